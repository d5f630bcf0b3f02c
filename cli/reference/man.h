/* The man page, to standard output. Uses book. */
#ifndef HCI_CLI_MAN_H
#define HCI_CLI_MAN_H

#include "cli/reference/book.h"

void cli_print_man(const cli_book *book);

#endif
