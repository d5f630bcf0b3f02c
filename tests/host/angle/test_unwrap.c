/* Unwrapping: every angle that was wrapped in one of the usual ways comes back as it was, and what tells
 * nothing of whole turns is left alone and named. */
#include "host/angle/unwrap.h"

#include <math.h>
#include <string.h>

#include "support/reference.h"
#include "unity.h"

enum { N = 400 };

static double truth[N], angle[N], time_s[N], rate[N];

void setUp(void)
{
    for (size_t k = 0; k < N; ++k)
        time_s[k] = 1e-3 * (double)k;
}

void tearDown(void)
{
}

/* Into low … low + turn. */
static void wrap(double low, double turn)
{
    for (size_t k = 0; k < N; ++k)
        angle[k] = truth[k] - turn * floor((truth[k] - low) / turn);
}

/* The path again, but for whole turns that are the same for all samples. */
static void expect_truth(void)
{
    const double turns = round((angle[0] - truth[0]) / (2.0 * REF_PI));
    for (size_t k = 0; k < N; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, truth[k] + 2.0 * REF_PI * turns, angle[k]);
}

/* There and back again, at up to 0.3 rad a sample. */
static void make_reversal(void)
{
    for (size_t k = 0; k < N; ++k)
        truth[k] = 1.0 + 20.0 * sin(6.0 * (double)k / N);
}

static void test_a_path_that_turns_back_is_unwrapped(void)
{
    static const double LOW[] = {0.0, -3.14159265358979323846};
    for (size_t j = 0; j < 2; ++j) {
        make_reversal();
        wrap(LOW[j], 2.0 * REF_PI);
        const hci_unwrapping u = hci_unwrap(angle, N, time_s, NULL);
        TEST_ASSERT_EQUAL_INT(HCI_ANGLE_UNWRAPPED, u.path);
        TEST_ASSERT_EQUAL_UINT(1, u.turns);
        expect_truth();
    }
}

/* Noise turns single steps about, and one reading is a little more than a turn. */
static void test_a_reading_beyond_the_turn_is_within_it(void)
{
    for (size_t k = 0; k < N; ++k)
        truth[k] = 0.05 * (double)k + 0.06 * sin(2.3 * (double)k);
    wrap(0.0, 2.0 * REF_PI);
    angle[120] = truth[120] = 2.0 * REF_PI + 0.01;
    TEST_ASSERT_EQUAL_INT(HCI_ANGLE_UNWRAPPED, hci_unwrap(angle, N, time_s, NULL).path);
    for (size_t k = 0; k < N; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(k == 120 ? 7.0 : 1e-9, truth[k], angle[k]);
}

/* A path that is a little longer than a turn, and jumps nowhere. */
static void test_a_little_more_than_a_turn_stays(void)
{
    for (size_t k = 0; k < N; ++k)
        truth[k] = angle[k] = 1.02 * 2.0 * REF_PI * (double)k / N;
    TEST_ASSERT_EQUAL_INT(HCI_ANGLE_WHOLE, hci_unwrap(angle, N, time_s, NULL).path);
    TEST_ASSERT_EQUAL_DOUBLE_ARRAY(truth, angle, N);
}

static void test_an_angle_within_a_turn_stays(void)
{
    for (size_t k = 0; k < N; ++k)
        truth[k] = angle[k] = 3.0 + 2.9 * sin((double)k / 20.0);
    TEST_ASSERT_EQUAL_INT(HCI_ANGLE_WITHIN, hci_unwrap(angle, N, time_s, NULL).path);
    TEST_ASSERT_EQUAL_DOUBLE_ARRAY(truth, angle, N);
}

static void test_an_angle_beyond_a_turn_stays(void)
{
    make_reversal();
    memcpy(angle, truth, sizeof angle);
    TEST_ASSERT_EQUAL_INT(HCI_ANGLE_WHOLE, hci_unwrap(angle, N, time_s, NULL).path);
    TEST_ASSERT_EQUAL_DOUBLE_ARRAY(truth, angle, N);
}

/* An electrical angle of three pole pairs that starts again after each mechanical turn. */
static void test_jumps_of_several_turns_are_counted(void)
{
    for (size_t k = 0; k < N; ++k)
        truth[k] = 0.2 * (double)k;
    wrap(0.0, 6.0 * REF_PI);
    const hci_unwrapping u = hci_unwrap(angle, N, time_s, NULL);
    TEST_ASSERT_EQUAL_INT(HCI_ANGLE_UNWRAPPED, u.path);
    TEST_ASSERT_EQUAL_UINT(3, u.turns);
    expect_truth();
}

/* 4 rad from sample to sample: the shortest way would be backward, the speed says forward. */
static void test_the_speed_tells_steps_beyond_half_a_turn(void)
{
    for (size_t k = 0; k < N; ++k) {
        truth[k] = 4.0 * (double)k;
        rate[k] = 4000.0;
    }
    wrap(0.0, 2.0 * REF_PI);
    const hci_unwrapping u = hci_unwrap(angle, N, time_s, rate);
    TEST_ASSERT_EQUAL_INT(HCI_ANGLE_UNWRAPPED, u.path);
    TEST_ASSERT_EQUAL_UINT(N - 1, u.predicted);
    expect_truth();
}

/* The same without the speed is not to be told, and is left as it was. */
static void test_steps_beyond_a_third_of_a_turn_are_unclear(void)
{
    double before[N];
    for (size_t k = 0; k < N; ++k)
        truth[k] = 4.0 * (double)k;
    wrap(0.0, 2.0 * REF_PI);
    memcpy(before, angle, sizeof before);
    TEST_ASSERT_EQUAL_INT(HCI_ANGLE_UNCLEAR, hci_unwrap(angle, N, time_s, NULL).path);
    TEST_ASSERT_EQUAL_DOUBLE_ARRAY(before, angle, N);
    TEST_ASSERT_EQUAL_INT(HCI_ANGLE_SCATTERED, hci_unwrap(angle, N, NULL, NULL).path);
    TEST_ASSERT_EQUAL_DOUBLE_ARRAY(before, angle, N);
}

/* Points at rest, each recorded on its own: a speed of 0 throughout says nothing of the way between them. */
static void test_points_at_rest_are_scattered(void)
{
    uint64_t seed = 5;
    for (size_t k = 0; k < N; ++k) {
        angle[k] = ref_uniform(&seed, 0.0, 2.0 * REF_PI);
        rate[k] = 0.0;
    }
    TEST_ASSERT_EQUAL_INT(HCI_ANGLE_SCATTERED, hci_unwrap(angle, N, time_s, rate).path);
}

/* 2 rad a sample, of which one is missing: the shortest way would be back. */
static void test_a_missing_sample_does_not_turn_the_path_back(void)
{

    for (int k = 0; k < 20; ++k) {
        const int at = k < 9 ? k : k + 1;
        time_s[k] = at;
        angle[k] = 2.0 * at - 2.0 * REF_PI * floor(2.0 * at / (2.0 * REF_PI));
    }
    TEST_ASSERT_EQUAL(HCI_ANGLE_UNWRAPPED, hci_unwrap(angle, 20, time_s, NULL).path);
    for (int k = 0; k < 20; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * time_s[k], angle[k]);
}

static void test_one_sample_is_a_path(void)
{
    angle[0] = 5.0;
    TEST_ASSERT_EQUAL_INT(HCI_ANGLE_WITHIN, hci_unwrap(angle, 1, time_s, NULL).path);
    TEST_ASSERT_EQUAL_DOUBLE(5.0, angle[0]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_path_that_turns_back_is_unwrapped);
    RUN_TEST(test_a_reading_beyond_the_turn_is_within_it);
    RUN_TEST(test_a_little_more_than_a_turn_stays);
    RUN_TEST(test_an_angle_within_a_turn_stays);
    RUN_TEST(test_an_angle_beyond_a_turn_stays);
    RUN_TEST(test_jumps_of_several_turns_are_counted);
    RUN_TEST(test_the_speed_tells_steps_beyond_half_a_turn);
    RUN_TEST(test_steps_beyond_a_third_of_a_turn_are_unclear);
    RUN_TEST(test_points_at_rest_are_scattered);
    RUN_TEST(test_a_missing_sample_does_not_turn_the_path_back);
    RUN_TEST(test_one_sample_is_a_path);
    return UNITY_END();
}
