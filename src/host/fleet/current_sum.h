/* How much the sensors of three phase currents differ, by the sum of what they read. */
#ifndef HCI_SRC_HOST_FLEET_CURRENT_SUM_H
#define HCI_SRC_HOST_FLEET_CURRENT_SUM_H

#include "hci/host/recording/run.h"

/* Gain of each sensor, as a share of what it reads, less the mean of the three, of a star without neutral
 * conductor, whose true currents have no sum: a phase that is not like the others changes the torque alike,
 * but not this sum. By all runs to be fitted in which the three currents were recorded; NAN, with its
 * standard error, where they do not tell it to 0.01. False when memory is out. O(samples). */
bool hci_current_sum_gains(const hci_runs *runs, double gain[3], double std_error[3]);

#endif
