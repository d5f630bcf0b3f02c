/* Which terms of one or two effects come in together, on the linearised problem.
 *
 * In: normal equations with all candidates as columns, the model swept in. Out: the group of candidates that
 * lowers χ² by most over the price of its terms. Terms come in one at a time, the best first, and leave again
 * when others have made them superfluous; one sweep for each. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_GROUP_SELECTION_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_GROUP_SELECTION_H

#include "host/diagnose/candidates/candidates.h"
#include "host/numeric/normal_equations.h"

/* What is chosen from. */
typedef struct {
    const hci_candidates *list;
    const size_t *column;  /* of the normal equations: the first one of each candidate */
    const hci_sweep *base; /* with the model in it */
    double rows;
} hci_selection;

/* Chooses, among the candidates of types a and b that are not in the model, those whose gain in χ² exceeds
 * their cost. in: out, for each candidate whether it was chosen. sweep, spare: work, of the size of base and
 * of the list. Returns by how much the score would fall if the model were linear. O(steps·columns²). */
double hci_group_select(const hci_selection *choice, const hci_effect_type *a, const hci_effect_type *b,
                        bool *in, hci_sweep *sweep, bool *spare);

/* Sweeps the columns of a candidate in. False when all of them depend on those that are in. */
bool hci_selection_enter(const hci_selection *choice, hci_sweep *sweep, size_t candidate);

#endif
