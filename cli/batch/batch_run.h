/* The motors of a batch, done by several processes. */
#ifndef HCI_CLI_BATCH_RUN_H
#define HCI_CLI_BATCH_RUN_H

#include "cli/batch/batch_words.h"
#include "cli/command/shard.h"

/* Who does it, and what is left of it. Start with {0}. */
typedef struct {
    const cli_batch *batch;
    hci_fleet_results results;
    cli_shard shard;
    const cli_command *fit; /* run beside a diagnosis */
    size_t jobs;
    double limit_s; /* of a motor; 0: none */
    bool retries;   /* motors without a result are done again */
    char **row;     /* of each motor of the list; NULL: not done */
} cli_batch_work;

/* Does what is not done yet and belongs to the share, and writes fleet.csv on the way and at the end.
 * work->row is to be given to cli_batch_release even after a failure. After Ctrl-C it ends with what it has,
 * cli_signals_deferred tells. */
hci_status cli_batch_run(cli_batch_work *work, hci_note *note);

void cli_batch_release(cli_batch_work *work);

#endif
