/* Tables with two clocks, and tables that were sorted by the angle (clock.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "host/csv/table.h"
#include "host/recording/clock.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

enum { MOST = 200 };

static hci_csv *csv;
static hci_note note;

void setUp(void)
{
    csv = NULL;
    memset(&note, 0, sizeof note);
    files_begin();
}

void tearDown(void)
{
    hci_csv_free(csv);
    files_end();
}

static FILE *open_table(const char *header)
{
    FILE *file = fopen(files_path("a.csv"), "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "%s\n", header);
    return file;
}

static void read_table(FILE *file)
{
    fclose(file);
    hci_csv_free(csv);
    csv = NULL;
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read_recording(files_path("a.csv"), &csv, &note), note.text);
}

/* ---- two clocks ---- */

/* Rows of two clocks a second a row, the second of which runs `factor` times as fast from its first value on
 * and is held for `held` rows. */
static hci_status agree(const char *header, size_t rows, double factor, size_t held)
{
    FILE *file = open_table(header);
    for (size_t k = 0; k < rows; ++k)
        fprintf(file, "%zu,%.3f,%.9g,%.3f\n", k, 0.1 * (double)k, 70.0 + factor * (double)(k / held * held),
                0.2 * (double)k);
    read_table(file);
    return hci_clocks_agree(csv, &note);
}

static const char TWO[] = "time_s,theta_m_rad,time2_s,torque_Nm";

/* A twentieth of the shorter record and one and a half of the longer steps: of 100 s, 99·0.06 = 5.94 beside
 * 0.05·93.06 + 1.5 = 6.15, and 99·0.07 = 6.93 beside 6.10. */
static void test_how_far_two_clocks_may_be_apart(void)
{
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, agree(TWO, 100, 0.94, 1), note.text);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, agree(TWO, 100, 0.93, 1));
    text_has("a.csv:101: column 3 ", note.text);
    text_has("found a second time, 162.07 s where ", note.text);
    text_has("is 99 s, so that", note.text);
    text_has("torque_Nm", note.text);
    text_has("and what else stands to its right is of other instants", note.text);
    text_has("--column \"none=torque_Nm\" and so", note.text);
    TEST_ASSERT_EQUAL(HCI_OK, agree(TWO, 100, 1.06, 1)); /* 5.94 beside 0.05·99 + 1.5·1.06 = 6.54 */
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, agree(TWO, 100, 1.07, 1)); /* 6.93 beside 6.55 */
}

/* A clock that is held for rows may be late by one and a half of its steps: by 9 rows of 10, but for 27. */
static void test_a_clock_that_is_held(void)
{
    TEST_ASSERT_EQUAL(HCI_OK, agree(TWO, 100, 1.0, 10));
    TEST_ASSERT_EQUAL(HCI_OK, agree(TWO, 100, 1.06, 10));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, agree(TWO, 100, 0.7, 10));
    text_has(":101: column 3 ", note.text);
}

/* Sixteen rows tell. */
static void test_few_rows_tell_no_clock(void)
{
    TEST_ASSERT_EQUAL(HCI_OK, agree(TWO, 15, 3.0, 1));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, agree(TWO, 16, 3.0, 1));
}

/* What goes back is no clock. */
static void test_a_column_that_goes_back(void)
{
    TEST_ASSERT_EQUAL(HCI_OK, agree(TWO, 100, -1.0, 1));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, agree(TWO, 100, 0.001, 1));
}

/* Only where columns that are known stand to the right of both. */
static void test_clocks_that_nothing_goes_by(void)
{
    TEST_ASSERT_EQUAL(HCI_OK, agree("time_s,theta_m_rad,time2_s,lamp", 100, 0.5, 1));
    TEST_ASSERT_EQUAL(HCI_OK, agree("time_s,lamp,time2_s,torque_Nm", 100, 0.5, 1));
    TEST_ASSERT_EQUAL(HCI_OK, agree("time_s,theta_m_rad,lamp,torque_Nm", 100, 0.5, 1));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, agree(TWO, 100, 0.5, 1));
}

/* What is left out or given a name does not go by its header. */
static void test_columns_that_are_given(void)
{
    agree(TWO, 100, 0.5, 1);
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_give(csv, "none", 3, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_clocks_agree(csv, &note));
    agree("time_s,theta_m_rad,time2_s,lamp", 100, 0.5, 1);
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_give(csv, "torque_Nm", 3, &note));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_clocks_agree(csv, &note));
    agree(TWO, 100, 0.5, 1);
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_give(csv, "none", 2, &note)); /* that time itself */
    TEST_ASSERT_EQUAL(HCI_OK, hci_clocks_agree(csv, &note));
}

/* Rows with one of the two do not count, nor does what stands before the first with both; of three clocks the
 * last one is off, from its first row on. */
static void test_holes_and_a_third_clock(void)
{
    FILE *file = open_table("time_s,theta_m_rad,time2_s,iq_A,time3_s,torque_Nm");
    for (int k = 0; k < 100; ++k) {
        fprintf(file, "%d,%.3f,", k, 0.1 * k);
        if (k < 3)
            fprintf(file, "%d,0.5,,2\n", k);
        else if (k % 7 == 5)
            fprintf(file, ",0.5,,2\n");
        else
            fprintf(file, "%.2f,0.5,%.2f,2\n", 900.0 + k, 50.0 + 1.5 * k);
    }
    read_table(file);
    (void)hci_clocks_agree(csv, &note);
    text_has(":101: column 5 ", note.text);
    text_has("198.5 s where", note.text);
    text_has("is 99 s, so that", note.text);
    text_has("none=torque_Nm", note.text);
}

/* ---- rows by the angle ---- */

/* 100 rows in the order of the angle, whose times jump about by `jump` or 100 less of it. */
static void read_sorted(size_t n, size_t jump, double way, const char *header)
{
    FILE *file = open_table(header);
    for (size_t k = 0; k < n; ++k) {
        const size_t at = k * jump % n;
        fprintf(file, "%zu,%.4f,%zu\n", at, way * (double)k, 1000 + 3 * at);
    }
    read_table(file);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_rows_by_time(csv, &note), note.text);
}

static const char SORTED[] = "time_s,theta_m_rad,torque_Nm";

/* Whether rows stand by time, and each with all that is its own. */
static bool is_by_time(size_t n, size_t jump)
{
    double time_s[MOST], theta[MOST], torque[MOST];
    bool ordered = true;
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "time_s", time_s, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "theta_m_rad", theta, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "torque_Nm", torque, &note));
    for (size_t k = 0; k < n; ++k) {
        ordered = ordered && time_s[k] == (double)k;
        TEST_ASSERT_EQUAL_DOUBLE(1000.0 + 3.0 * time_s[k], torque[k]);
        TEST_ASSERT_EQUAL_DOUBLE(time_s[k], fmod(round(theta[k] / 0.01) * (double)jump, (double)n));
    }
    return ordered;
}

/* More than twenty mean steps to and fro are no order. */
static void test_rows_in_the_order_of_the_angle(void)
{
    read_sorted(100, 37, 0.01, SORTED);
    TEST_ASSERT_TRUE(is_by_time(100, 37));
    text_has("its rows stand in the order of the angle, and are taken in that of the time",
             csv->decided.text);
    read_sorted(100, 21, 0.01, SORTED);
    TEST_ASSERT_TRUE(is_by_time(100, 21));
    read_sorted(100, 19, 0.01, SORTED);
    TEST_ASSERT_FALSE(is_by_time(100, 19));
    TEST_ASSERT_EQUAL_STRING("", csv->decided.text);
}

/* An electrical angle does as well; one that goes back, or stands still, does not. */
static void test_which_angles_put_rows_in_order(void)
{
    double time_s[MOST];
    for (int which = 0; which < 3; ++which) {
        read_sorted(100, 37, which == 0 ? 0.01 : which == 1 ? -0.01 : 0.0, "time_s,theta_e_rad,torque_Nm");
        TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "time_s", time_s, &note));
        TEST_ASSERT_EQUAL_DOUBLE(which == 0 ? 1.0 : 37.0, time_s[1]);
    }
    read_sorted(100, 37, 0.01, "time_s,lamp,torque_Nm");
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "time_s", time_s, &note));
    TEST_ASSERT_EQUAL_DOUBLE(37.0, time_s[1]);
}

/* Steps that grow are none back, however long the last ones. */
static void test_uneven_steps_forward(void)
{
    FILE *file = open_table(SORTED);
    for (int k = 0; k < 100; ++k)
        fprintf(file, "%d,%.2f,1\n", k < 90 ? 0 : (k - 89) * 1000, 0.01 * k);
    read_table(file);
    TEST_ASSERT_EQUAL(HCI_OK, hci_rows_by_time(csv, &note));
    TEST_ASSERT_EQUAL_STRING("", csv->decided.text);
}

/* Rows of one time stay in the order that they stand in. */
static void test_rows_of_one_time(void)
{
    double time_s[MOST], theta[MOST];
    FILE *file = open_table(SORTED);
    for (int k = 0; k < 100; ++k)
        fprintf(file, "%d,%.2f,1\n", k * 37 % 100 / 4, 0.01 * k);
    read_table(file);
    TEST_ASSERT_EQUAL(HCI_OK, hci_rows_by_time(csv, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "time_s", time_s, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "theta_m_rad", theta, &note));
    for (int k = 0; k < 100; ++k) {
        TEST_ASSERT_EQUAL_DOUBLE(k / 4, time_s[k]);
        TEST_ASSERT_TRUE(k % 4 == 0 || theta[k] > theta[k - 1]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_how_far_two_clocks_may_be_apart);
    RUN_TEST(test_a_clock_that_is_held);
    RUN_TEST(test_few_rows_tell_no_clock);
    RUN_TEST(test_a_column_that_goes_back);
    RUN_TEST(test_clocks_that_nothing_goes_by);
    RUN_TEST(test_columns_that_are_given);
    RUN_TEST(test_holes_and_a_third_clock);
    RUN_TEST(test_rows_in_the_order_of_the_angle);
    RUN_TEST(test_which_angles_put_rows_in_order);
    RUN_TEST(test_uneven_steps_forward);
    RUN_TEST(test_rows_of_one_time);
    return UNITY_END();
}
