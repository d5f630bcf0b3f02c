/* A torque that was late, in a steady turn: what was read before it began is that of its end. */
#include "host/diagnose/fit/late_torque.c"

#include "support/reference.h"
#include "unity.h"

enum { N = 80 };

#define STEP_S 1e-3

static double time_s[N], air_gap_Nm[N], shifted[N];
static hci_binned_sample sample[N];
static hci_binned_samples samples;
static hci_regression regression;

void setUp(void)
{
    for (int k = 0; k < N; ++k) {
        time_s[k] = STEP_S * k;
        air_gap_Nm[k] = sin(2.0 * REF_PI * k / N) + 0.5;
        sample[k].time_s = time_s[k];
    }
    samples = (hci_binned_samples){.sample = sample, .count = N};
    regression = (hci_regression){.samples = &samples};
}

void tearDown(void)
{
}

/* By so many steps, of a turn (or several, averaged) or of samples one after the other. */
static void late_by(int steps, size_t turns)
{
    const hci_segment segment = {.count = N, .turns = turns, .period_s = N * STEP_S};
    scan l = {.regression = &regression};
    l.time_s = time_s, l.air_gap_Nm = air_gap_Nm, l.shifted = shifted;
    shift(&l, &segment, steps * STEP_S);
}

static void test_a_steady_turn_repeats(void)
{
    for (size_t turns = 1; turns <= 3; ++turns)
        for (int steps = 0; steps < 30; steps += 7) {
            late_by(steps, turns);
            for (int k = 0; k < N; ++k)
                TEST_ASSERT_DOUBLE_WITHIN(1e-9, sin(2.0 * REF_PI * (k - steps) / N) + 0.5, shifted[k]);
        }
}

/* Without turns nobody knows what was before. */
static void test_what_was_before_is_not_known(void)
{
    late_by(7, 0);
    for (int k = 0; k < N; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, air_gap_Nm[k < 7 ? k : k - 7], shifted[k]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_steady_turn_repeats);
    RUN_TEST(test_what_was_before_is_not_known);
    return UNITY_END();
}
