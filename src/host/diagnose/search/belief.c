#include "host/diagnose/search/belief.h"

#include <math.h>

#include "host/diagnose/fit/cancelling.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/fit/unlike_iron.h"
#include "host/diagnose/search/brakes.h"
#include "host/machine/torque_constant.h"

#define LEAST_CONSTANT 0.5  /* of the torque per ampere that is declared: a correction leaves no less */
#define LARGEST_DEFECT 3.0  /* of a sensor, in units of what is expected of such a defect */
#define HIDDEN         0.2  /* of a torque, that a resonance leaves of one that does not show */
#define NEARLY         0.9  /* of what a model explains: another one that explains as much is as good */
#define HARDLY         0.1  /* acceleration beside a residual, that is next to none */
#define ROUNDING       1e-6 /* of the torque per ampere, that is none */

/* The time of a turn of the slowest run in use that turns; infinite where none does. */
static double longest_turn_s(const hci_regression *e)
{
    double slowest = INFINITY;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        const double speed = fabs(e->samples->statistics[r].mean_speed_rad_per_s);
        if (e->use[r] && speed > 0.0) slowest = fmin(slowest, speed);
    }
    return isfinite(slowest) ? 2.0 * HCI_PI / slowest : (double)INFINITY;
}

/* The longest lag of a sensor, or of a resonance so damped that it is one: 2ζ/ω_n. */
static double lag_of(const hci_candidate *x)
{
    const size_t *resonance = x->type->resonance;
    double lag_s = 0.0, frequency_Hz = INFINITY, damping = 0.0;
    for (size_t j = 0; j < x->count; ++j) {
        const hci_effect_term *t = &x->term[j];
        if (x->type->parameter[t->parameter].traits & HCI_PARAMETER_LAG) lag_s = fmax(lag_s, t->value);
        if (resonance && t->parameter == resonance[0]) frequency_Hz = t->value;
        if (resonance && t->parameter == resonance[1]) damping = t->value;
    }
    return fmax(lag_s, damping / (HCI_PI * frequency_Hz));
}

/* The frequency of the largest cogging torque that is declared, in the slowest run; 0: none is. */
static double cogging_frequency_Hz(const hci_regression *e)
{
    const hci_machine *m = e->machine;
    double largest_Nm = 0.0, order = 0.0;
    for (size_t k = 0; k < m->cogging_count; ++k) {
        const double amplitude_Nm = hypot(m->cogging[k].sine, m->cogging[k].cosine);
        if (!(amplitude_Nm > largest_Nm)) continue;
        largest_Nm = amplitude_Nm;
        order = m->cogging[k].order;
    }
    return order * m->pole_pairs / longest_turn_s(e);
}

/* Whether a resonance leaves nothing of the declared cogging torque in any run: then there may as well be
 * none. */
static bool hides_cogging(const hci_regression *e, const hci_candidate *x)
{
    const size_t *resonance = x->type->resonance;
    double frequency_Hz = INFINITY;
    for (size_t j = 0; resonance && j < x->count; ++j)
        if (x->term[j].parameter == resonance[0]) frequency_Hz = x->term[j].value;
    if (!isfinite(frequency_Hz)) return false;
    const double times = cogging_frequency_Hz(e) / frequency_Hz;
    return times * times > 1.0 + 1.0 / HIDDEN;
}

/* Behind a lag of more than a turn a sensor shows nothing of any torque, as if there were none. */
static bool is_large_defect(const hci_regression *e, const hci_candidate *x)
{
    for (size_t j = 0; j < x->count && x->type->is_small && x->deviation > 0.0; ++j)
        if (fabs(hci_candidate_departure(x, j)) > LARGEST_DEFECT * x->deviation) return true;
    return lag_of(x) > longest_turn_s(e) || hides_cogging(e, x);
}

/* A defect that nobody would have left unnoticed; their number: none. */
static size_t large_defect(const hci_regression *e, const hci_candidates *candidates)
{
    size_t k = 0;
    while (k < candidates->count &&
           !(candidates->candidate[k].in && is_large_defect(e, &candidates->candidate[k])))
        ++k;
    return k;
}

hci_status hci_search_constant_share(const hci_search *s, const hci_candidates *candidates, double *share,
                                     hci_note *note)
{
    const hci_regression *e = s->regression;
    const double declared = e->declared_constant;
    hci_model model;
    *share = 1.0;
    if (!(declared > 0.0)) return HCI_OK;
    const hci_status status = hci_model_make(e->declared, candidates, false, &model, note);
    if (status) return status;
    *share = hci_torque_constant(e->machine, &model.list) / declared;
    if (fabs(*share) < ROUNDING) *share = 0.0;
    hci_model_release(&model);
    return HCI_OK;
}

/* Whether a share of the declared torque per ampere is one that may be. */
static bool is_constant_believed(const hci_search *s, double share)
{
    return share >= LEAST_CONSTANT &&
           !(s->options->constant_is_known && fabs(share - 1.0) > HCI_CONSTANT_OFF);
}

/* How far it is from one that may be, the less the better. */
static double constant_off(const hci_search *s, double share)
{
    return s->options->constant_is_known ? fabs(share - 1.0) : -share;
}

/* The type in the model that takes the torque away, or makes it another one than is known: the one without
 * which it is most like it. */
static hci_status culprit_find(const hci_search *s, const hci_candidates *candidates,
                               const hci_effect_type **culprit, hci_note *note)
{
    double least = INFINITY;
    hci_status status = HCI_OK;
    for (size_t r = 0; r < hci_candidate_types() && !status; ++r) {
        const hci_effect_type *type = hci_candidate_type(r);
        hci_candidates without = {0};
        double share = 0.0;
        if (!hci_candidates_have(candidates, type)) continue;
        status = hci_candidates_copy(candidates, &without, note);
        if (!status) hci_candidates_remove_type(&without, type);
        if (!status) status = hci_search_constant_share(s, &without, &share, note);
        hci_candidates_release(&without);
        if (status || constant_off(s, share) >= least) continue;
        least = constant_off(s, share);
        *culprit = type;
    }
    return status;
}

static hci_status disbelieved_set(hci_search *s, const hci_fitted_model *model,
                                  const hci_effect_type *culprit, double share, hci_note *note)
{
    hci_fitted_model copy = {0};
    const hci_status status = hci_fitted_model_copy(model, &copy, note);
    if (status) return status;
    s->disbelieved.type = culprit;
    s->disbelieved.constant_share = share;
    hci_fitted_model_replace(&s->disbelieved.model, &copy);
    return HCI_OK;
}

/* Keeps the best of those that are not believed. */
static hci_status disbelieve(hci_search *s, const hci_fitted_model *model, const hci_effect_type *culprit,
                             double share, hci_note *note)
{
    if (s->disbelieved.type && !(model->fit.score < s->disbelieved.model.fit.score)) return HCI_OK;
    return disbelieved_set(s, model, culprit, share, note);
}

/* Without its large defects, one by one, a model may still compete: an order that the recordings hardly show
 * takes any value that suits. Where that takes the whole effect out, it does not. */
static hci_status defects_leave(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    const size_t types = hci_candidates_types_in(&model->candidates);
    hci_status status = HCI_OK;
    size_t k = large_defect(s->regression, &model->candidates);
    while (!status && k < model->candidates.count) {
        model->candidates.candidate[k].in = false;
        status = hci_regression_fit(s->regression, &model->candidates, &model->fit, note);
        k = large_defect(s->regression, &model->candidates);
    }
    if (hci_candidates_types_in(&model->candidates) < types) model->fit.score = INFINITY;
    return status;
}

hci_status hci_search_fit(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    return hci_search_fit_below(s, model, INFINITY, note);
}

hci_status hci_search_fit_below(hci_search *s, hci_fitted_model *model, double bar, hci_note *note)
{
    const hci_effect_type *culprit = NULL;
    double share = 1.0;
    hci_status status = hci_regression_fit_below(s->regression, &model->candidates, bar, &model->fit, note);
    const size_t defect = large_defect(s->regression, &model->candidates);
    if (!status && defect < model->candidates.count) {
        status = disbelieve(s, model, model->candidates.candidate[defect].type, share, note);
        if (!status) status = defects_leave(s, model, note);
    }
    if (!status) status = hci_search_constant_share(s, &model->candidates, &share, note);
    if (status || is_constant_believed(s, share)) return status;
    status = culprit_find(s, &model->candidates, &culprit, note);
    if (!status && culprit) status = disbelieve(s, model, culprit, share, note);
    if (culprit) model->fit.score = INFINITY;
    return status;
}

/* A type that is not believed; NULL: all are. */
static hci_status unbelieved_find(const hci_search *s, const hci_candidates *candidates,
                                  const hci_effect_type **type, hci_note *note)
{
    const size_t defect = large_defect(s->regression, candidates);
    double share = 1.0;
    *type = defect < candidates->count ? candidates->candidate[defect].type : NULL;
    if (*type) return HCI_OK;
    const hci_status status = hci_search_constant_share(s, candidates, &share, note);
    return status || is_constant_believed(s, share) ? status : culprit_find(s, candidates, type, note);
}

hci_status hci_search_keep_believed(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    const hci_effect_type *type = NULL;
    hci_status status = unbelieved_find(s, &model->candidates, &type, note);
    while (!status && type) {
        hci_candidates_remove_type(&model->candidates, type);
        status = hci_search_renew(s, model, note);
        if (!status) status = unbelieved_find(s, &model->candidates, &type, note);
    }
    return status;
}

/* A type that brakes and would drive, or whose terms cancel; NULL: none. */
static hci_status unnatural_find(const hci_search *s, const hci_candidates *candidates,
                                 const hci_effect_type **type, hci_note *note)
{
    const hci_status status = hci_brakes_find_driving(s->regression, candidates, type, note);
    return status || *type ? status : hci_cancelling_find(s->regression, candidates, type, note);
}

/* Of the iron's mean, a term that keeps its sign with the load or grows faster than the current; their
 * number: none. */
static size_t unnatural_mean(const hci_search *s, const hci_candidates *candidates)
{
    size_t k = 0;
    while (k < candidates->count && !hci_mirror_is_broken(s->regression, candidates, k) &&
           !hci_iron_would_rise(s->regression, candidates, k))
        ++k;
    return k;
}

/* What such a term was there for is not of the iron; its ripple may be. */
static hci_status means_leave(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_candidates *list = &model->candidates;
    hci_status status = HCI_OK;
    for (size_t k = unnatural_mean(s, list); k < list->count && !status; k = unnatural_mean(s, list)) {
        status = disbelieve(s, model, list->candidate[k].type, 1.0, note);
        list->candidate[k].in = false;
        if (!status) status = hci_search_renew(s, model, note);
    }
    return status;
}

static bool shorten(hci_candidates *candidates, const hci_effect_type *type)
{
    for (size_t k = 0; k < candidates->count; ++k) {
        hci_candidate *x = &candidates->candidate[k];
        if (!x->in || x->type != type || !hci_brakes_has_further_power(x)) continue;
        hci_candidate_shorten(x);
        return true;
    }
    return false;
}

/* Beside what a search that ended early has not found a law of friction may fall with the speed for that
 * alone, and for what else is in a mean where a speed was turned in one direction alone; it brakes all the
 * same with fewer powers of it. kept: out, whether it is in the model with those. */
static hci_status fewer_powers_try(hci_search *s, hci_fitted_model *model, const hci_effect_type *type,
                                   bool *kept, hci_note *note)
{
    hci_fitted_model fewer = {0};
    hci_status status = hci_fitted_model_copy(model, &fewer, note);
    *kept = false;
    while (!status && !*kept && shorten(&fewer.candidates, type)) {
        const hci_effect_type *driving = NULL;
        status = hci_search_renew(s, &fewer, note);
        if (!status) status = hci_brakes_find_driving(s->regression, &fewer.candidates, &driving, note);
        *kept = !status && driving != type;
    }
    if (*kept) hci_fitted_model_replace(model, &fewer);
    hci_fitted_model_release(&fewer);
    return status || *kept ? status : hci_search_renew(s, model, note);
}

/* In one direction of the turn a friction that drives is the zero of a torque sensor. */
static hci_status zero_try(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    hci_candidate zero = {.count = 1, .in = true};
    hci_fitted_model other = {0};
    zero.type = hci_sensor_zero(&zero.term[0].parameter);
    if (!zero.type || hci_candidates_find_in(&model->candidates, &zero)) return HCI_OK;
    hci_status status = hci_fitted_model_copy(model, &other, note);
    if (!status) status = hci_candidates_add(&other.candidates, &zero, note);
    if (!status) status = hci_search_renew(s, &other, note);
    if (!status && other.fit.score < model->fit.score - HCI_DECISIVE) hci_fitted_model_replace(model, &other);
    hci_fitted_model_release(&other);
    return status ? status : hci_search_renew(s, model, note);
}

static hci_status unnatural_leave(hci_search *s, hci_fitted_model *model, const hci_effect_type *type,
                                  hci_note *note)
{
    bool kept = false;
    hci_status status = HCI_OK;
    if (s->ended == HCI_WORK_LIMITED || hci_brakes_hang_on_one_way(s->regression))
        status = fewer_powers_try(s, model, type, &kept, note);
    if (status || kept) return status;
    status = disbelieve(s, model, type, 1.0, note);
    hci_candidates_remove_type(&model->candidates, type);
    if (!status) status = hci_search_renew(s, model, note);
    return status || !type->coulomb_Nm ? status : zero_try(s, model, note);
}

hci_status hci_search_keep_brakes(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    const hci_effect_type *type = NULL;
    hci_status status = means_leave(s, model, note);
    if (!status) status = unnatural_find(s, &model->candidates, &type, note);
    while (!status && type) {
        status = unnatural_leave(s, model, type, note);
        if (!status) status = means_leave(s, model, note);
        if (!status) status = unnatural_find(s, &model->candidates, &type, note);
    }
    return status;
}

/* ---- what it means for the model that is believed ---- */

/* Takes out what is in the model and not, or as the culprit, in the one that is not believed. */
static bool others_remove(const hci_disbelieved *better, hci_candidates *model)
{
    bool changed = false;
    for (size_t r = 0; r < hci_candidate_types(); ++r) {
        const hci_effect_type *type = hci_candidate_type(r);
        const bool in_both = type != better->type && hci_candidates_have(&better->model.candidates, type);
        if (in_both || !hci_candidates_have(model, type)) continue;
        hci_candidates_remove_type(model, type);
        changed = true;
    }
    return changed;
}

/* Whether all runs are free shafts that hardly accelerate beside what the declared machine leaves: a machine
 * that makes no torque describes them whatever they are. */
static hci_status is_trivial(hci_search *s, bool *trivial, hci_note *note)
{
    const hci_candidates none = {0};
    double torque = 0.0, residual = 0.0;
    const hci_status status = hci_search_residual(s, &none, note);
    *trivial = !status;
    for (const hci_segment *x = NULL; !status && (x = hci_regression_next(s->regression, x)) != NULL;) {
        *trivial = *trivial && s->regression->runs[x->run].torque_source == HCI_TORQUE_INERTIA;
        for (size_t j = x->first; j < x->first + x->count; ++j) {
            torque += pow(s->regression->samples->sample[j].torque_Nm, 2.0);
            residual += pow(s->residual_Nm[j], 2.0);
        }
    }
    *trivial = *trivial && torque < HARDLY * HARDLY * residual;
    return status;
}

/* How well a model describes the recordings, against the one without any effect. */
typedef struct {
    double gain;  /* fall of the score, with the noise of now */
    double white; /* score with white noise of one size in all runs */
} merit;

static hci_status merit_of(hci_search *s, hci_fitted_model *model, merit *to, hci_note *note)
{
    hci_candidates none = {0};
    hci_fit without;
    hci_status status = hci_regression_fit(s->regression, &none, &without, note);
    if (!status) status = hci_regression_fit(s->regression, &model->candidates, &model->fit, note);
    if (!status) status = hci_search_residual(s, &model->candidates, note);
    if (status) return status;
    const double price = hci_fit_effective_score(&model->fit, &model->candidates) - model->fit.square;
    to->gain = without.score - model->fit.score;
    to->white = model->fit.rows * 2.0 * log(hci_search_residual_rms(s)) + price;
    return HCI_OK;
}

/* The colour of the noise is that of what one of both leaves, and suits the other less or more by chance: a
 * model is better where white noise says so too. */
static bool is_better(const merit *x, const merit *than)
{
    return x->gain > than->gain + HCI_DECISIVE && x->white + HCI_DECISIVE < than->white;
}

/* Takes out of a model what a series in the currents has in it. */
static void parts_of_series_leave(hci_candidates *model)
{
    for (size_t r = 0; r < hci_candidate_types(); ++r)
        if (hci_candidate_type(r)->in_series) hci_candidates_remove_type(model, hci_candidate_type(r));
}

/* The same of the model that is believed, or of the one with single terms where a whole co-energy, which was
 * chosen by runs left out and not by this score, stands in its place and is further from that of them. */
static hci_status believed_merit(hci_search *s, hci_fitted_model *model, merit *to, hci_note *note)
{
    merit single;
    hci_status status = merit_of(s, model, to, note);
    if (status || !s->whole_coenergy || hci_candidates_types_in(&s->single.candidates) == 0) return status;
    status = merit_of(s, &s->single, &single, note);
    if (!status && single.gain > to->gain) *to = single;
    return status;
}

hci_status hci_search_yield(hci_search *s, hci_fitted_model *model, hci_yield *yield, hci_note *note)
{
    hci_disbelieved *x = &s->disbelieved;
    merit other = {0}, believed = {0};
    bool trivial = false;
    *yield = HCI_YIELD_NOTHING;
    if (!x->type) return HCI_OK;
    if (hci_candidates_have_series(&model->candidates)) parts_of_series_leave(&x->model.candidates);
    hci_status status = merit_of(s, &x->model, &other, note);
    if (!status) status = believed_merit(s, model, &believed, note);
    if (status) return status;
    if (other.gain > HCI_DECISIVE && other.gain > NEARLY * believed.gain) *yield = HCI_YIELD_RIVAL;
    if (!is_better(&other, &believed)) return HCI_OK;
    status = is_trivial(s, &trivial, note);
    if (status || trivial) return status;
    *yield = HCI_YIELD_BETTER;
    return others_remove(x, &model->candidates) ? hci_search_renew(s, model, note) : HCI_OK;
}
