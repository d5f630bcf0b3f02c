/* Cells of a column as numbers: decimal marks that the column, or the rest of the file, tells; clock times,
 * cells with a unit of their own, and orders. */
#include "host/csv/marks.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/csv/table.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

static hci_csv *csv;
static hci_cell_reader reader;
static hci_note note;

void setUp(void)
{
    csv = NULL;
    files_begin();
}

void tearDown(void)
{
    hci_csv_free(csv);
    files_end();
}

static void read_text(const char *text)
{
    hci_csv_free(csv);
    csv = NULL;
    memset(&note, 0, sizeof note);
    files_write(files_path("a.csv"), text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(files_path("a.csv"), &csv, &note), note.text);
}

static void read_column(const char *text, const char *name)
{
    read_text(text);
    const hci_column_match found = hci_column_find(csv, name);
    TEST_ASSERT_EQUAL(HCI_COLUMN_ONE, found.kind);
    reader = hci_cell_reader_of(csv, name, &found);
}

static void is_number(double expected, size_t record)
{
    double value = NAN;
    hci_number_kind kind;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_cell_read(&reader, record, &kind, &value, &note), note.text);
    TEST_ASSERT_EQUAL(HCI_NUMBER_FINITE, kind);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * (1.0 + fabs(expected)), expected, value);
}

static void is_kind(hci_number_kind expected, size_t record)
{
    double value;
    hci_number_kind kind;
    TEST_ASSERT_EQUAL(HCI_OK, hci_cell_read(&reader, record, &kind, &value, &note));
    TEST_ASSERT_EQUAL(expected, kind);
}

static void is_refused(const char *words, size_t record)
{
    double value;
    hci_number_kind kind;
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_cell_read(&reader, record, &kind, &value, &note));
    text_has(words, note.text);
}

#define COLUMN "expected one decimal mark in all of the column; write no marks between thousands"
#define FILE_                                                                                                \
    "expected one decimal mark in all of the file: this may be a number or a thousand times it; write no"

/* ---- decimal marks ---- */

/* The first cell that tells decides for the column, before and behind it. */
static void test_a_column_tells_its_mark(void)
{
    read_column("torque_Nm;x\n1.234;a\n7;b\n0,5;c\n1.234.567;d\n-2,25;e\n", "torque_Nm");
    TEST_ASSERT_EQUAL_INT8(',', reader.decimal);
    is_number(1234.0, 1); /* since the dot groups in line 5 */
    is_number(7.0, 2);
    is_number(0.5, 3);
    is_number(1234567.0, 4);
    is_number(-2.25, 5);
    read_column("torque_Nm;x\n1.234;a\n0,5;c\n", "torque_Nm");
    is_refused("a.csv:2: column 1 `torque_Nm`: found `1.234`, " COLUMN, 1);
    read_column("torque_Nm;x\n0.5;a\n1,25;c\n", "torque_Nm");
    is_number(0.5, 1);
    is_refused("a.csv:3: column 1 `torque_Nm`: found `1,25`, " COLUMN, 2);
    read_column("torque_Nm;x\n1 234,5;a\n", "torque_Nm");
    is_number(1234.5, 1);
    read_column("torque_Nm;x\n1 234;a\n0.25;a\n", "torque_Nm");
    is_number(1234.0, 1);
}

/* Where the column does not tell, the rest of the file does, or the semicolon: a comma needs one of them. */
static void test_the_file_tells_a_mark(void)
{
    read_column("torque_Nm;x\n1.234;7\n", "torque_Nm");
    is_number(1.234, 1);
    read_column("torque_Nm;x\n1.234;0,5\n", "torque_Nm");
    is_refused("a.csv:2: column 1 `torque_Nm`: found `1.234`, " FILE_, 1);
    read_column("torque_Nm;x\n1,234;7\n", "torque_Nm");
    is_number(1.234, 1);
    read_column("torque_Nm;x\n1,234;0.5\n", "torque_Nm");
    is_refused("`1,234`, " FILE_, 1);
    read_column("torque_Nm\tx\n1,234\t7\n", "torque_Nm");
    is_refused("`1,234`, " FILE_, 1);
    read_column("torque_Nm\tx\n1,234\t0,5\n", "torque_Nm");
    is_number(1.234, 1);
    read_column("torque_Nm\tx\n1,234\t7\n5\t0,5\n", "torque_Nm");
    is_number(1.234, 1);
    read_column("torque_Nm\tx\n1,234\t1.234.567\n", "torque_Nm"); /* whose dots are between thousands */
    is_number(1.234, 1);
}

/* In its first thousand rows. */
static void test_how_far_the_file_is_looked_at(void)
{
    for (size_t row = 1000; row <= 1001; ++row) {
        static char text[20000];
        size_t used = (size_t)sprintf(text, "torque_Nm\tx\n");
        for (size_t k = 1; k <= 1001; ++k)
            used += (size_t)sprintf(text + used, "1,234\t%s\n", k == row ? "0,5" : "7");
        read_column(text, "torque_Nm");
        TEST_ASSERT_EQUAL_INT8(row == 1000 ? ',' : 0, reader.decimal);
    }
}

/* ---- units ---- */

/* In N·m of a column in mN·m; nothing, and what is beyond all numbers. */
static void test_factors(void)
{
    read_column("torque_mNm,x\n250,a\n,b\nnan,c\ninf,d\n1e308,e\nsome,f\n", "torque_Nm");
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1e-3, reader.factor);
    is_number(0.25, 1);
    is_kind(HCI_NUMBER_NONE, 2);
    is_kind(HCI_NUMBER_NOT_FINITE, 3);
    is_kind(HCI_NUMBER_NOT_FINITE, 4);
    is_number(1e305, 5);
    is_kind(HCI_NUMBER_NONE, 6);
    read_column("torque_kNm,x\n1e307,a\n-1e306,b\n1e303,c\n", "torque_Nm");
    is_kind(HCI_NUMBER_NOT_FINITE, 1);
    is_kind(HCI_NUMBER_NOT_FINITE, 2);
    is_number(1e306, 3);
}

/* A cell may have a unit of the same quantity; those in another one than the column's are counted. */
static void test_cells_with_a_unit(void)
{
    read_column("torque_mNm,x\n250 mNm,a\n0.5 Nm,b\n3 A,c\n\"0,5 Nm\",d\n2 Nm,e\n7,f\n", "torque_Nm");
    is_number(0.25, 1);
    TEST_ASSERT_EQUAL_UINT64(0, reader.united);
    is_number(0.5, 2);
    is_kind(HCI_NUMBER_NONE, 3);
    is_kind(HCI_NUMBER_NONE, 4); /* with the mark of another column */
    is_number(2.0, 5);
    is_number(7e-3, 6);
    TEST_ASSERT_EQUAL_UINT64(2, reader.united);
    TEST_ASSERT_EQUAL_UINT64(2, reader.first_united);
}

/* Asked for in another unit than the column's, and than the cell's. */
static void test_units_of_cell_column_and_asker(void)
{
    read_column("torque_Nm,x\n2,a\n3 kNm,b\n50 mNm,c\n4 Nm,d\n", "torque_mNm");
    is_number(2e3, 1);
    is_number(3e6, 2);
    is_number(50.0, 3);
    is_number(4e3, 4);
    TEST_ASSERT_EQUAL_UINT64(2, reader.united);
}

/* ---- times ---- */

/* Of the day, in the unit of the column, from the beginning of the first day. */
static void test_clock_times(void)
{
    read_column("time_s,x\n12:00:01.5,a\n00:02.25,b\n7.5,c\n", "time_s");
    is_number(43201.5, 1);
    is_number(2.25, 2);
    is_number(7.5, 3);
    read_column("time_ms,x\n00:00:01.5,a\n250,b\n", "time_s");
    is_number(1.5, 1);
    is_number(0.25, 2);
    read_column("time_s,x\n2024-02-28 23:00:00,a\n2024-02-29 01:00:00,b\n2024-03-01 01:00:02,c\n", "time_s");
    is_number(82800.0, 1);
    is_number(86400.0 + 3600.0, 2);
    is_number(2.0 * 86400.0 + 3602.0, 3);
    read_column("torque_Nm,x\n12:00:01.5,a\n", "torque_Nm");
    is_kind(HCI_NUMBER_NONE, 1);
}

/* ---- orders ---- */

static void test_orders(void)
{
    read_column("order,x\n3,a\n18/7,b\n", "order");
    is_number(3.0, 1);
    is_number(18.0 / 7.0, 2);
    read_text("order,x\n3,a\n24/7,b\n");
    hci_csv_orders_of(csv, 4, HCI_ORDER_MECHANICAL);
    hci_column_match found = hci_column_find(csv, "order");
    reader = hci_cell_reader_of(csv, "order", &found);
    is_number(0.75, 1);
    is_number(6.0 / 7.0, 2);
    read_text("mechanical_order,x\n3,a\n");
    hci_csv_orders_of(csv, 4, HCI_ORDER_ELECTRICAL);
    found = hci_column_find(csv, "order");
    reader = hci_cell_reader_of(csv, "order", &found);
    is_number(0.75, 1);
    read_text("electrical_order,x\n3,a\n");
    hci_csv_orders_of(csv, 4, HCI_ORDER_MECHANICAL);
    found = hci_column_find(csv, "order");
    reader = hci_cell_reader_of(csv, "order", &found);
    is_number(3.0, 1);
    read_column("torque_Nm,x\n18/7,b\n", "torque_Nm");
    is_kind(HCI_NUMBER_NONE, 1);
}

/* Of any column, without a unit. */
static void test_a_plain_reader(void)
{
    read_text("a;lamp\n1;0,5\n2;1,25\n3;12:00:01\n4;3 A\n");
    reader = hci_cell_reader_plain(csv, 1);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, reader.factor);
    is_number(0.5, 1);
    is_number(1.25, 2);
    is_kind(HCI_NUMBER_NONE, 3);
    is_kind(HCI_NUMBER_NONE, 4);
}

/* Numbers in memory have no marks. */
static void test_numbers_in_memory(void)
{
    static const double torque[] = {250.0, NAN, INFINITY}, other[] = {1.0, 2.0, 3.0};
    static const char *const names[] = {"torque_mNm", "lamp"};
    static const double *const columns[] = {torque, other};
    const hci_csv_memory from = {.name = "m", .column = names, .value = columns, .columns = 2, .rows = 3};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_of_memory(&from, &csv, &note), note.text);
    const hci_column_match found = hci_column_find(csv, "torque_Nm");
    reader = hci_cell_reader_of(csv, "torque_Nm", &found);
    is_number(0.25, 1);
    is_kind(HCI_NUMBER_NONE, 2);
    is_kind(HCI_NUMBER_NOT_FINITE, 3);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_column_tells_its_mark);
    RUN_TEST(test_the_file_tells_a_mark);
    RUN_TEST(test_how_far_the_file_is_looked_at);
    RUN_TEST(test_factors);
    RUN_TEST(test_cells_with_a_unit);
    RUN_TEST(test_units_of_cell_column_and_asker);
    RUN_TEST(test_clock_times);
    RUN_TEST(test_orders);
    RUN_TEST(test_a_plain_reader);
    RUN_TEST(test_numbers_in_memory);
    return UNITY_END();
}
