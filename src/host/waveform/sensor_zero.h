/* A torque of electrical order 1, which zeros of the current sensors that are off make as well as the motor.
 */
#ifndef HCI_SRC_HOST_WAVEFORM_SENSOR_ZERO_H
#define HCI_SRC_HOST_WAVEFORM_SENSOR_ZERO_H

#include "hci/effects/effect.h"
#include "hci/host/recording/run.h"
#include "hci/machine/torque.h"

/* Amplitude in N·m of the torque of electrical order 1 in a machine with effects of which the runs do not
 * tell whether it is cogging torque or the zeros of the current sensors: a drive makes what it reads as
 * wanted, and what it reads too much makes a torque of order 1 that is the same at every load. The larger of
 * what stands there as torque of the angle and of what the zeros in the effects make, unless these stand in
 * the currents that were read with a load, too, within half of themselves. zeros_read_A: the
 * largest zero of a sensor that was read while no current flowed, 0: none was. 0: there is no such torque;
 * one of the runs with a torque has no current at all, and shows it by itself; the zeros that were read are
 * half of it or more, so that they are not hidden by a drive; none of the runs tells a torque. O((harmonics +
 * terms)²). */
double hci_sensor_zero_Nm(const hci_machine *machine, const hci_effects *effects, const hci_runs *runs,
                          double zeros_read_A);

#endif
