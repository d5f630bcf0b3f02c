/* A table of numbers in memory: its header is text as that of a file, its rows are the caller's numbers. */
#include <stdint.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/table.h"

enum { SHOWN_SIZE = 32 }; /* as hci_number_text asks for */

/* The names one after another in csv->text, and the index of record 0. */
static void write_header(const hci_csv_memory *from, hci_csv *csv)
{
    char *next = csv->text;
    csv->index[0] = 1;
    for (size_t k = 0; k < from->columns; ++k) {
        const size_t size = strlen(from->column[k]) + 1;
        memcpy(next, from->column[k], size);
        csv->index[1 + k] = (uint32_t)(next - csv->text);
        next += size;
    }
}

static size_t header_size(const hci_csv_memory *from)
{
    size_t size = 1;
    for (size_t k = 0; k < from->columns; ++k)
        size += strlen(from->column[k]) + 1;
    return size;
}

static hci_status fill(const hci_csv_memory *from, hci_csv *csv, hci_note *note)
{
    csv->path = hci_memory_text(from->name);
    csv->text = hci_memory_malloc(header_size(from));
    csv->index = hci_memory_new(1 + from->columns, sizeof *csv->index);
    csv->shown = hci_memory_malloc(SHOWN_SIZE);
    if (!csv->path || !csv->text || !csv->index || !csv->shown)
        return hci_note_memory(note, from->name, "its columns");
    csv->columns = from->columns;
    csv->records = 1 + from->rows;
    csv->number = from->value;
    write_header(from, csv);
    return hci_csv_check_header(csv, note);
}

hci_status hci_csv_of_memory(const hci_csv_memory *from, hci_csv **csv, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE];
    *csv = NULL;
    if (from->columns == 0)
        return hci_note_set(note, HCI_ERROR_INPUT, "%s: found no column, expected at least one; add one",
                            hci_quote_path(from->name, path));
    hci_csv *table = hci_memory_new(1, sizeof *table);
    if (!table) return hci_note_memory(note, from->name, "its columns");
    const hci_status status = fill(from, table, note);
    if (status)
        hci_csv_free(table);
    else
        *csv = table;
    return status;
}
