/* A mark is known where it can be one thing only: "0.5" has a decimal point, "1.234.567" points between
 * thousands. The first such cell of a column decides for all of it, and what contradicts it is an error.
 * Where every cell could be either, as 1.234, the rest of the file decides. */
#include "host/csv/marks.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/csv/column_name.h"
#include "host/csv/number_cell.h"
#include "host/csv/table.h"

/* Rows of a file in which marks are looked for, where a column does not tell. */
enum { ROWS_LOOKED_AT = 1000 };

/* The decimal mark that a cell shows; 0: it does not. */
static char decimal_of(const char *cell)
{
    const hci_marks marks = hci_marks_of(cell);
    if (marks.decimal != 0) return marks.decimal;
    return marks.group == '.' ? ',' : (char)(marks.group == ',' ? '.' : 0);
}

static bool file_shows(const hci_csv *csv, char decimal)
{
    const size_t first = hci_csv_first_record(csv);
    for (size_t record = first; record < csv->records && record < first + ROWS_LOOKED_AT; ++record)
        for (size_t column = 0; column < csv->columns; ++column)
            if (decimal_of(hci_csv_cell(csv, record, column)) == decimal) return true;
    return false;
}

/* Of a column whose marks could all be either: what the rest of the file does not contradict; 0: not known. A
 * comma needs a file that uses it, or one whose columns the semicolon separates for its sake. */
static char mark_of_file(const hci_csv *csv, char doubtful)
{
    if (file_shows(csv, doubtful == '.' ? ',' : '.')) return 0;
    return doubtful == '.' || csv->separator == ';' || file_shows(csv, ',') ? doubtful : (char)0;
}

static char decimal_mark(const hci_csv *csv, size_t column)
{
    char doubtful = 0;
    if (csv->number != NULL) return '.';
    for (size_t record = hci_csv_first_record(csv); record < csv->records; ++record) {
        const char *cell = hci_csv_cell(csv, record, column);
        const char mark = decimal_of(cell);
        if (mark != 0) return mark;
        if (doubtful == 0) doubtful = hci_marks_of(cell).doubtful;
    }
    return doubtful != 0 ? mark_of_file(csv, doubtful) : '.';
}

hci_cell_reader hci_cell_reader_plain(const hci_csv *csv, size_t column)
{
    return (hci_cell_reader){
        .csv = csv, .column = column, .factor = 1.0, .decimal = decimal_mark(csv, column), .first_day = NAN};
}

/* Does a column of orders count in a mechanical turn? */
static bool is_mechanical(const hci_csv *csv, const hci_column_match *found)
{
    const char *alias = found->alias != NULL ? found->alias->name : "";
    if (strcmp(alias, "electrical_order") == 0) return false;
    return strcmp(alias, "mechanical_order") == 0 || csv->orders_mechanical;
}

hci_cell_reader hci_cell_reader_of(const hci_csv *csv, const char *name, const hci_column_match *found)
{
    const hci_wanted_column want = hci_wanted_column_of(name);
    const hci_unit *second = hci_unit_find("s", 1);
    hci_cell_reader r = hci_cell_reader_plain(csv, found->column);
    r.factor = found->factor;
    if (want.unit->dimension == second->dimension) r.of_second = second->factor / want.unit->factor;
    r.unit = want.unit;
    r.is_order = strcmp(name, "order") == 0;
    if (r.is_order && csv->pole_pairs > 0 && is_mechanical(csv, found)) r.factor /= csv->pole_pairs;
    return r;
}

static bool column_groups_by(const hci_cell_reader *r, char mark)
{
    for (size_t record = hci_csv_first_record(r->csv); record < r->csv->records; ++record)
        if (hci_marks_of(hci_csv_cell(r->csv, record, r->column)).group == mark) return true;
    return false;
}

/* "1.234" among "0,5" is a thousand and some to one reader and 1.234 to the next. */
static hci_status mark_error(const hci_cell_reader *r, size_t record, bool whole_file, hci_note *note)
{
    char found[HCI_QUOTE_SIZE];
    const hci_csv_fault fault = {
        .line = hci_csv_record_line(r->csv, record),
        .column = r->column,
        .name = hci_csv_cell(r->csv, 0, r->column),
        .found = hci_quote(hci_csv_cell(r->csv, record, r->column), found),
        .expected = whole_file
                        ? "one decimal mark in all of the file: this may be a number or a thousand times it"
                        : "one decimal mark in all of the column",
        .remedy = "write no marks between thousands, and the same decimal mark everywhere"};
    return hci_csv_fault_note(r->csv, &fault, note);
}

/* A number with marks that are not plain. */
static hci_status read_marked(const hci_cell_reader *r, size_t record, hci_number_kind *kind, double *value,
                              hci_note *note)
{
    const char *cell = hci_csv_cell(r->csv, record, r->column);
    const hci_marks marks = hci_marks_of(cell);
    const char shown = decimal_of(cell);
    char mark = marks.doubtful;
    if (marks.decimal == 0 && marks.group == 0 && mark == 0) return HCI_OK;
    if (mark != 0 && r->decimal == 0) return mark_error(r, record, true, note);
    if ((shown != 0 && shown != r->decimal) ||
        (mark != 0 && mark != r->decimal && !column_groups_by(r, mark)))
        return mark_error(r, record, false, note);
    if (marks.group != 0 || (mark != 0 && mark != r->decimal)) {
        if (hci_csv_grouped_number(cell, r->decimal, value)) *kind = HCI_NUMBER_FINITE;
    } else {
        *kind = hci_number_read(cell, true, value, &mark);
    }
    return HCI_OK;
}

/* Seconds from the beginning of the day of the first. */
static bool read_clock(hci_cell_reader *r, const char *cell, double *value)
{
    double days, seconds;
    if (!(r->of_second > 0.0) || !hci_csv_clock(cell, &days, &seconds)) return false;
    if (isnan(r->first_day)) r->first_day = days;
    *value = (86400.0 * (days - r->first_day) + seconds) * r->of_second / r->factor;
    return true;
}

#define SAME_UNIT 1e-9 /* of the factor */

/* A number with its unit behind it, "1.001 sec". */
static bool read_with_unit(hci_cell_reader *r, size_t record, const char *cell, double *value)
{
    const hci_unit *unit;
    char mark = 0;
    if (r->unit == NULL || !hci_csv_number_and_unit(cell, value, &mark, &unit)) return false;
    if (unit->dimension != r->unit->dimension || (mark != 0 && mark != r->decimal)) return false;
    *value *= unit->factor / r->unit->factor / r->factor;
    if (fabs(unit->factor / (r->unit->factor * r->factor) - 1.0) > SAME_UNIT && r->united++ == 0)
        r->first_united = record;
    return true;
}

static hci_number_kind read_number(const hci_cell_reader *r, size_t record, double *value)
{
    *value = r->csv->number[r->column][record - 1] * r->factor;
    if (isfinite(*value)) return HCI_NUMBER_FINITE;
    return isnan(*value) ? HCI_NUMBER_NONE : HCI_NUMBER_NOT_FINITE;
}

hci_status hci_cell_read(hci_cell_reader *r, size_t record, hci_number_kind *kind, double *value,
                         hci_note *note)
{
    char mark = 0;
    if (r->csv->number != NULL) {
        *kind = read_number(r, record, value);
        return HCI_OK;
    }
    const char *cell = hci_csv_cell(r->csv, record, r->column);
    *kind = hci_number_read(cell, false, value, &mark);
    if (*kind == HCI_NUMBER_NONE || (mark != 0 && mark != r->decimal)) {
        if (*kind == HCI_NUMBER_FINITE) *kind = HCI_NUMBER_NONE;
        const hci_status status = read_marked(r, record, kind, value, note);
        if (status) return status;
        if (*kind == HCI_NUMBER_NONE &&
            (read_clock(r, cell, value) || read_with_unit(r, record, cell, value) ||
             (r->is_order && hci_csv_fraction(cell, value))))
            *kind = HCI_NUMBER_FINITE;
    }
    if (*kind == HCI_NUMBER_FINITE && !isfinite(*value *= r->factor)) *kind = HCI_NUMBER_NOT_FINITE;
    return HCI_OK;
}
