/* What the numbers of a data sheet mean: the strength of the magnets by any of its conventions, and whether
 * the ratings agree with it. */
#include <math.h>

#include "hci/host/machine/init.h"
#include "hci/math/harmonic.h"
#include "host/numeric/divisor.h"

#define SQRT2 1.4142135623730951
#define SQRT3 1.7320508075688772
#define RPM   (2.0 * HCI_PI / 60.0) /* rad/s */

/* ---- readings ---- */

/* What the sheet's number is for k_e = 1: per rpm/V the inverse of the voltage at 1 rpm, else in proportion.
 */
static double value_of_one(hci_sheet_reading reading, int pole_pairs)
{
    switch (reading) {
    case HCI_SHEET_KV_LINE_PEAK:
        return 1.0 / (SQRT3 * RPM);
    case HCI_SHEET_KV_LINE_RMS:
        return SQRT2 / (SQRT3 * RPM);
    case HCI_SHEET_KV_PHASE_PEAK:
        return 1.0 / RPM;
    case HCI_SHEET_VOLT_LINE_RMS:
        return 1000.0 * RPM * SQRT3 / SQRT2;
    case HCI_SHEET_VOLT_LINE_PEAK:
        return 1000.0 * RPM * SQRT3;
    case HCI_SHEET_VOLT_PHASE_PEAK:
        return 1000.0 * RPM;
    case HCI_SHEET_VOLT_PHASE_RMS:
        return 1000.0 * RPM / SQRT2;
    case HCI_SHEET_TORQUE_PEAK:
        return 1.5;
    case HCI_SHEET_TORQUE_RMS:
        return 1.5 * SQRT2;
    case HCI_SHEET_TORQUE_DC:
        return SQRT3;
    case HCI_SHEET_FLUX:
        return 1.0 / pole_pairs;
    }
    return NAN;
}

static bool is_inverse(hci_sheet_reading reading)
{
    return reading == HCI_SHEET_KV_LINE_PEAK || reading == HCI_SHEET_KV_LINE_RMS ||
           reading == HCI_SHEET_KV_PHASE_PEAK;
}

double hci_sheet_emf(hci_sheet_reading reading, double value, int pole_pairs)
{
    const double one = value_of_one(reading, pole_pairs);
    return is_inverse(reading) ? one / value : value / one;
}

double hci_sheet_value(hci_sheet_reading reading, double emf_Vs_per_rad, int pole_pairs)
{
    const double one = value_of_one(reading, pole_pairs);
    return is_inverse(reading) ? one / emf_Vs_per_rad : one * emf_Vs_per_rad;
}

const char *hci_sheet_unit(hci_sheet_reading reading)
{
    static const char *const UNIT[] = {
#define UNIT_OF(name, unit, meaning) unit,
        HCI_SHEET_READINGS(UNIT_OF)
#undef UNIT_OF
    };
    return UNIT[reading];
}

const char *hci_sheet_meaning(hci_sheet_reading reading)
{
    static const char *const MEANING[] = {
#define MEANING_OF(name, unit, meaning) meaning,
        HCI_SHEET_READINGS(MEANING_OF)
#undef MEANING_OF
    };
    return MEANING[reading];
}

int hci_cogging_order(int slots, int pole_pairs)
{
    return 2 * (slots / (int)hci_common_divisor((size_t)slots, 2 * (size_t)pole_pairs));
}

bool hci_has_equal_phases(int slots, int pole_pairs)
{
    return slots % (3 * (int)hci_common_divisor((size_t)slots, (size_t)pole_pairs)) == 0;
}

static double emf(const hci_sheet *s)
{
    return hci_sheet_emf(s->reading, s->strength, s->pole_pairs);
}

double hci_sheet_current_A(const hci_sheet *s)
{
    return s->rated_current_A * (s->rated_current_is_rms ? SQRT2 : 1.0);
}

double hci_sheet_resistance_ohm(const hci_sheet *s)
{
    return s->resistance_ohm * (s->resistance_of_line ? 0.5 : 1.0);
}

/* ---- do the numbers of the sheet agree? ---- */

/* Iron that saturates and torque lost in friction make a sheet's ratio a little smaller than 1. */
#define LEAST_RATIO 0.8
#define MOST_RATIO  1.2

/* The convention error whose factor is nearest to the ratio, within 8 %, in words; "" if there is none. */
static const char *convention_error_of(double ratio, bool from_flux)
{
    static const struct {
        double factor;
        bool flux_only;
        const char *words;
    } ERRORS[] = {
        {SQRT2, false, ": about sqrt(2); is one of them rms and taken as peak?"},
        {1.0 / SQRT2, false, ": about 1/sqrt(2); is one of them peak and taken as rms?"},
        {SQRT3, false, ": about sqrt(3); is a line-to-line value taken as of a phase?"},
        {1.0 / SQRT3, false, ": about 1/sqrt(3); is a value of a phase taken as line to line?"},
        {2.0, true, ": about 2; are poles and pole pairs mixed up?"},
        {0.5, true, ": about 1/2; are poles and pole pairs mixed up?"},
    };
    for (size_t k = 0; k < sizeof ERRORS / sizeof *ERRORS; ++k)
        if (fabs(ratio / ERRORS[k].factor - 1.0) < 0.08 && (from_flux || !ERRORS[k].flux_only))
            return ERRORS[k].words;
    return "";
}

/* Faster no shaft is turned by what the winding drops at its rated current; less no short circuit carries. */
#define MOST_rpm 1e5
#define LEAST_A  0.1

static void remark_on_winding(const hci_sheet *s, hci_note *remark)
{
    const double rpm = hci_sheet_resistance_ohm(s) * hci_sheet_current_A(s) / emf(s) / RPM;
    const double short_A = emf(s) / s->pole_pairs / s->inductance_d_H;
    if (isfinite(rpm) && rpm > MOST_rpm)
        hci_note_set(
            remark, HCI_OK,
            "the voltage that the resistance takes at the rated current would turn this motor at %.2g "
            "rpm: are Kv, resistance and current in rpm/V, ohm and A, and of this motor?",
            rpm);
    else if (s->inductance_d_H > 0.0 && short_A < LEAST_A)
        hci_note_set(remark, HCI_OK,
                     "with an inductance of %.3g H a short circuit of this motor would carry %.2g A at any "
                     "speed: is it %.3g mH, which are %.3g H?",
                     s->inductance_d_H, short_A, s->inductance_d_H, 1e-3 * s->inductance_d_H);
}

void hci_sheet_remark(const hci_sheet *s, hci_note *remark)
{
    const double torque_Nm = 1.5 * emf(s) * hci_sheet_current_A(s);
    const double line_V = SQRT3 * emf(s) * s->rated_speed_rpm * RPM, ratio = s->rated_torque_Nm / torque_Nm;
    *remark = (hci_note){{0}};
    if (isfinite(ratio) && (ratio < LEAST_RATIO || ratio > MOST_RATIO))
        hci_note_set(remark, HCI_OK,
                     "rated torque %.4g N·m, but rated current and magnets make %.4g N·m: %.3g times%s",
                     s->rated_torque_Nm, torque_Nm, ratio,
                     convention_error_of(ratio, s->reading == HCI_SHEET_FLUX));
    else if (line_V > s->dc_link_voltage_V)
        hci_note_set(
            remark, HCI_OK,
            "at rated speed the back-EMF is %.4g V line-to-line peak, above the dc link of %.4g V: check "
            "how the sheet's constant is meant, or expect field weakening",
            line_V, s->dc_link_voltage_V);
    else
        remark_on_winding(s, remark);
}
