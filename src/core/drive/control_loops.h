/* Current control in the rotor frame, which the controller of control.c alone uses. */
#ifndef HCI_SRC_CORE_DRIVE_CONTROL_LOOPS_H
#define HCI_SRC_CORE_DRIVE_CONTROL_LOOPS_H

#include "hci/drive/control.h"

/* One sample: from reference and measured current (A, αβ) at the angle and speed of `measured` to state->v.
 */
void hci_current_pi_sample(const hci_control *control, hci_current_pi_state *state, const double reference[2],
                           const double current[2], const hci_measurement *measured);

#endif
