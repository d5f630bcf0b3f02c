#include "host/diagnose/run_errors.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/diagnose/fit/noise_estimate.h"
#include "host/diagnose/reading/predicted_reading.h"
#include "host/diagnose/residual_spectrum.h"
#include "host/numeric/angle_bins.h"

#define SIGMA_95    1.96 /* of a normal distribution, for 95 % */
#define PER_RANGE   8.0  /* samples in a range of the turn */
#define LEAST_TURNS 3.0
#define FREEDOM     50.0

/* ---- one run ---- */

static double samples_of(const hci_dataset *b, size_t run)
{
    double count = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(&b->samples, run, s)) != NULL;)
        for (size_t j = s->first; j < s->first + s->count; ++j)
            count += b->samples.sample[j].count;
    return count;
}

/* How the residual changes along the angle, from the samples beside one of a segment. */
static double slope_at(const hci_segment *s, const hci_binned_sample *sample, const double *residual,
                       size_t j)
{
    const size_t before = j > s->first ? j - 1 : j, behind = j + 1 < s->first + s->count ? j + 1 : j;
    const double step_rad = sample[behind].raw.theta_m_rad - sample[before].raw.theta_m_rad;
    return step_rad != 0.0 ? (residual[behind] - residual[before]) / step_rad : 0.0;
}

/* Over samples: a mean over turns has the scatter of those that are in it too, and what the residual does
 * along their angles. NAN without samples. */
static double rms_of(const hci_dataset *b, size_t run, const double *residual)
{
    double sum = 0.0, count = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(&b->samples, run, s)) != NULL;)
        for (size_t j = s->first; j < s->first + s->count; ++j) {
            const hci_binned_sample *x = &b->samples.sample[j];
            const double slope = s->turns > 0 ? slope_at(s, b->samples.sample, residual, j) : 0.0;
            sum += x->count * (residual[j] * residual[j] + slope * slope * x->spread_rad2) + x->scatter_N2m2;
            count += x->count;
        }
    return count > 0.0 ? sqrt(sum / count) : (double)NAN;
}

static double mean_of(const hci_dataset *b, size_t run, const double *residual)
{
    double sum = 0.0, count = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(&b->samples, run, s)) != NULL;)
        for (size_t j = s->first; j < s->first + s->count; ++j) {
            sum += b->samples.sample[j].count * residual[j];
            count += b->samples.sample[j].count;
        }
    return count > 0.0 ? sum / count : (double)NAN;
}

static double beside_mean(double rms, double mean)
{
    return sqrt(fmax(0.0, rms * rms - mean * mean));
}

/* Of the samples in means over turns; NAN where there are none. */
static double scatter_of(const hci_dataset *b, size_t run)
{
    double sum = 0.0, freedom = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(&b->samples, run, s)) != NULL;)
        for (size_t j = s->first; j < s->first + s->count && s->turns > 0; ++j) {
            sum += b->samples.sample[j].scatter_N2m2;
            freedom += b->samples.sample[j].count - 1.0;
        }
    return freedom > FREEDOM ? sqrt(sum / freedom) : (double)NAN;
}

/* How far a sample's residual is from the mean of those at about the same angle. */
static double repeatability(const hci_dataset *b, size_t run, const double *residual, double turn_rad)
{
    hci_angle_bins bins = {0};
    double samples = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(&b->samples, run, s)) != NULL;)
        samples += (double)hci_segment_telling(&b->samples, s);
    const bool few = samples < PER_RANGE * HCI_ANGLE_BINS_MOST;
    bins.bins = few ? (size_t)(samples / PER_RANGE) + 1 : HCI_ANGLE_BINS_MOST;
    for (const hci_segment *s = NULL; (s = hci_segment_next(&b->samples, run, s)) != NULL;)
        for (size_t j = s->first; j < s->first + s->count; ++j)
            if (b->samples.sample[j].count > 0.0)
                hci_angle_bins_add(&bins, b->samples.sample[j].raw.theta_m_rad / turn_rad, residual[j]);
    return hci_angle_bins_rms(&bins, FREEDOM);
}

/* From the turns that a run has; NAN where it has too few. */
static double noise_of_turns(const hci_dataset *b, const hci_run *runs, size_t run, const double *residual)
{
    const hci_run_statistics *f = &b->samples.statistics[run];
    const double turn_rad = 2.0 * HCI_PI / (runs[run].turn_known ? 1.0 : b->regression.machine->pole_pairs);
    const double scatter = scatter_of(b, run);
    if (isfinite(scatter)) return scatter;
    if (f->turns * 2.0 * HCI_PI < LEAST_TURNS * turn_rad) return NAN;
    return repeatability(b, run, residual, turn_rad);
}

/* Readings that a sample is the mean of, on the average. */
static double readings_in_one(const hci_dataset *b, const hci_segment *s)
{
    double readings = 0.0;
    for (size_t j = s->first; j < s->first + s->count; ++j)
        readings += b->samples.sample[j].count;
    return readings / fmax(1.0, (double)hci_segment_telling(&b->samples, s));
}

/* Of a sample: from the spectrum between the orders, or, of few samples, from neighbours. */
static double noise_of_segment(const hci_dataset *b, const hci_segment *s, const double *residual)
{
    const double shared = hci_regression_noise(&b->regression, s)->rms;
    const double own = s->count < HCI_NOISE_LEAST && s->turns == 0
                           ? hci_noise_of_neighbours(residual + s->first, s->count)
                           : (double)NAN;
    return fmin(shared, own);
}

/* Of one reading; NAN without samples. */
static double noise_of_spectrum(const hci_dataset *b, size_t run, const double *residual)
{
    double sum = 0.0, count = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(&b->samples, run, s)) != NULL;) {
        const double rms = noise_of_segment(b, s, residual);
        sum += (double)s->count * rms * rms * readings_in_one(b, s);
        count += (double)s->count;
    }
    return count > 0.0 ? sqrt(sum / count) : (double)NAN;
}

/* The relative deviation of an rms of n samples is 1/√(2n). */
static hci_run_errors errors_of(const hci_dataset *b, const hci_runs *runs, size_t run, const double *before,
                                const double *after)
{
    hci_run_errors e = {
        .file = runs->run[run].name, .role = runs->role[run], .source = runs->run[run].torque_source};
    const double spread = SIGMA_95 / sqrt(2.0 * samples_of(b, run));
    e.mean_torque_Nm = b->samples.statistics[run].mean_torque_Nm;
    const double rms_Nm = b->samples.statistics[run].rms_torque_Nm;
    e.torque_varies_Nm = sqrt(fmax(0.0, rms_Nm * rms_Nm - e.mean_torque_Nm * e.mean_torque_Nm));
    e.slip_rad = b->index_offset_rad[run];
    e.rms_before_Nm = rms_of(b, run, before);
    e.rms_after_Nm = rms_of(b, run, after);
    e.error_mean_before_Nm = mean_of(b, run, before);
    e.error_mean_after_Nm = mean_of(b, run, after);
    e.ripple_before_Nm = beside_mean(e.rms_before_Nm, e.error_mean_before_Nm);
    e.ripple_after_Nm = beside_mean(e.rms_after_Nm, e.error_mean_after_Nm);
    e.noise_floor_Nm = noise_of_turns(b, runs->run, run, after);
    const double spectral_Nm = noise_of_spectrum(b, run, after);
    e.unrepeated_Nm = isfinite(e.noise_floor_Nm) ? beside_mean(e.noise_floor_Nm, spectral_Nm) : (double)NAN;
    if (!isfinite(e.noise_floor_Nm)) e.noise_floor_Nm = spectral_Nm;
    e.after_low_Nm = e.rms_after_Nm * fmax(0.0, 1.0 - spread);
    e.after_high_Nm = e.rms_after_Nm * (1.0 + spread);
    return e;
}

/* ---- all runs ---- */

static hci_status lines_fill(const hci_dataset *b, const double *before, const double *after,
                             hci_diagnosis *d, hci_note *note)
{
    double *noise_Nm = hci_memory_new(b->samples.run_count + 1, sizeof *noise_Nm);
    if (!noise_Nm) return hci_note_memory(note, NULL, "the errors of the recordings");
    for (size_t r = 0; r < b->samples.run_count; ++r)
        noise_Nm[r] = noise_of_spectrum(b, r, after);
    const hci_residuals residuals = {before, after, noise_Nm};
    const hci_status status =
        hci_residual_spectrum_make(&b->regression, &residuals, &d->line, &d->lines, note);
    hci_memory_free(noise_Nm);
    return status;
}

static hci_status runs_fill(const hci_dataset *b, const hci_runs *runs, const double *before,
                            const double *after, hci_diagnosis *d, hci_note *note)
{
    d->run = hci_memory_new(runs->count + 1, sizeof *d->run);
    if (!d->run) return hci_note_memory(note, NULL, "the errors of the recordings");
    for (size_t k = 0; k < runs->count; ++k)
        if (hci_segment_next(&b->samples, k, NULL)) d->run[d->runs++] = errors_of(b, runs, k, before, after);
    return HCI_OK;
}

/* Root mean square over the runs of one role of one of their errors; NAN where there is none. */
static double total_of(const hci_diagnosis *d, hci_role role, size_t member)
{
    double sum = 0.0, count = 0.0;
    for (size_t k = 0; k < d->runs; ++k) {
        const double *x = (const double *)(const void *)((const char *)&d->run[k] + member);
        if (d->run[k].role != role) continue;
        sum += *x * *x;
        count += 1.0;
    }
    return count > 0.0 ? sqrt(sum / count) : (double)NAN;
}

void hci_run_errors_total(hci_diagnosis *d)
{
    const hci_role fit = HCI_ROLE_FIT, test = HCI_ROLE_HOLDOUT;
    d->rms_before_Nm = total_of(d, fit, offsetof(hci_run_errors, rms_before_Nm));
    d->rms_after_Nm = total_of(d, fit, offsetof(hci_run_errors, rms_after_Nm));
    d->noise_Nm = total_of(d, fit, offsetof(hci_run_errors, noise_floor_Nm));
    d->holdout_before_Nm = total_of(d, test, offsetof(hci_run_errors, rms_before_Nm));
    d->holdout_after_Nm = total_of(d, test, offsetof(hci_run_errors, rms_after_Nm));
    d->holdout_noise_Nm = total_of(d, test, offsetof(hci_run_errors, noise_floor_Nm));
    d->holdout_mean_before_Nm = total_of(d, test, offsetof(hci_run_errors, error_mean_before_Nm));
    d->holdout_mean_after_Nm = total_of(d, test, offsetof(hci_run_errors, error_mean_after_Nm));
    d->holdout_ripple_before_Nm = total_of(d, test, offsetof(hci_run_errors, ripple_before_Nm));
    d->holdout_ripple_after_Nm = total_of(d, test, offsetof(hci_run_errors, ripple_after_Nm));
}

/* before: [2·samples], the residual without and behind it the one with the correction. */
static hci_status residuals_fill(hci_dataset *b, const hci_effects *effects, size_t parameters,
                                 double *before, hci_note *note)
{
    double *after = before + b->samples.count;
    hci_status status = hci_regression_residual(&b->regression, b->regression.declared, before, note);
    if (!status) status = hci_regression_residual(&b->regression, effects, after, note);
    if (!status) status = hci_regression_noise_estimate(&b->regression, after, parameters, 0.0, note);
    return status;
}

/* lines: whether those of the spectrum are wanted. */
static hci_status fill(hci_dataset *b, const hci_runs *runs, size_t parameters, bool lines, hci_diagnosis *d,
                       hci_note *note)
{
    double *before = hci_memory_new(2 * b->samples.count + 1, sizeof *before);
    if (!before) return hci_note_memory(note, NULL, "the errors of the recordings");
    double *after = before + b->samples.count;
    b->regression.use = b->any;
    b->regression.raw = true;
    hci_status status = residuals_fill(b, &d->effects.list, parameters, before, note);
    if (!status && lines) status = lines_fill(b, before, after, d, note);
    if (!status) status = runs_fill(b, runs, before, after, d, note);
    b->regression.use = b->fit;
    b->regression.raw = false;
    hci_memory_free(before);
    return status;
}

hci_status hci_run_errors_fill(hci_dataset *b, const hci_runs *runs, size_t parameters, hci_diagnosis *d,
                               hci_note *note)
{
    const hci_status status = fill(b, runs, parameters, true, d, note);
    if (!status) hci_run_errors_total(d);
    return status;
}

hci_status hci_run_errors_of(hci_dataset *b, const hci_runs *runs, const hci_effects *effects,
                             hci_diagnosis *d, hci_note *note)
{
    memset(d, 0, sizeof *d);
    d->effects.list = *effects;
    return fill(b, runs, 0, false, d, note);
}
