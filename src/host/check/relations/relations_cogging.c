/* What must hold for the torque without current: the cogging torque. */
#include <math.h>

#include "host/check/relations/relations.h"

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
                                        CHECK_COGGING_ANGLE_TOLERANCE),
                         0.0};
}

/* ---- the list */

static const check_relation LIST[] = {
    {"cogging_share", "share of the ripple without current at the orders of cogging.csv", CHECK_SHARE, 1.0,
     0.3, 8.0, cogging_share, "cogging.csv, and a recording of torque and angle without current", ""},
    {"cogging_size", "ripple without current over cogging.csv, at its largest order", CHECK_RATIO, 1.0, 0.3,
     7.0, cogging_size, "cogging.csv, and a recording of torque and angle without current", ""},
    {"cogging_angle", "phase of the ripple without current against cogging.csv, rad", CHECK_ANGLE, 0.0,
     CHECK_COGGING_ANGLE_TOLERANCE, 4.0, cogging_angle,
     "cogging.csv, and a recording of torque and angle without current", ""},
};
const check_relation_list HCI_CHECK_COGGING_RELATIONS = {LIST, sizeof LIST / sizeof *LIST};
