#include "host/diagnose/search/search.h"
#include "host/base/memory.h"
#include "host/diagnose/fit/current_sums.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/fit/noise_estimate.h"
#include "host/diagnose/reading/within_slope.h"

#include <math.h>
#include <string.h>

#define NOTICEABLE 0.05 /* least torque of an effect, as a share of the noise of a sample */
#define RESOLVED   0.5  /* and as a share of the resolution */

#define WITHIN_SLOPE 0.25 /* of what a torque varies within the window of a slope, that is not known */

#define ZEROS_SHOW 9.0 /* three times what zeros differ by, squared */

#define PART 0.02 /* of what is left of a step that a fit or a residual takes */

/* ---- the end ---- */

bool hci_search_is_over(hci_search *s)
{
    const double *work = s->regression->work;
    const double most = HCI_MOST_WORK + (s->judging ? HCI_WORK_OF_JUDGING : -s->kept_work);
    if (hci_search_is_interrupted(s)) return true;
    const bool much = work && *work > most;
    if (much) s->ended = HCI_WORK_LIMITED;
    return much || (s->ended != HCI_WORK_COMPLETE && !s->judging);
}

bool hci_search_is_interrupted(hci_search *s)
{
    if (hci_watch_stops(s->regression->watch)) s->ended = HCI_WORK_INTERRUPTED;
    return s->ended == HCI_WORK_INTERRUPTED;
}

/* ---- progress ---- */

static void tell(const hci_search *s)
{
    if (s->options->progress) s->options->progress(s->options->context, s->doing, s->share);
}

void hci_search_begin(hci_search *s, const char *doing, double from, double until)
{
    s->doing = doing;
    s->share = from;
    s->until = until;
    tell(s);
}

void hci_search_tell(hci_search *s)
{
    s->share += PART * (s->until - s->share);
    tell(s);
}

/* ---- models ---- */

hci_status hci_search_without(hci_search *s, const hci_fitted_model *model, const hci_effect_type *type,
                              hci_fitted_model *without, hci_note *note)
{
    hci_status status = hci_fitted_model_copy(model, without, note);
    if (status) return status;
    hci_search_tell(s);
    hci_candidates_remove_type(&without->candidates, type);
    status = hci_regression_fit(s->regression, &without->candidates, &without->fit, note);
    if (status) hci_fitted_model_release(without);
    return status;
}

/* ---- residual and noise ---- */

hci_status hci_search_residual(hci_search *s, const hci_candidates *candidates, hci_note *note)
{
    hci_model model;
    hci_status status = hci_model_make(s->regression->declared, candidates, false, &model, note);
    hci_search_tell(s);
    if (!status)
        status = hci_known_residuals_find(&s->residuals, s->regression, &model.list, s->residual_Nm, note);
    hci_model_release(&model);
    return status;
}

/* Of what the torque varies within the window of a slope a share is not known. */
static hci_status resolution_find(hci_search *s, const hci_candidates *candidates, hci_note *note)
{
    hci_model model;
    double within_Nm = 0.0;
    hci_status status = hci_model_make(s->regression->declared, candidates, false, &model, note);
    if (!status) status = hci_within_slope_find(s->regression, &model.list, &within_Nm, note);
    hci_model_release(&model);
    s->resolution_Nm = fmax(s->options->resolution_Nm, WITHIN_SLOPE * within_Nm);
    return status;
}

/* Smoothing takes the noise of currents and angle out of the residual, but not out of the few orders that
 * effects are found in. */
hci_status hci_search_noise(hci_search *s, const hci_candidates *candidates, hci_note *note)
{
    hci_status status = resolution_find(s, candidates, note);
    s->regression->raw = true;
    if (!status) status = hci_search_residual(s, candidates, note);
    s->regression->raw = false;
    if (status) return status;
    return hci_regression_noise_estimate(s->regression, s->residual_Nm, hci_candidates_terms_in(candidates),
                                         s->resolution_Nm, note);
}

hci_status hci_search_renew(hci_search *s, hci_fitted_model *model, hci_note *note)
{
    const hci_status status = hci_search_noise(s, &model->candidates, note);
    if (status) return status;
    return hci_regression_fit(s->regression, &model->candidates, &model->fit, note);
}

double hci_search_residual_rms(const hci_search *s)
{
    double sum = 0.0, count = 0.0;
    for (const hci_segment *x = NULL; (x = hci_regression_next(s->regression, x)) != NULL;) {
        const double rms = hci_regression_noise(s->regression, x)->rms;
        const double telling = (double)hci_segment_telling(s->regression->samples, x);
        for (size_t j = x->first; j < x->first + x->count; ++j)
            sum += s->residual_Nm[j] * s->residual_Nm[j];
        sum += (hci_segment_joined(x) - 1.0) * rms * rms * telling;
        count += telling;
    }
    return count > 0.0 ? sqrt(sum / count) : 0.0;
}

double hci_search_ripple_rms(const hci_search *s)
{
    double sum = 0.0, count = 0.0;
    for (const hci_segment *x = NULL; (x = hci_regression_next(s->regression, x)) != NULL;) {
        double mean[2] = {0.0, 0.0}, telling[2] = {0.0, 0.0};
        for (size_t j = x->first; j < x->first + x->count; ++j) {
            const hci_binned_sample *b = &s->regression->samples->sample[j];
            const int back = b->reading.speed_rad_per_s < 0.0;
            mean[back] += s->residual_Nm[j];
            telling[back] += b->count > 0.0 ? 1.0 : 0.0;
            sum += s->residual_Nm[j] * s->residual_Nm[j];
        }
        for (int back = 0; back < 2; ++back) {
            sum -= telling[back] > 0.0 ? mean[back] * mean[back] / telling[back] : 0.0;
            count += telling[back];
        }
    }
    return count > 0.0 ? sqrt(fmax(0.0, sum / count)) : 0.0;
}

double hci_search_noise_rms(const hci_search *s)
{
    double sum = 0.0, count = 0.0;
    for (const hci_segment *x = NULL; (x = hci_regression_next(s->regression, x)) != NULL;) {
        const double rms = hci_regression_noise(s->regression, x)->rms;
        const double telling = (double)hci_segment_telling(s->regression->samples, x);
        sum += hci_segment_joined(x) * rms * rms * telling;
        count += telling;
    }
    return count > 0.0 ? sqrt(sum / count) : 0.0;
}

/* ---- what an effect explains ---- */

/* Whether what one model has besides the other shows in the sum of the currents or in those of runs in which
 * none flowed, which say much of sensors that hardly make a torque. */
static hci_status shows_in_sums(const hci_search *s, const hci_candidates *with,
                                const hci_candidates *without, bool *shows, hci_note *note)
{
    hci_model more = {0}, less = {0};
    *shows = false;
    hci_status status = hci_model_make(s->regression->declared, with, false, &more, note);
    if (!status) status = hci_model_make(s->regression->declared, without, false, &less, note);
    if (!status) {
        const double after = hci_current_sums_rms(s->regression, &more.list);
        const double before = hci_current_sums_rms(s->regression, &less.list);
        const double zeros_after = hci_current_zeros_rms(s->regression, &more.list);
        const double zeros_before = hci_current_zeros_rms(s->regression, &less.list);
        *shows = before * before - after * after > NOTICEABLE * NOTICEABLE ||
                 zeros_before * zeros_before - zeros_after * zeros_after > ZEROS_SHOW;
    }
    hci_model_release(&more);
    hci_model_release(&less);
    return status;
}

hci_status hci_search_explained(hci_search *s, const hci_candidates *with, const hci_candidates *without,
                                double *explained_Nm, hci_note *note)
{
    hci_status status = hci_search_residual(s, with, note);
    *explained_Nm = 0.0;
    if (status) return status;
    const double after = hci_search_residual_rms(s);
    status = hci_search_residual(s, without, note);
    if (status) return status;
    const double before = hci_search_residual_rms(s);
    *explained_Nm = sqrt(fmax(0.0, before * before - after * after));
    return HCI_OK;
}

hci_status hci_search_explained_by(hci_search *s, const hci_fitted_model *model, const hci_effect_type *type,
                                   double *explained_Nm, hci_note *note)
{
    hci_fitted_model without = {0};
    *explained_Nm = 0.0;
    if (!hci_candidates_have(&model->candidates, type)) return HCI_OK;
    hci_status status = hci_search_without(s, model, type, &without, note);
    if (!status)
        status = hci_search_explained(s, &model->candidates, &without.candidates, explained_Nm, note);
    hci_fitted_model_release(&without);
    return status;
}

/* What one model has besides the other, whitened as the noise is: [samples]. */
static hci_status difference_fill(hci_search *s, const hci_candidates *with, const hci_candidates *without,
                                  double *difference_Nm, hci_note *note)
{
    const hci_binned_samples *samples = s->regression->samples;
    hci_status status = hci_search_residual(s, without, note);
    if (status) return status;
    memcpy(difference_Nm, s->residual_Nm, samples->count * sizeof *difference_Nm);
    status = hci_search_residual(s, with, note);
    if (status) return status;
    for (size_t j = 0; j < samples->count; ++j)
        difference_Nm[j] -= s->residual_Nm[j];
    for (const hci_segment *x = NULL; (x = hci_regression_next(s->regression, x)) != NULL;)
        hci_noise_whiten(hci_regression_noise(s->regression, x), difference_Nm + x->first, x->count, 1);
    return HCI_OK;
}

/* The noise of a slope is nearly all of it fast: of what varies more slowly a sample says as much as one of
 * white noise of a small part of its size. Whether an effect is noticeable beside that. */
static hci_status shows_beside_slopes(hci_search *s, const hci_candidates *with,
                                      const hci_candidates *without, bool *shows, hci_note *note)
{
    double square = 0.0, count = 0.0;
    double *difference_Nm = hci_memory_new(s->regression->samples->count + 1, sizeof *difference_Nm);
    hci_status status = difference_Nm ? difference_fill(s, with, without, difference_Nm, note)
                                      : hci_note_memory(note, NULL, "what an effect explains");
    for (const hci_segment *x = NULL; !status && (x = hci_regression_next(s->regression, x)) != NULL;) {
        for (size_t j = x->first; j < x->first + x->count; ++j)
            square += difference_Nm[j] * difference_Nm[j];
        count += hci_segment_joined(x) * (double)hci_segment_telling(s->regression->samples, x);
    }
    *shows = !status && square > NOTICEABLE * NOTICEABLE * count;
    hci_memory_free(difference_Nm);
    return status;
}

hci_status hci_search_noticeable(hci_search *s, const hci_candidates *with, const hci_candidates *without,
                                 bool *noticeable, hci_note *note)
{
    double explained_Nm;
    hci_status status = hci_search_explained(s, with, without, &explained_Nm, note);
    const double least = RESOLVED * s->resolution_Nm;
    *noticeable = !status && (explained_Nm > fmax(NOTICEABLE * hci_search_noise_rms(s), least) ||
                              hci_candidates_types_in(with) == hci_candidates_types_in(without));
    if (!status && !*noticeable && explained_Nm > least && hci_regression_has_slopes(s->regression))
        status = shows_beside_slopes(s, with, without, noticeable, note);
    if (!status && !*noticeable) status = shows_in_sums(s, with, without, noticeable, note);
    return status;
}
