/* Numbers and texts out of the columns of a table, in the unit asked for. */
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/text.h"
#include "hci/host/base/utf8.h"
#include "host/base/number_read.h"
#include "host/base/quote.h"
#include "host/csv/column.h"
#include "host/csv/table.h"

static const char *quote_cell(const char *cell, char out[HCI_QUOTE_SIZE])
{
    return *cell != '\0' ? hci_quote(cell, out) : "an empty cell";
}

/* Does record 1 look like a row of units with one cell that is none? column: out, that cell. */
static bool is_broken_unit_row(const hci_csv *csv, size_t *column)
{
    size_t units = 0, others = 0;
    for (size_t c = 0; c < csv->columns; c++) {
        const char *cell = hci_csv_cell(csv, 1, c);
        if (hci_csv_says_no_unit(cell)) continue;
        if (hci_csv_kind(csv, cell) != HCI_NUMBER_NONE) return false;
        if (hci_csv_cell_unit(cell) != NULL) {
            units++;
        } else {
            others++;
            *column = c;
        }
    }
    return units > 0 && others == 1;
}

static hci_status number_error(const hci_csv *csv, size_t record, size_t column, hci_number_kind kind,
                               hci_note *note)
{
    const char *remedy = "write it with a decimal point, e.g. 21.93";
    char found[HCI_QUOTE_SIZE];
    if (kind == HCI_NUMBER_NOT_FINITE) remedy = "remove the line or correct the value";
    if (*hci_csv_cell(csv, record, column) == '\0') remedy = "fill the cell or remove the line";
    hci_csv_fault fault = {.line = hci_csv_record_line(csv, record),
                           .column = column,
                           .expected = "a finite number",
                           .remedy = remedy};
    size_t unit = column;
    if (record == 1 && is_broken_unit_row(csv, &unit)) {
        fault.column = unit;
        fault.expected = HCI_CSV_UNIT_EXPECTED;
        fault.remedy = HCI_CSV_UNIT_REMEDY;
    }
    fault.name = hci_csv_cell(csv, 0, fault.column);
    fault.found = quote_cell(hci_csv_cell(csv, record, fault.column), found);
    return hci_csv_fault_note(csv, &fault, note);
}

/* "1.234" among "0,5" is a thousand and some to one reader and 1.234 to the next. */
static hci_status mark_error(const hci_csv *csv, size_t record, size_t column, hci_note *note)
{
    char found[HCI_QUOTE_SIZE];
    const hci_csv_fault fault = {
        .line = hci_csv_record_line(csv, record),
        .column = column,
        .name = hci_csv_cell(csv, 0, column),
        .found = hci_quote(hci_csv_cell(csv, record, column), found),
        .expected = "one decimal mark in all of the column",
        .remedy = "write no marks between thousands, and the same decimal mark everywhere"};
    return hci_csv_fault_note(csv, &fault, note);
}

/* A column that is read cell by cell, with the decimal mark that it has shown so far. */
typedef struct {
    const hci_csv *csv;
    hci_column_match found;
    char mark;
} column_reader;

/* kind, value: out. HCI_ERROR_INPUT for a second decimal mark. */
static hci_status read_cell(column_reader *r, size_t record, hci_number_kind *kind, double *value,
                            hci_note *note)
{
    char mark = 0;
    const char *cell = hci_csv_cell(r->csv, record, r->found.column);
    *kind = hci_number_read(cell, r->csv->separator == ';', value, &mark);
    if (*kind != HCI_NUMBER_FINITE) return HCI_OK;
    if (!isfinite(*value *= r->found.factor)) *kind = HCI_NUMBER_NOT_FINITE;
    if (mark != 0 && r->mark != 0 && mark != r->mark)
        return mark_error(r->csv, record, r->found.column, note);
    if (mark != 0) r->mark = mark;
    return HCI_OK;
}

static hci_status read_cells(const hci_csv *csv, hci_column_match found, size_t first, size_t count,
                             double *values, hci_note *note)
{
    column_reader r = {.csv = csv, .found = found};
    for (size_t record = first; record < first + count; record++) {
        double value;
        hci_number_kind kind;
        const hci_status status = read_cell(&r, record, &kind, &value, note);
        if (kind != HCI_NUMBER_FINITE) return number_error(csv, record, found.column, kind, note);
        if (status) return status;
        values[record - first] = value;
    }
    return HCI_OK;
}

hci_status hci_csv_numbers(const hci_csv *csv, const char *column, double *values, hci_note *note)
{
    const hci_column_match found = hci_column_find(csv, column);
    if (found.kind != HCI_COLUMN_ONE) return hci_column_error(csv, column, &found, note);
    return read_cells(csv, found, hci_csv_first_record(csv), hci_csv_rows(csv), values, note);
}

/* ---- cells without a number ---- */

/* A text in the first row may be a unit that is not known. */
static bool is_hole(const hci_csv *csv, size_t record, const char *cell, hci_number_kind kind)
{
    static const char *const MISSING[] = {"NA", "N/A", "#N/A", "null", "none"};
    if (record > hci_csv_first_record(csv) || *cell == '\0' || kind != HCI_NUMBER_NONE) return true;
    for (size_t k = 0; k < sizeof MISSING / sizeof *MISSING; ++k)
        if (hci_text_is(cell, MISSING[k])) return true;
    return false;
}

static void note_hole(const hci_csv *csv, size_t record, size_t column, hci_number_kind kind,
                      hci_csv_hole *first)
{
    char quoted[HCI_QUOTE_SIZE];
    const size_t line = hci_csv_record_line(csv, record);
    if (first->line != 0 && first->line <= line) return;
    memset(first, 0, sizeof *first);
    first->line = line;
    first->column = column;
    snprintf(first->found, sizeof first->found, "%s", quote_cell(hci_csv_cell(csv, record, column), quoted));
    number_error(csv, record, column, kind, &first->error);
}

hci_status hci_csv_numbers_or_nan(const hci_csv *csv, const char *column, double *values, hci_csv_hole *first,
                                  hci_note *note)
{
    column_reader r = {.csv = csv, .found = hci_column_find(csv, column)};
    const size_t from = hci_csv_first_record(csv), at = r.found.column;
    if (r.found.kind != HCI_COLUMN_ONE) return hci_column_error(csv, column, &r.found, note);
    for (size_t record = from; record < csv->records; record++) {
        double *value = &values[record - from];
        hci_number_kind kind;
        const hci_status status = read_cell(&r, record, &kind, value, note);
        if (status) return status;
        if (kind == HCI_NUMBER_FINITE) continue;
        if (!is_hole(csv, record, hci_csv_cell(csv, record, at), kind))
            return number_error(csv, record, at, kind, note);
        note_hole(csv, record, at, kind, first);
        *value = NAN;
    }
    return HCI_OK;
}

/* ---- one cell ---- */

hci_status hci_csv_number(const hci_csv *csv, const char *column, size_t row, double *value, hci_note *note)
{
    assert(row < hci_csv_rows(csv));
    hci_column_match found = hci_column_find(csv, column);
    if (found.kind == HCI_COLUMN_NONE || found.kind == HCI_COLUMN_TWICE)
        return hci_column_error(csv, column, &found, note);
    found.factor = 1;
    return read_cells(csv, found, hci_csv_first_record(csv) + row, 1, value, note);
}

hci_status hci_csv_text(const hci_csv *csv, const char *column, size_t row, const char **text, hci_note *note)
{
    assert(row < hci_csv_rows(csv));
    const hci_column_match found = hci_column_find(csv, column);
    if (found.kind == HCI_COLUMN_NONE || found.kind == HCI_COLUMN_TWICE)
        return hci_column_error(csv, column, &found, note);
    const char *cell = hci_csv_cell(csv, hci_csv_first_record(csv) + row, found.column);
    if (!hci_utf8_valid(cell))
        return hci_csv_encoding_error(csv, hci_csv_line(csv, row), found.column, cell, note);
    *text = cell;
    return HCI_OK;
}

hci_status hci_csv_error(const hci_csv *csv, const char *column, size_t row, hci_note *note,
                         const char *expected, const char *remedy)
{
    assert(row < hci_csv_rows(csv));
    const hci_column_match found = hci_column_find(csv, column);
    if (found.kind == HCI_COLUMN_NONE) return hci_column_error(csv, column, &found, note);
    char quoted[HCI_QUOTE_SIZE];
    const char *cell = hci_csv_cell(csv, hci_csv_first_record(csv) + row, found.column);
    const hci_csv_fault fault = {.line = hci_csv_line(csv, row),
                                 .column = found.column,
                                 .name = hci_csv_cell(csv, 0, found.column),
                                 .found = quote_cell(cell, quoted),
                                 .expected = expected,
                                 .remedy = remedy};
    return hci_csv_fault_note(csv, &fault, note);
}

void hci_csv_unused(const hci_csv *csv, const bool *used, hci_note *remark)
{
    char list[300] = "";
    size_t length = 0;
    for (size_t column = 0; column < hci_csv_columns(csv) && length < sizeof list; ++column) {
        char quoted[HCI_QUOTE_SIZE];
        const char *name = hci_csv_name(csv, column);
        if (used[column] || *name == '\0') continue;
        length += (size_t)snprintf(list + length, sizeof list - length, "%s%s", length > 0 ? ", " : "",
                                   hci_quote(name, quoted));
    }
    if (length >= sizeof list) memcpy(list + sizeof list - 4, "...", 4);
    if (length > 0) hci_note_add(remark, "columns not used: %s", list);
}
