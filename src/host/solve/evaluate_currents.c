/* What currents that were found elsewhere do on a machine. */
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/numeric/fft.h"
#include "host/solve/harmonic_system.h"

/* Samples in the period of the highest order: peaks between them are off by less than 1 − cos(π/16) of that
 * order. */
enum { SAMPLES_PER_PERIOD = 16, LEAST_SAMPLES = 1024 };

static hci_status no_memory(hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory while judging currents");
}

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

static void fill_errors(const hci_target *target, hci_judgement *j)
{
    double sum = 0.0, ripple = 0.0;
    for (size_t k = 0; k < j->order_count; ++k) {
        const hci_harmonic h = j->torque_Nm[k];
        const hci_target_order wanted = hci_target_at(target, h.order);
        const hci_harmonic error = {h.order, h.sine - wanted.torque_Nm.sine,
                                    h.cosine - wanted.torque_Nm.cosine};
        if (h.order < HCI_ORDER_TOLERANCE) j->mean_Nm = h.cosine;
        if (h.order >= HCI_ORDER_TOLERANCE) ripple += mean_square(h);
        if (wanted.weight <= 0.0) continue;
        sum += mean_square(error);
        if (hypot(error.sine, error.cosine) <= j->worst_error_Nm) continue;
        j->worst_error_Nm = hypot(error.sine, error.cosine);
        j->worst_order = h.order;
    }
    j->rms_error_Nm = sqrt(sum);
    j->F_ripple_percent = percent(sqrt(ripple), j->mean_Nm);
}

/* The torque over its period from its spectrum. */
static hci_status fill_peaks(hci_judgement *j, hci_note *note)
{
    const size_t turns = j->period_turns;
    const double top = j->torque_Nm[j->order_count - 1].order;
    const size_t n =
        hci_transform_size(fmax(LEAST_SAMPLES, SAMPLES_PER_PERIOD * (top + 1.0)) * (double)turns);
    double *re = hci_memory_new(2 * n, sizeof *re), *im = re + n, most, least;
    if (!re) return no_memory(note);
    for (size_t k = 0; k < j->order_count; ++k) {
        const size_t at = (size_t)floor(j->torque_Nm[k].order * (double)turns + 0.5);
        re[at] += j->torque_Nm[k].cosine; /* the real part of (C − jS) e^(jnθ) */
        im[at] -= j->torque_Nm[k].sine;
    }
    hci_transform(re, im, n, 1);
    most = least = re[0];
    for (size_t k = 1; k < n; ++k) {
        most = fmax(most, re[k]);
        least = fmin(least, re[k]);
    }
    hci_memory_free(re);
    j->peak_to_peak_Nm = most - least;
    j->T_ripple_percent = percent(j->peak_to_peak_Nm, j->mean_Nm);
    return HCI_OK;
}

static hci_status judge(const hci_corrected *c, const hci_wave *currents, size_t count,
                        const hci_target *target, hci_judgement *j, hci_note *note)
{
    hci_task task;
    hci_status status;
    hci_task_begin(c, target, &task);
    status = hci_task_find_period(&task, NULL, currents, count, note);
    j->period_turns = task.period_turns;
    if (!status) status = hci_judge_spectrum(&task, currents, count, &j->torque_Nm, &j->order_count, note);
    if (status) return status;
    fill_errors(target, j);
    return fill_peaks(j, note);
}

hci_status hci_judge_currents(const hci_machine_data *machine, const hci_effects *effects,
                              const hci_wave *currents, size_t count, const hci_target *target,
                              hci_judgement *judgement, hci_note *note)
{
    hci_corrected c;
    hci_status status = hci_corrected_make(&machine->model, effects, NAN, &c, note);
    memset(judgement, 0, sizeof *judgement);
    if (!status) status = judge(&c, currents, count, target, judgement, note);
    hci_corrected_release(&c);
    if (status) hci_judgement_release(judgement);
    return status;
}

void hci_judgement_release(hci_judgement *judgement)
{
    hci_memory_free(judgement->torque_Nm);
    memset(judgement, 0, sizeof *judgement);
}
