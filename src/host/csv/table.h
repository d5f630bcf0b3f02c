/* A CSV file cut into cells: what csv.c makes and column.c and values.c read columns from. */
#ifndef HCI_SRC_HOST_CSV_TABLE_H
#define HCI_SRC_HOST_CSV_TABLE_H

#include <stdint.h>

#include "hci/host/csv/csv.h"
#include "host/base/number_read.h"
#include "host/base/quote.h"
#include "host/base/unit_lookup.h"

/* A cell that holds no number, or a row that is too short or too long. */
typedef struct {
    size_t line, column;        /* in the file, from 1; from 0 */
    char found[HCI_QUOTE_SIZE]; /* in words or in quotes */
    hci_note error;             /* what is said where the file is refused for it */
    size_t united;              /* cells of the column that were read by a unit of their own */
    size_t united_record;       /* the first of them */
} hci_csv_hole;

/* As what a column is given that is not to be read. */
#define HCI_CSV_LEFT_OUT "none"

/* A column that is what the user says. */
typedef struct {
    char name[32]; /* canonical, with its unit or without */
    size_t column;
    double counts;  /* of a turn, where the column counts them; 0: it does not */
    double divisor; /* of the numbers in the column, for those of the quantity; -1: it is the opposite */
} hci_csv_given;

struct hci_csv {
    char *path;
    char *text;      /* the whole file, each cell cut out in place and ended by a NUL */
    uint32_t *index; /* of each record: its line, then the offset in `text` of each of its cells */
    size_t columns;
    size_t records;    /* header and row of units included */
    bool has_units;    /* record 1 is the row of units */
    bool has_foreword; /* lines before the header were passed over */
    char separator;
    int learned_pole_pairs; /* of what a device has learnt; 0: it was something else */
    const char *map_of;     /* the drive whose map the file was, its word; NULL: it was a table */
    bool leaves_holes;      /* rows that are too short or too long are left out, and counted */
    hci_csv_given *given;
    size_t given_count;
    hci_note decided;            /* what was decided of a column that could mean two things, or "" */
    size_t torn;                 /* rows left out so */
    hci_csv_hole hole;           /* the first of them */
    const double *const *number; /* rows of numbers in memory in place of cells; NULL: text */
    char *shown;                 /* with them: the cell that was asked for last, as text */
    int pole_pairs;              /* that divide mechanical orders; 0: not known */
    bool orders_mechanical;      /* those of a column `order` */
    bool has_angle_offset;       /* the user gives the zero of a recording's angle */
    double angle_offset_rad;     /* electrical, to be added to it */
};

/* Reads the whole of csv->path into csv->text, and makes sure that it is text. HCI_ERROR_INPUT, _MEMORY. */
hci_status hci_csv_load(hci_csv *csv, hci_note *note);

/* Names in record 0 that no header may have. HCI_ERROR_INPUT. */
hci_status hci_csv_check_header(const hci_csv *csv, hci_note *note);

/* "path: found …; remedy". */
hci_status hci_csv_file_error(const char *path, hci_note *note, const char *found, const char *remedy);

/* A cell of a record (0: header), and a record's line in the file. Of numbers in memory a cell is valid until
 * the next one is asked for. */
char *hci_csv_cell(const hci_csv *csv, size_t record, size_t column);
size_t hci_csv_record_line(const hci_csv *csv, size_t record);

/* Do two names of columns differ by no more than case? Names of one letter are as they stand: t is the time,
 * T the torque. */
bool hci_csv_same_name(const char *a, const char *b);

/* The record of data row 0. */
size_t hci_csv_first_record(const hci_csv *csv);

/* Are two records the same in every cell? */
bool hci_csv_same_record(const hci_csv *csv, size_t a, size_t b);

/* The numbers of a column like hci_csv_numbers, NAN where a cell holds none. first: the first such cell, set
 * only where its line is 0 or later in the file; it keeps what it has otherwise. A text in the first row is
 * an error all the same, since it is likely to be a unit. */
hci_status hci_csv_numbers_or_nan(const hci_csv *csv, const char *column, double *values, hci_csv_hole *first,
                                  hci_note *note);

/* A log with one message of a bus in each row, its time and the signals of that message, all other cells
 * empty: HCI_ERROR_INPUT, since no row of it is a sample. HCI_OK for others, among them those of which one
 * column has few values, and for numbers in memory. HCI_ERROR_MEMORY. O(cells). */
hci_status hci_csv_refuse_messages(const hci_csv *csv, hci_note *note);

/* The most frequent separator of a line, outside quotes. */
char hci_csv_separator(const char *line);

/* Where the table begins in the text of a file: at its first line that is neither blank nor a comment, unless
 * that and what follows it cannot be but a foreword: then at the first line of names with rows of as many
 * numbers below it, or, in a text without rows, at its last line if that names columns of recordings.
 * has_foreword: out, whether that is so. */
const char *hci_csv_table_start(const char *text, bool *has_foreword);

/* The line, from 1, at which rows of numbers begin below lines that are no header for them, each of one cell;
 * 0: there are none such. numbers: out, in a row. */
size_t hci_csv_bare_rows(const char *text, size_t *numbers);

/* Is a cell of the row of units one, such as "rad/s" or "(ms)"; NULL: none. */
const hci_unit *hci_csv_cell_unit(const char *cell);

/* Empty, "1" or "-": a cell of a row of units that says nothing. */
bool hci_csv_says_no_unit(const char *cell);

/* The unit that the row of units names for a column; NULL where it says nothing, or nothing that is known. */
const hci_unit *hci_csv_row_unit(const hci_csv *csv, size_t column);

/* The column of an angle that may be mechanical or electrical; false: none. */
bool hci_csv_unclear(const hci_csv *csv, size_t *column);

/* Names the columns that were not used, used[columns], in a remark: one under an unknown name would otherwise
 * be missed in silence. */
void hci_csv_unused(const hci_csv *csv, const bool *used, hci_note *remark);

/* What is wrong with a cell: "file:line: column N `name`: found …, expected …; remedy". */
typedef struct {
    size_t line;      /* in the file, from 1 */
    size_t column;    /* from 0 */
    const char *name; /* of the column; NULL: it has a number only */
    const char *found, *expected, *remedy;
} hci_csv_fault;

/* Puts it into the note. HCI_ERROR_INPUT. */
hci_status hci_csv_fault_note(const hci_csv *csv, const hci_csv_fault *fault, hci_note *note);

/* The same for a cell that is not UTF-8. */
hci_status hci_csv_encoding_error(const hci_csv *csv, size_t line, size_t column, const char *cell,
                                  hci_note *note);

/* How long tables may be whose work grows faster than their rows. */
enum {
    HCI_MOST_ORDERS_LISTED = 10000, /* rows of a spectrum, a set of components, currents */
    HCI_MOST_RUNS_LISTED = 4096     /* recordings of a list */
};

/* HCI_ERROR_INPUT where a table has more rows than `most`; remedy: in words. */
hci_status hci_csv_check_rows(const hci_csv *csv, size_t most, const char *remedy, hci_note *note);

/* The remark on a row of units with a cell that is none. */
#define HCI_CSV_UNIT_EXPECTED "a unit, as in the other cells"
#define HCI_CSV_UNIT_REMEDY   "in a row of units each cell must be a known unit, 1, - or empty"

#endif
