/* Terms of one effect that nearly cancel.
 *
 * In: a model. Out: an effect of the machine whose terms make far less together than each of them does:
 * orders 5 and 7 of the back-EMF of recordings whose i_d has not been varied. What is left of them is small
 * beside what the model gets wrong of each, whatever their errors say, and no machine has two unrelated terms
 * of one size. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_CANCELLING_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_CANCELLING_H

#include "host/diagnose/candidates/candidates.h"
#include "host/diagnose/reading/regression.h"

/* The type in the model whose linear terms make, in the runs in use and in units of their noise, less than a
 * sixteenth of the sum of the squares of what they make one by one; NULL: none. A series in the currents,
 * whose powers do, is none, nor is a whole co-energy. HCI_ERROR_MEMORY. O(samples·terms²). */
hci_status hci_cancelling_find(const hci_regression *regression, const hci_candidates *candidates,
                               const hci_effect_type **type, hci_note *note);

#endif
