/* The wishes for currents within limits, met in turn where torque and voltage are linear in the current. */
#ifndef HCI_SRC_HOST_SOLUTION_WISHES_H
#define HCI_SRC_HOST_SOLUTION_WISHES_H

#include "host/solution/wishes_program.h"

/* Fills what does not change from step to step. HCI_ERROR_INPUT where the voltage needs a value that is not
 * given. To be released in any case. */
hci_status hci_wishes_begin(hci_wishes *wishes, hci_note *note);

/* Finds x at the task and the current as they are, and fills what *solution says of cost. HCI_ERROR_NUMERIC,
 * _MEMORY. */
hci_status hci_wishes_meet(hci_wishes *wishes, hci_note *note);

void hci_wishes_release(hci_wishes *wishes);

#endif
