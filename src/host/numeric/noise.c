#include "host/numeric/noise.h"

#include <math.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/numeric/fft.h"
#include "host/numeric/wide.h"

enum {
    HALF_WINDOW = 20, /* frequencies on each side that a level is the median of */
    LANES = 16        /* frequencies at a time */
};

static const double LN_2 = 0.69314718055994530942;

size_t hci_noise_workspace(size_t n)
{
    return 4 * hci_fft_size((double)n) + 2 * HALF_WINDOW + 2;
}

/* ---- periodogram ---- */

/* Power at `bins` frequencies from 0 to half the sampling rate, scaled so that white noise has its variance
 * in each. A Hann window keeps the lines of an open record narrow. */
static size_t periodogram_open(const double *x, size_t n, double *power, double *work)
{
    const size_t m = hci_fft_size((double)n);
    double *re = work, *im = work + m, square = 0.0;
    memset(work, 0, 2 * m * sizeof *work);
    for (size_t k = 0; k < n; ++k) {
        const double window = 1.0 - cos(2.0 * HCI_PI * ((double)k + 0.5) / (double)n);
        re[k] = window * x[k];
        square += window * window;
    }
    hci_fft(re, im, m, -1);
    for (size_t k = 0; k <= m / 2; ++k)
        power[k] = (re[k] * re[k] + im[k] * im[k]) / square;
    return m / 2 + 1;
}

/* Goertzel's recurrence at LANES frequencies from one on: they do not wait for each other. */
HCI_WIDE static void goertzel(const double *x, size_t n, size_t first, double power[LANES])
{
    double c[LANES], u[LANES] = {0.0}, v[LANES] = {0.0};
    for (size_t r = 0; r < LANES; ++r)
        c[r] = 2.0 * cos(2.0 * HCI_PI * (double)(first + r) / (double)n);
    for (size_t j = n; j-- > 0;)
        for (size_t r = 0; r < LANES; ++r) {
            const double next = x[j] + c[r] * u[r] - v[r];
            v[r] = u[r];
            u[r] = next;
        }
    for (size_t r = 0; r < LANES; ++r)
        power[r] = fabs(u[r] * u[r] + v[r] * v[r] - c[r] * u[r] * v[r]) / (double)n;
}

static size_t periodogram_closed(const double *x, size_t n, double *power)
{
    const size_t bins = n / 2 + 1;
    for (size_t k = 0; k < bins; k += LANES) {
        double some[LANES];
        goertzel(x, n, k, some);
        memcpy(power + k, some, (bins - k < LANES ? bins - k : LANES) * sizeof *power);
    }
    return bins;
}

/* ---- under the lines ---- */

static void sort(double *x, size_t n)
{
    for (size_t i = 1; i < n; ++i) {
        const double v = x[i];
        size_t j = i;
        for (; j > 0 && x[j - 1] > v; --j)
            x[j] = x[j - 1];
        x[j] = v;
    }
}

/* The mean power of noise is its median over ln 2. */
static double level_at(const double *power, size_t bins, size_t at, double *window)
{
    const size_t from = at > HALF_WINDOW ? at - HALF_WINDOW : 0;
    const size_t to = at + HALF_WINDOW < bins ? at + HALF_WINDOW : bins - 1;
    memcpy(window, power + from, (to - from + 1) * sizeof *window);
    sort(window, to - from + 1);
    return window[(to - from) / 2] / LN_2;
}

/* ---- autoregression ---- */

/* Levinson and Durbin: the predictor from the correlations r. */
static void predictor(const double r[HCI_NOISE_MEMORY + 1], hci_noise *noise)
{
    double *a = noise->prediction, error = r[0];
    for (int m = 0; m < HCI_NOISE_MEMORY; ++m) {
        double old[HCI_NOISE_MEMORY], k = r[m + 1];
        for (int j = 0; j < m; ++j)
            k -= a[j] * r[m - j];
        k = error > 0.0 ? k / error : 0.0;
        memcpy(old, a, sizeof old);
        a[m] = k;
        for (int j = 0; j < m; ++j)
            a[j] = old[j] - k * old[m - 1 - j];
        error *= 1.0 - k * k;
    }
    noise->innovation = sqrt(fmax(error, 0.0));
    noise->rms = sqrt(r[0]);
}

void hci_noise_find(const double *residual, size_t n, bool closed, double floor, hci_noise *noise,
                    double *work)
{
    const size_t m = hci_fft_size((double)n);
    double *power = work + 2 * m, *level = work + 3 * m + 1, *window = work + 4 * m;
    double r[HCI_NOISE_MEMORY + 1] = {0.0};
    const size_t bins =
        closed ? periodogram_closed(residual, n, power) : periodogram_open(residual, n, power, work);
    memset(noise, 0, sizeof *noise);
    for (size_t k = 0; k < bins; ++k)
        level[k] = level_at(power, bins, k, window);
    for (size_t k = 0; k < bins; ++k)
        for (int lag = 0; lag <= HCI_NOISE_MEMORY; ++lag)
            r[lag] += level[k] * cos(HCI_PI * (double)lag * (double)k / (double)(bins - 1)) / (double)bins;
    r[0] += floor * floor;
    predictor(r, noise);
}

double hci_noise_of_neighbours(const double *x, size_t n)
{
    double sum = 0.0;
    if (n < HCI_NOISE_FEWEST) return NAN;
    for (size_t k = 1; k + 1 < n; ++k) {
        const double off = x[k] - 0.5 * (x[k - 1] + x[k + 1]);
        sum += off * off;
    }
    return sqrt(sum / (1.5 * (double)(n - 2)));
}

hci_noise hci_noise_white(double rms)
{
    const hci_noise noise = {{0.0}, rms, rms};
    return noise;
}

enum { RUN = 32 /* numbers at a time */ };

/* Numbers `from` to `from` + count − 1 of rows of so many columns, which follow each other as one row would.
 * All are read before any is replaced. */
static inline void run_whiten(const hci_noise *noise, double *x, size_t from, size_t count, size_t columns)
{
    const double scale = 1.0 / noise->innovation;
    double kept[RUN];
    for (size_t k = 0; k < count; ++k)
        kept[k] = x[from + k];
    for (size_t j = 0; j < HCI_NOISE_MEMORY; ++j) {
        const double *before = x + from - (j + 1) * columns, weight = noise->prediction[j];
        for (size_t k = 0; k < count; ++k)
            kept[k] -= weight * before[k];
    }
    for (size_t k = 0; k < count; ++k)
        x[from + k] = scale * kept[k];
}

HCI_WIDE void hci_noise_whiten(const hci_noise *noise, double *x, size_t n, size_t columns)
{
    const size_t first = (n < HCI_NOISE_MEMORY ? n : HCI_NOISE_MEMORY) * columns;
    size_t end = n * columns;
    for (; end >= first + RUN; end -= RUN)
        run_whiten(noise, x, end - RUN, RUN, columns);
    run_whiten(noise, x, first, end - first, columns);
    for (size_t k = 0; k < first; ++k)
        x[k] *= 1.0 / noise->rms;
}
