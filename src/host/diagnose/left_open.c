#include "host/diagnose/left_open.h"

#include <math.h>

#include "host/base/memory.h"
#include "host/diagnose/uncertainty/uncertainty.h"

/* The machine that each ambiguous effect would make of the recordings, where it is not the one that is
 * written down. */
static hci_alternatives alternatives_of(const hci_attribution *a)
{
    hci_alternatives x = {.count = 0};
    for (size_t r = 0; r < a->types && x.count < HCI_MOST_ALTERNATIVES; ++r) {
        const hci_verdict *v = &a->verdict[r];
        if (v->ambiguous && v->alternative.candidates.candidate)
            x.machine[x.count++] = &v->alternative.candidates;
    }
    return x;
}

/* Of the largest mean torque of a run, that is left of the mean of one. residual_Nm: of each sample. */
static double means_left(const hci_dataset *b, const double *residual_Nm)
{
    double left_Nm = 0.0, most_Nm = 0.0;
    for (size_t r = 0; r < b->samples.run_count; ++r) {
        double sum = 0.0, count = 0.0;
        if (!b->fit[r]) continue;
        for (const hci_segment *s = NULL; (s = hci_segment_next(&b->samples, r, s)) != NULL;)
            for (size_t k = s->first; k < s->first + s->count; ++k) {
                sum += b->samples.sample[k].count * residual_Nm[k];
                count += b->samples.sample[k].count;
            }
        if (count > 0.0) left_Nm = fmax(left_Nm, fabs(sum / count));
        most_Nm = fmax(most_Nm, fabs(b->samples.statistics[r].mean_torque_Nm));
    }
    return most_Nm > 0.0 ? left_Nm / most_Nm : 0.0;
}

/* Where nothing but the means of the runs is unknown, what the ripple tells, and a torque per ampere as open
 * as these means leave it. */
static hci_status open_beside_means(hci_dataset *b, const hci_attribution *a, hci_alternatives *others,
                                    hci_diagnosis *d, hci_note *note)
{
    double *residual_Nm = hci_memory_new(b->samples.count + 1, sizeof *residual_Nm);
    if (!residual_Nm) return hci_note_memory(note, NULL, "the errors of the recordings");
    hci_status status = hci_regression_residual(&b->regression, &d->effects.list, residual_Nm, note);
    if (!status) others->constant_share = means_left(b, residual_Nm);
    hci_memory_free(residual_Nm);
    if (status) return status;
    b->regression.free_means = true;
    status = hci_uncertainty_find(&b->regression, &a->model.candidates, others, &d->uncertainty, note);
    b->regression.free_means = false;
    return status;
}

/* What the recordings leave open. Of a model that had no rival, and beside something unknown, nothing is
 * stated. */
hci_status hci_left_open_find(hci_dataset *b, const hci_attribution *a, hci_diagnosis *d, hci_note *note)
{
    hci_alternatives others = alternatives_of(a);
    if (a->ended != HCI_WORK_COMPLETE) return HCI_OK;
    if (!a->unknown)
        return hci_uncertainty_find(&b->regression, &a->model.candidates, &others, &d->uncertainty, note);
    return a->means_alone && !d->contradicted ? open_beside_means(b, a, &others, d, note) : HCI_OK;
}
