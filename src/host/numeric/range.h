/* The least and the largest of some numbers. */
#ifndef HCI_SRC_HOST_NUMERIC_RANGE_H
#define HCI_SRC_HOST_NUMERIC_RANGE_H

#include <math.h>

typedef struct {
    double low, high; /* low > high: of no number yet */
} hci_range;

#define HCI_RANGE_EMPTY ((hci_range){HUGE_VAL, -HUGE_VAL})

/* Widens the range to hold the value; what is not finite is left out. */
void hci_range_include(hci_range *r, double value);

#endif
