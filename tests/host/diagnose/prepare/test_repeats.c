/* Whether a mean over turns loses nothing: of runs whose equations stand here. */
#define _XOPEN_SOURCE 700
#include "host/diagnose/prepare/repeats.h"

#include "host/base/memory.h"
#include "support/recording.h"
#include "unity.h"

enum { P = 4, BINS = 819 };

static const double RATE_HZ = 2000.0, NOISE_NM = 0.02, NOISE_A = 0.02;

static hci_run run;
static hci_run_statistics statistics;
static uint64_t seed;

/* What does not repeat: waves of the torque and of i_q, by their own frequency, a rise of the torque along
 * the run, and what of its noise goes on to the next sample. */
typedef struct {
    double torque_Nm, current_A, wave_Hz, rise_Nm, goes_on;
} strange;

void setUp(void)
{
    seed = 11;
    statistics = (hci_run_statistics){.current_A = 5.0, .rms_torque_Nm = 2.0};
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    rec_release(&run);
}

static void record(size_t n, double turns, const strange *x)
{
    double noise = 0.0;
    rec_release(&run);
    run = rec_make(n);
    for (size_t k = 0; k < n; ++k) {
        const double t = (double)k / RATE_HZ, wave = sin(2.0 * REF_PI * x->wave_Hz * t);
        const double theta = 0.3 + 2.0 * REF_PI * turns * (double)k / (double)n;
        noise = x->goes_on * noise + ref_normal(&seed);
        run.time_s[k] = t;
        run.theta_m_rad[k] = theta;
        rec_phases(0.0, 5.0 + 0.1 * cos(6.0 * P * theta) + x->current_A * wave + NOISE_A * ref_normal(&seed),
                   P * theta, run.i_A + 3 * k);
        run.torque_Nm[k] = 2.0 + 0.1 * sin(36.0 * theta) + x->torque_Nm * wave +
                           x->rise_Nm * (double)k / (double)n + NOISE_NM * noise;
    }
}

static bool repeats(void)
{
    bool answer = false;
    const hci_repeats_question question = {&run, &statistics, P, 0, run.count, BINS};
    TEST_ASSERT_TRUE(hci_repeats_find(&question, &answer));
    return answer;
}

static bool follows(double Nm_per_A)
{
    bool answer = false;
    const hci_repeats_question question = {&run, &statistics, P, 0, run.count, 333};
    TEST_ASSERT_TRUE(hci_repeats_follows(&question, Nm_per_A, &answer));
    return answer;
}

/* A wave of the current that makes its torque, one that makes less than half of it, and one that the sensor
 * alone shows; of a machine that makes nothing, and nothing but noise. */
static void test_a_torque_that_follows(void)
{
    record(4000, 12.3, &(strange){.torque_Nm = 0.4 * 0.5, .current_A = 0.5, .wave_Hz = 300.7});
    TEST_ASSERT_TRUE(follows(0.4));
    TEST_ASSERT_TRUE(follows(0.7));
    TEST_ASSERT_FALSE(follows(0.9));
    TEST_ASSERT_FALSE(follows(0.0));
    record(4000, 12.3, &(strange){.current_A = 0.5, .wave_Hz = 300.7});
    TEST_ASSERT_FALSE(follows(0.4));
    record(4000, 12.3, &(strange){.torque_Nm = 0.0});
    TEST_ASSERT_FALSE(follows(1e-3));
}

/* Waves of torque and current with two and a half samples in a period, which all fourteen turns have alike: a
 * line from sample to sample of a turn misses both. */
static void test_waves_of_few_samples_are_not_followed(void)
{
    rec_release(&run);
    run = rec_make(4970);
    for (size_t k = 0; k < run.count; ++k) {
        const double theta = 2.0 * REF_PI * (double)k / 354.4, wave = sin(144.0 * theta);
        run.time_s[k] = (double)k / RATE_HZ;
        run.theta_m_rad[k] = theta;
        rec_phases(0.0, 5.0 + 0.05 * wave + NOISE_A * ref_normal(&seed), P * theta, run.i_A + 3 * k);
        run.torque_Nm[k] = 2.0 + 0.5 * wave + NOISE_NM * ref_normal(&seed);
    }
    TEST_ASSERT_FALSE(follows(0.4));
}

/* Twelve turns at other angles each, and three at the same ones. */
static void test_what_repeats(void)
{
    const strange nothing = {0.0, 0.0, 0.0, 0.0, 0.0};
    record(4000, 12.3, &nothing);
    TEST_ASSERT_TRUE(repeats());
    record(3000, 3.0, &nothing);
    TEST_ASSERT_TRUE(repeats());
    record(4000, -12.3, &nothing);
    TEST_ASSERT_TRUE(repeats());
}

/* A wave of half the noise, whether the torque has it or the current; one that is taken out as a swing. */
static void test_waves_of_their_own(void)
{
    record(4000, 12.3, &(strange){0.5 * NOISE_NM, 0.0, 317.0, 0.0, 0.0});
    TEST_ASSERT_FALSE(repeats());
    statistics.swing[0] = (hci_swing){.frequency_Hz = 317.0, .sine_Nm = 0.5 * NOISE_NM};
    statistics.swings = 1;
    TEST_ASSERT_TRUE(repeats());
    statistics.swings = 0;
    record(4000, 12.3, &(strange){0.0, 0.5 * NOISE_A, 317.0, 0.0, 0.0});
    TEST_ASSERT_FALSE(repeats());
}

static void test_what_creeps(void)
{
    record(4000, 12.3, &(strange){0.0, 0.0, 0.0, 2.0 * NOISE_NM, 0.0});
    TEST_ASSERT_FALSE(repeats());
}

/* Noise of a colour is no white noise: whether it repeats is not told. */
static void test_noise_that_goes_on(void)
{
    record(4000, 12.3, &(strange){0.0, 0.0, 0.0, 0.0, 0.6});
    TEST_ASSERT_FALSE(repeats());
}

static bool is_slow(void)
{
    bool answer = false;
    const hci_repeats_question question = {&run, &statistics, P, 0, run.count, BINS};
    TEST_ASSERT_TRUE(hci_repeats_slow_noise(&question, &answer));
    return answer;
}

/* Noise that goes on for a tenth of a turn is slow; not so what goes on from sample to sample, a wave of its
 * own of a few orders, or what too few samples show. */
static void test_slow_noise(void)
{
    record(6000, 12.3, &(strange){0.0, 0.0, 0.0, 0.0, 0.95});
    TEST_ASSERT_TRUE(is_slow());
    for (size_t k = 0; k < run.count; ++k)
        run.theta_m_rad[k] += 2.0 * REF_PI * 500.0; /* wherever the angle begins */
    TEST_ASSERT_TRUE(is_slow());
    record(6000, 12.3, &(strange){0.0, 0.0, 0.0, 0.0, 0.5});
    TEST_ASSERT_FALSE(is_slow());
    record(6000, 12.3, &(strange){3.0 * NOISE_NM, 0.0, 9.7, 0.0, 0.0});
    TEST_ASSERT_FALSE(is_slow());
    record(6000, 80.0, &(strange){0.0, 0.0, 0.0, 0.0, 0.95});
    TEST_ASSERT_FALSE(is_slow());
}

/* Where the angle stands there is one bin, and where nothing was read no noise. */
static void test_odd_runs(void)
{
    record(100, 0.0, &(strange){0.0, 0.0, 0.0, 0.0, 0.0});
    repeats();
    for (size_t k = 0; k < run.count; ++k)
        run.torque_Nm[k] = run.i_A[3 * k] = run.i_A[3 * k + 1] = run.i_A[3 * k + 2] = 0.0;
    TEST_ASSERT_TRUE(repeats());
}

static void test_memory_is_out(void)
{
    bool answer = true;
    record(100, 3.0, &(strange){0.0, 0.0, 0.0, 0.0, 0.0});
    const hci_repeats_question question = {&run, &statistics, P, 0, run.count, BINS};
    for (long n = 0; n < 2; ++n) {
        hci_memory_fail_after(n);
        TEST_ASSERT_FALSE(hci_repeats_find(&question, &answer));
        TEST_ASSERT_FALSE(answer);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_repeats);
    RUN_TEST(test_waves_of_their_own);
    RUN_TEST(test_what_creeps);
    RUN_TEST(test_noise_that_goes_on);
    RUN_TEST(test_slow_noise);
    RUN_TEST(test_odd_runs);
    RUN_TEST(test_a_torque_that_follows);
    RUN_TEST(test_waves_of_few_samples_are_not_followed);
    RUN_TEST(test_memory_is_out);
    return UNITY_END();
}
