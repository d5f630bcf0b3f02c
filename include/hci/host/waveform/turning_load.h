/* Orders of a torque that a load which turns with the shaft makes as well as the motor. */
#ifndef HCI_HOST_WAVEFORM_TURNING_LOAD_H
#define HCI_HOST_WAVEFORM_TURNING_LOAD_H

#include "hci/effects/effect.h"
#include "hci/host/recording/run.h"
#include "hci/machine/torque.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether an electrical order is once a mechanical turn, as gravity on an arm is, or twice, as a crank is.
 * Order 1 twice a turn (two pole pairs) is left to the zeros of the current sensors, which make it more
 * often.
 */
bool hci_is_turning_load_order(double order, int pole_pairs);

/* Amplitude in N·m of an electrical order in the torque of the angle alone, of a machine with effects:
 * declared cogging torque and what effects add to it. O(harmonics + terms). */
double hci_angle_torque_Nm(const hci_machine *machine, const hci_effects *effects, double order);

/* Amplitude in N·m of the larger of these orders in the cogging torque of a machine with effects, where it is
 * more than a tenth of the largest order there is; 0: none is. 0 too where one of the runs has a torque
 * sensor, which sees no load behind it, and where none tells a torque. O((harmonics + terms)²). */
double hci_turning_load_Nm(const hci_machine *machine, const hci_effects *effects, const hci_runs *runs);

#ifdef __cplusplus
}
#endif

#endif
