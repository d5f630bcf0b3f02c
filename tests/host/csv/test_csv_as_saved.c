/* Tables as spreadsheets, loggers and consoles save them: encodings, marks between thousands, clock times,
 * columns apart by blanks, a header in a comment, fractions of orders. Each table is written here. */
#include <stdio.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "support/files.h"
#include "unity.h"

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    files_end();
}

/* Writes it and reads it; NULL: refused. */
static hci_csv *open_text(const char *text, size_t size, hci_note *note)
{
    const char *path = files_path("t.csv");
    hci_csv *csv;
    FILE *stream = fopen(path, "wb");
    TEST_ASSERT_NOT_NULL(stream);
    TEST_ASSERT_EQUAL(size, fwrite(text, 1, size, stream));
    TEST_ASSERT_EQUAL(0, fclose(stream));
    *note = (hci_note){{0}};
    hci_csv_read(path, &csv, note);
    return csv;
}

/* ---- numbers ---- */

#define NONE -12345.0

/* The last number of a column `column` of a table; NONE: refused, and the note says `said`. */
typedef struct {
    const char *text, *column;
    double value;
    const char *said;
} table_case;

static void check_case(const table_case *c)
{
    double values[8];
    hci_note note;
    hci_csv *csv = open_text(c->text, strlen(c->text), &note);
    const hci_status status = csv != NULL ? hci_csv_numbers(csv, c->column, values, &note) : HCI_ERROR_INPUT;
    TEST_ASSERT_EQUAL_MESSAGE(c->said == NULL ? HCI_OK : HCI_ERROR_INPUT, status,
                              note.text[0] ? note.text : c->text);
    if (c->said == NULL)
        TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(c->value, values[hci_csv_rows(csv) - 1], c->text);
    else
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, c->said), note.text);
    hci_csv_free(csv);
}

static void check_cases(const table_case *cases, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        check_case(&cases[k]);
}

#define CHECK(cases) check_cases(cases, sizeof(cases) / sizeof *(cases))

#define EITHER "this may be a number or a thousand times it"
#define COLUMN "expected one decimal mark in all of the column"

static void test_marks_between_thousands(void)
{
    static const table_case cases[] = {
        {"x;y\n1.000,5;1\n", "x", 1000.5, NULL},
        {"x;y\n-1.234.567;1\n", "x", -1234567, NULL},
        {"x;y\n1.000,5;1\n1.234;1\n", "x", 1234, NULL},
        {"x;y\n1.234;1\n1.000,5;1\n", "x", 1000.5, NULL},
        {"x;y\n1,000.5;1\n", "x", 1000.5, NULL},
        {"x,y\n\"1,000.5\",1\n\"1,234\",1\n", "x", 1234, NULL},
        {"x;y\n1 000,5;1\n", "x", 1000.5, NULL},
        {"x;y\n1\xC2\xA0"
         "000,5;1\n",
         "x", 1000.5, NULL},
        {"x;y\n12\xE2\x80\xAF"
         "000;1\n",
         "x", 12000, NULL},
        {"x,y\n1'000.5,1\n", "x", 1000.5, NULL},
        {"x,y\n1\xE2\x80\x99"
         "000.5,1\n",
         "x", 1000.5, NULL},
        {"x,y\n\"0,5\",1\n\"1,234\",1\n", "x", 1.234, NULL},
        {"x\ty\n0,5\t1\n1,234\t1\n", "x", 1.234, NULL},
        {"x;y\n1,234;1\n", "x", 1.234, NULL},
        {"x;y\n1.234;1\n", "x", 1.234, NULL},
        {"x;y\n1.234;0.5\n", "x", 1.234, NULL},
        {"x,y\n1.234,1\n", "x", 1.234, NULL},
        {"x;y\n0.123;1\n", "x", 0.123, NULL},
        {"x;y\n1.2345e3;1\n", "x", 1234.5, NULL},
    };
    CHECK(cases);
}

/* Never silently wrong by a thousand. */
static void test_a_mark_that_may_be_either_is_refused(void)
{
    static const table_case cases[] = {
        {"x;y\n1.234;0,5\n", "x", NONE, EITHER},
        {"x;y\n1,234;0.5\n", "x", NONE, EITHER},
        {"x\ty\n1,234\t1\n", "x", NONE, EITHER},
        {"x,y\n\"1,234\",1\n", "x", NONE, EITHER},
        {"x,y\n1.234,\"0,5\"\n", "x", NONE, EITHER},
        {"x;y\n0,5;1\n1.234;1\n", "x", NONE, COLUMN},
        {"x;y\n0.5;1\n1,234;1\n", "x", NONE, COLUMN},
        {"x;y\n0.5;1\n0,5;1\n", "x", NONE, COLUMN},
        {"x;y\n1.000,5;1\n1,000.5;1\n", "x", NONE, COLUMN},
        {"x;y\n1.23.456;1\n", "x", NONE, "found `1.23.456`"},
        {"x;y\n0.123.456;1\n", "x", NONE, "found `0.123.456`"},
        {"x;y\n1 23;1\n", "x", NONE, "found `1 23`"},
        {"x;y\n1.000,5.5;1\n", "x", NONE, "found `1.000,5.5`"},
    };
    CHECK(cases);
}

static void test_clock_times_are_seconds(void)
{
    static const table_case cases[] = {
        {"time_s,x\n12:00:01.5,1\n", "time_s", 43201.5, NULL},
        {"time_ms,x\n12:00:01.5,1\n", "time_s", 43201.5, NULL},
        {"t;x\n12:00:01,25;1\n", "time_s", 43201.25, NULL},
        {"t,x\n01:02.5,1\n", "time_s", 62.5, NULL},
        {"t,x\n1:00:00 PM,1\n", "time_s", 46800, NULL},
        {"t,x\n12:00:01 am,1\n", "time_s", 1, NULL},
        {"time,x\n2024-02-28T23:59:59Z,1\n2024-03-01T00:00:01.5Z,1\n", "time_s", 172801.5, NULL},
        {"time,x\n2024-02-29 10:00:00+01:00,1\n", "time_s", 36000, NULL},
        {"time;x\n31.12.2023 23:59:59;1\n01.01.2024 00:00:00;1\n", "time_s", 86400, NULL},
        {"time,x\n12/31/2023 11:59:58 PM,1\n", "time_s", 86398, NULL},
        {"time,x\n2024-03-01 10:01,1\n", "time_s", 36060, NULL},
        {"datetime,x\n2024-03-01 10:01,1\n", "time_s", 36060, NULL},
        {"time,x\n10:01,1\n", "time_s", NONE,
         "found `10:01`, expected a finite number, or a time as 12:00:01.5"},
        {"time,x\n10:61:00,1\n", "time_s", NONE, "found `10:61:00`"},
        {"time,x\n1,1\n2024-03-01,1\n", "time_s", NONE, "found `2024-03-01`"},
        {"time_s,torque_Nm\n1,12:00:00\n", "torque_Nm", NONE,
         "a clock time is read in a column of time only"},
    };
    CHECK(cases);
}

static void test_columns_apart_by_blanks(void)
{
    static const table_case cases[] = {
        {"time_s torque_Nm\n0 1\n1 2.5\n", "torque_Nm", 2.5, NULL},
        {"   time_s   torque_Nm\n      0      1.0   \n      1     -2.5   \n", "torque_Nm", -2.5, NULL},
        {"Time (s)   Torque (mNm)\n0   1\n1   2500\n", "torque_Nm", 2.5, NULL},
        {"\"Time (s)\" \"Torque (mNm)\"\n0 1\n1 2500\n", "torque_Nm", 2.5, NULL},
        {"time torque\ns   mNm\n0   1\n1   2500\n", "torque_Nm", 2.5, NULL},
        {"time_s torque_Nm\n0,5 1\n1,5 2,5\n", "torque_Nm", 2.5, NULL},
        {"Drive log of Monday\nserial: 12\n\ntime_s torque_Nm\r\n# a remark, here\r\n0 1\r\n1 2.5\r\n",
         "torque_Nm", 2.5, NULL},
        {"order,amplitude_Nm, phase_rad\n6, 2.5, 0\n", "amplitude_Nm", 2.5, NULL},
        {"torque Nm\n2.5\n", "torque_Nm", NONE, "found no column"},
        {"a torque_Nm\n1 2 3\n", "torque_Nm", NONE, "found no column"},
    };
    CHECK(cases);
}

static void test_a_header_in_a_comment(void)
{
    static const table_case cases[] = {
        {"# time_s,torque_Nm\n0,1\n1,2.5\n", "torque_Nm", 2.5, NULL},
        {"# Monday\n#time_s torque_Nm\n0.0e+00 1.0e+00\n1.0e+00 2.5e+00\n", "torque_Nm", 2.5, NULL},
        {"# Monday\n0,1\n1,2.5\n", "torque_Nm", NONE,
         "expected a column name; put a row of column names first"},
    };
    CHECK(cases);
}

static void test_orders_may_be_fractions(void)
{
    static const table_case cases[] = {
        {"order,amplitude_Nm\n24/7,1\n", "order", 24.0 / 7.0, NULL},
        {"order,amplitude_Nm\n24/0,1\n", "order", NONE, "found `24/0`"},
        {"order,amplitude_Nm\n-24/7,1\n", "order", NONE, "found `-24/7`"},
        {"order,amplitude_Nm\n1,24/7\n", "amplitude_Nm", NONE,
         "write it as a decimal number; orders only may be fractions"},
    };
    CHECK(cases);
}

static void test_what_is_no_number_is_counted_and_has_its_remedy(void)
{
    static const table_case cases[] = {
        {"x,y\n12 A,1\n13 A,1\n", "x", NONE,
         "found `12 A`, expected a finite number; write the unit into the column's name, as in torque_mNm, "
         "and "
         "the number alone (1 more cell of the column is none: line 3)"},
        {"x,y\n1,1\n\"#REF!\",1\n2,1\nb,1\nb,1\nb,1\nb,1\n", "x", NONE,
         "a spreadsheet writes this for an error: correct the formula, or empty the cell "
         "(4 more cells of the column are none: lines 5, 6, 7, ...)"},
    };
    CHECK(cases);
}

/* ---- encodings ---- */

typedef struct {
    const char *bytes;
    size_t size;
} raw;

#define RAW(text)                                                                                            \
    {                                                                                                        \
        text, sizeof(text) - 1                                                                               \
    }

/* Each is the table: column `Kühl (µs)`, row 0.5. */
static void test_encodings_of_spreadsheets(void)
{
    static const raw files[] = {
        RAW("time (\xC2\xB5s),\xC3\xBC\xE2\x82\xAC\n500,1\n"),
        RAW("time (\xB5s),\xFC\x80\n500,1\n"),
        RAW("\xFF\xFEt\0i\0m\0e\0 \0(\0\xB5\0s\0)\0,\0\xFC\0\xAC\x20\n\0005\0000\0000\0,\0001\0\n\0"),
        RAW("t\0i\0m\0e\0 \0(\0\xB5\0s\0)\0,\0\xFC\0\xAC\x20\n\0005\0000\0000\0,\0001\0\n\0"),
        RAW("\xFE\xFF\0t\0i\0m\0e\0 \0(\0\xB5\0s\0)\0,\0\xFC\x20\xAC\0\n\0005\0000\0000\0,\0001\0\n"),
    };
    for (size_t k = 0; k < sizeof files / sizeof *files; ++k) {
        hci_note note;
        double value;
        hci_csv *csv = open_text(files[k].bytes, files[k].size, &note);
        TEST_ASSERT_NOT_NULL_MESSAGE(csv, note.text);
        TEST_ASSERT_EQUAL_STRING("time (\xC2\xB5s)", hci_csv_name(csv, 0));
        TEST_ASSERT_EQUAL_STRING("\xC3\xBC\xE2\x82\xAC", hci_csv_name(csv, 1));
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_numbers(csv, "time_s", &value, &note), note.text);
        TEST_ASSERT_EQUAL_DOUBLE(500e-6, value);
        hci_csv_free(csv);
    }
}

/* A pair, half of one at the end, and one whose second half is another character. */
static void test_pairs_of_utf16(void)
{
    static const char bytes[] = "\xFF\xFE\x3D\xD8\x00\xDE\n\0x\0\xFF\xDB"
                                "a\0\n\0x\0\x3D\xD8";
    hci_note note;
    const char *text;
    hci_csv *csv = open_text(bytes, sizeof bytes - 1, &note);
    TEST_ASSERT_NOT_NULL_MESSAGE(csv, note.text);
    TEST_ASSERT_EQUAL_STRING("\xF0\x9F\x98\x80", hci_csv_name(csv, 0));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_text(csv, hci_csv_name(csv, 0), 0, &text, &note));
    TEST_ASSERT_EQUAL_STRING("x\xEF\xBF\xBD"
                             "a",
                             text);
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_text(csv, hci_csv_name(csv, 0), 1, &text, &note));
    TEST_ASSERT_EQUAL_STRING("x\xEF\xBF\xBD", text);
    hci_csv_free(csv);
}

static void test_files_that_are_no_text_are_named(void)
{
    static const struct {
        raw file;
        const char *said;
    } cases[] = {
        {RAW("PK\003\004\024\0\0\0"),
         "found a workbook (.xlsx, .ods) or another ZIP file; save the table in it as CSV"},
        {RAW("MATLAB 5.0 MAT-file\0"), "found a MATLAB file; "},
        {RAW("\x93NUMPY\1\0v\0"), "found a NumPy file; "},
        {RAW("order\n1\n\0 2\n"), ":3: found a NUL byte, expected text; "},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        hci_note note;
        TEST_ASSERT_NULL(open_text(cases[k].file.bytes, cases[k].file.size, &note));
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, cases[k].said), note.text);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_marks_between_thousands);
    RUN_TEST(test_a_mark_that_may_be_either_is_refused);
    RUN_TEST(test_clock_times_are_seconds);
    RUN_TEST(test_columns_apart_by_blanks);
    RUN_TEST(test_a_header_in_a_comment);
    RUN_TEST(test_orders_may_be_fractions);
    RUN_TEST(test_what_is_no_number_is_counted_and_has_its_remedy);
    RUN_TEST(test_encodings_of_spreadsheets);
    RUN_TEST(test_pairs_of_utf16);
    RUN_TEST(test_files_that_are_no_text_are_named);
    return UNITY_END();
}
