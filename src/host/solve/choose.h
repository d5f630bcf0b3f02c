/* Choice of components where the user names none. */
#ifndef HCI_SRC_HOST_SOLVE_CHOOSE_H
#define HCI_SRC_HOST_SOLVE_CHOOSE_H

#include "host/solve/answer.h"
#include "host/solve/set_cost.h"

/* As many as it takes: the lowest top order whose exact solution costs at most 1 % more copper than the
 * pointwise limit limit_mean_square_A2 (NAN: not known, then exactness is enough), or the best there is where
 * none does. *answer: out, to be released in any case. HCI_ERROR_MEMORY, _NUMERIC. */
hci_status hci_choose_all(const hci_task *task, double tolerance_Nm, double limit_mean_square_A2,
                          hci_answer *answer, hci_note *note);

/* At most `most` components: the best set by hci_set_cost_less of those that are searched. only: the
 * candidates, or NULL for all that there are. *answer: out, to be released in any case. HCI_ERROR_MEMORY,
 * HCI_ERROR_NUMERIC when no set could be solved. */
hci_status hci_choose_few(const hci_task *task, const hci_component_set *only, size_t most,
                          const hci_set_preference *preference, hci_answer *answer, hci_note *note);

#endif
