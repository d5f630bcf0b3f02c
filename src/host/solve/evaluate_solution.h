/* What the currents of a solution do. */
#ifndef HCI_SRC_HOST_SOLVE_EVALUATE_SOLUTION_H
#define HCI_SRC_HOST_SOLVE_EVALUATE_SOLUTION_H

#include "host/solve/task.h"

/* Fills orders, torque and verdicts of the currents of *solution, and their losses; tolerance and pointwise
 * limit are filled already. set: whose components could reach an order. HCI_ERROR_MEMORY. */
hci_status hci_solution_evaluate(const hci_task *task, const hci_component_set *set, hci_compare compare,
                                 hci_solution *solution, hci_note *note);

#endif
