#include "host/diagnose/search/few_values.h"

#include "host/diagnose/search/belief.h"
#include "host/diagnose/search/forward.h"

#define NEARER 0.7 /* share of what it is behind that a step may leave */

enum { MOST_STEPS = 3 };

/* The model with all series in the currents taken out, or with nothing at all. */
static hci_status start(hci_search *s, const hci_fitted_model *model, bool empty, hci_fitted_model *few,
                        hci_note *note)
{
    hci_status status = hci_fitted_model_copy(model, few, note);
    for (size_t k = 0; k < few->candidates.count; ++k)
        if (empty || few->candidates.candidate[k].type->is_series) few->candidates.candidate[k].in = false;
    if (!status) status = hci_search_fit(s, few, note);
    return status;
}

/* Takes effects of few values in until it is better than the model, or no further one comes in, or one that
 * brings it hardly nearer. */
static hci_status steps_run(hci_search *s, const hci_fitted_model *model, hci_fitted_model *few, bool *better,
                            hci_note *note)
{
    hci_status status = HCI_OK;
    bool added = true;
    *better = false;
    for (int step = 0; step < MOST_STEPS && added && !*better && !status && !hci_search_is_over(s); ++step) {
        const double behind = few->fit.score - model->fit.score;
        status = hci_search_forward_few(s, few, &added, note);
        const double left = few->fit.score - model->fit.score;
        *better = !status && left < -HCI_AS_GOOD;
        if (left > NEARER * behind) break;
    }
    return status;
}

hci_status hci_search_few_values(hci_search *s, hci_fitted_model *model, bool *changed, hci_note *note)
{
    hci_status status = HCI_OK;
    *changed = false;
    const bool series = hci_candidates_have_series(&model->candidates);
    if (!series && !s->from_no_load) return HCI_OK;
    for (int empty = !series; empty < 2 && !*changed && !status && !hci_search_is_over(s); ++empty) {
        hci_fitted_model few = {0};
        status = start(s, model, empty, &few, note);
        if (!status) status = steps_run(s, model, &few, changed, note);
        if (!status && *changed) {
            hci_fitted_model_replace(model, &few);
            status = hci_search_renew(s, model, note);
        }
        hci_fitted_model_release(&few);
    }
    return status;
}
