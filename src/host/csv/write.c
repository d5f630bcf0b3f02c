#include "host/csv/write.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/text.h"
#include "hci/host/base/utf8.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/marks.h"
#include "host/csv/number_cell.h"
#include "host/csv/table.h"

enum { PATH_SIZE = 4096 };

typedef struct {
    const hci_csv *csv;
    const hci_csv_added *added;
    size_t added_count;
    hci_output *output;
    hci_cell_reader *readers; /* of each column */
    hci_note *note;
} writer;

static bool is_replaced(const writer *w, size_t column)
{
    for (size_t k = 0; k < w->added_count; ++k)
        if (hci_text_is(hci_csv_cell(w->csv, 0, column), w->added[k].name)) return true;
    return false;
}

static bool needs_quotes(const char *cell, bool first)
{
    return strpbrk(cell, ",;\t\"\r\n") != NULL || (first && *cell == '#');
}

void hci_csv_write_cell(hci_output *output, const char *cell, bool first)
{
    if (!needs_quotes(cell, first)) {
        hci_output_text(output, "%s,", cell);
        return;
    }
    hci_output_text(output, "\"");
    for (; *cell != '\0'; ++cell)
        hci_output_text(output, "%s%c", *cell == '"' ? "\"" : "", *cell);
    hci_output_text(output, "\",");
}

/* A number with a decimal comma gets a point, and keeps its digits; one with marks between thousands loses
 * these. */
static void write_cell(const writer *w, size_t record, size_t column, bool first)
{
    const char *cell = hci_csv_cell(w->csv, record, column);
    hci_cell_reader *r = &w->readers[column];
    const hci_marks marks = hci_marks_of(cell);
    const char mark = marks.decimal != 0 ? marks.decimal : marks.doubtful;
    const char *comma = strchr(cell, ',');
    hci_number_kind kind = HCI_NUMBER_NONE;
    double value;
    if (marks.group == 0 && mark == ',' && r->decimal == ',')
        hci_output_text(w->output, "%.*s.%s,", (int)(comma - cell), cell, comma + 1);
    else if ((marks.group != 0 || (mark != 0 && mark != r->decimal)) &&
             !hci_cell_read(r, record, &kind, &value, NULL) && kind == HCI_NUMBER_FINITE)
        hci_output_number(w->output, value, ',');
    else
        hci_csv_write_cell(w->output, cell, first);
}

static hci_status write_own(const writer *w, size_t record)
{
    bool first = true;
    for (size_t column = 0; column < w->csv->columns; ++column) {
        const char *cell = hci_csv_cell(w->csv, record, column);
        if (is_replaced(w, column)) continue;
        if (!hci_utf8_valid(cell))
            return hci_csv_encoding_error(w->csv, hci_csv_record_line(w->csv, record), column, cell, w->note);
        write_cell(w, record, column, first);
        first = false;
    }
    return HCI_OK;
}

static hci_status write_record(const writer *w, size_t record)
{
    const hci_status status = write_own(w, record);
    const size_t first = hci_csv_first_record(w->csv);
    for (size_t k = 0; k < w->added_count && !status; ++k) {
        const char end = k + 1 < w->added_count ? ',' : '\n';
        const double value = record >= first ? w->added[k].value[record - first] : 0.0;
        if (isnan(value) && w->csv->leaves_holes)
            hci_output_text(w->output, "%c", end);
        else if (record >= first)
            hci_output_number(w->output, value, end);
        else
            hci_output_text(w->output, "%s%c", record == 0 ? w->added[k].name : w->added[k].unit, end);
    }
    return status;
}

hci_status hci_csv_write_with(const hci_csv *csv, const hci_csv_added *added, size_t count, const char *path,
                              hci_note *note)
{
    writer w = {csv, added, count, NULL, hci_memory_new(csv->columns, sizeof *w.readers), note};
    assert(count > 0);
    if (w.readers == NULL) return hci_note_memory(note, path, "the output");
    for (size_t column = 0; column < csv->columns; ++column)
        w.readers[column] = hci_cell_reader_plain(csv, column);
    hci_status status = hci_output_open_file(path, &w.output, note);
    for (size_t record = 0; record < csv->records && !status; ++record)
        status = write_record(&w, record);
    hci_memory_free(w.readers);
    if (!status) return hci_output_commit(w.output, note);
    hci_output_discard(w.output);
    return status;
}

hci_status hci_csv_copy(const char *path, hci_output *output, hci_note *note)
{
    char own[PATH_SIZE];
    hci_csv csv = {.path = own};
    if (snprintf(own, sizeof own, "%s", path) >= PATH_SIZE)
        return hci_note_set(note, HCI_ERROR_INPUT, "%.200s…: the path is too long", path);
    const hci_status status = hci_csv_load(&csv, note);
    if (!status) hci_output_bytes(output, csv.text, strlen(csv.text));
    hci_memory_free(csv.text);
    return status;
}
