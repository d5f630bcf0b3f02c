/* How far a current loop of first order follows the currents of a solution. */
#ifndef HCI_SRC_HOST_SOLUTION_LOOP_REACH_H
#define HCI_SRC_HOST_SOLUTION_LOOP_REACH_H

#include "host/solve/task.h"

/* Fills s->loop, after all else. HCI_ERROR_MEMORY. Some twenty evaluations of the torque spectrum, where
 * recordings were asked for (options->uncertainty) or a bandwidth is given; else none. */
hci_status hci_loop_reach_find(const hci_task *task, const hci_machine_data *machine,
                               const hci_solve_options *options, hci_solution *s, hci_note *note);

#endif
