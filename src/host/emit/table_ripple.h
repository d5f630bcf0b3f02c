/* What the cut of a table does to the torque. */
#ifndef HCI_SRC_HOST_EMIT_TABLE_RIPPLE_H
#define HCI_SRC_HOST_EMIT_TABLE_RIPPLE_H

#include "host/emit/emission.h"

/* The largest torque in N·m that an error of 1 A in each current of the table makes, at the currents of the
 * emission. */
double hci_table_torque_per_error(const hci_emission *e);

/* The ripple over one mechanical turn with the table that the emission has become, read as a controller reads
 * it, at each torque that a table is told for. */
void hci_table_ripples(hci_emission *e);

#endif
