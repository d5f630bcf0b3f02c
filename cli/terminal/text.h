/* Texts in columns of a terminal: their width, styles, and lines that are wrapped. Uses terminal. */
#ifndef HCI_CLI_TEXT_H
#define HCI_CLI_TEXT_H

#include <stddef.h>
#include <stdio.h>

/* Styles inside a text; they vanish where there is no colour. */
#define CLI_GOOD  "\001"
#define CLI_WARN  "\002"
#define CLI_BAD   "\003"
#define CLI_PLAIN "\004"

/* Columns that a text takes, styles not counted. */
size_t cli_text_width(const char *text);
/* The last `most` columns of a text, or all of it. */
const char *cli_text_end(const char *text, size_t most);

/* A text in lines of `width` columns, of which `used` are taken in the first and `indent` in the others. */
void cli_print_wrapped(FILE *stream, int width, int used, int indent, const char *text);

#endif
