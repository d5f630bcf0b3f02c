/* What to record or to correct next. Uses tune_facts, tune_suspect. */
#ifndef HCI_CLI_TUNE_NEXT_H
#define HCI_CLI_TUNE_NEXT_H

#include "cli/tune/tune_steps.h"

/* Adds to the part NEXT of the report. */
void cli_tune_say_next(cli_tuning *tune);

#endif
