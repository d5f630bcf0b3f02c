/* A CSV file that was read, written again with further columns. */
#ifndef HCI_SRC_HOST_CSV_WRITE_H
#define HCI_SRC_HOST_CSV_WRITE_H

#include "hci/host/base/output.h"
#include "hci/host/csv/csv.h"

typedef struct {
    const char *name, *unit; /* unit: for a file that has a row of units */
    const double *value;     /* hci_csv_rows of them; NAN in a recording: an empty cell */
} hci_csv_added;

/* Writes the columns of `csv` as they stand, but with comma and decimal point, and then those added; columns
 * of the same name are left out. Comments are not kept. HCI_ERROR_INPUT for a text that is not UTF-8,
 * _OUTPUT, _NOT_FINITE, _MEMORY. */
hci_status hci_csv_write_with(const hci_csv *csv, const hci_csv_added *added, size_t count, const char *path,
                              hci_note *note);

/* Appends a file as it stands, but in UTF-8 whatever it was saved in. HCI_ERROR_INPUT for what is no text,
 * _MEMORY. */
hci_status hci_csv_copy(const char *path, hci_output *output, hci_note *note);

/* Writes one cell, in quotes where CSV needs them, and the comma after it. first: of its row, where # would
 * begin a comment. */
void hci_csv_write_cell(hci_output *output, const char *cell, bool first);

#endif
