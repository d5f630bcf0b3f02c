/* Means over turns and their standard errors. */
#include <math.h>

#include "hci/math/harmonic.h"
#include "host/numeric/synchronous_average.h"

enum {
    NEIGHBOURS = 20 /* on each side */,
    NEIGHBOURS_LEAST = 8,
    CORRELATED_NEIGHBOURS = 10,
    FREEDOM_LEAST = 3
};

/* A turn may resemble the next by so much; more cannot be told from a drift. */
#define MOST_CORRELATION 0.8

static const int DIRECTION[] = {1, -1, 0};

size_t hci_average_passes(const hci_average *average, int direction)
{
    size_t count = 0;
    for (size_t k = 0; k < average->count; ++k)
        count += average->pass[k].direction == direction;
    return count;
}

static size_t directions_of(const hci_average *average)
{
    size_t count = 0;
    for (int d = 0; d < 3; ++d)
        count += hci_average_passes(average, DIRECTION[d]) > 0;
    return count;
}

bool hci_average_has_repeats(const hci_average *average)
{
    return average->count >= directions_of(average) + FREEDOM_LEAST;
}

static hci_average_harmonic mean_of_direction(const hci_average *average, size_t channel, size_t order,
                                              int direction)
{
    hci_average_harmonic sum = {0.0, 0.0};
    const double count = (double)hci_average_passes(average, direction);
    for (size_t k = 0; k < average->count; ++k) {
        if (average->pass[k].direction != direction) continue;
        const hci_average_harmonic *w = hci_average_at(average, k, channel, order);
        sum.sine += w->sine / count;
        sum.cosine += w->cosine / count;
    }
    return sum;
}

static hci_average_harmonic mean_of(const hci_average *average, size_t channel, size_t order)
{
    hci_average_harmonic sum = {0.0, 0.0};
    const double count = (double)directions_of(average);
    for (int d = 0; d < 3; ++d) {
        if (hci_average_passes(average, DIRECTION[d]) == 0) continue;
        const hci_average_harmonic w = mean_of_direction(average, channel, order, DIRECTION[d]);
        sum.sine += w.sine / count;
        sum.cosine += w.cosine / count;
    }
    return sum;
}

/* ---- from how turns differ ---- */

typedef struct {
    double square, next; /* Σ |d_j|², Σ d_j·d_{j+1} of departures from the mean of the direction */
} scatter;

static scatter scatter_of(const hci_average *average, size_t channel, size_t order)
{
    scatter s = {0.0, 0.0};
    for (int d = 0; d < 3; ++d) {
        const hci_average_harmonic mean = mean_of_direction(average, channel, order, DIRECTION[d]);
        hci_average_harmonic last = {0.0, 0.0};
        for (size_t k = 0; k < average->count; ++k) {
            if (average->pass[k].direction != DIRECTION[d]) continue;
            const hci_average_harmonic *w = hci_average_at(average, k, channel, order);
            const hci_average_harmonic now = {w->sine - mean.sine, w->cosine - mean.cosine};
            s.square += now.sine * now.sine + now.cosine * now.cosine;
            s.next += now.sine * last.sine + now.cosine * last.cosine;
            last = now;
        }
    }
    return s;
}

/* 1 / (number of passes of each direction), averaged as the mean over the directions is. */
static double share_of_mean(const hci_average *average)
{
    double sum = 0.0;
    const double count = (double)directions_of(average);
    for (int d = 0; d < 3; ++d) {
        const size_t passes = hci_average_passes(average, DIRECTION[d]);
        if (passes > 0) sum += 1.0 / (count * count * (double)passes);
    }
    return sum;
}

/* How much a turn resembles the next, with the bias of departures from their own mean taken out. */
static double correlation_of(const hci_average *average, size_t channel, size_t order)
{
    const scatter s = scatter_of(average, channel, order);
    const double raw = s.square > 0.0 ? s.next / s.square : 0.0;
    return raw + (1.0 + 3.0 * raw) / (double)average->count;
}

/* Over few turns the correlation of one order is uncertain: the mean with the orders around it is taken,
 * unless that of the order itself is clearly larger, as by a drift. */
static double resemblance(const hci_average *average, size_t channel, size_t order)
{
    const double own = correlation_of(average, channel, order);
    double sum = own, count = 1.0;
    for (size_t away = 1; away <= CORRELATED_NEIGHBOURS; ++away) {
        for (int side = -1; side <= 1; side += 2) {
            if (side < 0 ? order <= away : order + away > average->highest) continue;
            sum += correlation_of(average, channel, side < 0 ? order - away : order + away);
            count += 1.0;
        }
    }
    const bool clear = own > sum / count + 1.0 / sqrt((double)average->count);
    return fmin(fmax(clear ? own : sum / count, 0.0), MOST_CORRELATION);
}

static void estimate_between_turns(const hci_average *average, size_t channel, size_t order,
                                   hci_order_estimate *e)
{
    const double freedom = (double)(average->count - directions_of(average));
    const double coordinates = order > 0 ? 2.0 : 1.0;
    const double r = resemblance(average, channel, order), factor = (1.0 + r) / (1.0 - r);
    const double variance = scatter_of(average, channel, order).square / (coordinates * freedom);
    e->std_error = sqrt(variance * share_of_mean(average) * factor);
    e->freedom = fmax(coordinates * freedom / factor, 2.0);
}

/* ---- from the orders around ---- */

/* Median by counting down: few values. */
static double median_of(double *x, size_t n)
{
    for (size_t k = 1; k < n; ++k)
        for (size_t j = k; j > 0 && x[j - 1] > x[j]; --j) {
            const double swap = x[j];
            x[j] = x[j - 1];
            x[j - 1] = swap;
        }
    return n % 2 == 1 ? x[n / 2] : 0.5 * (x[n / 2 - 1] + x[n / 2]);
}

/* Noise is often larger at low orders: as many from below as from above, and none from far away. */
static size_t take_neighbours(const hci_average *average, size_t channel, size_t order, double *square)
{
    const size_t side = order / 2 < NEIGHBOURS ? order / 2 : NEIGHBOURS;
    size_t count = 0;
    for (size_t at = order - side; at <= average->highest && count < 2 * NEIGHBOURS; ++at) {
        if (at == order || at == 0) continue;
        if (at > order + side && count >= NEIGHBOURS_LEAST) break;
        const hci_average_harmonic w = mean_of(average, channel, at);
        square[count++] = w.sine * w.sine + w.cosine * w.cosine;
    }
    for (size_t at = order - side; at > 1 && count < NEIGHBOURS_LEAST;) {
        const hci_average_harmonic w = mean_of(average, channel, --at);
        square[count++] = w.sine * w.sine + w.cosine * w.cosine;
    }
    return count;
}

/* Noise makes A² exponential with mean 2σ² and median 2σ² ln 2. */
static void estimate_from_neighbours(const hci_average *average, size_t channel, size_t order,
                                     hci_order_estimate *e)
{
    double square[2 * NEIGHBOURS];
    const size_t count = take_neighbours(average, channel, order, square);
    e->freedom = fmax((double)count, 2.0);
    e->std_error = count > 0 ? sqrt(median_of(square, count) / (2.0 * log(2.0))) : (double)NAN;
    if (order == 0) e->std_error /= sqrt(2.0);
}

hci_order_estimate hci_average_estimate(const hci_average *average, size_t channel, size_t order)
{
    hci_order_estimate e = {.mean = mean_of(average, channel, order)};
    if (hci_average_has_repeats(average))
        estimate_between_turns(average, channel, order, &e);
    else
        estimate_from_neighbours(average, channel, order, &e);
    return e;
}

double hci_order_chance(const hci_order_estimate *e)
{
    const double square = e->mean.sine * e->mean.sine + e->mean.cosine * e->mean.cosine;
    if (!(square > 0.0) || isnan(e->std_error)) return 1.0;
    const double f = square / (2.0 * e->std_error * e->std_error);
    return pow(1.0 + 2.0 * f / e->freedom, -0.5 * e->freedom);
}

double hci_average_chance(const hci_average *average, size_t channel, size_t order)
{
    hci_order_estimate around = {.mean = mean_of(average, channel, order)}, between = around;
    estimate_from_neighbours(average, channel, order, &around);
    if (!hci_average_has_repeats(average)) return hci_order_chance(&around);
    estimate_between_turns(average, channel, order, &between);
    return fmin(2.0 * fmin(hci_order_chance(&around), hci_order_chance(&between)), 1.0);
}

double hci_average_half_difference(const hci_average *average, size_t channel, double *std_error)
{
    *std_error = NAN;
    if (hci_average_passes(average, 1) == 0 || hci_average_passes(average, -1) == 0) return NAN;
    *std_error = hci_average_estimate(average, channel, 0).std_error;
    return 0.5 * (mean_of_direction(average, channel, 0, -1).cosine -
                  mean_of_direction(average, channel, 0, 1).cosine);
}
