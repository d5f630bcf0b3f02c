#include "host/numeric/statistics.h"

#include <math.h>

#include "hci/math/harmonic.h"

double hci_mean(const double *x, size_t n)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += x[k];
    return sum / (double)n;
}

double hci_mean_square_about(const double *x, size_t n, double centre)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k)
        sum += (x[k] - centre) * (x[k] - centre);
    return sum / (double)n;
}

double hci_peak_to_peak(const double *x, size_t n)
{
    double low = x[0], high = x[0];
    for (size_t k = 1; k < n; ++k) {
        low = fmin(low, x[k]);
        high = fmax(high, x[k]);
    }
    return high - low;
}

static void swap(double *a, double *b)
{
    const double kept = *a;
    *a = *b;
    *b = kept;
}

/* Hoare's selection: halves that the place wanted is not in are left as they are. */
double hci_median(double *x, size_t n)
{
    const size_t wanted = n / 2;
    size_t low = 0, high = n - 1;
    while (low < high) {
        const double pivot = x[low + (high - low) / 2];
        size_t i = low, j = high;
        for (;;) {
            while (x[i] < pivot)
                ++i;
            while (x[j] > pivot)
                --j;
            if (i >= j) break;
            swap(&x[i++], &x[j--]);
        }
        if (i == j && wanted == i) break;
        if (wanted <= j)
            high = j;
        else
            low = j + 1;
    }
    return x[wanted];
}

double hci_quantum(const double *x, size_t n, double rounding)
{
    double least = INFINITY;
    for (size_t k = 2; k < n; ++k) {
        const double bend = fabs(x[k] - 2.0 * x[k - 1] + x[k - 2]);
        if (bend > rounding) least = fmin(least, bend);
    }
    return isfinite(least) ? least : rounding;
}

#define FINEST   0.02 /* steps from so much of the bends' rms … */
#define COARSEST 2.0  /* … to so much: above it all bends are near 0 of them … */
#define RATIO    1.01 /* … each so much larger than the one before */
#define COHERES                                                                                              \
    0.5 /* mean cosine of bends as angles of a step, of values that are its multiples, rounded to a sixth */

enum { BENDS = 4096 };

/* Mean of cos 2π b/step over the bends of x. */
static double coherence(const double *x, size_t n, double step)
{
    double sum = 0.0;
    for (size_t k = 2; k < n; ++k)
        sum += cos(2.0 * HCI_PI * (x[k] - 2.0 * x[k - 1] + x[k - 2]) / step);
    return sum / (double)(n - 2);
}

double hci_step_of_counts(const double *x, size_t n)
{
    const size_t count = n < BENDS ? n : BENDS;
    double square = 0.0, found = 0.0, most = COHERES;
    for (size_t k = 2; k < count; ++k)
        square += pow(x[k] - 2.0 * x[k - 1] + x[k - 2], 2.0);
    const double rms = count > 2 ? sqrt(square / (double)(count - 2)) : 0.0;
    for (double step = COARSEST * rms; step > FINEST * rms; step /= RATIO) {
        const double coheres = coherence(x, count, step);
        if (coheres > most) most = coheres, found = step;
        if (found > 0.0 && coheres < COHERES) break; /* what follows are parts of it */
    }
    return found;
}
