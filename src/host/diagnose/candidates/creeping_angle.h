/* Whether the angle creeps against the motor, as that of an encoder that loses counts, or slips on its shaft.
 *
 * In: swings of the torque that come so often in a turn of the angle, and no whole number of times. Declared
 * cogging torque of n periods in a turn of the motor comes n (1 + ε) times in a turn of an angle that falls
 * behind by ε, with the amplitude that it has. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATES_CREEPING_ANGLE_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATES_CREEPING_ANGLE_H

#include "hci/machine/torque.h"
#include "host/diagnose/prepare/run_statistics.h"

/* In words, where several runs show it; NULL: none do. Static. statistics: [runs]. */
const char *hci_creeping_angle(const hci_machine *machine, const hci_run_statistics *statistics, size_t runs);

#endif
