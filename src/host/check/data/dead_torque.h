/* Torques that are noise about one number: nothing is plugged in, or the column is another one. In: the
 * statistics of the recordings. Out: whether any of them answers to anything. */
#ifndef HCI_SRC_HOST_CHECK_DATA_DEAD_TORQUE_H
#define HCI_SRC_HOST_CHECK_DATA_DEAD_TORQUE_H

#include "host/check/data/data.h"

/* Whether the mean torque of a recording is more than its own noise makes of it. */
bool hci_check_torque_stands_out(const check_run *run);

/* Whether a torque was measured, of as many samples as tell. */
bool hci_check_torque_is_measured(const check_run *run);

/* Whether all torques that were measured are noise from row to row, as large in all recordings and about the
 * same mean: ripple, cogging torque and what drifts are not. noise_Nm: out, rms of the largest noise, in the
 * unit of the column. False where none was measured. O(samples). */
bool hci_check_torques_are_noise(const check_data *data, double *noise_Nm);

#endif
