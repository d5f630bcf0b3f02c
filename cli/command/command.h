/* From the words of a command to its exit code. Uses option, parse, help and the folder terminal. */
#ifndef HCI_CLI_COMMAND_H
#define HCI_CLI_COMMAND_H

#include "cli/command/option.h"
#include "hci/host/base/note.h"

/* Runs a command on the words that follow it; --help among them prints its help. Returns the exit code. */
int cli_command_run(const cli_command *command, int count, char *const *words);

/* Whether one of the words asks for help. */
bool cli_asks_for_help(int count, char *const *words);

/* Prints a summary to standard output and frees it; NULL: memory was out, and that is the status. */
hci_status cli_print_json(char *json, hci_note *note);

#endif
