/* Words on a terminal: what a name has in it that would drive one is not written. */
#include "cli/terminal/text.h"

#include <stdio.h>
#include <string.h>

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void expect_shown(const char *text, const char *shown)
{
    char line[128] = "";
    FILE *stream = tmpfile();
    TEST_ASSERT_NOT_NULL(stream);
    cli_print_wrapped(stream, 80, 0, 0, text);
    rewind(stream);
    TEST_ASSERT_NOT_NULL(fgets(line, sizeof line, stream));
    fclose(stream);
    line[strcspn(line, "\n")] = '\0';
    TEST_ASSERT_EQUAL_STRING(shown, line);
}

/* ESC; the same [ in one character, U+009B, which some terminals obey too; bytes that are no UTF-8. */
static void test_control_characters_are_masked(void)
{
    expect_shown("a\033[31mb", "a?[31mb");
    expect_shown("a\xC2\x9B"
                 "31mb",
                 "a?31mb");
    expect_shown("a\x9B\xC3", "a??");
    expect_shown("Ωm, ½ \x7F", "Ωm, ½ ?");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_control_characters_are_masked);
    return UNITY_END();
}
