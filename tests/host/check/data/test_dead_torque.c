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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_loudest_is_told);
    RUN_TEST(test_what_answers_is_none);
    return UNITY_END();
}
