/* Which terms these recordings could show at all.
 *
 * In: the machine, what the recordings contain (time, motion, temperature, whole turns) and the residual of
 * the present model. Out: one candidate for each term that could be missing. Each effect
 * names its own (hci_effect_type.propose), from what the recordings are like as a whole. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATES_MAKE_CANDIDATES_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATES_MAKE_CANDIDATES_H

#include "host/diagnose/candidates/candidates.h"

/* Terms that these recordings could show, at the orders that stand out of the residual. Those that are
 * already `in` an older list (known; or NULL) stay, with their values. On failure *candidates is empty.
 * HCI_ERROR_MEMORY. O(samples·orders). */
hci_status hci_candidates_make(const hci_candidates_source *source, const hci_candidates *known,
                               hci_candidates *candidates, hci_note *note);

#endif
