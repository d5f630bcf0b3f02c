/* Which recordings have currents of another direction in the rotor frame than most. Uses tune_steps. */
#ifndef HCI_CLI_TUNE_DIRECTIONS_H
#define HCI_CLI_TUNE_DIRECTIONS_H

#include "cli/tune/tune_steps.h"

/* Writes the names of these, with commas and an "and". Loads whose mean currents lie within 15 degrees of
 * each other, forward or braking, are of one direction; the most of them is that of most recordings, and they
 * have to be two and more than of any other one. False, and names is "", where there is none beside it, or
 * none of most. O(samples + recordings²). */
bool cli_tune_other_directions(const cli_tuning *tune, char *names, size_t size);

#endif
