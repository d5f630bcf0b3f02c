/* Every term of the co-energy as candidates, in place of a choice among them: with an expectation of each
 * that is small where the power of the currents or the order is high, all of them can be fitted at once to a
 * few recordings. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATES_COENERGY_TERMS_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATES_COENERGY_TERMS_H

#include "host/diagnose/candidates/candidates.h"

/* Adds them to the ones that `known` has in: all are in then, and those of the series have coenergy_unit and
 * power. On failure *all is empty. HCI_ERROR_MEMORY. */
hci_status hci_coenergy_terms(const hci_candidates *known, const hci_effect_coenergy_series *series,
                              hci_candidates *all, hci_note *note);

#endif
