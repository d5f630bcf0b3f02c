/* Notes and remarks: the first error stays, what is too long ends between two characters, memory that is out.
 */
#include "hci/host/base/note.h"

#include <string.h>

#include "hci/host/base/utf8.h"
#include "host/base/quote.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_the_first_error_wins(void)
{
    hci_note note = {0};
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_note_set(&note, HCI_ERROR_INPUT, "%s", "first"));
    TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY, hci_note_set(&note, HCI_ERROR_MEMORY, "second"));
    TEST_ASSERT_EQUAL_STRING("first", note.text);
    TEST_ASSERT_EQUAL(HCI_ERROR_OUTPUT, hci_note_set(NULL, HCI_ERROR_OUTPUT, "nowhere"));
}

/* The cut may fall on any byte of "é", and half a character must not be left. */
static void test_a_note_is_cut_between_characters(void)
{
    static char text[2 * HCI_NOTE_SIZE + 1];
    for (size_t k = 0; k < HCI_NOTE_SIZE; k++)
        memcpy(text + 2 * k, "\xC3\xA9", 2);
    for (size_t shift = 0; shift < 2; shift++) {
        hci_note note = {0};
        hci_note_set(&note, HCI_ERROR_INPUT, "%.*s%s", (int)shift, "x", text);
        TEST_ASSERT_TRUE(hci_utf8_valid(note.text));
        TEST_ASSERT_EQUAL(shift + (HCI_NOTE_SIZE - 1 - shift) / 2 * 2, strlen(note.text));
    }
}

static void test_a_long_path_keeps_its_end(void)
{
    char path[4096], out[HCI_QUOTE_PATH_SIZE];
    memset(path, 'a', sizeof path);
    memcpy(path + sizeof path - 9, "/run.csv", 9);
    hci_quote_path(path, out);
    TEST_ASSERT_EQUAL_STRING("/run.csv", out + strlen(out) - 8);
    TEST_ASSERT_EQUAL_STRING_LEN("\xE2\x80\xA6", out, 3);
}

/* Words of a command line and names out of files are quoted as they stand: none may drive a terminal or spoil
 * JSON. */
static void test_what_would_drive_a_terminal_is_masked(void)
{
    hci_note note = {0}, remark = {{0}};
    hci_note_set(&note, HCI_ERROR_INPUT, "unknown `%s`", "a\033[31m\x7F\xC2\x9B\xFF\xC3\xA9");
    TEST_ASSERT_EQUAL_STRING("unknown `a?[31m????\xC3\xA9`", note.text);
    hci_note_add(&remark, "%s", "\x15");
    TEST_ASSERT_EQUAL_STRING("?", remark.text);
}

/* "; ≤" is five bytes: behind one to five others the end falls into the letter one way or another. */
static void test_a_full_remark_ends_with_a_whole_letter(void)
{
    for (int shift = 1; shift <= 5; ++shift) {
        hci_note remark = {{0}};
        hci_note_add(&remark, "%.*s", shift, "abcde");
        for (int k = 0; k < 400; ++k)
            hci_note_add(&remark, "≤");
        const size_t length = strlen(remark.text);
        TEST_ASSERT_TRUE(length > HCI_NOTE_SIZE - 8 && length < HCI_NOTE_SIZE);
        const char *last = remark.text + length - 1;
        TEST_ASSERT_TRUE(*last == ' ' || *last == ';' || strcmp(remark.text + length - 3, "≤") == 0);
    }
}

static void test_what_memory_was_for_is_said_with_its_file(void)
{
    hci_note note = {0}, beside = {0};
    TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY, hci_note_memory(&note, NULL, "%d rows", 7));
    TEST_ASSERT_EQUAL_STRING("out of memory for 7 rows", note.text);
    TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY, hci_note_memory(&beside, "a/run.csv", "reading it"));
    TEST_ASSERT_EQUAL_STRING("a/run.csv: out of memory for reading it", beside.text);
    TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY, hci_note_memory(NULL, NULL, "nothing"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_first_error_wins);
    RUN_TEST(test_a_note_is_cut_between_characters);
    RUN_TEST(test_a_long_path_keeps_its_end);
    RUN_TEST(test_what_would_drive_a_terminal_is_masked);
    RUN_TEST(test_a_full_remark_ends_with_a_whole_letter);
    RUN_TEST(test_what_memory_was_for_is_said_with_its_file);
    return UNITY_END();
}
