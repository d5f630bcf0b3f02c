#include "host/diagnose/search/backward.h"

#include <math.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/fit/linearise.h"
#include "host/diagnose/fit/standard_errors.h"
#include "host/diagnose/search/brakes.h"

/* ---- single orders ---- */

/* The moments as they are about the declared values, to which what leaves goes back. */
static void moments_shift(const hci_candidates *model, const hci_normal_equations *normal, double *moment)
{
    for (size_t k = 0, c = 0; k < model->count; ++k)
        for (size_t j = 0; model->candidate[k].in && j < model->candidate[k].count; ++j, ++c)
            for (size_t i = 0; i < normal->n; ++i)
                moment[i] +=
                    normal->gram[i * normal->n + c] * hci_candidate_departure(&model->candidate[k], j);
}

/* The solution with all columns, but for those that depend on others. */
static bool solve_all(hci_sweep *sweep, const hci_candidates *model, const hci_normal_equations *normal)
{
    if (!hci_sweep_start(sweep, normal)) return false;
    moments_shift(model, normal, sweep->b);
    for (size_t c = 0; c < normal->n; ++c)
        hci_sweep_in(sweep, c);
    return true;
}

/* Candidates that leave one after the other. */
typedef struct {
    size_t *index, count;
} leaving_list;

static bool has_left(const leaving_list *l, size_t k)
{
    for (size_t j = 0; j < l->count; ++j)
        if (l->index[j] == k) return true;
    return false;
}

/* The one whose leaving would lower the score most, of those that have not left, and its first column; the
 * number of candidates where none would. */
static size_t superfluous(const hci_candidates *model, const hci_sweep *sweep, double rows,
                          const leaving_list *left, size_t *column)
{
    size_t worst = model->count;
    double least = 0.0;
    for (size_t k = 0, c = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        if (!x->in) continue;
        const double gain = hci_sweep_reduction(sweep, c, x->count) - hci_candidate_cost(x, rows);
        if (gain < least && !has_left(left, k)) {
            least = gain;
            worst = k;
            *column = c;
        }
        c += x->count;
    }
    return worst;
}

static hci_status superfluous_find(hci_search *s, const hci_candidates *model, leaving_list *leave,
                                   hci_note *note)
{
    hci_normal_equations normal;
    hci_sweep sweep = {0};
    size_t column = 0;
    hci_status status = hci_regression_normal(s->regression, model, false, &normal, note);
    if (status) return status;
    if (!solve_all(&sweep, model, &normal)) status = hci_note_memory(note, NULL, "the search of effects");
    for (size_t k; !status && (k = superfluous(model, &sweep, normal.rows, leave, &column)) < model->count;) {
        for (size_t j = 0; j < model->candidate[k].count; ++j)
            hci_sweep_out(&sweep, column + j);
        leave->index[leave->count++] = k;
    }
    hci_sweep_release(&sweep);
    hci_normal_equations_release(&normal);
    return status;
}

/* Leaves so many candidates out where a fit is as good without. */
static hci_status leave_try(hci_search *s, hci_fitted_model *model, const size_t *leave, size_t count,
                            bool *left, hci_note *note)
{
    hci_fitted_model without = {0};
    hci_status status = hci_fitted_model_copy(model, &without, note);
    if (status) return status;
    for (size_t k = 0; k < count; ++k)
        without.candidates.candidate[leave[k]].in = false;
    status = hci_regression_fit_below(s->regression, &without.candidates, model->fit.score + HCI_AS_GOOD,
                                      &without.fit, note);
    *left = !status && without.fit.score <= model->fit.score + HCI_AS_GOOD;
    if (*left) hci_fitted_model_replace(model, &without);
    hci_fitted_model_release(&without);
    return status;
}

/* All that the equations call superfluous, or the one that is most. left: out, whether any has left. */
static hci_status superfluous_leave(hci_search *s, hci_fitted_model *model, bool *left, hci_note *note)
{
    leaving_list leave = {hci_memory_new(model->candidates.count + 1, sizeof *leave.index), 0};
    *left = false;
    if (!leave.index) return hci_note_memory(note, NULL, "the search of effects");
    hci_status status = superfluous_find(s, &model->candidates, &leave, note);
    if (!status && leave.count > 1) status = leave_try(s, model, leave.index, leave.count, left, note);
    if (!status && !*left && leave.count > 0) status = leave_try(s, model, leave.index, 1, left, note);
    hci_memory_free(leave.index);
    return status;
}

/* Beside another brake the law of friction has no further powers of the speed that are not asked for: as many
 * values as there are speeds tell nothing of a run of another one. */
static hci_status powers_leave(hci_search *s, hci_fitted_model *model, size_t k, hci_note *note)
{
    const hci_candidate *x = &model->candidates.candidate[k];
    hci_status status = HCI_OK;
    bool left = x->in && hci_brakes_have_other(&model->candidates, x->type);
    while (!status && left && hci_brakes_has_further_power(&model->candidates.candidate[k])) {
        hci_fitted_model without = {0};
        status = hci_fitted_model_copy(model, &without, note);
        if (status) return status;
        hci_candidate_shorten(&without.candidates.candidate[k]);
        status = hci_regression_fit_below(s->regression, &without.candidates, model->fit.score + HCI_AS_GOOD,
                                          &without.fit, note);
        left = !status && without.fit.score <= model->fit.score + HCI_AS_GOOD;
        if (left) hci_fitted_model_replace(model, &without);
        hci_fitted_model_release(&without);
    }
    return status;
}

hci_status hci_search_prune(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_status status = HCI_OK;
    for (bool again = true; again && !status && !hci_search_is_over(s);)
        status = superfluous_leave(s, model, &again, note);
    for (size_t k = 0; k < model->candidates.count && !status; ++k)
        status = powers_leave(s, model, k, note);
    return status;
}

/* ---- effects ---- */

static hci_status drop_type(hci_search *s, hci_fitted_model *model, const hci_effect_type *type,
                            bool *dropped, hci_note *note)
{
    hci_fitted_model without = {0};
    bool noticeable = true;
    hci_status status = hci_fitted_model_copy(model, &without, note);
    if (status) return status;
    hci_search_tell(s);
    hci_candidates_remove_type(&without.candidates, type);
    status = hci_regression_fit_below(s->regression, &without.candidates, model->fit.score + HCI_DECISIVE,
                                      &without.fit, note);
    if (!status)
        status = hci_search_noticeable(s, &model->candidates, &without.candidates, &noticeable, note);
    *dropped = !status && (without.fit.score < model->fit.score + HCI_DECISIVE || !noticeable);
    if (*dropped) {
        hci_fitted_model_replace(model, &without);
        status = hci_search_renew(s, model, note);
    }
    hci_fitted_model_release(&without);
    return status;
}

/* The effects of the whole co-energy stand or fall together. */
static bool may_leave(const hci_search *s, const hci_fitted_model *model, const hci_effect_type *type)
{
    return hci_candidates_have(&model->candidates, type) && !(s->whole_coenergy && type->propose_coenergy);
}

hci_status hci_search_drop(hci_search *s, hci_fitted_model *model, bool *dropped, hci_note *note)
{
    hci_status status = HCI_OK;
    *dropped = false;
    for (size_t r = 0; r < hci_candidate_types() && !status && !*dropped && !hci_search_is_over(s); ++r)
        if (may_leave(s, model, hci_candidate_type(r)))
            status = drop_type(s, model, hci_candidate_type(r), dropped, note);
    return status;
}

/* ---- effects that noise makes ---- */

/* By how much the strongest order of a type pays its price with its own standard errors; terms of a friction
 * or an imbalance that come three at a time say little one by one, and are not asked. */
double hci_search_sureness(const hci_candidates *model, const hci_effect_type *type, double rows)
{
    double most = -INFINITY;
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        double sum = 0.0;
        if (!x->in || x->type != type) continue;
        for (size_t j = 0; j < x->count; ++j)
            sum += x->term[j].std_error > 0.0 ? pow(hci_candidate_departure(x, j) / x->term[j].std_error, 2.0)
                                              : (double)INFINITY;
        most = fmax(most, x->count > 2 ? (double)INFINITY : sum - hci_candidate_cost(x, rows));
    }
    return most;
}

static bool is_asked(const hci_search *s, const hci_fitted_model *model, const hci_effect_type *type)
{
    return may_leave(s, model, type) && type != &hci_empirical_type && !type->is_series;
}

/* The type that is least sure; NULL where all are. */
static const hci_effect_type *unsure_type(const hci_search *s, const hci_fitted_model *model)
{
    const hci_effect_type *unsure = NULL;
    double least = 0.0;
    for (size_t r = 0; r < hci_candidate_types(); ++r) {
        const hci_effect_type *type = hci_candidate_type(r);
        if (!is_asked(s, model, type)) continue;
        const double sure = hci_search_sureness(&model->candidates, type, model->fit.rows);
        if (!(sure < least)) continue;
        least = sure;
        unsure = type;
    }
    return unsure;
}

hci_status hci_search_drop_unsure(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_status status = HCI_OK;
    while (!status && hci_candidates_types_in(&model->candidates) > 0) {
        status = hci_regression_standard_errors(s->regression, &model->candidates, note);
        const hci_effect_type *unsure = status ? NULL : unsure_type(s, model);
        if (!unsure) break;
        hci_candidates_remove_type(&model->candidates, unsure);
        status = hci_search_renew(s, model, note);
    }
    return status;
}
