#ifndef HCI_SRC_HOST_CONIC_SOLVE_H
#define HCI_SRC_HOST_CONIC_SOLVE_H

#include "hci/host/base/note.h"
#include "host/conic/problem.h"

/* Primal–dual interior point, 10 to 30 steps. *answer is to be released in any case. HCI_ERROR_MEMORY.
 * O(rows · unknowns²) a step. */
hci_status hci_cone_solve(const hci_cone_problem *problem, hci_cone_answer *answer, hci_note *note);
void hci_cone_answer_release(hci_cone_answer *answer);

#endif
