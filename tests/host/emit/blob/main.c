/* Reads emitted blobs as a device does: good ones give the currents of the compiled table to the last bit;
 * one that is cut off at any byte, has any bit flipped, is newer, of another kind or not in place is refused
 * and leaves the table as it was. main F32.bin I16.bin */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/blob.h"
#include "rows.h"
#include "small.h"

static unsigned char *bytes;
static uint32_t size;
static int failures;

static void expect(int good, const char *what)
{
    if (good) return;
    fprintf(stderr, "blob: %s\n", what);
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

/* Points a table of either kind at memory. *touched: whether the table was written. */
static hci_blob_verdict table_of(hci_blob_kind kind, const void *blob, uint32_t room, int *touched)
{
    static hci_table_f32 f32;
    static hci_table_i16 i16;
    hci_blob_verdict verdict;
    f32.points = 12345;
    i16.intervals = 12345;
    verdict = kind == HCI_BLOB_F32 ? hci_blob_table_f32(blob, room, &f32, NULL)
                                   : hci_blob_table_i16(blob, room, &i16, NULL);
    *touched = f32.points != 12345 || i16.intervals != 12345;
    return verdict;
}

static void refuse(hci_blob_kind kind, const void *blob, uint32_t room, const char *what)
{
    int touched;
    const hci_blob_verdict verdict = table_of(kind, blob, room, &touched);
    expect(verdict != HCI_BLOB_GOOD && !touched, what);
}

static void expect_verdict(hci_blob_kind kind, hci_blob_verdict expected, const char *what)
{
    int touched;
    expect(table_of(kind, bytes, 65536, &touched) == expected, what);
}

static void set_crc(void)
{
    const uint32_t crc = hci_blob_crc32(bytes, size - 4);
    for (uint32_t k = 0; k < 4; ++k)
        bytes[size - 4 + k] = (unsigned char)(crc >> 8 * k & 255u);
}

static void damage(hci_blob_kind kind)
{
    for (uint32_t k = 0; k < size; ++k) {
        unsigned char *part =
            aligned_alloc(4, (k + 4) / 4 * 4); /* what is read beyond is seen by the sanitizer */
        memcpy(part, bytes, k);
        refuse(kind, part, k, "a blob that was cut off is taken");
        free(part);
    }
    for (uint32_t bit = 0; bit < 8 * size; ++bit) {
        bytes[bit / 8] = (unsigned char)(bytes[bit / 8] ^ 1u << bit % 8);
        refuse(kind, bytes, 65536, "a flipped bit is taken");
        bytes[bit / 8] = (unsigned char)(bytes[bit / 8] ^ 1u << bit % 8);
    }
    memmove(bytes + 2, bytes, size);
    refuse(kind, bytes + 2, 65534, "a blob that is not in place is taken");
    memmove(bytes, bytes + 2, size);
    expect_verdict(kind == HCI_BLOB_F32 ? HCI_BLOB_I16 : HCI_BLOB_F32, HCI_BLOB_OTHER_KIND,
                   "another kind is taken");
    bytes[4] = 2;
    expect_verdict(kind, HCI_BLOB_NEWER, "a newer version is taken");
    bytes[4] = 1;
    bytes[56] = (unsigned char)(bytes[56] + 1); /* one row more than there is, with a CRC that is right */
    set_crc();
    refuse(kind, bytes, 65536, "numbers that contradict each other are taken");
    bytes[56] = (unsigned char)(bytes[56] - 1);
    bytes[HCI_BLOB_HEAD] = (unsigned char)(bytes[HCI_BLOB_HEAD] ^ 1u);
    set_crc();
    expect_verdict(kind, HCI_BLOB_UNFIT, "rows whose own sum or CRC is another are taken");
    bytes[HCI_BLOB_HEAD] = (unsigned char)(bytes[HCI_BLOB_HEAD] ^ 1u);
    set_crc();
    memset(bytes + size, 0x5A, 100);
    expect_verdict(kind, HCI_BLOB_GOOD, "a good blob in larger memory is refused");
}

static void expect_facts(const hci_blob_facts *facts)
{
    expect(strcmp(facts->machine, "machine_a") == 0 && facts->pole_pairs == 2, "other facts");
    expect(facts->mean_torque_Nm > 2.462f && facts->mean_torque_Nm < 2.464f, "another torque");
}

static void check_f32(const char *path)
{
    hci_table_f32 table;
    hci_blob_facts facts;
    read_file(path);
    expect(hci_blob_table_f32(bytes, size, &table, &facts) == HCI_BLOB_GOOD, "a good blob is refused");
    expect_facts(&facts);
    for (uint32_t k = 0; k < 65536; ++k) {
        float a[3], b[3];
        hci_table_f32_currents(&table, k * 65537u, 1.0f, a);
        hci_table_f32_currents(&rows, k * 65537u, 1.0f, b);
        expect(memcmp(a, b, sizeof a) == 0, "other currents");
    }
    damage(HCI_BLOB_F32);
    free(bytes);
}

static void check_i16(const char *path)
{
    hci_table_i16 table;
    hci_blob_facts facts;
    read_file(path);
    expect(hci_blob_table_i16(bytes, size, &table, &facts) == HCI_BLOB_GOOD, "a good blob is refused");
    expect_facts(&facts);
    for (uint32_t k = 0; k < 65536; ++k) {
        int16_t a[3], b[3];
        hci_table_i16_currents_q15(&table, k * 65537u, 12345, a);
        hci_table_i16_currents_q15(&small, k * 65537u, 12345, b);
        expect(memcmp(a, b, sizeof a) == 0, "other currents");
    }
    damage(HCI_BLOB_I16);
    free(bytes);
}

int main(int argc, char **argv)
{
    if (argc != 3) return 2;
    check_f32(argv[1]);
    check_i16(argv[2]);
    return failures > 0;
}
