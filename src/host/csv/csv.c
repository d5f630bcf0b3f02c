/* A file of text cut into records and cells, and which line of it is the header and which the row of units.
 */
#include "hci/host/csv/csv.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/text.h"
#include "hci/host/base/utf8.h"
#include "host/base/memory.h"
#include "host/base/number_read.h"
#include "host/base/quote.h"
#include "host/base/unit_lookup.h"
#include "host/csv/blanks.h"
#include "host/csv/number_cell.h"
#include "host/csv/table.h"
#include "host/csv/twincat.h"
#include "host/foreign/as_recording.h"

enum { COLUMNS_MAX = 4096 };

typedef struct {
    hci_csv *csv;
    hci_note *note;
    char *next;    /* first byte not yet read; the text ends with a NUL */
    uint32_t line; /* of `next` */
    size_t used, capacity;
    const char *surplus; /* a cell beyond the last column that is not empty */
    bool stop[256];      /* bytes that end a cell without quotes */
} reader;

/* ---- cutting it into records and cells ---- */

static bool is_blank(char c, char separator)
{
    return c == ' ' || (c == '\t' && separator != '\t');
}

static char *skip_blanks(char *at, char separator)
{
    while (is_blank(*at, separator))
        at++;
    return at;
}

/* Past one LF, CRLF or CR, if there is one. */
static void skip_newline(reader *r)
{
    if (*r->next != '\n' && *r->next != '\r') return;
    r->next += r->next[0] == '\r' && r->next[1] == '\n' ? 2 : 1;
    r->line++;
}

/* Moves to the next line that is neither blank nor a comment; false at the end of the file. */
static bool find_record(reader *r)
{
    for (;;) {
        char *at = skip_blanks(r->next, r->csv->separator);
        if (*at == '#') at += strcspn(at, "\r\n");
        if (*at != '\n' && *at != '\r' && *at != '\0') return true;
        r->next = at;
        if (*at == '\0') return false;
        skip_newline(r);
    }
}

static void set_separator(reader *r)
{
    r->csv->separator = hci_csv_separator(r->next);
    r->stop[(unsigned char)r->csv->separator] = true;
    r->stop['\n'] = r->stop['\r'] = r->stop[0] = true;
}

/* Takes the quotes off a cell at *at = '"' (RFC 4180: "" is one "). start, end: out. Leaves *at after the
 * closing quote; false where there is none. */
static bool unquote(reader *r, char **at, char **start, char **end)
{
    char *from = *at + 1, *to = from;
    *start = from;
    for (; *from != '\0'; from++) {
        if (*from == '"' && *++from != '"') {
            *at = from;
            *end = to;
            return true;
        }
        if (*from == '\n' || (*from == '\r' && from[1] != '\n')) r->line++;
        *to++ = *from;
    }
    return false;
}

static hci_status quote_error(const reader *r, size_t line, size_t column, bool is_closed)
{
    hci_csv_fault fault = {.line = line, .column = column};
    fault.found = is_closed ? "text after a closing quote" : "an opening quote only";
    fault.expected = is_closed ? "a separator or the end of the line" : "a closing quote";
    fault.remedy = is_closed ? "write a quote inside of quotes twice"
                             : "close the quotes, and write a quote inside of them twice";
    return hci_csv_fault_note(r->csv, &fault, r->note);
}

/* One cell. On return r->next is at its separator, its newline or the end, with that byte in *stop. */
static hci_status read_cell(reader *r, size_t column, char **cell, char *stop)
{
    const char separator = r->csv->separator;
    const size_t line = r->line;
    char *start = skip_blanks(r->next, separator), *at = start, *end;
    if (*at == '"') {
        if (!unquote(r, &at, &start, &end)) {
            return quote_error(r, line, column, false);
        }
        at = skip_blanks(at, separator);
        if (!r->stop[(unsigned char)*at]) {
            return quote_error(r, r->line, column, true);
        }
    } else {
        while (!r->stop[(unsigned char)*at])
            at++;
        end = at;
    }
    while (start < end && is_blank(*start, '\0'))
        start++;
    while (end > start && is_blank(end[-1], '\0'))
        end--;
    *stop = *at;
    *end = '\0';
    *cell = start;
    r->next = at;
    return HCI_OK;
}

static hci_status push(reader *r, uint32_t value)
{
    if (r->used == r->capacity) {
        const size_t capacity = 2 * r->capacity + 64;
        uint32_t *larger = hci_memory_resize(r->csv->index, capacity, sizeof *larger);
        if (larger == NULL) return hci_note_memory(r->note, r->csv->path, "reading it");
        r->csv->index = larger;
        r->capacity = capacity;
    }
    r->csv->index[r->used++] = value;
    return HCI_OK;
}

/* Reads a record of at most `columns` cells into the index; empty cells beyond are let go.
 * count: out, cells read; filled: out, number of the last cell that is not empty, from 1. */
static hci_status read_record(reader *r, size_t columns, size_t *count, size_t *filled)
{
    hci_status status = push(r, r->line);
    char *cell = NULL, stop = r->csv->separator;
    *filled = 0;
    r->surplus = NULL;
    for (*count = 0; !status && stop == r->csv->separator; ++*count) {
        status = read_cell(r, *count, &cell, &stop);
        if (status) return status;
        if (*cell != '\0') *filled = *count + 1;
        if (*filled > columns && r->surplus == NULL) r->surplus = cell;
        if (r->surplus != NULL && !r->csv->leaves_holes) return HCI_OK;
        if (*count < columns) status = push(r, (uint32_t)(cell - r->csv->text));
        if (stop == r->csv->separator) r->next++;
    }
    /* The stop byte may have been overwritten by the end of the cell. */
    if (stop != '\0') {
        r->next += stop == '\r' && r->next[1] == '\n' ? 2 : 1;
        r->line++;
    }
    return status;
}

/* ---- header ---- */

static hci_status check_name(const hci_csv *csv, size_t column, hci_note *note)
{
    const char *name = hci_csv_cell(csv, 0, column);
    const size_t line = hci_csv_record_line(csv, 0);
    if (!hci_utf8_valid(name)) return hci_csv_encoding_error(csv, line, column, name, note);
    for (size_t i = 0; i < column && *name != '\0'; i++) {
        const char *other = hci_csv_cell(csv, 0, i);
        if (!hci_csv_same_name(other, name)) continue;
        char found[64];
        snprintf(found, sizeof found, "the name of column %zu again", i + 1);
        const hci_csv_fault fault = {.line = line,
                                     .column = column,
                                     .name = name,
                                     .found = found,
                                     .expected = "each name once",
                                     .remedy = "rename or remove one of them"};
        return hci_csv_fault_note(csv, &fault, note);
    }
    return HCI_OK;
}

/* Rows without a header. */
static hci_status no_names(const hci_csv *csv, hci_note *note)
{
    char found[HCI_QUOTE_SIZE];
    const size_t last = csv->columns - 1;
    const hci_csv_fault fault = {.line = hci_csv_record_line(csv, 0),
                                 .column = last,
                                 .found = hci_quote(hci_csv_cell(csv, 0, last), found),
                                 .expected = "a column name",
                                 .remedy = "put a row of column names first"};
    return hci_csv_fault_note(csv, &fault, note);
}

hci_status hci_csv_check_header(const hci_csv *csv, hci_note *note)
{
    size_t numbers = 0;
    hci_status status = HCI_OK;
    for (size_t column = 0; column < csv->columns; column++) {
        const char *name = hci_csv_cell(csv, 0, column);
        numbers += *name == '\0' || hci_csv_is_number(name);
    }
    if (numbers == csv->columns) return no_names(csv, note);
    for (size_t column = 0; column < csv->columns && !status; column++)
        status = check_name(csv, column, note);
    return status;
}

/* To the line that the table begins with. */
static void pass_foreword(reader *r)
{
    const char *start = hci_csv_table_start(r->next, &r->csv->has_foreword);
    while (r->csv->has_foreword && r->next < start) {
        r->next += strcspn(r->next, "\r\n");
        skip_newline(r);
    }
}

static hci_status wide_header(const reader *r)
{
    const hci_csv_fault fault = {.line = r->csv->index[0],
                                 .column = COLUMNS_MAX,
                                 .found = "another column",
                                 .expected = "4096 columns at most",
                                 .remedy = "remove those that are not needed"};
    return hci_csv_fault_note(r->csv, &fault, r->note);
}

static hci_status read_header(reader *r)
{
    hci_csv *csv = r->csv;
    size_t count, filled = 0;
    while (filled == 0) {
        csv->separator = '\0';
        memset(r->stop, 0, sizeof r->stop);
        r->used = 0;
        if (!find_record(r)) {
            return hci_csv_file_error(csv->path, r->note,
                                      "found no line of text, expected a header row of column names",
                                      "write the names in the first line");
        }
        set_separator(r);
        const hci_status status = read_record(r, COLUMNS_MAX, &count, &filled);
        if (status) return status;
    }
    if (filled > COLUMNS_MAX) return wide_header(r);
    csv->columns = filled;
    csv->records = 1;
    r->used = 1 + filled;
    return hci_csv_check_header(csv, r->note);
}

/* ---- rows ---- */

static hci_status short_row(const reader *r, size_t line, size_t count, hci_note *note)
{
    char expected[96];
    snprintf(expected, sizeof expected, "%zu fields as in the header (line %zu)", r->csv->columns,
             hci_csv_record_line(r->csv, 0));
    const hci_csv_fault fault = {.line = line,
                                 .column = count,
                                 .name = hci_csv_cell(r->csv, 0, count),
                                 .found = "the end of the line",
                                 .expected = expected,
                                 .remedy = "complete the line or remove it"};
    return hci_csv_fault_note(r->csv, &fault, note);
}

/* A decimal comma among commas cuts a number in two, and the row becomes too long. */
static hci_status long_row(const reader *r, size_t line, const char *cell, hci_note *note)
{
    char expected[96], found[HCI_QUOTE_SIZE];
    const size_t columns = r->csv->columns;
    snprintf(expected, sizeof expected, "%zu field%s as in the header (line %zu)", columns,
             columns == 1 ? "" : "s", hci_csv_record_line(r->csv, 0));
    hci_csv_fault fault = {
        .line = line, .column = columns, .found = hci_quote(cell, found), .expected = expected};
    fault.remedy = "remove what is too much, or quote a text that holds the separator";
    if (r->csv->separator == ',')
        fault.remedy = "if the comma is the decimal mark, write a decimal point or separate the columns by ;";
    return hci_csv_fault_note(r->csv, &fault, note);
}

/* A row with `count` cells, or more than there are columns: refused, or left out. */
static hci_status torn_row(reader *r, size_t line, size_t count)
{
    hci_csv *csv = r->csv;
    hci_csv_hole *hole = &csv->hole;
    const bool is_short = count < csv->columns;
    if (!csv->leaves_holes)
        return is_short ? short_row(r, line, count, r->note) : long_row(r, line, r->surplus, r->note);
    if (csv->torn++ > 0) return HCI_OK;
    hole->line = line;
    hole->column = is_short ? count : csv->columns;
    if (is_short) {
        snprintf(hole->found, sizeof hole->found, "the end of the line");
        short_row(r, line, count, &hole->error);
    } else {
        hci_quote(r->surplus, hole->found);
        long_row(r, line, r->surplus, &hole->error);
    }
    return HCI_OK;
}

/* LabVIEW names a last column for comments, and ends the rows before it. */
static bool lacks_comment(const hci_csv *csv, size_t count)
{
    return count + 1 == csv->columns && csv->columns > 1 &&
           hci_csv_same_name(hci_csv_cell(csv, 0, csv->columns - 1), "Comment");
}

static hci_status read_row(reader *r)
{
    hci_csv *csv = r->csv;
    const size_t start = r->used, line = r->line;
    size_t count, filled;
    hci_status status = read_record(r, csv->columns, &count, &filled);
    if (!status && lacks_comment(csv, count)) {
        status = push(r, csv->index[r->used - 1] + (uint32_t)strlen(csv->text + csv->index[r->used - 1]));
        ++count;
    }
    if (status) return status;
    if (filled > 0 && filled <= csv->columns && count >= csv->columns) {
        csv->records++;
        return HCI_OK;
    }
    r->used = start; /* spreadsheets end tables with rows of bare separators */
    return filled == 0 ? HCI_OK : torn_row(r, line, filled > csv->columns ? csv->columns + 1 : count);
}

static hci_status read_rows(reader *r)
{
    hci_csv *csv = r->csv;
    hci_status status = HCI_OK;
    while (!status && find_record(r))
        status = read_row(r);
    if (!status && csv->torn > csv->records - 1)
        return hci_note_set(r->note, HCI_ERROR_INPUT, "%s", csv->hole.error.text);
    return status;
}

/* ---- row of units ---- */

/* Are there no words below a cell of record 1? */
static bool has_no_words_below(const hci_csv *csv, size_t column)
{
    const char *below = csv->records > 2 ? hci_csv_cell(csv, 2, column) : "";
    return *below == '\0' || hci_csv_is_number(below);
}

/* Record 1 is a row of units when each cell is a unit, "1", "-" or empty, at least one is a true unit, and no
 * column with a true unit goes on with words (a column of phases "A", "B", "C" is not in ampere). Where
 * several are true units, others may be words above numbers: units that are not known here. A table with a
 * column named `unit` gives its units row by row. */
static bool find_units(const hci_csv *csv)
{
    size_t units = 0, others = 0;
    if (csv->records < 2) return false;
    for (size_t column = 0; column < csv->columns; column++) {
        const char *cell = hci_csv_cell(csv, 1, column);
        if (hci_text_begins(hci_csv_cell(csv, 0, column), "unit", sizeof "unit")) return false;
        if (hci_csv_says_no_unit(cell)) continue;
        if (hci_csv_is_number(cell) || !has_no_words_below(csv, column)) return false;
        if (hci_csv_cell_unit(cell) != NULL)
            units++;
        else
            others++;
    }
    return others > 0 ? units > 1 && csv->records > 2 : units > 0;
}

/* ---- the table ---- */

/* A map out of somebody's drive becomes the table that it stands for. */
static hci_status turn_into_table(hci_csv *csv, hci_note *note)
{
    const hci_foreign_type *type = hci_foreign_recognise(csv->text);
    hci_foreign_map map;
    char *table;
    if (type == NULL) return HCI_OK;
    hci_status status = hci_foreign_read(type, csv->path, csv->text, &map, note);
    if (status) return status;
    status = hci_foreign_as_csv(&map, &table, note);
    hci_foreign_map_release(&map);
    if (status) return status;
    hci_memory_free(csv->text);
    csv->text = table;
    csv->map_of = type->word;
    return HCI_OK;
}

/* The monitor of SimpleFOC and serial ports in general write numbers and no names. */
static hci_status refuse_bare_rows(const reader *r)
{
    size_t numbers;
    char path[HCI_QUOTE_PATH_SIZE];
    const size_t line = hci_csv_bare_rows(r->next, &numbers);
    if (line == 0 || r->csv->has_foreword) return HCI_OK;
    return hci_note_set(
        r->note, HCI_ERROR_INPUT,
        "%s:%zu: found rows of %zu numbers and no line of names above them, expected a header; put one "
        "before "
        "them with a name for each number, such as time_s, theta_m_rad, iq_A. SimpleFOC's monitor writes "
        "what "
        "monitor_variables names, in the order target, voltage_q, voltage_d, current_q_mA, current_d_mA, "
        "shaft_velocity, shaft_angle, and no time",
        hci_quote_path(r->csv->path, path), line, numbers);
}

static hci_status read_table(hci_csv *csv, hci_note *note)
{
    reader r = {.csv = csv, .note = note, .line = 1};
    hci_status status = hci_csv_load(csv, note);
    if (!status) status = turn_into_table(csv, note);
    if (!status) status = hci_csv_of_twincat(csv->path, csv->text, note);
    if (status) return status;
    hci_csv_prepare(csv->text);
    r.next = csv->text + (strncmp(csv->text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0);
    pass_foreword(&r);
    status = csv->leaves_holes ? refuse_bare_rows(&r) : HCI_OK;
    if (!status) status = read_header(&r);
    if (!status) status = read_rows(&r);
    if (!status) csv->has_units = find_units(csv);
    return status;
}

static hci_status read_path(const char *path, bool leaves_holes, hci_csv **csv, hci_note *note)
{
    *csv = NULL;
    hci_csv *table = hci_memory_new(1, sizeof *table);
    if (table == NULL) return hci_note_memory(note, path, "reading it");
    table->leaves_holes = leaves_holes;
    table->path = hci_memory_text(path);
    hci_status status =
        table->path == NULL ? hci_note_memory(note, path, "reading it") : read_table(table, note);
    if (!status) {
        *csv = table;
    } else {
        hci_csv_free(table);
    }
    return status;
}

hci_status hci_csv_read(const char *path, hci_csv **csv, hci_note *note)
{
    return read_path(path, false, csv, note);
}

hci_status hci_csv_read_recording(const char *path, hci_csv **csv, hci_note *note)
{
    return read_path(path, true, csv, note);
}
