/* Completion for bash: commands, options, and what their values may be, to standard output. Uses book. */
#ifndef HCI_CLI_BASH_H
#define HCI_CLI_BASH_H

#include "cli/reference/book.h"

void cli_print_bash(const cli_book *book);

#endif
