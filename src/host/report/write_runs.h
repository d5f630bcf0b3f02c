/* The list of recordings of a diagnosis, for the next one. */
#ifndef HCI_SRC_HOST_REPORT_WRITE_RUNS_H
#define HCI_SRC_HOST_REPORT_WRITE_RUNS_H

#include "hci/host/base/output.h"
#include "hci/host/recording/run.h"

/* Starts runs.csv as the next file of a set: file (from the folder, which is there), role, and how it is to
 * be read. Takes care that there is none where it is not known where the runs are from. HCI_ERROR_INPUT,
 * _OUTPUT, _MEMORY; discard the set then. */
hci_status hci_runs_write(hci_output *output, const hci_runs *runs, const char *folder, hci_note *note);

#endif
