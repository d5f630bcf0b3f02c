/* Current control in the rotor frame, which the controller of control.c alone uses. */
#ifndef HCI_SRC_CORE_DRIVE_CONTROL_LOOPS_H
#define HCI_SRC_CORE_DRIVE_CONTROL_LOOPS_H

#include "hci/drive/control.h"

/* One sample: from state->reference, state->feed and the measured current (A, αβ) at the angle and speed of
 * `measured` to state->current.pending, and without a delay to state->v. */
void hci_current_pi_sample(const hci_control *control, hci_control_state *state, const double current[2],
                           const hci_measurement *measured);

#endif
