/* Which components could be of use. */
#ifndef HCI_SRC_HOST_SOLVE_CANDIDATES_H
#define HCI_SRC_HOST_SOLVE_CANDIDATES_H

#include "host/solve/task.h"

/* The highest order that is wanted or disturbed, and the highest of the back-EMF; at least 1 each. */
void hci_candidates_span(const hci_task *task, double *torque_order, double *emf_order);

/* Every component up to `top_order` that U connects, directly or through others, with an order that is wanted
 * or disturbed. *set is to be released in any case. HCI_ERROR_MEMORY. */
hci_status hci_candidates(const hci_task *task, double top_order, hci_component_set *set, hci_note *note);

#endif
