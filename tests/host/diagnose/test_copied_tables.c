/* Tables of a machine in the encodings that spreadsheets save in are those of the corrected machine and of
 * the one that the diagnosis started from, in UTF-8, with nothing lost. */
#include "hci/host/report/write.h"

#include "hci/host/base/utf8.h"
#include "support/diagnosing.h"

#define TABLE                                                                                                \
    "name,value,unit,source\npole_pairs,3,1,test\nresistance,0.25,ohm,R\u00fcckseite\nconnection,star,,"     \
    "test\n"

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* Characters up to U+00FF as bytes of an encoding. */
static size_t encode(const char *text, bool wide, bool big, char *out)
{
    size_t size = 0;
    for (const unsigned char *at = (const unsigned char *)text; *at != '\0'; ++at) {
        unsigned code = *at;
        if (code >= 0xC0) code = (code & 0x1Fu) << 6 | (*++at & 0x3Fu);
        if (wide && big) out[size++] = 0;
        out[size++] = (char)code;
        if (wide && !big) out[size++] = 0;
    }
    return size;
}

static void write_bytes(const char *path, const char *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_EQUAL_UINT64(size, fwrite(bytes, 1, size, file));
    TEST_ASSERT_EQUAL_INT(0, fclose(file));
}

static void is_table(const char *path)
{
    char read[400];
    FILE *file = fopen(path, "rb");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    const size_t size = fread(read, 1, sizeof read - 1, file);
    fclose(file);
    read[size] = '\0';
    TEST_ASSERT_TRUE(hci_utf8_valid(read));
    TEST_ASSERT_EQUAL_STRING(TABLE, read);
    TEST_ASSERT_EQUAL_UINT64(strlen(TABLE), size);
}

/* Runs of 60 rad/s there and back, and their diagnosis. */
static void diagnose_and_write(void)
{
    hci_note note = {{0}};
    record(600, &(point){60.0, 2.0, 0.0, 0.02, 0.0});
    record(600, &(point){-60.0, 7.0, 0.0, -0.02, 0.0});
    (void)diagnose(NULL);
    TEST_ASSERT_EQUAL_INT_MESSAGE(
        HCI_OK, hci_diagnosis_write(&diagnosis, NULL, &runs, files_root, files_path("out"), &note),
        note.text);
}

static void copied_from(const char *mark, size_t mark_size, bool wide, bool big)
{
    char bytes[800];
    hci_machine_data corrected;
    hci_note note = {{0}};
    memcpy(bytes, mark, mark_size);
    write_bytes(files_path("machine.csv"), bytes, mark_size + encode(TABLE, wide, big, bytes + mark_size));
    hci_machine_release(&machine);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
    diagnose_and_write();
    is_table(files_path("out/machine/machine.csv"));
    is_table(files_path("out/declared/machine.csv"));
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_path("out/machine"), &corrected, &note),
                                  note.text);
    TEST_ASSERT_EQUAL_DOUBLE(0.25, corrected.resistance_ohm);
    hci_machine_release(&corrected);
}

static void test_little_endian_utf16(void)
{
    copied_from("\xFF\xFE", 2, true, false);
}

static void test_big_endian_utf16(void)
{
    copied_from("\xFE\xFF", 2, true, true);
}

static void test_latin_1(void)
{
    copied_from("", 0, false, false);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_little_endian_utf16);
    RUN_TEST(test_big_endian_utf16);
    RUN_TEST(test_latin_1);
    return UNITY_END();
}
