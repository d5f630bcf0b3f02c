/* What the recordings leave open about the machine of a diagnosis: d->uncertainty. */
#ifndef HCI_SRC_HOST_DIAGNOSE_LEFT_OPEN_H
#define HCI_SRC_HOST_DIAGNOSE_LEFT_OPEN_H

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/search/attribution.h"

/* a: what the search found; d: with its effects, and without an uncertainty. Nothing is stated of a search
 * that ended early, and beside something unknown that is not in the means of the runs alone. Errors and cost
 * are those of hci_uncertainty_find. */
hci_status hci_left_open_find(hci_dataset *b, const hci_attribution *a, hci_diagnosis *d, hci_note *note);

#endif
