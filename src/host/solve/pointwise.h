/* Currents found angle by angle. */
#ifndef HCI_SRC_HOST_SOLVE_POINTWISE_H
#define HCI_SRC_HOST_SOLVE_POINTWISE_H

#include "host/solve/answer.h"
#include "host/solve/task.h"

/* Mean of i_a² + i_b² + i_c² in A² of the shortest currents, the pointwise limit; NAN where there are none at
 * some angle. No set of harmonics that makes the same torque has less (theory.md, section 6). */
double hci_pointwise_mean_square_A2(const hci_task *task);

/* The sine of the direction that task->current_angle_rad keeps in the rotor frame whose torque has the mean
 * of the target, with all that the machine makes along it; of amplitude 0 where none has. */
hci_wave hci_pointwise_kept_sine(const hci_task *task);

/* The currents of task->strategy as waves in two columns, per N·m of mean torque and the rest (everything is
 * in the rest where currents are not linear in the torque). Angles without an answer are noted in *solution;
 * there the nearest current is taken. *answer is to be released in any case. HCI_ERROR_NUMERIC when e⊥
 * vanishes at an angle, or a kept direction has no current there; _MEMORY. */
hci_status hci_pointwise_answer(const hci_task *task, hci_answer *answer, hci_solution *solution,
                                hci_note *note);

#endif
