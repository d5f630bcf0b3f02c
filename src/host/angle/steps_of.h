/* The steps in which an angle was written down. */
#ifndef HCI_SRC_HOST_ANGLE_STEPS_OF_H
#define HCI_SRC_HOST_ANGLE_STEPS_OF_H

#include <stddef.h>

/* The largest step of which all changes of the readings are multiples, in rad; 0: it is less than a hundred
 * thousandth, or nearly all changes are the same, as of a shaft that turns evenly and is read at even times,
 * or the readings are fewer than 16. O(n). */
double hci_steps_of(const double *angle_rad, size_t n);

#endif
