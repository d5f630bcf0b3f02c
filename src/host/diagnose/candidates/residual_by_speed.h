/* What a model leaves on the average at each speed, for effects that act through the speed alone.
 *
 * In: the residual of all runs with its variance. Out: its weighted mean in each of 32 bins of the speed,
 * four an octave down from the fastest, for each direction by itself. Runs that do not tell the mean of a
 * torque, or no torque, have no part in it. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATES_RESIDUAL_BY_SPEED_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATES_RESIDUAL_BY_SPEED_H

#include "host/diagnose/candidates/candidates.h"

enum { HCI_SPEED_BINS = 32, HCI_SPEED_MEANS = 2 * HCI_SPEED_BINS };

/* Returns how many there are. O(samples). */
size_t hci_residual_by_speed(const hci_candidates_source *source,
                             hci_effect_speed_mean mean[HCI_SPEED_MEANS]);

#endif
