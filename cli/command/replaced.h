/* A folder of results with a summary.json that takes the place of that of an earlier call, as a whole or not
 * at all. */
#ifndef HCI_CLI_COMMAND_REPLACED_H
#define HCI_CLI_COMMAND_REPLACED_H

#include <stdbool.h>

#include "hci/host/base/note.h"

enum { CLI_REPLACED_PATH = 2048 };

/* Renames the results of an earlier call to a hidden name beside them, so that they are replaced as a whole
 * or not at all; those that a call left so which was killed are put back first. From here on until it is
 * settled no other call may do so: HCI_ERROR_OUTPUT where one does. aside: out, that name; "": there is
 * nothing to replace, or it cannot be renamed. HCI_ERROR_ARGUMENT for results in which something was changed
 * since they were written. */
hci_status cli_replaced_set_aside(const char *folder, char aside[CLI_REPLACED_PATH], hci_note *note);

/* Ends the replacement: deletes what was set aside, or, where nothing new was written, puts it back. To be
 * called in any case. */
void cli_replaced_settle(const char *folder, const char *aside, bool is_written);

#endif
