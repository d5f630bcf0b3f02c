/* The command line: options, commands and what they show. */
#ifndef HCI_CLI_H
#define HCI_CLI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "hci/host/base/note.h"
#include "hci/host/report/summary.h"

/* ---- options.c */

typedef enum { CLI_FLAG, CLI_VALUE, CLI_COUNT_OPTIONAL } cli_kind;

typedef struct {
    const char *name; /* without the dashes; NULL ends a list */
    char letter;      /* short form, or 0 */
    cli_kind kind;
    const char *value_name;
    const char *help;
} cli_option;

enum { CLI_MOST_OPTIONS = 32, CLI_MOST_WORDS = 72 };

/* Beside words_needed: more may follow. */
enum { CLI_OR_MORE = 256 };

typedef struct {
    bool given[CLI_MOST_OPTIONS];
    const char *value[CLI_MOST_OPTIONS]; /* NULL for a flag or a count that was left out */
    const char *word[CLI_MOST_WORDS];
    size_t words;
} cli_arguments;

typedef struct {
    const char *name, *words, *does;
    const cli_option *options;
    size_t words_needed;
    const char *example;
    int (*run)(const cli_arguments *arguments);
} cli_command;

/* Parses what follows the command. HCI_ERROR_ARGUMENT with a note that names the word and the remedy. */
hci_status cli_parse(const cli_command *command, int count, char *const *words, cli_arguments *arguments,
                     hci_note *note);

/* A number of an option; HCI_ERROR_ARGUMENT unless it is finite and inside [low, high]. */
hci_status cli_number(const char *option, const char *text, double low, double high, double *value,
                      hci_note *note);

/* Position of a word in a NULL-ended list of choices; HCI_ERROR_ARGUMENT when it is none of them. */
hci_status cli_choice(const char *option, const char *text, const char *const *choices, int *value,
                      hci_note *note);

void cli_print_help(const cli_command *command);

/* What every command has, in the same words: CLI_COMMON_KEYS ends its enum of options, CLI_COMMON_OPTIONS its
 * table. */
#define CLI_COMMON_KEYS JSON, QUIET, COLOR, HELP
#define CLI_COMMON_OPTIONS                                                                                   \
    [JSON] = {"json", 0, CLI_FLAG, NULL, "the summary as JSON on standard output, in place of the words"},   \
    [QUIET] = {"quiet", 'q', CLI_FLAG, NULL, "no words and no progress, only errors"},                       \
    [COLOR] = {"color", 0, CLI_VALUE, "WHEN", "auto (default: on a terminal), always or never"},             \
    [HELP] = {"help", 'h', CLI_FLAG, NULL, "this text"},                                                     \
    {                                                                                                        \
        NULL, 0, CLI_FLAG, NULL, NULL                                                                        \
    }
#define CLI_EXIT_ERRORS "2 command line; 3 input; 4 numerical; 5 output\n"

/* Index of the common option of this name in a command's table; -1 where it has none. */
int cli_option_find(const cli_command *command, const char *name);

/* Of NULL-ended names the one that `word` was probably meant to be, or NULL. */
const char *cli_nearest(const char *word, const char *const *names);

/* ---- terminal.c: words for people, on standard error */

/* What is asked for by --quiet, --json and --color, and what standard error is. Before it: no colour. */
hci_status cli_terminal_begin(const cli_command *command, const cli_arguments *arguments, hci_note *note);

/* Whether words are wanted: neither --quiet nor --json. */
bool cli_is_wordy(void);
bool cli_is_quiet(void);
/* Whether standard error is a terminal that is more than dumb. */
bool cli_is_terminal(void);
/* Whether drawings are made of ASCII: without a terminal, so that scripts see the same everywhere, and where
 * the locale is not of UTF-8. */
bool cli_is_ascii(void);
/* Columns of the terminal: COLUMNS, else what `descriptor` says, else 80. */
int cli_width(int descriptor);
/* Columns that a text takes, styles not counted. */
size_t cli_text_width(const char *text);
/* The last `most` columns of a text, or all of it. */
const char *cli_text_end(const char *text, size_t most);

/* Styles inside a text; they vanish where there is no colour. */
#define CLI_GOOD  "\001"
#define CLI_WARN  "\002"
#define CLI_BAD   "\003"
#define CLI_PLAIN "\004"

/* Part of a line, shown when the line ends. On a terminal a long line `  key   words` is continued below its
 * words. */
void cli_say(const char *format, ...) HCI_PRINTF(1, 2);
/* Words of any length as lines of at most 96 columns. */
void cli_say_paragraph(int indent, const char *text);
/* A text in lines of `width` columns, of which `used` are taken in the first and `indent` in the others. */
void cli_print_wrapped(FILE *stream, int width, int used, int indent, const char *text);

/* Tells an error or remark and returns the exit code of the status. */
int cli_fail(hci_status status, const hci_note *note);
void cli_remark(const hci_note *remark);

/* ---- progress.c */

/* What the rate of a job is counted in: `total` of `unit` make the whole. Context of cli_progress, or NULL.
 */
typedef struct {
    double total;
    const char *unit;
} cli_work;

/* Progress on a terminal, on work longer than a second. */
void cli_progress(void *work, const char *what, double share);
void cli_progress_end(void);

/* Ctrl-C and its like: the line is cleared, and no half-written file stays. */
void cli_signals_catch(void);

/* ---- draw.c: tables with bars */

enum { CLI_MOST_COLUMNS = 8, CLI_MOST_ROWS = 20 };

typedef enum { CLI_LEFT, CLI_RIGHT, CLI_BAR } cli_column_kind;

typedef struct {
    cli_column_kind kind;
    const char *head;
} cli_column;

/* A bar is as long as its value from 0 on (NAN: no bar); mark: a line across it, such as noise (NAN: none).
 */
typedef struct {
    char text[48];
    double value, mark;
} cli_cell;

typedef struct {
    const char *caption; /* what is drawn, its unit, and what it is compared with */
    const cli_column *column;
    size_t columns, rows;
    void (*fill)(const void *context, size_t row, cli_cell cell[]);
    const void *context;
    bool logarithmic;
    const char *unit;
} cli_chart;

void cli_draw(const cli_chart *chart);

/* One bar in so many cells; share and mark from 0 to 1. text: 4 bytes for each cell, and one. */
void cli_bar_text(double share, double mark, int cells, char *text);

/* With as many decimals as give five digits to the largest value of the column. */
void cli_number_text(double value, double largest, char *text, size_t size);

/* The largest of `count` values, at most CLI_MOST_ROWS, in their order; those below `least` of the largest
 * do not count. Returns how many. left_out: how many more there are, or NULL. */
size_t cli_pick(double (*value)(const void *context, size_t k), const void *context, size_t count,
                double least, size_t pick[CLI_MOST_ROWS], size_t *left_out);

/* ---- show.c */

void cli_show_solution(const hci_solution *solution, const char *machine, const char *target);

/* ---- the commands */

extern const cli_command cli_check;
extern const cli_command cli_harmonics, cli_solve, cli_predict, cli_simulate, cli_emit, cli_diagnose,
    cli_init;

/* After the help of `simulate`: what a scenario may hold. */
void cli_print_scenario_names(void);

/* `reference`, which tells of all others: man page, completion, Markdown. Returns the exit code. */
int cli_reference(const cli_command *const *commands, size_t count, int word_count, char *const *words);

#endif
