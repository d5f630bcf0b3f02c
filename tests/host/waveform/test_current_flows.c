/* A current that turns with the angle is told from the noise and the zeros of sensors without one: i_q of 1 A
 * over N samples has the mean 1, and five times the √2·rms/√N of noise is 5/√N. */
#include <math.h>
#include <string.h>

#include "host/waveform/task.h"
#include "support/reference.h"
#include "unity.h"

enum { MOST = 4000, PAIRS = 3 };

static double theta[MOST], current[3 * MOST];
static hci_run run;
static hci_waveform_options options;
static hci_waveform_task task;

void setUp(void)
{
    memset(&run, 0, sizeof run);
    memset(&options, 0, sizeof options);
    run.theta_m_rad = theta;
    run.i_A = current;
    options.pole_pairs = PAIRS;
    task = (hci_waveform_task){.run = &run, .options = &options};
}

void tearDown(void)
{
}

/* d and q in the rotor frame of θ, an offset of phase a and noise, over turns that are not whole. */
static void play(size_t count, double d_A, double q_A, double offset_A, double noise_A)
{
    uint64_t seed = 3;
    run.count = count;
    for (size_t k = 0; k < count; ++k) {
        theta[k] = 0.3 + 0.37 * (double)k;
        for (int s = 0; s < 3; ++s) {
            const double x = PAIRS * theta[k] - 2.0 * REF_PI * s / 3.0;
            current[3 * k + (size_t)s] =
                q_A * sin(x) - d_A * cos(x) + (s == 0 ? offset_A : 0.0) + noise_A * ref_normal(&seed);
        }
    }
}

/* 25 samples are the least at which 1 is not below 5/√N; with the same in d. */
static void test_of_how_many_samples_on(void)
{
    for (size_t count = 1; count < 60; ++count) {
        play(count, 0.0, 1.0, 0.0, 0.0);
        if (count != 25) TEST_ASSERT_EQUAL(count > 25, hci_waveform_current_flows(&task));
        play(count, -0.6, 0.8, 0.0, 0.0);
        if (count != 25) TEST_ASSERT_EQUAL(count > 25, hci_waveform_current_flows(&task));
    }
}

/* With noise of σ the rms of a phase is √(½ + σ²): told below σ² of N/50 − ½. */
static void test_beside_noise(void)
{
    static const double NOISE_A[] = {0.0, 3.0, 8.0, 10.0, 30.0};
    static const bool IS_TOLD[] = {true, true, true, false, false}; /* σ = 8.9 of 4000 samples */
    for (int k = 0; k < 5; ++k) {
        play(MOST, 0.0, 1.0, 0.0, NOISE_A[k]);
        TEST_ASSERT_EQUAL(IS_TOLD[k], hci_waveform_current_flows(&task));
    }
}

static void test_what_sensors_make_of_none(void)
{
    play(MOST, 0.0, 0.0, 0.0, 0.2);
    TEST_ASSERT_FALSE(hci_waveform_current_flows(&task));
    play(MOST, 0.0, 0.0, 0.5, 0.0); /* a zero that is off does not turn */
    TEST_ASSERT_FALSE(hci_waveform_current_flows(&task));
    play(MOST, 0.0, 0.0, 0.0, 0.0);
    TEST_ASSERT_FALSE(hci_waveform_current_flows(&task));
    run.theta_m_rad = NULL;
    TEST_ASSERT_FALSE(hci_waveform_current_flows(&task));
    play(3, 0.0, 1e-9, 0.0, 0.0); /* without an angle any current is one */
    TEST_ASSERT_TRUE(hci_waveform_current_flows(&task));
}

static void test_rms(void)
{
    play(MOST, 3.0, 4.0, 0.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 5.0 / sqrt(2.0), hci_waveform_current_rms(&run));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_of_how_many_samples_on);
    RUN_TEST(test_beside_noise);
    RUN_TEST(test_what_sensors_make_of_none);
    RUN_TEST(test_rms);
    return UNITY_END();
}
