/* The command `reference`, which prints what the tables of all commands say. Uses all of this folder. */
#ifndef HCI_CLI_REFERENCE_H
#define HCI_CLI_REFERENCE_H

#include "cli/command/option.h"

/* Prints man page, completion or Markdown of these commands and of itself; words: those behind `reference`.
 * Returns the exit code. */
int cli_reference(const cli_command *const *commands, size_t count, int word_count, char *const *words);

#endif
