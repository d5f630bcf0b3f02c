/* What a map has to add to a drive's own current, at each angle. */
#ifndef HCI_SRC_HOST_EMIT_FOREIGN_NEED_H
#define HCI_SRC_HOST_EMIT_FOREIGN_NEED_H

#include "hci/host/emit/emit_foreign.h"
#include "host/foreign/map.h"
#include "host/machine/machine_plant.h"

/* The torque of the currents, and the machine that makes it. */
typedef struct {
    const hci_machine_plant *plant;
    const hci_emit_foreign_request *request;
    double torque_constant_Nm_per_A; /* of the drive */
    double torque_Nm;                /* mean of the currents over a mechanical turn */
} hci_foreign_need;

/* Fills torque_Nm. */
void hci_foreign_need_begin(hci_foreign_need *need);

/* The values of a map, one row at an electrical angle of the machine, in the sense of the machine: q, or d,
 * q, d per A, q per A. HCI_ERROR_INPUT where i_q makes too little torque at that angle. */
hci_status hci_foreign_need_at(const hci_foreign_need *need, hci_foreign_kind kind, double theta_rad,
                               double *value, hci_note *note);

#endif
