/* How well a quantity repeats with the angle: a turn is cut into equal bins, and what is scattered within a bin
 * does not follow the angle. */
#ifndef HCI_SRC_HOST_NUMERIC_ANGLE_BINS_H
#define HCI_SRC_HOST_NUMERIC_ANGLE_BINS_H

#include <stddef.h>

enum { HCI_MOST_RANGES = 512 };

/* Start with {.ranges = 1 … HCI_MOST_RANGES}. */
typedef struct {
    size_t ranges;
    double sum[HCI_MOST_RANGES], square[HCI_MOST_RANGES], count[HCI_MOST_RANGES];
} hci_repeat;

/* The bin that an angle lies in. turns: of any size. */
size_t hci_repeat_at(const hci_repeat *repeat, double turns);
void hci_repeat_add(hci_repeat *repeat, double turns, double value);

/* Mean of a bin; 0 where it is empty. */
double hci_repeat_mean(const hci_repeat *repeat, size_t range);

/* rms departure from the mean of its bin; NAN for no more than so many degrees of freedom (samples less bins, of bins with two samples or more). */
double hci_repeat_rms(const hci_repeat *repeat, double least_freedom);

#endif
