/* Results of many motors in one folder: a folder for each motor, which appears when it is done, and fleet.csv
 * with a row for each. A motor's folder holds its own row, so that nothing is lost but the motors that were
 * being worked at when the program is killed. */
#ifndef HCI_HOST_FLEET_RESULTS_H
#define HCI_HOST_FLEET_RESULTS_H

#include "hci/host/base/note.h"
#include "hci/host/fleet/list.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Commands that are run on each motor: X(command, word). */
#define HCI_FLEET_COMMAND_NAMES(X)                                                                           \
    X(HCI_FLEET_DIAGNOSE, "diagnose")                                                                        \
    X(HCI_FLEET_TUNE, "tune")                                                                                \
    X(HCI_FLEET_SOLVE, "solve")                                                                              \
    X(HCI_FLEET_FIT, "fit")

/* What is run on each motor. */
typedef enum {
    HCI_FLEET_DIAGNOSE, /* what its model lacks */
    HCI_FLEET_TUNE,     /* from its logs to a table */
    HCI_FLEET_SOLVE,    /* its currents */
    HCI_FLEET_FIT       /* the parameters in common */
} hci_fleet_command;

/* The word of a command; a static string. */
const char *hci_fleet_command_name(hci_fleet_command command);

/* How a motor came out: X(state, word). */
#define HCI_FLEET_STATE_NAMES(X)                                                                             \
    X(HCI_FLEET_DONE, "done")                                                                                \
    X(HCI_FLEET_OPEN, "open")                                                                                \
    X(HCI_FLEET_FAILED, "failed")                                                                            \
    X(HCI_FLEET_LATE, "late")                                                                                \
    X(HCI_FLEET_CRASHED, "crashed")

/* How a motor came out. */
typedef enum {
    HCI_FLEET_DONE,   /* the command ended with exit code 0 */
    HCI_FLEET_OPEN,   /* with exit code 1: done, but something is left open or not reached */
    HCI_FLEET_FAILED, /* with another one, for the reason that is given */
    HCI_FLEET_LATE,   /* it took longer than it may, and was ended */
    HCI_FLEET_CRASHED /* its process ended by a signal */
} hci_fleet_state;

/* The word of a state; a static string. */
const char *hci_fleet_state_name(hci_fleet_state state);

/* Bytes of a row as a line of fleet.csv, and of a reason. */
enum { HCI_FLEET_ROW_SIZE = 3584, HCI_FLEET_REASON_SIZE = 512 };

/* What became of a motor. */
typedef struct {
    hci_fleet_state state;              /* how it came out */
    int exit_code;                      /* of the command; -1: it has none */
    char reason[HCI_FLEET_REASON_SIZE]; /* of a motor without a result; or "" */
} hci_fleet_outcome;

/* Where results are, and of what. */
typedef struct {
    const char *folder;         /* of all of it */
    hci_fleet_command command;  /* that is run on each motor */
    const hci_fleet_list *list; /* the motors */
} hci_fleet_results;

/* A digest of the words that a command was given, 16 hexadecimal digits. */
typedef struct {
    char text[17]; /* the digits */
} hci_fleet_digest;

/* Of a command with its words, which end with NULL; version: of the program. */
hci_fleet_digest hci_fleet_digest_of(const char *version, const char *const *words);

/* The folder that a motor's results are written to before they appear: folder/motors/.NAME.part. part: out.
 * HCI_ERROR_OUTPUT where the path is too long. */
hci_status hci_fleet_part(const hci_fleet_results *results, size_t motor, char *part, size_t size,
                          hci_note *note);

/* Removes what a process that was killed has left in that folder. HCI_ERROR_OUTPUT. */
hci_status hci_fleet_begin(const hci_fleet_results *results, size_t motor, hci_note *note);

/* Ends a motor: its row is made of the outcome and of the files in its part folder, is written beside them,
 * and the folder gets its name, folder/motors/NAME, all at once. row: out, the line of fleet.csv without its
 * end. Of an outcome without a result the part folder is emptied first. HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_fleet_end(const hci_fleet_results *results, size_t motor, const hci_fleet_outcome *outcome,
                         const hci_fleet_digest *digest, char row[HCI_FLEET_ROW_SIZE], hci_note *note);

/* The row of a motor that is done; false: it is not. HCI_ERROR_INPUT where it was done by another command, or
 * with other words, which the note tells, or its row cannot be read. */
hci_status hci_fleet_known(const hci_fleet_results *results, size_t motor, const hci_fleet_digest *digest,
                           char row[HCI_FLEET_ROW_SIZE], bool *is_done, hci_note *note);

/* Whether the results of a motor that is done are one whole: each file that its summary.json names is the one
 * that was written with it, also in the folders within, and the row says what they say. HCI_ERROR_INPUT where
 * they are not, the note tells by which file; _MEMORY. A motor without a result has none that could be. */
hci_status hci_fleet_check(const hci_fleet_results *results, size_t motor, const hci_fleet_digest *digest,
                           const char *row, hci_note *note);

/* The state in a row. */
hci_fleet_state hci_fleet_row_state(const char *row);

/* Why a row has no result, as its column `reason`; "": it has one. reason: out. */
void hci_fleet_row_reason(const char *row, char reason[HCI_FLEET_REASON_SIZE]);

/* Takes away a motor that is done, so that it is done again. HCI_ERROR_OUTPUT. */
hci_status hci_fleet_forget(const hci_fleet_results *results, size_t motor, hci_note *note);

/* Holds the folder, which is made where it is missing, for this process and those that it starts.
 * HCI_ERROR_OUTPUT where another one has it for longer than some seconds. Give *lock to hci_fleet_unlock. */
hci_status hci_fleet_lock(const hci_fleet_results *results, void **lock, hci_note *note);

/* Lets it go; NULL is fine. */
void hci_fleet_unlock(void *lock);

/* Motors by their state, and how many there are. */
typedef struct {
    size_t of[HCI_FLEET_CRASHED + 1]; /* by hci_fleet_state */
    size_t done, motors;              /* with any state; of the list */
} hci_fleet_count;

/* Counts the rows; NULL: not done. */
hci_fleet_count hci_fleet_count_rows(char *const *row, size_t count);

/* Writes fleet.csv: the rows that are not NULL, in the order of the list; and where is_complete summary.json
 * beside it. HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_fleet_write(const hci_fleet_results *results, char *const *row, bool is_complete,
                           hci_note *note);

/* How far fleet.sqlite has come. Start with {0}. */
typedef struct {
    double *seconds; /* that each motor of the list took; NAN: not known */
    bool *is_stored; /* of each: it has its row there */
    bool is_begun;   /* the first hci_fleet_store has been */
    bool is_last;    /* a file that another program holds is waited for, and then an error; else the rows
                        are left for the next call */
} hci_fleet_stored;

/* Brings fleet.sqlite up to the rows that are not NULL, in one transaction: table `motor` with the columns of
 * fleet.csv and `seconds`, table `parameter` with the rows of parameters.csv of each motor. The first call
 * takes out motors that are not done. HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_fleet_store(const hci_fleet_results *results, char *const *row, hci_fleet_stored *stored,
                           hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
