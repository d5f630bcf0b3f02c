/* A second implementation for the tests: waves by their sine formula, sampled over whole electrical turns,
 * and a naive Fourier sum. It takes nothing from the library but the wave and harmonic structs. */
#ifndef REFERENCE_H
#define REFERENCE_H

#include <math.h>
#include <stddef.h>

#include "hci/math/harmonic.h"
#include "support/draws.h"

#define REF_SAMPLES 256 /* a multiple of 4 */
#define REF_BAND    (REF_SAMPLES / 2)

/* A sin(nθ − shift·2πs/3 + γ): shift is the order for a waveform that is alike in each phase, else the
 * sequence σ. */
typedef struct {
    double order, shift, amplitude, phase;
} ref_wave;

/* Σ S sin + C cos per bin; bin m is order m/turns. */
typedef struct {
    double sine[REF_BAND], cosine[REF_BAND];
} ref_spectrum;

static inline double ref_wave_at(const ref_wave *w, int s, double theta)
{
    return w->amplitude * sin(w->order * theta - w->shift * 2.0 * REF_PI * s / 3.0 + w->phase);
}

static inline double ref_waves_at(const ref_wave *w, size_t count, int s, double theta)
{
    double sum = 0.0;
    for (size_t k = 0; k < count; ++k)
        sum += ref_wave_at(&w[k], s, theta);
    return sum;
}

static inline double ref_amplitude_sum(const ref_wave *w, size_t count)
{
    double sum = 0.0;
    for (size_t k = 0; k < count; ++k)
        sum += fabs(w[k].amplitude);
    return sum;
}

/* θ of sample j over `turns` electrical turns. */
static inline double ref_theta(size_t j, int turns)
{
    return 2.0 * REF_PI * turns * (double)j / REF_SAMPLES;
}

static inline void ref_transform(const double *x, ref_spectrum *out)
{
    double table[REF_SAMPLES];
    for (size_t k = 0; k < REF_SAMPLES; ++k)
        table[k] = sin(2.0 * REF_PI * (double)k / REF_SAMPLES);
    for (size_t m = 0; m < REF_BAND; ++m) {
        double s = 0.0, c = 0.0;
        for (size_t j = 0; j < REF_SAMPLES; ++j) {
            s += x[j] * table[m * j % REF_SAMPLES];
            c += x[j] * table[(m * j + REF_SAMPLES / 4) % REF_SAMPLES];
        }
        out->sine[m] = m == 0 ? 0.0 : 2.0 * s / REF_SAMPLES;
        out->cosine[m] = (m == 0 ? 1.0 : 2.0) * c / REF_SAMPLES;
    }
}

/* The larger of two errors; a NaN stays. */
static inline double ref_worse(double worst, double error)
{
    return isnan(worst) || worst >= fabs(error) ? worst : fabs(error);
}

/* Largest distance of a spectrum from the reference at every bin; a bin that is not listed must be zero in
 * the reference, unless `skip` marks it. skip: REF_BAND flags or NULL. */
static inline double ref_distance(const ref_spectrum *reference, const hci_harmonic *spectrum, size_t count,
                                  int turns, const unsigned char *skip)
{
    double worst = 0.0;
    for (size_t m = 0; m < REF_BAND; ++m) {
        double s = 0.0, c = 0.0;
        if (skip != NULL && skip[m]) continue;
        for (size_t k = 0; k < count; ++k) {
            if (fabs(spectrum[k].order * turns - (double)m) > 1e-3) continue;
            s += spectrum[k].sine;
            c += spectrum[k].cosine;
        }
        worst = ref_worse(ref_worse(worst, s - reference->sine[m]), c - reference->cosine[m]);
    }
    return worst;
}

#endif
