/* Any bytes as blobs of tables, with the CRC that they should have so that the checks behind it are reached
 * too: refused with the table as it was, or a table that can be read at every angle. No byte beyond is read:
 * each lies in memory of its own size. */
#include "fuzzing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hci/loop_blob.h"

static void use_f32(const void *blob, uint32_t size)
{
    hci_table_f32 table, before;
    memset(&table, 0x5A, sizeof table);
    before = table;
    if (hci_blob_table_f32(blob, size, &table, NULL) != HCI_BLOB_GOOD) {
        fuzz_require(memcmp(&table, &before, sizeof table) == 0, "a table that is left as it was");
        return;
    }
    for (uint32_t k = 0; k < 64; ++k) {
        float out[3];
        hci_table_f32_currents(&table, k * 0x04000001u, (float)k, out);
    }
}

static void use_i16(const void *blob, uint32_t size)
{
    hci_table_i16 table, before;
    memset(&table, 0x5A, sizeof table);
    before = table;
    if (hci_blob_table_i16(blob, size, &table, NULL) != HCI_BLOB_GOOD) {
        fuzz_require(memcmp(&table, &before, sizeof table) == 0, "a table that is left as it was");
        return;
    }
    for (uint32_t k = 0; k < 64; ++k) {
        int16_t whole[3];
        float out[3];
        hci_table_i16_currents_q15(&table, k * 0x04000001u, (int16_t)(k * 512u), whole);
        hci_table_i16_currents(&table, k * 0x04000001u, (float)k, out);
    }
}

static void use_loop(const void *blob, uint32_t size)
{
    hci_loop_f32 loop, before;
    memset(&loop, 0x5A, sizeof loop);
    before = loop;
    if (hci_loop_blob_read(blob, size, &loop, NULL) != HCI_BLOB_GOOD)
        fuzz_require(memcmp(&loop, &before, sizeof loop) == 0, "orders that are left as they were");
}

static void use(const uint8_t *bytes, size_t size)
{
    use_f32(bytes, (uint32_t)size);
    use_i16(bytes, (uint32_t)size);
    use_loop(bytes, (uint32_t)size);
}

static void store(uint8_t *at, uint32_t word)
{
    for (int k = 0; k < 4; ++k)
        at[k] = (uint8_t)(word >> (8 * k));
}

/* Sizes and sums as they should be, and the end of the blob at the end of the input. */
static void set_sums(uint8_t *bytes, size_t size)
{
    const uint32_t words = (uint32_t)size & ~3u;
    memcpy(bytes, "HCIT\001", 6);
    store(bytes + 8, words);
    store(bytes + words - 4, hci_blob_crc32(bytes, words - 4));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size > 1u << 20) return -1;
    uint8_t *bytes = malloc(size + (size == 0));
    fuzz_require(bytes != NULL, "memory for the input");
    if (size > 0) memcpy(bytes, data, size);
    use(bytes, size);
    if (size >= HCI_BLOB_HEAD + 4) set_sums(bytes, size), use(bytes, size);
    free(bytes);
    return 0;
}
