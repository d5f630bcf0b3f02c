/* UTF-8: which bytes are a character, and which one (RFC 3629). */
#include "hci/host/base/utf8.h"

#include <string.h>

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* All characters of one to three bytes, encoded here by the table of the RFC, and some of four. */
static void test_every_character_is_decoded(void)
{
    for (uint32_t code = 1; code <= 0x10FFFF; code += code < 0x10000 ? 1 : 257) {
        char text[5] = "";
        uint32_t back = 0;
        const size_t length = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
        if (code >= 0xD800 && code <= 0xDFFF) continue;
        if (length == 1) text[0] = (char)code;
        if (length == 2) text[0] = (char)(0xC0 + code / 64);
        if (length == 3) text[0] = (char)(0xE0 + code / 4096);
        if (length == 4) text[0] = (char)(0xF0 + code / 262144);
        if (length >= 2) text[length - 1] = (char)(0x80 + code % 64);
        if (length >= 3) text[length - 2] = (char)(0x80 + code / 64 % 64);
        if (length == 4) text[1] = (char)(0x80 + code / 4096 % 64);
        TEST_ASSERT_EQUAL_UINT(length, hci_utf8_decode(text, &back));
        TEST_ASSERT_EQUAL_HEX32(code, back);
        TEST_ASSERT_TRUE(hci_utf8_begins(text[0]));
        for (size_t k = 1; k < length; ++k)
            TEST_ASSERT_FALSE(hci_utf8_begins(text[k]));
    }
}

static void test_utf8_is_told_from_other_bytes(void)
{
    static const char *const yes[] = {"",
                                      "a",
                                      "\xC2\x80",
                                      "\xDF\xBF",
                                      "\xE0\xA0\x80",
                                      "\xEF\xBF\xBF",
                                      "\xF0\x90\x80\x80",
                                      "\xF4\x8F\xBF\xBF"};
    static const char *const no[] = {"\x80",
                                     "\xC1\xBF",
                                     "\xC2",
                                     "\xC2x",
                                     "\xE0\x9F\xBF",
                                     "\xED\xA0\x80",
                                     "\xF0\x8F\xBF\xBF",
                                     "\xF4\x90\x80\x80",
                                     "\xF8\x88\x80\x80\x80",
                                     "\xFF",
                                     "\xE2\x82"};
    for (size_t k = 0; k < sizeof yes / sizeof *yes; k++)
        TEST_ASSERT_TRUE_MESSAGE(hci_utf8_valid(yes[k]), yes[k]);
    for (size_t k = 0; k < sizeof no / sizeof *no; k++)
        TEST_ASSERT_FALSE_MESSAGE(hci_utf8_valid(no[k]), no[k]);
}

typedef struct {
    const char *name, *bytes;
} broken;

static void test_what_is_no_character_has_length_0(void)
{
    static const broken BROKEN[] = {
        {"ends after one of two", "\xC3"},
        {"ends after two of three", "\xE2\x82"},
        {"ends after three of four", "\xF0\x9F\x98"},
        {"goes on with a letter", "\xE2\x82"
                                  "a"},
        {"begins in the middle", "\xA9"},
        {"NUL in two bytes", "\xC0\x80"},
        {"a slash in two bytes", "\xC0\xAF"},
        {"a slash in three bytes", "\xE0\x80\xAF"},
        {"a slash in four bytes", "\xF0\x80\x80\xAF"},
        {"first surrogate", "\xED\xA0\x80"},
        {"last surrogate", "\xED\xBF\xBF"},
        {"above the last character", "\xF4\x90\x80\x80"},
        {"five bytes", "\xF8\x88\x80\x80\x80"},
    };
    for (size_t k = 0; k < sizeof BROKEN / sizeof *BROKEN; ++k) {
        TEST_ASSERT_EQUAL_UINT_MESSAGE(0, hci_utf8_length(BROKEN[k].bytes), BROKEN[k].name);
        TEST_ASSERT_FALSE_MESSAGE(hci_utf8_valid(BROKEN[k].bytes), BROKEN[k].name);
    }
}

static void test_the_neighbours_of_surrogates_are_characters(void)
{
    uint32_t code;
    TEST_ASSERT_EQUAL_UINT(3, hci_utf8_decode("\xED\x9F\xBF", &code));
    TEST_ASSERT_EQUAL_HEX32(0xD7FF, code);
    TEST_ASSERT_EQUAL_UINT(3, hci_utf8_decode("\xEE\x80\x80", &code));
    TEST_ASSERT_EQUAL_HEX32(0xE000, code);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_character_is_decoded);
    RUN_TEST(test_utf8_is_told_from_other_bytes);
    RUN_TEST(test_what_is_no_character_has_length_0);
    RUN_TEST(test_the_neighbours_of_surrogates_are_characters);
    return UNITY_END();
}
