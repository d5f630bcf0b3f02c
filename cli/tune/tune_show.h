/* What tune says on the terminal. Uses tune_facts and the folder terminal. */
#ifndef HCI_CLI_TUNE_SHOW_H
#define HCI_CLI_TUNE_SHOW_H

#include "cli/tune/tune_steps.h"

/* Verdict, before and after, the parts of the report and the commands, on standard output. */
void cli_show_tuning(const cli_tuning *tune);

#endif
