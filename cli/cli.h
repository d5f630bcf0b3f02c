/* The command line: options, commands and what they show. */
#ifndef HCI_CLI_H
#define HCI_CLI_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/note.h"
#include "hci/host/summary.h"

/* ---- options.c */

typedef enum { CLI_FLAG, CLI_VALUE, CLI_COUNT_OPTIONAL } cli_kind;

typedef struct {
    const char *name; /* without the dashes; NULL ends a list */
    char letter;      /* short form, or 0 */
    cli_kind kind;
    const char *value_name;
    const char *help;
} cli_option;

enum { CLI_MOST_OPTIONS = 32, CLI_MOST_WORDS = 4 };

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

/* ---- show.c: words for people, on standard error */

/* Tells an error or remark and returns the exit code of the status. */
int cli_fail(hci_status status, const hci_note *note);
void cli_remark(const hci_note *remark);

/* Progress on a terminal, on work longer than a second; `context` is not used. */
void cli_progress(void *context, const char *what, double share);
void cli_progress_end(void);

void cli_show_solution(const hci_solution *solution, const char *machine, const char *target);

/* ---- the commands */

extern const cli_command cli_harmonics, cli_solve, cli_predict, cli_simulate, cli_emit, cli_diagnose,
    cli_init;

/* After the help of `simulate`: what a scenario may hold. */
void cli_print_scenario_names(void);

#endif
