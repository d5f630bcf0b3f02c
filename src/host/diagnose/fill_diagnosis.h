/* What is said of the model that a search has found: the corrected machine, findings, errors of each run, and
 * what is left open. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FILL_DIAGNOSIS_H
#define HCI_SRC_HOST_DIAGNOSE_FILL_DIAGNOSIS_H

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/search/attribution.h"

/* a: what stands for no known effect leaves its model. d: an empty one. HCI_ERROR_MEMORY.
 * O(runs·samples·terms²). */
hci_status hci_diagnosis_fill(hci_dataset *b, const hci_runs *runs, hci_attribution *a, hci_diagnosis *d,
                              hci_note *note);

/* Whether a run in use turns, or is of means over turns. O(runs). */
bool hci_any_turns(const hci_dataset *b, const hci_runs *runs);

#endif
