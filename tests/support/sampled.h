/* A second implementation for the tests: back-EMF, currents and torque sampled over whole electrical turns
 * from their sine formulas, and the naive Fourier sum of the torque. Bin k is order k/turns.
 *
 *     T(θ) = Σ_s e_s i_s + T_cog,   e_s = Σ E sin(μ(θ − 2πs/3) + φ),   i_s = Σ S sin(nθ − σ2πs/3) + C cos(…)
 */
#ifndef SAMPLED_H
#define SAMPLED_H

#include "support/reference.h"

enum { SAMPLED_MOST = 8192 };

typedef struct {
    size_t turns, count;
    double table[SAMPLED_MOST]; /* sin(2πk/count) */
    double e[3][SAMPLED_MOST], cogging[SAMPLED_MOST];
    double i[3][SAMPLED_MOST], torque[SAMPLED_MOST];
    double sine[SAMPLED_MOST / 2], cosine[SAMPLED_MOST / 2]; /* of the torque */
} sampled;

static inline size_t sampled_bin(const sampled *w, double order)
{
    return (size_t)floor(order * (double)w->turns + 0.5);
}

/* Adds S sin(nθ − shift) + C cos(nθ − shift) to x. */
static inline void sampled_add(const sampled *w, double order, double s, double c, double shift, double *x)
{
    const double a = s * cos(shift) + c * sin(shift), b = c * cos(shift) - s * sin(shift);
    const size_t bin = sampled_bin(w, order);
    for (size_t j = 0; j < w->count; ++j) {
        const size_t k = bin * j % w->count;
        x[j] += a * w->table[k] + b * w->table[(k + w->count / 4) % w->count];
    }
}

/* per_turn: a multiple of 4, more than twice the highest order. cogging: shift is not used. */
static inline void sampled_machine(sampled *w, size_t turns, size_t per_turn, const ref_wave *emf,
                                   size_t emf_count, const ref_wave *cogging, size_t cogging_count)
{
    w->turns = turns;
    w->count = turns * per_turn;
    for (size_t j = 0; j < w->count; ++j) {
        w->table[j] = sin(2.0 * REF_PI * (double)j / (double)w->count);
        w->e[0][j] = w->e[1][j] = w->e[2][j] = w->cogging[j] = 0.0;
    }
    for (size_t k = 0; k < emf_count; ++k)
        for (int s = 0; s < 3; ++s)
            sampled_add(w, emf[k].order, emf[k].amplitude * cos(emf[k].phase),
                        emf[k].amplitude * sin(emf[k].phase), emf[k].order * 2.0 * REF_PI * s / 3.0, w->e[s]);
    for (size_t k = 0; k < cogging_count; ++k)
        sampled_add(w, cogging[k].order, cogging[k].amplitude * cos(cogging[k].phase),
                    cogging[k].amplitude * sin(cogging[k].phase), 0.0, w->cogging);
}

/* Fills i and torque; with_cogging 0 gives e·i alone. */
static inline void sampled_currents(sampled *w, const hci_wave *waves, size_t count, int with_cogging)
{
    for (int s = 0; s < 3; ++s)
        for (size_t j = 0; j < w->count; ++j)
            w->i[s][j] = 0.0;
    for (size_t k = 0; k < count; ++k)
        for (int s = 0; s < 3; ++s)
            sampled_add(w, waves[k].order, waves[k].sine, waves[k].cosine,
                        waves[k].sequence * 2.0 * REF_PI * s / 3.0, w->i[s]);
    for (size_t j = 0; j < w->count; ++j)
        w->torque[j] = w->e[0][j] * w->i[0][j] + w->e[1][j] * w->i[1][j] + w->e[2][j] * w->i[2][j] +
                       (with_cogging ? w->cogging[j] : 0.0);
}

/* Fills sine and cosine below `bins` (at most count/2). */
static inline void sampled_spectrum(sampled *w, size_t bins)
{
    for (size_t m = 0; m < bins; ++m) {
        double s = 0.0, c = 0.0;
        for (size_t j = 0, k = 0; j < w->count; ++j, k = (k + m) % w->count) {
            s += w->torque[j] * w->table[k];
            c += w->torque[j] * w->table[(k + w->count / 4) % w->count];
        }
        w->sine[m] = m == 0 ? 0.0 : 2.0 * s / (double)w->count;
        w->cosine[m] = (m == 0 ? 1.0 : 2.0) * c / (double)w->count;
    }
}

/* Mean of i_a² + i_b² + i_c². */
static inline double sampled_mean_square(const sampled *w)
{
    double sum = 0.0;
    for (int s = 0; s < 3; ++s)
        for (size_t j = 0; j < w->count; ++j)
            sum += w->i[s][j] * w->i[s][j];
    return sum / (double)w->count;
}

static inline double sampled_peak(const sampled *w)
{
    double peak = 0.0;
    for (int s = 0; s < 3; ++s)
        for (size_t j = 0; j < w->count; ++j)
            peak = fmax(peak, fabs(w->i[s][j]));
    return peak;
}

/* e⊥ at sample j, e⊥·e⊥ returned. */
static inline double sampled_normal(const sampled *w, size_t j, int has_neutral, double e[3])
{
    const double mean = has_neutral ? 0.0 : (w->e[0][j] + w->e[1][j] + w->e[2][j]) / 3.0;
    for (int s = 0; s < 3; ++s)
        e[s] = w->e[s][j] - mean;
    return e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
}

/* Mean of (T* − T_cog)²/(e⊥·e⊥): the copper of the pointwise limit. wanted: T* at each sample. */
static inline double sampled_limit(const sampled *w, const double *wanted, int has_neutral)
{
    double sum = 0.0;
    for (size_t j = 0; j < w->count; ++j) {
        double e[3];
        const double torque = wanted[j] - w->cogging[j];
        sum += torque * torque / sampled_normal(w, j, has_neutral, e);
    }
    return sum / (double)w->count;
}

#endif
