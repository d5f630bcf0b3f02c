/* Mean, mean square and peak-to-peak of a few numbers, by hand. */
#include "host/numeric/statistics.h"

#include <math.h>

#include "support/draws.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static const double X[] = {3.0, -1.0, 2.0, 4.0};

static void test_four_numbers(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(2.0, hci_mean(X, 4));
    TEST_ASSERT_EQUAL_DOUBLE((1.0 + 9.0 + 0.0 + 4.0) / 4.0, hci_mean_square_about(X, 4, 2.0));
    TEST_ASSERT_EQUAL_DOUBLE((9.0 + 1.0 + 4.0 + 16.0) / 4.0, hci_mean_square_about(X, 4, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE((4.0 + 4.0 + 1.0 + 9.0) / 4.0, hci_mean_square_about(X, 4, 1.0));
    TEST_ASSERT_EQUAL_DOUBLE(5.0, hci_peak_to_peak(X, 4));
}

static void test_one_number(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(3.0, hci_mean(X, 1));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_mean_square_about(X, 1, 3.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_peak_to_peak(X, 1));
}

static void test_the_median(void)
{
    double odd[] = {3.0, -1.0, 2.0, 4.0, 2.0}, even[] = {3.0, -1.0, 2.5, 4.0}, one[] = {7.0};
    TEST_ASSERT_EQUAL_DOUBLE(2.0, hci_median(odd, 5));
    TEST_ASSERT_EQUAL_DOUBLE(3.0, hci_median(even, 4));
    TEST_ASSERT_EQUAL_DOUBLE(7.0, hci_median(one, 1));
    double many[101];
    for (int k = 0; k < 101; ++k)
        many[k] = (k * 37) % 101;
    TEST_ASSERT_EQUAL_DOUBLE(50.0, hci_median(many, 101));
}

/* Of random numbers, of which some are the same: as many are below as above, or one more below. */
static void test_medians_of_random_numbers(void)
{
    uint64_t state = 9;
    for (int trial = 0; trial < 300; ++trial) {
        double x[40], copy[40];
        const int n = ref_integer(&state, 1, 40), kinds = ref_integer(&state, 1, 60);
        int below = 0, same = 0;
        for (int k = 0; k < n; ++k)
            copy[k] = x[k] = (double)ref_integer(&state, -kinds, kinds);
        const double median = hci_median(x, (size_t)n);
        for (int k = 0; k < n; ++k)
            below += copy[k] < median, same += copy[k] == median;
        TEST_ASSERT_TRUE(same > 0 && below <= n / 2 && below + same > n / 2);
    }
}

/* The least change of the slope that is more than rounding. */
static void test_the_quantum(void)
{
    const double x[] = {0.0, 3.0, 6.0, 9.5, 13.0, 16.3, 19.6, 22.9};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.2, hci_quantum(x, 8, 1e-6));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, hci_quantum(x, 8, 0.3));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, hci_quantum(x, 5, 1e-6));
    TEST_ASSERT_EQUAL_DOUBLE(0.7, hci_quantum(x, 8, 0.7));
    TEST_ASSERT_EQUAL_DOUBLE(0.7, hci_quantum(x, 2, 0.7));
}

/* Turns of an encoder of 16384 counts, written to 1e-5 of a turn: second differences are whole counts within
 * a sixth. An angle that is not counted, with noise or without, has no step. */
static void test_the_step_of_counts(void)
{
    enum { N = 3000 };
    static double counted[N], smooth[N], noisy[N];
    uint64_t state = 5;
    for (int k = 0; k < N; ++k) {
        const double turn = 4e-4 * k + 3e-5 * sin(0.42 * k);
        counted[k] = 1e-5 * round(1e5 * floor(16384.0 * turn) / 16384.0);
        smooth[k] = turn;
        noisy[k] = turn + 1e-4 * ref_normal(&state);
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.05 / 16384.0, 1.0 / 16384.0, hci_step_of_counts(counted, N));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_step_of_counts(noisy, N));
    TEST_ASSERT_TRUE(hci_step_of_counts(smooth, N) < 2e-5);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_step_of_counts(counted, 2));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_four_numbers);
    RUN_TEST(test_one_number);
    RUN_TEST(test_the_median);
    RUN_TEST(test_medians_of_random_numbers);
    RUN_TEST(test_the_quantum);
    RUN_TEST(test_the_step_of_counts);
    return UNITY_END();
}
