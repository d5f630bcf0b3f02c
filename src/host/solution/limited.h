/* Currents within limits. */
#ifndef HCI_SRC_HOST_SOLUTION_LIMITED_H
#define HCI_SRC_HOST_SOLUTION_LIMITED_H

#include "host/solution/wishes_program.h"
#include "host/solve/answer.h"

/* Replaces the answer without limits, which says where to begin and, for a set that is given or of at most K
 * components, which set to take. Fills what the solution says of the system and what limits cost and gain,
 * but not how the currents stand to them. HCI_ERROR_NUMERIC, _INPUT, _MEMORY. */
hci_status hci_limited_answer(const hci_limited *limited, hci_answer *answer, hci_note *note);

#endif
