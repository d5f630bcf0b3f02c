/* Whether the columns of i_d and i_q stand in each other's place, by what turns round with the motion. */
#ifndef HCI_SRC_HOST_CHECK_DATA_EXCHANGED_CURRENTS_H
#define HCI_SRC_HOST_CHECK_DATA_EXCHANGED_CURRENTS_H

#include "host/check/data/run_samples.h"

/* Of a shaft that its motor turns forward and back: friction is overcome by what is called i_d, and next to
 * nothing is in what is called i_q. False where the shaft goes one way, or a column is not there. O(samples).
 */
bool hci_check_currents_are_exchanged(const check_samples *samples);

/* Of phase currents that stand while the angle goes round: the phase with the largest, which i_q would be;
 * -1: they do not stand, or the angle does not go round. mean_A: out, its mean. O(samples). */
int hci_check_standing_phase(const check_samples *samples, double *mean_A);

#endif
