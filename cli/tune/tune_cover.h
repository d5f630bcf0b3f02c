/* How much of the turn the recordings show, and how finely: which orders they can tell. Uses tune_steps. */
#ifndef HCI_CLI_TUNE_COVER_H
#define HCI_CLI_TUNE_COVER_H

#include "cli/tune/tune_steps.h"

/* What one recording covers. */
typedef struct {
    double turns;          /* mechanical, from the least angle to the largest */
    double samples_a_turn; /* of those that were kept: a torque that is held over rows is read once; 0: not
                              told */
    double highest_order;  /* electrical, that so many samples tell; 0: not told */
} cli_tune_cover;

/* Zeros of a recording without an angle. O(samples). */
cli_tune_cover cli_tune_cover_of(const hci_run *run);

/* Sets turns, highest_order and tells_no_order of the recordings that have been read, which follow time. */
void cli_tune_cover_set(cli_tuning *tune);

/* Whether less than a mechanical turn is covered, so that orders closer than one over it are not told apart.
 */
bool cli_tune_is_short(const cli_tuning *tune);

/* Whether the order of slots and poles was not looked at since a part of the turn has no samples, although
 * those that there are lie close enough. */
bool cli_tune_has_gap(const cli_tuning *tune);

/* The largest part of the mechanical turn without a sample in either direction, of the slow turn that has the
 * smallest; 2π without such a turn. */
double cli_tune_least_gap_rad(const cli_tuning *tune);

/* The widest gap across which the order of slots and poles is told. */
double cli_tune_widest_gap_rad(const cli_tuning *tune);

/* Whether orders that slots and poles make twice over, or order 12, lie beyond what the samples tell. */
bool cli_tune_is_coarse(const cli_tuning *tune);

#endif
