/* Where the electrical zero is, by the back-EMF that diagnose found, and the saliency that does as well.
 * Uses tune_effects, tune_facts, tune_line. */
#ifndef HCI_CLI_TUNE_FOUND_ZERO_H
#define HCI_CLI_TUNE_FOUND_ZERO_H

#include "cli/tune/tune_steps.h"

/* When the diagnosis is there. Sets by how much the zero is turned, as far as that is told. */
void cli_tune_say_found_zero(cli_tuning *tune);

#endif
