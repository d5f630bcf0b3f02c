/* What can be read in several ways: one row a slip. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/machine/init.h"
#include "host/check/interpretation.h"

#define SQRT2  1.4142135623730951
#define SQRT3  1.7320508075688772
#define DEGREE (HCI_PI / 180.0)
#define RPM    (2.0 * HCI_PI / 60.0)

/* One table in a hundred has a given slip; what many tools get wrong is twice as frequent, and what needs two
 * mistakes or a rare unit half as frequent or less. A sheet's value is of one kind only, so that the kinds of
 * the back-EMF share what a slip of it may have. */
#define OFTEN  0.02
#define SELDOM 0.005
#define SLIP   0.01

enum {
    AT_POLES,
    AT_EMF,
    AT_EMF_SIGN,
    AT_EMF_ORDER,
    AT_COGGING_ORDER,
    AT_PHASE,
    AT_EMF_PHASE,
    AT_COGGING_PHASE,
    AT_ZERO,
    AT_RATED_CURRENT,
    AT_RESISTANCE,
    AT_SLOPE,
    AT_THETA_M,
    AT_THETA_E,
    AT_THETA,
    AT_PHASES,
    AT_ABC,
    AT_DQ,
    AT_DRIVE,
    AT_CURRENT,
    AT_VOLTAGE,
    AT_PHASE_VOLTAGE,
    AT_TORQUE,
    AT_SPEED,
    AT_SPEED_M,
    AT_TIME
};

enum {
    OF_POLES,
    OF_EMF,
    OF_EMF_SIGN,
    OF_EMF_ORDER,
    OF_COGGING_ORDER,
    OF_PHASE,
    OF_ZERO,
    OF_RATED_CURRENT,
    OF_RESISTANCE,
    OF_SLOPE,
    OF_THETA,
    OF_THETA_UNIT,
    OF_DIRECTION,
    OF_RUN_ZERO,
    OF_PHASES,
    OF_CURRENT,
    OF_CURRENT_SIGN,
    OF_VOLTAGE,
    OF_VOLTAGE_SIGN,
    OF_TORQUE,
    OF_TORQUE_UNIT,
    OF_SPEED,
    OF_TIME
};

#define FIELD(name) offsetof(check_view, name)

#define UNLOADED "a recording of voltages, angle and speed of the motor driven without current"
#define LOADED   "a recording of currents, angle, speed and torque, with voltages if possible"
#define RATINGS  "rated_torque and rated_current in machine.csv, or a recording under load"

/* Rows as calls: aligned columns would be wider than any screen. */
#define ROW(...)                                                                                             \
    {                                                                                                        \
        __VA_ARGS__                                                                                          \
    }

const check_choice HCI_CHECK_CHOICES[] = {
    ROW("poles_for_pole_pairs", OF_POLES, OFTEN, FIELD(pole_pairs), 0.5, 0.0, AT_POLES,
        "pole_pairs is the number of poles", "%s",
        "the number of magnets counted, or a recording of currents or voltages with the angle"),
    ROW("emf_rms", OF_EMF, SLIP, FIELD(emf_kind), 0.0, EMF_RMS, AT_EMF,
        "the back-EMF is given as rms of a phase, not as peak", "%s", UNLOADED),
    ROW("emf_line", OF_EMF, SLIP, FIELD(emf_kind), 0.0, EMF_LINE, AT_EMF,
        "the back-EMF is given line to line, not line to star point", "%s", UNLOADED),
    ROW("emf_line_rms", OF_EMF, SLIP, FIELD(emf_kind), 0.0, EMF_LINE_RMS, AT_EMF,
        "the back-EMF is given as rms line to line, not as peak of a phase", "%s", UNLOADED),
    ROW("emf_volt_per_krpm", OF_EMF, SELDOM, FIELD(emf_kind), 0.0, EMF_VOLT_PER_KRPM, AT_EMF,
        "the back-EMF is given in V per 1000 rpm (peak of a phase)", "%s", UNLOADED),
    ROW("emf_volt_per_krpm_line", OF_EMF, SELDOM, FIELD(emf_kind), 0.0, EMF_VOLT_PER_KRPM_LINE, AT_EMF,
        "the back-EMF is given in V per 1000 rpm, peak line to line", "%s", UNLOADED),
    ROW("emf_volt_per_krpm_line_rms", OF_EMF, SLIP, FIELD(emf_kind), 0.0, EMF_VOLT_PER_KRPM_LINE_RMS, AT_EMF,
        "the back-EMF is given in V per 1000 rpm, rms line to line", "%s", UNLOADED),
    ROW("emf_kv", OF_EMF, SELDOM, FIELD(emf_kind), 0.0, EMF_KV, AT_EMF,
        "the back-EMF is given as Kv in rpm per V (peak line to line)", "%s", UNLOADED),
    ROW("emf_volt_per_hz", OF_EMF, SELDOM, FIELD(emf_kind), 0.0, EMF_VOLT_PER_HZ, AT_EMF,
        "the back-EMF is given in V per electrical Hz (peak of a phase)", "%s", UNLOADED),
    ROW("emf_flux_linkage", OF_EMF, SLIP, FIELD(emf_kind), 0.0, EMF_FLUX_LINKAGE, AT_EMF,
        "the back-EMF is given as flux linkage in Wb, per electrical radian", "%s", UNLOADED),
    ROW("emf_sign", OF_EMF_SIGN, SELDOM, FIELD(emf_sign), -1.0, 0.0, AT_EMF_SIGN,
        "the back-EMF has the opposite sign", "%s, and so in every row",
        "nothing has to: both put the fundamental's rising zero crossing at angle 0"),
    ROW("emf_orders_mechanical", OF_EMF_ORDER, SLIP, FIELD(emf_mechanical), 0.0, 1.0, AT_EMF_ORDER,
        "the orders of back_emf.csv are per mechanical turn", "%s: every order divided by pole_pairs",
        UNLOADED),
    ROW("cogging_orders_mechanical", OF_COGGING_ORDER, SLIP, FIELD(cogging_mechanical), 0.0, 1.0,
        AT_COGGING_ORDER, "the orders of cogging.csv are per mechanical turn",
        "%s: every order divided by pole_pairs",
        "a recording of torque over the angle without current, or `slots` in machine.csv"),
    ROW("phases_in_degrees", OF_PHASE, SLIP, FIELD(phase_unit), DEGREE, 0.0, AT_PHASE,
        "the phases of both tables are in degrees", "phase_deg", "a table with phases above 2π"),
    ROW("phases_in_degrees", OF_PHASE, SELDOM, FIELD(emf_phase_unit), DEGREE, 0.0, AT_EMF_PHASE,
        "the phases of back_emf.csv are in degrees", "phase_deg", "a table with phases above 2π"),
    ROW("phases_in_degrees", OF_PHASE, SELDOM, FIELD(cogging_phase_unit), DEGREE, 0.0, AT_COGGING_PHASE,
        "the phases of cogging.csv are in degrees", "phase_deg", "a table with phases above 2π"),
    ROW("angle_zero_d_axis", OF_ZERO, SLIP, FIELD(zero_rad), 0.0, HCI_PI, AT_ZERO,
        "the tables count the angle from the magnet axis (e_a = -sin), not from the rising zero crossing of "
        "the back-EMF",
        "%s: in every table, phase - order x pi",
        "nothing has to: both put the fundamental's rising zero crossing at angle 0"),
    ROW("angle_zero_q_axis", OF_ZERO, SLIP, FIELD(zero_rad), 0.0, 0.5 * HCI_PI, AT_ZERO,
        "the tables count the angle from the crest of the back-EMF (e_a = cos), not from its rising zero "
        "crossing",
        "%s: in every table, phase - order x pi/2", UNLOADED),
    ROW("angle_zero_q_axis", OF_ZERO, SLIP, FIELD(zero_rad), 0.0, -0.5 * HCI_PI, AT_ZERO,
        "the tables count the angle from the trough of the back-EMF (e_a = -cos), not from its rising zero "
        "crossing",
        "%s: in every table, phase + order x pi/2", UNLOADED),
    ROW("rated_current_rms", OF_RATED_CURRENT, OFTEN, FIELD(rated_current), SQRT2, 0.0, AT_RATED_CURRENT,
        "rated_current is rms, not peak", "%s", LOADED),
    ROW("inductance_per_electrical_radian", OF_SLOPE, SLIP, FIELD(slope_electrical), 0.0, 1.0, AT_SLOPE,
        "the slopes of inductance.csv are per electrical radian, not per mechanical one",
        "%s: all slopes times pole_pairs",
        "inductance_d and inductance_q in machine.csv, or a recording with i_d"),
    ROW("resistance_line", OF_RESISTANCE, SLIP, FIELD(resistance), 0.5, 0.0, AT_RESISTANCE,
        "resistance is between two terminals, not of a phase", "%s", LOADED),
    ROW("theta_electrical_for_mechanical", OF_THETA, SLIP, FIELD(theta_m_is_electrical), 0.0, 1.0, AT_THETA_M,
        "the angle of the recordings is electrical, not mechanical", "theta_e_rad",
        "phase currents or voltages beside the angle"),
    ROW("theta_mechanical_for_electrical", OF_THETA, SLIP, FIELD(theta_e_is_mechanical), 0.0, 1.0, AT_THETA_E,
        "the angle of the recordings is mechanical, not electrical", "theta_m_rad",
        "phase currents or voltages beside the angle"),
    ROW("theta_degrees_for_radians", OF_THETA_UNIT, SLIP, FIELD(theta_unit), DEGREE, 0.0, AT_THETA,
        "the angle of the recordings is in degrees", "the unit _deg in the column's name",
        "phase currents or voltages beside the angle"),
    ROW("run_angle_zero_d_axis", OF_RUN_ZERO, SLIP, FIELD(run_zero_rad), 0.0, HCI_PI, AT_THETA,
        "the recordings count the angle from the magnet axis (e_a = -sin)", "the electrical angle + pi",
        UNLOADED),
    ROW("run_angle_zero_q_axis", OF_RUN_ZERO, SLIP, FIELD(run_zero_rad), 0.0, 0.5 * HCI_PI, AT_THETA,
        "the recordings count the angle from the crest of the back-EMF (e_a = cos)",
        "the electrical angle + pi/2", UNLOADED),
    ROW("run_angle_zero_q_axis", OF_RUN_ZERO, SLIP, FIELD(run_zero_rad), 0.0, -0.5 * HCI_PI, AT_THETA,
        "the recordings count the angle from the trough of the back-EMF (e_a = -cos)",
        "the electrical angle - pi/2", UNLOADED),
    ROW("direction_reversed", OF_DIRECTION, SELDOM, FIELD(direction), -1.0, 0.0, AT_THETA,
        "the angle of the recordings is counted backward", "the angle with the opposite sign",
        "a speed of its own beside time and angle (angle and speed reversed together look like b and c "
        "swapped)"),
    ROW("phases_swapped", OF_PHASES, SLIP, FIELD(swapped), 0.0, 1.0, AT_PHASES,
        "phases b and c of the recordings are swapped", "b and c the other way round", UNLOADED),
    ROW("current_rms", OF_CURRENT, SELDOM, FIELD(current), SQRT2, 0.0, AT_ABC,
        "the phase currents are scaled to rms values", "every current times sqrt(2)", LOADED),
    ROW("current_power_invariant", OF_CURRENT, SLIP, FIELD(current), 0.81649658092772603, 0.0, AT_DQ,
        "id and iq are power-invariant, not amplitude-invariant", "id and iq times sqrt(2/3)", LOADED),
    ROW("current_power_invariant", OF_CURRENT, SLIP, FIELD(dq), 0.81649658092772603, 0.0, AT_DRIVE,
        "id, iq, vd and vq are power-invariant, not amplitude-invariant", "id, iq, vd and vq times sqrt(2/3)",
        LOADED),
    ROW("current_dq_rms", OF_CURRENT, SLIP, FIELD(current), SQRT2, 0.0, AT_DQ, "id and iq are rms values",
        "id and iq times sqrt(2)", LOADED),
    ROW("current_dq_rms", OF_CURRENT, SLIP, FIELD(dq), SQRT2, 0.0, AT_DRIVE,
        "id, iq, vd and vq are rms values", "id, iq, vd and vq times sqrt(2)", LOADED),
    ROW("current_sign", OF_CURRENT_SIGN, SLIP, FIELD(current), -1.0, 0.0, AT_CURRENT,
        "the currents are counted out of the machine", "every current with the opposite sign",
        "voltages beside currents and torque, at a current with a clear copper loss"),
    ROW("voltage_line", OF_VOLTAGE, SLIP, FIELD(voltage_is_line), 0.0, 1.0, AT_PHASE_VOLTAGE,
        "the voltages are line to line: va holds v_ab, vb v_bc, vc v_ca", "vab_V, vbc_V, vca_V", UNLOADED),
    ROW("voltage_sign", OF_VOLTAGE_SIGN, SLIP, FIELD(voltage), -1.0, 0.0, AT_VOLTAGE,
        "the voltages have the opposite sign", "every voltage with the opposite sign",
        "voltages beside currents, speed and torque under load"),
    ROW("torque_sign", OF_TORQUE, SLIP, FIELD(torque), -1.0, 0.0, AT_TORQUE,
        "the torque is that of a generator: positive against the rotation",
        "the torque with the opposite sign",
        "voltages beside currents and torque, at a current with a clear copper loss"),
    ROW("torque_millinewton", OF_TORQUE_UNIT, SLIP, FIELD(torque), 1e-3, 0.0, AT_TORQUE,
        "the torque is in mN·m", "torque_mNm", LOADED),
    ROW("speed_electrical", OF_SPEED, SLIP, FIELD(speed_electrical), 0.0, 1.0, AT_SPEED_M,
        "the speed is electrical, not mechanical", "the speed divided by pole_pairs",
        "time, angle and phase currents or voltages beside the speed"),
    ROW("speed_rpm_for_rad_per_s", OF_SPEED, SLIP, FIELD(speed), RPM, 0.0, AT_SPEED, "the speed is in rpm",
        "speed_rpm", "time and angle beside the speed"),
    ROW("time_milliseconds", OF_TIME, SLIP, FIELD(time), 1e-3, 0.0, AT_TIME, "the time is in milliseconds",
        "time_ms", "a speed beside time and angle"),
};
const size_t HCI_CHECK_CHOICE_COUNT = sizeof HCI_CHECK_CHOICES / sizeof *HCI_CHECK_CHOICES;

/* Volts at a frequency that is given are seldom volts at another, or another thing. */
double hci_check_choice_prior(const check_choice *choice, const check_figures *f)
{
    const bool of_unit = choice->aspect == OF_EMF && choice->plus >= EMF_VOLT_PER_KRPM;
    return of_unit && f->emf_in_volts ? 0.1 * choice->prior : choice->prior;
}

/* ---- views */

check_view hci_check_view_declared(void)
{
    return (check_view){.pole_pairs = 1.0,
                        .emf_sign = 1.0,
                        .phase_unit = 1.0,
                        .emf_phase_unit = 1.0,
                        .cogging_phase_unit = 1.0,
                        .rated_current = 1.0,
                        .resistance = 1.0,
                        .theta_unit = 1.0,
                        .direction = 1.0,
                        .current = 1.0,
                        .voltage = 1.0,
                        .dq = 1.0,
                        .torque = 1.0,
                        .speed = 1.0,
                        .time = 1.0};
}

void hci_check_view_take(check_view *view, const check_choice *choice)
{
    double field;
    char *at = (char *)view + choice->field;
    memcpy(&field, at, sizeof field);
    field = field * choice->times + choice->plus;
    memcpy(at, &field, sizeof field);
}

/* ---- the machine of a view */

/* k_e in V·s/rad, peak of a phase, of the number in the table. */
static double emf_of(const check_figures *f, const check_view *view, double pole_pairs)
{
    const double a = fabs(f->emf.amplitude[f->emf.largest]);
    const double declared =
        f->emf_in_volts ? a * pole_pairs / (2.0 * HCI_PI * f->value[CHECK_emf_frequency_Hz]) : a;
    switch ((int)view->emf_kind) {
    case EMF_RMS:
        return declared * SQRT2;
    case EMF_LINE:
        return declared / SQRT3;
    case EMF_LINE_RMS:
        return declared * SQRT2 / SQRT3;
    case EMF_VOLT_PER_KRPM:
        return hci_sheet_emf(HCI_SHEET_VOLT_PHASE_PEAK, a, 1);
    case EMF_VOLT_PER_KRPM_LINE:
        return hci_sheet_emf(HCI_SHEET_VOLT_LINE_PEAK, a, 1);
    case EMF_VOLT_PER_KRPM_LINE_RMS:
        return hci_sheet_emf(HCI_SHEET_VOLT_LINE_RMS, a, 1);
    case EMF_KV:
        return hci_sheet_emf(HCI_SHEET_KV_LINE_PEAK, a, 1);
    case EMF_VOLT_PER_HZ: /* ω_m = 2πf/p */
        return a * pole_pairs / (2.0 * HCI_PI);
    case EMF_FLUX_LINKAGE:
        return a * pole_pairs;
    default:
        return declared;
    }
}

/* A sin(nθ' + γ) with θ' = θ − zero is A sin(nθ + γ − n zero); the largest row is order 1. */
static double emf_phase_of(const check_figures *f, const check_view *view)
{
    const size_t k = f->emf.largest;
    const double phase = f->emf.phase_rad[k] * view->phase_unit * view->emf_phase_unit;
    const bool negative = f->emf.amplitude[k] * view->emf_sign < 0.0;
    return remainder(phase - view->zero_rad + (negative ? HCI_PI : 0.0), 2.0 * HCI_PI);
}

/* Turning d and q by δ turns what L_d − L_q makes by 2δ; readings know quarter turns only. */
static double turned_difference(const check_view *view)
{
    return cos(2.0 * view->zero_rad) < 0.0 ? -1.0 : 1.0;
}

static void inductances_of(const check_figures *f, const check_view *view, check_model *m)
{
    const check_inductance *l = &f->inductance;
    const bool turned = turned_difference(view) < 0.0;
    m->inductance_d_H = f->value[CHECK_inductance_d_H];
    m->inductance_q_H = f->value[CHECK_inductance_q_H];
    if (isnan(m->inductance_d_H) || isnan(m->inductance_q_H)) {
        m->inductance_d_H = turned ? l->inductance_q_H : l->inductance_d_H;
        m->inductance_q_H = turned ? l->inductance_d_H : l->inductance_q_H;
        if (!l->given) m->inductance_d_H = m->inductance_q_H = NAN;
    }
    m->reluctance_Nm_per_A2 = 1.5 * m->pole_pairs * (m->inductance_d_H - m->inductance_q_H);
    if (!l->given) return;
    m->reluctance_Nm_per_A2 = l->reluctance_Nm_per_A2 * turned_difference(view);
    if (!l->are_slopes)
        m->reluctance_Nm_per_A2 *= view->pole_pairs;
    else if (view->slope_electrical > 0.0)
        m->reluctance_Nm_per_A2 *= m->pole_pairs;
}

check_model hci_check_model_of(const check_figures *f, const check_view *view)
{
    check_model m = {.pole_pairs = f->value[CHECK_pole_pairs] * view->pole_pairs};
    m.emf = emf_of(f, view, m.pole_pairs);
    m.emf_phase_rad = emf_phase_of(f, view);
    m.resistance_ohm = f->value[CHECK_resistance_ohm] * view->resistance;
    m.rated_current_A = f->value[CHECK_rated_current_A] * view->rated_current;
    inductances_of(f, view, &m);
    return m;
}

/* ---- places */

/* The first recording with a cell of this kind. */
static const check_place *run_place(const check_figures *f, int where)
{
    for (size_t k = 0; k < f->runs; ++k) {
        const check_run *r = &f->run[k];
        const check_place *place = NULL;
        if (where == AT_THETA || where == (r->is_electrical ? AT_THETA_E : AT_THETA_M))
            place = &r->theta_cell;
        if (where == AT_CURRENT || (where == AT_ABC && r->has_abc) || (where == AT_DQ && r->has_dq))
            place = &r->current_cell;
        if (where == AT_DRIVE && r->has_dq && r->has_dq_voltage) place = &r->current_cell;
        if (where == AT_PHASES && r->theta_cell.path)
            place = r->has_abc ? &r->current_cell : r->has_phase_voltage ? &r->voltage_cell : NULL;
        if (where == AT_VOLTAGE || (where == AT_PHASE_VOLTAGE && r->has_phase_voltage))
            place = &r->voltage_cell;
        if (where == AT_TORQUE && r->has_torque) place = &r->torque_cell;
        if (where == AT_SPEED || (where == AT_SPEED_M && !r->speed_is_electrical)) place = &r->speed_cell;
        if (where == AT_TIME) place = &r->time_cell;
        if (place && place->path) return place;
    }
    return NULL;
}

static const check_place *place_of(const check_figures *f, int where)
{
    switch (where) {
    case AT_POLES:
        return &f->cell[CHECK_pole_pairs];
    case AT_EMF:
    case AT_EMF_SIGN:
        return &f->emf.amplitude_cell;
    case AT_EMF_ORDER:
        return &f->emf.order_cell;
    case AT_COGGING_ORDER:
        return &f->cogging.order_cell;
    case AT_PHASE:
        return f->emf.most_phase_rad >= f->cogging.most_phase_rad ? &f->emf.phase_cell
                                                                  : &f->cogging.phase_cell;
    case AT_EMF_PHASE:
    case AT_ZERO:
        return &f->emf.phase_cell;
    case AT_COGGING_PHASE:
        return &f->cogging.phase_cell;
    case AT_RATED_CURRENT:
        return &f->cell[CHECK_rated_current_A];
    case AT_RESISTANCE:
        return &f->cell[CHECK_resistance_ohm];
    case AT_SLOPE:
        return &f->inductance.cell;
    default:
        return run_place(f, where);
    }
}

static bool is_beyond(const check_table *t)
{
    return t->most_phase_rad > 2.0 * HCI_PI;
}

/* Poles are an even number; a motor with one pole pair has no electrical radians of its own; degrees show by
 * phases above 2π, and read as degrees all others would be near 0. */
bool hci_check_choice_applies(const check_choice *choice, const check_figures *f)
{
    const double p = f->value[CHECK_pole_pairs];
    const check_place *place = place_of(f, choice->where);
    if (!place || !place->path) return false;
    if (choice->where == AT_POLES) return fmod(p, 2.0) == 0.0;
    if (choice->where == AT_PHASE)
        return f->cogging.count > 0 && (is_beyond(&f->emf) || is_beyond(&f->cogging));
    if (choice->where == AT_EMF_PHASE) return is_beyond(&f->emf);
    if (choice->where == AT_COGGING_PHASE) return is_beyond(&f->cogging);
    if (choice->aspect == OF_THETA || choice->aspect == OF_EMF_ORDER || choice->aspect == OF_COGGING_ORDER ||
        choice->aspect == OF_SLOPE)
        return p > 1.0;
    return true;
}

/* The number that should stand at the place, NAN where there is none to tell. */
static double right_number(const check_choice *choice, const check_figures *f, const check_view *view)
{
    const check_view declared = hci_check_view_declared();
    const check_model as_read = hci_check_model_of(f, view), before = hci_check_model_of(f, &declared);
    const check_table *e = &f->emf, *c = &f->cogging;
    switch (choice->where) {
    case AT_POLES:
        return as_read.pole_pairs;
    case AT_EMF: {
        check_view poles = declared;
        poles.pole_pairs = view->pole_pairs;
        return e->amplitude[e->largest] * as_read.emf / hci_check_model_of(f, &poles).emf;
    }
    case AT_EMF_SIGN:
        return -e->amplitude[e->largest];
    case AT_EMF_ORDER:
        return e->order[e->largest] / as_read.pole_pairs;
    case AT_COGGING_ORDER:
        return c->order[c->largest] / as_read.pole_pairs;
    case AT_ZERO:
        return as_read.emf_phase_rad;
    case AT_RATED_CURRENT:
        return f->value[CHECK_rated_current_A] * SQRT2;
    case AT_RESISTANCE:
        return 0.5 * before.resistance_ohm;
    default:
        return NAN;
    }
}

/* Words around a number: "%s: every order divided by pole_pairs". */
static void fill(char out[HCI_CHECK_TEXT], const char *words, double number)
{
    const char *at = strstr(words, "%s");
    char text[32] = "";
    if (isfinite(number)) snprintf(text, sizeof text, "%.6g", number);
    if (!at)
        snprintf(out, HCI_CHECK_TEXT, "%s", words);
    else if (text[0] == '\0')
        snprintf(out, HCI_CHECK_TEXT, "%s", at[2] == ':' ? at + 4 : at + 2);
    else
        snprintf(out, HCI_CHECK_TEXT, "%.*s%s%s", (int)(at - words), words, text, at + 2);
}

void hci_check_choice_locate(const check_choice *choice, const check_figures *f, const check_view *view,
                             hci_check_finding *finding)
{
    const check_place *place = place_of(f, choice->where);
    finding->slip = choice->slip;
    finding->words = choice->words;
    finding->told_by = choice->told_by;
    snprintf(finding->file, sizeof finding->file, "%s", place->path);
    finding->line = place->line;
    memcpy(finding->column, place->column, sizeof finding->column);
    memcpy(finding->found, place->text, sizeof finding->found);
    fill(finding->should_be, choice->should_be, right_number(choice, f, view));
}
