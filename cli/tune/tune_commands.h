/* The ordinary commands as tune runs them, and as a shell repeats them. Uses tune_steps and the folder
 * command. */
#ifndef HCI_CLI_TUNE_COMMANDS_H
#define HCI_CLI_TUNE_COMMANDS_H

#include "cli/tune/tune_steps.h"

enum { CLI_TUNE_MOST_WORDS = 32 + 2 * CLI_MOST_REPEATS };

/* A command line; the words belong to the caller. */
typedef struct {
    const char *word[CLI_TUNE_MOST_WORDS];
    size_t count;
} cli_tune_line;

void cli_tune_add(cli_tune_line *line, const char *word);

/* name without its dashes; value: NULL for one without. */
void cli_tune_add_option(cli_tune_line *line, const char *name, const char *value);

/* How recordings are to be read, as tune was told or has found. */
void cli_tune_add_reading(cli_tune_line *line, const cli_tuning *tune);

/* What --angle-offset takes; NULL: none. */
const char *cli_tune_offset(const cli_tuning *tune);

/* Adds to commands.sh: text; a word as a shell takes it, a name as it is; a command that may answer 1 where
 * may_be_no. */
void cli_tune_note(cli_tuning *tune, const char *format, ...) HCI_PRINTF(2, 3);
void cli_tune_note_word(cli_tuning *tune, const char *word, bool is_name);
void cli_tune_note_line(cli_tuning *tune, const cli_tune_line *line, bool may_be_no);

/* What needs no quotes in a shell. */
bool cli_tune_is_plain(const char *word);

/* Runs a command here without words, and notes it. What it ends with is the status, with a note. */
hci_status cli_tune_run(cli_tuning *tune, const cli_command *command, cli_tune_line *line, hci_note *note);

/* The path of a name in the folder of the results. */
void cli_tune_path(const cli_tuning *tune, const char *name, char path[CLI_TUNE_PATH]);

#endif
