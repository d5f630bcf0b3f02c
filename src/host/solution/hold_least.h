/* Of all currents with the same torque those of which a sampled current loop leaves most, within a copper
 * loss and the voltage (theory.md, section 16). */
#ifndef HCI_SRC_HOST_SOLUTION_HOLD_LEAST_H
#define HCI_SRC_HOST_SOLUTION_HOLD_LEAST_H

#include "host/solution/wishes_program.h"

/* What is asked for. Surface magnets in star connection. */
typedef struct {
    const hci_limited *of;
    const hci_component_set *set;
    const double *x;  /* 2·count: currents that have the torque */
    double most_A2;   /* mean of i_a² + i_b² + i_c², at most */
    double enough_Nm; /* torque, peak to peak, that may be missed: the least copper is then sought */
} hci_hold_question;

/* What the loop misses of the torque of coordinates x between its samples, peak to peak; HUGE_VAL without
 * memory. */
double hci_hold_missed_Nm(const hci_hold_question *question, const double *x);

/* Whether R and L are known and the torque is linear, so that hci_hold_least can be asked. */
bool hci_hold_is_known(const hci_limited *of);

/* x: out, 2·count. HCI_ERROR_NUMERIC where there is none, without a note; _MEMORY. */
hci_status hci_hold_least(const hci_hold_question *question, double *x, hci_note *note);

#endif
