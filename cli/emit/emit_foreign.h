/* `emit --for`: the compensation map of another maker's drive. Uses the folder command, emit_currents and
 * emit_words. */
#ifndef HCI_CLI_EMIT_FOREIGN_H
#define HCI_CLI_EMIT_FOREIGN_H

#include "cli/command/option.h"

/* All of it; returns the exit code. */
int cli_emit_for_foreign(const cli_arguments *arguments);

#endif
