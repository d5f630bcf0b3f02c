/* How long tables may be whose work grows faster than their rows. */
#ifndef HCI_SRC_HOST_CSV_MOST_ROWS_H
#define HCI_SRC_HOST_CSV_MOST_ROWS_H

#include "hci/host/csv/csv.h"

enum {
    HCI_MOST_ORDERS_LISTED = 10000, /* rows of a spectrum, a set of components, currents */
    HCI_MOST_RUNS_LISTED = 4096     /* recordings of a list */
};

/* HCI_ERROR_INPUT where a table has more rows than `most`; remedy: in words. */
hci_status hci_csv_check_rows(const hci_csv *csv, size_t most, const char *remedy, hci_note *note);

#endif
