/* A column of torques that a drive has computed from its own current: it says of the current what is known of
 * it already, and of the machine nothing. */
#ifndef HCI_SRC_HOST_RECORDING_COMPUTED_TORQUE_H
#define HCI_SRC_HOST_RECORDING_COMPUTED_TORQUE_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/recording/run.h"

/* Whether n torques are one constant times i_q of the same sample, but for the rounding of both (twice their
 * steps, or 1e-6 of the largest torque), while i_q varies by more than a hundredth of its largest value and
 * more than that rounding. A torque that was measured has noise and cogging. constant: out, N·m/A. Fewer than
 * 16 samples say nothing. O(n). */
bool hci_torque_is_of_current(const double *torque_Nm, const double *iq_A, size_t n, double *constant);

/* Whether the torque of a run is one number other than 0 in every row while i_q varies by more than a
 * thousandth, both over the angle: what somebody has typed, or a sensor that stands still. A measured torque
 * has noise. Fewer than 16 samples say nothing. O(samples). */
bool hci_torque_is_typed(const hci_run *run);

#endif
