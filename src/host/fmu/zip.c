/* APPNOTE.TXT of PKWARE, sections 4.3.7 (local header), 4.3.12 (central directory) and 4.3.16 (its end). */
#include "host/fmu/zip.h"

#include <string.h>

enum {
    LOCAL_HEADER = 0x04034b50,
    CENTRAL_HEADER = 0x02014b50,
    END_OF_DIRECTORY = 0x06054b50,
    LOCAL_SIZE = 30,
    CENTRAL_SIZE = 46,
    VERSION = 20,          /* 2.0: folders */
    MADE_ON_UNIX = 3 << 8, /* so that the permissions below hold */
    UTF8_NAMES = 1 << 11,
    FIRST_DATE = 33, /* 1 January 1980 */
    MOST_ENTRIES = 65535
};

static const uint32_t PLAIN_FILE = 0100644u << 16;
static const uint64_t MOST_BYTES = 0xFFFFFFFFu;

/* Numbers of a header, the lowest byte first. */
typedef struct {
    unsigned char bytes[64];
    size_t size;
} record;

static void put(record *r, uint32_t value, size_t bytes)
{
    for (size_t k = 0; k < bytes; ++k)
        r->bytes[r->size++] = (unsigned char)(value >> (8 * k));
}

static uint32_t crc32_of(const void *bytes, size_t size)
{
    const unsigned char *b = bytes;
    uint32_t crc = 0xFFFFFFFFu;
    for (size_t k = 0; k < size; ++k) {
        crc ^= b[k];
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ (crc & 1u ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

/* What local and central header share. */
static void put_entry(record *r, const hci_zip_entry *e, uint32_t crc)
{
    put(r, VERSION, 2);
    put(r, UTF8_NAMES, 2);
    put(r, 0, 2); /* stored */
    put(r, 0, 2); /* time */
    put(r, FIRST_DATE, 2);
    put(r, crc, 4);
    put(r, (uint32_t)e->size, 4);
    put(r, (uint32_t)e->size, 4);
    put(r, (uint32_t)strlen(e->path), 2);
    put(r, 0, 2); /* extra field */
}

static void write_file(hci_output *output, const hci_zip_entry *e)
{
    record r = {.size = 0};
    put(&r, LOCAL_HEADER, 4);
    put_entry(&r, e, crc32_of(e->bytes, e->size));
    hci_output_bytes(output, r.bytes, r.size);
    hci_output_bytes(output, e->path, strlen(e->path));
    hci_output_bytes(output, e->bytes, e->size);
}

static void write_directory_entry(hci_output *output, const hci_zip_entry *e, uint32_t at)
{
    record r = {.size = 0};
    put(&r, CENTRAL_HEADER, 4);
    put(&r, VERSION | MADE_ON_UNIX, 2);
    put_entry(&r, e, crc32_of(e->bytes, e->size));
    put(&r, 0, 2); /* comment */
    put(&r, 0, 2); /* disk */
    put(&r, 0, 2); /* internal attributes */
    put(&r, PLAIN_FILE, 4);
    put(&r, at, 4);
    hci_output_bytes(output, r.bytes, r.size);
    hci_output_bytes(output, e->path, strlen(e->path));
}

static void write_end(hci_output *output, size_t count, uint32_t size, uint32_t at)
{
    record r = {.size = 0};
    put(&r, END_OF_DIRECTORY, 4);
    put(&r, 0, 4); /* disks */
    put(&r, (uint32_t)count, 2);
    put(&r, (uint32_t)count, 2);
    put(&r, size, 4);
    put(&r, at, 4);
    put(&r, 0, 2); /* comment */
    hci_output_bytes(output, r.bytes, r.size);
}

hci_status hci_zip_write(hci_output *output, const hci_zip_entry *entries, size_t count, hci_note *note)
{
    uint64_t files = 0, directory = 0;
    for (size_t k = 0; k < count; ++k) {
        files += LOCAL_SIZE + strlen(entries[k].path) + entries[k].size;
        directory += CENTRAL_SIZE + strlen(entries[k].path);
    }
    if (count > MOST_ENTRIES || files + directory > MOST_BYTES)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "too much for one archive: %zu files", count);
    uint32_t at = 0;
    for (size_t k = 0; k < count; ++k)
        write_file(output, &entries[k]);
    for (size_t k = 0; k < count; ++k) {
        write_directory_entry(output, &entries[k], at);
        at += LOCAL_SIZE + (uint32_t)(strlen(entries[k].path) + entries[k].size);
    }
    write_end(output, count, (uint32_t)directory, (uint32_t)files);
    return HCI_OK;
}
