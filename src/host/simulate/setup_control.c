/* Speed control, current control and their sample times. */
#include <math.h>

#include "host/drive/machine_model.h"
#include "host/simulate/setup_task.h"

static hci_status count_sample(const hci_setup_task *b, const char *name, double value_s, double fallback_s,
                               unsigned *steps)
{
    *steps = (unsigned)fmax(floor(fallback_s / b->setup->drive.control.step_s + 0.5), 1.0);
    return isnan(value_s) ? HCI_OK : hci_setup_count_steps(b, name, value_s, 1, steps);
}

static hci_status set_sample_times(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    hci_control *control = &b->setup->drive.control;
    hci_status status =
        count_sample(b, "speed_sample_time", s->speed_sample_time_s, 1e-4, &control->speed_every);
    if (!status)
        status = count_sample(b, "current_sample_time", s->current_sample_time_s,
                              s->current_control == HCI_CURRENT_PI ? 1e-4 : 0.0, &control->current_every);
    return status;
}

/* Dead time of the inverter, and what the control does about it. */
static void set_dead_time(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    hci_drive *drive = &b->setup->drive;
    const double sample_s = drive->control.step_s * drive->control.current_every;
    drive->dead_time.voltage_V = drive->control.dc_link_V * hci_value_or(s->dead_time_s, 0.0) / sample_s;
    drive->dead_time.crossing_A = hci_value_or(s->dead_time_crossing_A, 0.0);
    if (hci_value_or(s->dead_time_compensation, 0.0) > 0.5)
        drive->control.current.dead_time = drive->dead_time;
}

static hci_status check_dead_time(const hci_setup_task *b)
{
    const hci_control *control = &b->setup->drive.control;
    const double dead_s = hci_value_or(b->scenario->dead_time_s, 0.0),
                 sample_s = control->step_s * control->current_every;
    if (dead_s < 0.5 * sample_s * (1.0 - 1e-9)) return HCI_OK;
    return hci_setup_wrong(
        b, "`dead_time` is %g s, expected less than half of `current_sample_time`, which is %g s", dead_s,
        sample_s);
}

/* A loop that is not stable may be what is to be seen, but not what nobody said. */
static void remark_stability(const hci_setup_task *b)
{
    const hci_control *control = &b->setup->drive.control;
    const hci_pi *pi = control->current.pi;
    hci_note ignored = {{0}};
    hci_machine_model m;
    if (hci_machine_model_make(b->machine, &m, &ignored)) return;
    const hci_loop_model loop = {.resistance_ohm = m.resistance_ohm,
                                 .inductance_H = {m.inductance_H[0], m.inductance_H[1]},
                                 .kp_ohm = {pi[0].proportional, pi[1].proportional},
                                 .ki_ohm_per_s = {pi[0].integral_per_s, pi[1].integral_per_s},
                                 .filter = control->current.filter,
                                 .sample_s = control->step_s * control->current_every,
                                 .delay_s = control->step_s * (double)control->current.delay_steps,
                                 .speed_rad_per_s =
                                     hci_value_or(b->scenario->prescribed_speed_rad_per_s, 0.0) *
                                     b->machine->model.pole_pairs,
                                 .decoupled = control->current.decoupled};
    const double pole = hci_loop_largest_pole(&loop);
    hci_machine_model_release(&m);
    if (pole >= 1.0)
        hci_note_add(
            &b->setup->remark,
            "the current loop is not stable with a k_p of %.4g V/A and a k_i of %.4g V/(A*s): largest pole "
            "%.4g, and what is simulated is how it swings",
            pi[0].proportional, pi[0].integral_per_s, pole);
}

static hci_status set_delay(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    hci_control *control = &b->setup->drive.control;
    control->current.delay_steps = hci_value_or(s->pwm_delay, 1.0) > 0.5 ? control->current_every : 0;
    if (isnan(s->computing_delay_s)) return HCI_OK;
    const hci_status status =
        hci_setup_count_steps(b, "computing_delay", s->computing_delay_s, 0, &control->current.delay_steps);
    if (status || control->current.delay_steps <= control->current_every) return status;
    return hci_setup_wrong(b, "`computing_delay` is %g s, expected at most `current_sample_time`",
                           s->computing_delay_s);
}

/* k_p and k_i of d, which are those of q as well where nothing else is said. */
static void set_gains(const hci_scenario *s, double kp_ohm, double ki_ohm_per_s, hci_control *control)
{
    const double sample_s = control->step_s * control->current_every;
    control->current.pi[0] = (hci_pi){kp_ohm, ki_ohm_per_s};
    control->current.pi[1] = (hci_pi){hci_value_or(s->current_kp_q_ohm, kp_ohm),
                                      hci_value_or(s->current_ki_q_V_per_As, ki_ohm_per_s)};
    if (s->current_filter_s > 0.0) control->current.filter = -expm1(-sample_s / s->current_filter_s);
}

/* Bandwidth 0.2 of a sample's rate, in rad: the 1.5 samples of delay then take 0.3 rad of the phase. */
static void set_current_pi(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    hci_control *control = &b->setup->drive.control;
    const double bandwidth_per_s = 0.2 / (control->step_s * control->current_every);
    double mean_H = 0.0;
    for (int k = 0; k < 360; ++k) {
        const hci_plant_point p = hci_plant_table_at(control->table, 2.0 * HCI_PI * k / 360.0);
        mean_H += 0.5 * (p.inductance_H[0] + p.inductance_H[2]) / 360.0;
    }
    set_gains(s, hci_value_or(s->current_kp_ohm, bandwidth_per_s * mean_H),
              hci_value_or(s->current_ki_V_per_As, bandwidth_per_s * b->machine->resistance_ohm), control);
    control->current.decoupled = hci_value_or(s->decoupling, 1.0) > 0.5;
    control->current.modulation = b->loop ? b->loop->modulation : HCI_MODULATION_SPACE_VECTOR;
    if (b->loop && b->loop->known) control->table = b->loop->known;
    set_dead_time(b);
}

static hci_status set_hysteresis(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    hci_control *control = &b->setup->drive.control;
    control->hysteresis.band_A = hci_value_or(s->hysteresis_band_A, 0.02 * b->machine->rated_current_A);
    control->hysteresis.hold_steps =
        hci_hysteresis_hold(hci_value_or(s->switching_frequency_max_Hz, 20e3), control->step_s);
    if (control->hysteresis.band_A > 0.0) return HCI_OK;
    return hci_setup_wrong(
        b, "no `hysteresis_band`, and machine.csv has no `rated_current` to take it from; add a row "
           "`hysteresis_band,VALUE,A`");
}

static hci_status set_current_control(const hci_setup_task *b)
{
    hci_control *control = &b->setup->drive.control;
    control->loop = b->scenario->current_control;
    if (control->loop == HCI_CURRENT_IDEAL) return HCI_OK;
    control->dc_link_V = hci_value_or(b->scenario->dc_link_voltage_V, b->machine->dc_link_voltage_V);
    if (control->dc_link_V <= 0.0)
        return hci_note_set(b->note, HCI_ERROR_INPUT, "machine.csv: expected `dc_link_voltage` above zero");
    if (control->loop == HCI_CURRENT_PI) set_current_pi(b);
    if (control->loop == HCI_CURRENT_PI && (set_delay(b) || check_dead_time(b))) return HCI_ERROR_INPUT;
    if (control->loop == HCI_CURRENT_PI && !b->loop) remark_stability(b);
    if (control->loop == HCI_CURRENT_HYSTERESIS && set_hysteresis(b)) return HCI_ERROR_INPUT;
    return hci_setup_need(b, control->dc_link_V, "dc_link_voltage", "V",
                          "an inverter needs (or give it in the scenario)");
}

/* Default: bandwidth 30 rad/s, and a double-pole-like integral part at a quarter of it. */
static void set_speed_control(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    hci_control *control = &b->setup->drive.control;
    const double limit_Nm =
        control->speed_controlled ? hci_value_or(2.0 * b->machine->rated_torque_Nm, HUGE_VAL) : HUGE_VAL;
    control->torque_limit_Nm = hci_value_or(s->torque_limit_Nm, limit_Nm);
    if (!control->speed_controlled) return;
    control->speed.proportional =
        hci_value_or(s->speed_kp_Nms_per_rad, 30.0 * b->setup->drive.plant.inertia_kgm2);
    control->speed.integral_per_s = hci_value_or(s->speed_ki_Nm_per_rad, 7.5 * control->speed.proportional);
}

hci_status hci_setup_control(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    hci_control *control = &b->setup->drive.control;
    hci_status status = set_sample_times(b);
    control->id_limit = hci_value_or(s->id_limit_A, HUGE_VAL);
    control->iq_limit = hci_value_or(s->iq_limit_A, HUGE_VAL);
    control->peak_limit_A = hci_value_or(s->current_limit_A, HUGE_VAL);
    set_speed_control(b);
    return status ? status : set_current_control(b);
}
