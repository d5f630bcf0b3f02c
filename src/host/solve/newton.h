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

/* Where hci_newton_answer has not come to rest (newton_converged): replaces the currents of the answer by
 * those of the same components with a squared error of the torque that is least in their neighbourhood, or
 * with which the target is reached. Of currents with the same error it is not that of the least copper.
 * Nothing is done for a choice of few components, for a comparison of few orders, and beyond HCI_DAMPED_MOST
 * components. HCI_ERROR_NUMERIC, _MEMORY, _STOPPED. */
hci_status hci_newton_come_nearer(hci_task *task, const hci_solve_options *options, hci_linear_torque *at,
                                  hci_answer *answer, hci_solution *solution, hci_note *note);

#endif
