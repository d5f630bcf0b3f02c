/* summary.json of `simulate`: of a scenario, and of speeds. */
#include <stdio.h>

#include "hci/host/base/unit.h"
#include "host/report/summary.h"

/* Opens an object of the four figures with the unit in their names; whoever calls adds to it and closes it.
 */
static void open_statistics(hci_json *json, const char *name, const char *unit, const hci_statistics *x)
{
    static const char *const NAME[] = {"mean", "rms", "max", "min"};
    const double value[] = {x->mean, x->rms, x->most, x->least};
    hci_json_object(json, name);
    for (int k = 0; k < 4; ++k) {
        char key[48];
        snprintf(key, sizeof key, "%s_%s", NAME[k], unit);
        hci_json_number(json, key, value[k]);
    }
}

static void put_evaluation(hci_json *json, const hci_simulation *s)
{
    hci_json_object(json, "evaluation");
    hci_json_number(json, "step_s", s->step_s);
    hci_json_number(json, "from_s", s->from_s);
    hci_json_number(json, "to_s", s->to_s);
    hci_json_number(json, "periods", (double)s->periods);
    hci_json_number(json, "period_electrical_turns", (double)s->period_turns);
    hci_json_close(json);
}

static void put_torque_and_current(hci_json *json, const hci_simulation *s)
{
    open_statistics(json, "torque", "Nm", &s->torque_Nm);
    hci_json_number(json, "T_ripple", s->T_ripple_percent);
    hci_json_number(json, "F_ripple", s->F_ripple_percent);
    hci_json_close(json);
    open_statistics(json, "current", "A", &s->current_A);
    hci_json_number(json, "peak_phase_A", s->peak_phase_A);
    hci_json_number(json, "plain_amplitude_A", s->plain_amplitude_A);
    hci_json_number(json, "loss_ratio_to_plain", s->loss_to_plain);
    hci_json_number(json, "copper_loss_W", s->copper_W);
    hci_json_close(json);
    open_statistics(json, "current_dqx", "A", &s->current_dqx_A);
    hci_json_close(json);
    open_statistics(json, "speed", "rad_per_s", &s->speed_rad_per_s);
    hci_json_close(json);
}

static void put_control(hci_json *json, const hci_simulation *s)
{
    hci_json_object(json, "control");
    hci_json_number(json, "switching_frequency_Hz", s->switching_frequency_Hz);
    hci_json_number(json, "samples", (double)s->samples);
    hci_json_number(json, "samples_without_current", (double)s->without_current);
    hci_json_number(json, "samples_limited", (double)s->limited);
    hci_json_number(json, "samples_without_current_from_start", (double)s->without_current_from_start);
    hci_json_number(json, "samples_limited_from_start", (double)s->limited_from_start);
    hci_json_close(json);
}

static void put_energy(hci_json *json, const hci_simulation *s)
{
    const hci_energies *j = &s->energy_J;
    hci_json_object(json, "energy");
    hci_json_number(json, "electrical_J", j->electrical);
    hci_json_number(json, "copper_J", j->copper);
    hci_json_number(json, "stored_J", j->stored);
    hci_json_number(json, "mechanical_J", j->mechanical);
    hci_json_number(json, "residual_J", j->residual);
    hci_json_bool(json, "balances", s->energy_balances);
    hci_json_number(json, "load_J", j->load);
    hci_json_number(json, "friction_J", j->friction);
    hci_json_number(json, "kinetic_J", j->kinetic);
    hci_json_close(json);
}

char *hci_simulation_json(const hci_simulation *simulation)
{
    hci_json json;
    hci_summary_begin(&json, "simulate");
    put_evaluation(&json, simulation);
    put_torque_and_current(&json, simulation);
    put_control(&json, simulation);
    put_energy(&json, simulation);
    return hci_json_end(&json);
}

/* ---- speeds ---- */

static void put_result(hci_json *json, hci_remedy remedy, const hci_speed_result *x)
{
    hci_json_object(json, NULL);
    hci_json_text(json, "remedy", hci_remedy_name(remedy));
    hci_json_number(json, "mean_Nm", x->mean_Nm);
    hci_json_number(json, "T_ripple", x->T_ripple_percent);
    hci_json_number(json, "F_ripple", x->F_ripple_percent);
    hci_json_number(json, "ripple_Nm", x->ripple_Nm);
    hci_json_number(json, "worst_T_ripple", x->worst_T_ripple_percent);
    hci_json_number(json, "peak_phase_A", x->peak_A);
    hci_json_number(json, "peak_line_V", x->line_V);
    hci_json_number(json, "limited_share", x->limited_share);
    hci_json_close(json);
}

static void put_row(hci_json *json, const hci_speed_row *row)
{
    hci_json_object(json, NULL);
    hci_json_number(json, "speed_rpm", hci_rpm(row->speed_rad_per_s));
    hci_json_number(json, "needed_dc_link_V", row->needed_V);
    hci_json_number(json, "back_emf_V", row->back_emf_V);
    hci_json_number(json, "orders_short", (double)row->orders_short);
    hci_json_number(json, "response_ripple", row->response_ripple_percent);
    hci_json_array(json, "remedies");
    for (int k = 0; k < HCI_REMEDIES; ++k)
        put_result(json, (hci_remedy)k, &row->remedy[k]);
    hci_json_close(json);
    hci_json_close(json);
}

char *hci_speeds_json(const hci_speeds *s)
{
    hci_json json;
    hci_summary_begin(&json, "simulate");
    hci_json_number(&json, "torque_Nm", s->torque_Nm);
    hci_json_number(&json, "dc_link_V", s->dc_link_V);
    hci_json_number(&json, "reached_V", s->reached_V);
    hci_json_number(&json, "highest_order", s->highest_order);
    hci_json_number(&json, "coarse_angle_mean_Nm", s->coarse_mean_Nm);
    hci_json_number(&json, "lead_s", s->lead_s);
    hci_json_number(&json, "model_error_percent", 100.0 * s->model_error);
    hci_json_number(&json, "voltage_rpm", hci_rpm(s->voltage_rad_per_s));
    hci_json_number(&json, "sampled_rpm", hci_rpm(s->sampled_rad_per_s));
    hci_json_number(&json, "measured_rpm", hci_rpm(s->measured_rad_per_s));
    hci_json_number(&json, "response_error", s->response_error);
    hci_json_object(&json, "harmful_from_rpm");
    for (int k = HCI_REMEDY_TABLE; k < HCI_REMEDIES; ++k)
        hci_json_number(&json, hci_remedy_name((hci_remedy)k), hci_rpm(s->harmful_rad_per_s[k]));
    hci_json_close(&json);
    hci_json_array(&json, "speeds");
    for (size_t k = 0; k < s->count; ++k)
        put_row(&json, &s->row[k]);
    hci_json_close(&json);
    return hci_json_end(&json);
}
