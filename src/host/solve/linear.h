/* The linear problem U x = h of a task: for a given set of components, or for one that is chosen. */
#ifndef HCI_SRC_HOST_SOLVE_LINEAR_H
#define HCI_SRC_HOST_SOLVE_LINEAR_H

#include "host/solve/answer.h"
#include "host/solve/task.h"

/* Solves at task->gradient for options->set, for `only` when there is none and it is not NULL, or for a
 * chosen set. Fills size, rank, condition and method of *solution, whose tolerance and pointwise limit it
 * needs; *answer is to be released in any case. HCI_ERROR_ARGUMENT for a method that cannot solve this
 * system, HCI_ERROR_SINGULAR, _NUMERIC, _MEMORY. */
hci_status hci_linear_answer(const hci_task *task, const hci_solve_options *options,
                             const hci_component_set *only, hci_answer *answer, hci_solution *solution,
                             hci_note *note);

/* Fills size, rank, condition and method of *solution for an answer that is known already.
 * HCI_ERROR_NUMERIC, _MEMORY. */
hci_status hci_linear_describe(const hci_task *task, const hci_answer *answer, hci_solution *solution,
                               hci_note *note);

#endif
