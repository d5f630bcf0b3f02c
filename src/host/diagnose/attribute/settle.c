#include "host/diagnose/attribute/settle.h"

#include <math.h>

#include "host/diagnose/attribute/cancelling_orders.h"
#include "host/diagnose/attribute/settle_means.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/search/backward.h"
#include "host/diagnose/search/belief.h"
#include "host/diagnose/search/noise_left.h"
#include "host/diagnose/search/scaled.h"

#define NOT_SMALL   2.0  /* times the resolution: rms of a residual that has to be understood */
#define LEAST_SHARE 0.25 /* of the residual's mean square that counts as unexplained when it is uneven */
#define SMALL       0.6  /* what is not understood is no finding below this share of what is */
#define UNTOUCHED   1.5  /* a known effect this much larger than what is not understood stands beside it */

/* ---- what is left ---- */

/* Whether the residual that is left is noise, and how much of it is not known. noise_Nm: out. */
static hci_status residual_judge(hci_search *s, hci_attribution *a, double *noise_Nm, hci_note *note)
{
    const double least_Nm = NOT_SMALL * s->resolution_Nm;
    hci_noise_left x;
    const hci_status status = hci_noise_left_find(s, &a->model.candidates, &x, note);
    if (status || !(x.rows > 0.0)) return status;
    const double excess = x.square_Nm2 / x.noise_Nm2 - 1.0, left = x.square_Nm2 / x.rows;
    a->wanders = x.wanders;
    a->unknown = !x.is_noise && left > least_Nm * least_Nm;
    *noise_Nm = sqrt(x.noise_Nm2 / x.rows);
    a->unexplained_Nm = a->unknown ? sqrt(left * fmax(excess / (1.0 + excess), LEAST_SHARE)) : 0.0;
    return HCI_OK;
}

/* ---- what is understood beside what is not ---- */

/* Adds what a type explains, as rms. Nothing where it is not in. */
static hci_status explained_add(hci_search *s, const hci_fitted_model *model, const hci_effect_type *type,
                                double *sum_Nm, hci_note *note)
{
    double explained_Nm;
    const hci_status status = hci_search_explained_by(s, model, type, &explained_Nm, note);
    *sum_Nm = hypot(*sum_Nm, explained_Nm);
    return status;
}

/* What is understood and what is not, as rms; the same of the ripple beside the means. */
typedef struct {
    double known_Nm, unexplained_Nm, known_ripple_Nm, unexplained_ripple_Nm, noise_Nm;
} understanding;

/* Of a model: what its effects explain, each by itself, and all together of the ripple. */
static hci_status known_of(hci_search *s, const hci_fitted_model *model, understanding *u, hci_note *note)
{
    static const hci_candidates none = {0};
    hci_status status = HCI_OK;
    for (size_t r = 0; hci_effect_type_at(r) && !status; ++r)
        status = explained_add(s, model, hci_effect_type_at(r), &u->known_Nm, note);
    if (!status) status = hci_search_residual(s, &none, note);
    const double before_Nm = hci_search_ripple_rms(s);
    if (!status) status = hci_search_residual(s, &model->candidates, note);
    const double after_Nm = hci_search_ripple_rms(s), all_Nm = hci_search_residual_rms(s);
    u->known_ripple_Nm = sqrt(fmax(0.0, before_Nm * before_Nm - after_Nm * after_Nm));
    u->unexplained_ripple_Nm = all_Nm > 0.0 ? u->unexplained_Nm * fmin(1.0, after_Nm / all_Nm) : 0.0;
    return status;
}

/* Whether what is not understood is large beside what is, or its ripple, above the noise, beside the ripple
 * that is: a friction, which makes none, explains none. */
static bool is_much(const understanding *u)
{
    return u->unexplained_Nm > SMALL * u->known_Nm ||
           u->unexplained_ripple_Nm > fmax(SMALL * u->known_ripple_Nm, u->noise_Nm);
}

/* Known effects beside something larger that is not understood cannot be told from a part of it, and go; a
 * description of a small remainder goes as well. */
static hci_status types_leave(hci_search *s, hci_attribution *a, double unexplained_Nm, hci_note *note)
{
    hci_candidates *model = &a->model.candidates;
    hci_status status = HCI_OK;
    for (size_t r = 0; r < a->types && !status; ++r) {
        const hci_effect_type *type = hci_candidate_type(r);
        double explained_Nm = 0.0;
        if (!hci_candidates_have(model, type) || (type == &hci_empirical_type) == a->unknown) continue;
        if (a->unknown) status = explained_add(s, &a->model, type, &explained_Nm, note);
        if (status || explained_Nm > UNTOUCHED * unexplained_Nm) continue;
        hci_candidates_remove_type(model, type);
    }
    return status;
}

/* Where a model that is not believed is better, something is behind the recordings that is not known, and
 * all that is left may belong to it. */
static void disbelieved_set(const hci_search *s, hci_yield yield, hci_attribution *a)
{
    a->disbelieved = s->disbelieved.type;
    a->disbelieved_share = s->disbelieved.constant_share;
    if (yield != HCI_YIELD_BETTER) return;
    a->unknown = true;
    a->unexplained_Nm = hci_search_residual_rms(s);
}

/* unpredicted: runs left out say that the effects are not all. */
static hci_status settle(hci_search *s, bool unpredicted, hci_attribution *a, hci_note *note)
{
    understanding u = {0.0, 0.0, 0.0, 0.0, 0.0};
    hci_yield yield = HCI_YIELD_NOTHING;
    hci_status status = hci_search_yield(s, &a->model, &yield, note);
    if (!status) status = residual_judge(s, a, &u.noise_Nm, note);
    if (yield) disbelieved_set(s, yield, a);
    if (unpredicted) a->unexplained_Nm = fmax(a->unexplained_Nm, hci_search_residual_rms(s));
    u.unexplained_Nm = a->unexplained_Nm;
    if (!status) status = explained_add(s, &a->model, &hci_empirical_type, &u.unexplained_Nm, note);
    if (status || !(u.unexplained_Nm > 0.0)) return status;
    status = known_of(s, &a->model, &u, note);
    if (status) return status;
    a->unknown = unpredicted || yield == HCI_YIELD_BETTER || is_much(&u);
    status = types_leave(s, a, u.unexplained_Nm, note);
    if (!status && a->unknown) a->unexplained_Nm = u.unexplained_Nm;
    return status;
}

/* Judging finds the noise anew, and scores are comparable with the same noise only. */
hci_status hci_search_settle(hci_search *s, hci_attribution *a, hci_note *note)
{
    hci_fitted_model before = {0};
    bool unpredicted = false;
    hci_status status = hci_settle_mirror(s, &a->model, note);
    if (!status) status = hci_settle_means(s, a, &unpredicted, note);
    if (!status && !a->means_open) status = hci_cancelling_orders_leave(s, &a->model, note);
    if (!status && !a->means_open) status = hci_search_keep_brakes(s, &a->model, note);
    if (!status && !a->means_open) status = hci_fitted_model_copy(&a->model, &before, note);
    if (!status && !a->means_open) status = settle(s, unpredicted, a, note);
    if (!status) status = hci_settle_ripple(s, a, &before, note);
    hci_fitted_model_release(&before);
    if (!status) status = hci_search_renew(s, &a->model, note);
    return status ? status : hci_settle_saturation(s, a, note);
}
