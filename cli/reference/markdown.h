/* The pages of docs/reference, in Markdown, to standard output. Uses book. */
#ifndef HCI_CLI_MARKDOWN_H
#define HCI_CLI_MARKDOWN_H

#include "cli/reference/book.h"

/* The page of one command. */
void cli_print_markdown_page(const cli_command *command);
/* The page that lists them all. */
void cli_print_markdown_index(const cli_book *book);

#endif
