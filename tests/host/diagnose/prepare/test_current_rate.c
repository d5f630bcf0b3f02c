/* Slopes of currents over time, in the rotor frame: of lines they are exact; of a parabola, seen from one
 * side, they tell how far the neighbours reach. */
#include "host/diagnose/prepare/current_rate.h"

#include <math.h>

#include "support/recording.h"
#include "unity.h"

enum { N = 90, P = 2 };

static const double STEP_S = 1e-3;
static hci_binned_sample sample[N];

void setUp(void)
{
}

void tearDown(void)
{
}

/* i_d = d₀ + d₁ t, i_q = q₀ + q₁ t + q₂ t², angles `step_rad` apart. */
static void fill(double step_rad, double d1, double q1, double q2)
{
    for (size_t k = 0; k < N; ++k) {
        const double t = STEP_S * (double)k;
        sample[k] = (hci_binned_sample){.time_s = 5.0 + t};
        sample[k].reading.theta_m_rad = step_rad * (double)k;
        rec_phases(-2.0 + d1 * t, 3.0 + q1 * t + q2 * t * t, P * sample[k].reading.theta_m_rad,
                   sample[k].reading.i_abc);
    }
    hci_current_rates_set(sample, N, P);
}

static void check(size_t k, double d, double q)
{
    double rate_d, rate_q;
    rec_rotor(sample[k].reading.change_A_per_s, P * sample[k].reading.theta_m_rad, &rate_d, &rate_q);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, d, rate_d);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, q, rate_q);
}

static void test_lines(void)
{
    fill(0.01, 7.0, -11.0, 0.0);
    for (size_t k = 0; k < N; ++k)
        check(k, 7.0, -11.0);
}

/* A line through t² at 0, h … mh has the slope mh, and through −mh … mh none; 1/80 of an electrical period is
 * 0.03927 rad of the shaft of two pole pairs. Two neighbours are taken in any case, and 32 at most. */
static void test_how_far_neighbours_reach(void)
{
    static const struct {
        double step_rad;
        double reach;
    } CASE[] = {{0.0196, 2.0},   {0.03, 2.0},    {1.0, 2.0},    {0.013, 3.0},   {0.0131, 2.0},
                {-0.0039, 10.0}, {0.0012, 32.0}, {0.001, 32.0}, {0.00124, 31.0}};
    for (size_t c = 0; c < sizeof CASE / sizeof *CASE; ++c) {
        const double slope = CASE[c].reach * STEP_S;
        fill(CASE[c].step_rad, 0.0, 0.0, 1.0);
        check(0, 0.0, slope);
        check(N - 1, 0.0, 2.0 * (N - 1) * STEP_S - slope);
        check(N / 2, 0.0, 2.0 * (N / 2) * STEP_S);
    }
}

static void test_too_few_samples(void)
{
    fill(0.01, 1.0, 1.0, 0.0);
    for (int s = 0; s < 3; ++s)
        sample[0].reading.change_A_per_s[s] = 0.0;
    hci_current_rates_set(sample, 1, P);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, sample[0].reading.change_A_per_s[1]);
    hci_current_rates_set(sample, 2, P);
    check(0, 1.0, 1.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_lines);
    RUN_TEST(test_how_far_neighbours_reach);
    RUN_TEST(test_too_few_samples);
    return UNITY_END();
}
