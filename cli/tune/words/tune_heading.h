/* The first lines of what tune says: what the table does, or why there is none, and the caveats, all that
 * makes it doubtful or has to be known before it is used. Uses tune_facts, tune_cover, tune_read,
 * tune_recorded, tune_size, tune_suspect. */
#ifndef HCI_CLI_TUNE_HEADING_H
#define HCI_CLI_TUNE_HEADING_H

#include "cli/tune/tune_steps.h"

/* Sets the heading of the report and the caveats under it. */
void cli_tune_set_heading(cli_tuning *tune);

#endif
