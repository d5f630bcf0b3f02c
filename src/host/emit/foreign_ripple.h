/* What ripple a map leaves in its drive. */
#ifndef HCI_SRC_HOST_EMIT_FOREIGN_RIPPLE_H
#define HCI_SRC_HOST_EMIT_FOREIGN_RIPPLE_H

#include "host/emit/foreign_need.h"

/* Torque over one mechanical turn with a plain sine and with the map, which is read as the drive reads it,
 * both at the same mean torque: what the map adds to it or takes from it the drive's own i_q makes good, as a
 * speed controller does. Where the drive's numbers end before that, mean_Nm is what it reaches. */
hci_foreign_ripple hci_foreign_ripple_of(const hci_foreign_need *need, const hci_foreign_map *map,
                                         double torque_Nm);

/* Peak to peak of the torque over one mechanical turn with a plain sine of that mean torque. */
double hci_emit_sine_ripple_Nm(const hci_machine_plant *plant, double torque_Nm);

#endif
