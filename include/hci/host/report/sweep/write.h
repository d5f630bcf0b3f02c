/* Results of a sweep as files in a folder, and as JSON. */
#ifndef HCI_HOST_REPORT_SWEEP_WRITE_H
#define HCI_HOST_REPORT_SWEEP_WRITE_H

#include "hci/host/report/page/sources.h"
#include "hci/host/sweep/sweep.h"

#ifdef __cplusplus
extern "C" {
#endif

/* As in summary.json of `sweep`; to be freed with hci_text_free, NULL when memory is out. */
char *hci_grid_json(const hci_grid *sweep);

/* Writes trade_off.csv, envelope.csv or map.csv with the picture of the same name, summary.json and, with
 * sources, report.html into `folder`; all or none. All points are done. HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_grid_write(const hci_grid *sweep, const hci_report_sources *sources, const char *folder,
                          hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
