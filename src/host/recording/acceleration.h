/* The acceleration of a shaft whose torque was measured. */
#ifndef HCI_SRC_HOST_RECORDING_ACCELERATION_H
#define HCI_SRC_HOST_RECORDING_ACCELERATION_H

#include "hci/host/recording/run.h"

/* The slope of the speed at each sample of a run with time and speed; where the speed is itself a slope of
 * the angle, over a window that the noise of the angle asks for. rate_rad_per_s2: out, [count], count >= 2.
 * O(n). */
void hci_run_acceleration(const hci_run *run, double *rate_rad_per_s2);

#endif
