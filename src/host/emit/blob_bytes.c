#include "host/emit/blob_bytes.h"

#include <stdio.h>
#include <string.h>

#include "hci/blob.h"

void hci_blob_put(hci_blob_sink *s, uint32_t value, int bytes)
{
    unsigned char low[4];
    for (int k = 0; k < bytes; ++k)
        low[k] = (unsigned char)(value >> 8 * k & 255u);
    s->crc =
        hci_table_crc32_bytes(s->crc, value & (bytes == 4 ? 0xFFFFFFFFu : (1u << 8 * bytes) - 1u), bytes);
    hci_output_bytes(s->out, low, (size_t)bytes);
    s->count += (size_t)bytes;
}

void hci_blob_put_float(hci_blob_sink *s, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    hci_blob_put(s, bits, 4);
}

void hci_blob_fill(hci_blob_sink *s)
{
    while (s->count % 4 != 0)
        hci_blob_put(s, 0, 1);
}

void hci_blob_put_name(hci_blob_sink *s, const char *name)
{
    char text[HCI_BLOB_NAME] = {0};
    snprintf(text, sizeof text, "%.*s", (int)sizeof text - 1, name);
    for (size_t k = 0; k < sizeof text; ++k)
        hci_blob_put(s, (unsigned char)text[k], 1);
}

void hci_blob_put_crc(hci_blob_sink *s)
{
    hci_blob_put(s, ~s->crc, 4);
}

void hci_blob_put_start(hci_blob_sink *s, int kind, size_t bytes, uint64_t input_hash, size_t pole_pairs)
{
    hci_blob_put(s, 0x54494348u, 4);
    hci_blob_put(s, HCI_BLOB_VERSION, 2);
    hci_blob_put(s, (uint32_t)kind, 2);
    hci_blob_put(s, (uint32_t)bytes, 4);
    hci_blob_put(s, (uint32_t)input_hash, 4);
    hci_blob_put(s, (uint32_t)(input_hash >> 32), 4);
    hci_blob_put(s, (uint32_t)pole_pairs, 4);
}
