#include "host/diagnose/uncertainty/power_trials.h"

#include <math.h>

#include "host/base/memory.h"

static const double SHARES[HCI_MOST_POWERS] = {1.0, 0.3, 0.1, 0.03};

/* −2 log of the density that the runs left out have, each as all others with the expectation foresee it: a
 * wide expectation foresees nothing, and is told by that. */
static double misfit_of(const hci_power_trials_of *of, const hci_left_out_group *left)
{
    const double by_square = of->width.twins * of->width.twins;
    double sum = 0.0;
    for (size_t g = 0; g < of->runs->count; ++g)
        sum += left[g].spread + left[g].surprise * by_square;
    return isnan(sum) ? (double)INFINITY : sum;
}

static hci_status try(const hci_power_trials_of *of, hci_power_trial *x, hci_left_out_group *left,
                      hci_note *note)
{
    hci_allowed_width width = of->width;
    const hci_expectation expected = {of->precision, of->terms->centre};
    hci_ridge ridge;
    width.beyond = x->beyond;
    hci_allowed_terms_precision(of->terms, width, of->precision);
    if (!hci_ridge_make(of->runs, &expected, &ridge)) return HCI_OK;
    const bool left_out = hci_ridge_leave_out(&ridge, of->runs, NULL, left);
    hci_ridge_release(&ridge);
    if (!left_out && hci_watch_stops(of->runs->watch)) return HCI_ERROR_STOPPED;
    if (!left_out) return hci_note_memory(note, NULL, "leaving runs out");
    x->misfit = misfit_of(of, left);
    return HCI_OK;
}

/* Where none describes the runs all weigh alike. */
static void weigh(hci_power_trials *t)
{
    double least = INFINITY, sum = 0.0;
    for (size_t k = 0; k < t->count; ++k)
        least = fmin(least, t->trial[k].misfit);
    for (size_t k = 0; k < t->count; ++k) {
        t->trial[k].weight = isfinite(least) ? exp(-0.5 * (t->trial[k].misfit - least)) : 1.0;
        sum += t->trial[k].weight;
    }
    for (size_t k = 0; k < t->count; ++k)
        t->trial[k].weight /= sum;
}

hci_status hci_power_trials_make(const hci_power_trials_of *of, hci_power_trials *t, hci_note *note)
{
    *t = (hci_power_trials){{{1.0, 0.0, 1.0}}, 1};
    if (!(of->width.twins > 0.0)) return HCI_OK;
    hci_left_out_group *left = hci_memory_new(of->runs->count + 1, sizeof *left);
    hci_status status = left ? HCI_OK : hci_note_memory(note, NULL, "leaving runs out");
    for (t->count = 0; t->count < HCI_MOST_POWERS && !status; ++t->count) {
        t->trial[t->count] = (hci_power_trial){SHARES[t->count], INFINITY, 0.0};
        status = try(of, &t->trial[t->count], left, note);
    }
    if (!status) weigh(t);
    hci_memory_free(left);
    return status;
}
