/* Samples of many waves and what is between them, against the sum of the waves. */
#include "host/currents/wave_samples.h"

#include <math.h>

#include "support/reference.h"
#include "unity.h"

enum { TURNS = 5, COUNT = 600 };

void setUp(void)
{
}

void tearDown(void)
{
}

/* Waves of orders k/5 with all sequences, whose amplitudes do not fall; returns the sum of these. */
static double waves_fill(hci_wave *wave)
{
    uint64_t seed = 11;
    double sum = 0.0;
    for (int k = 0; k < COUNT; ++k) {
        wave[k] = (hci_wave){(k / 3) / (double)TURNS, k % 3 - 1, ref_uniform(&seed, -1.0, 1.0),
                             ref_uniform(&seed, -1.0, 1.0)};
        sum += hypot(wave[k].sine, wave[k].cosine);
    }
    return sum;
}

static void test_between_samples_is_the_sum_of_the_waves(void)
{
    hci_wave wave[COUNT];
    hci_wave_samples samples;
    uint64_t seed = 12;
    const double sum = waves_fill(wave);
    TEST_ASSERT_TRUE(hci_wave_samples_make(wave, COUNT, TURNS, &samples));
    TEST_ASSERT_GREATER_THAN(0, samples.count);
    for (int k = 0; k < 3000; ++k) {
        const double share = k == 0 ? 0.0 : k == 1 ? 1.0 : ref_uniform(&seed, 0.0, 1.0);
        double abc[3], expected[3];
        hci_wave_samples_at(&samples, share, abc);
        hci_waves_at(wave, COUNT, 2.0 * REF_PI * TURNS * share, expected);
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(1e-11 * sum, expected[s], abc[s]);
    }
    hci_wave_samples_release(&samples);
    TEST_ASSERT_NULL(samples.value);
}

static void test_few_waves_and_very_high_orders_have_none(void)
{
    hci_wave wave[COUNT];
    hci_wave_samples samples;
    (void)waves_fill(wave);
    TEST_ASSERT_TRUE(hci_wave_samples_make(wave, 10, TURNS, &samples));
    TEST_ASSERT_EQUAL(0, samples.count);
    wave[COUNT - 1].order = 1e5;
    TEST_ASSERT_TRUE(hci_wave_samples_make(wave, COUNT, TURNS, &samples));
    TEST_ASSERT_EQUAL(0, samples.count);
    TEST_ASSERT_TRUE(hci_wave_samples_make(NULL, 0, TURNS, &samples));
    TEST_ASSERT_EQUAL(0, samples.count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_between_samples_is_the_sum_of_the_waves);
    RUN_TEST(test_few_waves_and_very_high_orders_have_none);
    return UNITY_END();
}
