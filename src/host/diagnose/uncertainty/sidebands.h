/* Terms that come with an order of the mechanical turn that was found.
 *
 * What varies over the turn, as unequal magnets do, multiplies all of the torque: around each order of the
 * cogging torque and of what the back-EMF makes with the currents there are orders k/p beside it, of which
 * only those that stand out are found. The others are as large as the share that was found. */
#ifndef HCI_SRC_HOST_DIAGNOSE_UNCERTAINTY_SIDEBANDS_H
#define HCI_SRC_HOST_DIAGNOSE_UNCERTAINTY_SIDEBANDS_H

#include "host/diagnose/candidates/candidates.h"

/* Adds them to a fitted model, at 0 and with the deviations that are to be expected, unless it has them.
 * machine: the declared one. HCI_ERROR_MEMORY, and then `model` has some of them. */
hci_status hci_sidebands_add(const hci_machine *machine, hci_candidates *model, hci_note *note);

#endif
