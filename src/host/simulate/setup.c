/* From machine and scenario to a drive: every default, and what is missing or contradicts itself. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/solve/solution_folder.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/simulate/simulation.h"

enum { POINTS_PER_TURN = 4096, IDEAL_STEPS_PER_TURN = 2048, ROWS_WANTED = 20000 };

#define MOST_STEPS 4e9

typedef struct {
    const hci_machine_data *machine;
    const hci_effects *effects;
    const hci_scenario *scenario;
    hci_setup *setup;
    hci_note *note;
} job;

static double or_else(double value, double fallback)
{
    return isnan(value) ? fallback : value;
}

/* An error of the scenario as a whole. */
static hci_status wrong(const job *b, const char *format, ...) HCI_PRINTF(2, 3);
static hci_status wrong(const job *b, const char *format, ...)
{
    char text[HCI_NOTE_SIZE / 2], path[HCI_QUOTE_PATH_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (b->scenario->path[0] == '\0') return hci_note_set(b->note, HCI_ERROR_INPUT, "%s", text);
    return hci_note_set(b->note, HCI_ERROR_INPUT, "%s: %s", hci_quote_path(b->scenario->path, path), text);
}

/* A value of machine.csv that the plant cannot do without. */
static hci_status need(const job *b, double value, const char *name, const char *unit, const char *why)
{
    if (!isnan(value)) return HCI_OK;
    return hci_note_set(b->note, HCI_ERROR_INPUT,
                        "machine.csv: no `%s`, which %s; add a row `%s,VALUE,%s,SOURCE`", name, why, name,
                        unit);
}

/* ---- what the drive is to do ---- */

static hci_status check_set_points(const job *b)
{
    const hci_scenario *s = b->scenario;
    const bool speed = !isnan(s->speed_reference_rad_per_s), torque = !isnan(s->torque_reference_Nm);
    const bool imposed = s->currents[0] != '\0', prescribed = !isnan(s->prescribed_speed_rad_per_s);
    if (isnan(s->duration_s)) return wrong(b, "no `duration`; add a row `duration,VALUE,s`");
    if (prescribed && speed)
        return wrong(b,
                     "`prescribed_speed` leaves a speed loop nothing to do; delete it or `speed_reference`");
    if (prescribed && !isnan(s->initial_speed_rad_per_s))
        return wrong(b, "`prescribed_speed` is the speed from the start on; delete `initial_speed`");
    if (speed && torque)
        return wrong(b, "`speed_reference` and `torque_reference` are two set points; delete one of them");
    if (!speed && !torque && !imposed)
        return wrong(b, "no set point; add a row `speed_reference`, `torque_reference` or `currents`");
    if (isnan(s->load_torque_2_Nm) != isnan(s->load_torque_2_from_s))
        return wrong(b, "`load_torque_2` and `load_torque_2_from` go together; add the other row");
    return HCI_OK;
}

static void set_times_and_loads(const job *b)
{
    const hci_scenario *s = b->scenario;
    hci_setup *p = b->setup;
    p->prescribed = !isnan(s->prescribed_speed_rad_per_s);
    p->drive.control.speed_controlled = !isnan(s->speed_reference_rad_per_s);
    p->has_command = p->drive.control.speed_controlled || !isnan(s->torque_reference_Nm);
    p->set_point = p->drive.control.speed_controlled ? s->speed_reference_rad_per_s
                                                     : or_else(s->torque_reference_Nm, 0.0);
    p->load_Nm = or_else(s->load_torque_Nm, 0.0);
    p->load_2_Nm = or_else(s->load_torque_2_Nm, 0.0);
    p->load_2_from_s = or_else(s->load_torque_2_from_s, HUGE_VAL);
    p->seed = (uint64_t)or_else(s->seed, 1.0);
    p->highest_order = (size_t)or_else(s->highest_order, 60.0);
}

/* ---- time ---- */

static double default_step_s(const job *b)
{
    const hci_scenario *s = b->scenario;
    const double speed = fabs(or_else(s->prescribed_speed_rad_per_s, 0.0));
    if (s->current_control == HCI_CURRENT_HYSTERESIS) return 1e-6;
    if (s->current_control == HCI_CURRENT_PI) return 0.1 * or_else(s->current_sample_time_s, 1e-4);
    if (speed > 0.0) return 2.0 * HCI_PI / (b->machine->pole_pairs * speed * IDEAL_STEPS_PER_TURN);
    return 1e-5;
}

/* What is the same from beginning to end has no transient; else half of the time from the last change on is
 * left to it. */
static double default_settle_s(const job *b)
{
    const hci_scenario *s = b->scenario;
    const double last_s = fmax(or_else(s->strategy_2_from_s, 0.0), or_else(s->load_torque_2_from_s, 0.0));
    if (b->setup->prescribed && s->current_control == HCI_CURRENT_IDEAL)
        return or_else(s->strategy_2_from_s, 0.0);
    return last_s + 0.5 * (s->duration_s - last_s);
}

static hci_status set_steps(const job *b)
{
    const hci_scenario *s = b->scenario;
    hci_setup *p = b->setup;
    const double step_s = or_else(s->step_s, default_step_s(b)),
                 steps = ceil(s->duration_s / step_s * (1.0 - 1e-12) - 1e-6);
    p->drive.control.step_s = step_s;
    p->settle_s = or_else(s->settle_s, default_settle_s(b));
    if (steps < 2.0)
        return wrong(b, "`duration` is shorter than two steps of %g s; give a smaller `step`", step_s);
    if (steps > MOST_STEPS)
        return wrong(b, "`duration` has %.3g steps of %g s; give a larger `step` or a shorter `duration`",
                     steps, step_s);
    if (!(p->settle_s + 2.0 * step_s <= s->duration_s))
        return wrong(b,
                     "`settle` (%g s) leaves nothing of `duration` (%g s) to evaluate; make one of them "
                     "smaller or larger",
                     p->settle_s, s->duration_s);
    p->steps = (size_t)steps;
    p->every = (size_t)or_else(s->trajectory_every, ceil(steps / ROWS_WANTED));
    return HCI_OK;
}

/* A sample time or a delay as a whole number of steps. */
static hci_status count_steps(const job *b, const char *name, double value_s, unsigned least, unsigned *steps)
{
    const double count = value_s / b->setup->drive.control.step_s, whole = floor(count + 0.5);
    *steps = (unsigned)fmax(whole, least);
    if (fabs(count - whole) <= 1e-6 * fmax(count, 1.0) && whole >= least && whole < 1e9) return HCI_OK;
    return wrong(b, "`%s`: found %g s, expected a whole number of steps of %g s; change it or `step`", name,
                 value_s, b->setup->drive.control.step_s);
}

static hci_status count_sample(const job *b, const char *name, double value_s, double fallback_s,
                               unsigned *steps)
{
    *steps = (unsigned)fmax(floor(fallback_s / b->setup->drive.control.step_s + 0.5), 1.0);
    return isnan(value_s) ? HCI_OK : count_steps(b, name, value_s, 1, steps);
}

static hci_status set_sample_times(const job *b)
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

/* ---- the plant ---- */

/* L from its slopes but for its mean: S = C'/(p m), C = −S'/(p m). The mean is a placeholder that makes L
 * positive definite. */
static hci_status integrate_slopes(const job *b, hci_plant_inductance *given)
{
    const hci_machine *m = &b->machine->model;
    hci_inductance *terms = hci_memory_new(m->slope_count + 1, sizeof *terms);
    double sum = 0.0;
    if (!terms) return hci_note_memory(b->note, NULL, "%zu inductance orders", m->slope_count);
    for (size_t k = 0; k < m->slope_count; ++k) {
        const double scale = m->pole_pairs * m->slope[k].order;
        terms[k + 1].order = m->slope[k].order;
        for (size_t q = 0; q < HCI_PHASE_MATRIX && scale > 0.0; ++q) {
            terms[k + 1].sine[q] = m->slope[k].cosine[q] / scale;
            terms[k + 1].cosine[q] = -m->slope[k].sine[q] / scale;
            sum += hypot(terms[k + 1].sine[q], terms[k + 1].cosine[q]);
        }
    }
    for (size_t q = HCI_AA; q <= HCI_CC; ++q)
        terms[0].cosine[q] = 4.0 * sum + 1e-3;
    b->setup->terms = terms;
    *given = (hci_plant_inductance){terms, m->slope_count + 1, 0.0, 0.0};
    return HCI_OK;
}

static hci_status choose_inductance(const job *b, hci_plant_inductance *given)
{
    const hci_machine_data *m = b->machine;
    const bool imposed = b->scenario->current_control == HCI_CURRENT_IDEAL;
    hci_status status = HCI_OK;
    b->setup->has_inductance = true;
    *given = (hci_plant_inductance){m->inductance, m->inductance_count, 0.0, 0.0};
    if (m->inductance_count > 0) return HCI_OK;
    if (m->model.slope_count > 0 && !imposed)
        return hci_note_set(b->note, HCI_ERROR_INPUT,
                            "inductance.csv: slopes only, but currents that a voltage drives need the "
                            "inductances; give the columns "
                            "La_H … Mca_H, or `current_control,ideal` in the scenario");
    if (m->model.slope_count > 0) {
        b->setup->has_inductance = false;
        return integrate_slopes(b, given);
    }
    if (!imposed || isnan(m->inductance_d_H) != isnan(m->inductance_q_H)) {
        status = need(b, m->inductance_d_H, "inductance_d", "H", "the change of currents needs");
        if (!status) status = need(b, m->inductance_q_H, "inductance_q", "H", "the change of currents needs");
        if (status) return status;
    }
    b->setup->has_inductance = !isnan(m->inductance_d_H);
    given->d_H = or_else(m->inductance_d_H, 1e-3);
    given->q_H = or_else(m->inductance_q_H, 1e-3);
    if (fabs(given->d_H - given->q_H) > 1e-9 * given->q_H)
        hci_note_add(&b->setup->remark,
                     "inductance_d and inductance_q differ, and the reluctance torque that follows is in "
                     "this simulation; "
                     "`solve` reads inductance.csv only");
    return HCI_OK;
}

static hci_status fill_table(const job *b)
{
    hci_setup *p = b->setup;
    hci_plant_inductance given;
    size_t points;
    int turns;
    hci_status status = choose_inductance(b, &given);
    if (status) return status;
    turns = hci_plant_table_turns(&b->machine->model, &given);
    if (turns == 0)
        return hci_note_set(b->note, HCI_ERROR_INPUT,
                            "cogging.csv: an order is no multiple of 1/pole_pairs, so that nothing repeats "
                            "after a mechanical turn; "
                            "check the orders, which are electrical");
    points = (size_t)turns * POINTS_PER_TURN;
    p->period_turns = (size_t)turns;
    p->rows = hci_memory_new(hci_plant_table_size(points), sizeof *p->rows);
    if (!p->rows) return hci_note_memory(b->note, NULL, "a table of %zu angles", points);
    status = hci_plant_table_fill(&b->machine->model, &given, points, p->rows, &p->drive.plant.table);
    p->drive.control.table = &p->drive.plant.table;
    if (status == HCI_ERROR_SINGULAR)
        return hci_note_set(b->note, HCI_ERROR_INPUT,
                            "the inductances are not positive definite at every angle; check inductance.csv, "
                            "or inductance_d and "
                            "inductance_q of machine.csv, which must be above zero");
    return status ? hci_note_set(b->note, status, "the tables of the machine: %s", hci_status_text(status))
                  : HCI_OK;
}

static hci_status set_shaft(const job *b)
{
    const hci_scenario *s = b->scenario;
    const hci_machine_data *m = b->machine;
    hci_plant *plant = &b->setup->drive.plant;
    const double inertia = or_else(s->inertia_kgm2, m->inertia_kgm2);
    plant->inertia_kgm2 = HUGE_VAL;
    hci_plant_state *start = &b->setup->state.plant;
    start->speed_rad_per_s = or_else(s->prescribed_speed_rad_per_s, or_else(s->initial_speed_rad_per_s, 0.0));
    start->theta_m_rad = fmod(or_else(s->initial_angle_rad, 0.0) / m->pole_pairs, 2.0 * HCI_PI);
    if (start->theta_m_rad < 0.0) start->theta_m_rad += 2.0 * HCI_PI;
    if (b->setup->prescribed) return HCI_OK;
    plant->viscous_Nms =
        or_else(s->viscous_friction_Nms_per_rad, or_else(m->viscous_friction_Nms_per_rad, 0.0));
    plant->coulomb_Nm = or_else(s->coulomb_friction_Nm, or_else(m->coulomb_friction_Nm, 0.0));
    plant->inertia_kgm2 = inertia;
    if (inertia <= 0.0 || plant->viscous_Nms < 0.0 || plant->coulomb_Nm < 0.0)
        return hci_note_set(b->note, HCI_ERROR_INPUT,
                            "machine.csv: expected `inertia` above zero and friction of zero or more");
    return need(b, inertia, "inertia", "kgm2",
                "a rotor that turns freely needs (or give it, or `prescribed_speed`, in the scenario)");
}

static hci_status set_resistance(const job *b)
{
    const double resistance = b->machine->resistance_ohm;
    b->setup->drive.plant.resistance_ohm = resistance;
    if (resistance < 0.0)
        return hci_note_set(b->note, HCI_ERROR_INPUT, "machine.csv: expected `resistance` of zero or more");
    if (b->scenario->current_control == HCI_CURRENT_IDEAL) return HCI_OK;
    return need(b, resistance, "resistance", "ohm", "currents that a voltage drives need");
}

static hci_status set_plant(const job *b)
{
    hci_status status = HCI_OK;
    b->setup->machine = &b->machine->model;
    if (b->machine->has_neutral)
        status = hci_note_set(b->note, HCI_ERROR_INPUT,
                              "machine.csv: connection `star-neutral`, but only a star without neutral "
                              "conductor can be simulated; set "
                              "it to `star` to do without the neutral");
    if (!status) status = fill_table(b);
    if (!status) status = set_resistance(b);
    return status ? status : set_shaft(b);
}

/* ---- where currents come from ---- */

static hci_status check_waves(const job *b, const hci_currents *currents)
{
    const int pole_pairs = b->machine->model.pole_pairs;
    for (size_t k = 0; k < currents->count; ++k) {
        const hci_wave *w = &currents->wave[k];
        const double turn = w->order * pole_pairs;
        if (w->sequence == 0)
            return wrong(b,
                         "`currents`: a zero-sequence component of order %g cannot flow in a star without "
                         "neutral conductor; leave "
                         "it out",
                         w->order);
        if (fabs(turn - floor(turn + 0.5)) > HCI_ORDER_TOLERANCE)
            return wrong(b,
                         "`currents`: order %g is no multiple of 1/%d, so that it does not repeat after a "
                         "mechanical turn",
                         w->order, pole_pairs);
        if (fabs(w->order - floor(w->order + 0.5)) > HCI_ORDER_TOLERANCE)
            b->setup->period_turns = (size_t)pole_pairs;
    }
    return HCI_OK;
}

static hci_status read_waves(const job *b)
{
    hci_setup *p = b->setup;
    const char *path = b->scenario->currents;
    hci_status status;
    if (p->has_command && !hci_solution_is_folder(path))
        return wrong(b, "`currents` is one file, which a torque cannot scale; give the folder that `solve` "
                        "wrote, or delete the set "
                        "point");
    if (p->has_command && !hci_solution_has_parts(path))
        return wrong(b, "`currents`: this solution has no currents_per_Nm.csv: it is for one torque (a held "
                        "fundamental, or reluctance torque); use `strategy`, or delete the set point");
    status = hci_solution_read_currents(
        path, p->has_command ? HCI_SOLUTION_CURRENTS_CONSTANT : HCI_SOLUTION_CURRENTS, &p->fixed, b->note);
    if (!status && p->has_command)
        status = hci_solution_read_currents(path, HCI_SOLUTION_CURRENTS_PER_NM, &p->per_Nm, b->note);
    if (!status) status = check_waves(b, &p->fixed);
    if (!status) status = check_waves(b, &p->per_Nm);
    if (!status && p->fixed.count + p->per_Nm.count == 0)
        status = wrong(b, "`currents`: no rows, so that nothing flows");
    p->source[0].fixed = p->fixed.wave;
    p->source[0].fixed_count = p->fixed.count;
    p->source[0].per_Nm = p->per_Nm.wave;
    p->source[0].per_Nm_count = p->per_Nm.count;
    return status;
}

static hci_status set_sources(const job *b)
{
    const hci_scenario *s = b->scenario;
    hci_setup *p = b->setup;
    p->source[0].strategy = s->strategy;
    p->source[1].strategy = s->strategy_2;
    p->source[1].from_s = s->strategy_2_from_s;
    p->drive.control.sources = p->source;
    p->drive.control.source_count = isnan(s->strategy_2_from_s) ? 1 : 2;
    return s->currents[0] != '\0' ? read_waves(b) : HCI_OK;
}

/* ---- the controller ---- */

/* Bandwidth 0.2 of a sample's rate, in rad: the 1.5 samples of delay then take 0.3 rad of the phase. */
static void set_current_pi(const job *b)
{
    const hci_scenario *s = b->scenario;
    hci_control *control = &b->setup->drive.control;
    const double bandwidth_per_s = 0.2 / (control->step_s * control->current_every);
    double mean_H = 0.0;
    for (int k = 0; k < 360; ++k) {
        const hci_plant_point p = hci_plant_table_at(control->table, 2.0 * HCI_PI * k / 360.0);
        mean_H += 0.5 * (p.inductance_H[0] + p.inductance_H[2]) / 360.0;
    }
    control->current.pi.proportional = or_else(s->current_kp_ohm, bandwidth_per_s * mean_H);
    control->current.pi.integral_per_s =
        or_else(s->current_ki_V_per_As, bandwidth_per_s * b->machine->resistance_ohm);
    control->current.delayed = or_else(s->pwm_delay, 1.0) > 0.5;
    control->current.decoupled = or_else(s->decoupling, 1.0) > 0.5;
}

static hci_status set_hysteresis(const job *b)
{
    const hci_scenario *s = b->scenario;
    hci_control *control = &b->setup->drive.control;
    control->hysteresis.band_A = or_else(s->hysteresis_band_A, 0.02 * b->machine->rated_current_A);
    control->hysteresis.hold_steps =
        hci_hysteresis_hold(or_else(s->switching_frequency_max_Hz, 20e3), control->step_s);
    if (control->hysteresis.band_A > 0.0) return HCI_OK;
    return wrong(b, "no `hysteresis_band`, and machine.csv has no `rated_current` to take it from; add a row "
                    "`hysteresis_band,VALUE,A`");
}

static hci_status set_current_control(const job *b)
{
    hci_control *control = &b->setup->drive.control;
    control->loop = b->scenario->current_control;
    if (control->loop == HCI_CURRENT_IDEAL) return HCI_OK;
    control->dc_link_V = or_else(b->scenario->dc_link_voltage_V, b->machine->dc_link_voltage_V);
    if (control->dc_link_V <= 0.0)
        return hci_note_set(b->note, HCI_ERROR_INPUT, "machine.csv: expected `dc_link_voltage` above zero");
    if (control->loop == HCI_CURRENT_PI) set_current_pi(b);
    if (control->loop == HCI_CURRENT_HYSTERESIS && set_hysteresis(b)) return HCI_ERROR_INPUT;
    return need(b, control->dc_link_V, "dc_link_voltage", "V",
                "an inverter needs (or give it in the scenario)");
}

/* Default: bandwidth 30 rad/s, and a double-pole-like integral part at a quarter of it. */
static void set_speed_control(const job *b)
{
    const hci_scenario *s = b->scenario;
    hci_control *control = &b->setup->drive.control;
    const double limit_Nm =
        control->speed_controlled ? or_else(2.0 * b->machine->rated_torque_Nm, HUGE_VAL) : HUGE_VAL;
    control->torque_limit_Nm = or_else(s->torque_limit_Nm, limit_Nm);
    if (!control->speed_controlled) return;
    control->speed.proportional = or_else(s->speed_kp_Nms_per_rad, 30.0 * b->setup->drive.plant.inertia_kgm2);
    control->speed.integral_per_s = or_else(s->speed_ki_Nm_per_rad, 7.5 * control->speed.proportional);
}

static hci_status set_control(const job *b)
{
    const hci_scenario *s = b->scenario;
    hci_control *control = &b->setup->drive.control;
    hci_status status = set_sample_times(b);
    control->id_limit = or_else(s->id_limit_A, HUGE_VAL);
    control->iq_limit = or_else(s->iq_limit_A, HUGE_VAL);
    control->peak_limit_A = or_else(s->current_limit_A, HUGE_VAL);
    set_speed_control(b);
    if (!status) status = set_current_control(b);
    return status ? status : set_sources(b);
}

/* ---- sensors ---- */

static void set_sensors(const job *b)
{
    const hci_scenario *s = b->scenario;
    hci_sensor *sensor = b->setup->sensor;
    const double pole_pairs = b->machine->pole_pairs, counts = or_else(s->encoder_counts, 0.0);
    const double offset[3] = {s->current_offset_a_A, s->current_offset_b_A, s->current_offset_c_A};
    const double gain[3] = {s->current_gain_a, s->current_gain_b, s->current_gain_c};
    for (int k = 0; k < 3; ++k) {
        sensor[HCI_SENSE_IA + k].offset = or_else(offset[k], 0.0);
        sensor[HCI_SENSE_IA + k].gain_error = or_else(gain[k], 0.0);
        sensor[HCI_SENSE_IA + k].noise = or_else(s->current_noise_A, 0.0);
        sensor[HCI_SENSE_IA + k].quantum = or_else(s->current_quantum_A, 0.0);
    }
    sensor[HCI_SENSE_ANGLE].offset = or_else(s->angle_offset_rad, 0.0) / pole_pairs;
    sensor[HCI_SENSE_ANGLE].noise = or_else(s->angle_noise_rad, 0.0) / pole_pairs;
    sensor[HCI_SENSE_ANGLE].quantum = counts > 0.0 ? 2.0 * HCI_PI / counts : 0.0;
    sensor[HCI_SENSE_SPEED].noise = or_else(s->speed_noise_rad_per_s, 0.0);
    sensor[HCI_SENSE_TORQUE].noise = or_else(s->torque_noise_Nm, 0.0);
    if (counts > 0.0 && fmod(counts, pole_pairs) != 0.0) b->setup->period_turns = (size_t)pole_pairs;
}

static hci_status set_delays(const job *b)
{
    static const char *const NAME[HCI_SENSE_COUNT] = {"current_delay", "current_delay", "current_delay",
                                                      "angle_delay",   "speed_delay",   "torque_delay"};
    const hci_scenario *s = b->scenario;
    const double delay_s[HCI_SENSE_COUNT] = {s->current_delay_s, s->current_delay_s, s->current_delay_s,
                                             s->angle_delay_s,   s->speed_delay_s,   s->torque_delay_s};
    hci_setup *p = b->setup;
    for (int k = 0; k < HCI_SENSE_COUNT; ++k) {
        unsigned steps = 0;
        if (count_steps(b, NAME[k], or_else(delay_s[k], 0.0), 0, &steps)) return HCI_ERROR_INPUT;
        p->sensor[k].delay_steps = steps;
    }
    return HCI_OK;
}

static bool is_ideal(const hci_sensor *s)
{
    return s->gain_error == 0.0 && s->offset == 0.0 && s->noise == 0.0 && s->quantum == 0.0 &&
           s->delay_steps == 0 && !s->modify;
}

static void use_sensors(hci_setup *setup)
{
    for (int k = 0; k < HCI_SENSE_COUNT; ++k)
        if (!is_ideal(&setup->sensor[k])) setup->drive.sensors = setup->sensor;
}

/* What effects.csv adds to the plant and to the sensors; all of it repeats after a mechanical turn. */
static hci_status add_effects(const job *b)
{
    hci_setup *p = b->setup;
    p->temperature_C = b->scenario->magnet_temperature_C;
    if (!b->effects && b->machine->has_effects)
        return hci_note_set(b->note, HCI_ERROR_INPUT,
                            "effects.csv: the machine has effects, and without them it is another one");
    if (!b->effects || b->effects->count == 0) return HCI_OK;
    p->period_turns = (size_t)b->machine->model.pole_pairs;
    const hci_effects_plant plant = {&b->machine->model, b->effects, p->temperature_C};
    return hci_effects_attach(&plant, &p->state.plant, &p->drive, p->sensor, &p->attachment, b->note);
}

static hci_status give_rings(const job *b)
{
    hci_setup *p = b->setup;
    for (int k = 0; k < HCI_SENSE_COUNT; ++k) {
        const size_t size = hci_sensor_workspace(&p->sensor[k]);
        p->ring[k] = size > 0 ? hci_memory_new(size, sizeof *p->ring[k]) : NULL;
        if (size > 0 && !p->ring[k]) return hci_note_memory(b->note, NULL, "a delay of %zu steps", size);
    }
    return HCI_OK;
}

/* ---- all of it ---- */

hci_status hci_setup_make(const hci_machine_data *machine, const hci_effects *effects,
                          const hci_scenario *scenario, hci_setup *setup, hci_note *note)
{
    const job b = {machine, effects, scenario, setup, note};
    hci_status status;
    memset(setup, 0, sizeof *setup);
    status = check_set_points(&b);
    if (status) return status;
    set_times_and_loads(&b);
    status = set_plant(&b);
    if (!status) status = set_steps(&b);
    if (!status) status = set_control(&b);
    if (!status) {
        set_sensors(&b);
        status = set_delays(&b);
        use_sensors(setup);
    }
    if (!status) status = add_effects(&b);
    return status ? status : give_rings(&b);
}

void hci_setup_release(hci_setup *setup)
{
    hci_effects_detach(setup->attachment);
    hci_memory_free(setup->rows);
    hci_memory_free(setup->terms);
    hci_currents_release(&setup->fixed);
    hci_currents_release(&setup->per_Nm);
    for (int k = 0; k < HCI_SENSE_COUNT; ++k)
        hci_memory_free(setup->ring[k]);
}
