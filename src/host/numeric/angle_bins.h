/* How well a quantity repeats with the angle: a turn is cut into equal bins, and what is scattered within a
 * bin does not follow the angle. */
#ifndef HCI_SRC_HOST_NUMERIC_ANGLE_BINS_H
#define HCI_SRC_HOST_NUMERIC_ANGLE_BINS_H

#include <stddef.h>

enum { HCI_ANGLE_BINS_MOST = 512 };

/* Start with {.bins = 1 … HCI_ANGLE_BINS_MOST}. */
typedef struct {
    size_t bins;
    double sum[HCI_ANGLE_BINS_MOST], square[HCI_ANGLE_BINS_MOST], count[HCI_ANGLE_BINS_MOST];
} hci_angle_bins;

/* The bin that an angle lies in. turns: of any size. */
size_t hci_angle_bins_at(const hci_angle_bins *bins, double turns);
void hci_angle_bins_add(hci_angle_bins *bins, double turns, double value);

/* Mean of a bin; 0 where it is empty. */
double hci_angle_bins_mean(const hci_angle_bins *bins, size_t bin);

/* rms departure from the mean of its bin; NAN for no more than so many degrees of freedom (samples less bins,
 * of bins with two samples or more). */
double hci_angle_bins_rms(const hci_angle_bins *bins, double least_freedom);

#endif
