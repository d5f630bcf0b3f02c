/* What diagnose found, in the report of tune: each sentence under the heading where it belongs, nothing both
 * found and not known. Uses tune_steps. */
#ifndef HCI_CLI_TUNE_FOUND_H
#define HCI_CLI_TUNE_FOUND_H

#include "cli/tune/tune_steps.h"

/* When the diagnosis is there. */
void cli_tune_say_diagnosis(cli_tuning *tune);

#endif
