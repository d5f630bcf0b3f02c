#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "csv_table.h"
#include "hci/host/csv.h"
#include "quote.h"

typedef enum { MATCH_NONE, MATCH_ONE, MATCH_TWICE, MATCH_OTHER_UNIT, MATCH_CONFLICT } match_kind;

typedef struct {
    match_kind kind;
    size_t column;
    double factor; /* from the file's unit to the unit asked for */
} match;

/* What a column is asked for by: "theta_e_rad" is the base "theta_e" in the unit rad. */
typedef struct {
    const char *base;
    size_t base_length;
    const hci_unit *unit;
} wanted;

/* Is `name` the wanted base followed by a unit ("_deg", " (deg)", "[deg]") or by nothing? unit: out, NULL for
 * nothing. */
static bool split_name(const char *name, const wanted *want, const hci_unit **unit)
{
    if (!hci_text_begins(name, want->base, want->base_length)) return false;
    const char *rest = name + want->base_length;
    *unit = NULL;
    if (*rest == '_') {
        *unit = hci_unit_of_suffix(rest + 1);
        return *unit != NULL;
    }
    rest += strspn(rest, " \t");
    if (*rest == '\0') return true;
    const size_t length = strlen(rest);
    const char close = rest[length - 1];
    if (length < 2 || !((*rest == '(' && close == ')') || (*rest == '[' && close == ']'))) return false;
    *unit = hci_unit_find(rest + 1, length - 2);
    return *unit != NULL;
}

static match match_column(const hci_csv *csv, size_t column, const wanted *want)
{
    match result = {.kind = MATCH_NONE, .column = column, .factor = 1};
    const hci_unit *of_name, *of_row = hci_csv_row_unit(csv, column);
    if (!split_name(hci_csv_cell(csv, 0, column), want, &of_name)) return result;
    if (of_name != NULL && of_name->dimension != want->unit->dimension) return result;
    const hci_unit *unit = of_name != NULL ? of_name : of_row != NULL ? of_row : want->unit;
    result.factor = unit->factor / want->unit->factor;
    if (unit->dimension != want->unit->dimension) {
        result.kind = MATCH_OTHER_UNIT;
    } else {
        result.kind = of_row != NULL && !hci_unit_equal(unit, of_row) ? MATCH_CONFLICT : MATCH_ONE;
    }
    return result;
}

static match find_column(const hci_csv *csv, const char *name)
{
    wanted want = {.base = name};
    match result = {.kind = MATCH_NONE};
    want.unit = hci_unit_of_name(name, &want.base_length);
    for (size_t column = 0; column < csv->columns; column++) {
        const match next = match_column(csv, column, &want);
        if (next.kind == MATCH_NONE || (next.kind == MATCH_OTHER_UNIT && result.kind != MATCH_NONE)) continue;
        const bool twice = result.kind == MATCH_ONE || result.kind == MATCH_CONFLICT;
        result = next;
        if (twice) {
            result.kind = MATCH_TWICE;
            break;
        }
    }
    return result;
}

/* "`a`, `b`, …" as far as there is room. Columns without a name are left out. */
static void list_columns(const hci_csv *csv, char *out, size_t size)
{
    static const char more[] = ", \xE2\x80\xA6";
    size_t used = 0;
    for (size_t column = 0; column < csv->columns; column++) {
        char quoted[HCI_QUOTE_SIZE];
        const char *name = hci_quote(hci_csv_cell(csv, 0, column), quoted), *between = used > 0 ? ", " : "";
        if (*hci_csv_cell(csv, 0, column) == '\0') continue;
        if (used + strlen(between) + strlen(name) + sizeof more > size) {
            memcpy(out + used, more, sizeof more);
            return;
        }
        used += (size_t)snprintf(out + used, size - used, "%s%s", between, name);
    }
}

static hci_status missing_column(const hci_csv *csv, const char *name, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE], quoted[HCI_QUOTE_SIZE], columns[400];
    list_columns(csv, columns, sizeof columns);
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%s:%zu: found no column %s but %s, expected it in the header; add it or rename a column",
        hci_quote_path(csv->path, path), hci_csv_record_line(csv, 0), hci_quote(name, quoted), columns);
}

/* The error of a column that is there but cannot be used. */
static hci_status match_error(const hci_csv *csv, const char *name, match found, hci_note *note)
{
    char quoted[HCI_QUOTE_SIZE], text[HCI_QUOTE_SIZE + 32];
    const char *header = hci_csv_cell(csv, 0, found.column);
    if (found.kind == MATCH_TWICE) {
        snprintf(text, sizeof text, "%s a second time", hci_quote(name, quoted));
        return hci_csv_cell_error(csv, hci_csv_record_line(csv, 0), found.column, header, note, text,
                                  "one column for it", "remove or rename one of them");
    }
    snprintf(text, sizeof text, "the unit %s", hci_quote(hci_csv_cell(csv, 1, found.column), quoted));
    return hci_csv_cell_error(csv, hci_csv_record_line(csv, 1), found.column, header, note, text,
                              found.kind == MATCH_CONFLICT ? "the unit in the column's name"
                                                           : "a unit of the quantity asked for",
                              "correct the unit");
}

bool hci_csv_has(const hci_csv *csv, const char *column)
{
    const match_kind kind = find_column(csv, column).kind;
    return kind != MATCH_NONE && kind != MATCH_OTHER_UNIT;
}

bool hci_csv_find(const hci_csv *csv, const char *name, size_t *column)
{
    const match found = find_column(csv, name);
    *column = found.column;
    return found.kind != MATCH_NONE;
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
        if (*cell == '\0' || strcmp(cell, "1") == 0 || strcmp(cell, "-") == 0) continue;
        if (hci_csv_kind(csv, cell) != HCI_NUMBER_NONE) return false;
        if (hci_unit_find(cell, strlen(cell)) != NULL) {
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
    const char *expected = "a finite number", *remedy = "write it with a decimal point, e.g. 21.93";
    char found[HCI_QUOTE_SIZE];
    if (kind == HCI_NUMBER_NOT_FINITE) remedy = "remove the line or correct the value";
    if (*hci_csv_cell(csv, record, column) == '\0') remedy = "fill the cell or remove the line";
    size_t odd = column;
    if (record == 1 && is_broken_unit_row(csv, &odd)) {
        column = odd;
        expected = "a unit, as in the other cells";
        remedy = "in a row of units each cell must be a known unit, 1, - or empty";
    }
    return hci_csv_cell_error(csv, hci_csv_record_line(csv, record), column, hci_csv_cell(csv, 0, column),
                              note, quote_cell(hci_csv_cell(csv, record, column), found), expected, remedy);
}

/* "1.234" among "0,5" is a thousand and some to one reader and 1.234 to the next. */
static hci_status mark_error(const hci_csv *csv, size_t record, size_t column, hci_note *note)
{
    char found[HCI_QUOTE_SIZE];
    return hci_csv_cell_error(csv, hci_csv_record_line(csv, record), column, hci_csv_cell(csv, 0, column),
                              note, hci_quote(hci_csv_cell(csv, record, column), found),
                              "one decimal mark in all of the column",
                              "write no marks between thousands, and the same decimal mark everywhere");
}

static hci_status read_cells(const hci_csv *csv, match found, size_t first, size_t count, double *values,
                             hci_note *note)
{
    const bool comma = csv->separator == ';';
    char column_mark = 0, mark;
    for (size_t record = first; record < first + count; record++) {
        double value;
        hci_number_kind kind = hci_number_read(hci_csv_cell(csv, record, found.column), comma, &value, &mark);
        if (kind == HCI_NUMBER_FINITE && !isfinite(value *= found.factor)) kind = HCI_NUMBER_NOT_FINITE;
        if (kind != HCI_NUMBER_FINITE) return number_error(csv, record, found.column, kind, note);
        if (mark != 0 && column_mark != 0 && mark != column_mark)
            return mark_error(csv, record, found.column, note);
        if (mark != 0) column_mark = mark;
        values[record - first] = value;
    }
    return HCI_OK;
}

hci_status hci_csv_numbers(const hci_csv *csv, const char *column, double *values, hci_note *note)
{
    const match found = find_column(csv, column);
    if (found.kind == MATCH_NONE) return missing_column(csv, column, note);
    if (found.kind != MATCH_ONE) return match_error(csv, column, found, note);
    return read_cells(csv, found, hci_csv_first_record(csv), hci_csv_rows(csv), values, note);
}

hci_status hci_csv_number(const hci_csv *csv, const char *column, size_t row, double *value, hci_note *note)
{
    assert(row < hci_csv_rows(csv));
    match found = find_column(csv, column);
    if (found.kind == MATCH_NONE) return missing_column(csv, column, note);
    if (found.kind == MATCH_TWICE) return match_error(csv, column, found, note);
    found.factor = 1;
    return read_cells(csv, found, hci_csv_first_record(csv) + row, 1, value, note);
}

hci_status hci_csv_text(const hci_csv *csv, const char *column, size_t row, const char **text, hci_note *note)
{
    assert(row < hci_csv_rows(csv));
    const match found = find_column(csv, column);
    if (found.kind == MATCH_NONE) return missing_column(csv, column, note);
    if (found.kind == MATCH_TWICE) return match_error(csv, column, found, note);
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
    const match found = find_column(csv, column);
    if (found.kind == MATCH_NONE) return missing_column(csv, column, note);
    const char *cell = hci_csv_cell(csv, hci_csv_first_record(csv) + row, found.column);
    char quoted[HCI_QUOTE_SIZE];
    return hci_csv_cell_error(csv, hci_csv_line(csv, row), found.column, hci_csv_cell(csv, 0, found.column),
                              note, quote_cell(cell, quoted), expected, remedy);
}
