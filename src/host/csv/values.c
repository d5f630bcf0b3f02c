/* Numbers and texts out of the columns of a table, in the unit asked for. */
#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/base/text.h"
#include "hci/host/base/utf8.h"
#include "host/base/number_read.h"
#include "host/base/quote.h"
#include "host/csv/column.h"
#include "host/csv/marks.h"
#include "host/csv/number_cell.h"
#include "host/csv/table.h"

static const char *quote_cell(const char *cell, char out[HCI_QUOTE_SIZE])
{
    return *cell != '\0' ? hci_quote(cell, out) : "an empty cell";
}

/* Does record 1 look like a row of units with one cell that is none? column: out, that cell. */
static bool is_broken_unit_row(const hci_csv *csv, size_t *column)
{
    size_t units = 0, others = 0;
    if (csv->number != NULL) return false;
    for (size_t c = 0; c < csv->columns; c++) {
        const char *cell = hci_csv_cell(csv, 1, c);
        if (hci_csv_says_no_unit(cell)) continue;
        if (hci_csv_is_number(cell)) return false;
        if (hci_csv_cell_unit(cell) != NULL) {
            units++;
        } else {
            others++;
            *column = c;
        }
    }
    return units > 0 && others == 1;
}

static const char *remedy_of(const char *cell, hci_number_kind kind)
{
    double days, value;
    char mark;
    const hci_unit *unit;
    if (*cell == '\0') return "fill the cell or remove the line";
    if (kind == HCI_NUMBER_NOT_FINITE) return "remove the line or correct the value";
    if (*cell == '#') return "a spreadsheet writes this for an error: correct the formula, or empty the cell";
    if (hci_csv_clock(cell, &days, &value)) return "a clock time is read in a column of time only";
    if (hci_csv_fraction(cell, &value)) return "write it as a decimal number; orders only may be fractions";
    if (hci_csv_number_and_unit(cell, &value, &mark, &unit))
        return "write the unit into the column's name, as in torque_mNm, and the number alone";
    return "write a number with a decimal point, e.g. 21.93";
}

/* "; 593 more cells of the column are none, first in lines 3, 4 and 5", or nothing. */
static void tell_others(hci_cell_reader *r, size_t record, char *text, size_t size)
{
    size_t lines[3], count = 0;
    for (size_t k = record + 1; k < r->csv->records; ++k) {
        double value;
        hci_number_kind kind;
        if (hci_cell_read(r, k, &kind, &value, NULL) || kind == HCI_NUMBER_FINITE) continue;
        if (count < 3) lines[count] = hci_csv_record_line(r->csv, k);
        ++count;
    }
    int used = count > 0 ? snprintf(text, size, " (%zu more cell%s of the column %s none: line%s ", count,
                                    count > 1 ? "s" : "", count > 1 ? "are" : "is", count > 1 ? "s" : "")
                         : 0;
    for (size_t k = 0; k < count && k < 3; ++k)
        used += snprintf(text + used, size - (size_t)used, "%s%zu", k > 0 ? ", " : "", lines[k]);
    if (count > 0) snprintf(text + used, size - (size_t)used, "%s)", count > 3 ? ", ..." : "");
}

static hci_status number_error(hci_cell_reader *r, size_t record, hci_number_kind kind, hci_note *note)
{
    const hci_csv *csv = r->csv;
    const char *cell = hci_csv_cell(csv, record, r->column);
    char found[HCI_QUOTE_SIZE], remedy[240], others[120] = "";
    size_t unit = r->column;
    hci_csv_fault fault = {.line = hci_csv_record_line(csv, record), .column = r->column, .remedy = remedy};
    fault.expected = r->of_second > 0.0 ? "a finite number, or a time as 12:00:01.5" : "a finite number";
    if (record == 1 && is_broken_unit_row(csv, &unit)) {
        fault.column = unit;
        fault.expected = HCI_CSV_UNIT_EXPECTED;
        fault.remedy = HCI_CSV_UNIT_REMEDY;
    }
    tell_others(r, record, others, sizeof others);
    snprintf(remedy, sizeof remedy, "%s%s", remedy_of(cell, kind), others);
    fault.name = hci_csv_cell(csv, 0, fault.column);
    fault.found = quote_cell(hci_csv_cell(csv, record, fault.column), found);
    return hci_csv_fault_note(csv, &fault, note);
}

static hci_status read_cells(hci_cell_reader *r, size_t first, size_t count, double *values, hci_note *note)
{
    for (size_t record = first; record < first + count; record++) {
        double value;
        hci_number_kind kind;
        const hci_status status = hci_cell_read(r, record, &kind, &value, note);
        if (status) return status;
        if (kind != HCI_NUMBER_FINITE) return number_error(r, record, kind, note);
        values[record - first] = value;
    }
    return HCI_OK;
}

static hci_status unknown_pole_pairs(const hci_csv *csv, size_t column, hci_note *note)
{
    const hci_csv_fault fault = {.line = hci_csv_record_line(csv, 0),
                                 .column = column,
                                 .name = hci_csv_cell(csv, 0, column),
                                 .found = "orders of a mechanical turn",
                                 .expected = "electrical ones, since no pole pairs are known here",
                                 .remedy = "divide them by the pole pairs and name the column order"};
    return hci_csv_fault_note(csv, &fault, note);
}

hci_status hci_csv_numbers(const hci_csv *csv, const char *column, double *values, hci_note *note)
{
    const hci_column_match found = hci_column_find(csv, column);
    if (found.kind != HCI_COLUMN_ONE) return hci_column_error(csv, column, &found, note);
    if (found.alias != NULL && strcmp(found.alias->name, "mechanical_order") == 0 && csv->pole_pairs == 0)
        return unknown_pole_pairs(csv, found.column, note);
    hci_cell_reader r = hci_cell_reader_of(csv, column, &found);
    return read_cells(&r, hci_csv_first_record(csv), hci_csv_rows(csv), values, note);
}

/* ---- cells without a number ---- */

/* A text in the first row may be a unit that is not known. */
static bool is_hole(const hci_csv *csv, size_t record, const char *cell, hci_number_kind kind)
{
    static const char *const MISSING[] = {"NA", "N/A", "null", "none"};
    if (record > hci_csv_first_record(csv) || *cell == '\0' || *cell == '#' || kind != HCI_NUMBER_NONE)
        return true;
    for (size_t k = 0; k < sizeof MISSING / sizeof *MISSING; ++k)
        if (hci_text_is(cell, MISSING[k])) return true;
    return false;
}

static void note_hole(hci_cell_reader *r, size_t record, hci_number_kind kind, hci_csv_hole *first)
{
    char quoted[HCI_QUOTE_SIZE];
    const size_t line = hci_csv_record_line(r->csv, record);
    if (first->line != 0 && first->line <= line) return;
    *first = (hci_csv_hole){.line = 0};
    first->line = line;
    first->column = r->column;
    snprintf(first->found, sizeof first->found, "%s",
             quote_cell(hci_csv_cell(r->csv, record, r->column), quoted));
    number_error(r, record, kind, &first->error);
}

hci_status hci_csv_numbers_or_nan(const hci_csv *csv, const char *column, double *values, hci_csv_hole *first,
                                  hci_note *note)
{
    const hci_column_match found = hci_column_find(csv, column);
    const size_t from = hci_csv_first_record(csv);
    if (found.kind != HCI_COLUMN_ONE) return hci_column_error(csv, column, &found, note);
    hci_cell_reader r = hci_cell_reader_of(csv, column, &found);
    for (size_t record = from; record < csv->records; record++) {
        double *value = &values[record - from];
        hci_number_kind kind;
        const hci_status status = hci_cell_read(&r, record, &kind, value, note);
        if (status) return status;
        if (kind == HCI_NUMBER_FINITE) continue;
        if (!is_hole(csv, record, hci_csv_cell(csv, record, found.column), kind))
            return number_error(&r, record, kind, note);
        note_hole(&r, record, kind, first);
        *value = NAN;
    }
    first->united = r.united;
    first->united_record = r.first_united;
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
    hci_cell_reader r = hci_cell_reader_of(csv, column, &found);
    return read_cells(&r, hci_csv_first_record(csv) + row, 1, value, note);
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

/* ---- counts ---- */

/* Degrees of a turn; an angle in whole ones goes over no more, and one that is counted on is told apart by
 * nobody but the user. */
#define FULL_TURN 360.0

/* Counts of the smallest encoders. */
#define LEAST_COUNTS 64.0

#define SIXTEEN_BITS 65536.0

bool hci_csv_is_counted(const hci_csv *csv, size_t column, double *of_turn)
{
    double least = DBL_MAX, most = -DBL_MAX;
    *of_turn = hci_csv_is_sixteen_bits(hci_csv_cell(csv, 0, column)) ? SIXTEEN_BITS : 0.0;
    if (*of_turn > 0.0) return true;
    for (size_t k = hci_csv_first_record(csv); k < csv->records; ++k) {
        double value;
        const char *cell = hci_csv_cell(csv, k, column);
        if (*cell == '\0' || *cell == '#' || *cell == 'n' || *cell == 'N') continue; /* a hole */
        if (!hci_number_parse(cell, &value) || value != floor(value)) return false;
        least = fmin(least, value);
        most = fmax(most, value);
    }
    if (!(most - least > 0.0)) return false;
    const double power = exp2(round(log2(most + 1.0)));
    if (least == 0.0 && most + 1.0 == power && power >= LEAST_COUNTS) *of_turn = power;
    return *of_turn > 0.0 || most - least > FULL_TURN;
}

/* Of all counts: a step in which they begin again, and how near a few turns come to their ends. */
#define MOST_OF  0.75
#define NEAR_END 0.02

double hci_csv_counts_that_begin_again(const hci_csv *csv, size_t column)
{
    double least = DBL_MAX, most = 0.0, step = 0.0, before = NAN, value;
    for (size_t k = hci_csv_first_record(csv); k < csv->records; ++k) {
        if (!hci_number_parse(hci_csv_cell(csv, k, column), &value)) continue;
        if (value != floor(value)) return 0.0;
        least = fmin(least, value);
        most = fmax(most, value);
        step = fmax(step, fabs(value - before));
        before = value;
    }
    const double counts = exp2(ceil(log2(most + 1.0)));
    const bool spans = least >= 0.0 && least < NEAR_END * counts && most > (1.0 - NEAR_END) * counts;
    return spans && step > MOST_OF * counts && counts >= LEAST_COUNTS ? counts : 0.0;
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
