/* The top near a sample, the range of values, common divisors, and draws against what they are drawn from. */
#include "host/numeric/peak.h"

#include <math.h>

#include "host/numeric/divisor.h"
#include "host/numeric/draws.h"
#include "host/numeric/range.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- tops ---- */

static unsigned asked;

static double hill(const void *context, double x)
{
    const double top = *(const double *)context;
    ++asked;
    return 2.0 - cosh(1.7 * (x - top)) + 0.1 * (x - top) * (x - top) * (x - top);
}

/* From either side, and from more than a width away. A thousandth of the width, squared, is what is left of
 * the value. */
static void test_the_top_is_found(void)
{
    static const double START[] = {-0.9, -0.4, 0.05, 0.6, 1.1};
    const double top = 0.1234;
    const hci_peak_function f = {hill, &top};
    for (int k = 0; k < 5; ++k) {
        double x = START[k];
        asked = 0;
        const double most = hci_peak_refine(&f, 0.5, &x);
        TEST_ASSERT_DOUBLE_WITHIN(2e-3, top, x);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, 1.0, most);
        TEST_ASSERT_EQUAL_DOUBLE(hill(&top, x), most);
        TEST_ASSERT_TRUE(asked <= 45);
    }
}

static double slope(const void *context, double x)
{
    (void)context;
    return 3.0 * x;
}

/* Without a top it climbs, twelve widths at most. */
static void test_a_slope_is_climbed(void)
{
    const hci_peak_function f = {slope, NULL};
    double x = 1.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0 * 13.0, hci_peak_refine(&f, 1.0, &x));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 13.0, x);
}

/* ---- ranges, divisors ---- */

static void test_ranges_leave_out_what_is_not_finite(void)
{
    static const double VALUE[] = {NAN, 2.0, INFINITY, -1.5, -INFINITY, 0.5};
    hci_range r = HCI_RANGE_EMPTY;
    TEST_ASSERT_TRUE(r.low > r.high);
    for (int k = 0; k < 6; ++k)
        hci_range_include(&r, VALUE[k]);
    TEST_ASSERT_TRUE(r.low == -1.5 && r.high == 2.0);
}

static void test_common_divisors(void)
{
    for (size_t a = 0; a < 40; ++a)
        for (size_t b = 0; b < 40; ++b) {
            size_t d = a > b ? a : b;
            while (d > 1 && (a % d || b % d))
                --d;
            TEST_ASSERT_EQUAL_UINT64(d, hci_common_divisor(a, b));
        }
}

/* ---- draws ---- */

enum { DRAWS = 40000 };

/* SplitMix64 from seed 1234567 gives 6457827717110365317 first (Steele, Lea and Flood). */
static void test_generator_is_splitmix64(void)
{
    hci_draws d = {1234567};
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 6457827717110365317.0 / 18446744073709551616.0, hci_draws_uniform(&d));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 3203168211198807973.0 / 18446744073709551616.0, hci_draws_uniform(&d));
}

/* Moments within five of their standard errors; E ν/χ² = ν/(ν − 2). */
static void test_draws_have_their_moments(void)
{
    hci_draws d = {7};
    double sum[5] = {0.0}, student = 0.0;
    for (int k = 0; k < DRAWS; ++k) {
        const double x = hci_draws_normal(&d), s = hci_draws_student_scale(&d, 12);
        for (int m = 1; m <= 4; ++m)
            sum[m] += pow(x, m) / DRAWS;
        student += s * s / DRAWS;
    }
    TEST_ASSERT_DOUBLE_WITHIN(5.0 / sqrt(DRAWS), 0.0, sum[1]);
    TEST_ASSERT_DOUBLE_WITHIN(5.0 * sqrt(2.0 / DRAWS), 1.0, sum[2]);
    TEST_ASSERT_DOUBLE_WITHIN(5.0 * sqrt(15.0 / DRAWS), 0.0, sum[3]);
    TEST_ASSERT_DOUBLE_WITHIN(5.0 * sqrt(96.0 / DRAWS), 3.0, sum[4]);
    TEST_ASSERT_DOUBLE_WITHIN(5.0 * 0.6 / sqrt(DRAWS), 1.2, student); /* their deviation is 1.2/√4 */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_top_is_found);
    RUN_TEST(test_a_slope_is_climbed);
    RUN_TEST(test_ranges_leave_out_what_is_not_finite);
    RUN_TEST(test_common_divisors);
    RUN_TEST(test_generator_is_splitmix64);
    RUN_TEST(test_draws_have_their_moments);
    return UNITY_END();
}
