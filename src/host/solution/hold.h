/* Currents of which a sampled current loop leaves little: a voltage that stands still between two samples
 * makes polygons of them (theory.md, section 16). */
#ifndef HCI_SRC_HOST_SOLUTION_HOLD_H
#define HCI_SRC_HOST_SOLUTION_HOLD_H

#include "host/solution/limited.h"

/* What the loop misses of currents, peak to peak, their mean of i_a² + i_b² + i_c², and the largest error of
 * an order of the torque that they make as they are. */
typedef struct {
    double ripple_Nm, copper_A2, error_Nm;
} hci_held_worth;

/* What was done that the loop misses less. */
typedef struct {
    bool is_worth_it;          /* else nothing was */
    bool is_exact;             /* asked of hold_least.h */
    hci_held_worth first, now; /* of the orders as they come, and of those that were found */
    hci_answer as_they_come;
} hci_held;

/* The currents without limits, by the method that the options and the machine ask for. With
 * options->sample_rad those of the same torque of which the loop misses least, within 1.5 times the copper
 * and the dc link, where R and L are known and the torque is linear (hold_least.h); else the squares of high
 * orders are priced until the copper is that, or the torque would not be the same any more. Either ends at a
 * ripple of 1 % of the mean torque. Neither where that takes less than a tenth of the ripple away, nor where
 * the torque determines the currents. Leaves the price in the task. has_parts: out,
 * whether the first column of the answer is what 1 N·m more takes. held: in {0}, out what was done; its
 * as_they_come to be released in any case. */
hci_status hci_held_answer(const hci_limited *of, hci_answer *answer, bool *has_parts, hci_held *held,
                           hci_note *note);

/* Says in the remark of the solution what the loop misses of an answer: that of hci_held_answer, or the one
 * that limits have put in its place. HCI_ERROR_MEMORY. */
hci_status hci_held_tell(const hci_limited *of, const hci_held *held, const hci_answer *answer,
                         hci_note *note);

/* Peak to peak, what the corners of the polygon leave of the torque of currents; sample_rad: electrical angle
 * of a sample. */
double hci_hold_ripple_Nm(const hci_task *task, const hci_wave *current, size_t count, double sample_rad);

#endif
