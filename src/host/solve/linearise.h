/* A task made linear at some currents (theory.md, section 7). */
#ifndef HCI_SRC_HOST_SOLVE_LINEARISE_H
#define HCI_SRC_HOST_SOLVE_LINEARISE_H

#include "host/machine/torque_gradient.h"
#include "host/solve/task.h"

/* Replaces gradient and offset of the task by those at `count` star currents. They stand in *at, which is to
 * be released after the task was last used; what it held before is freed. HCI_ERROR_MEMORY. */
hci_status hci_task_linearise(hci_task *task, const hci_wave *currents, size_t count, hci_linear_torque *at,
                              hci_note *note);

#endif
