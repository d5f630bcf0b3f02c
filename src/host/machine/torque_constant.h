/* What a machine with its effects makes of a current along q. */
#ifndef HCI_SRC_HOST_MACHINE_TORQUE_CONSTANT_H
#define HCI_SRC_HOST_MACHINE_TORQUE_CONSTANT_H

#include "hci/effects/effect.h"

/* N·m per ampere of i_q as it is read, at rest, in the limit of small currents, averaged over a mechanical
 * turn: 3/2 of the fundamental of the back-EMF, with whatever effects make of it. O(terms + harmonics). */
double hci_torque_constant(const hci_machine *machine, const hci_effects *effects);

/* The same, and its derivatives by the values of all terms: by_value[terms]. work: [terms]. */
double hci_torque_constant_by_value(const hci_machine *machine, const hci_effects *effects, double *by_value,
                                    double *work);

#endif
