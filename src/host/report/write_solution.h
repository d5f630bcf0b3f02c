/* The files of a solution, as a part of what is written together. */
#ifndef HCI_SRC_HOST_REPORT_WRITE_SOLUTION_H
#define HCI_SRC_HOST_REPORT_WRITE_SOLUTION_H

#include "hci/host/base/output.h"
#include "hci/host/report/write.h"

/* Writes what hci_solution_write_with_report does into a set that is open; the caller commits it. verdict:
 * HCI_OK or HCI_NOT_REACHED. sources: of report.html, or NULL. HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_solution_write_into(hci_output *out, const hci_machine_data *machine,
                                   const hci_solution *solution, hci_status verdict,
                                   const hci_report_sources *sources, hci_note *note);

#endif
