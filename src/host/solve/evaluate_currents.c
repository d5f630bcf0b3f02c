/* What currents that were found elsewhere do on a machine. In: machine, effects, star waves, target; out: the
 * spectrum of the torque, its errors and its ripple. */
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/solve/torque_spectrum.h"

static double mean_square(hci_harmonic h)
{
    const double square = h.sine * h.sine + h.cosine * h.cosine;
    return h.order < HCI_ORDER_TOLERANCE ? h.cosine * h.cosine : 0.5 * square;
}

static void fill_errors(const hci_target *target, hci_torque_evaluation *e)
{
    double sum = 0.0, ripple = 0.0;
    for (size_t k = 0; k < e->order_count; ++k) {
        const hci_harmonic h = e->torque_Nm[k];
        const hci_target_order wanted = hci_target_at(target, h.order);
        const hci_harmonic error = {h.order, h.sine - wanted.torque_Nm.sine,
                                    h.cosine - wanted.torque_Nm.cosine};
        if (h.order < HCI_ORDER_TOLERANCE) e->mean_Nm = h.cosine;
        if (h.order >= HCI_ORDER_TOLERANCE) ripple += mean_square(h);
        if (wanted.weight <= 0.0) continue;
        sum += mean_square(error);
        if (hci_amplitude(error.sine, error.cosine) <= e->worst_error_Nm) continue;
        e->worst_error_Nm = hci_amplitude(error.sine, error.cosine);
        e->worst_order = h.order;
    }
    e->rms_error_Nm = sqrt(sum);
    e->F_ripple_percent = hci_percent_of_mean(sqrt(ripple), e->mean_Nm);
}

static hci_status fill_peaks(hci_torque_evaluation *e, hci_note *note)
{
    const hci_harmonic_list torque = {e->torque_Nm, e->order_count};
    const hci_status status = hci_torque_swing(&torque, e->period_turns, &e->peak_to_peak_Nm, note);
    e->T_ripple_percent = hci_percent_of_mean(e->peak_to_peak_Nm, e->mean_Nm);
    return status;
}

static hci_status evaluate(const hci_quadratic_model *model, const hci_currents *currents,
                           const hci_target *target, hci_torque_evaluation *e, hci_note *note)
{
    hci_task task;
    hci_harmonic_list torque = {NULL, 0};
    hci_status status;
    hci_task_begin(model, target, &task);
    status = hci_task_find_period(&task, NULL, currents->wave, currents->count, note);
    e->period_turns = task.period_turns;
    if (!status) status = hci_torque_spectrum_evaluate(&task, currents->wave, currents->count, &torque, note);
    if (status) return status;
    e->torque_Nm = torque.harmonic;
    e->order_count = torque.count;
    fill_errors(target, e);
    return fill_peaks(e, note);
}

hci_status hci_evaluate_currents(const hci_machine_data *machine, const hci_effects *effects,
                                 const hci_currents *currents, const hci_target *target,
                                 hci_torque_evaluation *evaluation, hci_note *note)
{
    hci_quadratic_model model;
    hci_status status = hci_quadratic_model_make(&machine->model, effects, NAN, &model, note);
    memset(evaluation, 0, sizeof *evaluation);
    if (!status) status = evaluate(&model, currents, target, evaluation, note);
    hci_quadratic_model_release(&model);
    if (status) hci_torque_evaluation_release(evaluation);
    return status;
}

void hci_torque_evaluation_release(hci_torque_evaluation *evaluation)
{
    hci_memory_free(evaluation->torque_Nm);
    memset(evaluation, 0, sizeof *evaluation);
}
