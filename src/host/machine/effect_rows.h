/* Rows of tables that begin with effect,parameter,value,unit: effects.csv and uncertainty.csv. */
#ifndef HCI_SRC_HOST_MACHINE_EFFECT_ROWS_H
#define HCI_SRC_HOST_MACHINE_EFFECT_ROWS_H

#include "hci/host/csv/csv.h"
#include "hci/host/machine/effects.h"

/* As hci_effects_read, of a table that has been read. row_of: out, [hci_csv_rows], the row of the table that
 * each term, in the order of the effects and their terms, was in; or NULL. */
hci_status hci_effects_of_csv(const hci_csv *csv, hci_effects_data *effects, size_t *row_of, hci_note *note);

/* Writes effect, parameter, value and unit of one term, each with a comma behind it. */
void hci_effect_term_write(hci_output *output, const hci_effect_type *type, const hci_effect_term *term);

#endif
