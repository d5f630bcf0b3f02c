/* `emit --drive`: orders for hci/loop.h. Uses the folder command, emit_options and emit_words. */
#ifndef HCI_CLI_EMIT_DRIVE_H
#define HCI_CLI_EMIT_DRIVE_H

#include "cli/command/option.h"

/* All of it; returns the exit code. */
int cli_emit_for_drive(const cli_arguments *arguments);

#endif
