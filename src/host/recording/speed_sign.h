/* Whether a recorded speed tells which way the shaft turns.
 *
 * In: a run with a speed that was recorded, an angle and a time, and the slopes of the angle. Out: whether
 * noise turns the sign of the speed about while the angle goes one way, as that of a slow turn. */
#ifndef HCI_SRC_HOST_RECORDING_SPEED_SIGN_H
#define HCI_SRC_HOST_RECORDING_SPEED_SIGN_H

#include "hci/host/recording/run.h"

/* How often a speed changes its sign: below HCI_SPEED_SIGN_CHANGES it is not noise around 0. */
enum { HCI_SPEED_SIGN_CHANGES = 4 };
size_t hci_speed_sign_changes(const double *speed, size_t count);

/* slope: [count]. The speed has the other sign in one row of a hundred or more, changes it four times as
 * often as the angle, and is that of the angle on the whole. O(samples). */
bool hci_speed_sign_is_noise(const hci_run *run, const double *slope);

#endif
