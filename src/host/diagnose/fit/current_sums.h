/* What a model leaves of i_a + i_b + i_c, which is 0 where no neutral is connected: gains and offsets of
 * current sensors show there, however little torque they make. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_CURRENT_SUMS_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_CURRENT_SUMS_H

#include "host/diagnose/fit/regression.h"

/* The sum of the readings of one sample, without what sensors add to it. A. */
double hci_current_sum_left(const hci_regression *regression, const hci_effects *effects,
                            const hci_binned_sample *sample);

/* Root mean square over the runs in use whose sums say something, in units of the noise of a sample; 0: none
 * does. O(samples·terms). */
double hci_current_sums_rms(const hci_regression *regression, const hci_effects *effects);

#endif
