#include "host/diagnose/search/forward.h"

#include <math.h>

#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/fit/late_torque.h"
#include "host/diagnose/fit/resonance.h"
#include "host/diagnose/prepare/lag_told.h"
#include "host/diagnose/search/belief.h"
#include "host/diagnose/search/candidate_models.h"
#include "host/diagnose/search/companions.h"

/* Promises of the linearised problem, in units of the score. */
#define PROMISING    (0.5 * HCI_DECISIVE) /* a single effect that is fitted in full */
#define BEHIND_SHARE 0.3  /* how far behind the best promise it may be: this share of it … */
#define BEHIND       60.0 /* … and so much */
#define PAIR         (2.0 * HCI_DECISIVE) /* the same of two effects at once */

#define PAIR_MARGIN     0.02   /* what two effects at once must explain more than one, as a share */
#define LOOSE_MARGIN    0.01   /* the same of a series, beside effects of few values that others may join */
#define SERIES_MARGIN   0.005  /* what two effects may promise less than a series of as many values */
#define LOOSE_MOST      5000.0 /* and no more: beside large effects of the iron the rest is a series */
#define RESONANCE_PRICE 12.0   /* of having looked at so many frequencies */
#define LAG_PRICE       6.0    /* and at so many time constants */
#define LATE_PRICE      12.0   /* and at so many delays */
#define FAINT           0.5    /* of what an effect of the iron will have to explain */
#define MUCH            3.0    /* times the resolution, and … */
#define STANDS_OUT                                                                                           \
    1.1 /* … times the noise: a residual in which high powers of the currents are looked for               \
         */

enum { SINGLES = 3, PAIRS = 2, FEW = 6, RICHEST = 2 }; /* models that are fitted; values; of saturation */

/* ---- which models are fitted in full ---- */

static bool is_pair(const hci_candidate_model *x)
{
    return x->a != x->b;
}

static bool has_both(const hci_candidate_model *x, size_t a, size_t b)
{
    return (x->a == a || x->b == a) && (x->a == b || x->b == b);
}

static bool is_picked(const hci_candidate_model *x, const hci_candidate_model *const *picked, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        if (picked[k] == x) return true;
    return false;
}

/* The best single effects. */
static size_t singles_pick(const hci_candidate_models *t, const hci_candidate_model *picked[SINGLES])
{
    size_t count = 0;
    while (count < SINGLES) {
        const hci_candidate_model *best = NULL;
        for (size_t k = 0; k < t->count; ++k) {
            const hci_candidate_model *x = &t->model[k];
            if (is_pair(x) || x->gain < PROMISING || is_picked(x, picked, count)) continue;
            if (!best || x->gain > best->gain) best = x;
        }
        if (!best) break;
        if (count > 0 && best->gain < picked[0]->gain - BEHIND_SHARE * picked[0]->gain - BEHIND) break;
        picked[count++] = best;
    }
    return count;
}

/* The best pair, of those with one effect type or (NULL) of all. */
static const hci_candidate_model *best_pair(const hci_candidate_models *t, const hci_candidate_model *with)
{
    const hci_candidate_model *best = NULL;
    for (size_t k = 0; k < t->count; ++k) {
        const hci_candidate_model *x = &t->model[k];
        if (!is_pair(x) || (with && x->a != with->a && x->b != with->a)) continue;
        if (!best || x->gain > best->gain) best = x;
    }
    return best;
}

/* What describes nearly anything a little: a series in the currents, and what no effect explains. */
static bool is_loose(size_t type)
{
    return hci_candidate_type(type)->is_series || hci_candidate_type(type) == &hci_empirical_type;
}

/* Whether one effect of no more values promises as much as a pair, but for what a pair has to explain more.
 */
static bool one_does(const hci_candidate_models *t, const hci_candidate_model *pair)
{
    for (size_t k = 0; k < t->count; ++k) {
        const hci_candidate_model *x = &t->model[k];
        if (!is_pair(x) && !is_loose(x->a) && x->terms <= pair->terms &&
            pair->gain < (1.0 + PAIR_MARGIN) * x->gain)
            return true;
    }
    return false;
}

/* In place of a series two effects may have as many values as that, and promise a little less: a promise is
 * of orders that were chosen one by one. Not where one effect does as well. */
static bool is_frugal(const hci_candidate_models *t, const hci_candidate_model *x,
                      const hci_candidate_model *single)
{
    const bool series = hci_candidate_type(single->a)->is_series;
    const double least = series ? (1.0 - SERIES_MARGIN) * single->gain : single->gain + PAIR;
    return is_pair(x) && !is_loose(x->a) && !is_loose(x->b) && x->terms <= single->terms &&
           (series || x->terms <= FEW) && x->gain > least && !(series && one_does(t, x));
}

/* The best pair of few values that explains more than a single effect with no fewer. */
static const hci_candidate_model *frugal_pair(const hci_candidate_models *t,
                                              const hci_candidate_model *single)
{
    const hci_candidate_model *best = NULL;
    for (size_t k = 0; k < t->count; ++k) {
        const hci_candidate_model *x = &t->model[k];
        if (is_frugal(t, x, single) && (!best || x->gain > best->gain)) best = x;
    }
    return best;
}

/* The best single effects, the best pair where it beats what begins with the best of them, and the best that
 * needs no more values than that one: one step takes a family of many values before two effects of few. */
static size_t models_pick(const hci_candidate_models *t, const hci_candidate_model *picked[SINGLES + PAIRS])
{
    size_t count = singles_pick(t, picked);
    const hci_candidate_model *pair = best_pair(t, NULL);
    const hci_candidate_model *with_first = count > 0 ? best_pair(t, picked[0]) : NULL;
    const hci_candidate_model *frugal = count > 0 ? frugal_pair(t, picked[0]) : NULL;
    if (pair && pair->gain > PAIR && (!with_first || pair->gain > with_first->gain + HCI_DECISIVE))
        picked[count++] = pair;
    if (frugal && !is_picked(frugal, picked, count)) picked[count++] = frugal;
    return count;
}

/* ---- models ---- */

/* Whether a series in the currents promises more than every other single effect. */
static bool powers_lead(const hci_candidate_models *t)
{
    double most = 0.0, powers = 0.0;
    for (size_t k = 0; k < t->count; ++k) {
        if (is_pair(&t->model[k])) continue;
        if (hci_candidate_type(t->model[k].a)->is_series)
            powers = fmax(powers, t->model[k].gain);
        else
            most = fmax(most, t->model[k].gain);
    }
    return powers > most;
}

static bool is_much_left(const hci_search *s)
{
    const double rms = hci_search_residual_rms(s);
    return !(rms < MUCH * s->resolution_Nm || rms < STANDS_OUT * hci_search_noise_rms(s));
}

/* High powers of the currents fit anything: they are looked into only where much is left, and taken only when
 * nothing else explains more of it. */
static hci_status models_enriched(hci_search *s, const hci_candidates *model, hci_candidate_models *t,
                                  hci_note *note)
{
    const int richness = s->richness;
    const bool saturates = hci_candidates_have_series(model);
    hci_status status = hci_search_residual(s, model, note);
    if (status) return status;
    if (richness == RICHEST || !saturates || !is_much_left(s))
        return hci_candidate_models_make(s, model, true, t, note);
    s->richness = RICHEST;
    status = hci_candidate_models_make(s, model, true, t, note);
    if (status || powers_lead(t)) return status;
    s->richness = richness;
    hci_candidate_models_release(t);
    return hci_candidate_models_make(s, model, true, t, note);
}

/* ---- one round ---- */

/* The best model so far, and the score that the next one has to be below. */
typedef struct {
    hci_search *search;
    const hci_fitted_model *present;
    hci_fitted_model best;
    double bar;
    double least; /* that a score has to be below, whatever the handicap */
    bool refused; /* one was fitted and is not believed */
} comparison;

/* Takes the candidate as the best where it is, else leaves it. */
static hci_status contender_enter(comparison *c, hci_fitted_model *candidate, double handicap, hci_note *note)
{
    const double score = candidate->fit.score + handicap;
    bool noticeable = false;
    if (!(score < c->bar && candidate->fit.score < c->least)) return HCI_OK;
    const hci_status status =
        hci_search_noticeable(c->search, &candidate->candidates, &c->present->candidates, &noticeable, note);
    if (!noticeable) return status;
    c->bar = score;
    hci_fitted_model_replace(&c->best, candidate);
    return HCI_OK;
}

/* What a model must be better by than its score: two effects at once, unless of few values, and a series by a
 * share of what one explains too, and one that is called another unless it is decisively better. */
static double handicap_of(const hci_candidate_models *t, const hci_candidate_model *x,
                          const hci_candidate_model *best)
{
    const hci_effect_type *a = hci_candidate_type(x->a), *b = hci_candidate_type(x->b);
    const double margin = is_frugal(t, x, best) ? 0.0 : PAIR_MARGIN * best->gain;
    const double pair = is_pair(x) ? HCI_DECISIVE + margin : 0.0;
    const double loose = is_loose(x->a) || is_loose(x->b) ? fmin(LOOSE_MOST, LOOSE_MARGIN * best->gain) : 0.0;
    return pair + loose + (a->seen_as || b->seen_as ? HCI_DECISIVE : 0.0);
}

/* One of the table, fitted in full. Where that is not believed it leaves the table, and all that it is a part
 * of. */
static hci_status model_enter(comparison *c, hci_candidate_models *t, const hci_candidate_model *x,
                              double handicap, hci_note *note)
{
    hci_fitted_model candidate = {0};
    hci_status status =
        hci_candidate_model_fit(c->search, t, x, fmin(c->bar - handicap, c->least), &candidate, note);
    const bool believed = isfinite(candidate.fit.score);
    const size_t a = x->a, b = x->b;
    if (!status && believed) status = contender_enter(c, &candidate, handicap, note);
    c->refused = c->refused || !believed;
    for (size_t k = 0; k < t->count && !status && !believed; ++k)
        if (has_both(&t->model[k], a, b)) t->model[k].gain = -INFINITY;
    hci_fitted_model_release(&candidate);
    return status;
}

static hci_status models_enter(comparison *c, hci_candidate_models *t, hci_note *note)
{
    const hci_candidate_model *picked[SINGLES + PAIRS];
    const size_t count = models_pick(t, picked);
    const hci_candidate_model first = count > 0 ? *picked[0] : (hci_candidate_model){0};
    hci_status status = HCI_OK;
    for (size_t k = 0; k < count && !status && !hci_search_is_over(c->search); ++k)
        status = model_enter(c, t, picked[k], handicap_of(t, picked[k], &first), note);
    return status;
}

/* Where none of those that promise most comes in and one was not believed, those behind it. */
static hci_status believed_enter(comparison *c, hci_candidate_models *t, hci_note *note)
{
    hci_status status = models_enter(c, t, note);
    if (!status && c->refused && !c->best.candidates.candidate && !hci_search_is_over(c->search))
        status = models_enter(c, t, note);
    return status;
}

/* The model with a resonance, fitted from the best point of a grid. */
static hci_status resonance_fit(comparison *c, const hci_candidate *x, hci_fitted_model *candidate,
                                hci_note *note)
{
    hci_status status = hci_fitted_model_copy(c->present, candidate, note);
    if (!status) status = hci_candidates_add(&candidate->candidates, x, note);
    if (!status) status = hci_search_fit_below(c->search, candidate, c->bar, note);
    return status;
}

/* What no linearised problem finds: a resonance. */
static hci_status resonance_enter(comparison *c, const hci_effect_type *type, hci_note *note)
{
    hci_candidate x = {.type = type, .count = 2, .price = RESONANCE_PRICE, .in = true};
    hci_fitted_model candidate = {0};
    hci_resonance found;
    x.term[0] = (hci_effect_term){type->resonance[0], 0.0, 0.0, NAN};
    x.term[1] = (hci_effect_term){type->resonance[1], 0.0, 0.0, NAN};
    if (hci_candidates_find_in(&c->present->candidates, &x)) return HCI_OK;
    hci_status status = hci_search_residual(c->search, &c->present->candidates, note);
    if (!status)
        status = hci_resonance_find(c->search->regression, type, c->search->residual_Nm, &found, note);
    if (status || found.gain < hci_candidate_cost(&x, c->present->fit.rows) + HCI_DECISIVE) return status;
    x.term[0].value = found.natural_frequency_Hz;
    x.term[1].value = found.damping;
    status = resonance_fit(c, &x, &candidate, note);
    if (!status) status = contender_enter(c, &candidate, 0.0, note);
    hci_fitted_model_release(&candidate);
    return status;
}

/* And a lag that is so long that the linearised problem does not promise it. */
static hci_status lag_enter(comparison *c, const hci_effect_type *type, hci_note *note)
{
    hci_candidate x = {.type = type, .count = 1, .price = LAG_PRICE, .in = true};
    hci_fitted_model candidate = {0};
    double time_constant_s = 0.0, gain = 0.0;
    x.term[0] = (hci_effect_term){type->lag[0], 0.0, 0.0, NAN};
    if (hci_candidates_find_in(&c->present->candidates, &x)) return HCI_OK;
    hci_status status = hci_search_residual(c->search, &c->present->candidates, note);
    if (!status)
        status =
            hci_lag_find(c->search->regression, type, c->search->residual_Nm, &time_constant_s, &gain, note);
    if (status || gain < hci_candidate_cost(&x, c->present->fit.rows) + HCI_DECISIVE) return status;
    x.term[0].value = time_constant_s;
    status = resonance_fit(c, &x, &candidate, note);
    if (!status) status = contender_enter(c, &candidate, 0.0, note);
    hci_fitted_model_release(&candidate);
    return status;
}

/* The model with a torque that is later by a delay than it has already. */
static hci_status late_fit(comparison *c, hci_candidate *x, hci_fitted_model *candidate, hci_note *note)
{
    const hci_candidate *known = hci_candidates_find_in(&c->present->candidates, x);
    hci_status status = hci_fitted_model_copy(c->present, candidate, note);
    if (known)
        candidate->candidates.candidate[known - c->present->candidates.candidate].term[0].value +=
            x->term[0].value;
    if (!status && !known) status = hci_candidates_add(&candidate->candidates, x, note);
    if (!status) status = hci_search_fit_below(c->search, candidate, c->bar, note);
    return status;
}

/* And a torque that is late by more than a radian of what it shows. */
static hci_status late_enter(comparison *c, const hci_effect_type *type, hci_note *note)
{
    hci_candidate x = {.type = type, .count = 1, .price = LATE_PRICE, .in = true};
    hci_fitted_model candidate = {0};
    hci_late_torque found = {0.0, 0.0};
    hci_status status = hci_search_residual(c->search, &c->present->candidates, note);
    if (!status && is_much_left(c->search))
        status = hci_late_torque_find(c->search->regression, c->search->residual_Nm, &found, note);
    if (status || found.gain < hci_candidate_cost(&x, c->present->fit.rows) + HCI_DECISIVE) return status;
    x.term[0] = (hci_effect_term){type->late[0], 0.0, found.delay_s, NAN};
    status = late_fit(c, &x, &candidate, note);
    if (!status) status = contender_enter(c, &candidate, 0.0, note);
    hci_fitted_model_release(&candidate);
    return status;
}

/* ---- what would not stay ---- */

/* What an effect of the iron has to explain beside those that are in and not exact; half of it, since that
 * was found when they came in. */
static double least_of_iron(const hci_search *s, const hci_candidates *model, const hci_effect_type *type)
{
    double least = 0.0;
    for (size_t r = 0; r < hci_candidate_types(); ++r) {
        const hci_effect_type *other = hci_candidate_type(r);
        if (other == type || !hci_candidates_have(model, other)) continue;
        if (type->beyond_quadratic && other->beyond_quadratic) continue;
        least = fmax(least, FAINT * s->came_with[r] * hci_companion_error(s->regression, model, other));
    }
    return least;
}

/* The same of any effect but plain friction beside a torque that goes with an acceleration. */
static double least_of_slopes(const hci_search *s, const hci_candidates *model, const hci_effect_type *type)
{
    double least = 0.0;
    for (size_t r = 0; r < hci_candidate_types() && !type->coulomb_Nm; ++r) {
        const hci_effect_type *other = hci_candidate_type(r);
        if (other == type || !hci_companion_is_by_slope(other) || !hci_candidates_have(model, other))
            continue;
        least = fmax(least, FAINT * s->came_with[r] * hci_companion_error(s->regression, model, other));
    }
    return least;
}

/* What a type must explain to come in; 0: anything. What no effect explains takes the place of those of the
 * iron. */
static double least_of(const hci_search *s, const hci_candidates *model, size_t type)
{
    const hci_effect_type *x = hci_candidate_type(type);
    const bool of_iron = x->propose_coenergy || x == &hci_empirical_type;
    if (hci_candidates_have(model, x)) return 0.0;
    return fmax(least_of_slopes(s, model, x), of_iron ? least_of_iron(s, model, x) : 0.0);
}

/* What a type promises alone. */
static double single_gain(const hci_candidate_models *t, size_t type)
{
    for (size_t k = 0; k < t->count; ++k)
        if (t->model[k].a == type && t->model[k].b == type) return fmax(0.0, t->model[k].gain);
    return 0.0;
}

/* Whether one type of a model adds less to the other than it must. */
static bool is_faint(const hci_search *s, const hci_candidates *model, const hci_candidate_models *t,
                     const hci_candidate_model *x)
{
    const double least_a = least_of(s, model, x->a), least_b = least_of(s, model, x->b);
    if (!is_pair(x)) return x->gain < least_a;
    return x->gain - single_gain(t, x->b) < least_a || x->gain - single_gain(t, x->a) < least_b;
}

/* Effects of the iron that would be taken for a part of the error of others in the end are not looked for:
 * only noise is left. */
static void faint_leave(const hci_search *s, const hci_candidates *model, hci_candidate_models *t)
{
    size_t count = 0;
    for (size_t k = 0; k < t->count; ++k)
        if (is_pair(&t->model[k]) && is_faint(s, model, t, &t->model[k])) t->model[k].gain = -INFINITY;
    for (size_t k = 0; k < t->count; ++k)
        if (isfinite(t->model[k].gain) && !(!is_pair(&t->model[k]) && is_faint(s, model, t, &t->model[k])))
            t->model[count++] = t->model[k];
    t->count = count;
}

/* Takes note of what the score falls by. */
static void coming_note(hci_search *s, const hci_fitted_model *before, const hci_fitted_model *after)
{
    const bool alone =
        hci_candidates_types_in(&after->candidates) == hci_candidates_types_in(&before->candidates) + 1;
    for (size_t r = 0; r < hci_candidate_types() && alone; ++r)
        if (!hci_candidates_have(&before->candidates, hci_candidate_type(r)) &&
            hci_candidates_have(&after->candidates, hci_candidate_type(r)))
            s->came_with[r] = before->fit.score - after->fit.score;
}

/* ---- the step ---- */

static comparison comparison_from(hci_search *s, const hci_fitted_model *present)
{
    return (comparison){
        s, present, {{NULL, 0, 0.0}, {0.0, 0, 0.0, 0.0}}, present->fit.score - HCI_DECISIVE, INFINITY, false};
}

static bool is_denied(const hci_search *s, size_t type)
{
    return s->denied && s->denied[type];
}

static bool tells_lag(const hci_regression *e)
{
    return hci_lag_is_told(e->machine, e->runs, e->samples->statistics, e->use, e->samples->run_count);
}

hci_status hci_search_forward(hci_search *s, hci_fitted_model *model, bool *added, hci_note *note)
{
    comparison c = comparison_from(s, model);
    hci_candidate_models t;
    const bool lag_told = tells_lag(s->regression);
    hci_status status = models_enriched(s, &model->candidates, &t, note);
    *added = false;
    if (status) return status;
    faint_leave(s, &model->candidates, &t);
    status = believed_enter(&c, &t, note);
    hci_candidate_models_release(&t);
    for (size_t r = 0; hci_effect_type_at(r) && !status && !hci_search_is_over(s); ++r)
        if (hci_effect_type_at(r)->resonance && lag_told && !is_denied(s, r))
            status = resonance_enter(&c, hci_effect_type_at(r), note);
    for (size_t r = 0; hci_effect_type_at(r) && !status && !hci_search_is_over(s); ++r)
        if (hci_effect_type_at(r)->lag && lag_told && !is_denied(s, r))
            status = lag_enter(&c, hci_effect_type_at(r), note);
    for (size_t r = 0; hci_effect_type_at(r) && !status && !hci_search_is_over(s); ++r)
        if (hci_effect_type_at(r)->late && !is_denied(s, r))
            status = late_enter(&c, hci_effect_type_at(r), note);
    if (!status && c.best.candidates.candidate) {
        coming_note(s, model, &c.best);
        hci_fitted_model_replace(model, &c.best);
        *added = true;
        status = hci_search_renew(s, model, note);
    }
    hci_fitted_model_release(&c.best);
    return status;
}

/* ---- without a series ---- */

/* Leaves models with a series, or with what no effect explains, out of the table. */
static void loose_leave(hci_candidate_models *t)
{
    size_t count = 0;
    for (size_t k = 0; k < t->count; ++k)
        if (!is_loose(t->model[k].a) && !is_loose(t->model[k].b)) t->model[count++] = t->model[k];
    t->count = count;
}

hci_status hci_search_forward_few(hci_search *s, hci_fitted_model *model, double least, bool *added,
                                  hci_note *note)
{
    comparison c = comparison_from(s, model);
    hci_candidate_models t;
    c.least = least;
    hci_status status = hci_candidate_models_make(s, &model->candidates, true, &t, note);
    *added = false;
    if (status) return status;
    loose_leave(&t);
    status = models_enter(&c, &t, note);
    hci_candidate_models_release(&t);
    *added = !status && c.best.candidates.candidate;
    if (*added) hci_fitted_model_replace(model, &c.best);
    hci_fitted_model_release(&c.best);
    return status;
}
