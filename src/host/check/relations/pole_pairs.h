/* The pole pairs that the recordings count, whatever machine.csv says. */
#ifndef HCI_SRC_HOST_CHECK_POLE_PAIRS_H
#define HCI_SRC_HOST_CHECK_POLE_PAIRS_H

#include "host/check/data/data.h"

/* By the orders of a ripple without load, into data->pole_pairs_of_ripple; 0: no such recording. False: out
 * of memory. O(pole pairs × slots). */
bool hci_check_pole_pairs_of_ripple(check_data *data);

/* Into data->pole_pairs_of_ripple and data->counted_pole_pairs: by the waves of currents or voltages over the
 * mechanical angle, by both angles, or by the ripple. False: out of memory. */
bool hci_check_pole_pairs_count(check_data *data);

#endif
