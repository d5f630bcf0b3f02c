/* The points of a sweep, solved by several processes, and kept in its folder on the way. */
#ifndef HCI_CLI_SWEEP_RUN_H
#define HCI_CLI_SWEEP_RUN_H

#include "cli/sweep/sweep_inputs.h"

/* Where points come from and go to. */
typedef struct {
    size_t jobs;
    const char *out;         /* folder, or NULL */
    const char *const *join; /* folders whose points are taken too */
    size_t joins;
} cli_sweep_work;

/* Solves what is not done yet and belongs to the share. *sweep: out, to be released even after a failure.
 * After Ctrl-C it ends with what it has, cli_signals_deferred tells. */
hci_status cli_sweep_run(const cli_sweep_inputs *inputs, const cli_sweep_work *work, hci_grid *sweep,
                         hci_note *note);

#endif
