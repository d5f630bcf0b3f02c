/* Parts of what a sensor should have read: windows of means over turns, the derivative of a lag, the mean
 * that leaves, and samples that tell nothing. */
#include "host/diagnose/reading/predicted_reading.c"

#include "unity.h"

enum { ROWS = 11 };

void setUp(void)
{
}

void tearDown(void)
{
}

/* A window of 101 samples of 1 ms is one of 26 of the 4 ms that a mean over turns is apart; one of samples as
 * they are, and none, stay. */
static void test_windows_of_means(void)
{
    double time_s[ROWS];
    for (size_t k = 0; k < ROWS; ++k)
        time_s[k] = 5.0 + 1e-3 * (double)k;
    const hci_run run = {.count = ROWS, .time_s = time_s};
    hci_segment s = {.count = 50, .turns = 3, .period_s = 0.2};
    TEST_ASSERT_EQUAL_UINT64(26, window_in(&run, &s, 101));
    TEST_ASSERT_EQUAL_UINT64(0, window_in(&run, &s, 0));
    TEST_ASSERT_EQUAL_UINT64(1, window_in(&run, &s, 2));
    TEST_ASSERT_EQUAL_UINT64(2, window_in(&run, &s, 4)); /* 3 ms are nearer to 4 */
    s.turns = 0;
    TEST_ASSERT_EQUAL_UINT64(101, window_in(&run, &s, 101));
    s.turns = 3, s.period_s = 0.0;
    TEST_ASSERT_EQUAL_UINT64(101, window_in(&run, &s, 101));
}

/* −dT/dt of central differences, one-sided at the ends; 0 where no time passes. */
static void test_the_derivative_of_a_lag(void)
{
    static const double TIME_S[] = {0.0, 1.0, 3.0, 3.0, 3.0}, TORQUE_NM[] = {1.0, 4.0, 10.0, 2.0, 7.0};
    double column[10] = {0.0};
    lag_derivative(TORQUE_NM, TIME_S, 5, column, 2);
    TEST_ASSERT_EQUAL_DOUBLE(-3.0, column[0]);
    TEST_ASSERT_EQUAL_DOUBLE(-3.0, column[2]);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, column[4]); /* (2 − 4)/(3 − 1) */
    TEST_ASSERT_EQUAL_DOUBLE(0.0, column[6]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, column[8]);
    for (int k = 1; k < 10; k += 2)
        TEST_ASSERT_EQUAL_DOUBLE(0.0, column[k]);
}

/* Samples that tell no torque have a residual of 0, and no part in the mean that leaves. */
static void test_samples_that_tell_nothing(void)
{
    hci_binned_sample sample[4];
    double residual_Nm[4];
    memset(sample, 0, sizeof sample);
    double predicted_Nm[] = {1.0, 2.0, 3.0, 4.0};
    const hci_predicted_reading predicted = {.torque_Nm = predicted_Nm};
    for (int k = 0; k < 4; ++k) {
        sample[k].count = k == 2 ? 0.0 : 1.0;
        sample[k].torque_Nm = 10.0 + k;
    }
    residual_fill(sample, 4, &predicted, residual_Nm);
    for (int k = 0; k < 4; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(k == 2 ? 0.0 : 9.0, residual_Nm[k]);
    take_mean_out(sample, residual_Nm, 4, HUGE_VAL);
    for (int k = 0; k < 4; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, 0.0, residual_Nm[k]);
}

/* Of a load that is known within 0.4 N·m twice that at most, of either sign. */
static void test_what_is_beyond_a_known_load_stays(void)
{
    hci_binned_sample sample[2];
    memset(sample, 0, sizeof sample);
    sample[0].count = sample[1].count = 1.0;
    for (int sign = -1; sign <= 1; sign += 2) {
        double near_Nm[] = {sign * 0.5, sign * 0.9}, far_Nm[] = {sign * 0.5, sign * 1.3};
        take_mean_out(sample, near_Nm, 2, 0.4);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, sign * -0.2, near_Nm[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, sign * 0.2, near_Nm[1]);
        take_mean_out(sample, far_Nm, 2, 0.4);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, sign * -0.3, far_Nm[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, sign * 0.5, far_Nm[1]);
    }
}

/* The scale of what the current makes is taken out of each value: by its own share of it. */
static void test_a_scale_is_held(void)
{
    double by_value[] = {1.0, 2.0, 3.0, 4.0}, current_Nm[] = {0.5, -1.0}, constant_by_value[] = {0.2, 0.0};
    hci_predicted_reading o = {.by_value = by_value,
                               .current_Nm = current_Nm,
                               .terms = 2,
                               .constant_Nm_per_A = 0.4,
                               .constant_by_value = constant_by_value};
    scale_hold(&o, 2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.75, by_value[0]);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, by_value[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 3.5, by_value[2]);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, by_value[3]);
    o.constant_Nm_per_A = 0.0; /* nothing makes a torque */
    scale_hold(&o, 2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.75, by_value[0]);
}

/* Any of the runs in use. */
static void test_which_runs_hardly_accelerate(void)
{
    const bool use[] = {true, true, true};
    const hci_binned_samples samples = {.run_count = 3};
    for (size_t which = 0; which < 3; ++which) {
        hci_run run[3] = {{.hardly_accelerates = false}};
        bool none[3] = {true, true, true};
        run[which].hardly_accelerates = true;
        none[which] = false;
        hci_regression e = {.samples = &samples, .runs = run, .use = use};
        TEST_ASSERT_TRUE(any_hardly_accelerates(&e));
        e.use = none;
        TEST_ASSERT_FALSE(any_hardly_accelerates(&e));
    }
}

/* Of a path that is no turn, by steps of 1 and 3 in turns: (1 + 9)/(1 + 3), however small they are; of
 * samples in one place none. */
static void test_the_usual_step(void)
{
    hci_binned_sample sample[5];
    const hci_binned_samples samples = {.sample = sample, .count = 5};
    const hci_regression e = {.samples = &samples};
    const hci_segment s = {.count = 5};
    memset(sample, 0, sizeof sample);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, usual_step_rad(&e, &s));
    for (double step_rad = 1e-4; step_rad < 2.0; step_rad *= 10.0) {
        for (int k = 1; k < 5; ++k)
            sample[k].reading.theta_m_rad =
                sample[k - 1].reading.theta_m_rad - step_rad * (k % 2 ? 1.0 : 3.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * step_rad, 2.5 * step_rad, usual_step_rad(&e, &s));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_windows_of_means);
    RUN_TEST(test_the_derivative_of_a_lag);
    RUN_TEST(test_samples_that_tell_nothing);
    RUN_TEST(test_what_is_beyond_a_known_load_stays);
    RUN_TEST(test_a_scale_is_held);
    RUN_TEST(test_which_runs_hardly_accelerate);
    RUN_TEST(test_the_usual_step);
    return UNITY_END();
}
