/* What man page, Markdown pages and completion share: all commands, and how their tables are taken apart. */
#ifndef HCI_CLI_REFERENCE_H
#define HCI_CLI_REFERENCE_H

#include "cli/command/command.h"

enum { REFERENCE_MOST_COMMANDS = 32 };

typedef struct {
    const cli_command *command[REFERENCE_MOST_COMMANDS];
    size_t count;
} reference_book;

/* A piece of a text that is not ended by '\0'. */
typedef struct {
    const char *text;
    size_t length;
} reference_span;

/* The first line of what a command does, without its full stop: a title. */
reference_span reference_title(const cli_command *command);

/* The next line of a text, without its end; *text moves behind it, and is NULL after the last one. */
reference_span reference_line(const char **text);

/* ---- completion.c */

void reference_bash(const reference_book *book);
void reference_zsh(const reference_book *book);

#endif
