/* The rate of change of a recording: exact where a parabola is exact, near the truth under noise and under
 * the steps of an encoder, and the same whatever the unit of the time. */
#include "host/numeric/derivative.h"

#include <math.h>
#include <string.h>

#include "support/reference.h"
#include "unity.h"

enum { MOST = 4000 };

static double t[MOST], x[MOST], rate[MOST];
static uint64_t seed;

void setUp(void)
{
    seed = 7;
}

void tearDown(void)
{
}

/* Steps of time that differ by up to a factor of two. */
static void make_times(size_t n, double step_s)
{
    t[0] = 0.25;
    for (size_t k = 1; k < n; ++k)
        t[k] = t[k - 1] + step_s * ref_uniform(&seed, 0.7, 1.4);
}

static double rms_error(size_t n, double (*truth)(double))
{
    double square = 0.0;
    for (size_t k = 0; k < n; ++k)
        square += (rate[k] - truth(t[k])) * (rate[k] - truth(t[k])) / (double)n;
    return sqrt(square);
}

static double parabola_rate(double s)
{
    return 5.0 - 8.0 * s;
}

/* A parabola is fitted, so that one comes out exactly, at the ends too. The noise that is found in it is
 * rounding: 1e-16 of x over steps of 1 ms. */
static void test_a_parabola_has_its_rate(void)
{
    make_times(300, 1e-3);
    for (size_t k = 0; k < 300; ++k)
        x[k] = 2.0 + 5.0 * t[k] - 4.0 * t[k] * t[k];
    hci_derivative(t, x, 300, rate);
    for (size_t k = 0; k < 300; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, parabola_rate(t[k]), rate[k]);
}

/* A step of the rate in a gap of the record: on both sides it is what it is there. */
static double bent_rate(double s)
{
    return s < 1.0 ? 2.0 : -7.0;
}

static void test_a_gap_is_not_bridged(void)
{
    double at = 0.0;
    for (size_t k = 0; k < 400; ++k, at += k == 200 ? 1.5 : 1e-3) {
        t[k] = at;
        x[k] = at < 1.0 ? 2.0 * at : 9.0 - 7.0 * at;
    }
    hci_derivative(t, x, 400, rate);
    for (size_t k = 0; k < 400; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, bent_rate(t[k]), rate[k]);
}

static void test_few_samples_are_enough(void)
{
    for (size_t n = 2; n <= 6; ++n) {
        make_times(n, 0.1);
        for (size_t k = 0; k < n; ++k)
            x[k] = 3.0 * t[k] - 1.0;
        hci_derivative(t, x, n, rate);
        for (size_t k = 0; k < n; ++k)
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3.0, rate[k]);
    }
}

static double sine_rate(double s)
{
    return 10.0 * cos(10.0 * s);
}

/* 1e-4 of noise over steps of 1 ms would make a rate of ±0.1 from neighbours alone; a rate of rms 7 is wanted
 * to 2 %, and smoothing may cost as much again. */
static void test_noise_is_smoothed_and_the_shape_is_kept(void)
{
    make_times(MOST, 1e-3);
    for (size_t k = 0; k < MOST; ++k)
        x[k] = sin(10.0 * t[k]) + 3e-3 * ref_normal(&seed);
    hci_derivative(t, x, MOST, rate);
    TEST_ASSERT_DOUBLE_WITHIN(0.04 * 10.0 / sqrt(2.0), 0.0, rms_error(MOST, sine_rate));
}

static double fast_rate(double s)
{
    return 60.0 * cos(60.0 * s);
}

/* So much noise that no window brings it to 2 % of the rate: windows end before they smooth the wave away, at
 * a period of 105 samples. */
static void test_a_window_ends_before_the_shape_does(void)
{
    make_times(MOST, 1e-3);
    for (size_t k = 0; k < MOST; ++k)
        x[k] = sin(60.0 * t[k]) + 0.3 * ref_normal(&seed);
    hci_derivative(t, x, MOST, rate);
    TEST_ASSERT_DOUBLE_WITHIN(0.3 * 60.0 / sqrt(2.0), 0.0, rms_error(MOST, fast_rate));
}

static double ramp_rate(double s)
{
    (void)s;
    return 2.0;
}

/* An angle in steps of 0.01, at 2 per second and 1 kHz: it stands still for five samples, then jumps. 1 % of
 * one step in 20 that a window bridges. */
static void test_the_steps_of_an_encoder_are_bridged(void)
{
    for (size_t k = 0; k < MOST; ++k) {
        t[k] = 1e-3 * (double)k;
        x[k] = 0.01 * floor(2.0 * t[k] / 0.01);
    }
    hci_derivative(t, x, MOST, rate);
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * 2.0, 0.0, rms_error(MOST, ramp_rate));
}

/* Five steps of an encoder in twelve samples: over 48 of them it goes twenty steps, wherever one looks, which
 * is just enough for a window. */
static void test_twenty_steps_make_a_window(void)
{
    for (size_t k = 0; k < 200; ++k) {
        t[k] = 1e-3 * (double)k;
        x[k] = (double)(5 * k / 12);
    }
    TEST_ASSERT_EQUAL_UINT64(49, hci_derivative_window(t, x, 200));
}

static void test_what_stands_still_has_no_rate(void)
{
    make_times(100, 1e-3);
    for (size_t k = 0; k < 100; ++k)
        x[k] = -4.5;
    hci_derivative(t, x, 100, rate);
    for (size_t k = 0; k < 100; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(0.0, rate[k]);
}

/* Time in another unit and from another origin: the same rates, but for the rounding of times near 1e4. */
static void test_the_origin_and_unit_of_time_do_not_matter(void)
{
    static double other[MOST], again[MOST];
    make_times(500, 1e-3);
    for (size_t k = 0; k < 500; ++k) {
        x[k] = sin(20.0 * t[k]) + 1e-3 * ref_normal(&seed);
        other[k] = 1024.0 * t[k] + 8192.0;
    }
    hci_derivative(t, x, 500, rate);
    hci_derivative(other, x, 500, again);
    for (size_t k = 0; k < 500; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * 20.0, rate[k], 1024.0 * again[k]);
}

/* ---- the slope of a slope ---- */

/* Of an angle that speeds up at 40 rad/s² and is read with noise, by the slope of its slope. Returns the rms
 * error of the acceleration by windows that its own noise asks for, and by those of the angle's. */
static void accelerate(double noise_rad, double swing_rad, double error[2])
{
    static double slope[MOST];
    enum { N = 3000 };
    for (size_t k = 0; k < N; ++k) {
        t[k] = (double)k / 1500.0;
        x[k] = 20.0 * t[k] * t[k] + swing_rad * sin(150.0 * t[k]) + noise_rad * ref_normal(&seed);
    }
    hci_derivative(t, x, N, slope);
    for (int of_slope = 0; of_slope < 2; ++of_slope) {
        const size_t window =
            of_slope ? hci_derivative_window_of_slope(t, x, slope, N) : hci_derivative_window(t, slope, N);
        hci_derivative_over(t, slope, N, window, rate);
        error[of_slope] = 0.0;
        for (size_t k = 0; k < N; ++k)
            error[of_slope] += pow(rate[k] - 40.0 + 22500.0 * swing_rad * sin(150.0 * t[k]), 2.0) / N;
        error[of_slope] = sqrt(error[of_slope]);
    }
}

/* Neighbours of a slope share their noise, which hides it: the noise of what was read tells how long a window
 * must be. A swing of 63 samples is not smoothed away, nor is anything where there is no noise. */
static void test_the_slope_of_a_slope(void)
{
    double error[2];
    accelerate(2e-4, 0.0, error);
    TEST_ASSERT_TRUE(error[0] > 8.0);
    TEST_ASSERT_TRUE(error[1] < 1.5);
    accelerate(1e-9, 1e-3, error);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, error[0], error[1]);
    accelerate(1e-5, 1e-3, error);
    TEST_ASSERT_TRUE(error[1] < 0.15 * 22.5);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_parabola_has_its_rate);
    RUN_TEST(test_a_gap_is_not_bridged);
    RUN_TEST(test_few_samples_are_enough);
    RUN_TEST(test_noise_is_smoothed_and_the_shape_is_kept);
    RUN_TEST(test_a_window_ends_before_the_shape_does);
    RUN_TEST(test_the_steps_of_an_encoder_are_bridged);
    RUN_TEST(test_twenty_steps_make_a_window);
    RUN_TEST(test_what_stands_still_has_no_rate);
    RUN_TEST(test_the_origin_and_unit_of_time_do_not_matter);
    RUN_TEST(test_the_slope_of_a_slope);
    return UNITY_END();
}
