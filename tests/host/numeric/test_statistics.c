/* Mean, mean square and peak-to-peak of a few numbers, by hand. */
#include "host/numeric/statistics.h"

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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_four_numbers);
    RUN_TEST(test_one_number);
    RUN_TEST(test_the_median);
    return UNITY_END();
}
