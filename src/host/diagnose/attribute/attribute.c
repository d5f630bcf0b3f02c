#include "host/diagnose/attribute/attribute.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/attribute/settle.h"
#include "host/diagnose/candidates/creeping_angle.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/candidates/slip.h"
#include "host/diagnose/fit/standard_errors.h"
#include "host/diagnose/search/backward.h"
#include "host/diagnose/search/belief.h"
#include "host/diagnose/search/brakes.h"
#include "host/diagnose/search/candidate_models.h"
#include "host/diagnose/search/coenergy.h"
#include "host/diagnose/search/companions.h"
#include "host/diagnose/search/no_load.h"
#include "host/diagnose/search/noise_left.h"
#include "host/diagnose/search/phases.h"
#include "host/diagnose/search/rivals.h"
#include "host/diagnose/search/rounds.h"
#include "host/diagnose/search/scaled.h"
#include "host/diagnose/search/stability.h"

#define RATIO       1e-3 /* change of the torque per ampere, as a share, that an inertia may be wrong by */
#define MOST_LEFT   0.5  /* of all torque: more of it has another cause than an effect */
#define EQUAL_SHARE 0.2  /* of their mean, by which values of three phases may differ and are equal */

/* ---- verdicts ---- */

/* Terms of the whole co-energy stand for each other, and single ones of other effects for some of them: what
 * was asked of them is how well they describe runs left out together. */
static bool is_of_whole(const hci_search *s, const hci_effect_type *type)
{
    return s->whole_coenergy && type->propose_coenergy;
}

/* Where something is not known, effects may be a part of it; not those of the runs without a current, unless
 * what these show is left out as well. */
static bool is_beside_unknown(const hci_attribution *a)
{
    return a->unknown && (a->slip || !a->no_load_alone);
}

/* What speaks for an effect that is in, and which others could stand in its place. */
static hci_status verdict_of(hci_search *s, hci_attribution *a, hci_verdict *v, hci_note *note)
{
    hci_fitted_model without = {0};
    v->in = true;
    hci_status status = hci_search_without(s, &a->model, v->type, &without, note);
    if (status) return status;
    v->gain = s->whole_coenergy ? hci_fit_effective_score(&without.fit, &without.candidates) -
                                      hci_fit_effective_score(&a->model.fit, &a->model.candidates)
                                : without.fit.score - a->model.fit.score;
    status = hci_search_explained(s, &a->model.candidates, &without.candidates, &v->explained_Nm, note);
    hci_fitted_model_release(&without);
    v->compared = is_of_whole(s, v->type);
    if (status || is_beside_unknown(a) || v->compared || hci_search_is_over(s)) return status;
    status = hci_search_rivals(s, v->type, a, note);
    v->compared = !hci_search_is_over(s);
    return status;
}

/* By how much those that are not in would lower the score. */
static hci_status verdicts_of_others(hci_search *s, hci_attribution *a, hci_note *note)
{
    hci_candidate_models t;
    const hci_status status = hci_candidate_models_make(s, &a->model.candidates, false, &t, note);
    for (size_t k = 0; k < t.count && !status; ++k) {
        hci_verdict *v = &a->verdict[t.model[k].a];
        if (!v->in && !v->ambiguous) v->gain = t.model[k].gain;
    }
    hci_candidate_models_release(&t);
    return status;
}

/* Where the angle begins is a convention once the phases of a torque are free. */
static bool is_convention(const hci_effect_type *type, const hci_effect_type *as)
{
    return type->is_angle_zero && as->any_phase;
}

static size_t verdict_at(const hci_attribution *a, const hci_effect_type *type)
{
    size_t k = 0;
    while (a->verdict[k].type != type)
        ++k;
    return k;
}

/* Marks a type that stands in place of another as well, with the values that it would have there. */
static hci_status rival_mark(hci_search *s, hci_attribution *a, size_t type, const hci_effect_type *as,
                             hci_note *note)
{
    hci_verdict *v = &a->verdict[type], *other = &a->verdict[verdict_at(a, as)];
    v->ambiguous = other->ambiguous = true;
    v->rival_of = as;
    v->gain = other->gain;
    if (hci_search_is_over(s)) return HCI_OK;
    hci_fitted_model_release(&v->alternative);
    const hci_status status = hci_search_instead(s, &a->model, as, v->type, &v->alternative, note);
    if (!status && v->alternative.candidates.candidate)
        v->gain -= v->alternative.fit.score - a->model.fit.score;
    return status;
}

/* Whether what was to stand in that place cannot: without a model it is only known where a torque per ampere
 * is that it would not have. */
static bool is_contradicted(hci_search *s, const hci_attribution *a, const hci_verdict *v, bool driving)
{
    if (!v->alternative.candidates.candidate) return s->options->constant_is_known && !hci_search_is_over(s);
    return driving || !(v->alternative.fit.score < a->model.fit.score + HCI_DECISIVE);
}

/* The same, unless the recordings contradict it in that place, where what brakes would drive as well: means
 * of a few runs may look alike in sum where one run alone, such as one without a current, tells the two
 * apart. */
static hci_status rival_mark_unless_worse(hci_search *s, hci_attribution *a, size_t type,
                                          const hci_effect_type *as, hci_note *note)
{
    hci_verdict *v = &a->verdict[type], *other = &a->verdict[verdict_at(a, as)];
    const bool was_ambiguous = other->ambiguous;
    bool driving = false;
    hci_status status = rival_mark(s, a, type, as, note);
    if (!status && v->alternative.candidates.candidate)
        status = hci_brakes_drive(s->regression, &v->alternative.candidates, v->type, &driving, note);
    if (status || !is_contradicted(s, a, v, driving)) return status;
    v->ambiguous = false;
    v->rival_of = NULL;
    other->ambiguous = was_ambiguous;
    hci_fitted_model_release(&v->alternative);
    return HCI_OK;
}

/* Marks a type that looks the same as a part of another, unless it would explain nothing without that. */
static hci_status same_mark(hci_search *s, hci_attribution *a, size_t type, const hci_effect_type *as,
                            hci_note *note)
{
    const hci_verdict *v = &a->verdict[type];
    if (v->in || v->ambiguous || !a->plausible[verdict_at(a, as)][type] || is_convention(v->type, as))
        return HCI_OK;
    if (v->type->seen_as || as->seen_as == v->type) return HCI_OK;
    return rival_mark_unless_worse(s, a, type, as, note);
}

/* Effects that look the same as a part of one that is in. */
static hci_status verdicts_of_same(hci_search *s, hci_attribution *a, hci_note *note)
{
    const hci_effect_type *same_as[HCI_MOST_TYPES];
    if (is_beside_unknown(a)) return HCI_OK;
    hci_status status = hci_candidate_models_same(s, &a->model.candidates, same_as, note);
    for (size_t r = 0; r < a->types && !status; ++r)
        if (same_as[r] && !is_of_whole(s, same_as[r])) status = same_mark(s, a, r, same_as[r], note);
    return status;
}

/* Whether three values, one a phase, are the same within a share of their mean. */
static bool are_equal(const hci_candidates *model, const hci_effect_type *type)
{
    double sum = 0.0, least = INFINITY, most = -INFINITY;
    size_t count = 0;
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        for (size_t j = 0; x->in && x->type == type && j < x->count; ++j, ++count) {
            sum += x->term[j].value;
            least = fmin(least, x->term[j].value);
            most = fmax(most, x->term[j].value);
        }
    }
    return count == 3 && most - least < EQUAL_SHARE * fabs(sum / 3.0);
}

/* Equal gains of all phases are a back-EMF of another size, and sensors that are wrong alike are rare. */
static hci_status verdicts_of_equal(hci_search *s, hci_attribution *a, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t r = 0; r < a->types && !status; ++r) {
        hci_verdict *v = &a->verdict[r];
        const hci_effect_type *other = v->type->when_equal;
        if (!v->in || !other || !are_equal(&a->model.candidates, v->type)) continue;
        const size_t k = verdict_at(a, other);
        v->ambiguous = a->verdict[k].ambiguous = true;
        if (!a->verdict[k].in) status = rival_mark(s, a, k, v->type, note);
    }
    return status;
}

/* What was told apart and what was not, before an effect left, is asked anew. */
static void ambiguities_forget(hci_attribution *a)
{
    for (size_t r = 0; r < a->types; ++r) {
        a->verdict[r].ambiguous = false;
        a->verdict[r].rival_of = NULL;
        hci_fitted_model_release(&a->verdict[r].alternative);
    }
}

/* What an effect has to explain beside the others. What runs without a current show by themselves proves
 * itself, unless the sensor that read it lags or swings: then only what that leaves besides. */
static double least_beside(const hci_search *s, const hci_attribution *a, const hci_verdict *v)
{
    if (v->established) return hci_companion_of_sensor(a, v);
    const double linear = is_of_whole(s, v->type) ? 0.0 : hci_companion_of_series(s->regression, a, v);
    return fmax(linear, hci_companion_least(s->regression, a, v));
}

/* What an effect that is in explains, as a share of what it must beside the others; those that prove
 * themselves: INFINITY. */
static double share_of_least(const hci_search *s, const hci_attribution *a, const hci_verdict *v)
{
    if (!v->in || v->type == &hci_empirical_type) return INFINITY;
    const double least = least_beside(s, a, v);
    return least > 0.0 && v->gain < least ? v->gain / least : (double)INFINITY;
}

/* The effect beside such others that the recordings ask for least of those that they do not ask for. */
static hci_status companions_leave(hci_search *s, hci_attribution *a, bool *left, hci_note *note)
{
    hci_verdict *least = NULL;
    double share = INFINITY;
    for (size_t r = 0; r < a->types; ++r) {
        const double x = share_of_least(s, a, &a->verdict[r]);
        if (!(x < share)) continue;
        share = x;
        least = &a->verdict[r];
    }
    *left = least != NULL;
    if (!least) return HCI_OK;
    hci_candidates_remove_type(&a->model.candidates, least->type);
    ambiguities_forget(a);
    least->in = false;
    return hci_search_renew(s, &a->model, note);
}

/* Free shafts show torque per ampere and inertia as their ratio only: what changes the one is as well a wrong
 * inertia. */
static hci_status verdicts_of_ratio(hci_search *s, hci_attribution *a, hci_note *note)
{
    double with = 1.0, without = 1.0;
    if (!hci_are_free_shafts(s->regression)) return HCI_OK;
    hci_status status = hci_search_constant_share(s, &a->model.candidates, &with, note);
    for (size_t r = 0; r < a->types && !status; ++r) {
        hci_candidates rest = {0};
        if (!a->verdict[r].in) continue;
        status = hci_candidates_copy(&a->model.candidates, &rest, note);
        if (!status) hci_candidates_remove_type(&rest, a->verdict[r].type);
        if (!status) status = hci_search_constant_share(s, &rest, &without, note);
        hci_candidates_release(&rest);
        if (status || !(fabs(with - without) > RATIO)) continue;
        a->verdict[r].ambiguous = a->inertia_as_well = true;
    }
    return status;
}

static hci_status verdicts(hci_search *s, hci_attribution *a, hci_note *note)
{
    hci_status status = HCI_OK;
    bool left = true;
    while (left && !status) {
        for (size_t r = 0; r < a->types && !status; ++r)
            if (hci_candidates_have(&a->model.candidates, a->verdict[r].type))
                status = verdict_of(s, a, &a->verdict[r], note);
        if (!status) status = companions_leave(s, a, &left, note);
    }
    if (!status && !hci_search_is_over(s)) status = verdicts_of_others(s, a, note);
    if (!status && !hci_search_is_over(s)) status = verdicts_of_same(s, a, note);
    if (!status && !hci_search_is_over(s)) status = verdicts_of_equal(s, a, note);
    if (!status && !is_beside_unknown(a)) status = hci_search_phases_mark(a, note);
    if (!status && !a->unknown) status = verdicts_of_ratio(s, a, note);
    return status;
}

/* ---- what stands in the runs without a current ---- */

static void established_mark(hci_attribution *a)
{
    for (size_t r = 0; r < a->types; ++r) {
        const hci_effect_type *type = a->verdict[r].type;
        a->verdict[r].established = hci_candidates_have(&a->no_load.candidates, type) &&
                                    hci_candidates_have(&a->model.candidates, type);
    }
}

/* Goes by the runs without a current alone, where nothing else is understood: what they show is certain,
 * whatever is wrong under load. */
static hci_status no_load_stays(hci_search *s, hci_attribution *a, const bool *use, hci_note *note)
{
    hci_status status = HCI_OK;
    if (a->unknown) status = hci_search_no_load_stays(s, a, note);
    if (status || !a->no_load_alone) return status;
    s->regression->use = use;
    s->regression->free_means = false;
    s->no_current = true;
    return hci_search_renew(s, &a->model, note);
}

/* What is certain beside something unknown, and that this does not make as well. */
static hci_status certain_stays(hci_search *s, hci_attribution *a, const bool *no_load, hci_note *note)
{
    const bool *all = s->regression->use;
    double share = 0.0;
    hci_status status = HCI_OK;
    if (a->unknown) status = hci_search_mean_share(s, &a->model.candidates, &share, note);
    if (!status && a->means_open) status = hci_search_scaled_leave(s, &a->model, share, note);
    if (!status) status = no_load_stays(s, a, no_load, note);
    if (!status && a->no_load_alone && !a->slip) status = hci_search_scaled_leave(s, &a->model, share, note);
    established_mark(a);
    if (status || !a->no_load_alone || hci_candidates_types_in(&a->model.candidates) > 0) return status;
    a->no_load_alone = s->no_current = false;
    s->regression->use = all;
    return hci_search_renew(s, &a->model, note);
}

/* ---- saturated iron ---- */

enum { ENOUGH_RUNS = 6 }; /* to be left out, of which others tell what one shows */

#define FORETOLD    0.01 /* of what effects explain, that they leave in runs left out: a tenth of the error */
#define COARSE      2.0  /* times the resolution: noise that hides more than a model is asked for */
#define LITTLE_LEFT 0.25 /* of the torque that is not explained without the iron */

/* Single terms of the iron may say nothing of runs left out where all of them together do. model: the one
 * before `known`, that had them. */
static hci_status whole_try(hci_search *s, hci_fitted_model *model, hci_fitted_model *known, hci_note *note)
{
    hci_fitted_model single = {0};
    hci_status status = hci_search_renew(s, model, note);
    if (!status) status = hci_fitted_model_copy(model, &single, note);
    if (!status) status = hci_search_coenergy(s, model, note);
    if (!status && s->whole_coenergy) hci_fitted_model_replace(&s->single, &single);
    hci_fitted_model_release(&single);
    if (!status && s->whole_coenergy) status = hci_search_keep_predictive(s, model, note);
    if (!status) status = hci_search_residual(s, &known->candidates, note);
    const double known_Nm = hci_search_residual_rms(s);
    if (!status) status = hci_search_residual(s, &model->candidates, note);
    if (status) return status;
    if (s->whole_coenergy && hci_search_residual_rms(s) < LITTLE_LEFT * known_Nm &&
        hci_search_saturates(&model->candidates)) {
        hci_fitted_model_replace(known, model);
        return HCI_OK;
    }
    s->whole_coenergy = false;
    return hci_search_renew(s, known, note);
}

/* Whether nothing but noise is left, and runs left out are described. */
static hci_status is_all(hci_search *s, hci_fitted_model *model, bool *all, hci_note *note)
{
    double share = 0.0;
    hci_status status = hci_search_is_noise(s, &model->candidates, all, note);
    if (!status) status = hci_search_renew(s, model, note);
    if (status || !*all) return status;
    *all = hci_regression_runs_in_use(s->regression) >= ENOUGH_RUNS;
    if (*all) status = hci_search_unpredicted(s, &model->candidates, &share, note);
    *all = *all && share < FORETOLD;
    return status;
}

/* Where single terms leave nothing but coarse noise, in runs left out too, the recordings ask for no more.
 * Keeps the model with these, which may say of runs left out what the whole co-energy does not. */
static hci_status coenergy_try(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_fitted_model single = {0};
    hci_status status = HCI_OK;
    bool asks_no_more = false;
    if (hci_search_noise_rms(s) > COARSE * s->resolution_Nm) status = is_all(s, model, &asks_no_more, note);
    if (status || asks_no_more) return status;
    status = hci_fitted_model_copy(model, &single, note);
    if (!status) status = hci_search_coenergy(s, model, note);
    if (!status && s->whole_coenergy) hci_fitted_model_replace(&s->single, &single);
    hci_fitted_model_release(&single);
    return status;
}

/* Leaves out what says nothing of runs left out, and takes the whole co-energy in place of single terms. */
static hci_status predictive_find(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_fitted_model before = {0};
    hci_status status = hci_fitted_model_copy(model, &before, note);
    if (!status) status = hci_search_keep_predictive(s, model, note);
    if (!status && !hci_search_is_over(s)) {
        if (hci_search_saturates(&before.candidates) && !hci_search_saturates(&model->candidates))
            status = whole_try(s, &before, model, note);
        else
            status = coenergy_try(s, model, note);
    }
    hci_fitted_model_release(&before);
    return status;
}

/* ---- the whole ---- */

/* Whether the machine leaves most of all torque, which no effect corrects that is believed. */
static hci_status is_of_another(hci_search *s, const hci_fitted_model *model, bool *other, hci_note *note)
{
    const hci_status status = hci_search_residual(s, &model->candidates, note);
    double left = 0.0, whole = 0.0;
    for (const hci_segment *x = NULL; !status && (x = hci_regression_next(s->regression, x)) != NULL;)
        for (size_t j = x->first; j < x->first + x->count; ++j) {
            left += pow(s->residual_Nm[j], 2.0);
            whole += pow(s->regression->samples->sample[j].torque_Nm, 2.0);
        }
    *other = !status && whole > 0.0 && left > MOST_LEFT * MOST_LEFT * whole;
    return status;
}

/* Where a slip is so plain that there is nothing to be looked for. */
static hci_status slip_judge(hci_search *s, hci_attribution *a, hci_note *note)
{
    bool opposite = false;
    hci_status status = hci_search_opposite(s, &opposite, note);
    if (!status && a->slip) status = is_of_another(s, &a->model, &a->unknown, note);
    if (opposite) a->unknown = true;
    if (opposite && !a->slip) a->slip = hci_slip_of_load();
    return status;
}

/* What no effect makes, such as swapped phases, is not looked for among them. */
static hci_status convention_judge(hci_search *s, hci_attribution *a, hci_note *note)
{
    const hci_fitted_model none = {0};
    const hci_binned_samples *samples = s->regression->samples;
    bool other = false;
    hci_status status = HCI_OK;
    hci_search_begin(s, "looking for slips of the recordings", 0.0, 0.0);
    a->slip = hci_creeping_angle(s->regression->machine, samples->statistics, samples->run_count);
    if (!a->slip) status = hci_search_residual(s, &none.candidates, note);
    if (!a->slip && !status)
        a->slip = hci_slip_of_size(samples, s->regression->runs, s->regression->use, s->residual_Nm);
    if (!a->slip && !status && s->options->slip) status = is_of_another(s, &none, &other, note);
    if (other) a->slip = s->options->slip(s->options->slip_context);
    a->not_searched = a->unknown = a->slip != NULL;
    return status;
}

/* From the model of the runs without a current to what is judged. */
static hci_status model_find(hci_search *s, hci_attribution *a, hci_note *note)
{
    hci_status status = hci_search_rounds(s, &a->model, note);
    if (!status) status = hci_search_without_denied(s, &a->model, note);
    if (!status && s->options->only_complete && hci_search_is_over(s)) status = HCI_ERROR_STOPPED;
    if (status) return status;
    hci_search_begin(s, "weighing the evidence", HCI_ROUNDS_SHARE, 1.0);
    s->judging = s->ended == HCI_WORK_COMPLETE;
    status = predictive_find(s, &a->model, note);
    for (bool dropped = s->whole_coenergy; dropped && !status;)
        status = hci_search_drop(s, &a->model, &dropped, note);
    if (s->whole_coenergy && !status) status = hci_search_keep_predictive(s, &a->model, note);
    s->judging = true;
    if (!status) status = hci_search_drop_unsure(s, &a->model, note);
    return status ? status : hci_search_settle(s, a, note);
}

/* ---- holding tests ---- */

static bool any_is_held(const hci_regression *e)
{
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (e->use[r] && e->runs[r].torque_source == HCI_TORQUE_HOLDING) return true;
    return false;
}

/* The cogging torque that a slip makes leaves: what was declared is there, or nothing of it is. */
static hci_status held_judge(hci_search *s, hci_attribution *a, hci_note *note)
{
    if (a->slip || a->unknown || s->ended != HCI_WORK_COMPLETE || !any_is_held(s->regression)) return HCI_OK;
    a->slip = hci_slip_of_cogging(s->regression->machine, &a->model.candidates, true);
    if (!a->slip) return HCI_OK;
    a->unknown = true;
    for (size_t r = 0; r < a->types; ++r)
        if (a->verdict[r].type->any_phase && a->verdict[r].type->propose_coenergy)
            hci_candidates_remove_type(&a->model.candidates, a->verdict[r].type);
    hci_status status = hci_search_residual(s, &a->model.candidates, note);
    const double left_Nm = hci_search_residual_rms(s), noise_Nm = hci_search_noise_rms(s);
    a->unexplained_Nm = sqrt(fmax(0.0, left_Nm * left_Nm - noise_Nm * noise_Nm));
    return status;
}

/* Goes on from what another search has found. */
static hci_status start_take(const hci_search *s, hci_attribution *a, hci_note *note)
{
    const hci_candidates *start = s->options->start;
    if (!start || hci_candidates_types_in(start) == 0) return HCI_OK;
    hci_fitted_model_release(&a->model);
    return hci_candidates_copy(start, &a->model.candidates, note);
}

/* no_load: out, [runs], those without a current. */
static hci_status attribute(hci_search *s, hci_attribution *a, bool *no_load, hci_note *note)
{
    hci_candidates none = {0};
    hci_status status = convention_judge(s, a, note);
    if (!status && !a->not_searched) status = hci_search_no_load(s, no_load, a, note);
    s->from_no_load = hci_candidates_types_in(&a->model.candidates) > 0;
    if (!status && !a->not_searched) status = slip_judge(s, a, note);
    if (!status && !a->unknown) status = start_take(s, a, note);
    if (!status && !a->unknown) status = model_find(s, a, note);
    if (!status) status = held_judge(s, a, note);
    if (!status) status = certain_stays(s, a, no_load, note);
    if (!status && !a->not_searched) status = verdicts(s, a, note);
    if (!status) status = hci_search_stability(s, a, note);
    if (!status) status = hci_regression_standard_errors(s->regression, &a->model.candidates, note);
    if (!status) status = hci_regression_fit(s->regression, &none, &a->before, note);
    s->regression->free_means = false;
    a->ended = s->ended;
    a->magnetic_only = s->magnetic_only;
    return status;
}

hci_status hci_attribute(hci_regression *regression, const hci_attribute_options *options,
                         hci_attribution *attribution, hci_note *note)
{
    const size_t samples = regression->samples->count;
    hci_search s = {.regression = regression, .options = options, .richness = 1};
    memset(attribution, 0, sizeof *attribution);
    attribution->types = hci_candidate_types();
    assert(attribution->types <= HCI_MOST_TYPES);
    for (size_t r = 0; r < attribution->types; ++r)
        attribution->verdict[r].type = hci_candidate_type(r);
    s.residual_Nm = hci_memory_new(2 * samples + 1, sizeof *s.residual_Nm);
    bool *no_load = hci_memory_new(regression->samples->run_count + 1, sizeof *no_load);
    if (!s.residual_Nm || !no_load) {
        hci_memory_free(s.residual_Nm);
        hci_memory_free(no_load);
        return hci_note_memory(note, NULL, "the search of effects");
    }
    s.variance = s.residual_Nm + samples;
    const bool *all = regression->use;
    const hci_status status = attribute(&s, attribution, no_load, note);
    regression->use = all;
    hci_memory_free(no_load);
    hci_memory_free(s.residual_Nm);
    hci_known_residuals_release(&s.residuals);
    hci_fitted_model_release(&s.disbelieved.model);
    hci_fitted_model_release(&s.single);
    if (status) hci_attribution_release(attribution);
    return status;
}

void hci_attribution_release(hci_attribution *a)
{
    for (size_t r = 0; r < a->types; ++r)
        hci_fitted_model_release(&a->verdict[r].alternative);
    hci_fitted_model_release(&a->model);
    hci_fitted_model_release(&a->no_load);
    memset(a, 0, sizeof *a);
}
