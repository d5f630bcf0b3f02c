/* report.html of `tune`. */
#ifndef HCI_SRC_HOST_REPORT_TUNE_PAGE_TUNING_H
#define HCI_SRC_HOST_REPORT_TUNE_PAGE_TUNING_H

#include "hci/host/base/output.h"
#include "hci/host/report/tune/tuning.h"

void hci_page_tuning(hci_output *out, const hci_tuning *tuning);

#endif
