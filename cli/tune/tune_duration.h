/* How long recordings took. Uses tune_steps. */
#ifndef HCI_CLI_TUNE_DURATION_H
#define HCI_CLI_TUNE_DURATION_H

#include "cli/tune/tune_steps.h"

/* Whether a recording without a speed took so long, with rows so far apart, that its time may be in
 * milliseconds; text: out, the question. */
bool cli_tune_say_long(const cli_tuning *tune, char *text, size_t size);

#endif
