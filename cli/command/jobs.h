/* Independent work shared out among processes. Uses the folder terminal. */
#ifndef HCI_CLI_JOBS_H
#define HCI_CLI_JOBS_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/base/note.h"

enum { CLI_MOST_JOBS = 256, CLI_MOST_ANSWER = 4096 };

/* What is to be done, and who does it. */
typedef struct {
    size_t jobs;        /* processes, 1 to CLI_MOST_JOBS */
    const size_t *item; /* what is to be worked at, handed out in this order */
    size_t items;
    size_t answer_size; /* bytes, at most CLI_MOST_ANSWER */

    /* In a process of its own: works at one item. */
    void (*work)(void *context, size_t item, void *answer);
    /* In this process: takes an answer, as they come; NULL: its process was ended by the signal, or was ended
     * here for CLI_JOB_LATE. */
    void (*take)(void *context, size_t item, const void *answer, int signal);
    /* Every so often, a fifth of a second at most; false: stop. */
    bool (*goes_on)(void *context);
    void *context;
    double limit_s;    /* a process that takes longer for an item is ended; 0: none is */
    bool outlives_all; /* a process that ends in any way but by Ctrl-C and its like is replaced */
} cli_jobs;

/* What take gets in place of a signal: the process took longer than limit_s. */
enum { CLI_JOB_LATE = -1 };

/* Works at all items, or until it is told to stop. A process that a fault of its own ends (SIGSEGV and its
 * like) is replaced; one that was ended from outside ends the work, unless outlives_all. HCI_ERROR_MEMORY
 * where no process can be started, HCI_ERROR_NUMERIC where one was ended from outside. */
hci_status cli_jobs_run(const cli_jobs *jobs, hci_note *note);

/* Processors that this computer has for us, at least 1. */
size_t cli_processors(void);

#endif
