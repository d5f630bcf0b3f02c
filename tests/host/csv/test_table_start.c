/* Where a table begins in a file, which character separates its cells, and rows that have no header. */
#include <stdio.h>
#include <string.h>

#include "host/csv/table.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* The most frequent outside quotes in the first line; of as many the tab, and then the semicolon. */
static void test_separators(void)
{
    static const struct {
        const char *line;
        char separator;
    } CASES[] = {{"a,b", ','},
                 {"a;b", ';'},
                 {"a\tb", '\t'},
                 {"a;b,c", ';'},
                 {"a,b,c;d", ','},
                 {"a\tb;c,d", '\t'},
                 {"a;b;c\td", ';'},
                 {"a,b,c\td", ','},
                 {"\"a;b;c\",d", ','},
                 {"a,b\n;;;", ','},
                 {"a,b\r;;;", ','},
                 {"abc", ','},
                 {"", ','},
                 {"\"a\n;b\",c", ','},
                 {"\"a\r\nb\",c;d;e", ';'},
                 {"a\tb\tc;d,e,f", '\t'}};
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k)
        TEST_ASSERT_EQUAL_INT8_MESSAGE(CASES[k].separator, hci_csv_separator(CASES[k].line), CASES[k].line);
}

/* text: its table begins at `|`, which is not part of it. */
static void check(const char *marked, bool has_foreword)
{
    char text[4096];
    bool found;
    const char *mark = strchr(marked, '|');
    const size_t at = (size_t)(mark - marked);
    snprintf(text, sizeof text, "%.*s%s", (int)at, marked, mark + 1);
    const char *start = hci_csv_table_start(text, &found);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(at, (size_t)(start - text), marked);
    TEST_ASSERT_EQUAL_MESSAGE(has_foreword, found, marked);
}

static void test_tables_at_the_first_line(void)
{
    check("|time_s,iq_A\n0,1\n1,2\n", false);
    check("# note\n\n \t\n,;,\n  # more\n|time_s,iq_A\n0,1\n1,2\n", false);
    check("|lamp\n1\n2\n", false);
    check("|", false);
    check("|only words\nand more\n", false);
}

/* Behind lines about something else. */
static void test_tables_behind_a_foreword(void)
{
    check("Logger 5\nSerial: 12\n\n|time_s,iq_A\n0,1\n1,2\n", true);
    check("Logger 5\r\n|time_s;iq_A\r\n0;1\r\n1;2\r\n", true);
    check("Logger 5\r|time_s;iq_A\r0;1\r1;2\r", true);
    check("Logger 5\n|time,iq\ns,A\n0,1\n1,2\n", true);
    check("Logger 5\n|time,iq\n-,A\n0,1\n1,2\n", true);
    check("Logger 5\n|time_s,iq_A\n0,1\n", true); /* one row */
    check("Logger 5\n|time_s,iq_A\n# note\n0,1\n\n1,2\n", true);
    check("Logger 5\n|a,b,c,,\n0,1,2\n1,2,3\n", true);    /* empty cells behind the last name */
    check("Logger 5\n|a,b,c,d\n0,1,2,\n1,2,x,3\n", true); /* three numbers of four names */
    check("Logger 5\n|\"a;b\",c\n0,1\n1,2\n", true);
    check("Name,Value\nby,someone\n|time_s,iq_A\n0,1\n1,2\n", true);
    check("time_s,iq_A\nfoo,3\n|speed_rpm,id_A,lamp\n0,1,2\n1,2,3\n", true); /* of another length */
}

/* The last line, where it is the longest and two of its names are known; units may follow. */
static void test_a_header_without_rows(void)
{
    check("Logger 5\n|time_s,iq_A\n", true);
    check("Logger 5\n|time,iq\ns,A\n\n# end\n", true);
    check("Bench 3;Motor A;12.03.2026;;\n|Zeit [ms];Winkel [\xC2\xB0];I_U [A];I_V [A]\n", true);
    check("|time_s,iq_A\ns,A\n", false);
    check("|name,column\ntime_s,iq_A\n", false);   /* no more than the first */
    check("|Logger 5\ntime_s,lamp\n", false);      /* one that is known */
    check("|Logger 5\ntime_s,iq_A\nx,1\n", false); /* not the last */
}

/* Lines that are no header, or have no rows. */
static void test_lines_that_are_no_header(void)
{
    check("|Logger 5\ntime_s,iq_A\nx,1\n1,2\n", false); /* one number in a row */
    check("|Logger 5\ntime_s,iq_A\n0,1\nx,2\n", false);
    check("|Logger 5\na,b,c,d\n0,1,,\n1,2,,\n", false);                /* two of four names */
    check("|Logger 5\na,b\n0,1,2\n1,2,3\n", false);                    /* rows that are longer */
    check("|Logger 5\na,,b\n0,1,2\n1,2,3\n", false);                   /* a gap */
    check("Logger 5\n|t,T\n0,1\n1,2\n", true);                         /* names of one letter differ */
    check("|Logger 5\nlamp,Lamp\n0,1\n1,2\n", false);                  /* a name twice */
    check("|Logger 5\ns,A\n0,1\n1,2\n", false);                        /* units */
    check("|Logger 5\nlamp,2\n0,1\n1,2\n", false);                     /* a number */
    check("|time_s,iq_A\nfoo,bar baz\nlamp,other\n0,1\n1,2\n", false); /* a rival that is known */
}

/* A header is looked for in 64 lines. */
static void test_how_far_a_header_is_looked_for(void)
{
    for (int lines = 63; lines <= 64; ++lines) {
        char text[2000] = "";
        for (int k = 0; k < lines; ++k)
            strcat(text, "foreword\n");
        if (lines == 64) memmove(text + 1, text, strlen(text) + 1), text[0] = '|';
        if (lines == 63) strcat(text, "|");
        strcat(text, "time_s,iq_A\n0,1\n1,2\n");
        check(text, lines == 63);
    }
}

static void check_bare(const char *text, size_t line, size_t count)
{
    size_t numbers = 99;
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(line, hci_csv_bare_rows(text, &numbers), text);
    if (line > 0) TEST_ASSERT_EQUAL_UINT64_MESSAGE(count, numbers, text);
}

/* Three rows of as many numbers, two or more, below lines of one cell. */
static void test_rows_without_a_header(void)
{
    check_bare("Logger 5\n0,1\n1,2\n2,3\n", 2, 2);
    check_bare("Logger 5\n\n# note\nmore\n0;1;4\n1;2;5\n2;3;6\n", 5, 3);
    check_bare("0,1\n1,2\n2,3\n", 0, 0);
    check_bare("Logger 5\n0,1\n1,2\n", 0, 0);
    check_bare("Logger 5\n0,1\n1,2\n2,x\n", 0, 0);
    check_bare("Logger 5\n0,1\n1,2\n2,3,4\n", 0, 0);
    check_bare("Logger 5\n0\n1\n2\n", 0, 0);
    check_bare("Logger 5\n9,9\nword\n0,1\n1,2\n2,3\n", 4, 2);
    check_bare("a,b\nLogger\n0,1\n1,2\n2,3\n", 0, 0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_separators);
    RUN_TEST(test_tables_at_the_first_line);
    RUN_TEST(test_tables_behind_a_foreword);
    RUN_TEST(test_a_header_without_rows);
    RUN_TEST(test_lines_that_are_no_header);
    RUN_TEST(test_how_far_a_header_is_looked_for);
    RUN_TEST(test_rows_without_a_header);
    return UNITY_END();
}
