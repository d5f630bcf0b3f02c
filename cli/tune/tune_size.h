/* Whether the sizes of what was found and solved for can be believed. Uses tune_steps. */
#ifndef HCI_CLI_TUNE_SIZE_H
#define HCI_CLI_TUNE_SIZE_H

#include "cli/tune/tune_steps.h"

/* Sets size by the solution: a unit that is another one makes a table many times too large. */
void cli_tune_judge_size(cli_tuning *tune);

/* Why no table is written, for its size or that of the ripple in the model, as the first line; false: one is.
 * text: of size bytes. */
bool cli_tune_say_excess(const cli_tuning *tune, char *text, size_t size);

/* Whether none is written for that of the ripple: the model does not explain the recordings. */
bool cli_tune_is_unexplained(const cli_tuning *tune);

/* What is rated, in N·m; 0: nothing is. */
double cli_tune_rated_Nm(const cli_tuning *tune);

/* Whether the bound on the machine is so far above what a plain sine makes that it says nothing. */
bool cli_tune_is_unpromised(const cli_tuning *tune);

/* Of measured and calculated torque, or its inverse: beyond it no magnet and no sensor is meant. */
#define CLI_TUNE_ANOTHER_TORQUE 2.5

/* Peak to peak of a sine, over its rms: what a ripple of known rms swings by. */
#define CLI_TUNE_SWING_OF_RMS 2.8

/* Which recording has its torque in another unit than the others, of which one shows what its currents make;
 * false: none has. text: of size bytes. */
bool cli_tune_say_mixed_torque(const cli_tuning *tune, char *text, size_t size);

/* What --column calls a torque that is so many times too large for N·m; "": no unit that is known. */
const char *cli_tune_torque_unit(double times);

#endif
