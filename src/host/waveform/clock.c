/* Frequency and drift by nonlinear least squares, from a first guess by zero crossings. */
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "hci/math/dense.h"
#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/waveform/clock.h"

enum {
    CROSSINGS_LEAST = 3,
    HARMONICS_MOST = 13,
    COLUMNS_MOST = 1 + 2 * HARMONICS_MOST, /* offset, and sine and cosine of each */
    SAMPLES_A_HARMONIC = 4,
    PERIODS_FEW = 100, /* in a longer record what is left of high harmonics hardly moves the phase */
    HARMONICS_OF_MANY = 5,
    SAMPLES_LEAST = 16,
    STEPS_MOST = 30
};

/* A crossing counts when the voltage goes on to half its rms. */
#define HYSTERESIS 0.5

/* rms departure of the crossings from an even clock, in periods, at which they can still be counted. */
#define UNEVEN 0.1

/* ---- a first guess, from rising zero crossings ---- */

/* turns(τ) = turn[0] + turn[1] τ + turn[2] τ²/2, τ from the middle of the record. */
typedef struct {
    double turn[3];
    double misfit; /* rms, in turns */
} clock_guess;

typedef struct {
    double moment[5], product[3]; /* Σ u^j, Σ u^j k of crossing k */
    double square;
    size_t count;
} crossing_sums;

static void add_crossing(crossing_sums *s, double u)
{
    const double k = (double)s->count++;
    double power = 1.0;
    for (int j = 0; j < 5; ++j, power *= u) {
        s->moment[j] += power;
        if (j < 3) s->product[j] += power * k;
    }
    s->square += k * k;
}

/* Rising crossings of a channel's mean, each where it is crossed by interpolation. u: time from the middle,
 * over half the record. */
static void find_crossings(const double *time_s, const double *v, size_t n, double mean, double rms,
                           crossing_sums *s)
{
    const double middle = 0.5 * (time_s[0] + time_s[n - 1]), half = 0.5 * (time_s[n - 1] - time_s[0]);
    bool armed = false;
    double crossing = 0.0;
    for (size_t k = 1; k < n; ++k) {
        const double before = v[3 * (k - 1)] - mean, now = v[3 * k] - mean;
        if (before <= 0.0 && now > 0.0)
            crossing = time_s[k - 1] + (time_s[k] - time_s[k - 1]) * before / (before - now);
        if (now < -HYSTERESIS * rms) armed = true;
        if (!armed || now < HYSTERESIS * rms) continue;
        armed = false;
        add_crossing(s, (crossing - middle) / half);
    }
}

/* The parabola (with few crossings the straight line) of turns over time by least squares. */
static bool fit_crossings(const crossing_sums *s, double half_s, clock_guess *guess)
{
    const size_t terms = s->count > CROSSINGS_LEAST ? 3 : 2;
    double a[9], x[3] = {0.0, 0.0, 0.0};
    if (s->count < CROSSINGS_LEAST) return false;
    for (size_t i = 0; i < terms; ++i) {
        x[i] = s->product[i];
        for (size_t j = 0; j < terms; ++j)
            a[i + j * terms] = s->moment[i + j];
    }
    if (hci_cholesky_factor(terms, a)) return false;
    hci_cholesky_solve(terms, a, x);
    double square = s->square;
    for (size_t i = 0; i < terms; ++i)
        square -= x[i] * s->product[i];
    guess->misfit = sqrt(fmax(square, 0.0) / (double)s->count);
    guess->turn[0] = x[0];
    guess->turn[1] = x[1] / half_s;
    guess->turn[2] = 2.0 * x[2] / (half_s * half_s);
    return guess->turn[1] > 0.0;
}

static void mean_and_rms(const double *v, size_t n, double *mean, double *rms)
{
    double sum = 0.0, square = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += v[3 * k] / (double)n;
    for (size_t k = 0; k < n; ++k)
        square += (v[3 * k] - sum) * (v[3 * k] - sum);
    *mean = sum;
    *rms = sqrt(square / (double)n);
}

/* By the channel whose crossings are most even. rms: out, of each channel about its mean. */
static bool guess_clock(const double *time_s, const double *v, size_t n, double rms[3], clock_guess *best)
{
    bool found = false;
    best->misfit = INFINITY;
    for (int s = 0; s < 3; ++s) {
        crossing_sums sums = {.count = 0};
        clock_guess guess;
        double mean;
        mean_and_rms(v + s, n, &mean, &rms[s]);
        if (!(rms[s] > 0.0)) continue;
        find_crossings(time_s, v + s, n, mean, rms[s], &sums);
        if (!fit_crossings(&sums, 0.5 * (time_s[n - 1] - time_s[0]), &guess)) continue;
        if (guess.misfit < best->misfit) *best = guess;
        found = true;
    }
    return found && best->misfit < UNEVEN;
}

/* ---- the least squares ----
 *
 *     v_s(t) = o_s + g(t) Σ_h S_sh sin hφ + C_sh cos hφ,    φ = 2π(f τ + ½ a τ²),    g = φ'/(2πf)
 *
 * linear in o, S, C, so that f and a are found by Gauss–Newton in what these leave (variable projection). */

typedef struct {
    const double *time_s, *v;
    size_t n, harmonics, columns;
    double middle_s, half_s;
    double weight[3];                    /* 1/rms² of each channel */
    double frequency_Hz, drift_Hz_per_s; /* f, a */
    double gram[COLUMNS_MOST * COLUMNS_MOST],
        coefficient[3][COLUMNS_MOST];                                  /* Cholesky factor of XᵀX; o, S, C */
    double crossed[3][2][COLUMNS_MOST], slope_gram[3], slope_right[2]; /* XᵀJ, JᵀJ, Jᵀr */
} clock_fit;

/* The row of X, and ∂φ/∂f, ∂φ/∂a over half the record. */
static void row_at(const clock_fit *c, size_t k, double x[COLUMNS_MOST], double by[2])
{
    const double tau = c->time_s[k] - c->middle_s, u = tau / c->half_s;
    const double phase = 2.0 * HCI_PI * (c->frequency_Hz + 0.5 * c->drift_Hz_per_s * tau) * tau;
    const double g = 1.0 + c->drift_Hz_per_s * tau / c->frequency_Hz;
    const double cosine = cos(phase), sine = sin(phase);
    double s = sine, co = cosine;
    x[0] = 1.0;
    for (size_t h = 0; h < c->harmonics; ++h) {
        x[1 + 2 * h] = g * s;
        x[2 + 2 * h] = g * co;
        const double next = s * cosine + co * sine;
        co = co * cosine - s * sine;
        s = next;
    }
    by[0] = u;
    by[1] = u * u;
}

static hci_status fit_linear(clock_fit *c)
{
    memset(c->gram, 0, sizeof c->gram);
    memset(c->coefficient, 0, sizeof c->coefficient);
    for (size_t k = 0; k < c->n; ++k) {
        double x[COLUMNS_MOST], by[2];
        row_at(c, k, x, by);
        for (size_t j = 0; j < c->columns; ++j) {
            for (size_t i = j; i < c->columns; ++i)
                c->gram[i + j * c->columns] += x[i] * x[j];
            for (int s = 0; s < 3; ++s)
                c->coefficient[s][j] += x[j] * c->v[3 * k + (size_t)s];
        }
    }
    const hci_status status = hci_cholesky_factor(c->columns, c->gram);
    for (int s = 0; s < 3 && !status; ++s)
        hci_cholesky_solve(c->columns, c->gram, c->coefficient[s]);
    return status;
}

/* Adds a sample of one channel: residual, and J = ∂v/∂φ (∂φ/∂f, ∂φ/∂a). */
static void add_slope(clock_fit *c, size_t k, int s, const double x[COLUMNS_MOST], const double by[2])
{
    const double *coefficient = c->coefficient[s];
    double model = coefficient[0], by_phase = 0.0;
    for (size_t h = 1; h <= c->harmonics; ++h) {
        const double sine = coefficient[2 * h - 1], cosine = coefficient[2 * h];
        model += sine * x[2 * h - 1] + cosine * x[2 * h];
        by_phase += (double)h * (sine * x[2 * h] - cosine * x[2 * h - 1]);
    }
    const double residual = c->v[3 * k + (size_t)s] - model;
    for (int q = 0; q < 2; ++q) {
        const double slope = by_phase * by[q];
        c->slope_right[q] += c->weight[s] * slope * residual;
        for (size_t j = 0; j < c->columns; ++j)
            c->crossed[s][q][j] += slope * x[j];
    }
    c->slope_gram[0] += c->weight[s] * by_phase * by_phase * by[0] * by[0];
    c->slope_gram[1] += c->weight[s] * by_phase * by_phase * by[0] * by[1];
    c->slope_gram[2] += c->weight[s] * by_phase * by_phase * by[1] * by[1];
}

/* JᵀJ − JᵀX (XᵀX)⁻¹ XᵀJ: what of J the linear part cannot make. */
static void project(clock_fit *c)
{
    for (int s = 0; s < 3; ++s) {
        double solved[2][COLUMNS_MOST];
        memcpy(solved, c->crossed[s], sizeof solved);
        for (int q = 0; q < 2; ++q)
            hci_cholesky_solve(c->columns, c->gram, solved[q]);
        for (size_t j = 0; j < c->columns; ++j) {
            c->slope_gram[0] -= c->weight[s] * c->crossed[s][0][j] * solved[0][j];
            c->slope_gram[1] -= c->weight[s] * c->crossed[s][0][j] * solved[1][j];
            c->slope_gram[2] -= c->weight[s] * c->crossed[s][1][j] * solved[1][j];
        }
    }
}

/* One Gauss–Newton step; returns by how much the phase at the ends moves, in rad. */
static double improve(clock_fit *c)
{
    memset(c->crossed, 0, sizeof c->crossed);
    memset(c->slope_gram, 0, sizeof c->slope_gram);
    memset(c->slope_right, 0, sizeof c->slope_right);
    for (size_t k = 0; k < c->n; ++k) {
        double x[COLUMNS_MOST], by[2];
        row_at(c, k, x, by);
        for (int s = 0; s < 3; ++s)
            add_slope(c, k, s, x, by);
    }
    project(c);
    const double *m = c->slope_gram, *r = c->slope_right, determinant = m[0] * m[2] - m[1] * m[1];
    if (!(determinant > 1e-12 * m[0] * m[2])) return NAN;
    const double first = (m[2] * r[0] - m[1] * r[1]) / determinant;
    const double second = (m[0] * r[1] - m[1] * r[0]) / determinant;
    c->frequency_Hz += first / (2.0 * HCI_PI * c->half_s);
    c->drift_Hz_per_s += second / (HCI_PI * c->half_s * c->half_s);
    return fabs(first) + fabs(second);
}

static hci_status fit_clock(clock_fit *c)
{
    double moved = 1.0;
    for (int step = 0; step < STEPS_MOST && moved > 1e-10; ++step) {
        const hci_status status = fit_linear(c);
        if (status) return HCI_ERROR_SINGULAR;
        moved = improve(c);
        if (!(moved < 10.0) || !(c->frequency_Hz > 0.0)) return HCI_ERROR_SINGULAR;
    }
    return moved <= 1e-4 ? HCI_OK : HCI_ERROR_SINGULAR;
}

static size_t harmonics_of(size_t samples, double periods)
{
    const double bears = fmax((double)samples / periods / SAMPLES_A_HARMONIC, 1.0);
    const double wanted = periods > PERIODS_FEW ? HARMONICS_OF_MANY : HARMONICS_MOST;
    return (size_t)fmin(bears, wanted);
}

hci_status hci_voltage_clock_find(const double *time_s, const double *v, size_t n, double *phase_rad,
                                  double *rate_rad_per_s, hci_voltage_clock *clock)
{
    clock_guess guess = {.misfit = 0.0};
    double rms[3];
    if (n < SAMPLES_LEAST || !guess_clock(time_s, v, n, rms, &guess)) return HCI_ERROR_SINGULAR;
    clock_fit c = {.time_s = time_s, .v = v, .n = n};
    c.middle_s = 0.5 * (time_s[0] + time_s[n - 1]);
    c.half_s = 0.5 * (time_s[n - 1] - time_s[0]);
    c.frequency_Hz = guess.turn[1];
    c.drift_Hz_per_s = guess.turn[2];
    for (int s = 0; s < 3; ++s)
        c.weight[s] = rms[s] > 0.0 ? 1.0 / (rms[s] * rms[s]) : 0.0;
    c.harmonics = harmonics_of(n, 2.0 * c.half_s * c.frequency_Hz);
    c.columns = 1 + 2 * c.harmonics;
    const hci_status status = fit_clock(&c);
    if (status) return status;
    for (size_t k = 0; k < n; ++k) {
        const double tau = time_s[k] - c.middle_s;
        phase_rad[k] = 2.0 * HCI_PI * (c.frequency_Hz + 0.5 * c.drift_Hz_per_s * tau) * tau;
        rate_rad_per_s[k] = 2.0 * HCI_PI * (c.frequency_Hz + c.drift_Hz_per_s * tau);
    }
    *clock = (hci_voltage_clock){c.frequency_Hz, c.drift_Hz_per_s};
    return HCI_OK;
}
