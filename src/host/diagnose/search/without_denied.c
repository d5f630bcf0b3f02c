#include "host/diagnose/search/without_denied.h"

#include <math.h>

#include "host/diagnose/search/backward.h"
#include "host/diagnose/search/rounds.h"
#include "host/diagnose/search/stability.h"

#define MOST   0.5 /* of the square that a model explains */
#define NEARLY 0.1 /* of the same, that others may leave besides */

static hci_status square_of(hci_search *s, const hci_candidates *model, double *square, hci_note *note)
{
    const hci_status status = hci_search_residual(s, model, note);
    *square = pow(hci_search_residual_rms(s), 2.0);
    return status;
}

/* The share that one model leaves of what another explains. */
static hci_status share_left(hci_search *s, const hci_candidates *one, const hci_candidates *other,
                             double *share, hci_note *note)
{
    static const hci_candidates none = {0};
    double before = 0.0, after = 0.0, left = 0.0;
    hci_status status = square_of(s, &none, &before, note);
    if (!status) status = square_of(s, other, &after, note);
    if (!status) status = square_of(s, one, &left, note);
    *share = before > after ? (left - after) / (before - after) : 0.0;
    return status;
}

static hci_status lasting_keep(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    const hci_status status = hci_search_keep_predictive(s, model, note);
    return status ? status : hci_search_drop_unsure(s, model, note);
}

/* Those that act on all that is read along time; single terms of the iron, the other ones that stand for each
 * other, have their whole. Returns whether any has left. */
static bool denied_find(const hci_candidates *before, const hci_candidates *after,
                        bool denied[HCI_MOST_TYPES])
{
    bool any = false;
    for (size_t r = 0; r < hci_candidate_types(); ++r) {
        const hci_effect_type *type = hci_candidate_type(r);
        denied[r] = (type->lag || type->late) && hci_candidates_have(before, type) &&
                    !hci_candidates_have(after, type);
        any = any || denied[r];
    }
    return any;
}

/* others: in, what has stayed; out, what was found besides. */
static hci_status others_find(hci_search *s, const bool *denied, hci_fitted_model *others, hci_note *note)
{
    s->denied = denied;
    hci_status status = hci_search_rounds(s, others, note);
    s->denied = NULL;
    return status ? status : lasting_keep(s, others, note);
}

static hci_status try_others(hci_search *s, hci_fitted_model *model, hci_fitted_model *others, hci_note *note)
{
    bool denied[HCI_MOST_TYPES];
    double share = 0.0;
    hci_status status = lasting_keep(s, others, note);
    if (status || !denied_find(&model->candidates, &others->candidates, denied)) return status;
    status = share_left(s, &others->candidates, &model->candidates, &share, note);
    if (status || !(share > MOST)) return status;
    status = others_find(s, denied, others, note);
    if (!status) status = share_left(s, &others->candidates, &model->candidates, &share, note);
    if (!status && share < NEARLY) hci_fitted_model_replace(model, others);
    return status;
}

hci_status hci_search_without_denied(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_fitted_model others = {0};
    if (hci_search_is_over(s)) return HCI_OK;
    hci_status status = hci_fitted_model_copy(model, &others, note);
    if (!status) status = try_others(s, model, &others, note);
    hci_fitted_model_release(&others);
    return status ? status : hci_search_renew(s, model, note);
}
