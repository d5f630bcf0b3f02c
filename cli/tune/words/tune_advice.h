/* What diagnose asks to be recorded next, in the report of tune: in the words that people use, and for tables
 * of a calculation without speeds and directions. Uses tune_steps. */
#ifndef HCI_CLI_TUNE_ADVICE_H
#define HCI_CLI_TUNE_ADVICE_H

#include "cli/tune/tune_steps.h"

/* When the diagnosis is there. */
void cli_tune_say_advice(cli_tuning *tune);

#endif
