/* What the real machine is expected to do with the currents of a solution. */
#ifndef HCI_SRC_HOST_SOLUTION_EXPECT_H
#define HCI_SRC_HOST_SOLUTION_EXPECT_H

#include "hci/host/solve/solve.h"

/* Fills solution->expected from the machine's uncertainty, of a solution that is evaluated. HCI_ERROR_MEMORY.
 * O(samples·terms·machines), samples at least 1024 a turn. */
hci_status hci_solution_expect(const hci_machine *machine, const hci_solve_options *options,
                               hci_solution *solution, hci_note *note);

#endif
