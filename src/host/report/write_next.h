/* What a diagnosis would have recorded next, as a table. */
#ifndef HCI_SRC_HOST_REPORT_WRITE_NEXT_H
#define HCI_SRC_HOST_REPORT_WRITE_NEXT_H

#include "hci/host/base/output.h"
#include "hci/host/diagnose/diagnose.h"

/* Starts measure_next.csv as the next file of a set, or takes care that there is none where nothing is left
 * open. HCI_ERROR_OUTPUT, _MEMORY; discard the set then. */
hci_status hci_next_points_write(hci_output *output, const hci_diagnosis *diagnosis, hci_note *note);

#endif
