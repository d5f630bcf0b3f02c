/* The text of --help. Uses option and the folder terminal. */
#ifndef HCI_CLI_HELP_H
#define HCI_CLI_HELP_H

#include "cli/command/option.h"

/* Prints it to standard output, as wide as the terminal is. */
void cli_print_help(const cli_command *command);

#endif
