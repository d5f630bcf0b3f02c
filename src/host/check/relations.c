/* What must hold between the figures, whatever the machine: one row a relation. */
#include "host/check/relations.h"

#include <math.h>
#include <stddef.h>

/* Amplitudes below this share of the largest say nothing of where a table has its orders. */
#define SIGNIFICANT 0.05

/* ---- what they share */

const check_value HCI_CHECK_NONE = {NAN, 1.0};

check_value hci_check_found(double found)
{
    return (check_value){found, 1.0};
}

check_value hci_check_ratio_of(double top, double bottom)
{
    return bottom > 0.0 ? hci_check_found(top / bottom) : HCI_CHECK_NONE;
}

double hci_check_or_zero(double x)
{
    return isnan(x) ? 0.0 : x;
}

/* unknown: what may be missing in `bottom`, in the measure of its usual tolerance: such a recording counts
 * less. */
void hci_check_fit_add(check_fit *x, double top, double bottom, double unknown)
{
    const double weight = bottom * bottom / (1.0 + unknown * unknown);
    if (!(weight > 0.0)) {
        x->other += top * top;
        return;
    }
    x->cross += weight * top / bottom;
    x->square += weight;
    x->unknown += weight * weight * unknown * unknown;
}

/* The usual tolerance is common to all recordings; what is unknown in each is its own. */
check_value hci_check_fit_value(const check_fit *x)
{
    if (!(x->square > 0.0)) return x->other > 0.0 ? hci_check_found(0.0) : HCI_CHECK_NONE;
    return (check_value){x->cross / x->square, sqrt(1.0 + x->unknown / (x->square * x->square))};
}

double hci_check_cogging_order(const check_figures *f, const check_view *v, const check_model *m, size_t k)
{
    return v->cogging_mechanical > 0.0 ? f->cogging.order[k] / m->pole_pairs : f->cogging.order[k];
}

bool hci_check_is_significant(const check_table *t, size_t k)
{
    return fabs(t->amplitude[k]) > SIGNIFICANT * fabs(t->amplitude[t->largest]);
}

/* ---- the list */

/* Tolerances are one standard deviation: of a bench 5 % (magnets 25 K warmer or colder 3 %, sensors 2 %, iron
 * 3 %), of power with what the iron takes 8 %, of a sheet's torque 8 % above what the current makes and twice
 * that below, of warm copper 20 % above and 10 % below, of counting 1 %. Caps: counting is as good as
 * certain; a measured ratio may be odd once in e⁹; ratings are written by people, once in e^6.5; plausible
 * sizes decide little. */
/* Rows as calls: aligned columns would be wider than any screen. */
#define ROW(...)                                                                                             \
    {                                                                                                        \
        __VA_ARGS__                                                                                          \
    }

const check_relation HCI_CHECK_RELATIONS[] = {
    ROW("emf_order", "order of the largest back-EMF in the table", CHECK_RATIO, 1.0, 0.01, 12.0,
        hci_check_of_emf_order, "", ""),
    ROW("emf_phase", "phase of the back-EMF's fundamental, rad", CHECK_ANGLE, 0.0, 0.1, 8.0,
        hci_check_of_emf_phase, "", ""),
    ROW("emf_phase_range", "largest phase in back_emf.csv, rad", CHECK_MOST, 2.0 * HCI_PI, 0.05, 9.0,
        hci_check_of_emf_phase_range, "", ""),
    ROW("cogging_phase_range", "largest phase in cogging.csv, rad", CHECK_MOST, 2.0 * HCI_PI, 0.05, 9.0,
        hci_check_of_cogging_phase_range, "cogging.csv", ""),
    ROW("cogging_sixes", "share of the cogging torque at multiples of order 6", CHECK_SHARE, 1.0, 0.4, 4.0,
        hci_check_of_cogging_sixes, "cogging.csv with amplitudes", ""),
    ROW("cogging_first", "cogging order nearest to lcm(slots, 2p)/p, over it", CHECK_RATIO, 1.0, 0.2, 5.0,
        hci_check_of_cogging_first, "cogging.csv with amplitudes, and `slots` in machine.csv", ""),
    ROW("cogging_slots", "slots per pole that the cogging orders ask for", CHECK_MOST, 12.0, 0.3, 5.0,
        hci_check_of_cogging_slots, "cogging.csv with amplitudes", "cogging_first"),
    ROW("inductance_difference", "L_d - L_q of inductance.csv over that of machine.csv", CHECK_RATIO, 1.0,
        0.2, 6.5, hci_check_of_inductance_difference,
        "inductance.csv, and inductance_d and inductance_q that differ in machine.csv", ""),
    ROW("rated_torque", "rated torque over what the rated current makes", CHECK_LOW, 1.0, 0.08, 6.5,
        hci_check_of_rated_torque, "rated_torque and rated_current in machine.csv", ""),
    ROW("rated_voltage", "line-to-line back-EMF at rated speed over the dc link", CHECK_MOST, 1.0, 0.15, 5.0,
        hci_check_of_rated_voltage, "rated_speed and dc_link_voltage in machine.csv", ""),
    ROW("flux_size", "flux linkage k_e/p: times away from 30 mWb", CHECK_MOST, 300.0, 0.5, 4.0,
        hci_check_of_flux_size, "", ""),
    ROW("flux_per_current", "flux linkage over inductance and rated current: times away from 5", CHECK_MOST,
        30.0, 0.5, 4.0, hci_check_of_flux_per_current,
        "inductance_d, inductance_q and rated_current in machine.csv", ""),
    ROW("current_order", "order and sequence of the currents against the angle", CHECK_RATIO, 1.0, 0.01, 12.0,
        hci_check_of_current_order, "a recording of phase currents that turn with the angle", ""),
    ROW("voltage_order", "order and sequence of the voltages against the angle", CHECK_RATIO, 1.0, 0.01, 12.0,
        hci_check_of_voltage_order, "a recording of phase voltages with the angle", ""),
    ROW("angle_ratio", "theta_e over pole pairs x theta_m", CHECK_RATIO, 1.0, 0.02, 9.0,
        hci_check_of_angle_ratio, "a recording of both angles", ""),
    ROW("angle_speed", "change of the angle over time against the speed", CHECK_RATIO, 1.0, 0.05, 9.0,
        hci_check_of_angle_speed, "a recording of time, angle and speed", ""),
    ROW("frequency_speed", "frequency of the voltages over pole pairs x speed", CHECK_RATIO, 1.0, 0.03, 9.0,
        hci_check_of_frequency_speed, "a recording of time, voltages and speed (where there is no angle)",
        "angle_speed"),
    ROW("emf_size", "back-EMF in the recordings over that of the table", CHECK_RATIO, 1.0,
        PERCENT(EMF_TOLERANCE_PERCENT), 9.0, hci_check_of_emf_size,
        "a recording of voltages, angle and speed without current, or with it and resistance and "
        "inductances",
        ""),
    ROW("emf_angle", "phase of the back-EMF in the recordings against the table, rad", CHECK_ANGLE, 0.0,
        PERCENT(EMF_ANGLE_TOLERANCE_PERCENT), 9.0, hci_check_of_emf_angle,
        "a recording of voltages, angle and speed without current, or with it and resistance and "
        "inductances",
        ""),
    ROW("resistance_size", "voltage along the current, less the back-EMF, over R i", CHECK_HIGH, 1.0,
        PERCENT(RESISTANCE_TOLERANCE_PERCENT), 7.0, hci_check_of_resistance_size,
        "resistance, inductances, and a recording of voltages, currents and angle at low speed", ""),
    ROW("emf_per_frequency", "voltage over its frequency against k_e/p", CHECK_RATIO, 1.0, 0.06, 9.0,
        hci_check_of_emf_per_frequency,
        "a recording of time and voltages without current (where there is no angle)", "emf_size"),
    ROW("power_balance", "torque x speed and copper loss over v.i", CHECK_RATIO, 1.0,
        PERCENT(POWER_TOLERANCE_PERCENT), 9.0, hci_check_of_power_balance,
        "a recording of voltages, currents, torque and speed", ""),
    ROW("torque_size", "torque over 3/2 k_e i_q and the reluctance torque", CHECK_RATIO, 1.0,
        PERCENT(TORQUE_TOLERANCE_PERCENT), 9.0, hci_check_of_torque_size,
        "a recording of currents, angle and torque", ""),
    ROW("cogging_share", "share of the ripple without current at the orders of cogging.csv", CHECK_SHARE, 1.0,
        0.3, 8.0, hci_check_of_cogging_share,
        "cogging.csv, and a recording of torque and angle without current", ""),
    ROW("cogging_size", "ripple without current over cogging.csv, at its largest order", CHECK_RATIO, 1.0,
        0.3, 7.0, hci_check_of_cogging_size,
        "cogging.csv, and a recording of torque and angle without current", ""),
    ROW("cogging_angle", "phase of the ripple without current against cogging.csv, rad", CHECK_ANGLE, 0.0,
        PERCENT(COGGING_ANGLE_TOLERANCE_PERCENT), 4.0, hci_check_of_cogging_angle,
        "cogging.csv, and a recording of torque and angle without current", ""),
    ROW("current_sum", "ia + ib + ic over the currents (rms)", CHECK_SHARE, 0.0, 0.05, 3.0,
        hci_check_of_current_sum, "a recording of three phase currents", ""),
    ROW("current_balance", "largest over smallest phase current", CHECK_MOST, 1.1, 0.1, 3.0,
        hci_check_of_current_balance, "a recording of three phase currents", ""),
    ROW("voltage_balance", "largest over smallest phase voltage", CHECK_MOST, 1.1, 0.1, 3.0,
        hci_check_of_voltage_balance, "a recording of three phase voltages", ""),
};
const size_t HCI_CHECK_RELATION_COUNT = sizeof HCI_CHECK_RELATIONS / sizeof *HCI_CHECK_RELATIONS;

/* An array of −1 elements where a check has no room for all of them. */
typedef char room_for_all[sizeof HCI_CHECK_RELATIONS / sizeof *HCI_CHECK_RELATIONS <= HCI_CHECK_MOST_EVIDENCE
                              ? 1
                              : -1];

/* Of a ratio: the tolerance is relative, by the logarithm; what is unknown adds to the denominator, and so
 * deviates by found − 1. The variances of both add. */
static double ratio_deviation(const check_relation *r, double found, double spread)
{
    const double unknown = r->tolerance * sqrt(fmax(0.0, spread * spread - 1.0));
    double distance = found > 0.0 ? fabs(log(found)) : HUGE_VAL;
    if (found < 1.0 && r->kind == CHECK_LOW) distance /= 1.5;
    if (found < 1.0 && r->kind == CHECK_HIGH) distance *= 2.0;
    const double known = distance / r->tolerance, beside = fabs(found - 1.0) / unknown;
    if (!(unknown > 0.0) || !(known > 0.0)) return known;
    return isinf(known) ? beside : known * beside / hypot(known, beside);
}

double hci_check_deviation(const check_relation *r, check_value x)
{
    const double relative = x.found / (r->expected > 0.0 ? r->expected : 1.0),
                 tolerance = r->tolerance * x.spread;
    if (isnan(x.found)) return HUGE_VAL;
    switch (r->kind) {
    case CHECK_ANGLE:
        return fabs(remainder(x.found - r->expected, 2.0 * HCI_PI)) / tolerance;
    case CHECK_SHARE:
        return fabs(x.found - r->expected) / tolerance;
    case CHECK_MOST:
        return relative > 1.0 ? log(relative) / tolerance : 0.0;
    default:
        return ratio_deviation(r, relative, x.spread);
    }
}

/* A Gaussian of the deviation on a floor: −ln(e^{−z²/2}/spread + e^{−cap}). */
double hci_check_loss(const check_relation *r, check_value x)
{
    const double z = hci_check_deviation(r, x);
    return -log(exp(-0.5 * z * z) / x.spread + exp(-r->cap));
}
