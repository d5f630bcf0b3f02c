/* One stage of solving within limits, as a convex program (theory.md, section 15). */
#ifndef HCI_SRC_HOST_SOLUTION_LIMIT_STAGE_H
#define HCI_SRC_HOST_SOLUTION_LIMIT_STAGE_H

#include "host/solution/limit_program.h"

/* *optimum: out; x to be freed with hci_memory_free, also where it is infeasible. HCI_ERROR_MEMORY, _NUMERIC.
 */
hci_status hci_limit_stage_solve(const hci_limit_program *program, hci_limit_stage stage,
                                 hci_limit_optimum *optimum, hci_note *note);

#endif
