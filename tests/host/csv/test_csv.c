/* Reading CSV: the files of tests/files/csv with what they hold or what is said of them, a round trip of
 * random tables, and memory that runs out. */
#include "hci/host/csv/csv.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hci/host/base/utf8.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "support/files.h"
#include "support/reference.h"
#include "unity.h"

/* One rounding in the factor, one in the product. */
#define CONVERSION 4e-16

static char scratch[64];
static int first_free;

void setUp(void)
{
    first_free = files_next_descriptor();
    files_begin();
    snprintf(scratch, sizeof scratch, "%s", files_path("scratch.csv"));
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    files_end();
    TEST_ASSERT_EQUAL_MESSAGE(first_free, files_next_descriptor(), "a file is left open");
}

static const char *file_path(const char *name)
{
    static char path[256];
    snprintf(path, sizeof path, "tests/files/csv/%s.csv", name);
    return path;
}

static hci_csv *open_file(const char *name)
{
    hci_note note = {0};
    hci_csv *csv;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(file_path(name), &csv, &note), note.text);
    TEST_ASSERT_EQUAL_STRING("", note.text);
    return csv;
}

static void write_scratch(const char *text, size_t size)
{
    FILE *stream = fopen(scratch, "wb");
    TEST_ASSERT_NOT_NULL(stream);
    TEST_ASSERT_EQUAL(size, fwrite(text, 1, size, stream));
    TEST_ASSERT_EQUAL(0, fclose(stream));
}

/* ---- files that are read well ---- */

typedef struct {
    const char *file, *column;
    size_t count;
    double values[3];
} expected_column;

static const expected_column good[] = {
    {"bom", "order", 1, {1}},
    {"bom", "amplitude_V", 1, {21.93}},
    {"crlf", "order", 2, {1, 5}},
    {"crlf", "amplitude_V", 2, {21.93, 0.5}},
    {"cr", "amplitude_V", 2, {21.93, 0.5}},
    {"no_final_newline", "amplitude_V", 2, {21.93, 0.5}},
    {"semicolon_decimal_comma", "amplitude_V", 2, {21.93, 0.5}},
    {"semicolon_decimal_point", "amplitude_V", 2, {21.93, 0.5}},
    {"tab", "amplitude_V", 2, {21.93, 0.5}},
    {"comments", "amplitude_V", 2, {21.93, 0.5}},
    {"blank_lines", "amplitude_V", 2, {21.93, 0.5}},
    {"blanks_around", "order", 2, {1, 5}},
    {"blanks_around", "amplitude_V", 2, {21.93, 0.5}},
    {"quoted_separator_in_header", "value", 1, {1.5}},
    {"unit_row", "theta_e_rad", 1, {REF_PI}},
    {"unit_row", "ia_A", 1, {1.5}},
    {"unit_row", "order", 1, {5}},
    {"unit_row_bare_cells", "theta_e_deg", 1, {180 / REF_PI}},
    {"unit_row_bare_cells", "ia_A", 1, {2}},
    {"unit_row_bare_cells", "order", 1, {3}},
    {"unit_row_utf8", "inertia_kgm2", 1, {1}},
    {"unit_row_utf8", "R_ohm", 1, {2e-3}},
    {"unit_row_utf8", "Kt_Nm_per_A", 1, {3}},
    {"unit_row_utf8", "Ld_H", 1, {4e-6}},
    {"unit_row_utf8", "t_s", 1, {5e-6}},
    {"unit_row_utf8", "temperature_C", 1, {6}},
    {"unit_row_only", "theta_e_rad", 0, {0}},
    {"unit_row_repeats_suffix", "theta_e_rad", 1, {1}},
    {"unit_suffix", "theta_e_rad", 1, {REF_PI}},
    {"unit_suffix", "speed_rad_per_s", 1, {100 * REF_PI}},
    {"unit_suffix", "speed_rpm", 1, {3000}},
    {"unit_suffix", "ia_A", 1, {1.5}},
    {"unit_suffix", "time_s", 1, {0.25}},
    {"unit_suffix", "torque_Nm", 1, {0.75}},
    {"unit_brackets", "theta_e_rad", 1, {REF_PI / 2}},
    {"unit_brackets", "speed_rad_per_s", 1, {2 * REF_PI}},
    {"unit_brackets", "torque_Nm", 1, {7}},
    {"unit_brackets", "time_s", 1, {8}},
    {"bare_names", "theta_e_rad", 1, {1.5}},
    {"bare_names", "theta_e_deg", 1, {1.5}},
    {"bare_names", "speed_rpm", 1, {100}},
    {"upper_case_names", "theta_e_rad", 1, {REF_PI / 2}},
    {"upper_case_names", "time_s", 1, {5e-3}},
    {"upper_case_names", "ia_A", 1, {7}},
    {"upper_case_names", "torque_Nm", 1, {8}},
    {"text_table", "value", 2, {5, 100}},
    {"text_table_of_phases", "gain", 2, {1, 1}},
    {"header_only", "order", 0, {0}},
    {"trailing_separators", "amplitude_V", 3, {21.93, 0.5, 0.25}},
    {"bare_separators_between", "amplitude_V", 2, {21.93, 0.5}},
    {"nameless_column", "order", 2, {1, 5}},
    {"nameless_column", "amplitude_V", 2, {21.93, 0.5}},
    {"spreadsheet_end", "amplitude_V", 1, {21.93}},
    {"utf16le", "amplitude_V", 1, {21.93}},
    {"utf16be", "amplitude_V", 1, {21.93}},
    {"latin1_header", "temp_C", 1, {2}},
    {"thousands", "amplitude_V", 1, {1234.5}},
    {"decimal_comma_tab", "amplitude_V", 1, {0.5}},
};

static void test_well_formed_files_give_their_numbers(void)
{
    for (size_t k = 0; k < sizeof good / sizeof *good; k++) {
        double values[3] = {0};
        hci_note note = {0};
        hci_csv *csv = open_file(good[k].file);
        TEST_ASSERT_EQUAL_MESSAGE(good[k].count, hci_csv_rows(csv), good[k].file);
        TEST_ASSERT_TRUE_MESSAGE(hci_csv_has(csv, good[k].column), good[k].file);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_numbers(csv, good[k].column, values, &note), note.text);
        for (size_t i = 0; i < good[k].count; i++) {
            TEST_ASSERT_DOUBLE_WITHIN(CONVERSION * fabs(good[k].values[i]), good[k].values[i], values[i]);
        }
        TEST_ASSERT_EQUAL_STRING(file_path(good[k].file), hci_csv_path(csv));
        hci_csv_free(csv);
    }
}

static const struct {
    const char *file, *column;
    size_t row;
    const char *text;
    size_t line;
} texts[] = {
    {"quoted", "name", 0, "a,b", 2},
    {"quoted", "source, \"remark\"", 0, "say \"so\"", 2},
    {"quoted", "NAME", 1, "two\nlines", 3},
    {"quoted", "source, \"remark\"", 1, "plain \"inside\" word", 3},
    {"quoted", "name", 2, "last", 5},
    {"quoted", "source, \"remark\"", 2, "#5", 5},
    {"text_table", "name", 0, "pole_pairs", 2},
    {"text_table", "source", 0, "data sheet, p. 2", 2},
    {"text_table", "unit", 1, "Hz", 3},
    {"text_table", "source", 1, "", 3},
    {"text_table_of_units", "quantity", 0, "A", 2},
    {"text_table_of_units", "unit", 1, "rad", 3},
    {"text_table_of_phases", "phase", 0, "A", 2},
    {"unit_row", "set", 0, "sym", 3},
    {"comments", "order", 0, "1", 5},
    {"comments", "order", 1, "5", 6},
    {"blank_lines", "order", 1, "5", 8},
    {"cr", "order", 1, "5", 3},
    {"crlf", "order", 1, "5", 3},
    {"crlf_with_comments", "order", 0, "1", 5},
    {"tab_empty_cells", "amplitude_V", 0, "", 2},
    {"tab_empty_cells", "note", 0, "3", 2},
    {"tab_empty_cells", "amplitude_V", 1, "", 3},
    {"cr_in_quotes", "name", 0, "a\rb", 2},
    {"cr_in_quotes", "name", 1, "c", 4},
    {"bare_separators_between", "order", 1, "5", 5},
    {"text_table_of_one_unit", "unit", 0, "V", 2},
    {"empty_cells", "note", 0, "", 2},
    {"empty_cells", "note", 1, "", 3},
    {"latin1_text", "name", 0, "D\xC3\xBCse", 2},
};

static void test_cells_give_their_text_and_rows_their_line(void)
{
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        const char *text = NULL;
        hci_note note = {0};
        hci_csv *csv = open_file(texts[k].file);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_text(csv, texts[k].column, texts[k].row, &text, &note),
                                  note.text);
        TEST_ASSERT_EQUAL_STRING_MESSAGE(texts[k].text, text, texts[k].file);
        TEST_ASSERT_EQUAL_MESSAGE(texts[k].line, hci_csv_line(csv, texts[k].row), texts[k].file);
        hci_csv_free(csv);
    }
}

static void test_a_column_of_another_dimension_is_not_there(void)
{
    hci_csv *csv = open_file("unit_suffix");
    TEST_ASSERT_FALSE(hci_csv_has(csv, "theta_e_A"));
    TEST_ASSERT_FALSE(hci_csv_has(csv, "theta"));
    TEST_ASSERT_FALSE(hci_csv_has(csv, "theta_rad"));
    TEST_ASSERT_FALSE(hci_csv_has(csv, "torque_model_Nm"));
    hci_csv_free(csv);
    csv = open_file("unit_wrong_dimension");
    TEST_ASSERT_FALSE(hci_csv_has(csv, "torque_Nm"));
    TEST_ASSERT_TRUE(hci_csv_has(csv, "torque_mA"));
    hci_csv_free(csv);
}

/* One cell as it stands: the table has its unit in another column. */
static void test_a_single_number_is_not_converted(void)
{
    double value = 0;
    hci_note note = {0};
    hci_csv *csv = open_file("unit_suffix");
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_number(csv, "theta_e_rad", 0, &value, &note));
    TEST_ASSERT_EQUAL_DOUBLE(180, value);
    hci_csv_free(csv);
    csv = open_file("text_table");
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_number(csv, "value", 1, &value, &note));
    TEST_ASSERT_EQUAL_DOUBLE(100, value);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_number(csv, "name", 1, &value, &note));
    TEST_ASSERT_EQUAL_STRING(
        "tests/files/csv/text_table.csv:3: column 1 `name`: found `emf_frequency`, expected a finite "
        "number; write a number with a decimal point, e.g. 21.93",
        note.text);
    TEST_ASSERT_EQUAL_DOUBLE(100, value);
    hci_csv_free(csv);
}

/* ---- files that are refused ---- */

#define AS_IN_HEADER(n) "expected " n " as in the header (line 1); "
#define DECIMAL_COMMA   "if the comma is the decimal mark, write a decimal point or separate the columns by ;"
#define SAVE_UTF8       "; save it as CSV in UTF-8"
#define NO_NAMES                                                                                             \
    "found no line of text, expected a header row of column names; write the names in the first line"
#define FINITE     ", expected a finite number; "
#define WITH_POINT "write a number with a decimal point, e.g. 21.93"
#define UNIT_ROW   "in a row of units each cell must be a known unit, 1, - or empty"

/* column NULL: hci_csv_read refuses it. The text follows the path and a colon. */
static const struct {
    const char *file, *column, *text;
} bad[] = {
    {"empty", NULL, " " NO_NAMES},
    {"bom_only", NULL, " " NO_NAMES},
    {"comments_only", NULL, " " NO_NAMES},
    {"short_row", NULL,
     "3: column 3 `phase_rad`: found the end of the line, " AS_IN_HEADER(
         "3 fields") "complete the line or remove it"},
    {"cut_off", NULL,
     "3: column 3 `phase_rad`: found the end of the line, " AS_IN_HEADER(
         "3 fields") "complete the line or remove it"},
    {"long_row", NULL, "3: column 3: found `0`, " AS_IN_HEADER("2 fields") DECIMAL_COMMA},
    {"long_row_semicolon", NULL,
     "2: column 3: found `x`, " AS_IN_HEADER(
         "2 fields") "remove what is too much, or quote a text that holds the separator"},
    {"decimal_comma_among_commas", NULL, "2: column 3: found `93`, " AS_IN_HEADER("2 fields") DECIMAL_COMMA},
    {"decimal_comma_one_column", NULL, "2: column 2: found `5`, " AS_IN_HEADER("1 field") DECIMAL_COMMA},
    {"duplicate_header", NULL,
     "1: column 3 `IA_a`: found the name of column 2 again, expected each name once; rename or remove one of "
     "them"},
    {"no_header", NULL, "1: column 1: found `0.5`, expected a column name; put a row of column names first"},
    {"nul", NULL, "2: found a NUL byte, expected text" SAVE_UTF8},
    {"spreadsheet", NULL,
     " found a workbook (.xlsx, .ods) or another ZIP file; save the table in it as CSV and give that file"},
    {"unclosed_quote", NULL,
     "3: column 2: found an opening quote only, expected a closing quote; close the quotes, and write a "
     "quote inside of them twice"},
    {"unclosed_quote_at_the_end", NULL,
     "2: column 2: found an opening quote only, expected a closing quote; close the quotes, and write a "
     "quote inside of them twice"},
    {"unclosed_quote_after_doubled_quotes", NULL,
     "2: column 2: found an opening quote only, expected a closing quote; close the quotes, and write a "
     "quote inside of them twice"},
    {"text_after_quote", NULL,
     "2: column 2: found text after a closing quote, expected a separator or the end of the line; write a "
     "quote inside of quotes twice"},
    {"control_characters_in_row", NULL,
     "2: column 2: found `\\x1b[31mred\\x07`, " AS_IN_HEADER("1 field") DECIMAL_COMMA},

    {"duplicate_quantity", "theta_e_rad",
     "1: column 2 `theta_e_deg`: found `theta_e_rad` a second time, expected one column for it; remove or "
     "rename one of them"},
    {"nan", "amplitude_V",
     "2: column 2 `amplitude_V`: found `nan`" FINITE "remove the line or correct the value"},
    {"inf", "amplitude_V",
     "3: column 2 `amplitude_V`: found `-Infinity`" FINITE "remove the line or correct the value"},
    {"overflow", "amplitude_V",
     "2: column 2 `amplitude_V`: found `1e999`" FINITE "remove the line or correct the value"},
    {"overflow_in_conversion", "speed_rad_per_s",
     "2: column 1 `speed_rev_per_s`: found `1.7e308`" FINITE "remove the line or correct the value"},
    {"empty_cell", "amplitude_V",
     "2: column 2 `amplitude_V`: found an empty cell" FINITE "fill the cell or remove the line"},
    {"unit_row_before_empty_cell", "theta_e_rad",
     "3: column 1 `theta_e`: found an empty cell" FINITE "fill the cell or remove the line"},
    {"text_for_number", "amplitude_V", "3: column 2 `amplitude_V`: found `abc`" FINITE WITH_POINT},
    {"hexadecimal", "amplitude_V", "2: column 2 `amplitude_V`: found `0x10`" FINITE WITH_POINT},
    {"two_marks", "amplitude_V", "2: column 2 `amplitude_V`: found `1.2.3`" FINITE WITH_POINT},
    {"mixed_decimal_marks", "amplitude_V",
     "3: column 2 `amplitude_V`: found `1.234`, expected one decimal mark in all of the column; write no "
     "marks between thousands, and the same decimal mark everywhere"},
    {"control_characters", "amplitude_V",
     "2: column 2 `amplitude_V`: found `\\x1b]0;x\\x07\\x7f\\xc2\\x9b`" FINITE WITH_POINT},
    {"quoted_newline_line_number", "value", "5: column 2 `value`: found `x`" FINITE WITH_POINT},
    {"unit_row_unknown", "theta_e_rad",
     "2: column 2 `ia`: found `furlong`, expected a unit, as in the other cells; " UNIT_ROW},
    {"unit_row_mega", "ia_A",
     "2: column 2 `ia`: found `MA`, expected a unit, as in the other cells; " UNIT_ROW},
    {"unit_wrong_dimension", "torque_Nm",
     "2: column 1 `torque`: found the unit `A`, expected a unit of the quantity asked for; correct the unit"},
    {"unit_conflict", "theta_e_rad",
     "2: column 1 `theta_e_rad`: found the unit `deg`, expected the unit in the column's name; correct the "
     "unit"},
    {"unit_suffix", "ia_V",
     "1: found no column `ia_V` but `theta_e_deg`, `speed_rpm`, `ia_mA`, `time_ms`, `torque_mNm`, expected "
     "it in the header; add it or rename a column"},
    {"nameless_column", "ia_A",
     "1: found no column `ia_A` but `order`, `amplitude_V`, expected it in the header; add it or rename a "
     "column"},
    {"text_table", "torque_Nm",
     "1: found no column `torque_Nm` but `name`, `value`, `unit`, `source`, expected it in the header; add "
     "it or rename a column"},
};

static void test_faulty_files_are_refused_with_place_and_remedy(void)
{
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        hci_note note = {0};
        char expected[HCI_NOTE_SIZE];
        double values[3] = {0};
        hci_csv *csv;
        hci_status status = hci_csv_read(file_path(bad[k].file), &csv, &note);
        TEST_ASSERT_TRUE_MESSAGE((csv == NULL) == (bad[k].column == NULL), note.text);
        if (csv != NULL) status = hci_csv_numbers(csv, bad[k].column, values, &note);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_INPUT, status, bad[k].file);
        snprintf(expected, sizeof expected, "%s:%s", file_path(bad[k].file), bad[k].text);
        TEST_ASSERT_EQUAL_STRING(expected, note.text);
        hci_csv_free(csv);
    }
}

/* Neither UTF-8 nor Windows-1252: a character of the one beside a byte of the other. */
static void test_a_text_that_is_not_utf8_is_refused(void)
{
    static const char mixed[] = "name,value\n\xC2\xB5 D\xFCse,1\n";
    hci_note note = {0};
    const char *text = NULL;
    hci_csv *csv;
    write_scratch(mixed, sizeof mixed - 1);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(scratch, &csv, &note), note.text);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_text(csv, "name", 0, &text, &note));
    TEST_ASSERT_NULL(text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text,
                                        ":2: column 1: found `\xC2\xB5 D\\xfcse`, expected text in UTF-8; "
                                        "save the file as CSV in UTF-8"),
                                 note.text);
    hci_csv_free(csv);
}

static void test_a_long_cell_is_cut_in_the_note(void)
{
    hci_note note = {0};
    double value;
    hci_csv *csv = open_file("long_cell");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_numbers(csv, "amplitude_V", &value, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "\xC3\xBC\xE2\x80\xA6`, expected"));
    TEST_ASSERT_TRUE(strlen(note.text) < 300);
    TEST_ASSERT_TRUE(hci_utf8_valid(note.text));
    hci_csv_free(csv);
}

/* Whatever the lengths, the list of columns ends between two characters. */
static void test_a_long_list_of_columns_is_cut_in_the_note(void)
{
    for (int length = 1; length < 60; length++) {
        char text[8192];
        size_t used = 0;
        hci_note note = {0};
        hci_csv *csv;
        for (int c = 0; c < 99; c++)
            used += (size_t)snprintf(text + used, sizeof text - used, "%0*d\xC2\xB5,", length, c);
        write_scratch(text, used);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(scratch, &csv, &note), note.text);
        TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_numbers(csv, "torque_Nm", NULL, &note));
        TEST_ASSERT_TRUE(hci_utf8_valid(note.text));
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "`, \xE2\x80\xA6, expected it in the header;"),
                                     note.text);
        hci_csv_free(csv);
    }
}

static void test_a_caller_can_point_at_a_cell(void)
{
    hci_note note = {0};
    hci_csv *csv = open_file("unit_suffix");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT,
                      hci_csv_error(csv, "speed_rad_per_s", 0, &note, "a speed below 10", "brake"));
    TEST_ASSERT_EQUAL_STRING("tests/files/csv/unit_suffix.csv:2: column 2 `speed_rpm`: found `3000`, "
                             "expected a speed below 10; brake",
                             note.text);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_error(csv, "order", 0, NULL, "x", "y"));
    hci_csv_free(csv);
}

static void assert_folder(const char *path)
{
    hci_note note = {0};
    hci_csv *csv;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_read(path, &csv, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(
        strstr(note.text, ": found a folder, expected a CSV file; give the path of a file in it"), note.text);
}

static void assert_unreadable(const char *path, const char *reason)
{
    hci_note note = {0};
    hci_csv *csv;
    char expected[HCI_NOTE_SIZE];
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_read(path, &csv, &note));
    TEST_ASSERT_NULL(csv);
    snprintf(expected, sizeof expected,
             "%s: cannot be read: %s; give the path of a CSV file that you may read", path, reason);
    TEST_ASSERT_EQUAL_STRING(expected, note.text);
}

/* The super-user may read everything, so the test steps down for a moment. */
static void test_what_cannot_be_opened_is_said_with_its_reason(void)
{
    const bool root = geteuid() == 0;
    assert_unreadable("tests/files/csv/there_is_no_such_file.csv", "No such file or directory");
    assert_folder("tests/files");
    assert_unreadable("", "No such file or directory");
    files_write(scratch, "");
    TEST_ASSERT_EQUAL(0, chmod(scratch, 0));
    TEST_ASSERT_EQUAL(0, chmod(files_root, 0755));
    if (root) TEST_ASSERT_EQUAL(0, seteuid(65534));
    assert_unreadable(scratch, "Permission denied");
    if (root) TEST_ASSERT_EQUAL(0, seteuid(0));
}

static void test_a_pipe_is_read_like_a_file(void)
{
    static const char text[] = "order,amplitude_V\n1,21.93\n";
    char path[32];
    int ends[2];
    double value = 0;
    hci_csv *csv;
    hci_note note = {0};
    TEST_ASSERT_EQUAL(0, pipe(ends));
    TEST_ASSERT_EQUAL(sizeof text - 1, write(ends[1], text, sizeof text - 1));
    close(ends[1]);
    snprintf(path, sizeof path, "/dev/fd/%d", ends[0]);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(path, &csv, &note), note.text);
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "amplitude_V", &value, &note));
    TEST_ASSERT_EQUAL_DOUBLE(21.93, value);
    hci_csv_free(csv);
    close(ends[0]);
}

/* 4096 columns are read; one more is refused before names are compared pair by pair. */
static void test_the_number_of_columns_is_limited(void)
{
    static char text[8 * 4098];
    for (int columns = 4096; columns <= 4097; columns++) {
        hci_note note = {0};
        hci_csv *csv;
        size_t used = 0;
        for (int c = 0; c < columns; c++)
            used += (size_t)snprintf(text + used, sizeof text - used, "x%d,", c);
        write_scratch(text, used);
        TEST_ASSERT_EQUAL(columns == 4096 ? HCI_OK : HCI_ERROR_INPUT, hci_csv_read(scratch, &csv, &note));
        TEST_ASSERT_TRUE(columns == 4096 ||
                         strstr(note.text, ":1: column 4097: found another column, expected 4096") != NULL);
        hci_csv_free(csv);
    }
}

/* ---- random tables, written in random ways ---- */

enum { ROWS = 12, COLUMNS = 5, CELL = 16 };

typedef struct {
    size_t rows, columns;
    char cells[ROWS][COLUMNS][CELL];
} table;

static size_t below(uint64_t *seed, size_t limit)
{
    return (size_t)ref_uniform(seed, 0, (double)limit) % limit;
}

static bool often(uint64_t *seed)
{
    return below(seed, 2) == 0;
}

/* Pieces that a reader may trip over. No blanks at the ends: they are trimmed. */
static void random_cell(uint64_t *seed, bool first, char *cell)
{
    static const char *const piece[] = {"a", "\"", ",",        ";",        "\t.", "\n", "\r\n.",
                                        "#", "1",  "\xC3\xA9", "\xCE\xA9", " b",  "-"};
    snprintf(cell, CELL, "%s", first ? "x" : "");
    for (size_t n = below(seed, 5); n > 0; n--) {
        const char *next = piece[below(seed, sizeof piece / sizeof *piece)];
        if (strlen(cell) + strlen(next) < CELL - 1) memcpy(cell + strlen(cell), next, strlen(next) + 1);
    }
    if (cell[0] != '\0' && strchr(" \t\n\r", cell[0]) != NULL) cell[0] = 'y';
}

static void random_table(uint64_t *seed, table *t)
{
    t->rows = below(seed, ROWS + 1);
    t->columns = 1 + below(seed, COLUMNS);
    for (size_t row = 0; row < t->rows; row++) {
        for (size_t column = 0; column < t->columns; column++)
            random_cell(seed, column == 0, t->cells[row][column]);
    }
}

static void append_cell(uint64_t *seed, const char *cell, char separator, char *out)
{
    const char special[] = {'"', '\n', '\r', '#', separator, '\0'};
    const bool quote = strpbrk(cell, special) != NULL || often(seed);
    out += strlen(out);
    if (below(seed, 4) == 0) *out++ = ' ';
    if (quote) *out++ = '"';
    for (; *cell != '\0'; cell++) {
        if (quote && *cell == '"') *out++ = '"';
        *out++ = *cell;
    }
    if (quote) *out++ = '"';
    *out = '\0';
}

static void append_row(uint64_t *seed, const table *t, size_t row, char separator, const char *newline,
                       char *out)
{
    for (size_t column = 0; column < t->columns; column++) {
        const char between[] = {separator, '\0'};
        if (column > 0) memcpy(out + strlen(out), between, 2);
        append_cell(seed, t->cells[row][column], separator, out);
    }
    memcpy(out + strlen(out), newline, strlen(newline) + 1);
}

static void write_table(uint64_t *seed, const table *t, char *out)
{
    static const char separators[] = ",;\t";
    static const char *const newlines[] = {"\n", "\r\n", "\r"}, *const fillers[] = {"", "", "# c, \"", "  "};
    /* A header of one name does not show a separator: then it is the comma. */
    const char separator = separators[t->columns > 1 ? below(seed, 3) : 0],
               *newline = newlines[below(seed, 3)];
    snprintf(out, 8, "%s", often(seed) ? "\xEF\xBB\xBF" : "");
    for (size_t column = 0; column < t->columns; column++) {
        sprintf(out + strlen(out), "%.*sc%zu", column > 0, &separator, column);
    }
    strcat(out, newline);
    for (size_t row = 0; row < t->rows; row++) {
        const char *filler = fillers[below(seed, 4)];
        if (*filler != '\0') sprintf(out + strlen(out), "%s%s", filler, newline);
        append_row(seed, t, row, separator, row + 1 < t->rows || often(seed) ? newline : "", out);
    }
}

static void test_a_table_comes_back_however_it_is_written(void)
{
    static char out[64 * 1024];
    static table t;
    for (uint64_t trial = 1; trial <= 3000; trial++) {
        uint64_t seed = trial;
        hci_note note = {0};
        hci_csv *csv;
        random_table(&seed, &t);
        write_table(&seed, &t, out);
        write_scratch(out, strlen(out));
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(scratch, &csv, &note), note.text);
        TEST_ASSERT_EQUAL_MESSAGE(t.rows, hci_csv_rows(csv), out);
        for (size_t row = 0; row < t.rows; row++) {
            for (size_t column = 0; column < t.columns; column++) {
                char name[32];
                const char *text = NULL;
                snprintf(name, sizeof name, "C%zu", column);
                TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_text(csv, name, row, &text, &note), note.text);
                TEST_ASSERT_EQUAL_STRING_MESSAGE(t.cells[row][column], text, out);
            }
        }
        hci_csv_free(csv);
    }
}

static void test_columns_are_listed_and_found_by_any_name(void)
{
    static const char text[] = "Time (ms),\"a, b\",theta_e_deg\n1,2,3\n";
    hci_note note = {0};
    hci_csv *csv;
    size_t column = 9;
    write_scratch(text, sizeof text - 1);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(scratch, &csv, &note), note.text);
    TEST_ASSERT_EQUAL(3, (int)hci_csv_columns(csv));
    TEST_ASSERT_EQUAL_STRING("Time (ms)", hci_csv_name(csv, 0));
    TEST_ASSERT_EQUAL_STRING("a, b", hci_csv_name(csv, 1));
    TEST_ASSERT_TRUE(hci_csv_find(csv, "time_s", &column));
    TEST_ASSERT_EQUAL(0, (int)column);
    TEST_ASSERT_TRUE(hci_csv_find(csv, "theta_e_rad", &column));
    TEST_ASSERT_EQUAL(2, (int)column);
    TEST_ASSERT_FALSE(hci_csv_find(csv, "theta_m_rad", &column));
    hci_csv_free(csv);
}

/* ---- numbers ---- */

static void test_long_and_odd_numbers_are_rounded_once(void)
{
    /* The fifth is in 4.9406564584124654e-324 ± half of it; the last is 0.1 with 900 zeros around. */
    const double expected[] = {
        0.1, 9007199254740992.0, 9007199254740994.0, DBL_MAX, 0x1p-1074, 0.0, 0.5, 5.0, 700.0, -0.0, 1.0};
    double values[11];
    hci_note note = {0};
    hci_csv *csv = open_file("long_numbers");
    TEST_ASSERT_EQUAL(11, hci_csv_rows(csv));
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_numbers(csv, "x", values, &note), note.text);
    for (size_t k = 0; k < 11; k++)
        TEST_ASSERT_EQUAL_MEMORY(&expected[k], &values[k], sizeof values[k]);
    hci_csv_free(csv);
}

/* ---- memory ---- */

static void write_long_file(void)
{
    FILE *stream = fopen(scratch, "w");
    fputs("time_s,torque_Nm\n", stream);
    for (int row = 0; row < 20000; row++)
        fprintf(stream, "%d.5,%d\n", row, 20000 - row);
    fclose(stream);
}

static void test_every_allocation_may_fail(void)
{
    static double values[20000];
    hci_status status = HCI_ERROR_MEMORY;
    long failures = 0;
    write_long_file();
    for (; status != HCI_OK; failures++) {
        hci_note note = {0};
        hci_csv *csv = (hci_csv *)values;
        hci_memory_fail_after(failures);
        status = hci_csv_read(scratch, &csv, &note);
        if (status == HCI_OK) status = hci_csv_numbers(csv, "torque_Nm", values, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK || status == HCI_ERROR_MEMORY);
        TEST_ASSERT_TRUE((status == HCI_OK) == (csv != NULL));
        TEST_ASSERT_TRUE(status == HCI_OK || strstr(note.text, "out of memory") != NULL);
        hci_csv_free(csv);
    }
    for (int row = 0; row < 20000; row++)
        TEST_ASSERT_EQUAL_DOUBLE(20000 - row, values[row]);
    TEST_ASSERT_TRUE(failures > 8);
}

static void test_sizes_that_do_not_fit_are_refused(void)
{
    TEST_ASSERT_NULL(hci_memory_new(SIZE_MAX / 2, 3));
    TEST_ASSERT_NULL(hci_memory_resize(NULL, SIZE_MAX / 2, 3));
    void *none = hci_memory_new(0, 8), *raw = hci_memory_malloc(0);
    none = hci_memory_resize(none, 0, 8);
    TEST_ASSERT_NOT_NULL(none);
    TEST_ASSERT_NOT_NULL(raw);
    hci_memory_free(none);
    hci_memory_free(raw);
    hci_memory_free(NULL);
}

/* A line of separators alone is passed over, and says nothing of those of the table below it. */
static void test_separators_above_the_table(void)
{
    static const char TEXT[] = ",,,\nzeit;strom\n1,5;2,5\n3,5;4,25\n";
    hci_note note = {0};
    hci_csv *csv;
    double value[2];
    write_scratch(TEXT, sizeof TEXT - 1);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(scratch, &csv, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(2, hci_csv_columns(csv));
    TEST_ASSERT_EQUAL_UINT64(2, hci_csv_rows(csv));
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_numbers(csv, "strom", value, &note), note.text);
    TEST_ASSERT_EQUAL_DOUBLE(2.5, value[0]);
    TEST_ASSERT_EQUAL_DOUBLE(4.25, value[1]);
    hci_csv_free(csv);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_well_formed_files_give_their_numbers);
    RUN_TEST(test_cells_give_their_text_and_rows_their_line);
    RUN_TEST(test_a_column_of_another_dimension_is_not_there);
    RUN_TEST(test_a_single_number_is_not_converted);
    RUN_TEST(test_faulty_files_are_refused_with_place_and_remedy);
    RUN_TEST(test_a_text_that_is_not_utf8_is_refused);
    RUN_TEST(test_a_long_cell_is_cut_in_the_note);
    RUN_TEST(test_a_long_list_of_columns_is_cut_in_the_note);
    RUN_TEST(test_a_caller_can_point_at_a_cell);
    RUN_TEST(test_what_cannot_be_opened_is_said_with_its_reason);
    RUN_TEST(test_a_pipe_is_read_like_a_file);
    RUN_TEST(test_the_number_of_columns_is_limited);
    RUN_TEST(test_a_table_comes_back_however_it_is_written);
    RUN_TEST(test_columns_are_listed_and_found_by_any_name);
    RUN_TEST(test_long_and_odd_numbers_are_rounded_once);
    RUN_TEST(test_every_allocation_may_fail);
    RUN_TEST(test_sizes_that_do_not_fit_are_refused);
    RUN_TEST(test_separators_above_the_table);
    return UNITY_END();
}
