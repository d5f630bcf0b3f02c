/* Sentences in a text of fixed size: appended, and cut behind a whole character. */
#include "host/base/words.h"

#include <string.h>

#include "hci/host/base/utf8.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_words_are_appended(void)
{
    char text[32] = "";
    const hci_words words = {text, sizeof text};
    hci_words_say(&words, "%s.", "Falls");
    hci_words_say(&words, " By %d.", 3);
    TEST_ASSERT_EQUAL_STRING("Falls. By 3.", text);
}

/* Whatever the size, what is kept is the beginning, whole characters, and nothing behind the end is written.
 */
static void test_what_has_no_room_is_cut_behind_a_character(void)
{
    static const char full[] = "0.1 N\xC2\xB7m, 95 \xE2\x89\xA4 \xF0\x9F\x94\xA7";
    for (size_t size = 1; size <= sizeof full; ++size) {
        char text[sizeof full + 1] = "";
        text[size] = 'x';
        hci_words_say(&(hci_words){text, size}, "%s", "0.1 N\xC2\xB7m");
        hci_words_say(&(hci_words){text, size}, "%s", full + strlen("0.1 N\xC2\xB7m"));
        TEST_ASSERT_EQUAL('x', text[size]);
        TEST_ASSERT_LESS_THAN(size, strlen(text));
        TEST_ASSERT_TRUE(hci_utf8_valid(text));
        TEST_ASSERT_TRUE(strncmp(full, text, strlen(text) < 5 ? strlen(text) : 5) == 0);
    }
    char text[sizeof full] = "";
    hci_words_say(&(hci_words){text, sizeof text}, "%s", full);
    TEST_ASSERT_EQUAL_STRING(full, text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_words_are_appended);
    RUN_TEST(test_what_has_no_room_is_cut_behind_a_character);
    return UNITY_END();
}
