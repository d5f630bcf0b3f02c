/* What slopes over a window show of a rate: the same as the slopes of its integral in closed form. */
#include "host/numeric/slope_average.h"

#include <math.h>

#include "host/numeric/derivative.h"
#include "support/reference.h"
#include "unity.h"

enum { N = 400 };

static double t[N], x[3 * N], integral[N], slope[N], work[2 * N];

void setUp(void)
{
    uint64_t seed = 3;
    t[0] = 1.0;
    for (size_t k = 1; k < N; ++k)
        t[k] = t[k - 1] + 1e-3 * ref_uniform(&seed, 0.9, 1.1);
}

void tearDown(void)
{
}

/* The largest difference between the mean over the window and the slope of the integral, away from the ends.
 * x = cos ωt, every third value of an array. */
static double difference_at(double omega, size_t window)
{
    double most = 0.0;
    for (size_t k = 0; k < N; ++k) {
        x[3 * k + 1] = cos(omega * t[k]);
        integral[k] = sin(omega * t[k]) / omega;
    }
    hci_derivative_over(t, integral, N, window, slope);
    hci_slope_average(t, N, window, x + 1, 3, work);
    for (size_t k = window; k + window < N; ++k)
        most = fmax(most, fabs(x[3 * k + 1] - slope[k]));
    return most;
}

/* A third of a radian from sample to sample, and a whole one, where straight lines between the samples would
 * be off by 0.009 and 0.085. */
static void test_slope_of_the_integral(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(5e-4, 0.0, difference_at(333.0, 5));
    TEST_ASSERT_DOUBLE_WITHIN(5e-4, 0.0, difference_at(333.0, 15));
    TEST_ASSERT_DOUBLE_WITHIN(0.03, 0.0, difference_at(1000.0, 5));
}

/* Of the means of the steps in closed form, four radians a sample, where no curve through samples helps. */
static void test_means_of_steps(void)
{
    const double omega = 4000.0;
    for (size_t k = 0; k < N; ++k)
        integral[k] = sin(omega * t[k]) / omega;
    for (size_t k = 0; k + 1 < N; ++k)
        x[3 * k + 1] = (integral[k + 1] - integral[k]) / (t[k + 1] - t[k]);
    hci_derivative_over(t, integral, N, 5, slope);
    hci_slope_average_of_steps(t, N, 5, x + 1, 3, work);
    for (size_t k = 0; k < N; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, slope[k], x[3 * k + 1]);
}

/* What does not vary stays, at the ends too; two samples have no window. */
static void test_constant(void)
{
    for (size_t k = 0; k < N; ++k)
        x[k] = 2.5;
    hci_slope_average(t, N, 7, x, 1, work);
    for (size_t k = 0; k < N; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, 2.5, x[k]);
    x[1] = 4.0;
    hci_slope_average(t, 2, 5, x, 1, work);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, x[1]);
}

/* The integral of a straight line is a parabola, whose slope is exact, in the first and last windows too. */
static void test_straight_line(void)
{
    for (size_t k = 0; k < N; ++k)
        x[k] = 3.0 - 40.0 * (t[k] - t[0]);
    hci_slope_average(t, N, 7, x, 1, work);
    for (size_t k = 0; k < N; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, 3.0 - 40.0 * (t[k] - t[0]), x[k]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_slope_of_the_integral);
    RUN_TEST(test_means_of_steps);
    RUN_TEST(test_constant);
    RUN_TEST(test_straight_line);
    return UNITY_END();
}
