/* Which components currents within limits have. */
#ifndef HCI_SRC_HOST_SOLUTION_LIMITED_SET_H
#define HCI_SRC_HOST_SOLUTION_LIMITED_SET_H

#include "host/solution/wishes_program.h"
#include "host/solve/answer.h"

/* Fills wishes->set: that of the answer without limits where it was given or is of at most K components, else
 * all that the wanted torque needs up to its top order; where the torque is not linear up to order 61, unless
 * is_whole. HCI_ERROR_MEMORY. */
hci_status hci_limited_set_choose(const hci_answer *answer, bool is_whole, hci_wishes *wishes,
                                  hci_note *note);

/* Whether the components up to order 61 are fewer than those that the answer without limits has. */
bool hci_limited_set_is_cut(const hci_answer *answer, const hci_wishes *wishes);

#endif
