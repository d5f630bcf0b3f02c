/* Currents of which a sampled current loop leaves little: a voltage that stands still between two samples
 * makes polygons of them (theory.md, section 16). */
#ifndef HCI_SRC_HOST_SOLUTION_HOLD_H
#define HCI_SRC_HOST_SOLUTION_HOLD_H

#include "host/machine/torque_gradient.h"
#include "host/solve/answer.h"
#include "host/solve/task.h"

/* The currents without limits, by the method that the options and the machine ask for. With
 * options->sample_rad the squares of high orders are priced as much as it takes for a ripple of 1 % of the
 * mean torque at most, or until the copper is 1.5 times that without a price; a remark says what it did.
 * None where that takes less than a tenth of the ripple away. Leaves the price in the task. */
hci_status hci_held_answer(hci_task *task, const hci_solve_options *options, hci_linear_torque *at,
                           hci_answer *answer, hci_solution *solution, hci_note *note);

/* Peak to peak, what the corners of the polygon leave of the torque of currents; sample_rad: electrical angle
 * of a sample. */
double hci_hold_ripple_Nm(const hci_task *task, const hci_wave *current, size_t count, double sample_rad);

#endif
