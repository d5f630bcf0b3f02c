#include "host/diagnose/reading/wide_bins.h"

#include <math.h>
#include <string.h>

#define CLOSE 0.25 /* of the mean step: between angles that tell no curvature */

/* The step of angle from sample k to the next one, around the turn; 0 where there is none. */
static double step_at(const hci_wide_bins *b, size_t k)
{
    const size_t next = k + 1 < b->count ? k + 1 : 0;
    const double step = fabs(b->sample[next].reading.theta_m_rad - b->sample[k].reading.theta_m_rad);
    return next > 0 ? step : b->turn_rad > step ? b->turn_rad - step : 0.0;
}

/* What the curvatures by the angle are multiplied with, and the steps behind and ahead. */
typedef struct {
    double half_spread, behind, ahead;
} bend;

/* Adds to a row half the variance of the angles times the curvature of a parabola through its neighbours.
 * before: in and out, the row before as it was. */
static void row_bend(const bend *x, double *row, const double *after, double *before, size_t columns)
{
    const double scale = 2.0 * x->half_spread / (x->behind + x->ahead);
    for (size_t c = 0; c < columns; ++c) {
        const double here = row[c];
        row[c] += scale * ((after[c] - here) / x->ahead - (here - before[c]) / x->behind);
        before[c] = here;
    }
}

void hci_bins_widen(const hci_wide_bins *b, double *x, size_t columns, double *row)
{
    const hci_binned_sample *sample = b->sample;
    const size_t n = b->count;
    const double least =
        CLOSE * fabs(sample[n - 1].reading.theta_m_rad - sample[0].reading.theta_m_rad) / (double)n;
    double *first = row + columns, last_step = step_at(b, n - 1);
    memcpy(row, x + (n - 1) * columns, columns * sizeof *row);
    memcpy(first, x, columns * sizeof *first);
    for (size_t k = 0; k < n; ++k) {
        const bend c = {0.5 * sample[k].spread_rad2, last_step, step_at(b, k)};
        last_step = c.ahead;
        if (c.half_spread > 0.0 && c.behind > least && c.ahead > least)
            row_bend(&c, x + k * columns, k + 1 < n ? x + (k + 1) * columns : first, row, columns);
        else
            memcpy(row, x + k * columns, columns * sizeof *row);
    }
}

void hci_parts_widen(const hci_wide_bins *b, size_t parts, size_t first, double *x, size_t columns)
{
    const size_t rows = b->count * parts;
    double behind_rad = step_at(b, b->count - 1) / (double)parts;
    for (size_t k = 0; k < b->count; ++k) {
        const double ahead_rad = step_at(b, k) / (double)parts;
        const size_t here = first + k * parts;
        double *row = x + here * columns;
        const double *before = here > 0 ? row - columns : x + (rows - 1) * columns, *after = row + columns;
        const double scale = b->sample[k].spread_rad2 / (behind_rad + ahead_rad);
        for (size_t c = 0; scale > 0.0 && c < columns; ++c)
            row[c] += scale * ((after[c] - row[c]) / ahead_rad - (row[c] - before[c]) / behind_rad);
        behind_rad = ahead_rad;
    }
}
