/* The call that goes on with what was recorded. Uses tune_steps and tune_options. */
#ifndef HCI_CLI_TUNE_GO_ON_H
#define HCI_CLI_TUNE_GO_ON_H

#include "cli/tune/tune_steps.h"

/* Below what to record next, where there is something: the same call with the new logs. */
void cli_tune_say_go_on(cli_tuning *tune);

#endif
