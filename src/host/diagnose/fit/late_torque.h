/* A torque channel that is late, looked for on a grid of delays.
 *
 * In: a residual. Out: by how much later the torque was read than the other channels, where χ² falls most. A
 * Gauss–Newton fit finds a delay of less than a radian of the orders that matter; over a slow bus it is many.
 */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_LATE_TORQUE_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_LATE_TORQUE_H

#include "host/diagnose/reading/regression.h"

typedef struct {
    double delay_s; /* negative: the other channels are late */
    double gain;    /* fall of χ² */
} hci_late_torque;

/* Both 0 where no delay helps. residual_Nm: of a model, with the noise of now. HCI_ERROR_MEMORY. O(samples)
 * for each of some hundred delays. */
hci_status hci_late_torque_find(const hci_regression *regression, const double *residual_Nm,
                                hci_late_torque *late, hci_note *note);

#endif
