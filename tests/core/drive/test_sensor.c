/* Sensors: what is exact exactly, what is random by its statistics. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "hci/drive/sensor.h"
#include "unity.h"

enum { DRAWS = 1000000 };

static hci_sensor_state state;
static double ring[64];

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_zeros_are_ideal(void)
{
    const hci_sensor sensor = {0};
    TEST_ASSERT_EQUAL_UINT(0, hci_sensor_workspace(&sensor));
    hci_sensor_start(&sensor, &state, NULL, 1, 0.0);
    for (int k = -5; k < 5; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(0.1 * k, hci_sensor_read(&sensor, &state, 0.1 * k, 0.0));
}

static void test_gain_and_offset(void)
{
    const hci_sensor sensor = {.gain_error = 0.25, .offset = -3.0};
    hci_sensor_start(&sensor, &state, NULL, 1, 0.0);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, hci_sensor_read(&sensor, &state, 8.0, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(-13.0, hci_sensor_read(&sensor, &state, -8.0, 0.0));
}

static void test_quantisation_is_to_the_nearest(void)
{
    const hci_sensor sensor = {.quantum = 0.25};
    hci_sensor_start(&sensor, &state, NULL, 1, 0.0);
    for (int k = -4000; k <= 4000; ++k) {
        const double x = 0.00317 * k, y = hci_sensor_read(&sensor, &state, x, 0.0);
        TEST_ASSERT_EQUAL_DOUBLE(floor(4.0 * y + 0.5), 4.0 * y);
        TEST_ASSERT_TRUE(fabs(y - x) <= 0.125);
    }
}

static void test_delay_is_exact(void)
{
    static const int STEPS[] = {0, 1, 2, 37};
    for (int j = 0; j < 4; ++j) {
        const int late = STEPS[j];
        const hci_sensor sensor = {.delay_steps = (size_t)late};
        TEST_ASSERT_EQUAL_UINT(late, hci_sensor_workspace(&sensor));
        memset(&state, 0xA5, sizeof state); /* nothing of what was there before is left */
        hci_sensor_start(&sensor, &state, ring, 1, -1.0);
        for (int k = 0; k < 1000; ++k)
            TEST_ASSERT_EQUAL_DOUBLE(k < late ? -1.0 : k - late, hci_sensor_read(&sensor, &state, k, 0.0));
    }
}

/* An encoder off the centre reads θ + ε sin θ. */
static double off_centre(const void *context, double value, double theta_m_rad)
{
    const double *eccentricity = context;
    return value + *eccentricity * sin(theta_m_rad);
}

static void test_modification_comes_first(void)
{
    const double eccentricity = 0.01;
    const hci_sensor sensor = {
        .gain_error = 1.0, .offset = 5.0, .modify = off_centre, .context = &eccentricity};
    hci_sensor_start(&sensor, &state, NULL, 1, 0.0);
    TEST_ASSERT_EQUAL_DOUBLE(2.0 * (3.0 + 0.01 * sin(0.7)) + 5.0, hci_sensor_read(&sensor, &state, 3.0, 0.7));
}

/* Moments of 10⁶ draws: standard errors 1/√n, √2/√n, √6/√n and √24/√n of a standard deviation σ; the test
 * allows 5. And the share beyond 1, 2, 3, 4 σ against erfc, within 5 of its own standard errors. */
static void test_noise_is_normal(void)
{
    const hci_sensor sensor = {.noise = 0.5};
    double sum[5] = {0.0, 0.0, 0.0, 0.0, 0.0};
    int beyond[5] = {0, 0, 0, 0, 0};
    const double n = DRAWS;
    hci_sensor_start(&sensor, &state, NULL, 20260101, 0.0);
    for (int k = 0; k < DRAWS; ++k) {
        const double z = (hci_sensor_read(&sensor, &state, 3.0, 0.0) - 3.0) / 0.5;
        for (int m = 1; m <= 4; ++m) {
            sum[m] += pow(z, m);
            beyond[m] += fabs(z) > m;
        }
    }
    TEST_ASSERT_DOUBLE_WITHIN(5.0 / sqrt(n), 0.0, sum[1] / n);
    TEST_ASSERT_DOUBLE_WITHIN(5.0 * sqrt(2.0 / n), 1.0, sum[2] / n);
    TEST_ASSERT_DOUBLE_WITHIN(5.0 * sqrt(15.0 / n), 0.0, sum[3] / n);
    TEST_ASSERT_DOUBLE_WITHIN(5.0 * sqrt(96.0 / n), 3.0, sum[4] / n);
    for (int m = 1; m <= 4; ++m) {
        const double share = erfc(m / sqrt(2.0));
        TEST_ASSERT_DOUBLE_WITHIN(5.0 * sqrt(share / n), share, beyond[m] / n);
    }
}

/* White: correlation at the first lags, between neighbouring seeds, and between the two deviates of a pair,
 * within 5/√n. */
static void test_noise_is_white_and_seeds_are_unlike(void)
{
    enum { LAGS = 4 };
    const hci_sensor sensor = {.noise = 1.0};
    hci_sensor_state other;
    double past[LAGS] = {0.0, 0.0, 0.0, 0.0}, lagged[LAGS] = {0.0, 0.0, 0.0, 0.0}, cross = 0.0;
    hci_sensor_start(&sensor, &state, NULL, 7, 0.0);
    hci_sensor_start(&sensor, &other, NULL, 8, 0.0);
    for (int k = 0; k < DRAWS; ++k) {
        const double x = hci_sensor_read(&sensor, &state, 0.0, 0.0);
        cross += x * hci_sensor_read(&sensor, &other, 0.0, 0.0);
        for (int lag = LAGS - 1; lag >= 0; --lag) {
            lagged[lag] += x * past[lag];
            past[lag] = lag > 0 ? past[lag - 1] : x;
        }
    }
    TEST_ASSERT_DOUBLE_WITHIN(5.0 / sqrt((double)DRAWS), 0.0, cross / DRAWS);
    for (int lag = 0; lag < LAGS; ++lag)
        TEST_ASSERT_DOUBLE_WITHIN(5.0 / sqrt((double)DRAWS), 0.0, lagged[lag] / DRAWS);
}

/* Steele, Lea and Flood's generator from seed 1234567 gives 6457827717110365317 first and 3203168211198807973
 * next; the top 53 bits of both make the first deviate by the polar method. */
static void test_generator_is_splitmix64(void)
{
    const hci_sensor sensor = {.noise = 1.0};
    const double x = 2.0 * ((double)(UINT64_C(6457827717110365317) >> 11) + 0.5) / 9007199254740992.0 - 1.0;
    const double y = 2.0 * ((double)(UINT64_C(3203168211198807973) >> 11) + 0.5) / 9007199254740992.0 - 1.0;
    const double square = x * x + y * y;
    TEST_ASSERT_TRUE(square < 1.0);
    hci_sensor_start(&sensor, &state, NULL, 1234567, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, x * sqrt(-2.0 * log(square) / square),
                              hci_sensor_read(&sensor, &state, 0.0, 0.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, y * sqrt(-2.0 * log(square) / square),
                              hci_sensor_read(&sensor, &state, 0.0, 0.0));
}

static void test_equal_seeds_repeat(void)
{
    const hci_sensor sensor = {.noise = 1.0, .quantum = 0.01, .delay_steps = 3};
    double first[100];
    for (int run = 0; run < 2; ++run) {
        hci_sensor_start(&sensor, &state, ring, 99, 0.0);
        for (int k = 0; k < 100; ++k) {
            const double y = hci_sensor_read(&sensor, &state, 0.1 * k, 0.0);
            if (run == 0) first[k] = y;
            TEST_ASSERT_EQUAL_DOUBLE(first[k], y);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_zeros_are_ideal);
    RUN_TEST(test_gain_and_offset);
    RUN_TEST(test_quantisation_is_to_the_nearest);
    RUN_TEST(test_delay_is_exact);
    RUN_TEST(test_modification_comes_first);
    RUN_TEST(test_noise_is_normal);
    RUN_TEST(test_noise_is_white_and_seeds_are_unlike);
    RUN_TEST(test_generator_is_splitmix64);
    RUN_TEST(test_equal_seeds_repeat);
    return UNITY_END();
}
