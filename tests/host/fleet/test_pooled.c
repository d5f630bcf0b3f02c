/* The distribution of motors behind values with errors: against the likelihood itself on a grid, integrated
 * over the mean. */
#include "host/fleet/pooled.h"

#include <math.h>
#include <string.h>

#include "hci/host/fleet/line.h"
#include "host/fleet/trends.h"
#include "support/draws.h"
#include "unity.h"

enum { MOTORS = 40, GRID = 400, MEANS = 2000 };

static double value[MOTORS], std_error[MOTORS];

void setUp(void)
{
}

void tearDown(void)
{
}

/* ln ∫ Π N(v_i; μ, τ² + s_i²) dμ by the trapezoidal rule. */
static double integrated(double between)
{
    double sum = 0.0, most = -HUGE_VAL;
    static double at[MEANS];
    for (int k = 0; k < MEANS; ++k) {
        const double mean = -5.0 + 10.0 * k / (MEANS - 1);
        at[k] = 0.0;
        for (int i = 0; i < MOTORS; ++i) {
            const double variance = between * between + std_error[i] * std_error[i];
            at[k] -= 0.5 * log(variance) + 0.5 * (value[i] - mean) * (value[i] - mean) / variance;
        }
        most = fmax(most, at[k]);
    }
    for (int k = 0; k < MEANS; ++k)
        sum += exp(at[k] - most);
    return most + log(sum * 10.0 / (MEANS - 1));
}

static void draw(uint64_t seed, double between)
{
    for (int i = 0; i < MOTORS; ++i) {
        std_error[i] = ref_uniform(&seed, 0.1, 0.7);
        value[i] = 0.7 + between * ref_normal(&seed) + std_error[i] * ref_normal(&seed);
    }
}

static void test_likelihood_is_that_over_all_means(void)
{
    draw(3, 0.8);
    const double apart = hci_pooled_likelihood(value, std_error, MOTORS, 0.8) - integrated(0.8);
    for (int k = 0; k < 8; ++k) {
        const double between = 0.3 * k;
        TEST_ASSERT_DOUBLE_WITHIN(
            1e-9, apart, hci_pooled_likelihood(value, std_error, MOTORS, between) - integrated(between));
    }
}

static void test_maximum_is_that_of_a_grid(void)
{
    for (uint64_t seed = 1; seed < 6; ++seed) {
        double best = 0.0, highest = -HUGE_VAL;
        draw(seed, 0.5);
        for (int k = 0; k <= GRID; ++k) {
            const double between = 2.0 * k / GRID, at = integrated(between);
            if (at > highest) highest = at, best = between;
        }
        const hci_pooled p = hci_pooled_find(value, std_error, MOTORS);
        TEST_ASSERT_DOUBLE_WITHIN(2.0 / GRID, best, p.between);
    }
}

/* With equal errors: τ² = variance − s², the mean of all, and each its share. */
static void test_equal_errors_by_hand(void)
{
    const double v[] = {1.0, 2.0, 4.0, 5.0}, s[] = {1.0, 1.0, 1.0, 1.0};
    const hci_pooled p = hci_pooled_find(v, s, 4);
    double open;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0, p.mean);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, sqrt(10.0 / 3.0 - 1.0), p.between);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, sqrt(10.0 / 3.0 / 4.0), p.mean_std_error);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.7 * 2.0, hci_pooled_shrunken(&p, 5.0, 1.0, &open));
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, sqrt(0.7 + 0.09 * 10.0 / 12.0), open);
}

static void test_no_more_than_noise_is_no_difference(void)
{
    const double v[] = {1.0, 1.1, 0.9, 1.0}, s[] = {1.0, 1.0, 1.0, 1.0};
    double open;
    const hci_pooled p = hci_pooled_find(v, s, 4);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, p.between);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_pooled_shrunken(&p, 1.1, 1.0, &open));
}

static void test_limits_of_a_normal_distribution(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.959964, hci_normal_limit(0.05));
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 3.290527, hci_normal_limit(0.001));
}

/* Tables of F: 1 %, 4 and 20 degrees of freedom, 4.431; 0.1 %, 10 and 120, 3.24. */
static void test_F_as_a_normal_deviate(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 2.326348, hci_trend_normal_of_F(4.4307, 4.0, 20.0));
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 3.090232, hci_trend_normal_of_F(3.2372, 10.0, 120.0));
}

/* Values on a line over the day, with steps from batch to batch. */
static void test_a_line_and_steps_are_found(void)
{
    hci_trend_point point[60];
    double per_day, error;
    for (int k = 0; k < 60; ++k)
        point[k] = (hci_trend_point){2.0 + 0.01 * k, 0.1, 10.0 + k, ""};
    hci_trend_find(point, 60, 0.0, &per_day, &error);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.01, per_day);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 / sqrt(60.0 * 3599.0 / 12.0), error);
    for (int k = 0; k < 60; ++k)
        point[k] =
            (hci_trend_point){(k % 2 ? 0.1 : -0.1) + (k < 30 ? 0.0 : 1.0), 0.1, NAN, k < 30 ? "b1" : "b2"};
    const hci_trend_of_batches found = hci_trend_batches(point, 60);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, sqrt(0.5), found.deviation);
    TEST_ASSERT_TRUE(found.criterion > 5.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.2, sqrt(30.0), found.widening);
}

/* One parameter is told, but for the last motor; one by no motor, one by the odd motor alone; the last is
 * what stays, which is large in that motor and not told of the first. */
static void test_what_is_not_told_names_no_motor(void)
{
    enum { LINE = 12, PARAMETERS = 4, ODD = 7 };
    hci_line_motor motor[LINE];
    hci_line_parameter parameter[PARAMETERS];
    double told[LINE * PARAMETERS], error[LINE * PARAMETERS];
    hci_line line = {.motor = motor,
                     .motors = LINE,
                     .parameter = parameter,
                     .parameters = PARAMETERS,
                     .value = told,
                     .std_error = error};
    hci_note note;
    memset(motor, 0, sizeof motor);
    memset(parameter, 0, sizeof parameter);
    for (int k = 0; k < LINE; ++k) {
        const double not_told = NAN, *row = (double[]){0.01 * (k % 5), not_told, k == ODD ? 1.0 : not_told,
                                                       k == ODD ? 0.5 : 0.1 + 0.001 * (k % 3)};
        memcpy(told + PARAMETERS * k, row, PARAMETERS * sizeof *row);
        if (k == LINE - 1) told[PARAMETERS * k] = not_told;
        if (k == 0) told[PARAMETERS - 1] = not_told;
        for (int j = 0; j < PARAMETERS; ++j)
            error[PARAMETERS * k + j] =
                isnan(told[PARAMETERS * k + j]) ? not_told : 0.01 * (j + 1 < PARAMETERS);
    }
    TEST_ASSERT_EQUAL(HCI_OK, hci_line_conclude(0.002, &line, &note));
    TEST_ASSERT_EQUAL(1, hci_line_outside(&line));
    TEST_ASSERT_TRUE(motor[ODD].stands_out);
    TEST_ASSERT_EQUAL(PARAMETERS - 1, motor[ODD].worst);
    TEST_ASSERT_TRUE(isfinite(motor[ODD].deviation));
    TEST_ASSERT_TRUE(isnan(hci_line_deviation(&line, 0, 1)));
    TEST_ASSERT_EQUAL(0, motor[0].worst);
    TEST_ASSERT_TRUE(isfinite(motor[0].deviation));
    TEST_ASSERT_EQUAL(LINE - 1, parameter[0].motors);
    TEST_ASSERT_TRUE(isfinite(parameter[0].mean) && isfinite(parameter[0].between));
    TEST_ASSERT_TRUE(isnan(parameter[1].mean) && isnan(parameter[2].mean) && isnan(parameter[1].low));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_likelihood_is_that_over_all_means);
    RUN_TEST(test_maximum_is_that_of_a_grid);
    RUN_TEST(test_equal_errors_by_hand);
    RUN_TEST(test_no_more_than_noise_is_no_difference);
    RUN_TEST(test_limits_of_a_normal_distribution);
    RUN_TEST(test_F_as_a_normal_deviate);
    RUN_TEST(test_a_line_and_steps_are_found);
    RUN_TEST(test_what_is_not_told_names_no_motor);
    return UNITY_END();
}
