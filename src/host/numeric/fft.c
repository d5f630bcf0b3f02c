#include "host/numeric/fft.h"

#include <math.h>

size_t hci_fft_size(double least)
{
    size_t n = 2;
    while ((double)n < least)
        n *= 2;
    return n;
}

static void swap(double *x, size_t j, size_t k)
{
    const double t = x[j];
    x[j] = x[k];
    x[k] = t;
}

/* x_j to the place that is j with its bits in reverse. */
static void reorder(double *re, double *im, size_t n)
{
    for (size_t j = 0, k = 0; j < n; ++j) {
        size_t bit = n / 2;
        if (j < k) {
            swap(re, j, k);
            swap(im, j, k);
        }
        for (; bit > 0 && (k & bit); bit /= 2)
            k ^= bit;
        k |= bit;
    }
}

/* One stage: blocks of 2·half; every turn by its own sine and cosine, since a recurrence would lose
 * digits. */
static void join_blocks(double *re, double *im, size_t n, size_t half, int sign)
{
    for (size_t j = 0; j < half; ++j) {
        const double angle_rad = HCI_PI * (double)j / (double)half;
        const double c = cos(angle_rad), s = sign * sin(angle_rad);
        for (size_t k = j; k < n; k += 2 * half) {
            const double x = c * re[k + half] - s * im[k + half], y = s * re[k + half] + c * im[k + half];
            re[k + half] = re[k] - x;
            im[k + half] = im[k] - y;
            re[k] += x;
            im[k] += y;
        }
    }
}

void hci_fft(double *re, double *im, size_t n, int sign)
{
    reorder(re, im, n);
    for (size_t half = 1; half < n; half *= 2)
        join_blocks(re, im, n, half, sign);
}

/* A_k = (X_k + X*_{n−k})/2, B_k = (X_k − X*_{n−k})/2i; a harmonic has C = 2 Re A/n, S = −2 Im A/n. */
void hci_fft_bin(const hci_fft_pair *x, size_t k, hci_harmonic *a, hci_harmonic *b)
{
    const double *re = x->re, *im = x->im;
    const size_t n = x->n, mirror = k > 0 ? n - k : 0;
    const double order = (double)k / (double)x->turns, scale = (k > 0 ? 1.0 : 0.5) / (double)n;
    *a = (hci_harmonic){order, k > 0 ? -scale * (im[k] - im[mirror]) : 0.0, scale * (re[k] + re[mirror])};
    *b = (hci_harmonic){order, k > 0 ? scale * (re[k] - re[mirror]) : 0.0, scale * (im[k] + im[mirror])};
}
