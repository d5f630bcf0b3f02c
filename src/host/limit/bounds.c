#include "host/limit/bounds.h"

#include <math.h>

static const char PHASE[] = "abc";

static bool is_given(double value)
{
    return value > 0.0;
}

/* ---- contradictions ---- */

/* Negative values and those that are no numbers; 0 means that there is no limit. */
static hci_status check_signs(const hci_solve_options *o, hci_note *note)
{
    const hci_solve_limits *l = &o->limits;
    bool good = o->limit_current_A >= 0.0 && o->limit_voltage_V >= 0.0 && l->copper_W >= 0.0 &&
                l->copper_ratio >= 0.0 && l->dead_time_s >= 0.0 && l->pwm_frequency_Hz >= 0.0;
    for (int s = 0; s < 3; ++s)
        good = good && l->current_A[s] >= 0.0 && l->rms_A[s] >= 0.0;
    if (good && isfinite(o->speed_rad_per_s)) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "limits: found a negative value or one that is no number; expected values above 0");
}

static hci_status check_open_held(const hci_solve_options *o, hci_note *note)
{
    for (int s = 0; s < 3 && o->held; ++s)
        if (o->limits.is_open[s])
            return hci_note_set(note, HCI_ERROR_ARGUMENT,
                                "phase %c carries no current, but a fundamental of all phases is held; leave "
                                "out one of the two",
                                PHASE[s]);
    return HCI_OK;
}

/* A star has no way back through the neutral: two phases are one loop, one phase is none. */
static hci_status check_open(const hci_machine_data *m, const hci_solve_options *o, hci_note *note)
{
    const bool *open = o->limits.is_open;
    const int count = open[0] + open[1] + open[2];
    if (count > 0 && o->choose_at_most > 0)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "at most K components are chosen for three phases that carry current; with an open "
            "one leave out K or name the components with --harmonics");
    if (count <= (m->has_neutral ? 2 : 1)) return check_open_held(o, note);
    return hci_note_set(note, HCI_ERROR_ARGUMENT,
                        "%s phases are limited to 0 A, and %s connection then carries no current at all, so "
                        "there is no torque; allow current in %s",
                        count == 3 ? "all three" : "two", m->has_neutral ? "no" : "a star",
                        m->has_neutral ? "a phase" : "two phases");
}

static hci_status check_voltage(const hci_solve_options *o, hci_note *note)
{
    const hci_solve_limits *l = &o->limits;
    const double lost = l->voltage_reserve + 2.0 * l->dead_time_s * l->pwm_frequency_Hz;
    if (is_given(l->dead_time_s) != is_given(l->pwm_frequency_Hz))
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "the dead time takes 2 · dead time · switching frequency of the dc link: give both, "
            "--dead-time and --pwm-frequency");
    if (l->voltage_reserve >= 0.0 && lost < 1.0) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "reserve and dead time take %.3g times the dc link; expected a share from 0 to below 1", lost);
}

/* ---- from options to bounds ---- */

static void take_currents(const hci_machine_data *m, const hci_solve_options *o, hci_bounds *b)
{
    const hci_solve_limits *l = &o->limits;
    const bool declared = !l->ignore_ratings && is_given(m->max_current_A) && !is_given(o->limit_current_A);
    const double all_A = is_given(o->limit_current_A) ? o->limit_current_A
                         : declared                   ? m->max_current_A
                                                      : HUGE_VAL;
    for (int s = 0; s < 3; ++s) {
        b->current_is_declared[s] = declared && !l->is_open[s] && !is_given(l->current_A[s]);
        b->current_A[s] = l->is_open[s] ? 0.0 : is_given(l->current_A[s]) ? l->current_A[s] : all_A;
        b->rms_A[s] = is_given(l->rms_A[s]) && !l->is_open[s] ? l->rms_A[s] : HUGE_VAL;
    }
}

static void take_voltage(const hci_machine_data *m, const hci_solve_options *o, hci_bounds *b)
{
    const hci_solve_limits *l = &o->limits;
    const bool has_speed = o->at_speed || o->speed_rad_per_s != 0.0;
    const bool declared =
        !l->ignore_ratings && is_given(m->dc_link_voltage_V) && !is_given(o->limit_voltage_V) && has_speed;
    const double link_V = declared ? m->dc_link_voltage_V : o->limit_voltage_V;
    b->voltage_is_declared = declared;
    b->modulation = l->modulation;
    b->line_V_per_V = 1.0 - l->voltage_reserve - 2.0 * l->dead_time_s * l->pwm_frequency_Hz;
    b->line_V = is_given(link_V) ? b->line_V_per_V * link_V : HUGE_VAL;
}

static hci_status take_copper(const hci_machine_data *m, const hci_solve_limits *l, double plain_A,
                              hci_bounds *b, hci_note *note)
{
    b->mean_square_A2 = HUGE_VAL;
    b->resistance_ohm = m->resistance_ohm;
    if (is_given(l->copper_W) && !is_given(m->resistance_ohm))
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "machine.csv: a copper loss in W needs `resistance`; add that row or give a ratio "
            "to the plain sine");
    if (is_given(l->copper_ratio) && !is_given(plain_A))
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "the copper loss is limited to a ratio to the plain sine, but no sine makes the "
                            "wanted mean torque; give it in W");
    if (is_given(l->copper_W)) b->mean_square_A2 = l->copper_W / m->resistance_ohm;
    if (is_given(l->copper_ratio))
        b->mean_square_A2 = fmin(b->mean_square_A2, 1.5 * l->copper_ratio * plain_A * plain_A);
    return HCI_OK;
}

hci_status hci_bounds_make(const hci_machine_data *machine, const hci_solve_options *options, double plain_A,
                           hci_bounds *bounds, hci_note *note)
{
    hci_status status = check_signs(options, note);
    if (!status) status = check_open(machine, options, note);
    if (!status) status = check_voltage(options, note);
    if (status) return status;
    take_currents(machine, options, bounds);
    take_voltage(machine, options, bounds);
    return take_copper(machine, &options->limits, plain_A, bounds, note);
}

static bool is_driven(const hci_bounds *b, int pair)
{
    return b->current_A[pair] > 0.0 && b->current_A[(pair + 1) % 3] > 0.0;
}

bool hci_bounds_drive_pair(const hci_bounds *b, int pair)
{
    if (!(is_driven(b, 0) || is_driven(b, 1) || is_driven(b, 2))) return true;
    return b->modulation == HCI_MODULATION_SINUSOIDAL ? b->current_A[pair] > 0.0 : is_driven(b, pair);
}

bool hci_bounds_are_alike(const hci_bounds *b)
{
    bool alike = true;
    for (int s = 1; s < 3; ++s)
        alike = alike && b->current_A[s] == b->current_A[0] && b->rms_A[s] == b->rms_A[0];
    return alike;
}
