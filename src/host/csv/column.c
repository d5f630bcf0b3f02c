#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/text.h"
#include "hci/host/base/utf8.h"
#include "hci/host/csv/csv.h"
#include "host/base/number_read.h"
#include "host/base/quote.h"
#include "host/base/unit_lookup.h"
#include "host/csv/alias.h"
#include "host/csv/table.h"

typedef enum {
    MATCH_NONE,
    MATCH_ONE,
    MATCH_TWICE,
    MATCH_OTHER_UNIT,
    MATCH_CONFLICT,
    MATCH_UNKNOWN_UNIT
} match_kind;

typedef struct {
    match_kind kind;
    size_t column;
    double factor;          /* from the file's unit to the unit asked for */
    const hci_alias *alias; /* by which it was found; NULL: by its own name */
    bool has_unit;          /* the file says a unit */
} match;

/* What a column is asked for by: "theta_e_rad" is the base "theta_e" in the unit rad. */
typedef struct {
    const char *base;
    size_t base_length;
    const hci_unit *unit;
} wanted;

static wanted wanted_of(const char *name)
{
    wanted want = {.base = name};
    want.unit = hci_unit_of_name(name, &want.base_length);
    return want;
}

/* The unit that the end of a name gives: "_deg", " (deg)", "[deg]", " / deg", ", deg"; NULL: none. */
static const hci_unit *unit_of_tail(const char *tail)
{
    if (*tail == '_') return hci_unit_of_suffix(tail + 1);
    tail += strspn(tail, " \t");
    if (*tail == '/' || *tail == ',') return hci_csv_cell_unit(tail + 1 + strspn(tail + 1, " \t"));
    return *tail == '(' || *tail == '[' ? hci_csv_cell_unit(tail) : NULL;
}

/* Is `name` the wanted base followed by a unit or by nothing? unit: out, NULL for nothing. */
static bool split_name(const char *name, const wanted *want, const hci_unit **unit)
{
    if (!hci_text_begins(name, want->base, want->base_length)) return false;
    const char *rest = name + want->base_length;
    *unit = NULL;
    if (rest[strspn(rest, " \t")] == '\0') return true;
    *unit = unit_of_tail(rest);
    return *unit != NULL;
}

/* Is `name` the name of an alias, followed by a unit or by nothing? */
static bool split_alias(const char *name, const hci_alias *alias, const hci_unit **unit)
{
    const size_t length = strlen(name);
    *unit = NULL;
    if (hci_alias_is_name(alias, name, length)) return true;
    for (size_t end = 1; end < length; ++end) {
        if (strchr("_([/, ", name[end]) == NULL || !hci_alias_is_name(alias, name, end)) continue;
        *unit = unit_of_tail(name + end);
        if (*unit != NULL) return true;
    }
    return false;
}

/* ---- one column and what is asked for ---- */

/* of_name: the unit that the name gives, or NULL; otherwise: what holds where the file says nothing. */
static match match_units(const hci_csv *csv, size_t column, const wanted *want, const hci_unit *of_name,
                         const hci_unit *otherwise)
{
    match result = {.kind = MATCH_NONE, .column = column, .factor = 1};
    const hci_unit *of_row = hci_csv_row_unit(csv, column);
    const hci_unit *unit = of_name != NULL ? of_name : of_row != NULL ? of_row : otherwise;
    if (of_name != NULL && of_name->dimension != want->unit->dimension) return result;
    result.has_unit = of_name != NULL || of_row != NULL;
    result.factor = unit->factor / want->unit->factor;
    if (of_row == NULL && csv->has_units && !hci_csv_says_no_unit(hci_csv_cell(csv, 1, column)))
        result.kind = MATCH_UNKNOWN_UNIT;
    else if (unit->dimension != want->unit->dimension)
        result.kind = MATCH_OTHER_UNIT;
    else
        result.kind = of_row != NULL && !hci_unit_equal(unit, of_row) ? MATCH_CONFLICT : MATCH_ONE;
    return result;
}

static match match_column(const hci_csv *csv, size_t column, const wanted *want)
{
    const match none = {.kind = MATCH_NONE, .column = column, .factor = 1};
    const hci_unit *of_name;
    return split_name(hci_csv_cell(csv, 0, column), want, &of_name)
               ? match_units(csv, column, want, of_name, want->unit)
               : none;
}

/* A name that has several meanings is what its unit says, so another dimension is no match here. */
static match match_alias(const hci_csv *csv, size_t column, const wanted *want, const hci_alias *alias)
{
    match result = {.kind = MATCH_NONE, .column = column, .factor = 1};
    const hci_unit *of_name;
    if (!split_alias(hci_csv_cell(csv, 0, column), alias, &of_name)) return result;
    if (alias->unit == NULL && of_name == NULL && hci_csv_row_unit(csv, column) == NULL) return result;
    const hci_unit *otherwise =
        alias->unit != NULL ? hci_unit_find(alias->unit, strlen(alias->unit)) : want->unit;
    result = match_units(csv, column, want, of_name, otherwise);
    if (result.kind == MATCH_OTHER_UNIT) result.kind = MATCH_NONE;
    result.alias = alias;
    return result;
}

/* ---- all columns ---- */

/* Is the column's name one that means something else beside another column of this file? */
static bool has_beside(const hci_csv *csv, const hci_alias *alias)
{
    const hci_alias other = {.name = alias->beside};
    const hci_unit *unit;
    for (size_t column = 0; column < csv->columns; column++)
        if (split_alias(hci_csv_cell(csv, 0, column), &other, &unit)) return true;
    return false;
}

static bool means_another(const hci_csv *csv, size_t column, const char *name)
{
    const hci_unit *unit;
    for (size_t k = 0; k < hci_alias_count; k++) {
        const hci_alias *alias = &hci_aliases[k];
        if (alias->beside == NULL || strcmp(alias->column, name) == 0) continue;
        if (split_alias(hci_csv_cell(csv, 0, column), alias, &unit) && has_beside(csv, alias)) return true;
    }
    return false;
}

/* Joins what was found so far with a further column. False: no need to look further. */
static bool add_match(match *result, match next)
{
    if (next.kind == MATCH_NONE || (next.kind == MATCH_OTHER_UNIT && result->kind != MATCH_NONE)) return true;
    const bool twice = result->kind != MATCH_NONE && result->kind != MATCH_OTHER_UNIT;
    *result = next;
    if (twice) result->kind = MATCH_TWICE;
    return !twice;
}

static match find_own(const hci_csv *csv, const char *name, const wanted *want)
{
    match result = {.kind = MATCH_NONE};
    for (size_t column = 0; column < csv->columns; column++) {
        const match next = match_column(csv, column, want);
        if (next.kind == MATCH_NONE || means_another(csv, column, name)) continue;
        if (!add_match(&result, next)) break;
    }
    return result;
}

/* By the names of other tools: those that need another column beside them, or the rest. */
static match find_foreign(const hci_csv *csv, const char *name, const wanted *want, bool beside)
{
    match result = {.kind = MATCH_NONE};
    for (size_t k = 0; k < hci_alias_count; k++) {
        const hci_alias *alias = &hci_aliases[k];
        if (alias->column == NULL || (alias->beside != NULL) != beside || strcmp(alias->column, name) != 0)
            continue;
        if (beside && !has_beside(csv, alias)) continue;
        for (size_t column = 0; column < csv->columns; column++) {
            const match next = match_alias(csv, column, want, alias);
            if (next.kind == MATCH_NONE || (!beside && means_another(csv, column, name))) continue;
            if (!add_match(&result, next)) return result;
        }
    }
    return result;
}

static match find_column(const hci_csv *csv, const char *name)
{
    const wanted want = wanted_of(name);
    match result = find_foreign(csv, name, &want, true);
    if (result.kind == MATCH_NONE) result = find_own(csv, name, &want);
    if (result.kind == MATCH_NONE) result = find_foreign(csv, name, &want, false);
    return result;
}

bool hci_csv_is_known(const char *name)
{
    const hci_unit *unit;
    for (size_t k = 0; k < hci_alias_count; k++) {
        if (hci_aliases[k].column == NULL) continue;
        const wanted want = wanted_of(hci_aliases[k].column);
        if (split_alias(name, &hci_aliases[k], &unit) || split_name(name, &want, &unit)) return true;
    }
    return false;
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

#define UNIT_EXPECTED "a unit, as in the other cells"
#define UNIT_REMEDY   "in a row of units each cell must be a known unit, 1, - or empty"

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
    if (found.kind == MATCH_UNKNOWN_UNIT)
        return hci_csv_cell_error(csv, hci_csv_record_line(csv, 1), found.column, header, note,
                                  hci_quote(hci_csv_cell(csv, 1, found.column), quoted), UNIT_EXPECTED,
                                  UNIT_REMEDY);
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

bool hci_csv_told(const hci_csv *csv, const char *name, hci_note *told)
{
    const match found = find_column(csv, name);
    char quoted[HCI_QUOTE_SIZE];
    if (found.alias == NULL || found.alias->meaning == NULL) return false;
    const bool supposed = !found.has_unit && strcmp(found.alias->unit, "1") != 0;
    hci_note_set(told, HCI_OK, "%s is read as %s%s%s", hci_quote(hci_csv_cell(csv, 0, found.column), quoted),
                 found.alias->meaning, supposed ? ", in " : "", supposed ? found.alias->unit : "");
    return true;
}

hci_status hci_csv_check_clear(const hci_csv *csv, hci_note *note)
{
    const hci_unit *unit;
    for (size_t column = 0; column < csv->columns; column++) {
        const char *name = hci_csv_cell(csv, 0, column);
        for (size_t k = 0; k < hci_alias_count; k++)
            if (hci_aliases[k].column == NULL && split_alias(name, &hci_aliases[k], &unit))
                return hci_csv_cell_error(csv, hci_csv_record_line(csv, 0), column, name, note,
                                          "an angle that may be mechanical or electrical",
                                          "theta_m or theta_e", "rename the column to the one it is");
    }
    return HCI_OK;
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
    const char *expected = "a finite number", *remedy = "write it with a decimal point, e.g. 21.93";
    char found[HCI_QUOTE_SIZE];
    if (kind == HCI_NUMBER_NOT_FINITE) remedy = "remove the line or correct the value";
    if (*hci_csv_cell(csv, record, column) == '\0') remedy = "fill the cell or remove the line";
    size_t odd = column;
    if (record == 1 && is_broken_unit_row(csv, &odd)) {
        column = odd;
        expected = UNIT_EXPECTED;
        remedy = UNIT_REMEDY;
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
