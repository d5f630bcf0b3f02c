/* Texts in other encodings: which they are in, and what they are in UTF-8. */
#include "host/csv/encoding.h"

#include <string.h>

#include "host/base/memory.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void is_in(hci_encoding expected, const char *bytes, size_t size)
{
    TEST_ASSERT_EQUAL_MESSAGE(expected, hci_encoding_of(bytes, size), bytes);
}

#define IS_IN(expected, bytes) is_in(expected, bytes, sizeof bytes - 1)

/* By its mark, or by zeros in every second byte of the first four of an even number. */
static void test_utf16(void)
{
    IS_IN(HCI_ENCODING_UTF16_LITTLE, "\xFF\xFE");
    IS_IN(HCI_ENCODING_UTF16_BIG, "\xFE\xFF");
    IS_IN(HCI_ENCODING_UTF16_LITTLE, "a\0b\0");
    IS_IN(HCI_ENCODING_UTF16_BIG, "\0a\0b");
    IS_IN(HCI_ENCODING_UTF8, "a\0b\0c");
    IS_IN(HCI_ENCODING_UTF8, "a\0bc");
    IS_IN(HCI_ENCODING_UTF8, "ab\0c");
    IS_IN(HCI_ENCODING_UTF8, "\0ab\0");
    IS_IN(HCI_ENCODING_UTF8, "\0a\0\0");
    IS_IN(HCI_ENCODING_UTF8, "\0\0\0a");
    IS_IN(HCI_ENCODING_UTF8, "a\0\0\0");
    IS_IN(HCI_ENCODING_UTF8, "\0\0b\0");
    IS_IN(HCI_ENCODING_UTF8, "a\0");
}

static void test_bytes(void)
{
    IS_IN(HCI_ENCODING_UTF8, "");
    IS_IN(HCI_ENCODING_UTF8, "N\xC2\xB7m \xE2\x82\xAC");
    IS_IN(HCI_ENCODING_WINDOWS_1252, "N\xB7m");
    IS_IN(HCI_ENCODING_WINDOWS_1252, "N\xB7m\t\r\n\f\v");
    IS_IN(HCI_ENCODING_OTHER, "N\xB7m\x01");
    IS_IN(HCI_ENCODING_OTHER, "N\xB7m\x1F");
    IS_IN(HCI_ENCODING_OTHER, "N\xB7m \x81");
    IS_IN(HCI_ENCODING_OTHER, "N\xB7m \xC2\xB7");
    IS_IN(HCI_ENCODING_UTF8, "N\xC2\xB7m\0\xB7"); /* up to a NUL byte */
    IS_IN(HCI_ENCODING_OTHER, "\0\xB7m");         /* which is not the first */
}

static void becomes(hci_encoding encoding, const char *bytes, size_t size, const char *expected)
{
    char *text = hci_encoding_to_utf8(encoding, bytes, &size);
    TEST_ASSERT_NOT_NULL(text);
    TEST_ASSERT_EQUAL_STRING(expected, text);
    TEST_ASSERT_EQUAL_UINT64(strlen(expected), size);
    hci_memory_free(text);
}

/* Of Windows-1252 the bytes from 0xA0 on are Unicode, and those before are in a list. */
static void test_windows_1252(void)
{
    static const char *const LIST[32] = {
        "\xE2\x82\xAC", NULL,           "\xE2\x80\x9A", "\xC6\x92",     "\xE2\x80\x9E", "\xE2\x80\xA6",
        "\xE2\x80\xA0", "\xE2\x80\xA1", "\xCB\x86",     "\xE2\x80\xB0", "\xC5\xA0",     "\xE2\x80\xB9",
        "\xC5\x92",     NULL,           "\xC5\xBD",     NULL,           NULL,           "\xE2\x80\x98",
        "\xE2\x80\x99", "\xE2\x80\x9C", "\xE2\x80\x9D", "\xE2\x80\xA2", "\xE2\x80\x93", "\xE2\x80\x94",
        "\xCB\x9C",     "\xE2\x84\xA2", "\xC5\xA1",     "\xE2\x80\xBA", "\xC5\x93",     NULL,
        "\xC5\xBE",     "\xC5\xB8"};
    for (int byte = 1; byte < 256; ++byte) {
        const char bytes[2] = {(char)byte, 'z'};
        char expected[8];
        if (byte < 0x80) {
            expected[0] = (char)byte, expected[1] = '\0';
        } else if (byte < 0xA0) {
            const char *listed = LIST[byte - 0x80];
            if (listed == NULL) {
                is_in(HCI_ENCODING_OTHER, bytes, 2);
                continue;
            }
            strcpy(expected, listed);
        } else {
            expected[0] = (char)(byte < 0xC0 ? 0xC2 : 0xC3);
            expected[1] = (char)(byte < 0xC0 ? byte : byte - 0x40);
            expected[2] = '\0';
        }
        strcat(expected, "z");
        becomes(HCI_ENCODING_WINDOWS_1252, bytes, 2, expected);
    }
}

/* One, two, three and four bytes; halves of pairs are replaced, and an odd byte at the end is lost. */
static void test_characters_of_utf16(void)
{
    static const char LITTLE[] = "\xFF\xFE"
                                 "\x7F\0\x80\0\xFF\x07\0\x08\xFF\xFF\x3D\xD8\0\xDE\xFF\xDB\xFF\xDF"
                                 "a\0q",
                      EXPECTED[] =
                          "\x7F\xC2\x80\xDF\xBF\xE0\xA0\x80\xEF\xBF\xBF\xF0\x9F\x98\x80\xF4\x8F\xBF\xBF"
                          "a";
    char big[sizeof LITTLE];
    becomes(HCI_ENCODING_UTF16_LITTLE, LITTLE, sizeof LITTLE - 1, EXPECTED);
    for (size_t k = 0; k + 1 < sizeof LITTLE; k += 2)
        big[k] = LITTLE[k + 1], big[k + 1] = LITTLE[k];
    becomes(HCI_ENCODING_UTF16_BIG, big, sizeof LITTLE - 2, EXPECTED);
    becomes(HCI_ENCODING_UTF16_BIG, "\0a\0b", 4, "ab"); /* without a mark */
    becomes(HCI_ENCODING_UTF16_BIG, "\xD8\x3D\0a", 4,
            "\xEF\xBF\xBD"
            "a");
    becomes(HCI_ENCODING_UTF16_BIG, "\0a\xD8\x3D", 4, "a\xEF\xBF\xBD");
    becomes(HCI_ENCODING_UTF16_BIG, "\0a\xDC\0\xDE\0", 6, "a\xEF\xBF\xBD\xEF\xBF\xBD");
    becomes(HCI_ENCODING_UTF16_BIG, "\xD8\0\xE0\0", 4, "\xEF\xBF\xBD\xEE\x80\x80");
    becomes(HCI_ENCODING_UTF16_BIG, "\xD7\xFF\xD8\0\xDC\0", 6, "\xED\x9F\xBF\xF0\x90\x80\x80");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_utf16);
    RUN_TEST(test_bytes);
    RUN_TEST(test_windows_1252);
    RUN_TEST(test_characters_of_utf16);
    return UNITY_END();
}
