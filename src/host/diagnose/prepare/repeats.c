#include "host/diagnose/prepare/repeats.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/diagnose/prepare/drift.h"
#include "host/diagnose/prepare/swing.h"
#include "host/numeric/fft.h"
#include "host/numeric/statistics.h"
#include "host/recording/rotor_frame.h"

#define OF_NOISE   30.0 /* times the mean of the spectrum, of a line: of 10⁵ runs by chance in one */
#define ALIKE      0.25 /* correlation of neighbours */
#define SLOW_POWER 4.0  /* times the noise of higher orders, of noise that is slow */
#define FOLLOWS    4.0  /* standard errors by which the torque goes along with a current */
#define SHARED     1.94 /* times the variance of a product of departures, of which neighbours share their noise \
                         */
#define NONE 1e-4       /* of the torque or the current of a run, rms, that is next to nothing or rounding */

enum { CHANNELS = 3 };

enum { SLOW_FROM = 1, SLOW_UNTIL = 5, ABOVE_FROM = 20, ABOVE_UNTIL = 40 }; /* orders of the turn */

/* Means over bins of the turn. Angles are those within the turn. */
typedef struct {
    double *theta_rad, *value, *count; /* [bins]; bins without samples are left out */
    size_t bins;
} means;

typedef struct {
    const hci_repeats_question *q;
    double *theta_rad; /* [samples], within the turn */
    double *value;     /* [samples], of one channel */
    double *re, *im;   /* [size] */
    size_t *bin;       /* [samples], among those that are not empty */
    size_t *place;     /* [bins] */
    means mean;
    size_t size;
    double turn_rad;
} departures;

static double channel_at(const hci_repeats_question *q, int channel, size_t k)
{
    if (channel == 0) {
        const hci_run_statistics *f = q->statistics;
        return q->run->torque_Nm[k] - (f->swings > 0 ? hci_swings_at_Nm(f, q->run->time_s[k]) : 0.0) -
               (f->drift.degree > 0 ? hci_drift_at_Nm(&f->drift, q->run->time_s[k]) : 0.0);
    }
    const hci_dq i = hci_run_dq(q->run, q->pole_pairs, k);
    return channel == 1 ? i.d : i.q;
}

/* Which samples are in which bin, and the mean angle of each. */
static void bins_fill(departures *x)
{
    const hci_repeats_question *q = x->q;
    memset(x->mean.theta_rad, 0, 3 * q->bins * sizeof *x->mean.theta_rad);
    for (size_t k = 0; k < q->count; ++k) {
        const double theta = q->run->theta_m_rad[q->first + k];
        x->theta_rad[k] = theta - x->turn_rad * floor(theta / x->turn_rad);
        const size_t at = (size_t)(x->theta_rad[k] / x->turn_rad * (double)q->bins);
        x->bin[k] = at < q->bins ? at : q->bins - 1;
        x->mean.count[x->bin[k]] += 1.0;
    }
    x->mean.bins = 0;
    for (size_t b = 0; b < q->bins; ++b)
        if (x->mean.count[b] > 0.0) {
            x->place[b] = x->mean.bins;
            x->mean.count[x->mean.bins++] = x->mean.count[b];
        }
    for (size_t k = 0; k < q->count; ++k) {
        x->bin[k] = x->place[x->bin[k]];
        x->mean.theta_rad[x->bin[k]] += x->theta_rad[k] / x->mean.count[x->bin[k]];
    }
}

static void values_fill(departures *x, int channel)
{
    memset(x->mean.value, 0, x->mean.bins * sizeof *x->mean.value);
    for (size_t k = 0; k < x->q->count; ++k) {
        x->value[k] = channel_at(x->q, channel, x->q->first + k);
        x->mean.value[x->bin[k]] += x->value[k] / x->mean.count[x->bin[k]];
    }
}

/* On the line through the mean of a bin and that of the next one, around the turn. */
static double between(const departures *x, size_t bin, double theta_rad)
{
    const means *m = &x->mean;
    const size_t next = bin + 1 < m->bins ? bin + 1 : 0;
    const double round = next == 0 ? x->turn_rad : 0.0;
    const double step = m->theta_rad[next] + round - m->theta_rad[bin];
    const double ahead = theta_rad - m->theta_rad[bin];
    const double share = step > 0.0 ? (ahead < 0.0 ? ahead + x->turn_rad : ahead) / step : 0.0;
    return m->value[bin] + share * (m->value[next] - m->value[bin]);
}

static void means_leave(departures *x)
{
    for (size_t k = 0; k < x->q->count; ++k) {
        const bool behind = x->theta_rad[k] < x->mean.theta_rad[x->bin[k]];
        const size_t before = x->bin[k] > 0 ? x->bin[k] - 1 : x->mean.bins - 1;
        x->value[k] -= between(x, behind ? before : x->bin[k], x->theta_rad[k]);
    }
}

/* Whether what is left is next to nothing, whatever its colour. */
static bool is_nothing(const departures *x, int channel)
{
    const hci_run_statistics *of = x->q->statistics;
    const double least = NONE * (channel == 0 ? of->rms_torque_Nm : of->current_A);
    double square = 0.0;
    for (size_t k = 0; k < x->q->count; ++k)
        square += x->value[k] * x->value[k];
    return square <= least * least * (double)x->q->count;
}

static void spectrum_fill(departures *x)
{
    memset(x->re, 0, 2 * x->size * sizeof *x->re);
    memcpy(x->re, x->value, x->q->count * sizeof *x->re);
    hci_fft(x->re, x->im, x->size, -1);
}

static bool has_line(departures *x)
{
    double sum = 0.0, most = 0.0;
    spectrum_fill(x);
    for (size_t k = 0; k < x->size / 2; ++k) {
        const double power = x->re[k] * x->re[k] + x->im[k] * x->im[k];
        sum += power;
        most = fmax(most, power);
    }
    return most * (double)(x->size / 2) > OF_NOISE * sum;
}

/* Whether neighbours have something in common. */
static bool goes_on(const departures *x)
{
    double square = 0.0, product = 0.0;
    for (size_t k = 1; k < x->q->count; ++k) {
        square += x->value[k] * x->value[k];
        product += x->value[k] * x->value[k - 1];
    }
    return fabs(product) > ALIKE * square;
}

static bool is_white(departures *x, int channel)
{
    values_fill(x, channel);
    means_leave(x);
    return is_nothing(x, channel) || (!has_line(x) && !goes_on(x));
}

static bool departures_make(const hci_repeats_question *q, departures *x)
{
    *x = (departures){.q = q, .size = hci_fft_size((double)q->count)};
    x->theta_rad = hci_memory_new(2 * q->count + 2 * x->size + 3 * q->bins, sizeof *x->theta_rad);
    x->bin = hci_memory_new(q->count + q->bins, sizeof *x->bin);
    if (!x->theta_rad || !x->bin) return false;
    x->value = x->theta_rad + q->count;
    x->re = x->value + q->count;
    x->im = x->re + x->size;
    x->mean.theta_rad = x->im + x->size;
    x->mean.value = x->mean.theta_rad + q->bins;
    x->mean.count = x->mean.value + q->bins;
    x->place = x->bin + q->count;
    x->turn_rad = hci_turn_rad(q->run, q->pole_pairs);
    return true;
}

/* The median power of the spectrum from one order of the turn to another. */
static double power_between(departures *x, double turns, double from, double until)
{
    const double step = turns * (double)x->size / (double)x->q->count; /* places of one order */
    const size_t first = (size_t)ceil(from * step), behind = (size_t)(until * step);
    for (size_t k = first; k < behind; ++k)
        x->value[k - first] = x->re[k] * x->re[k] + x->im[k] * x->im[k];
    return hci_median(x->value, behind - first);
}

/* Hann's window keeps lines narrow. */
static void window(departures *x)
{
    for (size_t k = 0; k < x->q->count; ++k)
        x->value[k] *= 1.0 - cos(2.0 * HCI_PI * ((double)k + 0.5) / (double)x->q->count);
}

/* Of noise the median tells; a line of something that swings does not. */
static bool is_slow(departures *x)
{
    const hci_run *run = x->q->run;
    const size_t last = x->q->first + x->q->count - 1;
    const double turns = fabs(run->theta_m_rad[last] - run->theta_m_rad[x->q->first]) / x->turn_rad;
    if (2.0 * ABOVE_UNTIL * turns > (double)x->q->count) return false;
    values_fill(x, 0);
    means_leave(x);
    if (is_nothing(x, 0)) return false;
    window(x);
    spectrum_fill(x);
    const double slow = power_between(x, turns, SLOW_FROM, SLOW_UNTIL);
    return slow > SLOW_POWER * power_between(x, turns, ABOVE_FROM, ABOVE_UNTIL);
}

bool hci_repeats_slow_noise(const hci_repeats_question *question, bool *slow)
{
    departures x;
    const bool made = departures_make(question, &x);
    if (made) bins_fill(&x);
    *slow = made && is_slow(&x);
    hci_memory_free(x.theta_rad);
    hci_memory_free(x.bin);
    return made;
}

bool hci_repeats_find(const hci_repeats_question *question, bool *repeats)
{
    departures x;
    const bool made = departures_make(question, &x);
    *repeats = made;
    if (made) bins_fill(&x);
    for (int k = 0; k < CHANNELS && *repeats; ++k)
        *repeats = is_white(&x, k);
    hci_memory_free(x.theta_rad);
    hci_memory_free(x.bin);
    return made;
}

/* ---- the torque along a current that does not repeat ---- */

typedef struct {
    double theta_rad, torque_Nm, iq_A; /* the angle within the turn */
} sample_of_turn;

static int by_angle(const void *a, const void *b)
{
    const double x = ((const sample_of_turn *)a)->theta_rad, y = ((const sample_of_turn *)b)->theta_rad;
    return (x > y) - (x < y);
}

/* The samples in the order of their angles. */
static void samples_sort(const hci_repeats_question *q, sample_of_turn *sample)
{
    const double turn_rad = hci_turn_rad(q->run, q->pole_pairs);
    for (size_t k = 0; k < q->count; ++k) {
        const double theta = q->run->theta_m_rad[q->first + k];
        sample[k].theta_rad = theta - turn_rad * floor(theta / turn_rad);
        sample[k].torque_Nm = channel_at(q, 0, q->first + k);
        sample[k].iq_A = channel_at(q, 2, q->first + k);
    }
    qsort(sample, q->count, sizeof *sample, by_angle);
}

/* How far a sample lies from the line through the two beside it: what repeats with the angle bends little
 * from one to the other, since all turns are among them. */
static sample_of_turn departure_of(const sample_of_turn *x)
{
    const double step = x[1].theta_rad - x[-1].theta_rad;
    const double share = step > 0.0 ? (x->theta_rad - x[-1].theta_rad) / step : 0.5, rest = 1.0 - share;
    return (sample_of_turn){x->theta_rad, x->torque_Nm - rest * x[-1].torque_Nm - share * x[1].torque_Nm,
                            x->iq_A - rest * x[-1].iq_A - share * x[1].iq_A};
}

static bool is_followed(const sample_of_turn *sample, size_t count, double Nm_per_A)
{
    double product = 0.0, current = 0.0, torque = 0.0;
    for (size_t k = 1; k + 1 < count; ++k) {
        const sample_of_turn x = departure_of(sample + k);
        product += x.iq_A * x.torque_Nm;
        current += x.iq_A * x.iq_A;
        torque += x.torque_Nm * x.torque_Nm;
    }
    const double error = sqrt(SHARED * torque * current / (double)count);
    return product > 0.5 * Nm_per_A * current && product > FOLLOWS * error;
}

bool hci_repeats_follows(const hci_repeats_question *question, double Nm_per_A, bool *follows)
{
    sample_of_turn *sample = hci_memory_new(question->count, sizeof *sample);
    *follows = false;
    if (!sample) return false;
    samples_sort(question, sample);
    *follows = Nm_per_A > 0.0 && is_followed(sample, question->count, Nm_per_A);
    hci_memory_free(sample);
    return true;
}
