/* ZIP archives, byte by byte after APPNOTE.TXT of PKWARE, and how much they hold. */
#include "host/fmu/zip.h"

#include <stdio.h>
#include <string.h>

#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

enum { MOST = 512 };

static unsigned char bytes[MOST];
static hci_note note;

void setUp(void)
{
    files_begin();
    memset(&note, 0, sizeof note);
}

void tearDown(void)
{
    files_end();
}

static hci_status write_archive(const hci_zip_entry *entry, size_t count)
{
    hci_output *out;
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_open(files_path("out"), &out, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_file(out, "a.zip", &note));
    const hci_status status = hci_zip_write(out, entry, count, &note);
    if (status)
        hci_output_discard(out);
    else
        TEST_ASSERT_EQUAL(HCI_OK, hci_output_commit(out, &note));
    return status;
}

static size_t read_archive(void)
{
    FILE *file = fopen(files_path("out/a.zip"), "rb");
    TEST_ASSERT_NOT_NULL(file);
    const size_t size = fread(bytes, 1, MOST, file);
    fclose(file);
    return size;
}

/* Two files: "hello\\n" has the CRC-32 0x363A3020, and nothing has 0. */
static void test_two_files(void)
{
    static const hci_zip_entry ENTRY[] = {{"a/b.txt", "hello\n", 6}, {"c", "", 0}};
    static const unsigned char EXPECTED[] = {
        /* local header, at 0 */
        'P', 'K', 3, 4, 20, 0, 0, 8, 0, 0, 0, 0, 33, 0, 0x20, 0x30, 0x3A, 0x36, 6, 0, 0, 0, 6, 0, 0, 0, 7, 0,
        0, 0, 'a', '/', 'b', '.', 't', 'x', 't', 'h', 'e', 'l', 'l', 'o', '\n',
        /* the second one, at 43 */
        'P', 'K', 3, 4, 20, 0, 0, 8, 0, 0, 0, 0, 33, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 'c',
        /* central directory, at 74: of a file 0100644 made on Unix */
        'P', 'K', 1, 2, 20, 3, 20, 0, 0, 8, 0, 0, 0, 0, 33, 0, 0x20, 0x30, 0x3A, 0x36, 6, 0, 0, 0, 6, 0, 0, 0,
        7, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xA4, 0x81, 0, 0, 0, 0, 'a', '/', 'b', '.', 't', 'x', 't', 'P',
        'K', 1, 2, 20, 3, 20, 0, 0, 8, 0, 0, 0, 0, 33, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0,
        0, 0, 0, 0, 0, 0, 0, 0xA4, 0x81, 43, 0, 0, 0, 'c',
        /* its end: two entries, 100 bytes from 74 on */
        'P', 'K', 5, 6, 0, 0, 0, 0, 2, 0, 2, 0, 100, 0, 0, 0, 74, 0, 0, 0, 0, 0};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, write_archive(ENTRY, 2), note.text);
    TEST_ASSERT_EQUAL_UINT64(sizeof EXPECTED, read_archive());
    TEST_ASSERT_EQUAL_UINT8_ARRAY(EXPECTED, bytes, sizeof EXPECTED);
}

/* 65535 entries, and 2³² − 1 bytes with all headers and names. */
static void test_too_much(void)
{
    static hci_zip_entry many[65536];
    for (size_t k = 0; k < 65536; ++k)
        many[k] = (hci_zip_entry){"n", "", 0};
    TEST_ASSERT_EQUAL(HCI_OK, write_archive(many, 65535));
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, write_archive(many, 65536));
    text_has("too much for one archive: 65536 files", note.text);
    const hci_zip_entry large = {"name", "", 0xFFFFFFFFu - (30 + 4) - (46 + 4) + 1u};
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, write_archive(&large, 1)); /* refused before a byte of it is read */
    text_has("too much for one archive: 1 files", note.text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_two_files);
    RUN_TEST(test_too_much);
    return UNITY_END();
}
