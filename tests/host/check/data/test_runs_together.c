/* What recordings tell beside each other: torques that were typed, the zero of the torque sensor, the current
 * that is none. Statistics are written by hand. */
#define hci_check_runs_read    runs_read
#define hci_check_data_release data_release
#define hci_check_has_current  has_current
#include "host/check/data/runs.c"

#include "support/texts.h"
#include "unity.h"

enum { RUNS = 5 };

static check_run run[RUNS];
static check_data data;
static const char *const PATH[RUNS] = {"a.csv", "b.csv", "c.csv", "d.csv", "e.csv"};

/* Five recordings of different torques and currents. */
void setUp(void)
{
    memset(run, 0, sizeof run);
    memset(&data, 0, sizeof data);
    data.run = run;
    data.runs = RUNS;
    data.value[CHECK_pole_pairs] = 4.0;
    data.value[CHECK_rated_current_A] = NAN;
    for (size_t k = 0; k < RUNS; ++k) {
        const double current_A = 2.0 + (double)k;
        run[k] = (check_run){.path = PATH[k], .count = 3, .has_torque = true, .has_speed = true};
        run[k].torque_mean = 1.0 + 0.5 * (double)k;
        run[k].torque_at_speed = 10.0 + (double)k;
        run[k].torque_variance = 0.01;
        run[k].current_square = current_A * current_A;
        run[k].speed = k % 2 ? -10.0 : 10.0;
        run[k].torque = hci_memory_new(3, sizeof(double));
        for (size_t n = 0; n < 3; ++n)
            run[k].torque[n] = run[k].torque_mean + 0.1 * ((double)n - 1.0);
    }
}

void tearDown(void)
{
    for (size_t k = 0; k < RUNS; ++k)
        hci_memory_free(run[k].torque);
}

/* ---- one number for torque ---- */

static void make_one_number(size_t k, double torque_Nm)
{
    run[k].torque_mean = torque_Nm;
    run[k].torque_variance = 0.0;
}

static void is_typed(size_t k, double torque_Nm)
{
    TEST_ASSERT_EQUAL_DOUBLE(torque_Nm, run[k].typed_torque);
}

/* The same number at currents that differ by a tenth of the largest, which is 6 A. */
static void test_one_number_at_two_currents(void)
{
    make_one_number(1, 0.7);
    make_one_number(3, 0.7 * (1.0 + 0.9e-9));
    run[3].current_square = pow(3.0 + 0.59, 2.0);
    typed_find(&data);
    is_typed(1, 0.0);
    is_typed(3, 0.0);
    run[3].current_square = pow(3.0 - 0.61, 2.0);
    typed_find(&data);
    is_typed(1, 0.7);
    is_typed(3, run[3].torque_mean);
    is_typed(0, 0.0);
    is_typed(2, 0.0);
    is_typed(4, 0.0);
}

static void test_two_numbers_that_differ(void)
{
    make_one_number(1, 0.7);
    make_one_number(3, 0.7 * (1.0 + 1.2e-9));
    typed_find(&data);
    is_typed(1, 0.0);
    make_one_number(3, -0.7);
    typed_find(&data);
    is_typed(1, 0.0);
    make_one_number(3, 0.7);
    run[3].torque_variance = pow(0.7 * 1.1e-9, 2.0);
    typed_find(&data);
    is_typed(1, 0.0);
    run[3].torque_variance = pow(0.7 * 0.9e-9, 2.0);
    run[3].path = PATH[1]; /* of one file */
    typed_find(&data);
    is_typed(1, 0.0);
    run[3].path = PATH[3];
    run[3].has_torque = false;
    typed_find(&data);
    is_typed(1, 0.0);
}

/* One that was typed by itself, at whatever current. */
static void test_a_number_beside_one_that_was_typed(void)
{
    make_one_number(1, 0.7);
    run[4].has_torque = false;
    run[4].typed_torque = 0.7;
    run[4].current_square = run[1].current_square;
    typed_find(&data);
    is_typed(1, 0.7);
    run[1].typed_torque = 0.0;
    run[4].typed_torque = 0.8;
    typed_find(&data);
    is_typed(1, 0.0);
}

/* Said once of each file. */
static void test_typed_torques_are_left(void)
{
    hci_note remark[RUNS] = {{{0}}};
    run[2].typed_torque = run[3].typed_torque = 0.9;
    run[3].path = run[2].path;
    run[4].typed_torque = 0.4;
    run[4].has_torque = false;
    typed_leave(PATH, RUNS, &data, remark);
    for (size_t k = 0; k < RUNS; ++k) {
        TEST_ASSERT_EQUAL(k < 2, run[k].has_torque);
        TEST_ASSERT_EQUAL(k == 2 || k == 3, run[k].torque == NULL);
        TEST_ASSERT_EQUAL_INT(k == 2, text_count("one number in every row, as in another", remark[k].text));
    }
}

/* ---- the zero of the torque sensor ---- */

/* Forward and back without a current: runs 0 to 2, of 3, 5 and 4 samples. */
static void make_open(double back_speed)
{
    static const double TORQUE[] = {0.30, -0.14, 0.21}, SPEED[] = {8.0, 0.0, 11.0};
    static const size_t COUNT[] = {3, 5, 4};
    data.no_current_A = 0.1;
    for (size_t k = 0; k < 3; ++k) {
        run[k].torque_mean = TORQUE[k];
        run[k].has_torque = true;
        run[k].current_square = 0.0081;
        run[k].speed = k == 1 ? -back_speed : SPEED[k];
        run[k].count = COUNT[k];
        hci_memory_free(run[k].torque);
        run[k].torque = NULL;
    }
}

/* The mean of both directions, each by its samples, is taken out of all torques; at speeds that differ by
 * less than a quarter: (3·8 + 4·11)/7 is 9.714. */
static void test_the_zero_of_the_sensor(void)
{
    const double zero = 0.5 * ((3.0 * 0.30 + 4.0 * 0.21) / 7.0 - 0.14);
    make_open(12.0);
    take_torque_zero(&data);
    TEST_ASSERT_TRUE(data.torque_zero_is_told);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.30 - zero, run[0].torque_mean);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.14 - zero, run[1].torque_mean);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.5 - zero, run[3].torque_mean);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 13.0 - zero, run[3].torque_at_speed);
    for (size_t n = 0; n < 3; ++n)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.5 + 0.1 * ((double)n - 1.0) - zero, run[3].torque[n]);
}

static void test_zeros_that_are_not_told(void)
{
    static const double SPEEDS[] = {12.2, 7.7, 12.0, 7.9};
    for (int k = 0; k < 4; ++k) {
        make_open(SPEEDS[k]);
        take_torque_zero(&data);
        TEST_ASSERT_EQUAL(k >= 2, data.torque_zero_is_told);
    }
    make_open(10.0);
    run[1].current_square = 0.0121; /* with a current */
    take_torque_zero(&data);
    TEST_ASSERT_FALSE(data.torque_zero_is_told);
    TEST_ASSERT_EQUAL_DOUBLE(0.30, run[0].torque_mean);
    make_open(10.0);
    run[1].has_torque = false;
    take_torque_zero(&data);
    TEST_ASSERT_FALSE(data.torque_zero_is_told);
    make_open(10.0);
    run[1].has_speed = false; /* by the angle then */
    run[1].angle_rate = -10.0;
    run[1].speed = NAN;
    take_torque_zero(&data);
    TEST_ASSERT_TRUE(data.torque_zero_is_told);
}

/* ---- what is compared with ---- */

static void test_the_current_that_is_none(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, CHECK_NO_CURRENT * 6.0, no_current(&data));
    data.value[CHECK_rated_current_A] = 9.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, CHECK_NO_CURRENT * 9.0, no_current(&data));
    data.value[CHECK_rated_current_A] = 9000.0; /* of recordings that do not tell it from a current */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, CHECK_NO_CURRENT * 9000.0, no_current(&data));
    run[0].current_square = pow(0.9 * CHECK_NO_CURRENT * 6.0, 2.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, CHECK_NO_CURRENT * 6.0, no_current(&data));
    run[0].current_square = pow(1.1 * CHECK_NO_CURRENT * 6.0, 2.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, CHECK_NO_CURRENT * 9000.0, no_current(&data));
    data.no_current_A = 4.5;
    TEST_ASSERT_FALSE(has_current(&data, &run[2]));
    TEST_ASSERT_TRUE(has_current(&data, &run[3]));
    data.no_current_A = -1.0;
    run[0].current_square = 0.0;
    TEST_ASSERT_FALSE(has_current(&data, &run[0]));
}

/* 1, p and p/2 electrical radians, and so for degrees, turns, and radians that were read as degrees, each
 * once. */
static void test_scales_of_an_angle(void)
{
    static const struct {
        double pole_pairs;
        size_t scales;
        double scale[3];
    } CASES[] = {{4.0, 12, {1.0, 4.0, 2.0}}, {5.0, 8, {1.0, 5.0}}, {2.0, 8, {1.0, 2.0}}, {1.0, 4, {1.0}}};
    static const double UNIT[] = {1.0, HCI_PI / 180.0, 2.0 * HCI_PI, 180.0 / HCI_PI};
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; ++c) {
        const size_t of_unit = CASES[c].scales / 4;
        data.scales = 0;
        data.value[CHECK_pole_pairs] = CASES[c].pole_pairs;
        scales_make(&data);
        TEST_ASSERT_EQUAL_UINT64(CASES[c].scales, data.scales);
        for (size_t k = 0; k < CASES[c].scales; ++k)
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, CASES[c].scale[k % of_unit] * UNIT[k / of_unit], data.scale[k]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_one_number_at_two_currents);
    RUN_TEST(test_two_numbers_that_differ);
    RUN_TEST(test_a_number_beside_one_that_was_typed);
    RUN_TEST(test_typed_torques_are_left);
    RUN_TEST(test_the_zero_of_the_sensor);
    RUN_TEST(test_zeros_that_are_not_told);
    RUN_TEST(test_the_current_that_is_none);
    RUN_TEST(test_scales_of_an_angle);
    return UNITY_END();
}
