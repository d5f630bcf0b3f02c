/* The harmonic system of a machine whose torque is not linear in the currents, by Newton's method. */
#ifndef HCI_SRC_HOST_SOLVE_NEWTON_H
#define HCI_SRC_HOST_SOLVE_NEWTON_H

#include "host/machine/torque_gradient.h"
#include "host/solve/answer.h"
#include "host/solve/task.h"

/* The currents of options->set, or of a chosen set, whose true torque comes nearest to the target. gradient
 * and offset of the task follow the current; what they point to is in *at, to be released after the task was
 * last used. Fills newton_* of *solution and what hci_linear_answer does; *answer is to be released in any
 * case. HCI_ERROR_NUMERIC when no step could be made, _MEMORY, and those of hci_linear_answer. */
hci_status hci_newton_answer(hci_task *task, const hci_solve_options *options, hci_linear_torque *at,
                             hci_answer *answer, hci_solution *solution, hci_note *note);

#endif
