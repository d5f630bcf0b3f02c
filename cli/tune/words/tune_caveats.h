/* What the first line of tune hangs on, and what else one has to know before the table is used: a sentence
 * each, without its full stop. Uses tune_facts, tune_cover, tune_read, tune_recorded, tune_size,
 * tune_suspect. */
#ifndef HCI_CLI_TUNE_CAVEATS_H
#define HCI_CLI_TUNE_CAVEATS_H

#include "cli/tune/tune_steps.h"

/* Adds one, as printf does. */
void cli_tune_caveat(cli_tuning *tune, const char *format, ...) HCI_PRINTF(2, 3);

/* Columns that were not read, where that is why nothing was solved. */
void cli_tune_column_caveats(cli_tuning *tune);

/* What of the logs was not read, and what may not be of this motor. */
void cli_tune_log_caveats(cli_tuning *tune);

/* What the table needs of the drive, and does not do. */
void cli_tune_table_caveats(cli_tuning *tune);

/* What the recordings do not tell of torque and machine. */
void cli_tune_untold_caveats(cli_tuning *tune);

#endif
