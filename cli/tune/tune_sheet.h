/* Numbers of the data sheet that were typed in another unit. Uses tune_steps. */
#ifndef HCI_CLI_TUNE_SHEET_H
#define HCI_CLI_TUNE_SHEET_H

#include "cli/tune/tune_steps.h"

/* Which number of the data sheet cannot be believed in its unit, by the recordings or by what motors have,
 * and what would be; false: none. text: of size bytes. */
bool cli_tune_say_sheet(const cli_tuning *tune, char *text, size_t size);

/* Whether another unit of the strength of the magnets, or another place of its point, makes the torques of
 * the recordings, with magnets that are usual or more so than those of the number as it is; and what it would
 * be. text: of size bytes. */
bool cli_tune_say_meant_strength(const cli_tuning *tune, char *text, size_t size);

#endif
