/* What a slope over a window shows of a rate that varies within it.
 *
 * In: a rate, and the window that slopes of its integral were taken over. Out: those slopes: the mean of the
 * rate around each sample, with weights that fall from the middle of the window to its ends. So a model's
 * torque compares with an acceleration that was read off a speed. */
#ifndef HCI_SRC_HOST_NUMERIC_SLOPE_AVERAGE_H
#define HCI_SRC_HOST_NUMERIC_SLOPE_AVERAGE_H

#include <stddef.h>

/* x: in/out, n values, one every `stride`, a cubic between them. window: of hci_derivative_over.
 * work: 2 n. Less than three samples are left as they are. O(n). */
void hci_slope_average(const double *time_s, size_t n, size_t window, double *x, size_t stride, double *work);

/* The same where x[k] is the mean of the rate from sample k to the next one, the last x of any value: of a
 * rate that swings between samples, which no curve through its values at them tells. */
void hci_slope_average_of_steps(const double *time_s, size_t n, size_t window, double *x, size_t stride,
                                double *work);

#endif
