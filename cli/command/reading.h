/* How recordings are read, from the options that every command that reads them has. Uses option. */
#ifndef HCI_CLI_READING_H
#define HCI_CLI_READING_H

#include "cli/command/option.h"
#include "hci/host/recording/run.h"

/* The options of reading, and what they own. */
typedef struct {
    hci_run_options run; /* pole pairs and inertia are the caller's to fill in */
    hci_column_names columns;
} cli_reading;

/* Takes --column and, where it is given, --strict. *reading is to be released even after a failure, and not
 * to be moved. HCI_ERROR_ARGUMENT, HCI_ERROR_MEMORY. */
hci_status cli_reading_take(const cli_arguments *arguments, bool strict, cli_reading *reading,
                            hci_note *note);
void cli_reading_release(cli_reading *reading);

/* The remarks of recordings, remark(context, k) for k < count: what several have in common is said once, with
 * their number. */
void cli_remark_each(const hci_note *(*remark)(const void *context, size_t k), const void *context,
                     size_t count);

#endif
