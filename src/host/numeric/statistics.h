/* Mean, mean square, peak-to-peak, median and step of samples. */
#ifndef HCI_SRC_HOST_NUMERIC_STATISTICS_H
#define HCI_SRC_HOST_NUMERIC_STATISTICS_H

#include <stddef.h>

/* Of n samples, n from 1. O(n). */
double hci_mean(const double *x, size_t n);

/* Mean of the squares of x − centre. */
double hci_mean_square_about(const double *x, size_t n, double centre);

/* Largest less smallest. */
double hci_peak_to_peak(const double *x, size_t n);

/* The one with as many below as above, of an even number the upper one; changes their order. O(n) as a rule.
 */
double hci_median(double *x, size_t n);

/* What values are whole multiples of, where they were rounded: their second differences are too, and the
 * smallest of those that are more than `rounding` is taken; `rounding` where there is none. */
double hci_quantum(const double *x, size_t n, double rounding);

/* The step of values that are whole numbers of it, as an encoder counts, although they were written to few
 * digits: the one, within a twentieth, of which second differences are multiples within a sixth. 0: none. Of
 * up to 4096 values; O(n). */
double hci_step_of_counts(const double *x, size_t n);

#endif
