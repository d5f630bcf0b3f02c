/* Cogging torque of a holding test with what diagnose has added to it, and what such recordings do not tell
 * from it: a load on the shaft, a zero of the current sensors, the mains, slots of another motor. Uses
 * tune_effects, tune_facts, tune_folded. */
#ifndef HCI_CLI_TUNE_FOUND_COGGING_H
#define HCI_CLI_TUNE_FOUND_COGGING_H

#include "cli/tune/tune_steps.h"

/* When the diagnosis is there. Sets how well the orders are known. */
void cli_tune_say_found_cogging(cli_tuning *tune);

#endif
