/* Whether rows follow each other, what currents some rows apart have in common, and how many rows are a part
 * of a turn: by hand. */
#include "host/diagnose/prepare/run_statistics.c"

#include "support/recording.h"
#include "unity.h"

enum { ROWS = 101, P = 3 };

static double theta_rad[ROWS];
static hci_run run;

void setUp(void)
{
}

void tearDown(void)
{
}

/* Even steps from an angle on, but for the first of them (or the last), which is so many times as long. */
static hci_run even(size_t rows, double times, bool first)
{
    theta_rad[0] = 2.0;
    for (size_t k = 1; k < rows; ++k)
        theta_rad[k] = theta_rad[k - 1] - 0.01 * (k == (first ? 1 : rows - 1) ? times : 1.0);
    return (hci_run){.count = rows, .theta_m_rad = theta_rad};
}

/* Of 100 steps of which one is 1 + x as long the squares are about x²(1 − 1/100), against EVEN² (1 + x/100)²
 * 100. */
static double times_at_the_bound(void)
{
    double low = 0.0, high = 100.0;
    for (int k = 0; k < 60; ++k) {
        const double x = 0.5 * (low + high), mean = 1.0 + x / 100.0;
        const double square = 99.0 * (x / 100.0) * (x / 100.0) + (x - x / 100.0) * (x - x / 100.0);
        if (square < EVEN * EVEN * mean * mean * 100.0)
            low = x;
        else
            high = x;
    }
    return 1.0 + low;
}

static void test_rows_that_follow_each_other(void)
{
    const double bound = times_at_the_bound();
    for (int first = 0; first < 2; ++first) {
        run = even(ROWS, 0.999 * bound, first);
        TEST_ASSERT_TRUE(is_in_order(&run));
        run = even(ROWS, 1.001 * bound, first);
        TEST_ASSERT_FALSE(is_in_order(&run));
        run.time_s = theta_rad;
        TEST_ASSERT_TRUE(is_in_order(&run));
    }
    run = even(LEAST_SAMPLES, 1.0, true);
    TEST_ASSERT_TRUE(is_in_order(&run));
    run = even(LEAST_SAMPLES - 1, 1.0, true);
    TEST_ASSERT_FALSE(is_in_order(&run));
    run.theta_m_rad = NULL;
    run.count = ROWS;
    TEST_ASSERT_FALSE(is_in_order(&run));
}

/* A sixteenth of an electrical turn: of rows over a way of 6 rad, which are 18 electrical. */
static void test_rows_of_a_part_of_a_turn(void)
{
    run = even(ROWS, 1.0, true);
    TEST_ASSERT_EQUAL_UINT64((size_t)(ROWS * 2.0 * HCI_PI / (16.0 * P * 1.0)), part_of_turn(&run, P));
    run.theta_m_rad = NULL;
    TEST_ASSERT_EQUAL_UINT64(0, part_of_turn(&run, P));
}

/* i_q of 3, 1, 2, 4 and 0.5 A beside standing currents: products of neighbours over squares from the second
 * on; of the currents two apart; of none at all it is 1. */
static void test_what_currents_have_in_common(void)
{
    static const double IQ_A[5] = {3.0, 1.0, 2.0, 4.0, 0.5}, STANDING_A[3] = {0.3, -0.2, 0.1};
    hci_run r = rec_make(5);
    for (size_t k = 0; k < 5; ++k) {
        r.theta_m_rad[k] = 0.7 * (double)k;
        rec_phases(0.0, IQ_A[k], P * r.theta_m_rad[k], r.i_A + 3 * k);
        for (size_t s = 0; s < 3; ++s)
            r.i_A[3 * k + s] += STANDING_A[s];
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, (3.0 + 2.0 + 8.0 + 2.0) / (1.0 + 4.0 + 16.0 + 0.25),
                              common_share(&r, P, STANDING_A, 1));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, (6.0 + 4.0 + 1.0) / (4.0 + 16.0 + 0.25),
                              common_share(&r, P, STANDING_A, 2));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, common_share(&r, P, STANDING_A, 5));
    rec_release(&r);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rows_that_follow_each_other);
    RUN_TEST(test_rows_of_a_part_of_a_turn);
    RUN_TEST(test_what_currents_have_in_common);
    return UNITY_END();
}
