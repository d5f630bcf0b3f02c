/* Wishes where torque or voltage are not linear in the current. */
#ifndef HCI_SRC_HOST_SOLUTION_LIMITED_PATH_H
#define HCI_SRC_HOST_SOLUTION_LIMITED_PATH_H

#include "host/solution/wishes.h"
#include "host/solve/merit.h"

/* Steps of one answer, all its beginnings together; and with fewer than LEAST of them left none is begun. */
enum { HCI_LIMITED_MOST_STEPS = 120, HCI_LIMITED_LEAST_STEPS = 20 };

/* Meets the wishes with torque and voltage made linear again and again, from `from` (coordinates of
 * wishes->set; of no meaning afterwards) on: at the last answer, by Anderson's acceleration, as long as that
 * comes to rest; else within a distance from the best answer that shrinks where the true torque is not better
 * than that. 60 steps at most, and none beyond those of one answer: wishes->is_ended says so, and the best of
 * them is taken. wishes->x is the answer. Fills the steps of the solution. HCI_ERROR_NUMERIC, _MEMORY. */
hci_status hci_limited_path_follow(hci_wishes *wishes, double *from, hci_note *note);

/* The same to a few thousandths of the currents, without the last steps that bring peaks between the angles
 * within the limits. */
hci_status hci_limited_path_approach(hci_wishes *wishes, double *from, hci_note *note);

/* How good the true torque of coordinates x is. HCI_ERROR_MEMORY. */
hci_status hci_limited_path_merit(const hci_wishes *wishes, const double *x, hci_limit_merit *merit,
                                  hci_note *note);

#endif
