/* A CSV file cut into cells: what csv.c makes and csv_column.c reads columns from. */
#ifndef HCI_SRC_HOST_CSV_TABLE_H
#define HCI_SRC_HOST_CSV_TABLE_H

#include <stdint.h>

#include "hci/host/csv/csv.h"
#include "host/base/number_read.h"
#include "host/base/unit_lookup.h"

struct hci_csv {
    char *path;
    char *text;      /* the whole file, each cell cut out in place and ended by a NUL */
    uint32_t *index; /* of each record: its line, then the offset in `text` of each of its cells */
    size_t columns;
    size_t records;    /* header and row of units included */
    bool has_units;    /* record 1 is the row of units */
    bool has_foreword; /* lines before the header were passed over */
    char separator;
};

/* A cell of a record (0: header), and a record's line in the file. */
char *hci_csv_cell(const hci_csv *csv, size_t record, size_t column);
size_t hci_csv_record_line(const hci_csv *csv, size_t record);

/* Do two names of columns differ by no more than case? Names of one letter are as they stand: t is the time,
 * T the torque. */
bool hci_csv_same_name(const char *a, const char *b);

/* What a cell is as a number, with the decimal marks of this file. */
hci_number_kind hci_csv_kind(const hci_csv *csv, const char *cell);

/* The record of data row 0. */
size_t hci_csv_first_record(const hci_csv *csv);

/* The most frequent separator of a line, outside quotes. */
char hci_csv_separator(const char *line);

/* Where the table begins in the text of a file: at its first line that is neither blank nor a comment, unless
 * that and what follows it cannot be but a foreword: then at the first line of names with rows of as many
 * numbers below it. has_foreword: out, whether that is so. */
const char *hci_csv_table_start(const char *text, bool *has_foreword);

/* Is a cell of the row of units one, such as "rad/s" or "(ms)"; NULL: none. */
const hci_unit *hci_csv_cell_unit(const char *cell);

/* Empty, "1" or "-": a cell of a row of units that says nothing. */
bool hci_csv_says_no_unit(const char *cell);

/* The unit that the row of units names for a column; NULL where it says nothing, or nothing that is known. */
const hci_unit *hci_csv_row_unit(const hci_csv *csv, size_t column);

/* Is a name one of those that a recording has, here or elsewhere? */
bool hci_csv_is_known(const char *name);

/* Tells the columns that were not used, used[columns], in a remark: one under an unknown name would otherwise
 * be missed in silence. */
void hci_csv_unused(const hci_csv *csv, const bool *used, hci_note *remark);

/* "file:line: column N `name`: found …, expected …; remedy". `name` may be NULL. Returns HCI_ERROR_INPUT. */
hci_status hci_csv_cell_error(const hci_csv *csv, size_t line, size_t column, const char *name,
                              hci_note *note, const char *found, const char *expected, const char *remedy);
hci_status hci_csv_encoding_error(const hci_csv *csv, size_t line, size_t column, const char *cell,
                                  hci_note *note);

#endif
