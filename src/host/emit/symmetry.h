/* Which part of a period of currents says all. */
#ifndef HCI_SRC_HOST_EMIT_SYMMETRY_H
#define HCI_SRC_HOST_EMIT_SYMMETRY_H

#include "host/emit/tabulate.h"

/* A period is so many sectors; from one to the next the phases move on and the sign may change. */
typedef struct {
    uint32_t sectors, rotation, alternates; /* as in hci_table_i16 */
} hci_symmetry;

/* The most sectors that the waves of a table allow. In phase currents: six, three or two of one electrical
 * turn; in the rotor frame any number, of equal currents. */
hci_symmetry hci_symmetry_of(const hci_tabulation *t);

#endif
