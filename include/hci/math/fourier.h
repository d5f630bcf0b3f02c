/* Fourier analysis of sampled waveforms at chosen orders, whole or fractional. */
#ifndef HCI_MATH_FOURIER_H
#define HCI_MATH_FOURIER_H

#include "hci/math/harmonic.h"
#include "hci/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Coefficients at one order of `count` samples taken at θ_j = 2π·turns·j/count, j = 0 … count − 1, that is
 * over `turns` whole electrical turns without the end point. order·turns must be a whole number (to the order
 * tolerance) below count/2; HCI_ERROR_ARGUMENT otherwise, HCI_ERROR_NOT_FINITE when a sample is not finite;
 * out is then untouched. Exact for a band-limited waveform, to the rounding of the sums for any length of
 * record. O(count). */
hci_status hci_fourier_uniform(const double *samples, size_t count, size_t turns, double order,
                               hci_harmonic *out);

/* Doubles of workspace that hci_fourier_fit needs for so many orders. */
size_t hci_fourier_fit_workspace(size_t order_count);

/* Least-squares fit of Σ S sin(nθ) + C cos(nθ) to samples at any angles (uneven, wrapped or not; fractional
 * orders need angles that are unwrapped, or wrapped at a period of theirs such as the mechanical turn).
 * theta_rad, samples: count entries; orders: ascending, each once; out: order_count entries; work:
 * hci_fourier_fit_workspace(order_count) doubles, whatever the count: the samples pass by in blocks and are
 * reflected into a triangle (orthogonal, not normal equations). The error is about κ·(2⁻⁵² + the rounding of
 * n θ) of the samples' size, κ the condition of the angles for these orders: some units where they cover the
 * period, 10³ for orders that drift apart by a fiftieth of a period only; noise grows by κ as well.
 * HCI_ERROR_ARGUMENT for orders out of order, HCI_ERROR_NOT_FINITE; HCI_ERROR_SINGULAR when the angles cannot
 * tell the orders apart (fewer samples than unknowns, aliases, a column within 1e-10 of the others); out is
 * then untouched. O(count·order_count²). */
hci_status hci_fourier_fit(const double *theta_rad, const double *samples, size_t count, const double *orders,
                           size_t order_count, hci_harmonic *out, double *work);

#ifdef __cplusplus
}
#endif

#endif
