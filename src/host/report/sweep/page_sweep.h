/* The page of a sweep, appended to the current file of `out`. */
#ifndef HCI_SRC_HOST_REPORT_SWEEP_PAGE_SWEEP_H
#define HCI_SRC_HOST_REPORT_SWEEP_PAGE_SWEEP_H

#include "hci/host/base/output.h"
#include "hci/host/report/page/sources.h"
#include "hci/host/sweep/sweep.h"

void hci_page_sweep(hci_output *out, const hci_grid *sweep, const hci_report_sources *sources);

#endif
