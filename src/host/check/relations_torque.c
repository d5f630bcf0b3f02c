/* What must hold for the torque of the recordings, with current and without. */
#include <math.h>

#include "host/check/relations.h"

#define SQRT3 1.7320508075688772

/* ---- power and torque */

/* Coulomb and viscous friction, where machine.csv has them. */
static double friction_Nm(const check_data *data, double speed)
{
    return hci_check_or_zero(data->value[CHECK_coulomb_friction_Nm]) +
           hci_check_or_zero(data->value[CHECK_viscous_friction_Nms_per_rad]) *
               fabs(hci_check_or_zero(speed));
}

/* Of v_q alone it is whole where no i_d flows. */
static bool knows_power(const check_run *r)
{
    if (r->has_dq_voltage) return r->has_dq && (!r->lacks_d_voltage || r->lacks_d_current);
    return r->has_voltage && !hci_check_is_unbalanced(r->voltage_balance) && (r->has_abc || r->theta);
}

static bool has_power(const check_data *data, const check_run *r)
{
    return knows_power(r) && r->has_torque && hci_check_has_speed(r) && hci_check_has_vector_current(data, r);
}

static double shaft_power_W(const check_run *r, const check_interpretation *as, const check_model *m)
{
    return r->torque_at_speed * as->torque * hci_check_speed_of(r, as, m);
}

/* 3/2 i² */
static double square_A2(const check_run *r, const check_interpretation *as)
{
    const double dq = r->has_dq ? as->dq : 1.0;
    return 1.5 * r->current_square * as->current * as->current * dq * dq;
}

/* A resistance that is not given is what the recordings miss in their power, each as much as it has: least
 * squares of 3/2 R i² = v·i − T ω, relative to v·i. It is neither negative nor above the largest |v|/|i|.
 */
static double resistance_of(const check_data *data, const check_interpretation *as, const check_model *m)
{
    const double line = as->voltage_is_line > 0.0 ? SQRT3 : 1.0;
    double cross = 0.0, square = 0.0, most = 0.0;
    if (!isnan(m->resistance_ohm)) return m->resistance_ohm;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (!has_power(data, r)) continue;
        const double power = hci_check_power_of(r, as, m), share = square_A2(r, as) / power;
        cross += share * (power - shaft_power_W(r, as, m)) / power;
        square += share * share;
        most = fmax(most, sqrt(r->voltage_square / r->current_square) / line / fabs(as->current));
    }
    return square > 0.0 && isfinite(square) ? fmin(most, fmax(0.0, cross / square)) : 0.0;
}

/* T ω_m + 3/2 R i² over v·i */
static check_value power_balance(const check_data *data, const check_interpretation *as, const check_model *m)
{
    const double resistance_ohm = resistance_of(data, as, m);
    check_fit x = {0};
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (!has_power(data, r)) continue;
        const double power = hci_check_power_of(r, as, m), copper = resistance_ohm * square_A2(r, as);
        const double speed = hci_check_speed_of(r, as, m), friction = friction_Nm(data, speed) * fabs(speed);
        const double command = r->has_dq_voltage ? CHECK_COMMAND_UNKNOWN * fabs(power) : 0.0;
        hci_check_fit_add(&x, shaft_power_W(r, as, m) + copper, power,
                          hypot(CHECK_DROP_UNKNOWN * copper + friction, command) / fabs(power) /
                              CHECK_POWER_TOLERANCE);
    }
    return hci_check_fit_value(&x);
}

/* 3/2 Re(e* i) + K i_d i_q. Where K is not known, a third of i_d may count as i_q; where it is, K to a third.
 */
static void torque_add(check_fit *x, const check_data *data, const check_run *r,
                       const check_interpretation *as, const check_model *m)
{
    const bool known = !isnan(m->reluctance_Nm_per_A2);
    const check_vector i = hci_check_current_of(r, as, m), e = hci_check_emf_expected(1.0, m);
    const double mutual = 1.5 * hci_check_product(i, hci_check_conjugate(e)).re;
    const double reluctance = known ? m->reluctance_Nm_per_A2 * i.re * i.im : 0.0;
    const double unknown = known ? CHECK_DROP_UNKNOWN * fabs(reluctance)
                                 : CHECK_SALIENCY_UNKNOWN * 1.5 * m->emf_Nm_per_A * fabs(i.re);
    const double model = mutual + reluctance;
    hci_check_fit_add(x, r->torque_mean * as->torque, model,
                      (unknown + friction_Nm(data, hci_check_speed_of(r, as, m))) / fabs(model) /
                          CHECK_TORQUE_TOLERANCE);
}

static check_value torque_size(const check_data *data, const check_interpretation *as, const check_model *m)
{
    check_fit x = {0};
    for (size_t k = 0; k < data->runs; ++k)
        if (data->run[k].has_torque && hci_check_has_vector_current(data, &data->run[k]))
            torque_add(&x, data, &data->run[k], as, m);
    return hci_check_fit_value(&x);
}

/* ---- torque without current */

/* Nothing but the cogging torque: without current, or balanced by it while the shaft was held. */
static check_run *unloaded_torque(const check_data *data)
{
    check_run *best = NULL;
    for (size_t k = 0; k < data->runs; ++k) {
        check_run *r = &data->run[k];
        const bool unloaded = r->is_held || (r->has_torque && !hci_check_has_current(data, r));
        if (!unloaded || !r->theta || !(r->torque_variance > 0.0)) continue;
        if (!best || r->count > best->count) best = r;
    }
    return best;
}

/* N·m per what the ripple is in. */
static double torque_unit(const check_run *r, const check_interpretation *as, const check_model *m)
{
    return r->is_held ? 1.5 * m->emf_Nm_per_A * as->current : as->torque;
}

static bool has_cogging(const check_data *data)
{
    return data->cogging.count > 0 && fabs(data->cogging.amplitude[data->cogging.largest]) > 0.0;
}

/* The share of the ripple that is at the orders of the table, whatever its amplitudes; of a noisy reading the
 * share of what the table declares. */
static check_value cogging_share(const check_data *data, const check_interpretation *as, const check_model *m)
{
    check_run *r = unloaded_torque(data);
    double sum = 0.0, declared = 0.0;
    if (!r || !has_cogging(data)) return HCI_CHECK_NONE;
    const double unit = r->is_held ? fabs(torque_unit(r, as, m)) : 1.0;
    for (size_t k = 0; k < data->cogging.count; ++k) {
        const double order = hci_check_cogging_order(data, as, m, k) * hci_check_scale_of(r, as, m);
        if (!hci_check_is_significant(&data->cogging, k)) continue;
        const double length = unit * hci_check_length(hci_check_torque_order(r, order));
        sum += 0.5 * length * length;
        declared += 0.5 * data->cogging.amplitude[k] * data->cogging.amplitude[k];
    }
    return hci_check_found(fmin(1.0, sum / fmin(declared, unit * unit * r->torque_variance)));
}

/* Measured over declared at the largest order of the table: S + jC of both, the table's turned by its zero.
 */
static bool cogging_pair(const check_data *data, const check_interpretation *as, const check_model *m,
                         check_vector *found, check_vector *declared)
{
    check_run *r = unloaded_torque(data);
    const size_t k = data->cogging.largest;
    if (!r || !has_cogging(data)) return false;
    const double order = hci_check_cogging_order(data, as, m, k);
    const double phase = data->cogging.phase_rad[k] * as->phase_unit * as->cogging_phase_unit;
    const check_vector amplitude = {data->cogging.amplitude[k], 0.0};
    *declared = hci_check_turned(amplitude, phase - order * as->zero_rad);
    *found =
        hci_check_turned(hci_check_scaled(hci_check_torque_order(r, order * hci_check_scale_of(r, as, m)),
                                          torque_unit(r, as, m)),
                         -order * as->run_zero_rad);
    return true;
}

static check_value cogging_size(const check_data *data, const check_interpretation *as, const check_model *m)
{
    check_vector found, declared;
    if (!cogging_pair(data, as, m, &found, &declared)) return HCI_CHECK_NONE;
    return hci_check_found(hci_check_length(found) / hci_check_length(declared));
}

/* 0.05 electrical radians of the encoder are as many times that as the order says. */
static check_value cogging_angle(const check_data *data, const check_interpretation *as, const check_model *m)
{
    check_vector found, declared;
    if (!cogging_pair(data, as, m, &found, &declared)) return HCI_CHECK_NONE;
    const check_vector turned = hci_check_product(found, hci_check_conjugate(declared));
    return (check_value){atan2(turned.im, turned.re),
                         hypot(1.0, 0.05 * hci_check_cogging_order(data, as, m, data->cogging.largest) /
                                        CHECK_COGGING_ANGLE_TOLERANCE)};
}

/* ---- the list */

static const check_relation LIST[] = {
    {"power_balance", "torque x speed and copper loss over v.i", CHECK_RATIO, 1.0, CHECK_POWER_TOLERANCE, 9.0,
     power_balance, "a recording of voltages, currents, torque and speed", ""},
    {"torque_size", "torque over 3/2 k_e i_q and the reluctance torque", CHECK_RATIO, 1.0,
     CHECK_TORQUE_TOLERANCE, 9.0, torque_size, "a recording of currents, angle and torque", ""},
    {"cogging_share", "share of the ripple without current at the orders of cogging.csv", CHECK_SHARE, 1.0,
     0.3, 8.0, cogging_share, "cogging.csv, and a recording of torque and angle without current", ""},
    {"cogging_size", "ripple without current over cogging.csv, at its largest order", CHECK_RATIO, 1.0, 0.3,
     7.0, cogging_size, "cogging.csv, and a recording of torque and angle without current", ""},
    {"cogging_angle", "phase of the ripple without current against cogging.csv, rad", CHECK_ANGLE, 0.0,
     CHECK_COGGING_ANGLE_TOLERANCE, 4.0, cogging_angle,
     "cogging.csv, and a recording of torque and angle without current", ""},
};
const check_relation_list HCI_CHECK_TORQUE_RELATIONS = {LIST, sizeof LIST / sizeof *LIST};
