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
    RUN_TEST(test_the_step_of_counts);
    return UNITY_END();
}
