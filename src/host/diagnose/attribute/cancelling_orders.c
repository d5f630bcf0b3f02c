#include "host/diagnose/attribute/cancelling_orders.h"

#include <math.h>

#include "host/diagnose/fit/cancelling.h"
#include "host/diagnose/search/forward.h"
#include "host/diagnose/search/noise_left.h"
#include "host/diagnose/search/search.h"

/* Takes out the one of a type without which the others describe the recordings best. */
static hci_status order_leaves(hci_search *s, hci_fitted_model *model, const hci_effect_type *type,
                               hci_note *note)
{
    hci_fitted_model best = {0};
    hci_status status = HCI_OK;
    best.fit.score = INFINITY;
    for (size_t k = 0; k < model->candidates.count && !status; ++k) {
        hci_fitted_model without = {0};
        if (!model->candidates.candidate[k].in || model->candidates.candidate[k].type != type) continue;
        status = hci_fitted_model_copy(model, &without, note);
        if (!status) without.candidates.candidate[k].in = false;
        if (!status)
            status = hci_regression_fit_below(s->regression, &without.candidates, best.fit.score,
                                              &without.fit, note);
        if (!status && without.fit.score < best.fit.score) hci_fitted_model_replace(&best, &without);
        hci_fitted_model_release(&without);
    }
    if (!status && best.candidates.candidate) hci_fitted_model_replace(model, &best);
    hci_fitted_model_release(&best);
    return status;
}

static size_t orders_of(const hci_candidates *model, const hci_effect_type *type)
{
    size_t count = 0;
    for (size_t k = 0; k < model->count; ++k)
        count += model->candidate[k].in && model->candidate[k].type == type;
    return count;
}

/* Takes orders out until none cancel; type: in and out, NULL where that is so. */
static hci_status orders_leave(hci_search *s, hci_fitted_model *model, const hci_effect_type **type,
                               hci_note *note)
{
    hci_status status = HCI_OK;
    while (!status && *type && orders_of(&model->candidates, *type) > 1) {
        status = order_leaves(s, model, *type, note);
        if (!status) status = hci_cancelling_find(s->regression, &model->candidates, type, note);
    }
    return status;
}

/* What they were there for beside that is another effect. */
static hci_status other_comes(hci_search *s, hci_fitted_model *model, const hci_effect_type **type,
                              bool *is_all, hci_note *note)
{
    bool added = false;
    hci_status status = hci_search_is_noise(s, &model->candidates, is_all, note);
    if (status || *is_all || *type) return status;
    status = hci_search_renew(s, model, note);
    if (!status) status = hci_search_forward(s, model, &added, note);
    if (!status) status = hci_cancelling_find(s->regression, &model->candidates, type, note);
    if (!status) status = hci_search_is_noise(s, &model->candidates, is_all, note);
    return status;
}

/* Where two orders of an effect make the same torque at the currents that flowed, one stands for both, if
 * nothing but noise is left then. */
hci_status hci_cancelling_orders_leave(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_fitted_model fewer = {0};
    const hci_effect_type *type = NULL;
    bool is_all = false;
    hci_status status = hci_cancelling_find(s->regression, &model->candidates, &type, note);
    if (status || !type) return status;
    status = hci_fitted_model_copy(model, &fewer, note);
    if (!status) status = orders_leave(s, &fewer, &type, note);
    if (!status) status = other_comes(s, &fewer, &type, &is_all, note);
    if (!status && is_all && !type) hci_fitted_model_replace(model, &fewer);
    hci_fitted_model_release(&fewer);
    return status ? status : hci_search_renew(s, model, note);
}
