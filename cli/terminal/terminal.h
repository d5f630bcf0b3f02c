/* What standard output and standard error are and how much is wanted on them: the lowest file of cli.
 *
 * Order in this folder; a file uses only those before it:
 *   terminal  what the two streams are, what --quiet, --json and --color ask for, the line of progress
 *   text      width of texts, styles, lines that are wrapped
 *   say       results for people on standard output; errors and remarks on standard error
 *   rows      which rows of a long table are shown
 *   bar       one bar of characters
 *   chart     a table with bars
 *   estimate  from shares of a job that are done to its rate and the time that is left
 *   progress  the line that tells of long work
 *   signals   Ctrl-C and its like
 * The folder uses nothing of the rest of cli. */
#ifndef HCI_CLI_TERMINAL_H
#define HCI_CLI_TERMINAL_H

#include <stdbool.h>

typedef enum { CLI_COLOR_AUTO, CLI_COLOR_ALWAYS, CLI_COLOR_NEVER } cli_color;

/* Sets what is asked for by --quiet, --json and --color; before it: neither, and auto. */
void cli_terminal_begin(bool quiet, bool json, cli_color color);

/* Whether words are wanted: neither --quiet nor --json. */
bool cli_is_wordy(void);
bool cli_is_quiet(void);
bool cli_is_json(void);
/* Whether STDOUT_FILENO or STDERR_FILENO is a terminal that is more than dumb. */
bool cli_is_terminal(int descriptor);
/* Whether styles are shown there: by --color; `auto` on a terminal, unless NO_COLOR says otherwise. */
bool cli_has_color(int descriptor);
/* Whether the locale is one of UTF-8, by the names in LC_ALL, LC_CTYPE and LANG. */
bool cli_is_utf8(void);
/* Whether drawings there are made of ASCII: without a terminal, so that scripts see the same everywhere, and
 * where the locale is not of UTF-8. */
bool cli_is_ascii(int descriptor);
/* Columns of the terminal: COLUMNS, else what `descriptor` says, else 80; at least 40. */
int cli_width(int descriptor);

/* ---- a line that the next one replaces */

/* Shows a line in place of the one that was shown so before. */
void cli_line_show(const char *line);
bool cli_line_is_shown(void);
/* Erases it, where there is one. */
void cli_line_erase(void);
/* The same by write() alone, as a signal handler may. */
void cli_line_erase_in_handler(void);

#endif
