/* What follows from all steps of tune. Uses tune_heading, tune_unknown and tune_next. */
#ifndef HCI_CLI_TUNE_CONCLUDE_H
#define HCI_CLI_TUNE_CONCLUDE_H

#include "cli/tune/tune_steps.h"

/* Sets the verdict, the heading, what is not known and what to do next, when all steps are done. */
void cli_tune_conclude(cli_tuning *tune);

#endif
