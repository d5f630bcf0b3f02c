/* What motors of one make have in common and where they differ, as files in a folder and as JSON. */
#ifndef HCI_HOST_REPORT_FLEET_WRITE_H
#define HCI_HOST_REPORT_FLEET_WRITE_H

#include "hci/host/fleet/line.h"

#ifdef __cplusplus
extern "C" {
#endif

/* As in summary.json of `fleet`; to be freed with hci_text_free, NULL when memory is out. */
char *hci_line_json(const hci_line *line);

/* Writes fleet.csv, line.csv, deviations.csv, report.html and summary.json into `folder`; all or none.
 * HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_line_write(const hci_line *line, const char *folder, hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
