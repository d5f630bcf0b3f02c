/* Currents within limits. */
#ifndef HCI_SRC_HOST_SOLVE_LIMITED_H
#define HCI_SRC_HOST_SOLVE_LIMITED_H

#include "host/machine/torque_gradient.h"
#include "host/solve/answer.h"
#include "host/solution/bounds.h"
#include "host/solve/task.h"

/* What is solved, and where it goes. */
typedef struct {
    hci_task *task; /* gradient and offset follow the current where the torque is not linear */
    const hci_machine_data *machine;
    const hci_solve_options *options;
    const hci_bounds *bounds;
    hci_linear_torque *at; /* what they point to; to be released after the task was last used */
    hci_solution *solution;
} hci_limited;

/* Replaces the answer without limits, which says where to begin and, for a set that is given or of at most K
 * components, which set to take. Fills what the solution says of the system and what limits cost and gain,
 * but not how the currents stand to them. HCI_ERROR_NUMERIC, _INPUT, _MEMORY. */
hci_status hci_limited_answer(const hci_limited *limited, hci_answer *answer, hci_note *note);

#endif
