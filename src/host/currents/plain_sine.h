/* The sine that currents are compared with. */
#ifndef HCI_SRC_HOST_CURRENTS_PLAIN_SINE_H
#define HCI_SRC_HOST_CURRENTS_PLAIN_SINE_H

#include "hci/machine/torque.h"

/* The least sine whose mutual torque has this mean: in phase with the positive sequence of the back-EMF's
 * fundamental, whose torque with it is 3/2 |e| |i|. Of amplitude 0 where there is no such fundamental. */
hci_wave hci_plain_sine(const hci_machine *machine, double mean_Nm);

#endif
