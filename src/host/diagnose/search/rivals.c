#include "host/diagnose/search/rivals.h"

#include <math.h>
#include <string.h>

#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/search/brakes.h"
#include "host/diagnose/search/candidate_models.h"
#include "host/diagnose/search/stability.h"

#define EQUAL          6.0  /* models whose scores differ by less fit as well as each other */
#define PART           0.3  /* of the gain of an effect that makes another one plausible beside it */
#define PROMISED_SHARE 0.6  /* what a rival must promise of the gain of the effect … */
#define MOST_OF        0.75 /* of that gain */
#define PROMISED_LESS  20.0 /* … less so much: promises are of a linearised problem */

enum { VALUES_MORE = 2 }; /* of a rival that may be what recordings show */

/* Other effects in place of one that is in the model, one after the other. */
typedef struct rivalry rivalry;
struct rivalry {
    hci_search *search;
    const hci_fitted_model *model;
    const hci_effect_type *type; /* in whose place */
    bool unseen;                 /* only what these rounds have not been at */
    bool (*is_asked)(const rivalry *r, const hci_candidate_model *x); /* what else is not; NULL: nothing */
    double bar;        /* that the score of a rival has to be below, to be looked at … */
    double square_bar; /* … or the sum of its squares this one */
    hci_fitted_model without;
    hci_candidate_models models;
    size_t next;
};

static hci_status rivalry_start(hci_search *s, const hci_fitted_model *model, const hci_effect_type *type,
                                rivalry *r, hci_note *note)
{
    memset(r, 0, sizeof *r);
    r->search = s;
    r->model = model;
    r->type = type;
    r->bar = INFINITY;
    r->square_bar = -INFINITY;
    hci_status status = hci_search_without(s, model, type, &r->without, note);
    if (!status) status = hci_candidate_models_make(s, &r->without.candidates, false, &r->models, note);
    return status;
}

static void rivalry_end(rivalry *r)
{
    hci_candidate_models_release(&r->models);
    hci_fitted_model_release(&r->without);
}

/* The types of a model and one more, a bit each; more NULL: those of the model. */
static uint32_t types_of(const hci_candidates *model, const hci_effect_type *more)
{
    uint32_t types = 0;
    for (size_t r = 0; r < hci_candidate_types(); ++r)
        if (hci_candidates_have(model, hci_candidate_type(r)) || hci_candidate_type(r) == more)
            types |= (uint32_t)1 << r;
    return types;
}

static bool is_seen(const hci_search *s, uint32_t types)
{
    for (size_t k = 0; k < s->seen_count; ++k)
        if (s->seen[k] == types) return true;
    return false;
}

void hci_search_see(hci_search *s, const hci_candidates *model)
{
    const uint32_t types = types_of(model, NULL);
    if (s->seen_count < HCI_MOST_SEEN && !is_seen(s, types)) s->seen[s->seen_count++] = types;
}

static bool is_promising(const rivalry *r, const hci_candidate_model *x)
{
    const hci_effect_type *other = hci_candidate_type(x->a);
    const double gain = r->without.fit.score - r->model->fit.score;
    return other != r->type && !hci_candidates_have(&r->model->candidates, other) &&
           !(x->gain < PROMISED_SHARE * gain - PROMISED_LESS) &&
           !(r->unseen && is_seen(r->search, types_of(&r->without.candidates, other))) &&
           !(r->is_asked && !r->is_asked(r, x));
}

static bool is_in(const rivalry *r, const hci_candidate_model *x, size_t k)
{
    return r->models.list.candidate[k].in || x->in[k];
}

/* How many terms a rival has, and what they cost. */
static size_t terms_of(const rivalry *r, const hci_candidate_model *x)
{
    size_t terms = 0;
    for (size_t k = 0; k < r->models.list.count; ++k)
        if (is_in(r, x, k)) terms += r->models.list.candidate[k].count;
    return terms;
}

static double cost_of(const rivalry *r, const hci_candidate_model *x)
{
    double cost = 0.0;
    for (size_t k = 0; k < r->models.list.count; ++k)
        if (is_in(r, x, k)) cost += hci_candidate_cost(&r->models.list.candidate[k], r->model->fit.rows);
    return cost;
}

/* The next promising rival, fitted. with: out, its type in hci_candidate_type's count, or its end. On failure
 * and at the end *rival is empty. */
static hci_status rivalry_next(rivalry *r, hci_fitted_model *rival, size_t *with, hci_note *note)
{
    memset(rival, 0, sizeof *rival);
    while (r->next < r->models.count && !is_promising(r, &r->models.model[r->next]))
        ++r->next;
    *with = hci_candidate_types();
    if (r->next == r->models.count) return HCI_OK;
    const hci_candidate_model *x = &r->models.model[r->next++];
    *with = x->a;
    const double bar = fmax(r->bar, r->square_bar + cost_of(r, x));
    return hci_candidate_model_fit(r->search, &r->models, x, bar, rival, note);
}

/* ---- another effect instead ---- */

/* Whether one is what the other is called unless it explains decisively more. */
static bool is_called(const hci_effect_type *a, const hci_effect_type *b)
{
    return a->seen_as == b || b->seen_as == a;
}

/* By how much a rival has to fit better. The empirical term, which is no physical effect, decisively so, and
 * an effect that is called another one besides; that one takes its place where it is not decisively worse. */
static double margin_of(const hci_effect_type *in_place, const hci_effect_type *rival)
{
    if (in_place->seen_as == rival) return -HCI_DECISIVE;
    return rival == &hci_empirical_type || rival->seen_as ? HCI_DECISIVE : HCI_AS_GOOD;
}

/* Whether a rival is to take the place of the effect: it fits decisively better, or as well and describes
 * runs left out decisively better. */
static hci_status is_better(const rivalry *r, const hci_fitted_model *rival, size_t with, bool *better,
                            hci_note *note)
{
    const double fall = r->model->fit.score - rival->fit.score;
    double misfit = 0.0, rival_misfit = 0.0;
    *better = fall > margin_of(r->type, hci_candidate_type(with));
    if (*better || fall < -EQUAL || hci_candidate_type(with) == &hci_empirical_type) return HCI_OK;
    if (is_called(r->type, hci_candidate_type(with))) return HCI_OK;
    hci_status status = hci_search_left_out(r->search, &r->model->candidates, &misfit, note);
    if (!status) status = hci_search_left_out(r->search, &rival->candidates, &rival_misfit, note);
    *better = rival_misfit < misfit - HCI_DECISIVE;
    return status;
}

static hci_status swap_type(hci_search *s, hci_fitted_model *model, const hci_effect_type *type,
                            bool *swapped, hci_note *note)
{
    rivalry r;
    hci_fitted_model rival = {0};
    size_t with = 0;
    hci_status status = rivalry_start(s, model, type, &r, note);
    r.unseen = true;
    r.bar = model->fit.score + HCI_DECISIVE;
    while (!status && !*swapped && with < hci_candidate_types() && !hci_search_is_over(s)) {
        status = rivalry_next(&r, &rival, &with, note);
        if (status || with == hci_candidate_types()) break;
        status = is_better(&r, &rival, with, swapped, note);
        if (!status && *swapped) {
            hci_fitted_model_replace(model, &rival);
            status = hci_search_renew(s, model, note);
        }
        hci_fitted_model_release(&rival);
    }
    rivalry_end(&r);
    return status;
}

hci_status hci_search_swap(hci_search *s, hci_fitted_model *model, bool *swapped, hci_note *note)
{
    hci_status status = HCI_OK;
    *swapped = false;
    for (size_t r = 0; r < hci_candidate_types() && !status && !*swapped && !hci_search_is_over(s); ++r)
        if (hci_candidates_have(&model->candidates, hci_candidate_type(r)))
            status = swap_type(s, model, hci_candidate_type(r), swapped, note);
    return status;
}

/* ---- effects that cannot be told apart ---- */

static size_t type_index(const hci_effect_type *type)
{
    size_t k = 0;
    while (k < hci_candidate_types() && hci_candidate_type(k) != type)
        ++k;
    return k;
}

static void rival_mark(const rivalry *r, size_t with, hci_fitted_model *rival, hci_attribution *a)
{
    hci_verdict *v = &a->verdict[with];
    v->ambiguous = true;
    v->rival_of = r->type;
    v->gain = r->without.fit.score - rival->fit.score;
    a->verdict[type_index(r->type)].ambiguous = true;
    hci_fitted_model_replace(&v->alternative, rival);
}

/* Effects that would explain a part of what one in the model explains, if that were not there. */
static void plausible_mark(const rivalry *r, hci_attribution *a)
{
    const double gain = r->without.fit.score - r->model->fit.score;
    for (size_t k = 0; k < r->models.count; ++k)
        if (r->models.model[k].gain > PART * gain)
            a->plausible[type_index(r->type)][r->models.model[k].a] = true;
}

/* Whether a rival describes runs that are left out about as well. */
static hci_status is_as_good(const rivalry *r, const hci_fitted_model *rival, bool *good, hci_note *note)
{
    double misfit = 0.0, rival_misfit = 0.0;
    hci_status status = hci_search_left_out(r->search, &r->model->candidates, &misfit, note);
    if (!status) status = hci_search_left_out(r->search, &rival->candidates, &rival_misfit, note);
    *good = rival_misfit < misfit + HCI_DECISIVE;
    return status;
}

/* Whether an effect may stand in the place of another one under its own name. */
static bool is_of_its_own(const hci_effect_type *type, const hci_effect_type *other)
{
    return other != &hci_empirical_type && !other->seen_as && !is_called(type, other);
}

static bool asks_own(const rivalry *r, const hci_candidate_model *x)
{
    return is_of_its_own(r->type, hci_candidate_type(x->a));
}

/* Whether a rival of hardly more values describes the recordings as well: what it costs in values does not
 * make it unlikely, as of a friction whose law comes in as a whole. */
static bool describes_as_well(const hci_fitted_model *model, const hci_fitted_model *rival)
{
    return isfinite(rival->fit.score) && rival->fit.square < model->fit.square + HCI_DECISIVE &&
           hci_candidates_terms_in(&rival->candidates) <=
               hci_candidates_terms_in(&model->candidates) + VALUES_MORE;
}

/* Whether a type in the model makes no mean torque, and is no other torque per ampere. */
static bool is_of_ripple(const hci_candidates *model, const hci_effect_type *type)
{
    for (size_t k = 0; k < model->count; ++k)
        for (size_t j = 0; model->candidate[k].in && j < model->candidate[k].count; ++j)
            if (model->candidate[k].type == type && !(model->candidate[k].term[j].order > 1.0)) return false;
    return true;
}

/* The same of two parts of the iron where one value stands for a sine and a cosine: the orders of the one are
 * told by its symmetry, which the recordings do not show. */
static bool is_same_ripple(const hci_fitted_model *model, const hci_fitted_model *rival,
                           const hci_effect_type *a, const hci_effect_type *b)
{
    return a->propose_coenergy && b->propose_coenergy && is_of_ripple(&model->candidates, a) &&
           describes_as_well(model, rival) &&
           hci_candidates_terms_in(&rival->candidates) <= hci_candidates_terms_in(&model->candidates) + 1;
}

hci_status hci_search_rivals(hci_search *s, const hci_effect_type *type, hci_attribution *a, hci_note *note)
{
    rivalry r;
    hci_fitted_model rival = {0};
    size_t with = 0;
    bool drives = false;
    hci_status status = rivalry_start(s, &a->model, type, &r, note);
    if (!status) plausible_mark(&r, a);
    r.is_asked = asks_own;
    r.bar = a->model.fit.score + EQUAL;
    if (type->propose_coenergy) r.square_bar = a->model.fit.square + HCI_DECISIVE;
    while (!status && !hci_search_is_over(s)) {
        status = rivalry_next(&r, &rival, &with, note);
        if (status || with == hci_candidate_types()) break;
        bool equal = rival.fit.score < a->model.fit.score + EQUAL ||
                     is_same_ripple(&a->model, &rival, type, hci_candidate_type(with));
        if (equal) status = is_as_good(&r, &rival, &equal, note);
        if (!status)
            status =
                hci_brakes_drive(s->regression, &rival.candidates, hci_candidate_type(with), &drives, note);
        equal = equal && !drives;
        a->unsettled = a->unsettled || (equal && a->model.fit.score - rival.fit.score >
                                                     margin_of(type, hci_candidate_type(with)));
        if (!status && equal) rival_mark(&r, with, &rival, a);
        hci_fitted_model_release(&rival);
    }
    rivalry_end(&r);
    return status;
}

static bool asks_few(const rivalry *r, const hci_candidate_model *x)
{
    return asks_own(r, x) && terms_of(r, x) <= hci_candidates_terms_in(&r->model->candidates) + VALUES_MORE;
}

hci_status hci_search_is_told(hci_search *s, const hci_fitted_model *model, const hci_effect_type *type,
                              bool *told, hci_note *note)
{
    rivalry r;
    hci_fitted_model rival = {0};
    size_t with = 0;
    hci_status status = rivalry_start(s, model, type, &r, note);
    r.is_asked = asks_few;
    r.bar = -INFINITY;
    r.square_bar = model->fit.square + HCI_DECISIVE;
    *told = true;
    while (!status && *told) {
        status = rivalry_next(&r, &rival, &with, note);
        if (status || with == hci_candidate_types()) break;
        *told = !describes_as_well(model, &rival);
        hci_fitted_model_release(&rival);
    }
    rivalry_end(&r);
    return status;
}

static bool asks_angle(const rivalry *r, const hci_candidate_model *x)
{
    return hci_candidate_type(x->a)->keeps_currents &&
           terms_of(r, x) <= hci_candidates_terms_in(&r->model->candidates);
}

hci_status hci_search_is_of_angle(hci_search *s, const hci_fitted_model *model, const hci_effect_type *type,
                                  bool *of_angle, hci_note *note)
{
    rivalry r;
    hci_fitted_model rival = {0};
    size_t with = 0;
    hci_status status = rivalry_start(s, model, type, &r, note);
    const double gain = r.without.fit.score - model->fit.score;
    r.is_asked = asks_angle;
    r.bar = r.without.fit.score - MOST_OF * gain;
    *of_angle = false;
    while (!status && !*of_angle && !type->keeps_currents) {
        status = rivalry_next(&r, &rival, &with, note);
        if (status || with == hci_candidate_types()) break;
        *of_angle = rival.fit.score < r.bar;
        hci_fitted_model_release(&rival);
    }
    rivalry_end(&r);
    return status;
}

hci_status hci_search_instead(hci_search *s, const hci_fitted_model *model, const hci_effect_type *in_place,
                              const hci_effect_type *type, hci_fitted_model *instead, hci_note *note)
{
    rivalry r;
    size_t k = 0;
    memset(instead, 0, sizeof *instead);
    hci_status status = rivalry_start(s, model, in_place, &r, note);
    while (!status && k < r.models.count && hci_candidate_type(r.models.model[k].a) != type)
        ++k;
    if (!status && k < r.models.count)
        status = hci_candidate_model_fit(s, &r.models, &r.models.model[k], INFINITY, instead, note);
    if (!status && !isfinite(instead->fit.score)) hci_fitted_model_release(instead);
    rivalry_end(&r);
    return status;
}
