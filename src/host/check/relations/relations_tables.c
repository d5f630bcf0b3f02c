/* What must hold between the tables of a machine, and with its ratings. */
#include <math.h>

#include "hci/host/machine/init.h"
#include "host/check/relations/relations.h"

#define SQRT3 1.7320508075688772

/* ---- tables */

static check_value emf_order(const check_data *data, const check_interpretation *as, const check_model *m)
{
    const double order = data->emf.order[data->emf.largest];
    return hci_check_found(as->emf_mechanical > 0.0 ? order / m->pole_pairs : order);
}

static check_value emf_phase(const check_data *data, const check_interpretation *as, const check_model *m)
{
    (void)data, (void)as;
    return hci_check_found(m->emf_phase_rad);
}

static check_value emf_phase_range(const check_data *data, const check_interpretation *as,
                                   const check_model *m)
{
    (void)m;
    return hci_check_found(data->emf.most_phase_rad * as->phase_unit * as->emf_phase_unit);
}

static check_value cogging_phase_range(const check_data *data, const check_interpretation *as,
                                       const check_model *m)
{
    (void)m;
    return data->cogging.count > 0
               ? hci_check_found(data->cogging.most_phase_rad * as->phase_unit * as->cogging_phase_unit)
               : HCI_CHECK_NONE;
}

/* lcm(slots, 2p)/p is a multiple of 6 for every balanced three-phase winding. */
static check_value cogging_sixes(const check_data *data, const check_interpretation *as, const check_model *m)
{
    double sixes = 0.0, all = 0.0;
    for (size_t k = 0; k < data->cogging.count; ++k) {
        const double order = hci_check_cogging_order(data, as, m, k),
                     square = data->cogging.amplitude[k] * data->cogging.amplitude[k];
        if (fabs(remainder(order, 6.0)) < 1e-3) sixes += square;
        all += square;
    }
    return hci_check_ratio_of(sixes, all);
}

/* Slots per pole of the smallest stator whose cogging begins at this order; 100 where there is none. */
static double slots_per_pole(double order, int pole_pairs)
{
    if (fabs(remainder(order, 1.0)) > 1e-3) return 100.0;
    for (int slots = 3; slots <= 200 * pole_pairs; slots += 3)
        if (fabs(hci_cogging_order(slots, pole_pairs) - order) < 1e-3) return slots / (2.0 * pole_pairs);
    return 100.0;
}

static check_value cogging_slots(const check_data *data, const check_interpretation *as, const check_model *m)
{
    double least = HUGE_VAL;
    if (data->value[CHECK_slots] >= 3.0) return HCI_CHECK_NONE;
    for (size_t k = 0; k < data->cogging.count; ++k)
        if (hci_check_is_significant(&data->cogging, k))
            least = fmin(least, slots_per_pole(hci_check_cogging_order(data, as, m, k), (int)m->pole_pairs));
    return least < HUGE_VAL ? hci_check_found(least) : HCI_CHECK_NONE;
}

/* Uneven magnets and teeth add orders to it, but do not take it away. */
static check_value cogging_first(const check_data *data, const check_interpretation *as, const check_model *m)
{
    double nearest = NAN;
    if (!(data->value[CHECK_slots] >= 3.0)) return HCI_CHECK_NONE;
    const double first = hci_cogging_order((int)data->value[CHECK_slots], (int)m->pole_pairs);
    for (size_t k = 0; k < data->cogging.count; ++k) {
        const double x = hci_check_cogging_order(data, as, m, k) / first;
        if (hci_check_is_significant(&data->cogging, k) && !(fabs(log(x)) > fabs(log(nearest)))) nearest = x;
    }
    return hci_check_found(nearest);
}

static check_value inductance_difference(const check_data *data, const check_interpretation *as,
                                         const check_model *m)
{
    const double d = data->value[CHECK_inductance_d_H], q = data->value[CHECK_inductance_q_H];
    (void)as;
    if (!data->inductance.given || !(fabs(d - q) > 0.1 * d)) return HCI_CHECK_NONE;
    return hci_check_found(m->reluctance_Nm_per_A2 / (1.5 * m->pole_pairs * (d - q)));
}

/* ---- ratings */

/* 3/2 k_e I, or what i_d adds at the best angle: max over β of A cos β + ½K I² sin 2β. */
static double most_torque_Nm(const check_model *m, double mutual_Nm)
{
    const double k = m->reluctance_Nm_per_A2 * m->rated_current_A * m->rated_current_A;
    double most = mutual_Nm;
    for (int j = -45; j <= 45 && isfinite(k); ++j) {
        const double b = HCI_PI * j / 180.0;
        most = fmax(most, mutual_Nm * cos(b) + 0.5 * k * sin(2.0 * b));
    }
    return most;
}

static check_value rated_torque(const check_data *data, const check_interpretation *as, const check_model *m)
{
    const double rated_Nm = data->value[CHECK_rated_torque_Nm],
                 mutual_Nm = 1.5 * m->emf_Nm_per_A * m->rated_current_A;
    const double most_Nm = most_torque_Nm(m, mutual_Nm);
    (void)as;
    if (!(rated_Nm > 0.0) || !(mutual_Nm > 0.0)) return HCI_CHECK_NONE;
    return hci_check_found(rated_Nm < mutual_Nm ? rated_Nm / mutual_Nm
                           : rated_Nm > most_Nm ? rated_Nm / most_Nm
                                                : 1.0);
}

/* At rated speed the back-EMF alone, line to line, is below the dc link. */
static check_value rated_voltage(const check_data *data, const check_interpretation *as, const check_model *m)
{
    const double speed = data->value[CHECK_rated_speed_rad_per_s];
    (void)as;
    return speed > 0.0
               ? hci_check_ratio_of(SQRT3 * m->emf_Nm_per_A * speed, data->value[CHECK_dc_link_voltage_V])
               : HCI_CHECK_NONE;
}

/* From a watch motor to a wind generator: ψ = k_e/p within a factor of 300 around 30 mWb. */
static check_value flux_size(const check_data *data, const check_interpretation *as, const check_model *m)
{
    (void)data, (void)as;
    return hci_check_found(exp(fabs(log(m->emf_Nm_per_A / m->pole_pairs / 0.03))));
}

/* The current that would cancel the magnets, ψ/L_d, over the rated one: within a factor of 30 around 5. */
static check_value flux_per_current(const check_data *data, const check_interpretation *as,
                                    const check_model *m)
{
    const double l = m->inductance_d_H, i = m->rated_current_A;
    (void)data, (void)as;
    return l > 0.0 && i > 0.0 ? hci_check_found(exp(fabs(log(m->emf_Nm_per_A / m->pole_pairs / l / i / 5.0))))
                              : HCI_CHECK_NONE;
}

/* ---- the list */

static const check_relation LIST[] = {
    {"emf_order", "order of the largest back-EMF in the table", CHECK_RATIO, 1.0, 0.01, 12.0, emf_order, "",
     ""},
    {"emf_phase", "phase of the back-EMF's fundamental, rad", CHECK_ANGLE, 0.0, 0.1, 8.0, emf_phase, "", ""},
    {"emf_phase_range", "largest phase in back_emf.csv, rad", CHECK_MOST, 2.0 * HCI_PI, 0.05, 9.0,
     emf_phase_range, "", ""},
    {"cogging_phase_range", "largest phase in cogging.csv, rad", CHECK_MOST, 2.0 * HCI_PI, 0.05, 9.0,
     cogging_phase_range, "cogging.csv", ""},
    {"cogging_sixes", "share of the cogging torque at multiples of order 6", CHECK_SHARE, 1.0, 0.4, 4.0,
     cogging_sixes, "cogging.csv with amplitudes", ""},
    {"cogging_first", "cogging order nearest to lcm(slots, 2p)/p, over it", CHECK_RATIO, 1.0, 0.2, 5.0,
     cogging_first, "cogging.csv with amplitudes, and `slots` in machine.csv", ""},
    {"cogging_slots", "slots per pole that the cogging orders ask for", CHECK_MOST, 12.0, 0.3, 5.0,
     cogging_slots, "cogging.csv with amplitudes", "cogging_first"},
    {"inductance_difference", "L_d - L_q of inductance.csv over that of machine.csv", CHECK_RATIO, 1.0, 0.2,
     6.5, inductance_difference,
     "inductance.csv, and inductance_d and inductance_q that differ in machine.csv", ""},
    {"rated_torque", "rated torque over what the rated current makes", CHECK_LOW, 1.0, 0.08, 6.5,
     rated_torque, "rated_torque and rated_current in machine.csv", ""},
    {"rated_voltage", "line-to-line back-EMF at rated speed over the dc link", CHECK_MOST, 1.0, 0.15, 5.0,
     rated_voltage, "rated_speed and dc_link_voltage in machine.csv", ""},
    {"flux_size", "factor between the flux linkage k_e/p and 30 mWb, which is usual", CHECK_MOST, 300.0, 0.5,
     4.0, flux_size, "", ""},
    {"flux_per_current",
     "factor between 5, which is usual, and flux linkage over inductance times rated current", CHECK_MOST,
     30.0, 0.5, 4.0, flux_per_current, "inductance_d, inductance_q and rated_current in machine.csv", ""},
};
const check_relation_list HCI_CHECK_TABLE_RELATIONS = {LIST, sizeof LIST / sizeof *LIST};
