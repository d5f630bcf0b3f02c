#include "host/diagnose/search/candidate_models.h"

#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/make_candidates.h"
#include "host/diagnose/fit/linearise.h"
#include "host/diagnose/search/belief.h"
#include "host/diagnose/search/group_selection.h"

#define SAME       1e-4  /* share of a column that the model leaves of terms that look the same … */
#define OWN        1e-2  /* … and of those that do not */
#define NOT_IN_USE 1e300 /* variance of samples that carry no information */

/* ---- candidates ---- */

static void variance_set(hci_search *s)
{
    const hci_binned_samples *samples = s->regression->samples;
    for (size_t j = 0; j < samples->count; ++j)
        s->variance[j] = NOT_IN_USE;
    for (const hci_segment *x = NULL; (x = hci_regression_next(s->regression, x)) != NULL;) {
        const double rms = hci_regression_noise(s->regression, x)->rms;
        for (size_t j = x->first; j < x->first + x->count && rms > 0.0; ++j)
            if (samples->sample[j].count > 0.0) s->variance[j] = rms * rms;
    }
}

/* A fresh list of candidates for what the model leaves, the model in it. */
static hci_status candidates_renew(hci_search *s, const hci_candidates *model, hci_candidates *list,
                                   hci_note *note)
{
    const bool saturates = hci_candidates_have_series(model);
    const hci_candidates_source source = {.machine = s->regression->machine,
                                          .declared = s->regression->declared,
                                          .samples = s->regression->samples,
                                          .runs = s->options->runs,
                                          .use = s->regression->use,
                                          .residual_Nm = s->residual_Nm,
                                          .variance = s->variance,
                                          .reference_current_A = s->options->reference_current_A,
                                          .richness = saturates ? s->richness : 0,
                                          .slots = s->options->slots,
                                          .known_only = s->known_only,
                                          .magnetic_only = s->magnetic_only,
                                          .no_current = s->no_current,
                                          .denied = s->denied,
                                          .one_gain = s->one_gain,
                                          .has_neutral = s->options->has_neutral};
    const hci_status status = hci_search_residual(s, model, note);
    if (status) return status;
    variance_set(s);
    return hci_candidates_make(&source, model, list, note);
}

/* ---- models ---- */

/* What the linearised problem is solved with. */
typedef struct {
    hci_selection choice;
    hci_sweep base, sweep;
    size_t *column;
    bool *spare;
} dataset;

static bool dataset_make(const hci_candidates *list, const hci_normal_equations *normal, dataset *b)
{
    memset(b, 0, sizeof *b);
    b->column = hci_memory_new(list->count + 1, sizeof *b->column);
    b->spare = hci_memory_new(list->count + 1, sizeof *b->spare);
    if (!b->column || !b->spare || !hci_sweep_start(&b->base, normal) || !hci_sweep_start(&b->sweep, normal))
        return false;
    b->choice = (hci_selection){list, b->column, &b->base, normal->rows};
    for (size_t k = 0, at = 0; k < list->count; ++k) {
        b->column[k] = at;
        at += list->candidate[k].count;
        if (list->candidate[k].in) hci_selection_enter(&b->choice, &b->base, k);
    }
    return true;
}

static void bench_release(dataset *b)
{
    hci_sweep_release(&b->base);
    hci_sweep_release(&b->sweep);
    hci_memory_free(b->column);
    hci_memory_free(b->spare);
}

/* By how much the score falls since the laws of a type that are in have more terms than the model has. Laws
 * begin with the same terms. */
static double growth_gain(const hci_selection *choice, const hci_effect_type *type)
{
    double gain = 0.0;
    for (size_t k = 0; k < choice->list->count; ++k) {
        hci_candidate more = choice->list->candidate[k];
        const size_t from = more.grown_from;
        if (more.type != type || from == 0) continue;
        more.count -= from;
        more.price = 0.0; /* paid by those that are in */
        gain += hci_sweep_reduction(choice->base, choice->column[k] + from, more.count) -
                hci_candidate_cost(&more, choice->rows);
    }
    return gain;
}

static void model_add(hci_candidate_models *t, dataset *b, size_t type_a, size_t type_b)
{
    hci_candidate_model *x = &t->model[t->count];
    *x = (hci_candidate_model){type_a, type_b, 0.0, t->flags + t->count * (t->list.count + 1), 0};
    x->gain = hci_group_select(&b->choice, hci_candidate_type(type_a), hci_candidate_type(type_b), x->in,
                               &b->sweep, b->spare);
    if (type_a == type_b) x->gain += growth_gain(&b->choice, hci_candidate_type(type_a));
    for (size_t k = 0; k < t->list.count; ++k)
        x->terms += x->in[k] ? t->list.candidate[k].count : 0;
    ++t->count;
}

static hci_status models_fill(hci_search *s, hci_candidate_models *t, const hci_normal_equations *normal,
                              bool pairs, hci_note *note)
{
    const size_t types = hci_candidate_types();
    dataset b;
    t->flags = hci_memory_new((t->list.count + 1) * HCI_MOST_CANDIDATE_MODELS, sizeof *t->flags);
    const bool made = dataset_make(&t->list, normal, &b) && t->flags;
    for (size_t type_a = 0; made && type_a < types; ++type_a) {
        hci_search_tell(s);
        for (size_t type_b = type_a; type_b < (pairs ? types : type_a + 1); ++type_b)
            model_add(t, &b, type_a, type_b);
    }
    bench_release(&b);
    return made ? HCI_OK : hci_note_memory(note, NULL, "the search of effects");
}

hci_status hci_candidate_models_make(hci_search *s, const hci_candidates *model, bool pairs,
                                     hci_candidate_models *t, hci_note *note)
{
    hci_normal_equations normal;
    memset(t, 0, sizeof *t);
    hci_status status = candidates_renew(s, model, &t->list, note);
    if (status) return status;
    status = hci_regression_normal(s->regression, &t->list, true, &normal, note);
    if (!status) status = models_fill(s, t, &normal, pairs, note);
    hci_normal_equations_release(&normal);
    if (status) hci_candidate_models_release(t);
    return status;
}

/* ---- terms that look the same ---- */

/* Whether a sweep leaves less than a share of all columns of a candidate, what is expected of them aside. */
static bool is_within(const dataset *b, const hci_sweep *sweep, size_t candidate, double share)
{
    for (size_t j = 0; j < b->choice.list->candidate[candidate].count; ++j) {
        const size_t c = b->column[candidate] + j;
        const double expected = b->choice.list->candidate[candidate].deviation;
        const double prior = expected > 0.0 ? 1.0 / (expected * expected) : 0.0;
        const double whole = sweep->diagonal[c] - prior, rest = sweep->a[c * sweep->n + c] - prior;
        if (!(whole > 0.0) || rest > share * whole) return false;
    }
    return true;
}

/* The type in the model without which the candidate would stand on its own; NULL: none. */
static const hci_effect_type *stands_for(dataset *b, size_t candidate)
{
    const hci_candidates *list = b->choice.list;
    for (size_t r = 0; r < hci_candidate_types(); ++r) {
        const hci_effect_type *type = hci_candidate_type(r);
        if (!hci_candidates_have(list, type)) continue;
        hci_sweep_copy(&b->sweep, &b->base);
        for (size_t k = 0; k < list->count; ++k)
            for (size_t j = 0; j < list->candidate[k].count && list->candidate[k].type == type; ++j)
                hci_sweep_out(&b->sweep, b->column[k] + j);
        if (!is_within(b, &b->sweep, candidate, OWN)) return type;
    }
    return NULL;
}

static void same_find(dataset *b, const hci_effect_type *same_as[HCI_MOST_TYPES])
{
    const hci_candidates *list = b->choice.list;
    for (size_t k = 0; k < list->count; ++k) {
        size_t r = 0;
        while (hci_candidate_type(r) != list->candidate[k].type)
            ++r;
        if (same_as[r] || hci_candidates_have(list, list->candidate[k].type)) continue;
        if (is_within(b, &b->base, k, SAME)) same_as[r] = stands_for(b, k);
    }
}

hci_status hci_candidate_models_same(hci_search *s, const hci_candidates *model,
                                     const hci_effect_type *same_as[HCI_MOST_TYPES], hci_note *note)
{
    hci_candidates list = {0};
    hci_normal_equations normal = {0};
    dataset b;
    hci_status status = candidates_renew(s, model, &list, note);
    memset(same_as, 0, HCI_MOST_TYPES * sizeof *same_as);
    if (!status) status = hci_regression_normal(s->regression, &list, true, &normal, note);
    if (!status) {
        if (dataset_make(&list, &normal, &b))
            same_find(&b, same_as);
        else
            status = hci_note_memory(note, NULL, "the search of effects");
        bench_release(&b);
    }
    hci_normal_equations_release(&normal);
    hci_candidates_release(&list);
    return status;
}

void hci_candidate_models_release(hci_candidate_models *t)
{
    hci_candidates_release(&t->list);
    hci_memory_free(t->flags);
    memset(t, 0, sizeof *t);
}

hci_status hci_candidate_model_fit(hci_search *s, const hci_candidate_models *t, const hci_candidate_model *x,
                                   double bar, hci_fitted_model *fitted, hci_note *note)
{
    memset(fitted, 0, sizeof *fitted);
    hci_status status = hci_candidates_copy(&t->list, &fitted->candidates, note);
    for (size_t k = 0; k < fitted->candidates.count && !status; ++k)
        fitted->candidates.candidate[k].in = fitted->candidates.candidate[k].in || x->in[k];
    if (!status) status = hci_search_fit_below(s, fitted, bar, note);
    if (status) hci_fitted_model_release(fitted);
    return status;
}
