/* Waves of the turn in noise, against those that were put in. */
#include "host/diagnose/prepare/standing_waves.h"
#include "support/draws.h"
#include "support/reference.h"
#include "unity.h"

#include <math.h>

enum { N = 3000, MOST = 8 };

static uint64_t seed = 5;
static double theta_m_rad[N], first[N], second[N];
static size_t periods[MOST], count;

void setUp(void)
{
}

void tearDown(void)
{
}

static void noise_fill(double samples_of_turn)
{
    for (size_t k = 0; k < N; ++k) {
        theta_m_rad[k] = 2.0 * REF_PI * (double)k / samples_of_turn;
        first[k] = 0.1 * ref_normal(&seed);
        second[k] = 0.1 * ref_normal(&seed);
    }
}

static void wave_add(double *value, double order, double amplitude)
{
    for (size_t k = 0; k < N; ++k)
        value[k] += amplitude * sin(order * theta_m_rad[k] + 0.7);
}

static void find(hci_standing_waves q, size_t most)
{
    static const double *const VALUE[] = {first, second};
    q.theta_m_rad = theta_m_rad;
    q.value = VALUE;
    q.n = N;
    q.axes = 2;
    TEST_ASSERT_TRUE(hci_standing_waves_find(&q, most, periods, &count));
}

/* Noise of 0.1 makes waves of 0.1·2/√N = 0.0037 rms. */
static void test_what_stands_out(void)
{
    noise_fill(300.0);
    find((hci_standing_waves){.stride = 1, .most_periods = 140, .apart = 1}, MOST);
    TEST_ASSERT_EQUAL_UINT64(0, count);
    wave_add(first, 31.0, 0.02);
    wave_add(second, 14.0, 0.03);
    find((hci_standing_waves){.stride = 1, .most_periods = 140, .apart = 1}, MOST);
    TEST_ASSERT_EQUAL_UINT64(2, count);
    TEST_ASSERT_EQUAL_UINT64(14, periods[0]);
    TEST_ASSERT_EQUAL_UINT64(31, periods[1]);
}

static void test_what_is_not_looked_at(void)
{
    noise_fill(300.0);
    wave_add(first, 31.0, 0.02);
    wave_add(second, 14.0, 0.03);
    find((hci_standing_waves){.stride = 1, .most_periods = 140, .apart = 1}, 1);
    TEST_ASSERT_EQUAL_UINT64(1, count);
    TEST_ASSERT_EQUAL_UINT64(14, periods[0]);
    find((hci_standing_waves){.stride = 3, .most_periods = 140, .apart = 1}, MOST);
    TEST_ASSERT_EQUAL_UINT64(0, count);
    find((hci_standing_waves){.stride = 1, .most_periods = 30, .apart = 1, .least = 0.001}, MOST);
    TEST_ASSERT_EQUAL_UINT64(0, count);
}

/* Two turns and a half, in which a wave has a part of its neighbours. */
static void test_neighbours_are_one(void)
{
    noise_fill(1200.0);
    wave_add(first, 31.0, 0.2);
    find((hci_standing_waves){.stride = 1, .most_periods = 140, .apart = 1}, MOST);
    TEST_ASSERT_TRUE(count > 1);
    find((hci_standing_waves){.stride = 1, .most_periods = 140, .apart = 2}, 1);
    TEST_ASSERT_EQUAL_UINT64(31, periods[0]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_stands_out);
    RUN_TEST(test_what_is_not_looked_at);
    RUN_TEST(test_neighbours_are_one);
    return UNITY_END();
}
