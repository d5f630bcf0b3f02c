/* What a current makes of torque at each order: e + share·L'i as a list of waves. With share 1 it is ∂T/∂i,
 * with ½ its product with i is the mutual and reluctance torque. */
#ifndef HCI_SRC_HOST_MACHINE_TORQUE_GRADIENT_H
#define HCI_SRC_HOST_MACHINE_TORQUE_GRADIENT_H

#include "hci/host/base/note.h"
#include "hci/machine/torque.h"

/* *waves: out, to be freed with hci_memory_free. Waves below relative_floor times the largest are dropped.
 * HCI_ERROR_MEMORY. */
hci_status hci_torque_gradient(const hci_machine *machine, const hci_wave *currents, size_t count,
                               double share, double relative_floor, hci_wave **waves, size_t *wave_count,
                               hci_note *note);

#endif
