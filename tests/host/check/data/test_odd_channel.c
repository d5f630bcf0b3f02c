/* Which of three columns of currents is not as the two others, by how they vary; currents that stand say
 * nothing of it. */
#include "host/check/data/run_samples.c"

#include <stdlib.h>

#include "support/draws.h"
#include "unity.h"

enum { N = 120 };

static double a[N], b[N], c[N];
static uint64_t seed;

void setUp(void)
{
    seed = 7;
}

void tearDown(void)
{
}

static check_odd_channel judge(void)
{
    const double *const column[3] = {a, b, c};
    return hci_check_odd_channel(column, N);
}

static void turn(void)
{
    for (int k = 0; k < N; ++k) {
        const double x = 4.0 * REF_PI * k / N;
        a[k] = sin(x), b[k] = sin(x - 2.0 * REF_PI / 3.0), c[k] = sin(x + 2.0 * REF_PI / 3.0);
    }
}

/* Into a, and back through b and c in parallel; noise_A: of each sensor, and of b and c alike. */
static void stand(double current_A, double noise_A, double common_A)
{
    for (int k = 0; k < N; ++k) {
        const double common = common_A * ref_normal(&seed);
        a[k] = current_A + noise_A * ref_normal(&seed);
        b[k] = -0.5 * current_A + common + noise_A * ref_normal(&seed);
        c[k] = -0.5 * current_A + common + noise_A * ref_normal(&seed);
    }
}

static void test_currents_that_stand_are_no_twins(void)
{
    static const double NOISE_A[][2] = {{0.0, 0.0}, {0.0, 0.001}, {0.01, 0.0}, {0.0, 0.02}};
    for (int k = 0; k < 4; ++k) {
        stand(1.5507319, NOISE_A[k][0], NOISE_A[k][1]);
        TEST_ASSERT_EQUAL(CHECK_CHANNELS_AGREE, judge().state);
    }
}

/* One that flickers beside two whose last digit stands. */
static void test_currents_that_stand_are_not_dead(void)
{
    stand(1.55, 0.0, 0.0);
    for (int k = 0; k < N; ++k)
        a[k] += k % 3 ? 0.0 : 0.01;
    TEST_ASSERT_EQUAL(CHECK_CHANNELS_AGREE, judge().state);
}

/* In steps of the current: what flows back is no twin, nor where the clamp of a is the other way round. */
static void test_what_flows_back_in_two_phases_is_no_twin(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        for (int k = 0; k < N; ++k) {
            const double x = floor(8.0 * k / N);
            a[k] = sign * x, b[k] = c[k] = -0.5 * x;
        }
        const check_odd_channel odd = judge();
        TEST_ASSERT_EQUAL(sign > 0 ? CHECK_CHANNELS_AGREE : CHECK_CHANNEL_ODD, odd.state);
        if (sign < 0) TEST_ASSERT_DOUBLE_WITHIN(1e-9, -1.0, odd.gain);
        if (sign < 0) TEST_ASSERT_EQUAL(0, odd.phase);
    }
}

static void test_twins(void)
{
    turn();
    TEST_ASSERT_EQUAL(CHECK_CHANNELS_AGREE, judge().state);
    for (int k = 0; k < N; ++k)
        c[k] = b[k];
    TEST_ASSERT_EQUAL(CHECK_CHANNELS_TWINS, judge().state);
    TEST_ASSERT_EQUAL(0, judge().phase);
}

static void test_a_dead_one(void)
{
    turn();
    for (int k = 0; k < N; ++k)
        b[k] = 0.2;
    TEST_ASSERT_EQUAL(CHECK_CHANNEL_DEAD, judge().state);
    TEST_ASSERT_EQUAL(1, judge().phase);
}

/* One that reads nothing is what the two others leave, one that reads otherwise is divided by its gain; with
 * a neutral conductor each is read as it is. */
static void test_columns_are_mended(void)
{
    static const hci_csv nothing;
    double *const column[3] = {a, b, c};
    for (int odd = 0; odd < 3; ++odd)
        for (int kind = 0; kind < 3; ++kind) {
            check_data data = {.has_neutral = kind == 2};
            check_run *run = calloc(1, sizeof *run);
            check_samples s = {.count = N, .phase = (const double *const *)column};
            double wanted[N];
            s.columns.csv = &nothing;
            turn();
            for (int k = 0; k < N; ++k) {
                wanted[k] = column[odd][k];
                column[odd][k] = kind == 1 ? -2.0 * wanted[k] : 0.2;
            }
            for (int phase = 0; phase < 3; ++phase)
                s.columns.value[HCI_RUN_IA + phase] = column[phase];
            TEST_ASSERT_EQUAL(HCI_OK, mend_channel(&data, run, &s));
            for (int k = 0; k < N; ++k)
                TEST_ASSERT_DOUBLE_WITHIN(1e-6, kind == 2 ? 0.2 : wanted[k], column[odd][k]);
            free(run);
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_currents_that_stand_are_no_twins);
    RUN_TEST(test_currents_that_stand_are_not_dead);
    RUN_TEST(test_what_flows_back_in_two_phases_is_no_twin);
    RUN_TEST(test_twins);
    RUN_TEST(test_a_dead_one);
    RUN_TEST(test_columns_are_mended);
    return UNITY_END();
}
