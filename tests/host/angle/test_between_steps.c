/* Angles read in the steps of an encoder: what lies between the steps comes back far better than it was read,
 * and what is none of an encoder, or moves otherwise than along the time, is left alone. */
#include "host/angle/between_steps.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "support/reference.h"
#include "unity.h"

enum { N = 6000 };

static const double STEP = 2.0 * REF_PI / 2048.0;

static double truth[N], angle[N], read_rad[N], time_s[N];
static uint64_t seed;

void setUp(void)
{
    seed = 5;
    for (size_t k = 0; k < N; ++k)
        time_s[k] = 1e-3 * (double)k;
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
}

/* At so many steps a second, with a speed that varies by a share of it seven times in a turn. */
static void turn_at(double steps_per_s, double share)
{
    truth[0] = 0.4;
    for (size_t k = 1; k < N; ++k)
        truth[k] = truth[k - 1] +
                   STEP * steps_per_s * (time_s[k] - time_s[k - 1]) * (1.0 + share * sin(7.0 * truth[k - 1]));
}

/* The reading of an angle stands for half a step more on the average. */
static void read_in(double step)
{
    for (size_t k = 0; k < N; ++k)
        angle[k] = read_rad[k] = step * floor(truth[k] / step);
}

static double rms_error(const double *x, double step, size_t from, size_t until)
{
    double sum = 0.0;
    for (size_t k = from; k < until; ++k)
        sum += pow(x[k] + 0.5 * step - truth[k], 2.0) / (double)(until - from);
    return sqrt(sum);
}

static void expect_unchanged(double returned)
{
    TEST_ASSERT_EQUAL_DOUBLE(0.0, returned);
    TEST_ASSERT_EQUAL_INT(0, memcmp(read_rad, angle, sizeof angle));
}

/* Of a step evenly spread, 0.289 of it as rms, a tenth is left. At 1.45 samples a step its middle is known to
 * a sample evenly spread, 0.2 steps as rms, and the middle of a parabola through sixteen to 3/8 of that;
 * faster, of sixteen readings, 3/8 of what a reading is off is left. */
static void test_between_steps(void)
{
    static const double STEPS_PER_S[] = {30.0, 170.7, 400.0, -170.7, 690.0, 1562.0, -1850.0};
    for (size_t k = 0; k < sizeof STEPS_PER_S / sizeof *STEPS_PER_S; ++k) {
        turn_at(STEPS_PER_S[k], 0.05);
        read_in(STEP);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * STEP, STEP, hci_angle_between_steps(angle, time_s, N));
        TEST_ASSERT_DOUBLE_WITHIN(0.01 * STEP, 0.289 * STEP, rms_error(read_rad, STEP, 0, N));
        TEST_ASSERT_TRUE(rms_error(angle, STEP, 0, N) < (k < 4 ? 0.03 : k == 4 ? 0.075 : 0.11) * STEP);
    }
}

/* Of a file with two decimals of a degree: steps of 0.17 and 0.18. */
static void test_decimals(void)
{
    turn_at(170.7, 0.05);
    read_in(STEP);
    for (size_t k = 0; k < N; ++k)
        angle[k] = read_rad[k] = round(read_rad[k] * 18000.0 / REF_PI) * REF_PI / 18000.0;
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * STEP, STEP, hci_angle_between_steps(angle, time_s, N));
    TEST_ASSERT_TRUE(rms_error(angle, STEP, 0, N) < 0.04 * STEP);
}

/* A time in which nothing was recorded is no time of a step: beside it nothing is worse than what was read.
 */
static void test_a_gap(void)
{
    for (size_t k = N / 2; k < N; ++k)
        time_s[k] += 1.7;
    turn_at(170.7, 0.0);
    read_in(STEP);
    TEST_ASSERT_TRUE(hci_angle_between_steps(angle, time_s, N) > 0.0);
    TEST_ASSERT_TRUE(rms_error(angle, STEP, N / 2 - 100, N / 2 + 100) < 0.05 * STEP);
}

/* Where the shaft turns round it rests on a step for as long as it likes: no value is further from what was
 * read than three quarters of a step. */
static void test_turning_round(void)
{
    for (size_t k = 0; k < N; ++k)
        truth[k] = 0.3 * sin(2.0 * REF_PI * (double)k / N);
    read_in(STEP);
    TEST_ASSERT_TRUE(hci_angle_between_steps(angle, time_s, N) > 0.0);
    for (size_t k = 0; k < N; ++k)
        TEST_ASSERT_TRUE(fabs(angle[k] - read_rad[k]) <= 0.75 * STEP);
    TEST_ASSERT_TRUE(rms_error(angle, STEP, N / 3, 2 * N / 3) < 0.08 * STEP);
}

/* No steps, steps of more than a degree, and a shaft that rests on each of its positions. */
static void test_what_is_no_encoder(void)
{
    turn_at(170.7, 0.05);
    for (size_t k = 0; k < N; ++k)
        angle[k] = read_rad[k] = truth[k] + 0.1 * STEP * ref_normal(&seed);
    expect_unchanged(hci_angle_between_steps(angle, time_s, N));
    turn_at(690.0, 0.05); /* each reading is another one */
    memcpy(angle, truth, sizeof truth);
    memcpy(read_rad, truth, sizeof truth);
    expect_unchanged(hci_angle_between_steps(angle, time_s, N));
    turn_at(4300.0, 0.0); /* steps that are small beside what is passed from sample to sample */
    read_in(STEP);
    expect_unchanged(hci_angle_between_steps(angle, time_s, N));
    turn_at(170.7, 0.05);
    read_in(1.01 * REF_PI / 180.0);
    expect_unchanged(hci_angle_between_steps(angle, time_s, N));
    turn_at(15.0, 0.0);
    read_in(STEP);
    expect_unchanged(hci_angle_between_steps(angle, time_s, N));
    for (size_t k = 0; k < N; ++k)
        angle[k] = read_rad[k] = 0.7;
    expect_unchanged(hci_angle_between_steps(angle, time_s, N));
}

/* Steps that no parabola in time follows: back and forth by three of them, by chance. */
static void test_what_does_not_follow_the_time(void)
{
    double at = 0.0;
    for (size_t k = 0; k < N; ++k) {
        if (k % 3 == 0) at += 3.0 * STEP * (ref_normal(&seed) > 0.0 ? 1.0 : -1.0);
        truth[k] = at;
        angle[k] = read_rad[k] = at;
    }
    expect_unchanged(hci_angle_between_steps(angle, time_s, N));
}

static void test_memory_is_out(void)
{
    turn_at(170.7, 0.05);
    read_in(STEP);
    hci_memory_fail_after(0);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, hci_angle_between_steps(angle, time_s, N));
    TEST_ASSERT_EQUAL_INT(0, memcmp(read_rad, angle, sizeof angle));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_between_steps);
    RUN_TEST(test_decimals);
    RUN_TEST(test_a_gap);
    RUN_TEST(test_turning_round);
    RUN_TEST(test_what_is_no_encoder);
    RUN_TEST(test_what_does_not_follow_the_time);
    RUN_TEST(test_memory_is_out);
    return UNITY_END();
}
