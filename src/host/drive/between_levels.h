/* What the torque is between the levels of a table. */
#ifndef HCI_SRC_HOST_DRIVE_BETWEEN_LEVELS_H
#define HCI_SRC_HOST_DRIVE_BETWEEN_LEVELS_H

#include "host/drive/loop_set.h"
#include "host/machine/machine_plant.h"

/* Looks at a quarter, the half and three quarters of the way from each level to the next, with the table as
 * the controller reads it and currents that flow as they are. HCI_ERROR_MEMORY. */
hci_status hci_between_levels_find(const hci_loop_set *set, const hci_machine_plant *plant,
                                   hci_between_levels *found, hci_note *note);

#endif
