/* From a line of the list to the words of the command that is run on that motor. */
#ifndef HCI_CLI_BATCH_WORDS_H
#define HCI_CLI_BATCH_WORDS_H

#include "cli/command/option.h"
#include "hci/host/fleet/results.h"

enum { CLI_BATCH_MOST_WORDS = 64, CLI_BATCH_TEXT_SIZE = 16384 };

/* What all motors have in common. Start with {0}. */
typedef struct {
    const cli_command *command; /* that is run */
    const char *path;           /* of the list */
    hci_fleet_list list;
    const char *const *common; /* words of each motor, behind its own */
    size_t commons;
} cli_batch;

/* The words of one motor; they end with NULL. */
typedef struct {
    char *word[CLI_BATCH_MOST_WORDS + 1];
    size_t count;
    char text[CLI_BATCH_TEXT_SIZE];
    size_t used;
    bool is_full; /* there was no room for all of it */
} cli_batch_words;

/* Refuses a list with a column that is neither known nor an option of the command. HCI_ERROR_INPUT. */
hci_status cli_batch_check(const cli_batch *batch, hci_note *note);

/* The words of a motor without those for its results; in the list as it stands, for their digest, or with
 * paths from here. */
void cli_batch_words_of(const cli_batch *batch, size_t motor, bool from_here, cli_batch_words *words);

/* Its machine and its list of recordings alone, as words with paths from here. */
void cli_batch_paths_of(const cli_batch *batch, size_t motor, cli_batch_words *words);

/* Appends one. */
void cli_batch_add(cli_batch_words *words, const char *word);

#endif
