/* What tune says. Uses tune_steps and the folder terminal. */
#ifndef HCI_CLI_TUNE_WORDS_H
#define HCI_CLI_TUNE_WORDS_H

#include "cli/tune/tune_steps.h"

/* Sets the verdict, the heading and what is not known, when all steps are done. */
void cli_tune_conclude(cli_tuning *tune);

/* Verdict, before and after, the parts of the report and the commands, on standard output. */
void cli_show_tuning(const cli_tuning *tune);

#endif
