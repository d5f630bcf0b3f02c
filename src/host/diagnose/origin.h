/* What goes with the corrected machine of its diagnosis: diagnosis.csv. */
#ifndef HCI_SRC_HOST_DIAGNOSE_ORIGIN_H
#define HCI_SRC_HOST_DIAGNOSE_ORIGIN_H

#include "hci/host/diagnose/diagnose.h"

/* Fills d->uncertainty.origin of a whole diagnosis, whether or not anything is stated of the uncertainty.
 * HCI_ERROR_MEMORY. O(runs·samples). */
hci_status hci_origin_fill(const hci_machine *machine, const hci_runs *runs, hci_diagnosis *d,
                           hci_note *note);

#endif
