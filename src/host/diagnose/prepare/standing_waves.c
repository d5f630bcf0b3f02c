#include "host/diagnose/prepare/standing_waves.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/numeric/rotor.h"
#include "host/numeric/statistics.h"
#include "host/numeric/wide.h"

#define BY_CHANCE 10.0 /* times the mean square that noise has at a wave: once in 2·10⁴ */

enum { LEAST_WAVES = 8 }; /* of which a median tells the noise */

/* sums: [2][count] of waves 0, stride, 2·stride … */
HCI_WIDE static void sums_fill(const hci_standing_waves *q, const double *value, size_t count, double *sums)
{
    memset(sums, 0, 2 * count * sizeof *sums);
    for (size_t j = 0; j < q->n; ++j)
        hci_rotor_sum((double)q->stride * q->theta_m_rad[j], value[j], count, sums);
}

/* The largest squared amplitudes of waves stride, 2·stride … of all axes. sums: room for [2][count + 1]. */
static void axis_add(const hci_standing_waves *q, const double *value, size_t count, double *sums,
                     double *square)
{
    const double *cosine = sums + 1, *sine = cosine + count + 1;
    const double n = (double)q->n;
    sums_fill(q, value, count + 1, sums);
    for (size_t k = 0; k < count; ++k)
        square[k] = fmax(square[k], 4.0 * (cosine[k] * cosine[k] + sine[k] * sine[k]) / (n * n));
}

static bool is_apart(const hci_standing_waves *q, size_t period, const size_t *periods, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        if ((period > periods[k] ? period - periods[k] : periods[k] - period) < q->apart) return false;
    return true;
}

static int ascending(const void *a, const void *b)
{
    const size_t x = *(const size_t *)a, y = *(const size_t *)b;
    return (x > y) - (x < y);
}

/* Those above a squared amplitude, the strongest first; then in their order. Returns how many. */
static size_t strongest(const hci_standing_waves *q, double *square, size_t count, double least, size_t most,
                        size_t *periods)
{
    size_t taken = 0;
    while (taken < most) {
        size_t best = count;
        for (size_t k = 0; k < count; ++k)
            if (square[k] > least && (best == count || square[k] > square[best])) best = k;
        if (best == count) break;
        square[best] = 0.0;
        if (is_apart(q, (best + 1) * q->stride, periods, taken)) periods[taken++] = (best + 1) * q->stride;
    }
    qsort(periods, taken, sizeof *periods, ascending);
    return taken;
}

bool hci_standing_waves_find(const hci_standing_waves *q, size_t most, size_t *periods, size_t *taken)
{
    const size_t count = q->most_periods / q->stride;
    double *square = hci_memory_new(4 * count + 2, sizeof *square);
    *taken = 0;
    if (!square) return false;
    double *sorted = square + count;
    for (size_t k = 0; k < q->axes; ++k)
        axis_add(q, q->value[k], count, sorted + count, square);
    memcpy(sorted, square, count * sizeof *square);
    if (count >= LEAST_WAVES) {
        const double noise = hci_median(sorted, count) / log(2.0);
        *taken = strongest(q, square, count, fmax(BY_CHANCE * noise, q->least), most, periods);
    }
    hci_memory_free(square);
    return true;
}
