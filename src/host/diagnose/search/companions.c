#include "host/diagnose/search/companions.h"

#include <math.h>

#include "host/diagnose/search/search.h"

#define SERIES_ERROR 0.002
#define SWING_ERROR  0.005
#define SLOPE_ERROR  0.005 /* of a torque that goes with an acceleration, which is a slope of readings */
#define JITTER_ERROR 0.25  /* of a delay that is another one at each sample */
#define JITTER       1.5   /* largest over least noise of a run that tells of it */
#define CRAWL_ERROR  0.01  /* of a cogging torque that the current answers within a few samples */
#define ANY_ERROR    3e-4 /* a noise of another size in each run, an inertia, the angle between two samples */
#define KNEE                                                                                                 \
    0.1 /* of what a power describes of tanh x or x/√(1 + x²) up to x = 1, that a linear part beside it   \
           describes better */
#define NO_CURRENT 0.01 /* of the largest, that is none */
#define PLAIN      40.0 /* a fall of the score that no such error makes */

/* Whether a type that is in delays, or has a lag or a resonance: the zero of a torque sensor has none. */
static bool swings(const hci_candidates *model, const hci_effect_type *type)
{
    if (type->late) return true;
    for (size_t k = 0; k < model->count && type->lag; ++k) {
        const hci_candidate *x = &model->candidate[k];
        if (x->in && x->type == type &&
            (type->parameter[x->term[0].parameter].traits & HCI_PARAMETER_ALONG_TIME))
            return true;
    }
    return false;
}

/* Noise of a sample of a run, of which a mean over turns has less; 0: none is in use. */
static double noise_Nm(const hci_regression *e, size_t run)
{
    double sum = 0.0, bins = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(e->samples, run, s)) != NULL;) {
        const double rms = hci_regression_noise(e, s)->rms;
        for (size_t k = s->first; k < s->first + s->count && e->use[run]; ++k, bins += 1.0)
            sum += rms * rms * e->samples->sample[k].count;
    }
    return bins > 0.0 ? sqrt(sum / bins) : 0.0;
}

/* Whether the noise is not of one size: beside a delay that is what stamps that are off by another time at
 * each sample make of a torque that varies. They take from its high orders too, which no delay does. */
static bool jitters(const hci_regression *e)
{
    double least = INFINITY, most = 0.0;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        const double noise = noise_Nm(e, r);
        if (!(noise > 0.0)) continue;
        least = fmin(least, noise);
        most = fmax(most, noise);
    }
    return most > JITTER * least;
}

/* Whether a cogging torque holds a shaft that hardly accelerates: what its current does between two samples,
 * and the noise of it, are in each torque that is read there. */
static bool crawls(const hci_regression *e, const hci_effect_type *type)
{
    bool any = false;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        any = any || (e->use[r] && e->runs[r].hardly_accelerates);
    return any && type->any_phase && type->propose_coenergy;
}

bool hci_companion_is_by_slope(const hci_effect_type *type)
{
    return (type->needs & HCI_EFFECT_NEEDS_ACCELERATION) != 0;
}

/* What a model of the type gets wrong, as a share of what it explains: a series in the currents is not what
 * iron does to the last digit, nor what a sensor answers between samples that are far apart in a period, nor
 * a delay the filter that makes it. */
double hci_companion_error(const hci_regression *e, const hci_candidates *model, const hci_effect_type *type)
{
    if (type->late && jitters(e)) return JITTER_ERROR;
    if (hci_companion_is_by_slope(type)) return SLOPE_ERROR;
    if (type->beyond_quadratic) return SERIES_ERROR;
    if (crawls(e, type)) return CRAWL_ERROR;
    return swings(model, type) ? SWING_ERROR : 0.0;
}

/* Whether both are of a whole co-energy, in which neither is a part of the error of the other. */
static bool are_of_whole(const hci_attribution *a, const hci_verdict *v, const hci_verdict *other)
{
    const hci_candidates *model = &a->model.candidates;
    return hci_candidates_are_of_whole(model, v->type) && hci_candidates_are_of_whole(model, other->type);
}

/* The fall of the score that another effect of the iron must reach to be more than a part of the error of the
 * others; 0: none of them is off. */
static double least_of_iron(const hci_regression *e, const hci_attribution *a, const hci_verdict *v)
{
    double most = 0.0;
    for (size_t r = 0; r < a->types; ++r) {
        const hci_verdict *other = &a->verdict[r];
        const double error = hci_companion_error(e, &a->model.candidates, other->type);
        const bool both =
            (v->type->beyond_quadratic && other->type->beyond_quadratic) || are_of_whole(a, v, other);
        if (other->in && other != v && error > 0.0 && !both) most = fmax(most, error * other->gain);
    }
    return most > 0.0 ? fmax(HCI_DECISIVE, most) : 0.0;
}

/* The same of any effect but one that brakes, beside a torque that goes with an acceleration. */
static double least_of_slopes(const hci_attribution *a, const hci_verdict *v)
{
    double most = 0.0;
    if (v->type->coulomb_Nm) return 0.0;
    for (size_t r = 0; r < a->types; ++r) {
        const hci_verdict *other = &a->verdict[r];
        if (other->in && other != v && hci_companion_is_by_slope(other->type))
            most = fmax(most, SLOPE_ERROR * other->gain);
    }
    return most;
}

/* The same of any effect: a small part of what the largest of the others explains. */
static double least_of_any(const hci_attribution *a, const hci_verdict *v)
{
    double most = 0.0;
    for (size_t r = 0; r < a->types; ++r) {
        const hci_verdict *other = &a->verdict[r];
        if (other->in && other != v && !are_of_whole(a, v, other)) most = fmax(most, other->gain);
    }
    return fmin(PLAIN, ANY_ERROR * most);
}

/* ---- the linear part of iron ---- */

/* Whether a series in the model has an order that this one of a back-EMF makes with the currents. */
static bool series_has(const hci_candidates *model, double order)
{
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        for (size_t j = 0; x->in && x->type->is_series && j < x->count; ++j)
            if (fabs(fabs(x->term[j].order - order) - 1.0) < HCI_ORDER_TOLERANCE) return true;
    }
    return false;
}

/* Whether all that a type has in the model are back-EMFs of a balanced machine at the orders of a series. */
static bool is_linear_part(const hci_candidates *model, const hci_effect_type *type)
{
    bool any = false;
    for (size_t k = 0; k < model->count && type->is_small && type->propose_coenergy; ++k) {
        const hci_candidate *x = &model->candidate[k];
        if (!x->in || x->type != type) continue;
        if (!type->parameter[x->term[0].parameter].whole || !series_has(model, x->term[0].order))
            return false;
        any = true;
    }
    return any;
}

/* Whether all that a type has in the model takes phases that differ. */
static bool is_of_unlike_phases(const hci_candidates *model, const hci_effect_type *type)
{
    bool any = false;
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        if (!x->in || x->type != type) continue;
        if (!hci_candidate_is_unbalanced(type, x->term[0].parameter, x->term[0].order)) return false;
        any = true;
    }
    return any;
}

/* Whether each run in use is of direct current or of none. The current vector turns against the rotor there,
 * and what powers of it miss is of any order of the angle. */
static bool are_direct(const hci_regression *e)
{
    const hci_run_statistics *f = e->samples->statistics;
    double most_A = 0.0;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (e->use[r]) most_A = fmax(most_A, f[r].current_A);
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (e->use[r] && f[r].current_A > NO_CURRENT * most_A && !f[r].is_direct) return false;
    return most_A > 0.0;
}

/* Reluctance and saturation. */
static bool is_of_powers(const hci_effect_type *type)
{
    return type->propose_coenergy && !type->any_phase && !type->is_small;
}

/* Others that are in would take the linear part in its place, and the iron be wrong by it. */
double hci_companion_of_series(const hci_regression *e, const hci_attribution *a, const hci_verdict *v)
{
    const hci_candidates *model = &a->model.candidates;
    const bool unlike = is_of_unlike_phases(model, v->type) && hci_candidates_have_series(model);
    double sum = 0.0;
    if (!is_linear_part(model, v->type) && !(unlike && are_direct(e))) return 0.0;
    for (size_t r = 0; r < a->types; ++r) {
        const hci_verdict *other = &a->verdict[r];
        if (!other->in || other == v || other->type->any_phase) continue;
        if (!is_of_powers(other->type)) return 0.0;
        sum += other->gain;
    }
    return KNEE * sum;
}

/* ---- delays of free shafts ---- */

/* Whether every torque in use is an inertia times an acceleration. */
bool hci_are_free_shafts(const hci_regression *e)
{
    bool any = false;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        if (!e->use[r]) continue;
        if (e->runs[r].torque_source != HCI_TORQUE_INERTIA) return false;
        any = true;
    }
    return any;
}

/* The shortest time between two samples of the runs in use; infinite where none has times. */
static double shortest_step_s(const hci_regression *e)
{
    double least = INFINITY;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        const hci_run *run = &e->runs[r];
        if (!e->use[r] || !run->time_s || run->count < 2) continue;
        least = fmin(least, (run->time_s[run->count - 1] - run->time_s[0]) / (double)(run->count - 1));
    }
    return least;
}

/* Whether all delays of a type are shorter than a sample of a free shaft: when its acceleration was, which is
 * a slope of the angle, is not known better than that. */
static bool is_within_slope(const hci_regression *e, const hci_candidates *model, const hci_effect_type *type)
{
    double longest_s = 0.0;
    if (!type->late || !hci_are_free_shafts(e)) return false;
    for (size_t k = 0; k < model->count; ++k)
        for (size_t j = 0; model->candidate[k].in && j < model->candidate[k].count; ++j)
            if (model->candidate[k].type == type)
                longest_s = fmax(longest_s, fabs(model->candidate[k].term[j].value));
    return longest_s < shortest_step_s(e);
}

double hci_companion_of_sensor(const hci_attribution *a, const hci_verdict *v)
{
    for (size_t r = 0; r < a->types; ++r) {
        const hci_verdict *other = &a->verdict[r];
        if (other->in && other != v && other->type->lag && swings(&a->model.candidates, other->type))
            return least_of_any(a, v);
    }
    return 0.0;
}

/* Of the magnetic circuit, or a drag that grows with the current. */
static bool is_by_iron(const hci_effect_type *type)
{
    const bool drags = type->drag_Nm && (type->parameter[0].traits & HCI_PARAMETER_WITH_CURRENT);
    return type->propose_coenergy || drags;
}

double hci_companion_least(const hci_regression *e, const hci_attribution *a, const hci_verdict *v)
{
    if (is_within_slope(e, &a->model.candidates, v->type)) return INFINITY;
    const double least = fmax(least_of_any(a, v), least_of_slopes(a, v));
    return fmax(least, is_by_iron(v->type) ? least_of_iron(e, a, v) : 0.0);
}
