/* Torques of recordings that are the same noise, whatever flows: how loud it is, and when it is none. */
#include "host/check/data/dead_torque.h"

#include <math.h>
#include <string.h>

#include "support/draws.h"
#include "unity.h"

enum { RUNS = 2, ROWS = 400 };

static double torque_Nm[RUNS][ROWS];
static check_run run[RUNS];
static check_data data;

void setUp(void)
{
}

void tearDown(void)
{
}

/* White noise of the given sizes about means. */
static bool is_noise(const double size_Nm[RUNS], const double mean_Nm[RUNS], double *noise_Nm)
{
    uint64_t seed = 9;
    memset(run, 0, sizeof run);
    memset(&data, 0, sizeof data);
    for (int r = 0; r < RUNS; ++r) {
        run[r].has_torque = true;
        run[r].count = ROWS;
        run[r].torque = torque_Nm[r];
        for (int k = 0; k < ROWS; ++k) {
            torque_Nm[r][k] = mean_Nm[r] + size_Nm[r] * ref_normal(&seed);
            run[r].torque_mean += torque_Nm[r][k] / ROWS;
        }
        for (int k = 0; k < ROWS; ++k)
            run[r].torque_variance += pow(torque_Nm[r][k] - run[r].torque_mean, 2.0) / ROWS;
    }
    data.run = run;
    data.runs = RUNS;
    return hci_check_torques_are_noise(&data, noise_Nm);
}

static void test_the_loudest_is_told(void)
{
    double noise_Nm = NAN;
    TEST_ASSERT_TRUE(is_noise((double[]){0.1, 0.12}, (double[]){0.3, 0.3}, &noise_Nm));
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.12, noise_Nm);
    TEST_ASSERT_TRUE(is_noise((double[]){1e-4, 0.8e-4}, (double[]){0.0, 0.0}, &noise_Nm));
    TEST_ASSERT_DOUBLE_WITHIN(0.2e-4, 1e-4, noise_Nm);
}

/* Other means, or one that is far louder, answer to something. */
static void test_what_answers_is_none(void)
{
    double noise_Nm = NAN;
    TEST_ASSERT_FALSE(is_noise((double[]){0.1, 0.1}, (double[]){0.3, 0.4}, &noise_Nm));
    TEST_ASSERT_FALSE(is_noise((double[]){0.1, 5.0}, (double[]){0.3, 0.3}, &noise_Nm));
    TEST_ASSERT_FALSE(is_noise((double[]){5.0, 0.1}, (double[]){0.3, 0.3}, &noise_Nm));
}

/* A recording of a held rotor and a short one are no part of it, whatever they show; a torque without noise
 * that was measured is no noise. */
static void test_what_is_no_part_of_it(void)
{
    static const double SIZE[] = {0.1, 0.1}, MEAN[] = {0.3, 7.0};
    double noise_Nm = NAN;
    TEST_ASSERT_FALSE(is_noise(SIZE, MEAN, &noise_Nm));
    run[1].is_held = true;
    TEST_ASSERT_TRUE(hci_check_torques_are_noise(&data, &noise_Nm));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(run[0].torque_variance), noise_Nm);
    run[1].is_held = false;
    run[1].count = 30;
    TEST_ASSERT_FALSE(hci_check_torques_are_noise(&data, &noise_Nm));
    run[1].count = 29;
    TEST_ASSERT_TRUE(hci_check_torques_are_noise(&data, &noise_Nm));
    run[1].count = ROWS;
    run[1].torque_mean = run[0].torque_mean;
    TEST_ASSERT_TRUE(hci_check_torques_are_noise(&data, &noise_Nm));
    run[1].torque_variance = 0.0;
    TEST_ASSERT_FALSE(hci_check_torques_are_noise(&data, &noise_Nm));
    run[0].is_held = run[1].is_held = true;
    TEST_ASSERT_FALSE(hci_check_torques_are_noise(&data, &noise_Nm));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, noise_Nm);
}

/* A mean stands out from five of its errors on; noise that goes on from row to row is none. */
static void test_means_and_rows(void)
{
    double noise_Nm = NAN;
    check_run x = {.count = 100, .torque_variance = 4.0, .torque_mean = 1.01};
    TEST_ASSERT_TRUE(hci_check_torque_stands_out(&x));
    x.torque_mean = -1.01;
    TEST_ASSERT_TRUE(hci_check_torque_stands_out(&x));
    x.torque_mean = 0.99;
    TEST_ASSERT_FALSE(hci_check_torque_stands_out(&x));
    TEST_ASSERT_TRUE(is_noise((double[]){0.1, 0.1}, (double[]){0.0, 0.0}, &noise_Nm));
    for (int k = 1; k < ROWS; ++k)
        torque_Nm[0][k] += 0.6 * torque_Nm[0][k - 1];
    TEST_ASSERT_FALSE(hci_check_torques_are_noise(&data, &noise_Nm));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_loudest_is_told);
    RUN_TEST(test_what_answers_is_none);
    RUN_TEST(test_what_is_no_part_of_it);
    RUN_TEST(test_means_and_rows);
    return UNITY_END();
}
