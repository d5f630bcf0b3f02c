/* Whether angle and torque stand in each other's column: the one called torque goes on evenly from row to
 * row, and the one called angle to and fro. */
#ifndef HCI_SRC_HOST_CHECK_EXCHANGED_ANGLE_H
#define HCI_SRC_HOST_CHECK_EXCHANGED_ANGLE_H

#include <stdbool.h>
#include <stddef.h>

/* theta, torque: [count], as recorded; NULL: none, and not exchanged. O(count). */
bool hci_check_is_exchanged(const double *theta, const double *torque, size_t count);

#endif
