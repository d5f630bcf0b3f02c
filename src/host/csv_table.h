/* A CSV file cut into cells: what csv.c makes and csv_column.c reads columns from. */
#ifndef HCI_SRC_HOST_CSV_TABLE_H
#define HCI_SRC_HOST_CSV_TABLE_H

#include <stdint.h>

#include "hci/host/csv.h"
#include "number.h"
#include "unit.h"

struct hci_csv {
    char *path;
    char *text;      /* the whole file, each cell cut out in place and ended by a NUL */
    uint32_t *index; /* of each record: its line, then the offset in `text` of each of its cells */
    size_t columns;
    size_t records; /* header and row of units included */
    bool has_units; /* record 1 is the row of units */
    char separator;
};

/* A cell of a record (0: header), and a record's line in the file. */
char *hci_csv_cell(const hci_csv *csv, size_t record, size_t column);
size_t hci_csv_record_line(const hci_csv *csv, size_t record);

/* What a cell is as a number, with the decimal marks of this file. */
hci_number_kind hci_csv_kind(const hci_csv *csv, const char *cell);

/* The record of data row 0. */
size_t hci_csv_first_record(const hci_csv *csv);

/* The unit that the row of units names for a column; NULL where it says nothing. */
const hci_unit *hci_csv_row_unit(const hci_csv *csv, size_t column);

/* Does `text` begin with these `length` bytes, without regard to case? */
bool hci_text_begins(const char *text, const char *start, size_t length);

/* "file:line: column N `name`: found …, expected …; remedy". `name` may be NULL. Returns HCI_ERROR_INPUT. */
hci_status hci_csv_cell_error(const hci_csv *csv, size_t line, size_t column, const char *name,
                              hci_note *note, const char *found, const char *expected, const char *remedy);
hci_status hci_csv_encoding_error(const hci_csv *csv, size_t line, size_t column, const char *cell,
                                  hci_note *note);

#endif
