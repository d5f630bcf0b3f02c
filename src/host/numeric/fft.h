/* Fast Fourier transform of samples over a whole period, for what is known by its values only. */
#ifndef HCI_SRC_HOST_NUMERIC_FFT_H
#define HCI_SRC_HOST_NUMERIC_FFT_H

#include <stddef.h>

#include "hci/math/harmonic.h"

/* The smallest power of two that is not below `least`; at least 2. */
size_t hci_fft_size(double least);

/* In place, n a power of two: X_k = Σ x_j e^(sign·2πi jk/n), with sign −1 or +1 and no factor 1/n. O(n log
 * n). */
void hci_fft(double *re, double *im, size_t n, int sign);

/* Two real signals over `turns` turns, transformed as real and imaginary part with sign −1. */
typedef struct {
    const double *re, *im;
    size_t n, turns;
} hci_fft_pair;

/* What each has at k periods, k < n/2; the order is k/turns. */
void hci_fft_bin(const hci_fft_pair *x, size_t k, hci_harmonic *a, hci_harmonic *b);

/* Amplitude of a harmonic's or wave's coordinates below which it is the rounding of samples. */
#define HCI_FFT_FLOOR 1e-13

#endif
