/* Which orders per mechanical turn a torque, or the current that balances it, repeats with. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/check/data/run_samples.h"

/* A turn has as many bins as there are samples, up to so many: an order above half of the bins would be seen
 * as a lower one. Orders below the first are those of encoders and bearings. */
enum { LEAST_BINS = 400, MOST_BINS = 4096, FIRST = 3 };

/* Orders of the upper half may be those of still higher ones. */
#define BEYOND 0.3

/* A line has this share of the largest, and so many times the median of all orders. */
#define SHARE_OF_LARGEST 0.08
#define TIMES_MEDIAN     6.0

/* Of a turn, in bins without a sample. */
#define MOST_EMPTY 0.6

/* Means over a turn; where a bin is empty, that of the one before. Returns how many are not, or 0: less than
 * a turn. */
static size_t bins_of(const check_run *run, size_t bins, double *mean, size_t *hits)
{
    size_t empty = 0, last = bins;
    for (size_t k = 0; k < run->count; ++k) {
        const double turn = run->theta[k] / (2.0 * HCI_PI);
        const size_t bin = (size_t)((turn - floor(turn)) * (double)bins) % bins;
        mean[bin] += run->torque[k] - run->torque_mean;
        ++hits[bin];
    }
    for (size_t k = 0; k < bins; ++k) {
        if (hits[k] > 0) mean[k] /= (double)hits[k];
        if (hits[k] > 0) last = k;
        empty += hits[k] == 0;
    }
    for (size_t k = 0; k < bins && last < bins; ++k) {
        if (hits[k] == 0) mean[k] = mean[last];
        if (hits[k] > 0) last = k;
    }
    return (double)empty < MOST_EMPTY * (double)bins ? bins - empty : 0;
}

static double amplitude_of(const double *mean, size_t bins, int order)
{
    double s = 0.0, c = 0.0;
    for (size_t k = 0; k < bins; ++k) {
        const double angle = 2.0 * HCI_PI * order * (double)k / (double)bins;
        s += mean[k] * sin(angle);
        c += mean[k] * cos(angle);
    }
    return hypot(s, c);
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* An order above half of the positions is seen as a lower one; so there may be some when much is seen not far
 * below. amplitude: [trusted] and as many again; sorted: workspace. */
static void lines_take(const double *amplitude, double *sorted, int trusted, check_run *run)
{
    double beyond = 0.0;
    for (int n = trusted; n < 2 * trusted; ++n)
        beyond = fmax(beyond, amplitude[n]);
    memcpy(sorted, amplitude, (size_t)trusted * sizeof *sorted);
    qsort(sorted, (size_t)trusted, sizeof *sorted, ascending);
    const double largest = sorted[trusted - 1],
                 least = fmax(SHARE_OF_LARGEST * largest, TIMES_MEDIAN * sorted[trusted / 2]);
    if (beyond > BEYOND * largest) return;
    for (int n = FIRST; n < trusted && run->lines < CHECK_MOST_LINES; ++n)
        if (amplitude[n] > least && amplitude[n] > 0.0) run->line[run->lines++] = n;
}

static void spectrum_take(const double *mean, size_t bins, size_t filled, double *work, check_run *run)
{
    const int trusted = filled / 4 < CHECK_MOST_ORDER ? (int)(filled / 4) : CHECK_MOST_ORDER;
    for (int n = FIRST; n < 2 * trusted; ++n)
        work[n] = amplitude_of(mean, bins, n);
    lines_take(work, work + 2 * CHECK_MOST_ORDER, trusted, run);
}

bool hci_check_run_orders(check_run *run)
{
    run->lines = 0;
    if (!run->theta || !run->torque || run->is_electrical || run->count < LEAST_BINS) return true;
    const size_t bins = run->count < MOST_BINS ? run->count : MOST_BINS;
    double *mean = hci_memory_new(bins, sizeof *mean);
    double *work = hci_memory_new(3 * CHECK_MOST_ORDER, sizeof *work);
    size_t *hits = hci_memory_new(bins, sizeof *hits);
    const bool good = mean && hits && work;
    const size_t filled = good ? bins_of(run, bins, mean, hits) : 0;
    if (filled > 0) spectrum_take(mean, bins, filled, work, run);
    hci_memory_free(mean);
    hci_memory_free(work);
    hci_memory_free(hits);
    return good;
}
