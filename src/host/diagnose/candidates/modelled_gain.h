/* Whether what a model changes of the machine is as well a gain of the torque sensor.
 *
 * A sensor that reads (1 + g) T shows the torque per ampere and every order of the cogging torque off by g,
 * of which the latter is seen in the residual only until the model has a cogging torque that differs. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATES_MODELLED_GAIN_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATES_MODELLED_GAIN_H

#include "host/diagnose/candidates/candidates.h"

#define HCI_SAME_GAIN 0.3 /* of a gain, that what shows it may be off */

/* Whether the model changes a declared order of the cogging torque by the same factor as the torque per
 * ampere, to three tenths of it, and turns it by no more; another order may differ in its own way, which is
 * then the machine's. gain: of the torque per ampere. */
bool hci_modelled_gain(const hci_machine *machine, const hci_candidates *model, double gain);

/* Whether candidate k of the model is the cogging torque of such an order. */
bool hci_modelled_gain_has(const hci_machine *machine, const hci_candidates *model, double gain, size_t k);

#endif
