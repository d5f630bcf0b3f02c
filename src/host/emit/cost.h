/* What reading a table costs a controller. */
#ifndef HCI_SRC_HOST_EMIT_COST_H
#define HCI_SRC_HOST_EMIT_COST_H

#include "host/emit/tabulate.h"

/* Fills in the instructions of one call of the function that a choice is read by. */
void hci_emit_cost(const hci_tabulation *t, hci_emit_choice *choice);

#endif
