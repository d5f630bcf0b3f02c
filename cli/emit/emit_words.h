/* What `emit` says of what it wrote, on standard error. Uses the folder terminal. */
#ifndef HCI_CLI_EMIT_WORDS_H
#define HCI_CLI_EMIT_WORDS_H

#include "hci/host/emit/emit.h"
#include "hci/host/emit/emit_foreign.h"
#include "hci/host/emit/emit_loop.h"

/* A table, orders for hci/loop.h, a map of another maker's drive. folder: where the files are. */
void cli_show_table(const hci_emit_request *request, const hci_emit_result *result, const char *folder);
void cli_show_loop(const hci_emit_loop_request *request, const hci_emit_loop_result *result,
                   const char *folder);
void cli_show_foreign(const hci_emit_foreign_request *request, const hci_emit_foreign_result *result,
                      const char *folder);

/* Where what was written is of little use: a table with a large error, a map that makes the ripple larger or
 * whose torque the drive does not reach. */
void cli_remark_table(const hci_emit_result *result);
void cli_remark_foreign(const hci_emit_foreign_result *result);

#endif
