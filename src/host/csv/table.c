/* A table that was read: its cells by record and column, its row of units, and errors that point at a cell.
 */
#include "host/csv/table.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/base/text.h"
#include "host/base/memory.h"
#include "host/base/quote.h"

/* ---- cells ---- */

/* A number in memory as the text of a cell. */
static char *show(const hci_csv *csv, double value)
{
    if (isfinite(value))
        hci_number_text(value, csv->shown);
    else
        strcpy(csv->shown, isnan(value) ? "" : value > 0.0 ? "inf" : "-inf");
    return csv->shown;
}

char *hci_csv_cell(const hci_csv *csv, size_t record, size_t column)
{
    if (csv->number != NULL && record > 0) return show(csv, csv->number[column][record - 1]);
    return csv->text + csv->index[record * (csv->columns + 1) + 1 + column];
}

size_t hci_csv_record_line(const hci_csv *csv, size_t record)
{
    return csv->number != NULL ? record + 1 : csv->index[record * (csv->columns + 1)];
}

static bool is_same_number(double a, double b)
{
    return isnan(a) || isnan(b) ? isnan(a) && isnan(b) : !(fabs(a - b) > 0.0);
}

static bool is_same_cell(const hci_csv *csv, size_t a, size_t b, size_t column)
{
    if (csv->number != NULL) return is_same_number(csv->number[column][a - 1], csv->number[column][b - 1]);
    return strcmp(hci_csv_cell(csv, a, column), hci_csv_cell(csv, b, column)) == 0;
}

bool hci_csv_same_record(const hci_csv *csv, size_t a, size_t b)
{
    for (size_t column = 0; column < csv->columns; ++column)
        if (!is_same_cell(csv, a, b, column)) return false;
    return true;
}

bool hci_csv_same_name(const char *a, const char *b)
{
    return strlen(a) == 1 ? strcmp(a, b) == 0 : hci_text_is(a, b);
}

void hci_csv_free(hci_csv *csv)
{
    if (csv == NULL) return;
    hci_memory_free(csv->path);
    hci_memory_free(csv->text);
    hci_memory_free(csv->index);
    hci_memory_free(csv->given);
    hci_memory_free(csv->shown);
    hci_memory_free(csv);
}

const char *hci_csv_map_of(const hci_csv *csv)
{
    return csv->map_of;
}

int hci_csv_learned_pole_pairs(const hci_csv *csv)
{
    return csv->learned_pole_pairs;
}

const char *hci_csv_path(const hci_csv *csv)
{
    return csv->path;
}

size_t hci_csv_first_record(const hci_csv *csv)
{
    return csv->has_units ? 2 : 1;
}

size_t hci_csv_rows(const hci_csv *csv)
{
    return csv->records - hci_csv_first_record(csv);
}

size_t hci_csv_line(const hci_csv *csv, size_t row)
{
    assert(row < hci_csv_rows(csv));
    return hci_csv_record_line(csv, hci_csv_first_record(csv) + row);
}
size_t hci_csv_header_line(const hci_csv *csv)
{
    return csv->has_foreword ? hci_csv_record_line(csv, 0) : 0;
}

size_t hci_csv_columns(const hci_csv *csv)
{
    return csv->columns;
}

const char *hci_csv_name(const hci_csv *csv, size_t column)
{
    assert(column < csv->columns);
    return hci_csv_cell(csv, 0, column);
}

/* ---- row of units ---- */

/* hh:mm:ss, HH:MM:SS.fff and the like say how the cells are written: clock times are in seconds. */
static bool is_clock_format(const char *text, size_t length)
{
    return memchr(text, ':', length) != NULL && strspn(text, "hHmMsSfFiInNxX0:., ") >= length;
}

const hci_unit *hci_csv_cell_unit(const char *cell)
{
    size_t length = strlen(cell);
    if (length >= 2 &&
        ((cell[0] == '(' && cell[length - 1] == ')') || (cell[0] == '[' && cell[length - 1] == ']')))
        ++cell, length -= 2;
    return is_clock_format(cell, length) ? hci_unit_find("s", 1) : hci_unit_find(cell, length);
}

bool hci_csv_says_no_unit(const char *cell)
{
    return *cell == '\0' || strcmp(cell, "1") == 0 || strcmp(cell, "-") == 0;
}

const hci_unit *hci_csv_row_unit(const hci_csv *csv, size_t column)
{
    if (!csv->has_units) return NULL;
    const char *cell = hci_csv_cell(csv, 1, column);
    return *cell == '\0' || strcmp(cell, "-") == 0 ? NULL : hci_csv_cell_unit(cell);
}

/* ---- messages ---- */

hci_status hci_csv_fault_note(const hci_csv *csv, const hci_csv_fault *fault, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE], quoted[HCI_QUOTE_SIZE];
    return hci_note_set(note, HCI_ERROR_INPUT, "%s:%zu: column %zu%s%s: found %s, expected %s; %s",
                        hci_quote_path(csv->path, path), fault->line, fault->column + 1,
                        fault->name != NULL ? " " : "",
                        fault->name != NULL ? hci_quote(fault->name, quoted) : "", fault->found,
                        fault->expected, fault->remedy);
}

hci_status hci_csv_encoding_error(const hci_csv *csv, size_t line, size_t column, const char *cell,
                                  hci_note *note)
{
    char found[HCI_QUOTE_SIZE];
    const hci_csv_fault fault = {.line = line,
                                 .column = column,
                                 .found = hci_quote(cell, found),
                                 .expected = "text in UTF-8",
                                 .remedy = "save the file as CSV in UTF-8"};
    return hci_csv_fault_note(csv, &fault, note);
}

hci_status hci_csv_check_rows(const hci_csv *csv, size_t most, const char *remedy, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE];
    if (hci_csv_rows(csv) <= most) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT, "%s: found %zu rows, expected at most %zu; %s",
                        hci_quote_path(hci_csv_path(csv), path), hci_csv_rows(csv), most, remedy);
}

/* ---- one message of a bus in each row ---- */

enum { LEAST_ROWS = 20, LEAST_COLUMNS = 3 };

#define LIVES 0.02 /* share of the rows in which a column has a value, if it has any to speak of */
#define WHOLE                                                                                                \
    0.9          /* the same of a column that has one in each row, but for holes: the time is the only one   \
                  */
#define FULL 0.1 /* of the rows, that have all columns */

/* Cells that are not empty, of each column. */
static void count_cells(const hci_csv *csv, size_t *filled)
{
    for (size_t r = hci_csv_first_record(csv); r < csv->records; ++r)
        for (size_t c = 0; c < csv->columns; ++c)
            filled[c] += *hci_csv_cell(csv, r, c) != '\0';
}

/* Rows with a value in each column that lives. */
static size_t full_rows(const hci_csv *csv, const size_t *filled, double rows)
{
    size_t full = 0;
    for (size_t r = hci_csv_first_record(csv); r < csv->records; ++r) {
        bool is_full = true;
        for (size_t c = 0; c < csv->columns && is_full; ++c)
            is_full = (double)filled[c] < LIVES * rows || *hci_csv_cell(csv, r, c) != '\0';
        full += is_full;
    }
    return full;
}

static bool is_of_messages(const hci_csv *csv, const size_t *filled, double rows)
{
    size_t lives = 0, whole = 0;
    for (size_t c = 0; c < csv->columns; ++c) {
        lives += (double)filled[c] >= LIVES * rows;
        whole += (double)filled[c] > WHOLE * rows;
    }
    return lives >= LEAST_COLUMNS && whole <= 1 && (double)full_rows(csv, filled, rows) < FULL * rows;
}

hci_status hci_csv_refuse_messages(const hci_csv *csv, hci_note *note)
{
    const size_t rows = csv->records - hci_csv_first_record(csv);
    if (csv->number != NULL || rows < LEAST_ROWS) return HCI_OK;
    size_t *filled = hci_memory_new(csv->columns, sizeof *filled);
    if (filled == NULL) return hci_note_memory(note, csv->path, "its columns");
    count_cells(csv, filled);
    const bool is_refused = is_of_messages(csv, filled, (double)rows);
    hci_memory_free(filled);
    return is_refused
               ? hci_csv_file_error(csv->path, note,
                                    "found rows with one or a few of the columns each, as where a row is a "
                                    "message of a bus, expected all of them in each row",
                                    "export it again with the last value held in each column, or all signals "
                                    "on one clock")
               : HCI_OK;
}
