/* Components with their currents: what the linear problem is answered with. */
#ifndef HCI_SRC_HOST_SOLVE_ANSWER_H
#define HCI_SRC_HOST_SOLVE_ANSWER_H

#include "hci/host/currents/component_set.h"

/* Two columns of coordinates, S and C of each component in turn: the first in A/(N·m) for each N·m of mean
 * torque, the second in A for the rest. The current is mean × first + second. Start with {0}. */
typedef struct {
    hci_component_set set;
    double *x; /* 2·count × 2 */
} hci_answer;

/* Room for `count` components; set.count is set, nothing else filled. HCI_ERROR_MEMORY, without a note, which
 * the caller can word better. To be released in any case. */
hci_status hci_answer_reserve(size_t count, hci_answer *answer);

/* Replaces *to by a copy of *from. HCI_ERROR_MEMORY, without a note. */
hci_status hci_answer_copy(const hci_answer *from, hci_answer *to);

void hci_answer_release(hci_answer *answer);

/* Coordinate j of the current at a mean torque: x[j]·mean + x[n + j], n = 2·count. */
double hci_coordinate(const double *x, size_t n, double mean_Nm, size_t j);

#endif
