/* Whether voltages that were recorded without a current are those of the declared back-EMF.
 *
 * In: a machine and recordings. Out: the share by which they differ. The torque is all that effects are found
 * in, and without a current it says nothing of the back-EMF: that the voltages contradict it has to be said.
 */
#ifndef HCI_SRC_HOST_DIAGNOSE_OPEN_VOLTAGE_H
#define HCI_SRC_HOST_DIAGNOSE_OPEN_VOLTAGE_H

#include "hci/host/recording/run.h"
#include "hci/machine/torque.h"

/* rms of the voltages less speed × back-EMF over the rms of the latter, without their sum and without what
 * changes from sample to sample as noise does; 0 where no recording has voltages, an angle and a speed and no
 * current. O(samples·waves). */
double hci_open_voltage_off(const hci_machine *machine, const hci_runs *runs);

/* Whether there are such voltages, and they are those of the declared back-EMF. */
bool hci_open_voltage_agrees(const hci_machine *machine, const hci_runs *runs);

/* Size of these voltages beside the declared back-EMF, all phases together: 1 where it is the same; NAN
 * without such voltages. Here currents that are nothing but the noise of their sensors are none. */
double hci_open_voltage_scale(const hci_machine *machine, const hci_runs *runs);

/* The same of the runs to be fitted, however well it is known, with its standard error by white noise. */
double hci_open_voltage_scale_fitted(const hci_machine *machine, const hci_runs *runs, double *std_error);

/* Whether a run has such voltages. */
bool hci_open_voltage_is_in(const hci_machine *machine, const hci_run *run);

#endif
