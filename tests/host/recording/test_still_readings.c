/* Where each rule of holes.c begins: readings that stay, a sensor at its end, a shaft that stands. Rows are
 * given to its parts as they are, without a file. */
#define hci_run_columns_open     rows_open
#define hci_run_columns_open_any rows_open_any
#include "host/recording/holes.c"
#undef hci_run_columns_open
#undef hci_run_columns_open_any

#include "support/texts.h"
#include "unity.h"

enum { MOST = 2400 };

static double value[MOST], angle[MOST], work[MOST];
static bool is_left[MOST];
static size_t fresh[MOST];
static hci_run_columns columns;
static hci_note remark;
static rows_task task;

void setUp(void)
{
    memset(&columns, 0, sizeof columns);
    memset(&remark, 0, sizeof remark);
    columns.remark = &remark;
    task = (rows_task){.c = &columns, .rows = MOST, .is_left = is_left};
    for (size_t k = 0; k < MOST; ++k)
        is_left[k] = true;
}

void tearDown(void)
{
}

static readings of(const double *column)
{
    return (readings){{column}, 1, "torque"};
}

/* ---- temperatures between ---- */

static void test_values_between_are_on_a_line(void)
{
    double x[] = {NAN, NAN, 3.0, NAN, NAN, NAN, 11.0, 4.0, NAN, NAN};
    const double expected[] = {3.0, 3.0, 3.0, 5.0, 7.0, 9.0, 11.0, 4.0, 4.0, 4.0};
    interpolate(x, 10);
    for (int k = 0; k < 10; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected[k], x[k]);
    TEST_ASSERT_EQUAL_UINT64(2, missing_in((double[]){NAN, 1.0, NAN, 0.0}, 4));
}

/* ---- fresh readings ---- */

/* Rows that are used and differ from the last that was fresh, in any of the columns. */
static void test_which_readings_are_fresh(void)
{
    const double a[] = {1.0, 1.0, 2.0, 2.0, 2.0, 1.0, 1.0}, b[] = {5.0, 5.0, 5.0, 6.0, 6.0, 6.0, 6.0};
    const size_t one[] = {0, 2, 5}, both[] = {0, 2, 3, 5};
    const readings x = {{a}, 1, ""}, y = {{a, b}, 2, ""};
    task.rows = 7;
    TEST_ASSERT_EQUAL_UINT64(3, fresh_find(&task, &x, fresh));
    TEST_ASSERT_EQUAL_MEMORY(one, fresh, sizeof one);
    TEST_ASSERT_EQUAL_UINT64(4, fresh_find(&task, &y, fresh));
    TEST_ASSERT_EQUAL_MEMORY(both, fresh, sizeof both);
    is_left[0] = is_left[2] = false;
    TEST_ASSERT_EQUAL_UINT64(3, fresh_find(&task, &x, fresh));
    TEST_ASSERT_EQUAL_UINT64(1, fresh[0]);
    TEST_ASSERT_EQUAL_UINT64(3, fresh[1]);
    TEST_ASSERT_EQUAL_UINT64(2, length_of(&task, fresh, 3, 1));
    TEST_ASSERT_EQUAL_UINT64(2, length_of(&task, fresh, 3, 2));
    TEST_ASSERT_EQUAL_UINT64(1, length_of(&task, fresh, 3, 0));
}

/* Steps of a reading one after the other; all rows are fresh. */
static bool is_fine_of(double from, const double *steps, size_t period, size_t count)
{
    const readings x = of(value);
    value[0] = from;
    for (size_t k = 0; k < count; ++k)
        fresh[k] = k, value[k] = k > 0 ? value[k - 1] + steps[(k - 1) % period] * (k % 2 ? 1.0 : -1.0) : from;
    return is_fine(&x, fresh, count, work);
}

/* A reading is coarse whose steps are whole numbers of the smallest, within 2 % of it, in nine of ten; unless
 * they usually are more than four of these. */
static void test_which_readings_are_fine(void)
{
    const double whole[] = {1.0, 2.0, 3.0, 2.0, 1.0, 3.0, 2.0, 1.0, 2.0, 3.0},
                 near_[] = {1.0, 2.015, 2.985, 2.01}, off[] = {1.0, 2.03, 2.5, 2.6},
                 large[] = {1.0, 5.0, 6.0}, four[] = {1.0, 4.0, 4.0, 3.0};
    double some[20];
    TEST_ASSERT_FALSE(is_fine_of(50.0, whole, 10, 101));
    TEST_ASSERT_FALSE(is_fine_of(50.0, near_, 4, 101));
    TEST_ASSERT_TRUE(is_fine_of(50.0, off, 4, 101));
    TEST_ASSERT_TRUE(is_fine_of(50.0, large, 3, 101));
    TEST_ASSERT_FALSE(is_fine_of(50.0, four, 4, 101));
    for (int odd = 1; odd <= 3; ++odd) { /* one, two or three of 20 are no whole number */
        for (int k = 0; k < 20; ++k)
            some[k] = k < odd ? 2.4 : 1.0 + k % 3;
        TEST_ASSERT_EQUAL(odd == 3, is_fine_of(50.0, some, 20, 101));
    }
}

/* Usual steps of 1e-9 of the largest reading are rounding, whatever they are. */
static void test_rounding_is_not_fine(void)
{
    const double steps[] = {1.0, 1.37, 1.83};
    TEST_ASSERT_TRUE(is_fine_of(1.2e9, steps, 3, 101));
    TEST_ASSERT_FALSE(is_fine_of(1.6e9, steps, 3, 101));
    TEST_ASSERT_FALSE(is_fine_of(-1.6e9, steps, 3, 101));
    TEST_ASSERT_FALSE(is_fine_of(5.0, (double[]){0.0}, 1, 101));
}

/* ---- stretches ---- */

/* Without equal neighbours two pairs of the same are chance up to eight, and no more. */
static void test_pairs_by_chance(void)
{
    const readings x = of(value);
    for (int pairs = 8; pairs <= 9; ++pairs) {
        size_t count = 0;
        for (size_t k = 0; k < 400; ++k)
            value[k] = (double)(k - (k % 40 == 7 && k < 40 * (size_t)pairs ? 1 : 0));
        task.rows = 400;
        count = fresh_find(&task, &x, fresh);
        TEST_ASSERT_EQUAL_DOUBLE(pairs == 8 ? 2.0 : 1.0, longest_by_chance(&task, &x, fresh, count));
    }
}

/* Where one in so many is as the second one before it, a stretch of n by chance has the odds of the n-th
 * power: one in a million of the recording. */
static void test_the_longest_stretch_by_chance(void)
{
    const readings x = of(value);
    for (size_t each = 3; each < 40; each += 9) {
        double equal = 0.0;
        const size_t count = 600;
        for (size_t k = 0; k < count; ++k)
            fresh[k] = k, value[k] = k % each == 2 ? value[k - 2] : (double)k;
        for (size_t k = 2; k < count; ++k)
            equal += value[k] == value[k - 2];
        task.rows = count;
        const double longest = longest_by_chance(&task, &x, fresh, count);
        /* the odds of longest − 1 more that are equal, times the readings */
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1e-6, pow(equal / (double)count, longest - 1.0) * (double)count);
    }
}

/* The first row of a stretch stays; those that are longer than `longest` lose the others. */
static void test_stretches_are_left_out(void)
{
    const readings x = of(value);
    const int left[] = {1, 1, 1, 1, 0, 0, 0, 1, 0, 0, 0};
    const double values[] = {1.0, 2.0, 2.0, 3.0, 3.0, 3.0, 3.0, 4.0, 4.0, 4.0, 4.0};
    task.rows = 11;
    memcpy(value, values, sizeof values);
    const size_t count = fresh_find(&task, &x, fresh);
    TEST_ASSERT_EQUAL_UINT64(0, stretches_leave(&task, &x, fresh, count, 4.0));
    TEST_ASSERT_EQUAL_UINT64(6, stretches_leave(&task, &x, fresh, count, 3.0));
    for (int k = 0; k < 11; ++k)
        TEST_ASSERT_EQUAL(left[k], is_left[k]);
}

/* From fifty fresh readings on. */
static void test_how_many_readings_tell(void)
{
    for (size_t few = 49; few <= 50; ++few) {
        setUp();
        task.rows = 3 * few;
        for (size_t k = 0; k < task.rows; ++k)
            value[k] = sqrt((double)(k / 3));
        const readings x = of(value);
        TEST_ASSERT_EQUAL(HCI_OK, leave_still_out(&task, &x));
        TEST_ASSERT_EQUAL_UINT64(few < 50 ? 0 : 2 * few, task.still);
        if (few == 50) text_has("100 of 150 rows repeat the torque before: read less often", remark.text);
    }
}

/* No current in rows without a time is that of a table; over time it is a reading that stays. */
static void test_no_current_of_a_table(void)
{
    for (int timed = 0; timed < 2; ++timed) {
        setUp();
        task.rows = 300;
        for (size_t k = 0; k < task.rows; ++k)
            value[k] = k < 200 ? sqrt((double)k + 1.0) : 0.0;
        columns.ready[HCI_RUN_TIME] = timed ? angle : NULL;
        const readings x = {{value, value}, 2, "currents"};
        TEST_ASSERT_EQUAL(HCI_OK, leave_still_out(&task, &x));
        TEST_ASSERT_EQUAL_UINT64(timed ? 99 : 0, task.still);
    }
}

/* ---- a sensor at its end ---- */

/* A torque that comes to its end `times` times for `stay` rows, and otherwise goes on; `twice` other readings
 * are there twice. */
static void make_clipped(size_t times, size_t stay, size_t twice)
{
    const size_t apart = task.rows / times;
    for (size_t k = 0; k < task.rows; ++k) {
        const size_t at = k % apart;
        value[k] = at < stay && k / apart < times ? 7.5 : sin((double)k) * 7.0;
    }
    for (size_t k = 0; k < twice; ++k)
        value[k * apart / 2 + apart / 4] = value[k * apart / 2 + apart / 4 - 1];
}

static bool is_clipped_now(void)
{
    columns.torque_is_clipped = false;
    for (size_t k = 0; k < MOST; ++k)
        is_left[k] = true;
    leave_clipped_out(&task, value);
    return columns.torque_is_clipped;
}

static void test_a_sensor_at_its_end(void)
{
    task.rows = 1000;
    make_clipped(3, 4, 0);
    TEST_ASSERT_TRUE(is_clipped_now());
    TEST_ASSERT_EQUAL_UINT64(12, task.still);
    text_has("in 12 of 1000 rows it stands at 7.5 N·m, its largest, as of a sensor", remark.text);
    text_lacks("least value", remark.text);
    for (size_t k = 0; k < 1000; ++k)
        TEST_ASSERT_EQUAL(value[k] < 7.5, is_left[k]);
    make_clipped(2, 6, 0); /* comes there too seldom */
    TEST_ASSERT_FALSE(is_clipped_now());
    make_clipped(3, 3, 0); /* nine rows of a thousand */
    TEST_ASSERT_FALSE(is_clipped_now());
    make_clipped(11, 1, 0); /* never twice in a row */
    TEST_ASSERT_FALSE(is_clipped_now());
    make_clipped(10, 2, 0); /* half of them again */
    TEST_ASSERT_FALSE(is_clipped_now());
    make_clipped(10, 3, 0);
    TEST_ASSERT_TRUE(is_clipped_now());
    make_clipped(19, 2, 0);
    TEST_ASSERT_FALSE(is_clipped_now());
}

/* Of what repeats 95 % is the end: 19 of 20 rows, not 19 of 21. */
static void test_what_else_repeats(void)
{
    task.rows = 1000;
    for (size_t twice = 1; twice <= 2; ++twice) {
        make_clipped(10, 3, 0);
        value[97] = value[96] = 7.5 - 7.5; /* so that 20 repeats are of the end … */
        for (size_t k = 0; k < twice; ++k)
            value[50 + 5 * k] = value[49 + 5 * k];
        value[97] = 0.3;
        TEST_ASSERT_EQUAL(twice == 1, is_clipped_now());
    }
}

/* Both ends, told together. */
static void test_both_ends(void)
{
    task.rows = 1000;
    make_clipped(5, 4, 0);
    for (size_t k = 0; k < 1000; ++k)
        if (k % 200 >= 100 && k % 200 < 104) value[k] = -8.25;
    TEST_ASSERT_TRUE(is_clipped_now());
    text_has("in 40 of 1000 rows it stands at -8.25 N·m, its least value, or 7.5 N·m, its largest, as",
             remark.text);
}

/* Fifty readings between the ends. */
static void test_readings_between_the_ends(void)
{
    for (size_t between = 49; between <= 50; ++between) {
        task.rows = 3 * 8 + between + 1; /* of so few rows the least one is an end too */
        for (size_t k = 0; k < task.rows; ++k)
            value[k] = k < 24 && k % 8 < 7 ? 7.5 : (double)k / 100.0;
        for (size_t k = 24; k < 27; ++k) /* three of them are among the ends */
            value[k] = 7.5;
        TEST_ASSERT_EQUAL(between == 50, is_clipped_now());
    }
}

/* ---- a shaft that stands ---- */

/* The angle of a shaft that turns by one count in `stay` rows, and stands `stand` rows, `times` times. */
static size_t make_stands(size_t stay, size_t stand, size_t times)
{
    size_t rows = 0, at = 0;
    for (size_t turn = 0; turn <= times; ++turn) {
        for (size_t k = 0; k < 30 * stay; ++k)
            angle[rows++] = (double)(at + k / stay);
        at += 30;
        for (size_t k = 0; k < stand && turn < times; ++k)
            angle[rows++] = (double)at - 1.0; /* beside the `stay` rows that it was there already */
    }
    task.rows = rows;
    return rows;
}

static double longest_stay(void)
{
    const readings x = of(angle);
    const size_t count = fresh_find(&task, &x, fresh);
    return stay_of_turning(&task, fresh, count);
}

/* Longer than fifty rows, and twenty times as long as usual: of 3 rows. */
static void test_how_long_a_shaft_stands(void)
{
    make_stands(1, 49, 2);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, longest_stay());
    make_stands(1, 51, 2);
    TEST_ASSERT_EQUAL_DOUBLE(50.0, longest_stay());
    make_stands(3, 56, 2);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, longest_stay());
    make_stands(3, 58, 2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 60.0, longest_stay());
}

/* Three times, and eight where the torque was measured. */
static void test_how_often_a_shaft_stands(void)
{
    for (size_t times = 1; times <= 9; ++times) {
        make_stands(1, 60, times);
        columns.ready[HCI_RUN_TORQUE] = NULL;
        TEST_ASSERT_EQUAL(times <= 3, longest_stay() > 0.0);
        columns.ready[HCI_RUN_TORQUE] = value;
        TEST_ASSERT_EQUAL(times <= 8, longest_stay() > 0.0);
    }
}

/* Of 50 counts and more that it turns by. */
static void test_how_much_a_shaft_turns(void)
{
    make_stands(1, 60, 1); /* 59 and the one that it stands at */
    TEST_ASSERT_TRUE(longest_stay() > 0.0);
    task.rows -= 9;
    TEST_ASSERT_TRUE(longest_stay() > 0.0);
    task.rows -= 1;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, longest_stay());
}

/* One count to and fro is none, if it comes back within fifty rows. */
static void test_an_angle_that_flickers(void)
{
    double x[] = {0.0, 2.0, 4.0, 6.0, 8.0, 6.0, 8.0, 6.0, 6.0, 10.0};
    const double held[] = {0.0, 2.0, 4.0, 6.0, 6.0, 6.0, 6.0, 6.0, 6.0, 10.0};
    task.rows = 10;
    TEST_ASSERT_EQUAL_DOUBLE(2.0, smallest_step(&task, x));
    hold_angle(&task, x, work);
    TEST_ASSERT_EQUAL_MEMORY(held, work, sizeof held);
    is_left[4] = is_left[6] = false; /* what is not used is held */
    x[4] = x[6] = 6.5;
    TEST_ASSERT_EQUAL_DOUBLE(2.0, smallest_step(&task, x));
    for (size_t away = 50; away <= 51; ++away) {
        setUp();
        task.rows = 60;
        for (size_t k = 0; k < 60; ++k)
            angle[k] = k == 0 || k == 1 + away ? 5.0 : 6.0;
        TEST_ASSERT_EQUAL(away == 50, is_back(&task, angle, 1, 5.0));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_values_between_are_on_a_line);
    RUN_TEST(test_which_readings_are_fresh);
    RUN_TEST(test_which_readings_are_fine);
    RUN_TEST(test_rounding_is_not_fine);
    RUN_TEST(test_pairs_by_chance);
    RUN_TEST(test_the_longest_stretch_by_chance);
    RUN_TEST(test_stretches_are_left_out);
    RUN_TEST(test_how_many_readings_tell);
    RUN_TEST(test_no_current_of_a_table);
    RUN_TEST(test_a_sensor_at_its_end);
    RUN_TEST(test_what_else_repeats);
    RUN_TEST(test_both_ends);
    RUN_TEST(test_readings_between_the_ends);
    RUN_TEST(test_how_long_a_shaft_stands);
    RUN_TEST(test_how_often_a_shaft_stands);
    RUN_TEST(test_how_much_a_shaft_turns);
    RUN_TEST(test_an_angle_that_flickers);
    return UNITY_END();
}
