/* Tables with the columns order, amplitude, phase_rad, as machine and target files have them. */
#ifndef HCI_SRC_HOST_MACHINE_SPECTRUM_TABLE_H
#define HCI_SRC_HOST_MACHINE_SPECTRUM_TABLE_H

#include "hci/host/csv/csv.h"
#include "hci/math/harmonic.h"

/* Reads `order`, `amplitude_column` (with its unit) and `phase_rad` into *terms, ascending by order;
 * (*row_of)[k] is the data row that term k stood in. Amplitudes may be negative. At order 0 the amplitude is
 * the mean and the phase 0 or π/2. Negative and repeated orders are errors. Both arrays are the caller's to
 * free with hci_memory_free. */
hci_status hci_spectrum_rows(const hci_csv *csv, const char *amplitude_column, hci_harmonic **terms,
                             size_t **row_of, size_t *count, hci_note *note);

/* Adds to a remark that the phases of a table are in rad and look like degrees, if they do: one is beyond two
 * turns. */
void hci_spectrum_tell_degrees(const hci_csv *csv, hci_note *remark);

/* The error of an order above HCI_MOST_ORDER, in any table with a column `order`. HCI_ERROR_INPUT. */
hci_status hci_spectrum_order_error(const hci_csv *csv, size_t row, hci_note *note);

#endif
