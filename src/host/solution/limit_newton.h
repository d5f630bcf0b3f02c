/* The optimum of a stage by Newton's method, from an answer that is near it (theory.md, section 15). */
#ifndef HCI_SRC_HOST_SOLUTION_LIMIT_NEWTON_H
#define HCI_SRC_HOST_SOLUTION_LIMIT_NEWTON_H

#include "host/conic/problem.h"
#include "host/solution/limit_build.h"

/* From the program of a stage and its answer to where the conditions of Karush, Kuhn and Tucker hold with the
 * limits at every angle: fills *optimum and sets its is_settled. Where it does not come there, *optimum
 * stays, as where the swing is minimised. HCI_ERROR_MEMORY, without a note. */
hci_status hci_limit_newton(const hci_limit_build *build, const hci_cone_answer *answer,
                            hci_limit_optimum *optimum);

#endif
