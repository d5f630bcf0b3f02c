/* How three voltage channels compare: waves of six turns that are written down here, as complex numbers. */
#include <complex.h>
#include <math.h>
#include <string.h>

#include "host/waveform/emf_phases.h"
#include "support/draws.h"
#include "unity.h"

enum { PASSES = 6, HIGHEST = 24, ORDERS = HIGHEST + 1 };

static hci_average_pass pass[PASSES];
static hci_average_harmonic wave[PASSES * HCI_EMF_CHANNELS * ORDERS];
static hci_average average;
static hci_emf_phases phases;
static hci_waveform result;
static hci_waveform_task task;

void setUp(void)
{
    memset(wave, 0, sizeof wave);
    memset(&result, 0, sizeof result);
    for (size_t k = 0; k < PASSES; ++k)
        pass[k] = (hci_average_pass){10 * k, 10, 1};
    average = (hci_average){HIGHEST, HCI_EMF_CHANNELS, PASSES, 1, pass, wave};
    phases = (hci_emf_phases){1, {true, true, true}};
    task = (hci_waveform_task){.result = &result};
}

void tearDown(void)
{
}

/* Channel s reads `ratio` times what it should, `late` rad off its third of a turn, with an offset; amplitude
 * 0.4 at 0.7 rad. */
static void channel_set(size_t s, double ratio, double late_rad, double offset)
{
    const double complex z =
        0.4 * ratio *
        cexp((double complex)I * (0.7 + late_rad - phases.sequence * (double)s * 2.0 * REF_PI / 3.0));
    for (size_t k = 0; k < PASSES; ++k) {
        *hci_average_at(&average, k, s, 1) = (hci_average_harmonic){creal(z), cimag(z)};
        *hci_average_at(&average, k, s, 0) = (hci_average_harmonic){0.0, offset};
    }
}

static void compare(double inverse)
{
    memset(&result, 0, sizeof result);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_emf_compare_channels(&task, &average, &phases, inverse));
}

/* ---- which count ---- */

static void expect_counts(bool a, bool b, bool c)
{
    const bool expected[3] = {a, b, c};
    hci_emf_choose_channels(&average, &phases);
    for (int s = 0; s < 3; ++s)
        TEST_ASSERT_EQUAL(expected[s], phases.counts[s]);
}

/* One whose scale is 1.25 times that of two that agree to 1.1, or that much less. */
static void test_a_channel_of_another_scale(void)
{
    for (size_t odd = 0; odd < 3; ++odd) {
        const size_t next = (odd + 1) % 3, last = (odd + 2) % 3;
        channel_set(next, 1.0, 0.0, 0.0);
        channel_set(last, 1.09, 0.0, 0.0);
        channel_set(odd, 1.045 * 1.26, 0.0, 0.0);
        expect_counts(odd != 0, odd != 1, odd != 2);
        channel_set(odd, 1.045 / 1.26, 0.0, 0.0);
        expect_counts(odd != 0, odd != 1, odd != 2);
        channel_set(odd, 1.045 * 1.24, 0.0, 0.0);
        expect_counts(true, true, true);
        channel_set(odd, 1.045 / 1.24, 0.0, 0.0);
        expect_counts(true, true, true);
    }
    channel_set(0, 3.0, 0.0, 0.0);
    channel_set(1, 1.0, 0.0, 0.0);
    channel_set(2, 1.11, 0.0, 0.0);
    expect_counts(true, true, true);
}

/* ---- how each compares ---- */

/* z of a channel over the mean of the others that count, for both sequences. */
static void test_ratios_and_phases(void)
{
    static const double RATIO[3] = {1.0, 1.05, 0.97}, LATE_RAD[3] = {0.01, -0.03, 0.005},
                        OFFSET[3] = {0.02, -0.04, 0.03};
    static const char *const NAME[3] = {"va", "vb", "vc"};
    for (int k = 0; k < 4; ++k) {
        phases = (hci_emf_phases){k % 2 ? -1 : 1, {true, true, k < 2}};
        for (size_t s = 0; s < 3; ++s)
            channel_set(s, RATIO[s], LATE_RAD[s], OFFSET[s]);
        compare(-0.25);
        for (size_t s = 0; s < 3; ++s) {
            double complex others = 0.0;
            double count = 0.0;
            for (size_t o = 0; o < 3; ++o) {
                if (o == s || !phases.counts[o]) continue;
                others += RATIO[o] * cexp((double complex)I * LATE_RAD[o]);
                count += 1.0;
            }
            const double complex z = RATIO[s] * cexp((double complex)I * LATE_RAD[s]) / (others / count);
            const hci_waveform_channel *c = &result.channel[s];
            TEST_ASSERT_EQUAL_STRING(NAME[s], c->name);
            TEST_ASSERT_EQUAL(!phases.counts[s], c->left_out);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, cabs(z), c->ratio);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, carg(z), c->phase_error_rad);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, OFFSET[s] / -0.25, c->offset_V);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, c->ratio_error);
        }
    }
}

/* Turns that differ: errors of the ratio from how it varies, as those of any wave. */
static void test_errors_of_turns_that_differ(void)
{
    uint64_t seed = 3;
    for (size_t s = 0; s < 3; ++s) {
        channel_set(s, 1.0, 0.0, 0.0);
        for (size_t k = 0; k < PASSES; ++k) {
            hci_average_at(&average, k, s, 1)->sine += 0.01 * ref_normal(&seed);
            hci_average_at(&average, k, s, 1)->cosine += 0.01 * ref_normal(&seed);
            hci_average_at(&average, k, s, 0)->cosine += 0.01 * ref_normal(&seed);
        }
    }
    compare(-0.5);
    for (size_t s = 0; s < 3; ++s) {
        hci_average_harmonic ratio[2 * PASSES] = {{0.0, 0.0}};
        hci_average ratios = {1, 1, PASSES, 1, pass, ratio};
        for (size_t k = 0; k < PASSES; ++k) {
            double complex z[3];
            for (size_t o = 0; o < 3; ++o) {
                const hci_average_harmonic *w = hci_average_at(&average, k, o, 1);
                z[o] = (w->sine + (double complex)I * w->cosine) *
                       cexp((double complex)I * (double)o * 2.0 * REF_PI / 3.0);
            }
            const double complex q = z[s] / (0.5 * (z[(s + 1) % 3] + z[(s + 2) % 3]));
            ratio[2 * k + 1] = (hci_average_harmonic){creal(q), cimag(q)};
        }
        const hci_order_estimate e = hci_average_estimate(&ratios, 0, 1);
        const hci_waveform_channel *c = &result.channel[s];
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, e.std_error, c->ratio_error);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, e.std_error / hypot(e.mean.sine, e.mean.cosine), c->phase_error);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, hci_average_estimate(&average, s, 0).std_error / 0.5,
                                  c->offset_error_V);
    }
}

/* Of fewer turns: from the errors of the channels, those of the others as of their mean. */
static void test_errors_of_few_turns(void)
{
    average.count = 3;
    for (int counts = 0; counts < 2; ++counts) {
        double share[3];
        phases.counts[2] = counts == 1;
        for (size_t s = 0; s < 3; ++s) {
            channel_set(s, 1.0, 0.0, 0.0);
            for (size_t k = 0; k < average.count; ++k)
                for (size_t n = 2; n <= HIGHEST; ++n)
                    *hci_average_at(&average, k, s, n) =
                        (hci_average_harmonic){0.01 * (double)(s + 1) * sin((double)(7 * n + k)), 0.0};
            const hci_order_estimate e = hci_average_estimate(&average, s, 1);
            share[s] = e.std_error / hypot(e.mean.sine, e.mean.cosine);
            TEST_ASSERT_TRUE(share[s] > 1e-4);
        }
        compare(1.0);
        const double others =
            counts ? 0.25 * (share[1] * share[1] + share[2] * share[2]) : share[1] * share[1];
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(share[0] * share[0] + others), result.channel[0].phase_error);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, result.channel[0].phase_error * result.channel[0].ratio,
                                  result.channel[0].ratio_error);
    }
}

/* ---- remarks ---- */

static void expect_remark(const char *text)
{
    compare(0.5);
    TEST_ASSERT_EQUAL_STRING(text, result.remark.text);
}

/* A fiftieth of a scale, of the amplitude, 0.8 V, and of a radian. */
static void test_what_is_said_of_a_channel(void)
{
    for (size_t s = 0; s < 3; ++s)
        channel_set(s, 1.0, 0.0, 0.0);
    expect_remark("");
    channel_set(1, 1.019, 0.019, 0.0075);
    expect_remark("");
    channel_set(1, 1.021, 0.0, 0.0);
    expect_remark("channel vb reads 1.021 times the others");
    channel_set(1, 1.0, 0.021, 0.0);
    expect_remark("channel vb is 0.021 rad off its third of a turn");
    channel_set(1, 1.0, 0.0, -0.0085);
    expect_remark("channel vb has an offset of -0.017 V");
}

static void test_guesses_of_a_scale(void)
{
    static const double RATIO[6] = {10.0, 0.1, 112.0, 1.7320508, 0.6, 3.0};
    static const char *const SAID[6] = {
        "channel vc reads 10 times the others: a x10 probe?; it is left out of the amplitudes",
        "channel vc reads 0.1 times the others: a x10 probe?; it is left out of the amplitudes",
        "channel vc reads 112 times the others: a x100 probe?; it is left out of the amplitudes",
        "channel vc reads 1.73 times the others: line and phase voltages mixed?; it is left out of the "
        "amplitudes",
        "channel vc reads 0.6 times the others: line and phase voltages mixed?; it is left out of the "
        "amplitudes",
        "channel vc reads 3 times the others; it is left out of the amplitudes"};
    for (size_t s = 0; s < 2; ++s)
        channel_set(s, 1.0, 0.0, 0.0);
    for (int k = 0; k < 6; ++k) {
        channel_set(2, RATIO[k], 0.0, 0.0);
        hci_emf_choose_channels(&average, &phases);
        expect_remark(SAID[k]);
    }
}

/* Of one that is left out the offset is beside its own amplitude, and the amplitude is that of the others. */
static void test_an_offset_of_a_channel_that_is_left_out(void)
{
    for (size_t s = 0; s < 2; ++s)
        channel_set(s, 1.0, 0.0, 0.0);
    phases.counts[2] = false;
    channel_set(2, 4.0, 0.0, 0.031);
    expect_remark("channel vc reads 4 times the others; it is left out of the amplitudes");
    channel_set(2, 4.0, 0.0, 0.033);
    expect_remark(
        "channel vc reads 4 times the others; it is left out of the amplitudes; channel vc has an offset of "
        "0.066 V");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_channel_of_another_scale);
    RUN_TEST(test_ratios_and_phases);
    RUN_TEST(test_errors_of_turns_that_differ);
    RUN_TEST(test_errors_of_few_turns);
    RUN_TEST(test_what_is_said_of_a_channel);
    RUN_TEST(test_guesses_of_a_scale);
    RUN_TEST(test_an_offset_of_a_channel_that_is_left_out);
    return UNITY_END();
}
