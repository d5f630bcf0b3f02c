#include "hci/host/csv/csv.h"

#include <assert.h>
#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/text.h"
#include "hci/host/base/utf8.h"
#include "host/base/memory.h"
#include "host/base/number_read.h"
#include "host/base/quote.h"
#include "host/base/unit_lookup.h"
#include "host/csv/table.h"

enum { COLUMNS_MAX = 4096, FIRST_READ = 1 << 16 };

/* Offsets have 32 bits. A power of two times FIRST_READ, so that doubling meets it. */
#define SIZE_LIMIT ((size_t)1 << 31)

typedef struct {
    hci_csv *csv;
    hci_note *note;
    char *next;    /* first byte not yet read; the text ends with a NUL */
    uint32_t line; /* of `next` */
    size_t used, capacity;
    const char *surplus; /* a cell beyond the last column that is not empty */
    bool stop[256];      /* bytes that end a cell without quotes */
} reader;

/* ---- messages ---- */

static hci_status file_error(const char *path, hci_note *note, const char *found, const char *remedy)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(note, HCI_ERROR_INPUT, "%s: %s; %s", hci_quote_path(path, shown), found, remedy);
}

static hci_status system_error(const char *path, hci_note *note, int error)
{
    char found[128];
    snprintf(found, sizeof found, "cannot be read: %s", strerror(error != 0 ? error : EIO));
    return file_error(path, note, found, "give the path of a CSV file that you may read");
}

static hci_status memory_error(const char *path, hci_note *note)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(note, HCI_ERROR_MEMORY, "%s: not enough memory to read it",
                        hci_quote_path(path, shown));
}

/* `name` may be NULL: then the column has a number only. */
hci_status hci_csv_cell_error(const hci_csv *csv, size_t line, size_t column, const char *name,
                              hci_note *note, const char *found, const char *expected, const char *remedy)
{
    char path[HCI_QUOTE_PATH_SIZE], quoted[HCI_QUOTE_SIZE];
    return hci_note_set(note, HCI_ERROR_INPUT, "%s:%zu: column %zu%s%s: found %s, expected %s; %s",
                        hci_quote_path(csv->path, path), line, column + 1, name != NULL ? " " : "",
                        name != NULL ? hci_quote(name, quoted) : "", found, expected, remedy);
}

/* ---- reading the file ---- */

static char *read_stream(FILE *stream, size_t *size)
{
    size_t capacity = FIRST_READ;
    char *text = hci_memory_malloc(capacity + 1);
    *size = 0;
    while (text != NULL) {
        *size += fread(text + *size, 1, capacity - *size, stream);
        if (*size < capacity || *size == SIZE_LIMIT) break;
        capacity *= 2;
        char *larger = hci_memory_realloc(text, capacity + 1);
        if (larger == NULL) hci_memory_free(text);
        text = larger;
    }
    if (text != NULL) text[*size] = '\0';
    return text;
}

static hci_status read_file(hci_csv *csv, size_t *size, hci_note *note)
{
    errno = 0;
    FILE *stream = fopen(csv->path, "rb");
    if (stream == NULL) return system_error(csv->path, note, errno);
    csv->text = read_stream(stream, size);
    const int failure = ferror(stream) ? errno : 0;
    fclose(stream);
    if (csv->text == NULL) return memory_error(csv->path, note);
    if (failure != 0) return system_error(csv->path, note, failure);
    return HCI_OK;
}

/* A spreadsheet, UTF-16 without its mark, or a log that lost its end to a power failure. */
static hci_status nul_error(const hci_csv *csv, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE];
    size_t line = 1;
    for (const char *at = csv->text; *at != '\0'; at++)
        line += *at == '\n';
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%s:%zu: found a NUL byte, expected text; save it as CSV in UTF-8",
                        hci_quote_path(csv->path, path), line);
}

static hci_status check_encoding(const hci_csv *csv, size_t size, hci_note *note)
{
    if (size == SIZE_LIMIT) return file_error(csv->path, note, "found 2 GiB or more", "split the file");
    if (size >= 2 && (memcmp(csv->text, "\xFF\xFE", 2) == 0 || memcmp(csv->text, "\xFE\xFF", 2) == 0)) {
        return file_error(csv->path, note, "found UTF-16, expected UTF-8", "save it as CSV in UTF-8");
    }
    return strlen(csv->text) < size ? nul_error(csv, note) : HCI_OK;
}

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

/* One cell. On return r->next is at its separator, its newline or the end, with that byte in *stop. */
static hci_status read_cell(reader *r, size_t column, char **cell, char *stop)
{
    const char separator = r->csv->separator;
    const size_t line = r->line;
    char *start = skip_blanks(r->next, separator), *at = start, *end;
    if (*at == '"') {
        if (!unquote(r, &at, &start, &end)) {
            return hci_csv_cell_error(r->csv, line, column, NULL, r->note, "an opening quote only",
                                      "a closing quote",
                                      "close the quotes, and write a quote inside of them twice");
        }
        at = skip_blanks(at, separator);
        if (!r->stop[(unsigned char)*at]) {
            return hci_csv_cell_error(r->csv, r->line, column, NULL, r->note, "text after a closing quote",
                                      "a separator or the end of the line",
                                      "write a quote inside of quotes twice");
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
        if (larger == NULL) return memory_error(r->csv->path, r->note);
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
    for (*count = 0; status == HCI_OK && stop == r->csv->separator; ++*count) {
        status = read_cell(r, *count, &cell, &stop);
        if (status != HCI_OK) return status;
        if (*cell != '\0') *filled = *count + 1;
        if (*filled > columns) {
            r->surplus = cell;
            return HCI_OK;
        }
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

char *hci_csv_cell(const hci_csv *csv, size_t record, size_t column)
{
    return csv->text + csv->index[record * (csv->columns + 1) + 1 + column];
}

size_t hci_csv_record_line(const hci_csv *csv, size_t record)
{
    return csv->index[record * (csv->columns + 1)];
}

bool hci_csv_same_name(const char *a, const char *b)
{
    return strlen(a) == 1 ? strcmp(a, b) == 0 : hci_text_is(a, b);
}

hci_number_kind hci_csv_kind(const hci_csv *csv, const char *cell)
{
    double value;
    char mark;
    return hci_number_read(cell, csv->separator == ';', &value, &mark);
}

hci_status hci_csv_encoding_error(const hci_csv *csv, size_t line, size_t column, const char *cell,
                                  hci_note *note)
{
    char found[HCI_QUOTE_SIZE];
    return hci_csv_cell_error(csv, line, column, NULL, note, hci_quote(cell, found), "text in UTF-8",
                              "save the file as CSV in UTF-8");
}

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
        return hci_csv_cell_error(csv, line, column, name, note, found, "each name once",
                                  "rename or remove one of them");
    }
    return HCI_OK;
}

static hci_status check_header(const hci_csv *csv, hci_note *note)
{
    size_t numbers = 0;
    for (size_t column = 0; column < csv->columns; column++) {
        const hci_status status = check_name(csv, column, note);
        if (status != HCI_OK) return status;
        numbers += *hci_csv_cell(csv, 0, column) == '\0' ||
                   hci_csv_kind(csv, hci_csv_cell(csv, 0, column)) != HCI_NUMBER_NONE;
    }
    if (numbers < csv->columns) return HCI_OK;
    char found[HCI_QUOTE_SIZE];
    const size_t last = csv->columns - 1;
    return hci_csv_cell_error(csv, hci_csv_record_line(csv, 0), last, NULL, note,
                              hci_quote(hci_csv_cell(csv, 0, last), found), "a column name",
                              "put a row of column names first");
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

static hci_status read_header(reader *r)
{
    hci_csv *csv = r->csv;
    size_t count, filled = 0;
    while (filled == 0) {
        csv->separator = '\0';
        memset(r->stop, 0, sizeof r->stop);
        r->used = 0;
        if (!find_record(r)) {
            return file_error(csv->path, r->note,
                              "found no line of text, expected a header row of column names",
                              "write the names in the first line");
        }
        set_separator(r);
        const hci_status status = read_record(r, COLUMNS_MAX, &count, &filled);
        if (status != HCI_OK) return status;
    }
    if (filled > COLUMNS_MAX) {
        return hci_csv_cell_error(csv, csv->index[0], COLUMNS_MAX, NULL, r->note, "another column",
                                  "4096 columns at most", "remove those that are not needed");
    }
    csv->columns = filled;
    csv->records = 1;
    r->used = 1 + filled;
    return check_header(csv, r->note);
}

/* ---- rows ---- */

static hci_status short_row(const reader *r, size_t line, size_t count)
{
    char expected[96];
    snprintf(expected, sizeof expected, "%zu fields as in the header (line %zu)", r->csv->columns,
             hci_csv_record_line(r->csv, 0));
    return hci_csv_cell_error(r->csv, line, count, hci_csv_cell(r->csv, 0, count), r->note,
                              "the end of the line", expected, "complete the line or remove it");
}

/* A decimal comma among commas cuts a number in two, and the row becomes too long. */
static hci_status long_row(const reader *r, size_t line, const char *cell)
{
    char expected[96], found[HCI_QUOTE_SIZE];
    const size_t columns = r->csv->columns;
    snprintf(expected, sizeof expected, "%zu field%s as in the header (line %zu)", columns,
             columns == 1 ? "" : "s", hci_csv_record_line(r->csv, 0));
    return hci_csv_cell_error(
        r->csv, line, columns, NULL, r->note, hci_quote(cell, found), expected,
        r->csv->separator == ','
            ? "if the comma is the decimal mark, write a decimal point or separate the columns by ;"
            : "remove what is too much, or quote a text that holds the separator");
}

static hci_status read_rows(reader *r)
{
    hci_csv *csv = r->csv;
    while (find_record(r)) {
        const size_t start = r->used, line = r->line;
        size_t count, filled;
        const hci_status status = read_record(r, csv->columns, &count, &filled);
        if (status != HCI_OK) return status;
        if (filled == 0) {
            r->used = start; /* spreadsheets end tables with rows of bare separators */
        } else if (filled > csv->columns) {
            return long_row(r, line, r->surplus);
        } else if (count < csv->columns) {
            return short_row(r, line, count);
        } else {
            csv->records++;
        }
    }
    return HCI_OK;
}

/* ---- row of units ---- */

const hci_unit *hci_csv_cell_unit(const char *cell)
{
    const size_t length = strlen(cell);
    if (length >= 2 &&
        ((cell[0] == '(' && cell[length - 1] == ')') || (cell[0] == '[' && cell[length - 1] == ']')))
        return hci_unit_find(cell + 1, length - 2);
    return hci_unit_find(cell, length);
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

/* Are there no words below a cell of record 1? */
static bool has_no_words_below(const hci_csv *csv, size_t column)
{
    const char *below = csv->records > 2 ? hci_csv_cell(csv, 2, column) : "";
    return *below == '\0' || hci_csv_kind(csv, below) != HCI_NUMBER_NONE;
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
        if (hci_csv_kind(csv, cell) != HCI_NUMBER_NONE || !has_no_words_below(csv, column)) return false;
        if (hci_csv_cell_unit(cell) != NULL)
            units++;
        else
            others++;
    }
    return others > 0 ? units > 1 && csv->records > 2 : units > 0;
}

/* ---- the table ---- */

static hci_status read_table(hci_csv *csv, hci_note *note)
{
    reader r = {.csv = csv, .note = note, .line = 1};
    size_t size = 0;
    hci_status status = read_file(csv, &size, note);
    if (status == HCI_OK) status = check_encoding(csv, size, note);
    if (status != HCI_OK) return status;
    r.next = csv->text + (strncmp(csv->text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0);
    pass_foreword(&r);
    status = read_header(&r);
    if (status == HCI_OK) status = read_rows(&r);
    if (status == HCI_OK) csv->has_units = find_units(csv);
    return status;
}

hci_status hci_csv_read(const char *path, hci_csv **csv, hci_note *note)
{
    *csv = NULL;
    hci_csv *table = hci_memory_new(1, sizeof *table);
    if (table == NULL) return memory_error(path, note);
    table->path = hci_memory_malloc(strlen(path) + 1);
    hci_status status = HCI_ERROR_MEMORY;
    if (table->path == NULL) {
        memory_error(path, note);
    } else {
        memcpy(table->path, path, strlen(path) + 1);
        status = read_table(table, note);
    }
    if (status == HCI_OK) {
        *csv = table;
    } else {
        hci_csv_free(table);
    }
    return status;
}

void hci_csv_free(hci_csv *csv)
{
    if (csv == NULL) return;
    hci_memory_free(csv->path);
    hci_memory_free(csv->text);
    hci_memory_free(csv->index);
    hci_memory_free(csv);
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
