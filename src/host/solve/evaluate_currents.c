/* What currents that were found elsewhere do on a machine. In: machine, effects, star waves, target; out: the
 * spectrum of the torque, its errors and its ripple. */
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/numeric/fft.h"
#include "host/solve/torque_spectrum.h"

/* Samples in the period of the highest order: peaks between them are off by less than 1 − cos(π/16) of that
 * order. */
enum { SAMPLES_PER_PERIOD = 16, LEAST_SAMPLES = 1024 };

static double mean_square(hci_harmonic h)
{
    const double square = h.sine * h.sine + h.cosine * h.cosine;
    return h.order < HCI_ORDER_TOLERANCE ? h.cosine * h.cosine : 0.5 * square;
}

static double percent(double value_Nm, double mean_Nm)
{
    if (mean_Nm == 0.0) return NAN;
    return 100.0 * value_Nm / fabs(mean_Nm);
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
    e->F_ripple_percent = percent(sqrt(ripple), e->mean_Nm);
}

/* The torque over its period from its spectrum. */
static hci_status fill_peaks(hci_torque_evaluation *e, hci_note *note)
{
    const size_t turns = e->period_turns;
    const double top = e->torque_Nm[e->order_count - 1].order;
    const size_t n = hci_fft_size(fmax(LEAST_SAMPLES, SAMPLES_PER_PERIOD * (top + 1.0)) * (double)turns);
    double *re = hci_memory_new(2 * n, sizeof *re), most, least;
    if (!re) return hci_note_memory(note, NULL, "evaluating currents");
    double *const im = re + n;
    for (size_t k = 0; k < e->order_count; ++k) {
        const size_t at = (size_t)floor(e->torque_Nm[k].order * (double)turns + 0.5);
        re[at] += e->torque_Nm[k].cosine; /* the real part of (C − jS) e^(jnθ) */
        im[at] -= e->torque_Nm[k].sine;
    }
    hci_fft(re, im, n, 1);
    most = least = re[0];
    for (size_t k = 1; k < n; ++k) {
        most = fmax(most, re[k]);
        least = fmin(least, re[k]);
    }
    hci_memory_free(re);
    e->peak_to_peak_Nm = most - least;
    e->T_ripple_percent = percent(e->peak_to_peak_Nm, e->mean_Nm);
    return HCI_OK;
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
