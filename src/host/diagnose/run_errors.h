/* The error of each run before and after the correction, beside its noise, and the totals of fitted and
 * held-out runs. */
#ifndef HCI_SRC_HOST_DIAGNOSE_RUN_ERRORS_H
#define HCI_SRC_HOST_DIAGNOSE_RUN_ERRORS_H

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/fit/dataset.h"

/* Fills run, line and the totals of a diagnosis whose effects are there already. parameters: that were
 * fitted. The noise of the dataset's regression becomes that of the readings of all runs. HCI_ERROR_MEMORY.
 * O(samples·(terms + orders)). */
hci_status hci_run_errors_fill(hci_dataset *dataset, const hci_runs *runs, size_t parameters,
                               hci_diagnosis *diagnosis, hci_note *note);

/* Fills run alone, of all runs before and after effects; the list of effects stays the caller's, and
 * diagnosis->run is to be freed. The noise of the dataset's regression becomes that of the readings of all
 * runs. HCI_ERROR_MEMORY. O(samples·terms). */
hci_status hci_run_errors_of(hci_dataset *dataset, const hci_runs *runs, const hci_effects *effects,
                             hci_diagnosis *diagnosis, hci_note *note);

/* Fills the totals from the errors of the runs. */
void hci_run_errors_total(hci_diagnosis *diagnosis);

#endif
