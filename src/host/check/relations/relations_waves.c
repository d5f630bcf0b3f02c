/* What must hold for currents, voltages and speed of the recordings. */
#include <math.h>

#include "host/check/relations/relations.h"

#define SQRT3 1.7320508075688772

/* ---- order and sequence */

/* Of the recording that has most of it. */
static check_value order_against_angle(const check_data *data, const check_interpretation *as,
                                       const check_model *m, bool of_current)
{
    const check_run *best = NULL;
    double most = 0.0;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        const double square = of_current ? r->current_square : r->voltage_square;
        if (!isfinite(of_current ? r->current_order : r->voltage_order) || !(square > most)) continue;
        if (of_current && !hci_check_has_current(data, r)) continue;
        most = square;
        best = r;
    }
    if (!best) return HCI_CHECK_NONE;
    const double order =
        (of_current ? best->current_order : best->voltage_order) / hci_check_scale_of(best, as, m);
    const bool swapped = of_current ? hci_check_currents_swapped(as) : hci_check_voltages_swapped(as);
    return hci_check_found(swapped ? -order : order);
}

static check_value current_order(const check_data *data, const check_interpretation *as, const check_model *m)
{
    return order_against_angle(data, as, m, true);
}

static check_value voltage_order(const check_data *data, const check_interpretation *as, const check_model *m)
{
    return order_against_angle(data, as, m, false);
}

/* ---- speed */

static check_value angle_speed(const check_data *data, const check_interpretation *as, const check_model *m)
{
    check_fit x = {0};
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (isfinite(r->speed_over_time) && fabs(r->speed) > 0.0)
            hci_check_fit_add(&x, hci_check_angle_speed_of(r, as, m), hci_check_speed_over_time_of(r, as, m),
                              0.0);
    }
    return hci_check_fit_value(&x);
}

static check_value angle_ratio(const check_data *data, const check_interpretation *as, const check_model *m)
{
    (void)as;
    for (size_t k = 0; k < data->runs; ++k)
        if (isfinite(data->run[k].angle_ratio))
            return hci_check_found(data->run[k].angle_ratio / m->pole_pairs);
    return HCI_CHECK_NONE;
}

static check_value frequency_speed(const check_data *data, const check_interpretation *as,
                                   const check_model *m)
{
    check_fit x = {0};
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (r->theta || !r->has_speed || !isfinite(r->frequency)) continue;
        hci_check_fit_add(&x, fabs(r->frequency / as->time),
                          fabs(m->pole_pairs * hci_check_column_speed_of(r, as, m)), 0.0);
    }
    return hci_check_fit_value(&x);
}

/* ---- back-EMF */

/* jω(L_d i_d + jL_q i_q); without inductances 0. */
static check_vector reactive_drop(const check_voltage_terms *x, const check_model *m)
{
    const check_vector flux = {hci_check_or_zero(m->inductance_d_H) * x->speed_current.re,
                               hci_check_or_zero(m->inductance_q_H) * x->speed_current.im};
    return hci_check_turned(hci_check_scaled(flux, m->pole_pairs), 0.5 * HCI_PI);
}

static check_vector drop_of(const check_data *data, const check_run *r, const check_voltage_terms *x,
                            const check_model *m)
{
    const check_vector none = {0.0, 0.0};
    if (!hci_check_has_drop(data, r)) return none;
    return hci_check_sum(hci_check_scaled(x->current, m->resistance_ohm), reactive_drop(x, m));
}

static double voltage_unknown(const check_run *r, const check_voltage_terms *x)
{
    return r->has_dq_voltage ? CHECK_COMMAND_UNKNOWN * hci_check_length(x->voltage) : 0.0;
}

/* Leads, switches and, where the voltage is what a drive has asked for, its dead time: all of them along the
 * current, and together easily as much as the copper. */
static double along_current_unknown(const check_run *r, const check_voltage_terms *x, const check_model *m)
{
    const double drop = hci_check_or_zero(m->resistance_ohm) * hci_check_length(x->current);
    return r->has_dq_voltage ? CHECK_SWITCHES_UNKNOWN * drop : CHECK_DROP_UNKNOWN * drop;
}

void hci_check_emf_of(const check_data *data, const check_run *r, const check_interpretation *as,
                      const check_model *m, check_emf *emf)
{
    const check_voltage_terms terms = hci_check_voltage_terms_of(r, as, m);
    const check_vector drop = drop_of(data, r, &terms, m);
    emf->expected = hci_check_emf_expected(terms.speed, m);
    emf->found = hci_check_sum(terms.voltage, hci_check_scaled(drop, -1.0));
    emf->unknown = hypot(CHECK_DROP_UNKNOWN * hci_check_length(drop),
                         hypot(along_current_unknown(r, &terms, m), voltage_unknown(r, &terms))) /
                   hci_check_length(emf->expected);
}

/* Leads, iron and dead times turn a voltage beside a current. */
static double angle_unknown(const check_data *data, const check_run *r, const check_emf *emf)
{
    const bool is_open = !r->has_dq_voltage && !hci_check_has_drop(data, r);
    return is_open ? emf->unknown : hypot(emf->unknown, CHECK_LOADED_ANGLE_UNKNOWN);
}

/* Σ E Ê* / Σ |Ê|² over the recordings, with E = v − R i − jω(L_d i_d + jL_q i_q). */
static check_value emf_fit(const check_data *data, const check_interpretation *as, const check_model *m,
                           bool of_angle)
{
    const double tolerance = of_angle ? CHECK_EMF_ANGLE_TOLERANCE : CHECK_EMF_TOLERANCE;
    check_fit re = {0}, im = {0};
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        check_emf emf;
        if (!hci_check_has_emf(data, r, m)) continue;
        hci_check_emf_of(data, r, as, m, &emf);
        const double length = hci_check_length(emf.expected),
                     unknown = (of_angle ? angle_unknown(data, r, &emf) : emf.unknown) / tolerance;
        const check_vector cross = hci_check_product(emf.found, hci_check_conjugate(emf.expected));
        hci_check_fit_add(&re, cross.re / length, length, unknown);
        hci_check_fit_add(&im, cross.im / length, length, unknown);
    }
    check_value x = hci_check_fit_value(&re);
    const double y = hci_check_fit_value(&im).found;
    if (!isnan(x.found)) x.found = of_angle ? atan2(y, x.found) : hypot(x.found, y);
    return x;
}

static check_value emf_size(const check_data *data, const check_interpretation *as, const check_model *m)
{
    return emf_fit(data, as, m, false);
}

static check_value emf_angle(const check_data *data, const check_interpretation *as, const check_model *m)
{
    return emf_fit(data, as, m, true);
}

/* The part of v − Ê − jω(L_d i_d + jL_q i_q) along the current, over R i. Inductances that are not known
 * have a drop that is mostly across the current. */
static check_value resistance_size(const check_data *data, const check_interpretation *as,
                                   const check_model *m)
{
    check_fit x = {0};
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (!hci_check_has_turning_voltage(r) || !hci_check_has_vector_current(data, r) ||
            isnan(m->resistance_ohm))
            continue;
        const check_voltage_terms terms = hci_check_voltage_terms_of(r, as, m);
        const check_vector i = terms.current, e = hci_check_emf_expected(terms.speed, m),
                           l = reactive_drop(&terms, m);
        const check_vector rest = hci_check_sum(terms.voltage, hci_check_scaled(hci_check_sum(e, l), -1.0));
        const double length = hci_check_length(i), drop = m->resistance_ohm * length;
        const double inductance = isnan(m->inductance_q_H) ? CHECK_SALIENCY_UNKNOWN * hci_check_length(e)
                                                           : CHECK_DROP_UNKNOWN * hci_check_length(l);
        const double unknown =
            hypot(CHECK_EMF_TOLERANCE * hci_check_length(e) + inductance, voltage_unknown(r, &terms));
        hci_check_fit_add(&x, hci_check_product(rest, hci_check_conjugate(i)).re / length, drop,
                          unknown / drop / CHECK_RESISTANCE_TOLERANCE);
    }
    return hci_check_fit_value(&x);
}

/* Without an angle: |v|/ω_e = k_e/p. */
static check_value emf_per_frequency(const check_data *data, const check_interpretation *as,
                                     const check_model *m)
{
    check_fit x = {0};
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (r->theta || !isfinite(r->frequency) || hci_check_has_current(data, r) ||
            hci_check_is_unbalanced(r->voltage_balance))
            continue;
        const double line = as->voltage_is_line > 0.0 ? SQRT3 : 1.0;
        hci_check_fit_add(&x, sqrt(r->voltage_square) / line,
                          fabs(r->frequency / as->time) * m->emf_Nm_per_A / m->pole_pairs, 0.0);
    }
    return hci_check_fit_value(&x);
}

/* ---- the list */

static const check_relation LIST[] = {
    {"current_order", "order and sequence of the currents against the angle", CHECK_RATIO, 1.0, 0.01, 12.0,
     current_order, "a recording of phase currents that turn with the angle", ""},
    {"voltage_order", "order and sequence of the voltages against the angle", CHECK_RATIO, 1.0, 0.01, 12.0,
     voltage_order, "a recording of phase voltages with the angle", ""},
    {"angle_ratio", "theta_e over pole pairs x theta_m", CHECK_RATIO, 1.0, 0.02, 9.0, angle_ratio,
     "a recording of both angles", ""},
    {"angle_speed", "change of the angle over time against the speed", CHECK_RATIO, 1.0, 0.05, 9.0,
     angle_speed, "a recording of time, angle and speed", ""},
    {"frequency_speed", "frequency of the voltages over pole pairs x speed", CHECK_RATIO, 1.0, 0.03, 9.0,
     frequency_speed, "a recording of time, voltages and speed (where there is no angle)", "angle_speed"},
    {"emf_size", "back-EMF in the recordings over that of the table", CHECK_FLUX, 1.0, CHECK_EMF_TOLERANCE,
     9.0, emf_size,
     "a recording of voltages, angle and speed without current, or with it and resistance and "
     "inductances",
     ""},
    {"emf_angle", "phase of the back-EMF in the recordings against the table, rad", CHECK_ANGLE, 0.0,
     CHECK_EMF_ANGLE_TOLERANCE, 9.0, emf_angle,
     "a recording of voltages, angle and speed without current, or with it and resistance and "
     "inductances",
     ""},
    {"resistance_size", "voltage along the current, less the back-EMF, over R i", CHECK_HIGH, 1.0,
     CHECK_RESISTANCE_TOLERANCE, 7.0, resistance_size,
     "resistance, inductances, and a recording of voltages, currents and angle at low speed", ""},
    {"emf_per_frequency", "voltage over its frequency against k_e/p", CHECK_FLUX, 1.0, 0.06, 9.0,
     emf_per_frequency, "a recording of time and voltages without current (where there is no angle)",
     "emf_size"},
};
const check_relation_list HCI_CHECK_WAVE_RELATIONS = {LIST, sizeof LIST / sizeof *LIST};
