/* Reads the blob of a drive's orders as a device does: the references are those of the compiled orders to the
 * last bit; one that is cut off at any byte or has any bit flipped, or is another kind, is refused and leaves
 * the orders as they were. main LOOP.bin OTHER.bin */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/loop_blob.h"
#include "orders.h"

static unsigned char *bytes;
static uint32_t size;
static int failures;

static void expect(int good, const char *what)
{
    if (good) return;
    fprintf(stderr, "blob of orders: %s\n", what);
    ++failures;
}

static void read_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file) exit(2);
    bytes = aligned_alloc(4, 65536);
    size = (uint32_t)fread(bytes, 1, 65536, file);
    fclose(file);
}

static void refuse(const void *blob, uint32_t room, const char *what)
{
    hci_loop_f32 x;
    memset(&x, 0x5A, sizeof x);
    const hci_loop_f32 before = x;
    expect(hci_loop_blob_read(blob, room, &x, NULL) != HCI_BLOB_GOOD && memcmp(&x, &before, sizeof x) == 0,
           what);
}

static void damage(void)
{
    for (uint32_t k = 0; k < size; ++k) {
        unsigned char *part =
            aligned_alloc(4, (k + 4) / 4 * 4); /* what is read beyond is seen by the sanitizer */
        memcpy(part, bytes, k);
        refuse(part, k, "one that was cut off is taken");
        free(part);
    }
    for (uint32_t bit = 0; bit < 8 * size; ++bit) {
        bytes[bit / 8] = (unsigned char)(bytes[bit / 8] ^ 1u << bit % 8);
        refuse(bytes, 65536, "a flipped bit is taken");
        bytes[bit / 8] = (unsigned char)(bytes[bit / 8] ^ 1u << bit % 8);
    }
}

/* Tables in RAM of both, at a speed, with voltages. */
static void compare(const hci_loop_f32 *x)
{
    static float memory[2][orders_FLOATS];
    hci_loop_tables tables[2];
    hci_loop_start(&tables[0], x, HCI_LOOP_FEEDFORWARD, memory[0]);
    hci_loop_start(&tables[1], &orders, HCI_LOOP_FEEDFORWARD, memory[1]);
    hci_loop_make(&tables[0], 200.0f);
    hci_loop_make(&tables[1], 200.0f);
    expect(memcmp(memory[0], memory[1], sizeof memory[0]) == 0, "other tables");
    for (uint32_t k = 0; k < 1000; ++k) {
        const hci_loop_reference a = hci_loop_at(&tables[0], k * 4294967u, 1.0f, 200.0f);
        const hci_loop_reference b = hci_loop_at(&tables[1], k * 4294967u, 1.0f, 200.0f);
        expect(memcmp(&a, &b, sizeof a) == 0, "other references");
    }
}

int main(int argc, char **argv)
{
    hci_loop_f32 x;
    hci_blob_facts facts;
    if (argc != 3) return 2;
    read_file(argv[1]);
    expect(hci_loop_blob_read(bytes, size, &x, &facts) == HCI_BLOB_GOOD, "a good one is refused");
    if (failures > 0) return 1;
    expect(strcmp(facts.machine, "machine_a") == 0 && facts.pole_pairs == 2, "other facts");
    expect(x.crc32 == orders.crc32 && x.response_count == orders.response_count, "other waves");
    compare(&x);
    damage();
    free(bytes);
    read_file(argv[2]);
    expect(hci_loop_blob_read(bytes, size, &x, NULL) == HCI_BLOB_OTHER_KIND, "a table is taken for orders");
    free(bytes);
    return failures > 0;
}
