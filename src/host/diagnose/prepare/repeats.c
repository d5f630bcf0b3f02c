#include "host/diagnose/prepare/repeats.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/prepare/swing.h"
#include "host/numeric/fft.h"
#include "host/recording/rotor_frame.h"

#define OF_NOISE 30.0 /* times the mean of the spectrum, of a line: of 10⁵ runs by chance in one */
#define ALIKE    0.25 /* correlation of neighbours; what lies between samples is as much by being found there */

enum { CHANNELS = 3, POINTS = 4 /* of a polynomial */ };

/* Changes from one turn to the next. */
typedef struct {
    const hci_run *run;
    double *value;     /* [CHANNELS][samples] of the torque, i_d and i_q */
    double *change;    /* [samples] */
    double *re, *im;   /* [size] */
    size_t from, next; /* first sample that has a turn before it, and behind the last */
    size_t size;
    double turn_rad, direction;
} changes;

static void values_fill(const changes *x, const hci_run_statistics *statistics, int pole_pairs)
{
    const hci_run *r = x->run;
    for (size_t k = 0; k < r->count; ++k) {
        const hci_dq i = hci_run_dq(r, pole_pairs, k);
        const double swing_Nm = statistics->swings > 0 ? hci_swings_at_Nm(statistics, r->time_s[k]) : 0.0;
        x->value[k] = r->torque_Nm[k] - swing_Nm;
        x->value[r->count + k] = i.d;
        x->value[2 * r->count + k] = i.q;
    }
}

/* Weights of so many samples from one on, of the polynomial through them at an angle; false where two of the
 * angles are the same. */
static bool weights_find(const double *theta, double at, double weight[POINTS])
{
    for (int j = 0; j < POINTS; ++j) {
        weight[j] = 1.0;
        for (int k = 0; k < POINTS; ++k)
            if (k != j) weight[j] *= (at - theta[k]) / (theta[j] - theta[k]);
        if (!isfinite(weight[j])) return false;
    }
    return true;
}

/* Of one channel: each value less that at the angle one turn before. */
static bool changes_fill(const changes *x, const double *value)
{
    const double *theta = x->run->theta_m_rad;
    size_t before = 0;
    for (size_t k = x->from; k < x->next; ++k) {
        const double at = theta[k] - x->direction * x->turn_rad;
        double weight[POINTS];
        while (before + 1 < k && x->direction * (theta[before + 1] - at) <= 0.0)
            ++before;
        const size_t first = before > 0 ? before - 1 : 0;
        if (first + POINTS > x->run->count || !weights_find(theta + first, at, weight)) return false;
        x->change[k - x->from] = value[k];
        for (size_t j = 0; j < POINTS; ++j)
            x->change[k - x->from] -= weight[j] * value[first + j];
    }
    return true;
}

static bool has_line(const changes *x)
{
    const size_t n = x->next - x->from;
    double sum = 0.0, most = 0.0;
    memset(x->re, 0, 2 * x->size * sizeof *x->re);
    memcpy(x->re, x->change, n * sizeof *x->re);
    hci_fft(x->re, x->im, x->size, -1);
    for (size_t k = 0; k < x->size / 2; ++k) {
        const double power = x->re[k] * x->re[k] + x->im[k] * x->im[k];
        sum += power;
        most = fmax(most, power);
    }
    return most * (double)(x->size / 2) > OF_NOISE * sum;
}

/* Whether neighbours have something in common. */
static bool goes_on(const changes *x)
{
    const size_t n = x->next - x->from;
    double square = 0.0, product = 0.0;
    for (size_t k = 1; k < n; ++k) {
        square += x->change[k] * x->change[k];
        product += x->change[k] * x->change[k - 1];
    }
    return fabs(product) > ALIKE * square;
}

static bool is_white(const changes *x)
{
    return !has_line(x) && !goes_on(x);
}

static bool changes_make(const hci_run *run, size_t next, changes *x)
{
    *x = (changes){.run = run, .next = next, .size = hci_fft_size((double)run->count)};
    x->value = hci_memory_new((CHANNELS + 1) * run->count + 2 * x->size + 1, sizeof *x->value);
    if (!x->value) return false;
    x->change = x->value + CHANNELS * run->count;
    x->re = x->change + run->count;
    x->im = x->re + x->size;
    return true;
}

bool hci_repeats_find(const hci_run *run, const hci_run_statistics *statistics, int pole_pairs,
                      const hci_turn *turns, size_t count, bool *repeats)
{
    changes x;
    const hci_turn *last = &turns[count - 1];
    if (!changes_make(run, last->first + last->count, &x)) return false;
    x.from = turns[1].first;
    x.turn_rad = hci_turn_rad(run, pole_pairs);
    x.direction = hci_turn_direction(run, turns[0].first, x.next - 1);
    values_fill(&x, statistics, pole_pairs);
    *repeats = true;
    for (int k = 0; k < CHANNELS && *repeats; ++k)
        *repeats = changes_fill(&x, x.value + (size_t)k * run->count) && is_white(&x);
    hci_memory_free(x.value);
    return true;
}
