/* The derivative of what was sampled at uneven times. */
#ifndef HCI_SRC_HOST_NUMERIC_DERIVATIVE_H
#define HCI_SRC_HOST_NUMERIC_DERIVATIVE_H

#include <stddef.h>

/* dx/dt at each of n >= 2 samples: the slope of a local parabola by least squares. Its window has 5 samples
 * or more, a quarter of the record at most, so many that it bridges the steps of an encoder, and grows as
 * long as noise is more than 2 % of the slope and the slopes change by no more than noise explains. It does
 * not reach across a gap that is as long as the window usually is, and as 20 usual steps, unless fewer than 5
 * samples stand between two gaps. time_s: ascending. rate: out, n. O(n). */
void hci_derivative(const double *time_s, const double *x, size_t n, double *rate);

/* The window where x itself is a slope of what was read: its noise has much in common from sample to sample,
 * and is told from that of the reading. x: what was read; slope: its derivative. n >= 2. */
size_t hci_derivative_window_of_slope(const double *time_s, const double *x, const double *slope, size_t n);

/* Samples of that window, at most n, and the slopes over one that is given. */
size_t hci_derivative_window(const double *time_s, const double *x, size_t n);
void hci_derivative_over(const double *time_s, const double *x, size_t n, size_t window, double *rate);

#endif
