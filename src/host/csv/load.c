/* The whole of a file as one text, or why it is none; "-" is standard input, which can be read once. What a
 * device has learnt becomes text here. */
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "hci/host/base/output.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/encoding.h"
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
    if (error == EISDIR)
        return hci_csv_file_error(path, note, "found a folder, expected a CSV file",
                                  "give the path of a file in it");
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

/* Files that a process was killed over are those of its set first. */
static void finish_interrupted(const char *path)
{
    char folder[4096];
    const char *end = strrchr(path, '/');
    const size_t length = end != NULL ? (size_t)(end - path) : 0;
    if (length >= sizeof folder) return;
    memcpy(folder, path, length);
    folder[length] = '\0';
    hci_output_finish_interrupted(end == NULL ? "." : length == 0 ? "/" : folder);
}

static hci_status read_file(hci_csv *csv, size_t *size, hci_note *note)
{
    const bool is_input = strcmp(csv->path, "-") == 0;
    finish_interrupted(csv->path);
    errno = 0;
    FILE *stream = is_input ? stdin : fopen(csv->path, "rb");
    if (stream == NULL) return system_error(csv->path, note, errno);
    csv->text = read_stream(stream, size);
    const int failure = ferror(stream) ? errno : 0;
    if (!is_input) fclose(stream);
    if (csv->text == NULL) return hci_note_memory(note, csv->path, "reading it");
    if (failure != 0) return system_error(csv->path, note, failure);
    return HCI_OK;
}

/* What a file is whose first bytes tell; NULL: nothing that is known. */
static const char *kind_of(const char *text, size_t size)
{
    static const struct {
        const char *bytes;
        size_t length;
        const char *words;
    } KINDS[] = {{"PK\003\004", 4, "found a workbook (.xlsx, .ods) or another ZIP file"},
                 {"\xD0\xCF\x11\xE0", 4, "found an old workbook (.xls)"},
                 {"MATLAB 5.0", 10, "found a MATLAB file"},
                 {"\x89HDF", 4, "found an HDF5 or MATLAB file"},
                 {"\x93NUMPY", 6, "found a NumPy file"},
                 {"MDF     ", 8, "found an MDF file"},
                 {"TDSm", 4, "found a TDMS file"},
                 {"%PDF", 4, "found a PDF file"},
                 {"\x1F\x8B", 2, "found a compressed file"}};
    for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; ++k)
        if (size >= KINDS[k].length && memcmp(text, KINDS[k].bytes, KINDS[k].length) == 0)
            return KINDS[k].words;
    return NULL;
}

/* A text that is no table, by how it begins; NULL: nothing that is known. */
static const char *kind_of_text(const char *text)
{
    static const struct {
        const char *begins, *words;
    } KINDS[] = {{"<!doctype html", "found a page (HTML), expected a table"},
                 {"<html", "found a page (HTML), expected a table"},
                 {"<?xml", "found XML, expected a table"},
                 {"<svg", "found a picture (SVG), expected a table"},
                 {"{", "found JSON, expected a table"},
                 {"[{", "found JSON, expected a table"},
                 {"[[", "found JSON, expected a table"},
                 {"#include", "found a C source, expected a table"},
                 {"#!/", "found a script, expected a table"}};
    if (strncmp(text, "\xEF\xBB\xBF", 3) == 0) text += 3;
    text += strspn(text, " \t\r\n");
    for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; ++k)
        if (strncasecmp(text, KINDS[k].begins, strlen(KINDS[k].begins)) == 0) return KINDS[k].words;
    return strncmp(text, "/*", 2) == 0 && strstr(text, "#include") != NULL
               ? "found a C source, expected a table"
               : NULL;
}

/* A file that is no text, or a log that lost its end to a power failure. */
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

static hci_status too_large(const hci_csv *csv, hci_note *note)
{
    return hci_csv_file_error(csv->path, note, "found 2 GiB or more", "split the file");
}

/* Into UTF-8, where a spreadsheet has saved it in another encoding. */
static hci_status change_encoding(hci_csv *csv, size_t *size, hci_note *note)
{
    const hci_encoding encoding = hci_encoding_of(csv->text, *size);
    if (encoding == HCI_ENCODING_UTF8 || encoding == HCI_ENCODING_OTHER) return HCI_OK;
    char *text = hci_encoding_to_utf8(encoding, csv->text, size);
    if (text == NULL) return hci_note_memory(note, csv->path, "reading it");
    hci_memory_free(csv->text);
    csv->text = text;
    return *size >= SIZE_LIMIT ? too_large(csv, note) : HCI_OK;
}

static hci_status no_table(const hci_csv *csv, const char *kind, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(note, HCI_ERROR_INPUT,
                        "%s:1: %s; give the CSV file of the rows, which may stand beside it",
                        hci_quote_path(csv->path, path), kind);
}

static hci_status check_text(hci_csv *csv, size_t size, hci_note *note)
{
    if (size == SIZE_LIMIT) return too_large(csv, note);
    const char *kind = kind_of(csv->text, size);
    if (kind != NULL)
        return hci_csv_file_error(csv->path, note, kind, "save the table in it as CSV and give that file");
    const hci_status status = change_encoding(csv, &size, note);
    if (status) return status;
    kind = kind_of_text(csv->text);
    if (kind != NULL) return no_table(csv, kind, note);
    if (csv->leaves_holes && ends_in_nul(csv, size)) return HCI_OK;
    return strlen(csv->text) < size ? nul_error(csv, note) : HCI_OK;
}

hci_status hci_csv_load(hci_csv *csv, hci_note *note)
{
    size_t size = 0;
    const hci_status status = read_file(csv, &size, note);
    if (status) return status;
    if (hci_csv_is_learned(csv, size)) return hci_csv_read_learned(csv, size, note);
    return check_text(csv, size, note);
}
