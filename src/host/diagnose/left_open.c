#include "host/diagnose/left_open.h"

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

/* Deviation of the torque per ampere of a sheet, where no mean tells it. */
#define OF_SHEET 0.1

/* Where nothing but the means of the runs is unknown, what the ripple tells. */
static hci_status open_beside_means(hci_dataset *b, const hci_attribution *a, hci_alternatives *others,
                                    hci_diagnosis *d, hci_note *note)
{
    others->constant_share = OF_SHEET;
    b->regression.free_means = true;
    const hci_status status =
        hci_uncertainty_find(&b->regression, &a->model.candidates, others, &d->uncertainty, note);
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
