#include "host/base/checksum.h"

#include <errno.h>
#include <inttypes.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "host/base/memory.h"

enum { PART_SIZE = 1 << 14 };

/* What a byte adds, for the polynomial of ISO/IEC 8802-3. */
static void fill_table(uint32_t table[256])
{
    for (uint32_t k = 0; k < 256; ++k) {
        uint32_t c = k << 24;
        for (int bit = 0; bit < 8; ++bit)
            c = (c << 1) ^ ((c >> 31) * UINT32_C(0x04C11DB7));
        table[k] = c;
    }
}

static uint32_t add_byte(const uint32_t table[256], uint32_t c, unsigned byte)
{
    return (c << 8) ^ table[(c >> 24) ^ (byte & 0xFFu)];
}

bool hci_checksum_file(const char *path, char text[HCI_CHECKSUM_SIZE])
{
    unsigned char part[PART_SIZE];
    uint32_t table[256], c = 0;
    uint64_t size = 0;
    size_t length;
    FILE *file = fopen(path, "rb");
    if (file == NULL && errno == ENOMEM) hci_memory_is_short();
    if (file == NULL) return false;
    fill_table(table);
    for (; (length = fread(part, 1, sizeof part, file)) > 0; size += length)
        for (size_t k = 0; k < length; ++k)
            c = add_byte(table, c, part[k]);
    const bool good = !ferror(file);
    fclose(file);
    for (uint64_t rest = size; rest > 0; rest >>= 8)
        c = add_byte(table, c, (unsigned)(rest & 0xFF));
    snprintf(text, HCI_CHECKSUM_SIZE, "%" PRIu32 " %" PRIu64, (uint32_t)~c, size);
    return good;
}
