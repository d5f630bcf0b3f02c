/* What recordings tell of a motor beside the torque: by voltages, and by the sum of the currents. */
#ifndef HCI_SRC_HOST_FLEET_BESIDE_TORQUE_H
#define HCI_SRC_HOST_FLEET_BESIDE_TORQUE_H

#include "hci/host/fleet/fit.h"

/* Lists these behind the parameters of the torque, NAN for what is not told. HCI_ERROR_MEMORY. O(samples). */
hci_status hci_fleet_list_beside(const hci_machine_data *machine, const hci_runs *runs, hci_fleet_fit *fit,
                                 hci_note *note);

#endif
