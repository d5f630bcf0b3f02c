/* The whole of a file as one text, or why it is none. What a device has learnt becomes text here. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/learned.h"

enum { FIRST_READ = 1 << 16 };

/* Offsets have 32 bits. A power of two times FIRST_READ, so that doubling meets it. */
#define SIZE_LIMIT ((size_t)1 << 31)

hci_status hci_csv_file_error(const char *path, hci_note *note, const char *found, const char *remedy)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(note, HCI_ERROR_INPUT, "%s: %s; %s", hci_quote_path(path, shown), found, remedy);
}

static hci_status system_error(const char *path, hci_note *note, int error)
{
    char found[128];
    if (error == ENOMEM) return hci_note_memory(note, path, "reading it");
    snprintf(found, sizeof found, "cannot be read: %s", strerror(error != 0 ? error : EIO));
    return hci_csv_file_error(path, note, found, "give the path of a CSV file that you may read");
}

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
    if (csv->text == NULL) return hci_note_memory(note, csv->path, "reading it");
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

/* NUL bytes to the end of the file: what was not written any more. */
static bool ends_in_nul(const hci_csv *csv, size_t size)
{
    for (size_t k = strlen(csv->text); k < size; ++k)
        if (csv->text[k] != '\0') return false;
    return true;
}

static hci_status check_encoding(const hci_csv *csv, size_t size, hci_note *note)
{
    if (size == SIZE_LIMIT)
        return hci_csv_file_error(csv->path, note, "found 2 GiB or more", "split the file");
    if (size >= 2 && (memcmp(csv->text, "\xFF\xFE", 2) == 0 || memcmp(csv->text, "\xFE\xFF", 2) == 0)) {
        return hci_csv_file_error(csv->path, note, "found UTF-16, expected UTF-8", "save it as CSV in UTF-8");
    }
    if (csv->leaves_holes && ends_in_nul(csv, size)) return HCI_OK;
    return strlen(csv->text) < size ? nul_error(csv, note) : HCI_OK;
}

hci_status hci_csv_load(hci_csv *csv, hci_note *note)
{
    size_t size = 0;
    const hci_status status = read_file(csv, &size, note);
    if (status) return status;
    if (hci_csv_is_learned(csv, size)) return hci_csv_read_learned(csv, size, note);
    return check_encoding(csv, size, note);
}
