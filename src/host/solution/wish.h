/* One wish for currents within limits, with the peaks between the angles of its program. */
#ifndef HCI_SRC_HOST_SOLUTION_WISH_H
#define HCI_SRC_HOST_SOLUTION_WISH_H

#include "host/solution/wishes_program.h"

/* Solves a stage until its answer keeps the limits at every angle, and says in o->is_settled whether it does.
 * A round that rounding spoils leaves the one before. *optimum: out, its x to be freed in any case.
 * HCI_ERROR_NUMERIC, _MEMORY, _STOPPED, which is asked before each program. */
hci_status hci_wish_solve(hci_wishes *wishes, hci_limit_stage stage, hci_limit_optimum *optimum,
                          hci_note *note);

/* Takes peaks that the last answer is not near, or that have another beside them, out of the program, lest
 * rows that no longer matter become
 * many. HCI_ERROR_MEMORY. */
hci_status hci_wish_forget(hci_wishes *wishes, hci_note *note);

/* Whether a status ends the whole solve, where a wish that cannot be met would not: memory is out, or it is
 * stopped. */
bool hci_wish_is_end(hci_status status);

/* Takes its currents out of an optimum. */
void hci_wish_take(hci_wishes *wishes, hci_limit_optimum *optimum);

#endif
