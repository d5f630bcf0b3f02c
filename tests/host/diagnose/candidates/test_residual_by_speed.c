/* Means of a residual by the speed: weighted ones of each quarter of an octave and each direction, by hand.
 */
#include "host/diagnose/candidates/residual_by_speed.h"

#include <math.h>
#include <string.h>

#include "unity.h"

enum { SAMPLES = 12, RUNS = 4 };

static hci_binned_sample sample[SAMPLES];
static hci_segment segment[RUNS];
static hci_run run[RUNS];
static bool use[RUNS];
static double residual_Nm[SAMPLES], variance[SAMPLES];
static hci_binned_samples samples;
static hci_candidates_source source;
static hci_effect_speed_mean mean[HCI_SPEED_MEANS];

/* Three samples to each run. */
void setUp(void)
{
    memset(sample, 0, sizeof sample);
    memset(segment, 0, sizeof segment);
    memset(run, 0, sizeof run);
    for (size_t k = 0; k < SAMPLES; ++k) {
        residual_Nm[k] = 0.01 * (double)(k + 1);
        variance[k] = 1.0 / (double)(k % 5 + 1);
    }
    for (size_t r = 0; r < RUNS; ++r) {
        segment[r] = (hci_segment){.run = r, .first = 3 * r, .count = 3};
        run[r].torque_source = HCI_TORQUE_MEASURED;
        use[r] = true;
    }
    samples = (hci_binned_samples){sample, SAMPLES, segment, RUNS, NULL, RUNS};
    source = (hci_candidates_source){
        .samples = &samples, .runs = run, .use = use, .residual_Nm = residual_Nm, .variance = variance};
}

void tearDown(void)
{
}

static void speeds_set(const double speed_rad_per_s[SAMPLES])
{
    for (size_t k = 0; k < SAMPLES; ++k)
        sample[k].reading.speed_rad_per_s = speed_rad_per_s[k];
}

/* The mean at `at` is that of two samples, or of one twice. */
static void expect(size_t at, size_t a, size_t b)
{
    const double w_a = 1.0 / variance[a], w_b = a == b ? 0.0 : 1.0 / variance[b];
    const double v_a = sample[a].reading.speed_rad_per_s, v_b = sample[b].reading.speed_rad_per_s;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, w_a + w_b, mean[at].weight);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, (w_a * v_a + w_b * v_b) / (w_a + w_b), mean[at].speed_rad_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, (w_a * residual_Nm[a] + w_b * residual_Nm[b]) / (w_a + w_b),
                              mean[at].residual_Nm);
}

/* From the fastest down, 300 rad/s, a bin is a factor of 2^¼ wide, and its neighbour is 2^⅛ off: 275.1 rad/s.
 * Backward has bins of its own, behind. What stands, and what is slower than the bins, has none. */
static void test_bins_of_a_quarter_of_an_octave(void)
{
    const double far = 300.0 * pow(2.0, -31.4 / 4.0), too_far = 300.0 * pow(2.0, -31.6 / 4.0);
    const double speed[SAMPLES] = {275.3,  0.0,    300.0,  275.0, 150.0,   -275.3,
                                   -300.0, -275.0, -150.0, far,   too_far, 151.0};
    speeds_set(speed);
    TEST_ASSERT_EQUAL_UINT64(7, hci_residual_by_speed(&source, mean));
    expect(0, 0, 2);
    expect(1, 3, 3);
    expect(2, 4, 11);
    expect(3, 9, 9);
    expect(4, 5, 6);
    expect(5, 7, 7);
    expect(6, 8, 8);
}

/* Runs that are not in use, hold no measured torque or have an unknown mean take no part, nor in what is
 * fastest. */
static void test_runs_that_tell_no_mean(void)
{
    const double speed[SAMPLES] = {900.0, 900.0, 900.0, 800.0, 800.0, 800.0,
                                   20.0,  20.0,  10.0,  700.0, 700.0, 700.0};
    speeds_set(speed);
    use[0] = false;
    run[1].torque_source = HCI_TORQUE_INERTIA;
    run[3].mean_is_unknown = true;
    TEST_ASSERT_EQUAL_UINT64(2, hci_residual_by_speed(&source, mean));
    expect(0, 6, 7);
    expect(1, 8, 8);
    sample[6].reading.speed_rad_per_s = sample[7].reading.speed_rad_per_s =
        sample[8].reading.speed_rad_per_s = 0.0;
    TEST_ASSERT_EQUAL_UINT64(0, hci_residual_by_speed(&source, mean));
}

/* Slow ones are forward and backward, too. */
static void test_slow_speeds(void)
{
    const double speed[SAMPLES] = {0.01, 0.0, 0.0, -0.01, 0.0, 0.0, 1e-3, 0.0, 0.0, -1e-3, 0.0, 0.0};
    speeds_set(speed);
    TEST_ASSERT_EQUAL_UINT64(4, hci_residual_by_speed(&source, mean));
    expect(0, 0, 0);
    expect(1, 6, 6);
    expect(2, 3, 3);
    expect(3, 9, 9);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_bins_of_a_quarter_of_an_octave);
    RUN_TEST(test_runs_that_tell_no_mean);
    RUN_TEST(test_slow_speeds);
    return UNITY_END();
}
