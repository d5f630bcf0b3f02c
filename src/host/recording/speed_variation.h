/* How evenly a shaft turns within an electrical turn. */
#ifndef HCI_SRC_HOST_RECORDING_SPEED_VARIATION_H
#define HCI_SRC_HOST_RECORDING_SPEED_VARIATION_H

#include "hci/host/recording/run.h"

/* rms of the speed about its mean over half an electrical turn, as a share of that mean; where the shaft
 * keeps its direction and about its pace, so that neither a turn round nor a pause nor another speed counts.
 * The speed is the slope of the angle, since a recorded one may be noisier. *share: out, 0 where a run
 * without time or with too few such samples does not tell. False: no memory. O(samples). */
bool hci_speed_variation(const hci_run *run, int pole_pairs, double *share);

#endif
