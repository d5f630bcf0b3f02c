/* Texts of users in messages: how long they get, and that nothing in them drives a terminal. */
#include "host/base/quote.h"

#include <stdio.h>
#include <string.h>

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void is_quoted(const char *text, const char *expected)
{
    char out[HCI_QUOTE_SIZE];
    TEST_ASSERT_EQUAL_STRING_MESSAGE(expected, hci_quote(text, out), text);
}

static void test_control_characters(void)
{
    is_quoted("", "``");
    is_quoted("a b", "`a b`");
    is_quoted("\x1f \x20", "`\\x1f  `");
    is_quoted("\x7e\x7f\n", "`~\\x7f\\x0a`");
    is_quoted("\xC2\x9F\xC2\xA0x", "`\\xc2\\x9f\xC2\xA0x`");
    is_quoted("\xC3\x80\xE2\x82\xAC", "`\xC3\x80\xE2\x82\xAC`");
    is_quoted("\xFFz\xE2\x82", "`\\xffz\\xe2\\x82`");
}

/* Behind as much as there is room for stands an ellipsis. */
static void test_long_texts(void)
{
    char out[HCI_QUOTE_SIZE], text[2 * HCI_QUOTE_SIZE];
    const size_t most = HCI_QUOTE_SIZE - 6; /* quotes, an ellipsis of three bytes and NUL */
    for (size_t length = most; length <= most + 1; ++length) {
        memset(text, 'x', length);
        text[length] = '\0';
        hci_quote(text, out);
        TEST_ASSERT_EQUAL(length > most, strstr(out, "\xE2\x80\xA6`") != NULL);
        TEST_ASSERT_EQUAL_UINT64(length > most ? HCI_QUOTE_SIZE - 1 : most + 2, strlen(out));
    }
    for (size_t before = 0; before < 4; ++before) { /* no character is cut */
        memset(text, 'x', most - 1 - before);
        strcpy(text + most - 1 - before, "\xE2\x82\xAC\xE2\x82\xAC");
        hci_quote(text, out);
        TEST_ASSERT_EQUAL_UINT64(before >= 2 ? 1 : 0, strstr(out, "\xE2\x82\xAC\xE2\x80\xA6`") != NULL);
    }
}

/* Of a long path the end is kept, from the beginning of a character on. */
static void test_long_paths(void)
{
    char out[HCI_QUOTE_PATH_SIZE], path[2 * HCI_QUOTE_PATH_SIZE];
    const size_t keep = HCI_QUOTE_PATH_SIZE / 2;
    for (size_t length = keep; length <= keep + 1; ++length) {
        for (size_t k = 0; k < length; ++k)
            path[k] = (char)('a' + k % 26);
        path[length] = '\0';
        hci_quote_path(path, out);
        TEST_ASSERT_EQUAL_STRING(path + length - keep, out + (length > keep ? 3 : 0));
        TEST_ASSERT_EQUAL(length > keep, strncmp(out, "\xE2\x80\xA6", 3) == 0);
    }
    memset(path, 'x', keep + 9);
    path[keep + 9] = '\0';
    memcpy(path + 8, "\xE2\x82\xAC", 3); /* whose second byte the path would begin with */
    hci_quote_path(path, out);
    TEST_ASSERT_EQUAL_STRING(path + 11, out + 3);
}

/* Byte by byte where it is no text, one mark a character where it is. */
static void test_masks(void)
{
    char text[] = "a\x01\xC2\x9F"
                  "b\xFF\xC3\x80";
    hci_quote_mask(text);
    TEST_ASSERT_EQUAL_STRING("a???b?\xC3\x80", text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_control_characters);
    RUN_TEST(test_long_texts);
    RUN_TEST(test_long_paths);
    RUN_TEST(test_masks);
    return UNITY_END();
}
