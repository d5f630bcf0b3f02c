/* Resistance and inductances by voltages that were recorded while currents flow. */
#ifndef HCI_SRC_HOST_FLEET_VOLTAGES_H
#define HCI_SRC_HOST_FLEET_VOLTAGES_H

#include "hci/host/recording/run.h"
#include "hci/machine/torque.h"

/* Places in the arrays below: Ω, H, H. */
enum { HCI_VOLTAGES_R, HCI_VOLTAGES_L_D, HCI_VOLTAGES_L_Q, HCI_VOLTAGES_MOST };

/* By all runs to be fitted with voltages, currents, angle and speed, together with the size and the angle of
 * the back-EMF: u_d = R i_d − ω L_q i_q + e_d, u_q = R i_q + ω L_d i_d + e_q, of means over each electrical
 * turn. NAN, with its standard error, for what they do not tell to a fifth. False when memory is out.
 * O(samples). */
bool hci_voltages_fit(const hci_machine *machine, const hci_runs *runs, double value[HCI_VOLTAGES_MOST],
                      double std_error[HCI_VOLTAGES_MOST]);

#endif
