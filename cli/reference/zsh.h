/* Completion for zsh: commands, options, and what their values may be, to standard output. Uses book. */
#ifndef HCI_CLI_ZSH_H
#define HCI_CLI_ZSH_H

#include "cli/reference/book.h"

void cli_print_zsh(const cli_book *book);

#endif
