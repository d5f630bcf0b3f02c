/* The page of a fleet, appended to the current file of `out`. */
#ifndef HCI_SRC_HOST_REPORT_FLEET_PAGE_FLEET_H
#define HCI_SRC_HOST_REPORT_FLEET_PAGE_FLEET_H

#include "hci/host/base/output.h"
#include "hci/host/fleet/line.h"

void hci_page_fleet(hci_output *out, const hci_line *line);

#endif
