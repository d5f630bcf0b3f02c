/* What several summaries have in common. */
#ifndef HCI_SRC_HOST_REPORT_SUMMARY_H
#define HCI_SRC_HOST_REPORT_SUMMARY_H

#include "hci/host/base/output.h"
#include "hci/host/machine/expected_ripple.h"
#include "hci/host/report/summary.h"
#include "hci/host/solve/loop_reach.h"
#include "host/base/json.h"

/* Begins the text: the command that has made the result, and the version of the program. */
void hci_summary_begin(hci_json *json, const char *command);

/* Writes summary.json, the last file of a set: the text, which is freed, with `files`, the checksum of each
 * other file. json: NULL where memory was out for it. */
hci_status hci_summary_write(hci_output *out, char *json, hci_note *note);

/* The object `expected`: what the real machine is expected to do. */
void hci_summary_expected(hci_json *json, const hci_expected_ripple *expected);

/* The object `current_loop`: what a current loop makes of the torque of the currents. */
void hci_summary_loop(hci_json *json, const hci_loop_reach *loop);

#endif
