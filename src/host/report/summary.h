/* What several summaries have in common. */
#ifndef HCI_SRC_HOST_REPORT_SUMMARY_H
#define HCI_SRC_HOST_REPORT_SUMMARY_H

#include "hci/host/machine/expected_ripple.h"
#include "hci/host/report/summary.h"
#include "host/base/json.h"

/* Begins the text: the command that has made the result, and the version of the program. */
void hci_summary_begin(hci_json *json, const char *command);

/* The object `expected`: what the real machine is expected to do. */
void hci_summary_expected(hci_json *json, const hci_expected_ripple *expected);

#endif
