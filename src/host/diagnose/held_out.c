#include "host/diagnose/held_out.h"

#include <math.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/fit/fit.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/reading/predicted_reading.h"
#include "host/diagnose/search/search.h"

#define BEYOND        1.05 /* of the largest current and speed fitted: beyond it a run is no test */
#define NOISY         1.5  /* error of a run held out, over its noise … */
#define NEAR          1.2  /* … of a torque that was measured, where half of what is not noise is left */
#define COARSE        4.0  /* … or over the resolution, that speaks against the effects … */
#define HARDLY_BETTER 0.5  /* … unless it is less than this share of the error without them */
#define NEARLY_ALL    0.1  /* share of an error that is next to nothing beside what it was */
#define RIPPLE        2.0  /* over the noise, which of slopes is known by half: a ripple that is there */
#define MUCH          2.0  /* the same of all runs: the model is not complete … */
#define MUCH_OF_ONE   4.0  /* … nor where one run leaves as much */
#define MEAN_LEFT     0.5  /* of the noise of a sample, that the mean of a run may be off */
#define RIPPLE_LEFT   0.3  /* share of the error of a fitted run that a ripple beside its noise is of */
#define HELPS         1.05 /* of the error held out, without an effect that lowers it */
#define RISES         1.02 /* of an error, that is no rounding */
#define STAYS         0.95 /* share of an error that has not fallen */
#define MADE          2.0  /* of a ripple held out, over that of the declared machine: effects make it */
#define SMALL         0.05 /* share of what all effects explain, that a small one explains of it at most */
#define BY_CHANCE     20.0 /* χ² by which runs held out are described worse, all of them together */

/* Whether a run is within the currents and speeds of those that were fitted. */
static bool is_within(const hci_run_statistics *f, const hci_dataset *b)
{
    double most_A = 0.0, most_speed = 0.0;
    for (size_t r = 0; r < b->samples.run_count; ++r) {
        if (!b->fit[r]) continue;
        most_A = fmax(most_A, b->samples.statistics[r].current_A);
        most_speed = fmax(most_speed, b->samples.statistics[r].pace_rad_per_s);
    }
    return f->current_A <= BEYOND * most_A && f->pace_rad_per_s <= BEYOND * most_speed;
}

/* Errors of the runs held out that a fit could describe, as mean squares over runs. */
typedef struct {
    double before, after;
    double allowed;                             /* what noise and resolution may leave */
    double told_before, told_after, told_noise; /* of runs whose noise is well known: measured torques */
} test_errors;

static void told_add(const hci_run_errors *e, double resolution_Nm, test_errors *x)
{
    x->told_before += e->rms_before_Nm * e->rms_before_Nm;
    x->told_after += e->rms_after_Nm * e->rms_after_Nm;
    x->told_noise += fmax(pow(e->noise_floor_Nm, 2.0), pow(COARSE / NOISY * resolution_Nm, 2.0));
}

static test_errors test_errors_of(const hci_dataset *b, const hci_runs *runs, const hci_diagnosis *d,
                                  double resolution_Nm)
{
    test_errors x = {0};
    for (size_t k = 0, run = 0; k < runs->count && run < d->runs; ++k) {
        const hci_run_errors *e = &d->run[run];
        if (e->file != runs->run[k].name) continue;
        ++run;
        if (e->role == HCI_ROLE_FIT || !is_within(&b->samples.statistics[k], b)) continue;
        x.before += e->rms_before_Nm * e->rms_before_Nm;
        x.after += e->rms_after_Nm * e->rms_after_Nm;
        x.allowed += fmax(pow(NOISY * e->noise_floor_Nm, 2.0), pow(COARSE * resolution_Nm, 2.0));
        if (runs->run[k].torque_source == HCI_TORQUE_MEASURED) told_add(e, resolution_Nm, &x);
    }
    return x;
}

/* Down to the noise, or nearly. */
static bool is_described(const test_errors *x)
{
    return !(x->after > x->allowed) || x->after < NEARLY_ALL * NEARLY_ALL * x->before;
}

/* Whether an error that is small beside the noise, but stands out of it, has hardly fallen: of what is not
 * noise more than a share of the mean square is left. */
static bool is_hardly_less(const test_errors *x, double share)
{
    return x->told_after > NEAR * NEAR * x->told_noise &&
           x->told_after - x->told_noise > share * (x->told_before - x->told_noise);
}

/* Whether the runs held out speak against the effects: they are not described down to their noise, and hardly
 * better than without; of what was kept of them because it helps, no better at all. */
static bool is_contradicted(const test_errors *x, bool kept)
{
    const double share = kept ? STAYS : HARDLY_BETTER;
    return (!is_described(x) && x->after > share * share * x->before) ||
           is_hardly_less(x, kept ? STAYS * STAYS : HARDLY_BETTER);
}

/* Whether the ripple held out, that of currents and speeds beyond those that were fitted too, is a multiple
 * of what the declared machine leaves: no effect that is there makes a ripple where there is none. */
static bool makes_ripple(const hci_diagnosis *d, double resolution_Nm)
{
    const double allowed_Nm = fmax(RIPPLE * d->holdout_noise_Nm, COARSE * resolution_Nm);
    return d->holdout_ripple_after_Nm > fmax(allowed_Nm, MADE * d->holdout_ripple_before_Nm);
}

/* Whether the mean error of a run that was fitted stands beside its noise: a mean is known much better than a
 * sample. */
static bool leaves_means(const hci_diagnosis *d, double resolution_Nm)
{
    for (size_t k = 0; k < d->runs; ++k) {
        const hci_run_errors *e = &d->run[k];
        if (e->role != HCI_ROLE_FIT) continue;
        const double noise_Nm = fmax(MEAN_LEFT * e->noise_floor_Nm, COARSE * resolution_Nm);
        if (fabs(e->error_mean_after_Nm) > fmax(noise_Nm, NEARLY_ALL * e->rms_before_Nm)) return true;
    }
    return false;
}

/* Whether a run that was fitted has a ripple that noise does not make. */
static bool leaves_ripple(const hci_diagnosis *d, double resolution_Nm)
{
    for (size_t k = 0; k < d->runs; ++k) {
        const hci_run_errors *e = &d->run[k];
        if (e->role != HCI_ROLE_FIT) continue;
        const double noise_Nm = fmax(RIPPLE * e->noise_floor_Nm, COARSE * resolution_Nm);
        if (e->ripple_after_Nm > fmax(noise_Nm, RIPPLE_LEFT * e->rms_before_Nm)) return true;
    }
    return false;
}

/* The samples of a run. */
static double rows_of(const hci_dataset *b, size_t run)
{
    double rows = 0.0;
    for (size_t k = 0; k < b->samples.segment_count; ++k)
        if (b->samples.segment[k].run == run) rows += (double)b->samples.segment[k].count;
    return rows;
}

/* χ² that chance adds to runs held out by the errors of the values of the effects, twice over. */
static double by_chance(const hci_diagnosis *d)
{
    double terms = 0.0;
    for (size_t k = 0; k < d->effects.list.count; ++k)
        terms += (double)d->effects.list.effect[k].count;
    return BY_CHANCE + 2.0 * terms;
}

/* Whether all runs held out together are described worse than by the declared machine, however near to their
 * noise they are. */
static bool rises_at_all(const hci_dataset *b, const hci_runs *runs, const hci_diagnosis *d)
{
    double rise = 0.0; /* χ² */
    for (size_t k = 0, run = 0; k < runs->count && run < d->runs; ++k) {
        const hci_run_errors *e = &d->run[run];
        if (e->file != runs->run[k].name) continue;
        ++run;
        if (e->role == HCI_ROLE_FIT || !(e->noise_floor_Nm > 0.0)) continue;
        const double weight = rows_of(b, k) / (e->noise_floor_Nm * e->noise_floor_Nm);
        rise += weight * (pow(e->rms_after_Nm, 2.0) - pow(e->rms_before_Nm, 2.0));
    }
    return rise > by_chance(d) && d->holdout_after_Nm > RISES * d->holdout_before_Nm;
}

/* Whether something is left that the effects do not explain: the error held out is above the noise, or that
 * of currents and speeds beyond those that were fitted does not fall. */
static bool is_partial(const test_errors *x, const hci_diagnosis *d, double resolution_Nm)
{
    const double allowed_Nm = fmax(NOISY * d->holdout_noise_Nm, COARSE * resolution_Nm);
    const bool rises = d->holdout_after_Nm > allowed_Nm && !(d->holdout_after_Nm < d->holdout_before_Nm);
    const bool ripples = d->holdout_ripple_after_Nm > fmax(allowed_Nm, RIPPLE * d->holdout_noise_Nm) &&
                         !(d->holdout_ripple_after_Nm < STAYS * d->holdout_ripple_before_Nm);
    return !is_described(x) || rises || ripples || leaves_means(d, resolution_Nm) ||
           leaves_ripple(d, resolution_Nm);
}

bool hci_held_out_leaves_much(const hci_diagnosis *d, double resolution_Nm)
{
    const double least_Nm = COARSE * resolution_Nm;
    for (size_t k = 0; k < d->runs; ++k)
        if (d->run[k].rms_after_Nm > fmax(MUCH_OF_ONE * d->run[k].noise_floor_Nm, least_Nm)) return true;
    return d->rms_after_Nm > fmax(MUCH * d->noise_Nm, least_Nm) ||
           d->holdout_after_Nm > fmax(MUCH * d->holdout_noise_Nm, least_Nm);
}

hci_held_out_result hci_held_out_judge(const hci_dataset *b, const hci_runs *runs, const hci_diagnosis *d,
                                       double resolution_Nm)
{
    const test_errors x = test_errors_of(b, runs, d, resolution_Nm);
    if (is_contradicted(&x, d->contradicted) || makes_ripple(d, resolution_Nm))
        return HCI_HELD_OUT_CONTRADICTED;
    return is_partial(&x, d, resolution_Nm) || rises_at_all(b, runs, d) ? HCI_HELD_OUT_PARTLY
                                                                        : HCI_HELD_OUT_DESCRIBED;
}

bool hci_held_out_rises(const hci_dataset *b, const hci_runs *runs, const hci_diagnosis *d,
                        double resolution_Nm)
{
    const test_errors x = test_errors_of(b, runs, d, resolution_Nm);
    return x.after > x.allowed && x.after > RISES * RISES * x.before;
}

bool hci_held_out_rises_both(const hci_dataset *b, const hci_runs *runs, const hci_diagnosis *d)
{
    double mean = 0.0, ripple = 0.0; /* χ² by which they rise */
    for (size_t k = 0, run = 0; k < runs->count && run < d->runs; ++k) {
        const hci_run_errors *e = &d->run[run];
        if (e->file != runs->run[k].name) continue;
        ++run;
        if (e->role == HCI_ROLE_FIT || !is_within(&b->samples.statistics[k], b)) continue;
        const double weight = rows_of(b, k) / (e->noise_floor_Nm * e->noise_floor_Nm);
        mean += weight * (pow(e->error_mean_after_Nm, 2.0) - pow(e->error_mean_before_Nm, 2.0));
        ripple += weight * (pow(e->ripple_after_Nm, 2.0) - pow(e->ripple_before_Nm, 2.0));
    }
    return mean > BY_CHANCE && ripple > BY_CHANCE;
}

/* ---- which effects help ---- */

/* Samples of the runs held out within what was fitted. */
static double samples_of(const hci_dataset *b, const hci_runs *runs)
{
    double count = 0.0;
    for (size_t k = 0; k < b->samples.segment_count; ++k) {
        const hci_segment *s = &b->samples.segment[k];
        if (runs->role[s->run] != HCI_ROLE_FIT && is_within(&b->samples.statistics[s->run], b))
            count += (double)s->count;
    }
    return count;
}

/* Whether a run held out takes part: within what was fitted, or where none is. */
static bool takes_part(const hci_dataset *b, const hci_runs *runs, size_t run)
{
    return runs->role[run] != HCI_ROLE_FIT &&
           (is_within(&b->samples.statistics[run], b) || !(samples_of(b, runs) > 0.0));
}

/* Mean square over these runs, of the residual of a model, N²·m². residual_Nm: [samples]. */
static hci_status square_of(hci_dataset *b, const hci_runs *runs, const hci_candidates *candidates,
                            double *residual_Nm, double *square, hci_note *note)
{
    hci_model model;
    double sum = 0.0, count = 0.0;
    hci_status status = hci_model_make(b->regression.declared, candidates, false, &model, note);
    if (status) return status;
    b->regression.use = b->any;
    status = hci_regression_residual(&b->regression, &model.list, residual_Nm, note);
    b->regression.use = b->fit;
    for (size_t k = 0; k < b->samples.segment_count && !status; ++k) {
        const hci_segment *s = &b->samples.segment[k];
        if (!takes_part(b, runs, s->run)) continue;
        for (size_t j = s->first; j < s->first + s->count; ++j, count += 1.0)
            sum += residual_Nm[j] * residual_Nm[j];
    }
    *square = count > 0.0 ? sum / count : 0.0;
    hci_model_release(&model);
    return status;
}

/* The mean square over the runs held out without one type; NULL: with all. */
static hci_status square_without(hci_dataset *b, const hci_runs *runs, const hci_effect_type *type,
                                 const hci_candidates *model, double *square, hci_note *note)
{
    hci_candidates without = {0};
    double *residual_Nm = hci_memory_new(b->samples.count + 1, sizeof *residual_Nm);
    hci_status status = residual_Nm ? hci_candidates_copy(model, &without, note)
                                    : hci_note_memory(note, NULL, "the runs held out");
    if (!status && type) hci_candidates_remove_type(&without, type);
    if (!status) status = square_of(b, runs, &without, residual_Nm, square, note);
    hci_candidates_release(&without);
    hci_memory_free(residual_Nm);
    return status;
}

/* By how much the mean square has to be larger without a type: a series in the currents describes anything a
 * little, and has to halve the error. */
static double helps(const hci_effect_type *type)
{
    return type->is_series ? 1.0 / (HARDLY_BETTER * HARDLY_BETTER) : HELPS * HELPS;
}

hci_status hci_held_out_keep(hci_dataset *b, const hci_runs *runs, hci_candidates *model, hci_note *note)
{
    double with_Nm2 = 0.0, without_Nm2[HCI_MOST_TYPES] = {0.0};
    hci_status status = square_without(b, runs, NULL, model, &with_Nm2, note);
    for (size_t r = 0; r < hci_candidate_types() && !status; ++r)
        if (hci_candidates_have(model, hci_candidate_type(r)))
            status = square_without(b, runs, hci_candidate_type(r), model, &without_Nm2[r], note);
    for (size_t r = 0; r < hci_candidate_types() && !status; ++r)
        if (!(without_Nm2[r] > helps(hci_candidate_type(r)) * with_Nm2))
            hci_candidates_remove_type(model, hci_candidate_type(r));
    return status;
}

/* ---- which effects mislead ---- */

/* The same mean square without one type, all others fitted anew. asked: out, whether the runs that were
 * fitted ask for it; may be NULL. */
static hci_status square_refitted(hci_dataset *b, const hci_runs *runs, const hci_effect_type *type,
                                  const hci_fitted_model *model, double *square, bool *asked, hci_note *note)
{
    hci_candidates without = {0};
    hci_fit fit;
    hci_status status = hci_candidates_copy(&model->candidates, &without, note);
    if (!status) hci_candidates_remove_type(&without, type);
    if (!status) status = hci_regression_fit(&b->regression, &without, &fit, note);
    if (!status) status = square_without(b, runs, NULL, &without, square, note);
    if (asked) *asked = !status && !(fit.score < model->fit.score + HCI_DECISIVE);
    hci_candidates_release(&without);
    return status;
}

static double gain_of_all(const hci_attribution *a)
{
    return a->before.score - a->model.fit.score;
}

/* Whether a type is found in none of the cases with one run left out: others of the co-energy take its place
 * in each. */
static bool is_never_found(const hci_verdict *v)
{
    return v->left_out > 0 && v->stays == 0;
}

hci_status hci_held_out_misleading(hci_dataset *b, const hci_runs *runs, const hci_attribution *a,
                                   const hci_effect_type **type, hci_note *note)
{
    const double samples = samples_of(b, runs);
    double with_Nm2 = 0.0, without_Nm2 = 0.0;
    *type = NULL;
    if (!(samples > 0.0)) return HCI_OK;
    hci_status status = square_without(b, runs, NULL, &a->model.candidates, &with_Nm2, note);
    double least_Nm2 = with_Nm2 * (1.0 - BY_CHANCE / samples);
    for (size_t r = 0; r < a->types && !status; ++r) {
        const hci_verdict *v = &a->verdict[r];
        if (!v->in || v->ambiguous || v->gain > SMALL * gain_of_all(a)) continue;
        const bool of_whole = hci_candidates_are_of_whole(&a->model.candidates, v->type);
        if (of_whole && !is_never_found(v)) continue;
        bool asked = true;
        status = square_refitted(b, runs, v->type, &a->model, &without_Nm2, &asked, note);
        if (!asked && !of_whole) without_Nm2 = 0.0;
        if (status || !(without_Nm2 < least_Nm2)) continue;
        least_Nm2 = without_Nm2;
        *type = v->type;
    }
    return status;
}

hci_status hci_held_out_idle_series(hci_dataset *b, const hci_runs *runs, const hci_attribution *a,
                                    const hci_effect_type **type, hci_note *note)
{
    double with_Nm2 = 0.0, without_Nm2 = 0.0;
    *type = NULL;
    if (!(samples_of(b, runs) > 0.0)) return HCI_OK;
    hci_status status = square_without(b, runs, NULL, &a->model.candidates, &with_Nm2, note);
    for (size_t r = 0; r < a->types && !status && !*type; ++r) {
        const hci_verdict *v = &a->verdict[r];
        if (!v->in || v->established || !v->type->is_series) continue;
        status = square_refitted(b, runs, v->type, &a->model, &without_Nm2, NULL, note);
        if (!status && !(without_Nm2 > helps(v->type) * with_Nm2)) *type = v->type;
    }
    return status;
}

/* ---- of a search that ended early ---- */

#define STANDS_STILL 0.02  /* of an error: by that it is no other one */
#define MINOR        1e-3  /* of what all effects explain */
#define STANDS       0.333 /* of what is explained: rms of what is not, beside which that stands */

/* Whether what is left of an error is small beside what is explained of it. */
static bool is_explained(double before_Nm, double after_Nm, double noise_Nm)
{
    const double left = after_Nm * after_Nm - noise_Nm * noise_Nm;
    const double explained = before_Nm * before_Nm - after_Nm * after_Nm;
    return left <= STANDS * STANDS * fmax(0.0, explained);
}

static bool has_risen(double before_Nm, double after_Nm)
{
    return after_Nm > (1.0 + STANDS_STILL) * before_Nm;
}

/* Whether runs held out are left with more than their noise, and that is not small beside what is explained
 * of them: of all, or of their means or the ripple about them where the other is no worse. */
static bool is_much_held_out(const hci_diagnosis *d)
{
    const bool means = is_explained(d->holdout_mean_before_Nm, d->holdout_mean_after_Nm, 0.0) &&
                       !has_risen(d->holdout_ripple_before_Nm, d->holdout_ripple_after_Nm);
    const bool ripple =
        is_explained(d->holdout_ripple_before_Nm, d->holdout_ripple_after_Nm, d->holdout_noise_Nm) &&
        !has_risen(d->holdout_mean_before_Nm, d->holdout_mean_after_Nm);
    return isfinite(d->holdout_after_Nm) && !means && !ripple &&
           !is_explained(d->holdout_before_Nm, d->holdout_after_Nm, d->holdout_noise_Nm);
}

static bool is_found_without_runs(const hci_verdict *v)
{
    return 3 * v->stays >= 2 * v->left_out;
}

/* Whether an effect is next to nothing of what all explain. */
static bool is_minor(const hci_attribution *a, const hci_verdict *v)
{
    return v->gain < MINOR * gain_of_all(a);
}

/* What is next to nothing needs runs held out that tell it from what the search had still to look at. */
static bool is_untested(const hci_attribution *a, const hci_diagnosis *d, const hci_verdict *v)
{
    return is_minor(a, v) && !isfinite(d->holdout_after_Nm);
}

/* Beside something unknown nothing is compared. Where there is nothing unknown, what is not next to nothing
 * needs no comparison. */
static bool stands_out(const hci_attribution *a, const hci_verdict *v)
{
    if (a->unknown && a->means_alone) return true; /* of the ripple nothing is unknown */
    if (a->unknown) return a->unexplained_Nm < STANDS * v->explained_Nm;
    return v->compared || !is_minor(a, v);
}

bool hci_is_unconfirmed(const hci_attribution *a, const hci_diagnosis *d, const hci_verdict *v)
{
    return a->ended == HCI_WORK_LIMITED && v->in && v->type != &hci_empirical_type && !v->established &&
           (a->unsettled || is_untested(a, d, v) || !is_found_without_runs(v) || !stands_out(a, v) ||
            is_much_held_out(d));
}
