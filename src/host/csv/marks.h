/* Which mark of a column is the decimal one, and its cells as numbers. */
#ifndef HCI_SRC_HOST_CSV_MARKS_H
#define HCI_SRC_HOST_CSV_MARKS_H

#include "host/base/number_read.h"
#include "host/csv/column.h"

/* A column that is read cell by cell. */
typedef struct {
    const hci_csv *csv;
    size_t column;
    double factor;        /* of numbers */
    double of_second;     /* of clock times, from seconds; 0: the column is no time */
    const hci_unit *unit; /* that is asked for; NULL: any number will do */
    bool is_order;        /* a fraction is a number here */
    char decimal;         /* mark */
    double first_day;     /* of clock times; NAN: none so far */
    size_t united;        /* cells that have been read with a unit of their own, which is not the column's */
    size_t first_united;  /* the record of the first of them */
} hci_cell_reader;

/* name: the canonical one that the column was found by. */
hci_cell_reader hci_cell_reader_of(const hci_csv *csv, const char *name, const hci_column_match *found);

/* Of any column, whose numbers have no unit. */
hci_cell_reader hci_cell_reader_plain(const hci_csv *csv, size_t column);

/* What a cell of it is. HCI_ERROR_INPUT for a number whose mark may be decimal or between thousands. */
hci_status hci_cell_read(hci_cell_reader *r, size_t record, hci_number_kind *kind, double *value,
                         hci_note *note);

#endif
