/* What the logs have already, which no advice may ask for. Uses tune_recorded. */
#ifndef HCI_CLI_TUNE_KNOWN_H
#define HCI_CLI_TUNE_KNOWN_H

#include "cli/tune/tune_steps.h"

/* Whether voltages of the open machine among them have told where its zero is. */
bool cli_tune_has_zero_of_voltages(const cli_tuning *tune);

/* Whether one with a torque sensor is of a load without an i_d, where no reluctance makes a mean torque.
 * O(samples). */
bool cli_tune_has_load_along_q(const cli_tuning *tune);

/* Whether loads with a torque sensor have an i_d of both signs, of a tenth of the current and more.
 * O(samples). */
bool cli_tune_has_both_id(const cli_tuning *tune);

/* What tells a saliency from another zero, beside loads of which the back-EMF is found turned, as far as it
 * is not among the logs; a clause. O(samples). */
const char *cli_tune_turn_told_by(const cli_tuning *tune);

/* Whether all loads with a torque sensor have an i_d ten times their i_q and more, and no phase currents.
 * O(samples). */
bool cli_tune_lies_along_d(const cli_tuning *tune);

/* How many loads with a torque sensor there are, whose currents differ by a fifth and more. O(samples +
 * recordings²). */
size_t cli_tune_load_sizes(const cli_tuning *tune);

/* Whether there are loads beside a torque sensor, and the motor drives in all of them: none is turned
 * against. */
bool cli_tune_loads_drive_alone(const cli_tuning *tune);

/* Whether one is a slow turn without a load, whose current is read as a holding test, or would be with the
 * inertia. O(samples). */
bool cli_tune_has_free_turn(const cli_tuning *tune);

#endif
