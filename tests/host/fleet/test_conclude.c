/* Motors of a line side by side: medians, spreads and limits by hand, who stands out and by what. */
#include <math.h>
#include <string.h>

#include "hci/host/fleet/line.h"
#include "host/base/memory.h"
#include "unity.h"

enum { MOTORS = 9, PARAMETERS = 3, RESIDUAL = PARAMETERS - 1 };

static hci_line_motor motor[MOTORS];
static hci_line_parameter parameter[PARAMETERS];
static double value[MOTORS][PARAMETERS], std_error[MOTORS][PARAMETERS];
static hci_line line;

/* 1 … 9 about 5, ten times that, and what stays unexplained about 1: medians of distances 2, 20 and 0.02. */
void setUp(void)
{
    memset(motor, 0, sizeof motor);
    memset(parameter, 0, sizeof parameter);
    for (int k = 0; k < MOTORS; ++k) {
        value[k][0] = k + 1.0;
        value[k][1] = 10.0 * (MOTORS - k);
        value[k][RESIDUAL] = 1.0 + 0.01 * (k - 4);
        std_error[k][0] = 0.1 * (k + 1.0);
        std_error[k][1] = 1.0;
        std_error[k][RESIDUAL] = 0.01;
        motor[k].day = NAN;
    }
    line = (hci_line){.motor = motor,
                      .motors = MOTORS,
                      .parameter = parameter,
                      .parameters = PARAMETERS,
                      .value = value[0],
                      .std_error = std_error[0]};
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
}

static void conclude(void)
{
    TEST_ASSERT_EQUAL(HCI_OK, hci_line_conclude(0.01, &line, NULL));
}

/* 1 % of motors by chance, shared by three parameters: 1 − 0.99^(1/3) two-sided is 2.93436 standard
 * deviations. */
static void test_limits(void)
{
    conclude();
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2.934161, line.limit);
    TEST_ASSERT_EQUAL_UINT64(MOTORS, parameter[0].motors);
    TEST_ASSERT_EQUAL_DOUBLE(5.0, parameter[0].median);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.4826 * 2.0, parameter[0].scale);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, parameter[0].noise);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.0 - line.limit * 2.9652, parameter[0].low);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.0 + line.limit * 2.9652, parameter[0].high);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.4826 * 20.0, parameter[1].scale);
    TEST_ASSERT_EQUAL_UINT64(0, hci_line_outside(&line));
}

/* A parameter that one motor alone tells compares none, and the limit is shared by the two others. */
static void test_values_that_are_not_told(void)
{
    for (int k = 1; k < MOTORS; ++k)
        value[k][1] = NAN;
    value[0][1] = 1e9;
    conclude();
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2.806225, line.limit);
    TEST_ASSERT_EQUAL_UINT64(1, parameter[1].motors);
    TEST_ASSERT_EQUAL_UINT64(0, parameter[1].outside);
    TEST_ASSERT_TRUE(isnan(hci_line_deviation(&line, 3, 1)));
    TEST_ASSERT_EQUAL_UINT64(0, hci_line_outside(&line));
    value[0][1] = NAN;
    conclude();
    TEST_ASSERT_EQUAL_UINT64(0, parameter[1].motors);
    TEST_ASSERT_TRUE(isnan(parameter[1].median) && isnan(parameter[1].scale));
}

/* Of a motor with more noise than usual the spread is that much wider: errors of 0.9 where 0.5 is usual. */
static void test_deviations(void)
{
    conclude();
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, (1.0 - 5.0) / 2.9652, hci_line_deviation(&line, 0, 0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, hci_line_deviation(&line, 4, 0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0 / sqrt(2.9652 * 2.9652 + 0.9 * 0.9 - 0.5 * 0.5),
                              hci_line_deviation(&line, 8, 0));
    std_error[8][0] = NAN;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0 / 2.9652, hci_line_deviation(&line, 8, 0));
}

/* Where all but one are the same, that one is beyond any limit, and the others are not off at all. */
static void test_values_without_a_spread(void)
{
    for (int k = 0; k < MOTORS; ++k) {
        value[k][0] = 7.0;
        std_error[k][0] = 0.0;
    }
    value[2][0] = 7.001;
    value[3][0] = 6.999;
    conclude();
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_line_deviation(&line, 1, 0));
    TEST_ASSERT_TRUE(hci_line_deviation(&line, 2, 0) == HUGE_VAL);
    TEST_ASSERT_TRUE(hci_line_deviation(&line, 3, 0) == -HUGE_VAL);
    TEST_ASSERT_EQUAL_UINT64(2, parameter[0].outside);
    TEST_ASSERT_EQUAL_UINT64(2, hci_line_outside(&line));
    TEST_ASSERT_TRUE(motor[2].stands_out && motor[3].stands_out && !motor[1].stands_out);
}

/* By the parameter that is furthest off, on either side. */
static void test_by_what_a_motor_stands_out(void)
{
    value[2][0] = 40.0;   /* 11.8 standard deviations */
    value[2][1] = -400.0; /* 15 of them, to the other side */
    conclude();
    TEST_ASSERT_TRUE(motor[2].stands_out);
    TEST_ASSERT_EQUAL_UINT64(1, motor[2].worst);
    TEST_ASSERT_EQUAL_DOUBLE(hci_line_deviation(&line, 2, 1), motor[2].deviation);
    TEST_ASSERT_TRUE(motor[2].deviation < -line.limit);
    TEST_ASSERT_FALSE(motor[2].leaves_more);
    TEST_ASSERT_EQUAL_UINT64(1, parameter[0].outside);
    TEST_ASSERT_EQUAL_UINT64(1, parameter[1].outside);
    TEST_ASSERT_EQUAL_UINT64(0, parameter[RESIDUAL].outside);
    TEST_ASSERT_EQUAL_UINT64(1, hci_line_outside(&line));
}

/* What stays names a motor where nothing else does; less of it than usual is no fault. */
static void test_a_motor_that_leaves_more(void)
{
    value[6][RESIDUAL] = 3.0;
    value[7][RESIDUAL] = 0.9;
    conclude();
    TEST_ASSERT_TRUE(motor[6].stands_out && motor[6].leaves_more);
    TEST_ASSERT_EQUAL_UINT64(RESIDUAL, motor[6].worst);
    TEST_ASSERT_FALSE(motor[7].leaves_more);
    value[6][0] = 40.0; /* describes it in part; its errors are three times as large as with the usual rest */
    std_error[6][0] = 3.0 * 0.5;
    conclude();
    TEST_ASSERT_TRUE(motor[6].leaves_more && motor[6].stands_out);
    TEST_ASSERT_EQUAL_UINT64(0, motor[6].worst);
    std_error[6][0] = 20.0; /* and is not three of its own off */
    conclude();
    TEST_ASSERT_EQUAL_UINT64(RESIDUAL, motor[6].worst);
    value[6][RESIDUAL] = 1.0; /* and with nothing left it is none any more */
    conclude();
    TEST_ASSERT_FALSE(motor[6].leaves_more);
}

static void test_the_machine_in_common(void)
{
    value[8][0] = 90.0; /* stands out, and is not counted */
    conclude();
    TEST_ASSERT_TRUE(motor[8].stands_out);
    TEST_ASSERT_TRUE(parameter[0].mean > 3.0 && parameter[0].mean < 6.0);
    TEST_ASSERT_TRUE(parameter[0].between > 1.5 && parameter[0].between < 3.5);
    TEST_ASSERT_FALSE(parameter[0].has_trend || parameter[0].has_batches);
    TEST_ASSERT_TRUE(isnan(parameter[0].per_day));
}

static void test_memory_runs_out(void)
{
    for (long k = 0; k < 2; ++k) {
        hci_note note = {{0}};
        hci_memory_fail_after(k);
        TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY, hci_line_conclude(0.01, &line, &note));
        TEST_ASSERT_TRUE(note.text[0] != '\0');
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_limits);
    RUN_TEST(test_values_that_are_not_told);
    RUN_TEST(test_deviations);
    RUN_TEST(test_values_without_a_spread);
    RUN_TEST(test_by_what_a_motor_stands_out);
    RUN_TEST(test_a_motor_that_leaves_more);
    RUN_TEST(test_the_machine_in_common);
    RUN_TEST(test_memory_runs_out);
    return UNITY_END();
}
