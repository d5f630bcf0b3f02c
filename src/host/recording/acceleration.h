/* The angular acceleration of a run, from its speed over time. */
#ifndef HCI_SRC_HOST_RECORDING_ACCELERATION_H
#define HCI_SRC_HOST_RECORDING_ACCELERATION_H

#include "hci/host/recording/run.h"

/* rad_per_s2: out, run->count; 0 where a run has no time or no speed. O(samples). */
void hci_run_accelerations(const hci_run *run, double *rad_per_s2);

#endif
