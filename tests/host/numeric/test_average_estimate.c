/* Means over turns, their standard errors and the chance of noise, of passes that are written by hand. */
#include <math.h>
#include <string.h>

#include "host/numeric/synchronous_average.h"
#include "unity.h"

enum { MOST_PASSES = 12, MOST_ORDERS = 61, CHANNELS = 2 };

static hci_average average;
static hci_average_pass pass[MOST_PASSES];
static hci_average_harmonic wave[MOST_PASSES * CHANNELS * MOST_ORDERS];

/* `forward` passes, and then `backward` ones; all waves are 0. */
static void start(size_t highest, size_t forward, size_t backward)
{
    memset(wave, 0, sizeof wave);
    average = (hci_average){highest, CHANNELS, forward + backward, 1, pass, wave};
    for (size_t k = 0; k < average.count; ++k)
        pass[k] = (hci_average_pass){10 * k, 10, k < forward ? 1 : -1};
}

void setUp(void)
{
}

void tearDown(void)
{
}

static hci_average_harmonic *at(size_t k, size_t order)
{
    return hci_average_at(&average, k, 1, order);
}

static hci_order_estimate estimate(size_t order)
{
    return hci_average_estimate(&average, 1, order);
}

/* ---- means ---- */

/* Of each direction, and then of the directions: two forward of 1 and 3, four backward of 10. */
static void test_means_of_directions(void)
{
    double error;
    start(2, 2, 4);
    for (size_t k = 0; k < 6; ++k) {
        *at(k, 1) =
            k < 2 ? (hci_average_harmonic){1.0 + 2.0 * (double)k, -1.0} : (hci_average_harmonic){10.0, 4.0};
        at(k, 0)->cosine = k < 2 ? 0.5 : 0.9;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 6.0, estimate(1).mean.sine);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5, estimate(1).mean.cosine);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.2, hci_average_half_difference(&average, 1, &error));
    TEST_ASSERT_EQUAL_DOUBLE(estimate(0).std_error, error);
    TEST_ASSERT_EQUAL(2, hci_average_passes(&average, 1));
    TEST_ASSERT_EQUAL(4, hci_average_passes(&average, -1));
    TEST_ASSERT_EQUAL(0, hci_average_passes(&average, 0));
    start(2, 3, 0);
    TEST_ASSERT_TRUE(isnan(hci_average_half_difference(&average, 1, &error)) && isnan(error));
    start(2, 0, 3);
    TEST_ASSERT_TRUE(isnan(hci_average_half_difference(&average, 1, &error)));
}

/* Three degrees of freedom beside the mean of each direction. */
static void test_turns_enough(void)
{
    for (size_t count = 1; count < 8; ++count) {
        start(2, count, 0);
        TEST_ASSERT_EQUAL(count >= 4, hci_average_has_repeats(&average));
        start(2, count, 1);
        TEST_ASSERT_EQUAL(count + 1 >= 5, hci_average_has_repeats(&average));
    }
    start(2, 4, 0);
    pass[1].direction = -1;
    pass[2].direction = 0;
    TEST_ASSERT_FALSE(hci_average_has_repeats(&average));
}

/* ---- between turns ---- */

/* Departures of order n by turns, in the signs of a text: the mean is 1. */
static void depart(size_t order, double size, const char *signs)
{
    for (size_t k = 0; k < average.count; ++k)
        *at(k, order) = (hci_average_harmonic){1.0, 1.0 + (signs[k] == '+' ? size : -size)};
}

/* Σ d² = 8 e², of 7 degrees of freedom and two coordinates, over 8: turns that alternate resemble nothing. */
static void test_error_of_a_mean(void)
{
    start(1, 8, 0);
    depart(1, 0.1, "+-+-+-+-");
    depart(0, 0.1, "+-+-+-+-");
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 / sqrt(14.0), estimate(1).std_error);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 14.0, estimate(1).freedom);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 / sqrt(7.0), estimate(0).std_error);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 7.0, estimate(0).freedom);
    start(0, 2, 6); /* a quarter of 1/2 + 1/6 in place of 1/8, six degrees of freedom */
    depart(0, 0.1, "+-+-+-+-");
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 * sqrt(8.0 / 6.0 / 6.0), estimate(0).std_error);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 6.0, estimate(0).freedom);
}

/* Σ d_j d_{j+1} of ++−−++−− is 1 of 8: r = 1/8 + (1 + 3/8)/8; of ++++−−−− it is 5, and r more than 0.8. */
static void test_turns_that_resemble_the_next(void)
{
    const double r = 0.125 + 1.375 / 8.0, factor = (1.0 + r) / (1.0 - r);
    start(0, 8, 0);
    depart(0, 0.1, "++--++--");
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 * sqrt(factor / 7.0), estimate(0).std_error);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 7.0 / factor, estimate(0).freedom);
    depart(0, 0.1, "++++----");
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 * sqrt(9.0 / 7.0), estimate(0).std_error);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, estimate(0).freedom);
    start(0, 4, 4); /* the last forward and the first backward are no neighbours: −1 in each */
    depart(0, 0.1, "+--++--+");
    const double raw = -2.0 / 8.0, of_ways = fmax(0.0, raw + (1.0 + 3.0 * raw) / 8.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, of_ways);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 * sqrt(1.0 / 6.0), estimate(0).std_error);
}

/* Orders around count with the order, ten on each side and without order 0, unless it resembles clearly more.
 */
static void test_resemblance_of_the_orders_around(void)
{
    const double high = 0.125 + 1.375 / 8.0, low = -0.875 + (1.0 - 2.625) / 8.0;
    for (size_t order = 1; order <= 14; order += 13) {
        start(30, 8, 0);
        for (size_t k = 0; k <= 30; ++k)
            depart(k, 0.1, k == order ? "+-+-+-+-" : "++--++--");
        const double around = order == 1 ? 10.0 : 20.0; /* 2 … 11; 4 … 13 and 15 … 24 */
        const double r = (around * high + low) / (around + 1.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 * sqrt((1.0 + r) / (1.0 - r) / 14.0), estimate(order).std_error);
    }
    for (size_t k = 0; k <= 30; ++k)
        depart(k, 0.1, k == 14 ? "++--++--" : "+-+-+-+-");
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 * sqrt((1.0 + high) / (1.0 - high) / 14.0), estimate(14).std_error);
    /* 0.297 is not clearly more than the mean of half of them, which is below 0 */
    for (size_t k = 0; k <= 30; ++k)
        depart(k, 0.1, k % 2 == 0 ? "++--++--" : "+--+-++-");
    const double other = -3.0 / 8.0 + (1.0 - 9.0 / 8.0) / 8.0, mean = (11.0 * high + 10.0 * other) / 21.0;
    TEST_ASSERT_TRUE(high > mean && high < mean + 1.0 / sqrt(8.0));
    const double r = fmax(mean, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 * sqrt((1.0 + r) / (1.0 - r) / 14.0), estimate(14).std_error);
}

/* ---- from the orders around ---- */

/* Amplitudes as large as their order: the median of the squares tells which orders were taken. */
static void rising(size_t highest)
{
    start(highest, 2, 0);
    for (size_t k = 0; k < 2; ++k)
        for (size_t n = 0; n <= highest; ++n)
            *at(k, n) = (hci_average_harmonic){0.6 * (double)n, -0.8 * (double)n};
}

static void check_median(size_t order, double below, double above, double count)
{
    const double median = 0.5 * (below * below + above * above);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(median / (2.0 * log(2.0)) / (order == 0 ? 2.0 : 1.0)),
                              estimate(order).std_error);
    TEST_ASSERT_EQUAL_DOUBLE(count, estimate(order).freedom);
}

/* Half of the order on either side, 20 at most, and eight in all where there are so many. */
static void test_orders_around(void)
{
    rising(60);
    check_median(20, 19.0, 21.0, 20.0); /* 10 … 30 */
    check_median(21, 20.0, 22.0, 20.0); /* 11 … 31 */
    check_median(44, 41.0, 42.0, 36.0); /* 24 … 60: above are 16 */
    check_median(40, 39.0, 41.0, 40.0); /* 20 … 60 */
    check_median(60, 49.0, 50.0, 20.0); /* 40 … 59 */
    check_median(3, 6.0, 7.0, 8.0);     /* 2, 4 … 10 */
    check_median(1, 5.0, 6.0, 8.0);     /* 2 … 9 */
    check_median(0, 4.0, 5.0, 8.0);     /* 1 … 8 */
    rising(5);
    check_median(5, 2.0, 3.0, 4.0); /* 1 … 4 */
    rising(6);
    check_median(4, 3.0, 3.0, 5.0); /* 1, 2, 3, 5, 6 */
    rising(1);
    TEST_ASSERT_TRUE(isnan(estimate(1).std_error));
    TEST_ASSERT_EQUAL_DOUBLE(2.0, estimate(1).freedom);
}

/* ---- chance ---- */

/* F with 2 and n degrees: (1 + 2F/n)^(−n/2). */
static void test_chance_of_an_order(void)
{
    hci_order_estimate e = {{3.0, 4.0}, 2.5, 2.0};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0 / 3.0, hci_order_chance(&e));
    e.freedom = 4.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.25, hci_order_chance(&e));
    e.freedom = 1e9;
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, exp(-2.0), hci_order_chance(&e));
    e.std_error = NAN;
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_order_chance(&e));
    e = (hci_order_estimate){{0.0, 0.0}, 1.0, 2.0};
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_order_chance(&e));
}

/* Twice the lesser of two, and 1 at most; without repeats that of the orders around. */
static void test_chance_by_what_tells_more(void)
{
    rising(60);
    hci_order_estimate e = estimate(60);
    TEST_ASSERT_EQUAL_DOUBLE(hci_order_chance(&e), hci_average_chance(&average, 1, 60));
    start(30, 8, 0);
    for (size_t k = 0; k <= 30; ++k)
        depart(k, 0.1,
               "+-+-+-+-"); /* all are 1 and 1: as large as the noise around, but far above that between */
    e = estimate(20);
    TEST_ASSERT_DOUBLE_WITHIN(1e-18, 2.0 * hci_order_chance(&e), hci_average_chance(&average, 1, 20));
    for (size_t k = 0; k <= 30; ++k)
        depart(k, 4.0, "+-+-+-+-");
    for (size_t k = 0; k < 8; ++k) /* 1000 times what is around, and between turns as uneven */
        at(k, 20)->sine = k % 2 ? 2500.0 : -500.0;
    const double around = (1000.0 * 1000.0 + 1.0) * log(2.0) / 2.0; /* F: the median of the squares is 2 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * 2.0 * pow(1.0 + around / 10.0, -10.0),
                              2.0 * pow(1.0 + around / 10.0, -10.0), hci_average_chance(&average, 1, 20));
    for (size_t k = 0; k < 8; ++k)
        *at(k, 20) = (hci_average_harmonic){k % 2 ? 0.1 : -0.1, k % 2 ? 0.1 : -0.09};
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_average_chance(&average, 1, 20));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_means_of_directions);
    RUN_TEST(test_turns_enough);
    RUN_TEST(test_error_of_a_mean);
    RUN_TEST(test_turns_that_resemble_the_next);
    RUN_TEST(test_resemblance_of_the_orders_around);
    RUN_TEST(test_orders_around);
    RUN_TEST(test_chance_of_an_order);
    RUN_TEST(test_chance_by_what_tells_more);
    return UNITY_END();
}
