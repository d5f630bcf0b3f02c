/* One current component as a row of a file names it. */
#ifndef HCI_SRC_HOST_CURRENTS_COMPONENT_ROW_H
#define HCI_SRC_HOST_CURRENTS_COMPONENT_ROW_H

#include "hci/host/csv/csv.h"
#include "hci/host/currents/component_set.h"

/* A component and the name under which the file has it. */
typedef struct {
    hci_component component;
    hci_set name;
} hci_component_row;

/* Reads column `set` of a row whose order is known. HCI_ERROR_INPUT for an order or name that is none, and
 * for a zero sequence without neutral conductor. */
hci_status hci_component_row_read(const hci_csv *csv, size_t row, double order, bool has_neutral,
                                  hci_component_row *component, hci_note *note);

#endif
