/* Waits on the way of a shaft that is turned slowly: as long as it takes for half an electrical turn, or
 * more.
 */
#include "host/recording/slow_turn.c"

#include "unity.h"

enum { MOST = 100 };

static double time_s[MOST], theta_m_rad[MOST];
static hci_run run;

void setUp(void)
{
    run = (hci_run){.time_s = time_s, .theta_m_rad = theta_m_rad};
}

void tearDown(void)
{
}

/* 30 steps of the angle, of which 15 are an electrical turn, with a wait of so many samples in the middle. */
static size_t waits_with(size_t samples, size_t *middle)
{
    size_t found[MOST_WAITS] = {0};
    run.count = 31 + samples;
    for (size_t k = 0; k < run.count; ++k) {
        const size_t gone = k <= 15 ? k : k <= 15 + samples ? 15 : k - samples;
        time_s[k] = 0.25 * (double)k;
        theta_m_rad[k] = (double)gone;
    }
    const rows x = {.run = &run, .turn_rad = 15.0};
    const size_t waits = waits_of(&x, 0, run.count, found);
    *middle = found[0];
    return waits;
}

/* The wait takes n steps of 30 + n, and half an electrical turn a quarter of all time: 10 of 40. */
static void test_a_wait_of_half_a_turn(void)
{
    size_t middle;
    TEST_ASSERT_EQUAL_UINT64(0, waits_with(0, &middle));
    TEST_ASSERT_EQUAL_UINT64(0, waits_with(10, &middle));
    TEST_ASSERT_EQUAL_UINT64(1, waits_with(11, &middle));
    TEST_ASSERT_UINT64_WITHIN(1, 15 + 5, middle);
    TEST_ASSERT_EQUAL_UINT64(1, waits_with(40, &middle));
    TEST_ASSERT_UINT64_WITHIN(1, 15 + 20, middle);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_wait_of_half_a_turn);
    return UNITY_END();
}
