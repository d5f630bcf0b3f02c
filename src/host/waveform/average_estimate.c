/* Means over turns and how sure they are. */
#include <math.h>

#include "hci/math/harmonic.h"
#include "host/waveform/synchronous_average.h"

enum {
    NEIGHBOURS = 20 /* on each side */,
    NEIGHBOURS_LEAST = 8,
    CORRELATED_NEIGHBOURS = 10,
    FREEDOM_LEAST = 3
};

/* A turn may resemble the next by so much; more cannot be told from a drift. */
#define MOST_CORRELATION 0.8

static const int DIRECTION[] = {1, -1, 0};

size_t hci_turns_passes(const hci_turns *turns, int direction)
{
    size_t count = 0;
    for (size_t k = 0; k < turns->count; ++k)
        count += turns->pass[k].direction == direction;
    return count;
}

static size_t directions_of(const hci_turns *turns)
{
    size_t count = 0;
    for (int d = 0; d < 3; ++d)
        count += hci_turns_passes(turns, DIRECTION[d]) > 0;
    return count;
}

bool hci_turns_repeat(const hci_turns *turns)
{
    return turns->count >= directions_of(turns) + FREEDOM_LEAST;
}

static hci_turn_wave mean_of_direction(const hci_turns *turns, size_t channel, size_t order, int direction)
{
    hci_turn_wave sum = {0.0, 0.0};
    const double count = (double)hci_turns_passes(turns, direction);
    for (size_t k = 0; k < turns->count; ++k) {
        if (turns->pass[k].direction != direction) continue;
        const hci_turn_wave *w = hci_turns_wave(turns, k, channel, order);
        sum.sine += w->sine / count;
        sum.cosine += w->cosine / count;
    }
    return sum;
}

static hci_turn_wave mean_of(const hci_turns *turns, size_t channel, size_t order)
{
    hci_turn_wave sum = {0.0, 0.0};
    const double count = (double)directions_of(turns);
    for (int d = 0; d < 3; ++d) {
        if (hci_turns_passes(turns, DIRECTION[d]) == 0) continue;
        const hci_turn_wave w = mean_of_direction(turns, channel, order, DIRECTION[d]);
        sum.sine += w.sine / count;
        sum.cosine += w.cosine / count;
    }
    return sum;
}

/* ---- from how turns differ ---- */

typedef struct {
    double square, next; /* Σ |d_j|², Σ d_j·d_{j+1} of departures from the mean of the direction */
} scatter;

static scatter scatter_of(const hci_turns *turns, size_t channel, size_t order)
{
    scatter s = {0.0, 0.0};
    for (int d = 0; d < 3; ++d) {
        const hci_turn_wave mean = mean_of_direction(turns, channel, order, DIRECTION[d]);
        hci_turn_wave last = {0.0, 0.0};
        for (size_t k = 0; k < turns->count; ++k) {
            if (turns->pass[k].direction != DIRECTION[d]) continue;
            const hci_turn_wave *w = hci_turns_wave(turns, k, channel, order);
            const hci_turn_wave now = {w->sine - mean.sine, w->cosine - mean.cosine};
            s.square += now.sine * now.sine + now.cosine * now.cosine;
            s.next += now.sine * last.sine + now.cosine * last.cosine;
            last = now;
        }
    }
    return s;
}

/* 1 / (number of passes of each direction), averaged as the mean over the directions is. */
static double share_of_mean(const hci_turns *turns)
{
    double sum = 0.0;
    const double count = (double)directions_of(turns);
    for (int d = 0; d < 3; ++d) {
        const size_t passes = hci_turns_passes(turns, DIRECTION[d]);
        if (passes > 0) sum += 1.0 / (count * count * (double)passes);
    }
    return sum;
}

/* How much a turn resembles the next, with the bias of departures from their own mean taken out. */
static double correlation_of(const hci_turns *turns, size_t channel, size_t order)
{
    const scatter s = scatter_of(turns, channel, order);
    const double raw = s.square > 0.0 ? s.next / s.square : 0.0;
    return raw + (1.0 + 3.0 * raw) / (double)turns->count;
}

/* Of few turns one order alone says little, so the orders around are asked; unless it is clearly a drift of
 * its own. */
static double resemblance(const hci_turns *turns, size_t channel, size_t order)
{
    const double own = correlation_of(turns, channel, order);
    double sum = own, count = 1.0;
    for (size_t away = 1; away <= CORRELATED_NEIGHBOURS; ++away) {
        for (int side = -1; side <= 1; side += 2) {
            if (side < 0 ? order <= away : order + away > turns->highest) continue;
            sum += correlation_of(turns, channel, side < 0 ? order - away : order + away);
            count += 1.0;
        }
    }
    const bool clear = own > sum / count + 1.0 / sqrt((double)turns->count);
    return fmin(fmax(clear ? own : sum / count, 0.0), MOST_CORRELATION);
}

static void estimate_between_turns(const hci_turns *turns, size_t channel, size_t order, hci_turn_estimate *e)
{
    const double freedom = (double)(turns->count - directions_of(turns));
    const double coordinates = order > 0 ? 2.0 : 1.0;
    const double r = resemblance(turns, channel, order), factor = (1.0 + r) / (1.0 - r);
    const double variance = scatter_of(turns, channel, order).square / (coordinates * freedom);
    e->std_error = sqrt(variance * share_of_mean(turns) * factor);
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
static size_t take_neighbours(const hci_turns *turns, size_t channel, size_t order, double *square)
{
    const size_t side = order / 2 < NEIGHBOURS ? order / 2 : NEIGHBOURS;
    size_t count = 0;
    for (size_t at = order - side; at <= turns->highest && count < 2 * NEIGHBOURS; ++at) {
        if (at == order || at == 0) continue;
        if (at > order + side && count >= NEIGHBOURS_LEAST) break;
        const hci_turn_wave w = mean_of(turns, channel, at);
        square[count++] = w.sine * w.sine + w.cosine * w.cosine;
    }
    for (size_t at = order - side; at > 1 && count < NEIGHBOURS_LEAST;) {
        const hci_turn_wave w = mean_of(turns, channel, --at);
        square[count++] = w.sine * w.sine + w.cosine * w.cosine;
    }
    return count;
}

/* Noise makes A² exponential with mean 2σ² and median 2σ² ln 2. */
static void estimate_from_neighbours(const hci_turns *turns, size_t channel, size_t order,
                                     hci_turn_estimate *e)
{
    double square[2 * NEIGHBOURS];
    const size_t count = take_neighbours(turns, channel, order, square);
    e->freedom = fmax((double)count, 2.0);
    e->std_error = count > 0 ? sqrt(median_of(square, count) / (2.0 * log(2.0))) : (double)NAN;
    if (order == 0) e->std_error /= sqrt(2.0);
}

hci_turn_estimate hci_turns_estimate(const hci_turns *turns, size_t channel, size_t order)
{
    hci_turn_estimate e = {.mean = mean_of(turns, channel, order)};
    if (hci_turns_repeat(turns))
        estimate_between_turns(turns, channel, order, &e);
    else
        estimate_from_neighbours(turns, channel, order, &e);
    return e;
}

double hci_turn_chance(const hci_turn_estimate *e)
{
    const double square = e->mean.sine * e->mean.sine + e->mean.cosine * e->mean.cosine;
    if (!(square > 0.0) || isnan(e->std_error)) return 1.0;
    const double f = square / (2.0 * e->std_error * e->std_error);
    return pow(1.0 + 2.0 * f / e->freedom, -0.5 * e->freedom);
}

double hci_turns_chance(const hci_turns *turns, size_t channel, size_t order)
{
    hci_turn_estimate around = {.mean = mean_of(turns, channel, order)}, between = around;
    estimate_from_neighbours(turns, channel, order, &around);
    if (!hci_turns_repeat(turns)) return hci_turn_chance(&around);
    estimate_between_turns(turns, channel, order, &between);
    return fmin(2.0 * fmin(hci_turn_chance(&around), hci_turn_chance(&between)), 1.0);
}

double hci_turns_half_difference(const hci_turns *turns, size_t channel, double *std_error)
{
    *std_error = NAN;
    if (hci_turns_passes(turns, 1) == 0 || hci_turns_passes(turns, -1) == 0) return NAN;
    *std_error = hci_turns_estimate(turns, channel, 0).std_error;
    return 0.5 *
           (mean_of_direction(turns, channel, 0, -1).cosine - mean_of_direction(turns, channel, 0, 1).cosine);
}
