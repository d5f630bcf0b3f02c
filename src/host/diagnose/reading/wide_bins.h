/* A sample that is the mean over a wide bin of the turn shows the mean of the torque over it, not the torque
 * at its mean angle: by half the variance of its angles times the curvature along the angle. */
#ifndef HCI_SRC_HOST_DIAGNOSE_READING_WIDE_BINS_H
#define HCI_SRC_HOST_DIAGNOSE_READING_WIDE_BINS_H

#include "host/diagnose/prepare/segment.h"

typedef struct {
    const hci_binned_sample *sample;
    size_t count;
    double turn_rad; /* around which the first follows the last; 0: it does not */
} hci_wide_bins;

/* The curvature is that of parabolas through the rows beside each: x[count][columns], row: work, [2 columns].
 * O(count·columns). */
void hci_bins_widen(const hci_wide_bins *bins, double *x, size_t columns, double *row);

/* The same of rows `parts` apart, between which others tell the curvature: x[first + count·parts][columns],
 * around the turn where first is 0. O(count·columns). */
void hci_parts_widen(const hci_wide_bins *bins, size_t parts, size_t first, double *x, size_t columns);

#endif
