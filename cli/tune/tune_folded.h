/* Orders that samples show as lower ones: where so many of them are taken in each turn that two orders go
 * through them alike, as 120 and 20 of a turn with 140. Uses tune_steps. */
#ifndef HCI_CLI_TUNE_FOLDED_H
#define HCI_CLI_TUNE_FOLDED_H

#include "cli/tune/tune_steps.h"

/* A multiple of the order of slots and poles, above what the samples tell, that they show as this electrical
 * order, which is no such multiple itself; 0: none does. O(samples). */
double cli_tune_folded_from(const cli_tuning *tune, double order);

#endif
