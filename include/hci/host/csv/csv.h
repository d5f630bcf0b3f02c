/* CSV as users and their tools have it: comma, semicolon or tab, LF or CRLF, BOM, comment lines, lines before
 * the header, quoted fields, a row of units. */
#ifndef HCI_HOST_CSV_CSV_H
#define HCI_HOST_CSV_CSV_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/base/note.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A table that has been read. */
typedef struct hci_csv hci_csv;

/* Reads a whole file. On success *csv is to be given to hci_csv_free; on failure it is NULL and the note
 * names file, line, column, what was found, what was expected and the remedy. HCI_ERROR_INPUT or
 * HCI_ERROR_MEMORY. */
hci_status hci_csv_read(const char *path, hci_csv **csv, hci_note *note);

/* The same of a recording: rows that are too short or too long are left out, and so are NUL bytes at the end,
 * which a power failure leaves. HCI_ERROR_INPUT where that would be more than half of the rows. */
hci_status hci_csv_read_recording(const char *path, hci_csv **csv, hci_note *note);

/* A table of numbers that is in memory already, so that no file is on the way. */
typedef struct {
    const char *name;           /* stands for a path: by which it is asked for, and in messages */
    const char *const *column;  /* names as a header has them, each once */
    const double *const *value; /* `rows` numbers of each column; NAN: an empty cell. Not copied */
    size_t columns, rows;       /* entries of column and of value; of each of these */
} hci_csv_memory;

/* The same as if it had been read from a file with the header in its line 1. from: kept as long as
 * *csv, which is to be given to hci_csv_free. HCI_ERROR_INPUT for names that no header may have,
 * _MEMORY. O(columns²). */
hci_status hci_csv_of_memory(const hci_csv_memory *from, hci_csv **csv, hci_note *note);

/* Frees a table; NULL is fine. */
void hci_csv_free(hci_csv *csv);

/* The path that it was read from; owned by csv. */
const char *hci_csv_path(const hci_csv *csv);

/* The drive whose compensation map the file was, which has been read as the recording that it stands for: a
 * word such as "moteus", or NULL. */
const char *hci_csv_map_of(const hci_csv *csv);

/* The pole pairs in what a device has learnt (hci/learn.h), which has been read as a recording; 0 for any
 * other file. */
int hci_csv_learned_pole_pairs(const hci_csv *csv);

/* Rows of data: without the header, the row of units and comments. */
size_t hci_csv_rows(const hci_csv *csv);

/* Line in the file (from 1) of data row `row`, for messages. */
size_t hci_csv_line(const hci_csv *csv, size_t row);

/* A column is asked for by its canonical name with its unit suffix ("theta_e_rad"). A file may have it in any
 * unit of the same dimension ("theta_e_deg", or "theta_e" with `deg` in the row of units) and without regard
 * to case; values come back in the unit asked for. A column without any unit is taken to be in the unit asked
 * for. */
bool hci_csv_has(const hci_csv *csv, const char *column);

/* Says which column a canonical name stands for, whatever the header says; the last word counts. name:
 * shorter than 32 bytes; its unit, where it has one, is that of the column, whatever the file says.
 * HCI_ERROR_MEMORY. */
hci_status hci_csv_give(hci_csv *csv, const char *name, size_t column, hci_note *note);

/* The same of an angle that an encoder counts: `counts` in a turn. */
hci_status hci_csv_give_counts(hci_csv *csv, const char *name, size_t column, double counts, hci_note *note);

/* Is a column, by its name, an encoder's counts? */
bool hci_csv_counts(const char *name);

/* Does it say that its numbers are the 16 bits of a firmware ("s16degree", "int16"), of whatever quantity: a
 * turn is then 65536 of them, and what an ampere is the firmware knows alone? */
bool hci_csv_is_sixteen_bits(const char *name);

/* Is it by its numbers, or by those 16 bits: whole ones that go over more than 360, or from 0 to the last
 * before a power of two? of_turn: out, that power; 0: not told. O(rows). */
bool hci_csv_is_counted(const hci_csv *csv, size_t column, double *of_turn);
/* The counts of a turn, a power of two, where whole numbers go from near 0 to near it and begin again; 0:
 * they do not. O(rows). */
double hci_csv_counts_that_begin_again(const hci_csv *csv, size_t column);

/* What a column `order` counts periods of. */
typedef enum { HCI_ORDER_ELECTRICAL, HCI_ORDER_MECHANICAL } hci_order_base;

/* What the orders of a table count: a column `mechanical_order`, and where base is mechanical a column
 * `order`, periods of a mechanical turn, which `pole_pairs` divides on reading. Before it, `order` is
 * electrical and `mechanical_order` refused. */
void hci_csv_orders_of(hci_csv *csv, int pole_pairs, hci_order_base base);

/* How many columns the file has. */
size_t hci_csv_columns(const hci_csv *csv);

/* The name of a column as it stands in the header, "" where it has none; owned by csv. */
const char *hci_csv_name(const hci_csv *csv, size_t column);

/* Which column of the file hci_csv_numbers takes for a canonical name, or complains of; false: none. A column
 * that goes by the name of another tool ("erpm", "d_axis_current") is taken where none has the canonical
 * name; docs/files.md lists these names. */
bool hci_csv_find(const hci_csv *csv, const char *name, size_t *column);

/* What was supposed of the column that is taken for a canonical name, where its name in the file could mean
 * something else ("`erpm` is read as …"). told: out, start with {0}; false: nothing. */
bool hci_csv_told(const hci_csv *csv, const char *name, hci_note *told);

/* HCI_ERROR_INPUT for a column such as `theta`, which may be a mechanical or an electrical angle. */
hci_status hci_csv_check_clear(const hci_csv *csv, hci_note *note);

/* Line of the header in the file, where lines before it were passed over; 0: there were none. */
size_t hci_csv_header_line(const hci_csv *csv);

/* The numbers of a column into values[hci_csv_rows]. Missing column, or text that is not a finite number:
 * HCI_ERROR_INPUT, and values is undefined. */
hci_status hci_csv_numbers(const hci_csv *csv, const char *column, double *values, hci_note *note);

/* The number in one cell, as it stands (no unit conversion). Not a finite number: HCI_ERROR_INPUT. */
hci_status hci_csv_number(const hci_csv *csv, const char *column, size_t row, double *value, hci_note *note);

/* One cell as text with quotes removed and blanks trimmed; owned by csv. Missing column: HCI_ERROR_INPUT. */
hci_status hci_csv_text(const hci_csv *csv, const char *column, size_t row, const char **text,
                        hci_note *note);

/* An error at a cell: "file:line: column `name`: found `text`, expected ...; remedy". Returns
 * HCI_ERROR_INPUT. */
hci_status hci_csv_error(const hci_csv *csv, const char *column, size_t row, hci_note *note,
                         const char *expected, const char *remedy);

#ifdef __cplusplus
}
#endif

#endif
