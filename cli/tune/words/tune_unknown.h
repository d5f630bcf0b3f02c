/* What is not known when all steps of tune are done. Uses tune_facts, tune_cover. */
#ifndef HCI_CLI_TUNE_UNKNOWN_H
#define HCI_CLI_TUNE_UNKNOWN_H

#include "cli/tune/tune_steps.h"

/* Adds to the part UNKNOWN of the report, and to NEXT what would tell it in a word. */
void cli_tune_say_unknown(cli_tuning *tune);

#endif
