/* Tables whose columns stand apart by blanks, and headers that begin with #. */
#include "host/csv/blanks.h"

#include <stdio.h>
#include <string.h>

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void becomes(const char *text, const char *expected)
{
    char changed[4096];
    snprintf(changed, sizeof changed, "%s", text);
    hci_csv_prepare(changed);
    TEST_ASSERT_EQUAL_STRING_MESSAGE(expected, changed, text);
}

static void stays(const char *text)
{
    becomes(text, text);
}

static void test_runs_of_blanks_become_tabs(void)
{
    becomes("a b\n0 1\n2 3\n", "a\tb\n0\t1\n2\t3\n");
    becomes("  a   b  \n  0    1 \r\n2 3", "a\tb\n0\t1\r\n2\t3");
    becomes("a b c\ns A V\n0 1 2\n", "a\tb\tc\ns\tA\tV\n0\t1\t2\n");
    becomes("note\n\na b\n0 1\n", "note\n\na\tb\n0\t1\n");
    becomes("a b\n# any note here\n0 1\n", "a\tb\n# any note here\n0\t1\n");
    becomes("\"a x\" b\n0 1\n", "\"a x\"\tb\n0\t1\n");
}

/* Names that hold a blank stand apart by two or more; numbers do not have to. */
static void test_names_with_blanks(void)
{
    becomes("time  iq current\n0 1\n2 3\n", "time\tiq current\n0\t1\n2\t3\n");
    becomes("time  iq current   lamp\n0  1 2\n", "time\tiq current\tlamp\n0\t1\t2\n");
}

static void test_what_is_no_such_table(void)
{
    stays("a,b\n0,1\n");
    stays("a;b c\n0 1\n");
    stays("a\tb\n0 1\n");
    stays("a b\n0 1 2\n");
    stays("a b\n0 x\n");
    stays("a b\nx y\nz w\n");
    stays("a 2\n0 1\n");
    stays("a\n0\n");
    stays("a b\n");
    stays("");
}

/* In the first 64 lines. */
static void test_how_far_a_header_is_looked_for(void)
{
    for (int lines = 63; lines <= 64; ++lines) {
        char text[1000] = "", expected[1100];
        for (int k = 0; k < lines; ++k)
            strcat(text, "note\n");
        snprintf(expected, sizeof expected, "%s%s", text, lines == 63 ? "a\tb\n0\t1\n" : "a b\n0 1\n");
        strcat(text, "a b\n0 1\n");
        becomes(text, expected);
    }
}

/* The last comment before rows of numbers alone, if it has as many names. */
static void test_headers_in_comments(void)
{
    becomes("# a,b\n0,1\n", "  a,b\n0,1\n");
    becomes("# note\n # a;b\n0;1\n2;3\n", "# note\n   a;b\n0;1\n2;3\n");
    becomes("#a\tb\n0\t1\n", " a\tb\n0\t1\n");
    becomes("# a b\n0 1\n2 3\n", "a\tb\n0\t1\n2\t3\n");
    becomes("# the time  iq\n0 1\n", "the time\tiq\n0\t1\n");
    becomes("# a,b\n\n0,1\n", "  a,b\n\n0,1\n");
    stays("# a,b,c\n0,1\n");
    stays("# a,b\nx,1\n");
    stays("# a,2\n0,1\n");
    stays("# a\n0\n");
    stays("# a,b\n");
    stays("c,d\n# a,b\n0,1\n");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_runs_of_blanks_become_tabs);
    RUN_TEST(test_names_with_blanks);
    RUN_TEST(test_what_is_no_such_table);
    RUN_TEST(test_how_far_a_header_is_looked_for);
    RUN_TEST(test_headers_in_comments);
    return UNITY_END();
}
