/* What man page, Markdown pages and completion share: all commands, and pieces of their texts.
 *
 * Order in this folder; a file uses only those before it and the folders terminal and command:
 *   book       all commands, pieces of texts
 *   man        the man page
 *   markdown   the pages in docs/reference
 *   bash, zsh  completion
 *   reference  the command `reference` */
#ifndef HCI_CLI_BOOK_H
#define HCI_CLI_BOOK_H

#include "cli/command/option.h"

enum { CLI_MOST_COMMANDS = 32 };

typedef struct {
    const cli_command *command[CLI_MOST_COMMANDS];
    size_t count;
} cli_book;

/* A piece of a text that is not ended by '\0'. */
typedef struct {
    const char *text;
    size_t length;
} cli_span;

/* All of a text. */
cli_span cli_span_of(const char *text);

/* The next line of a text, without its end; *text moves behind it, and is NULL after the last one. */
cli_span cli_span_line(const char **text);

/* The first line of what a command does, without its full stop: a title. */
cli_span cli_span_title(const cli_command *command);

/* "--name VALUE" of an option, VALUE in brackets where it may be left out; `print` prints the words, and
 * `value_mark` stands before VALUE. */
void cli_print_option_name(const cli_option *option, const char *value_mark, void (*print)(cli_span));

/* Whether a command is `reference`, whose words are kinds of text and names of commands. */
bool cli_is_reference(const cli_command *command);

/* What `reference` prints. */
#define CLI_REFERENCE_KINDS "man bash zsh markdown"

/* The choices of an option, divided by blanks, to standard output. */
void cli_print_choices(const cli_option *option);

/* The names of all commands, divided by blanks, to standard output. */
void cli_print_command_names(const cli_book *book);

#endif
