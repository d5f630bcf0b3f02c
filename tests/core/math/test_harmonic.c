/* Harmonics and three-phase waves against their sine formulas. */
#include "hci/math/harmonic.h"

#include "support/reference.h"
#include "unity.h"

/* A few dozen roundings of numbers up to 10. */
#define ROUNDING 1e-13

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_polar_and_linear_agree_both_ways(void)
{
    uint64_t seed = 1;
    for (int trial = 0; trial < 2000; ++trial) {
        const double a = ref_uniform(&seed, 0.01, 10.0), g = ref_uniform(&seed, -REF_PI, REF_PI);
        const hci_harmonic h = hci_harmonic_polar(3.5, a, g);
        const hci_wave w = hci_wave_polar(2.0, -1, a, g);
        TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, a * cos(g), h.sine);
        TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, a * sin(g), h.cosine);
        TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, a, hci_amplitude(h.sine, h.cosine));
        TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, g, hci_phase_rad(h.sine, h.cosine));
        TEST_ASSERT_EQUAL_DOUBLE(3.5, h.order);
        TEST_ASSERT_EQUAL_DOUBLE(2.0, w.order);
        TEST_ASSERT_EQUAL_INT(-1, w.sequence);
        TEST_ASSERT_EQUAL_DOUBLE(h.sine, w.sine);
        TEST_ASSERT_EQUAL_DOUBLE(h.cosine, w.cosine);
    }
}

static void test_a_negative_amplitude_is_half_a_turn(void)
{
    const hci_wave minus = hci_wave_polar(5.0, -1, -5.02, 0.3),
                   plus = hci_wave_polar(5.0, -1, 5.02, 0.3 + REF_PI);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, plus.sine, minus.sine);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, plus.cosine, minus.cosine);
}

static void test_phase_is_above_minus_pi_and_up_to_pi(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(HCI_PI, hci_phase_rad(-1.0, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(HCI_PI, hci_phase_rad(-1.0, -0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_phase_rad(1.0, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_phase_rad(0.0, 0.0));
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, REF_PI / 2.0, hci_phase_rad(0.0, 2.0));
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, -REF_PI / 2.0, hci_phase_rad(0.0, -2.0));
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, -0.75 * REF_PI, hci_phase_rad(-1.0, -1.0));
}

static void test_amplitude_neither_overflows_nor_underflows(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(5e200, hci_amplitude(3e200, 4e200));
    TEST_ASSERT_DOUBLE_WITHIN(1e-215, 5e-200, hci_amplitude(3e-200, 4e-200));
}

static void test_order_zero_is_the_mean_whatever_the_phase(void)
{
    const hci_harmonic h = hci_harmonic_polar(0.0, -2.5, 1.2);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, h.sine);
    TEST_ASSERT_EQUAL_DOUBLE(-2.5, h.cosine);
}

/* The waveform A sin(n(θ − 2πs/3) + γ) is a wave of the sequence of its order, for every n. */
static void test_sequence_of_order_describes_a_shifted_waveform(void)
{
    for (int n = 0; n <= 60; ++n) {
        const ref_wave waveform = {n, n, 1.3, 0.7};
        const hci_wave w = hci_wave_polar(n, hci_sequence_of_order(n), 1.3, 0.7);
        double abc[3];
        hci_waves_at(&w, 1, 0.9, abc);
        /* the sine of an argument near 400 is known to 400·2⁻⁵³ */
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, ref_wave_at(&waveform, s, 0.9), abc[s]);
    }
    TEST_ASSERT_EQUAL_INT(0, hci_sequence_of_order(0.0));
    TEST_ASSERT_EQUAL_INT(1, hci_sequence_of_order(7.0));
    TEST_ASSERT_EQUAL_INT(-1, hci_sequence_of_order(5.0 - 1e-9));
    TEST_ASSERT_EQUAL_INT(-1, hci_sequence_of_order(5.0 + 1e-9));
}

static void test_harmonics_at_is_the_sum_of_sines(void)
{
    uint64_t seed = 2;
    for (int trial = 0; trial < 500; ++trial) {
        hci_harmonic list[5];
        const double theta = ref_uniform(&seed, -7.0, 7.0);
        double expected = 0.0;
        for (int k = 0; k < 5; ++k) {
            const double n = ref_integer(&seed, 1, 40) / 4.0;
            const double a = ref_uniform(&seed, -2.0, 2.0), g = ref_uniform(&seed, -4.0, 4.0);
            list[k] = hci_harmonic_polar(n, a, g);
            expected += a * sin(n * theta + g);
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected, hci_harmonics_at(list, 5, theta));
    }
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_harmonics_at(NULL, 0, 1.0));
}

static void test_waves_at_is_the_sine_formula_in_each_phase(void)
{
    uint64_t seed = 3;
    for (int trial = 0; trial < 2000; ++trial) {
        hci_wave list[4];
        ref_wave formula[4];
        double abc[3];
        const double theta = ref_uniform(&seed, -7.0, 7.0);
        for (int k = 0; k < 4; ++k) {
            const int sequence = ref_integer(&seed, -1, 1);
            formula[k] = (ref_wave){ref_integer(&seed, 0, 40) / 4.0, sequence, ref_uniform(&seed, -2.0, 2.0),
                                    ref_uniform(&seed, -4.0, 4.0)};
            list[k] = hci_wave_polar(formula[k].order, sequence, formula[k].amplitude, formula[k].phase);
        }
        hci_waves_at(list, 4, theta, abc);
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, ref_waves_at(formula, 4, s, theta), abc[s]);
    }
}

/* Orders of five electrical turns, as a table of one mechanical turn has them, each of which follows from the
 * one before it: the products of order and angle alone are off by 2e-12. */
static void test_a_thousand_orders_stay_as_exact_as_their_angles(void)
{
    enum { COUNT = 1500 };
    static hci_wave list[COUNT];
    static hci_harmonic terms[COUNT];
    uint64_t seed = 4;
    for (int k = 0; k < COUNT; ++k) {
        list[k] = (hci_wave){k / 5.0, k % 2 ? 1 : -1, 1.0, 0.0};
        terms[k] = (hci_harmonic){k / 5.0, 0.0, 1.0};
    }
    for (int trial = 0; trial < 20; ++trial) {
        const double theta = ref_uniform(&seed, 0.0, 10.0 * REF_PI);
        double abc[3], sine = 0.0, cosine = 0.0;
        for (int k = 0; k < COUNT; ++k) {
            sine += sin(k / 5.0 * theta);
            cosine += cos(k / 5.0 * theta);
        }
        hci_waves_at(list, COUNT, theta, abc);
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, sine, abc[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, cosine, hci_harmonics_at(terms, COUNT, theta));
    }
}

static void test_no_waves_are_zero(void)
{
    double abc[3] = {1.0, 1.0, 1.0};
    hci_waves_at(NULL, 0, 1.0, abc);
    for (int s = 0; s < 3; ++s)
        TEST_ASSERT_EQUAL_DOUBLE(0.0, abc[s]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_waves_mean_square(NULL, 0));
}

/* Orders j/turns up to 3 make squares up to order 6: 24 of 128 bins, so the average of the samples is exact.
 */
static void test_mean_square_is_the_average_of_the_samples(void)
{
    uint64_t seed = 4;
    for (int trial = 0; trial < 3000; ++trial) {
        const int turns = ref_integer(&seed, 1, 4), count = ref_integer(&seed, 1, 8);
        hci_wave list[8];
        ref_wave formula[8];
        double mean = 0.0;
        for (int k = 0; k < count; ++k) {
            const int sequence = ref_integer(&seed, -1, 1);
            /* few orders, so that repeats and pairs at order 0 are common */
            const double order = (double)ref_integer(&seed, 0, 3) / turns;
            formula[k] =
                (ref_wave){order, sequence, ref_uniform(&seed, -2.0, 2.0), ref_uniform(&seed, -4.0, 4.0)};
            list[k] = hci_wave_polar(order, sequence, formula[k].amplitude, formula[k].phase);
        }
        for (size_t j = 0; j < REF_SAMPLES; ++j)
            for (int s = 0; s < 3; ++s)
                mean += pow(ref_waves_at(formula, (size_t)count, s, ref_theta(j, turns)), 2.0) / REF_SAMPLES;
        TEST_ASSERT_DOUBLE_WITHIN(1e-11, mean, hci_waves_mean_square(list, (size_t)count));
    }
}

static void test_mean_square_of_known_currents(void)
{
    const hci_wave sine = hci_wave_polar(1.0, 1, 12.0, 0.2);
    const hci_wave twice[2] = {hci_wave_polar(1.0, 1, 6.0, 0.2), hci_wave_polar(1.0, 1, 6.0, 0.2)};
    const hci_wave constant[2] = {hci_wave_polar(0.0, 1, 1.0, HCI_PI / 2.0),
                                  hci_wave_polar(0.0, -1, 1.0, HCI_PI / 2.0)};
    const hci_wave neutral = hci_wave_polar(0.0, 0, 2.0, HCI_PI / 2.0);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING * 100.0, 1.5 * 144.0, hci_waves_mean_square(&sine, 1));
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING * 100.0, 1.5 * 144.0, hci_waves_mean_square(twice, 2));
    /* both are (1, −1/2, −1/2) A: together (2, −1, −1) A */
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 6.0, hci_waves_mean_square(constant, 2));
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 12.0, hci_waves_mean_square(&neutral, 1));
}

/* The floor is a share of the largest amplitude, wherever that stands. */
static void test_floor_is_of_the_largest(void)
{
    hci_wave waves[3] = {{7.0, 1, 1e-3, 0.0}, {5.0, -1, 0.6, 0.8}, {1.0, 1, 0.0, 2e-3}};
    TEST_ASSERT_EQUAL_UINT64(1, hci_waves_join(waves, 3, 1e-2));
    TEST_ASSERT_EQUAL_DOUBLE(5.0, waves[0].order);
}

/* Two of one order and sequence are one wave, first, in between and last; of another sequence they stay two.
 */
static void test_waves_of_one_order_join(void)
{
    hci_wave pair[2] = {{5.0, -1, 1.0, 0.25}, {5.0, -1, 2.0, -1.0}};
    TEST_ASSERT_EQUAL_UINT64(1, hci_waves_join(pair, 2, 1e-9));
    TEST_ASSERT_EQUAL_DOUBLE(3.0, pair[0].sine);
    TEST_ASSERT_EQUAL_DOUBLE(-0.75, pair[0].cosine);
    hci_wave many[7] = {{7.0, 1, 1.0, 0.0}, {1.0, 1, 1.0, 0.0}, {5.0, -1, 1.0, 0.0}, {5.0, 1, 4.0, 0.0},
                        {7.0, 1, 2.0, 0.0}, {1.0, 1, 8.0, 0.0}, {5.0, -1, 16.0, 0.0}};
    TEST_ASSERT_EQUAL_UINT64(4, hci_waves_join(many, 7, 1e-9));
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) {
        const double expected = many[k].order == 1.0   ? 9.0
                                : many[k].order == 7.0 ? 3.0
                                : many[k].sequence > 0 ? 4.0
                                                       : 17.0;
        TEST_ASSERT_EQUAL_DOUBLE(expected, many[k].sine);
        sum += many[k].sine;
    }
    TEST_ASSERT_EQUAL_DOUBLE(33.0, sum);
}

/* The floor is a share of the largest wave, which may be the first. */
static void test_the_floor_is_a_share_of_the_largest(void)
{
    hci_wave waves[] = {{1.0, 1, 10.0, 0.0}, {5.0, 1, 0.005, 0.0}, {7.0, 1, 0.0, 0.02}};
    TEST_ASSERT_EQUAL_UINT64(2, hci_waves_join(waves, 3, 1e-3));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, waves[0].order);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, waves[1].order);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_polar_and_linear_agree_both_ways);
    RUN_TEST(test_a_negative_amplitude_is_half_a_turn);
    RUN_TEST(test_phase_is_above_minus_pi_and_up_to_pi);
    RUN_TEST(test_amplitude_neither_overflows_nor_underflows);
    RUN_TEST(test_order_zero_is_the_mean_whatever_the_phase);
    RUN_TEST(test_sequence_of_order_describes_a_shifted_waveform);
    RUN_TEST(test_harmonics_at_is_the_sum_of_sines);
    RUN_TEST(test_waves_at_is_the_sine_formula_in_each_phase);
    RUN_TEST(test_a_thousand_orders_stay_as_exact_as_their_angles);
    RUN_TEST(test_no_waves_are_zero);
    RUN_TEST(test_mean_square_is_the_average_of_the_samples);
    RUN_TEST(test_mean_square_of_known_currents);
    RUN_TEST(test_floor_is_of_the_largest);
    RUN_TEST(test_waves_of_one_order_join);
    RUN_TEST(test_the_floor_is_a_share_of_the_largest);
    return UNITY_END();
}
