/* The highest order of a torque: by its amplitude, beside noise, in any of the runs that are in use. */
#include "host/diagnose/fit/shown_orders.h"

#include <math.h>

#include "support/reference.h"
#include "unity.h"

enum { P = 3, N = 800, RUNS = 2 };

static const double NOISE_NM = 0.01;

static uint64_t seed;
static hci_binned_sample sample[RUNS * N];
static hci_segment segment[RUNS];
static hci_binned_samples samples;
static hci_run run[RUNS];
static hci_noise noise[RUNS];
static bool use[RUNS];
static const hci_machine MACHINE = {.pole_pairs = P};
static hci_regression regression;

/* One mechanical turn each, about 2 N·m. */
void setUp(void)
{
    seed = 8;
    for (int r = 0; r < RUNS; ++r) {
        segment[r] = (hci_segment){.run = (size_t)r, .first = (size_t)(N * r), .count = N};
        use[r] = true;
        noise[r] = hci_noise_white(NOISE_NM);
    }
    for (int k = 0; k < RUNS * N; ++k) {
        sample[k].reading.theta_m_rad = 2.0 * REF_PI * (double)(k % N) / N;
        sample[k].torque_Nm = 2.0 + NOISE_NM * ref_normal(&seed);
    }
    samples = (hci_binned_samples){
        .sample = sample, .count = RUNS * N, .segment = segment, .segment_count = RUNS, .run_count = RUNS};
    regression =
        (hci_regression){.machine = &MACHINE, .samples = &samples, .runs = run, .use = use, .noise = noise};
}

void tearDown(void)
{
}

static void ripple(int r, double order, double amplitude_Nm)
{
    for (int k = N * r; k < N * (r + 1); ++k)
        sample[k].torque_Nm += amplitude_Nm * cos(order * P * sample[k].reading.theta_m_rad + 0.7);
}

static int highest(double least_Nm)
{
    return hci_highest_order_shown(&regression, 6, 62, least_Nm);
}

static void test_the_highest_is_found(void)
{
    TEST_ASSERT_EQUAL_INT(0, highest(0.0));
    ripple(0, 6.0, 0.1);
    ripple(1, 24.0, 0.006); /* noise makes 0.0026 once in a million */
    ripple(0, 40.0, 0.1);   /* no multiple of six */
    ripple(0, 66.0, 0.1);   /* above all that are asked for */
    TEST_ASSERT_EQUAL_INT(24, highest(0.004));
    TEST_ASSERT_EQUAL_INT(6, highest(0.008));
    use[1] = false;
    TEST_ASSERT_EQUAL_INT(6, highest(0.004));
}

static void test_noise_is_no_order(void)
{
    ripple(0, 12.0, 0.006);
    TEST_ASSERT_EQUAL_INT(12, highest(0.0));
    noise[0] = hci_noise_white(4.0 * NOISE_NM);
    TEST_ASSERT_EQUAL_INT(0, highest(0.0));
}

/* Less than nine tenths of an electrical turn. */
static void test_an_arc_tells_no_order(void)
{
    for (int k = 0; k < N; ++k)
        sample[k].reading.theta_m_rad *= 0.31;
    ripple(0, 12.0, 0.1);
    TEST_ASSERT_EQUAL_INT(12, highest(0.05));
    for (int k = 0; k < N; ++k)
        sample[k].reading.theta_m_rad *= 0.29 / 0.31;
    TEST_ASSERT_EQUAL_INT(0, highest(0.05));
    use[1] = false;
    TEST_ASSERT_EQUAL_INT(62, highest(0.05)); /* nothing is told */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_highest_is_found);
    RUN_TEST(test_noise_is_no_order);
    RUN_TEST(test_an_arc_tells_no_order);
    return UNITY_END();
}
