/* A parameter over the day and from batch to batch: sums by hand of lists that are out of order. */
#include "host/fleet/trends.h"

#include <math.h>

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- over the day ---- */

/* Weighted least squares by the four sums of the textbook: slope (S Sxy − Sx Sy)/(S Sxx − Sx²), its variance
 * S/(S Sxx − Sx²). Points without a day do not count. */
static void test_a_line_over_the_day(void)
{
    static const double DAY[] = {9.0, 2.0, 5.0, 2.0, 14.0}, VALUE[] = {3.1, 1.2, 2.5, 0.8, 3.7},
                        ERROR[] = {0.3, 0.1, 0.2, 0.5, 0.4}, BETWEEN = 0.25;
    hci_trend_point point[7];
    double s = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, per_day = 0.0, std_error = 0.0;
    for (int k = 0; k < 5; ++k) {
        const double w = 1.0 / (BETWEEN * BETWEEN + ERROR[k] * ERROR[k]);
        point[k + k / 2] = (hci_trend_point){VALUE[k], ERROR[k], DAY[k], ""};
        s += w;
        sx += w * DAY[k];
        sy += w * VALUE[k];
        sxx += w * DAY[k] * DAY[k];
        sxy += w * DAY[k] * VALUE[k];
    }
    point[2] = point[5] = (hci_trend_point){77.0, 0.1, (double)NAN, ""};
    hci_trend_find(point, 7, BETWEEN, &per_day, &std_error);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, (s * sxy - sx * sy) / (s * sxx - sx * sx), per_day);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(s / (s * sxx - sx * sx)), std_error);
}

/* Of two days nothing is concluded, however many motors there are; of three it is. */
static void test_three_days_are_a_trend(void)
{
    hci_trend_point point[4] = {
        {1.0, 0.1, 3.0, ""}, {2.0, 0.1, 8.0, ""}, {2.2, 0.1, 8.0, ""}, {1.1, 0.1, 3.0, ""}};
    double per_day = 0.0, std_error = 0.0;
    hci_trend_find(point, 4, 0.1, &per_day, &std_error);
    TEST_ASSERT_TRUE(isnan(per_day) && isnan(std_error));
    point[1].day += 1.0;
    hci_trend_find(point, 4, 0.1, &per_day, &std_error);
    TEST_ASSERT_FALSE(isnan(per_day) || isnan(std_error));
}

/* ---- from batch to batch ---- */

/* Quantiles of tables: 2.5 % of F(5, 10) above 4.2361, 5 % of F(3, 20) above 3.0984, half of F(2, 9) above
 * 0.7494; the approximation is one of a hundredth. */
static void test_quantiles_of_F(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 1.9600, hci_trend_normal_of_F(4.2361, 5.0, 10.0));
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 1.6449, hci_trend_normal_of_F(3.0984, 3.0, 20.0));
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.0, hci_trend_normal_of_F(0.7494, 2.0, 9.0));
}

enum { MOTORS = 10 };

/* Batches a, b, c of 3, 2 and 4 motors, and one that is not known. */
static void batches_fill(hci_trend_point point[MOTORS])
{
    static const double VALUE[MOTORS] = {1.7, 1.0, 99.0, 2.1, 1.5, 1.3, 1.9, 2.4, 0.9, 1.6};
    static const char *const BATCH[MOTORS] = {"c", "a", "", "b", "c", "a", "c", "b", "a", "c"};
    for (int k = 0; k < MOTORS; ++k)
        point[k] = (hci_trend_point){VALUE[k], 0.1, (double)NAN, BATCH[k]};
}

/* Means 3.2/3, 2.25 and 1.675 about 14.4/9 = 1.6; m̄ = (9 − 29/9)/2. */
static void test_batches_that_differ(void)
{
    hci_trend_point point[MOTORS];
    const double a = 3.2 / 3.0, b = 2.25, c = 1.675;
    const double between =
        3.0 * (a - 1.6) * (a - 1.6) + 2.0 * (b - 1.6) * (b - 1.6) + 4.0 * (c - 1.6) * (c - 1.6);
    const double within = (1.0 - a) * (1.0 - a) + (1.3 - a) * (1.3 - a) + (0.9 - a) * (0.9 - a) +
                          2.0 * 0.15 * 0.15 + 0.025 * 0.025 + 0.175 * 0.175 + 0.225 * 0.225 + 0.075 * 0.075;
    const double usual = (9.0 - 29.0 / 9.0) / 2.0, below = within / 6.0;
    const double square = (between / 2.0 - below) / usual;
    batches_fill(point);
    const hci_trend_of_batches found = hci_trend_batches(point, MOTORS);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(square), found.deviation);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, hci_trend_normal_of_F(between / 2.0 / below, 2.0, 6.0), found.criterion);
    TEST_ASSERT_EQUAL_STRING("b", found.furthest);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.65, found.beside);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(1.0 + (usual - 1.0) * square / (square + below)), found.widening);
}

/* Batches whose means are nearer to each other than chance makes them have no deviation, and widen nothing.
 */
static void test_batches_that_are_alike(void)
{
    hci_trend_point point[4] = {
        {1.0, 0.1, NAN, "x"}, {3.0, 0.1, NAN, "y"}, {3.01, 0.1, NAN, "x"}, {1.0, 0.1, NAN, "y"}};
    const hci_trend_of_batches found = hci_trend_batches(point, 4);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, found.deviation);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, found.widening);
    TEST_ASSERT_TRUE(found.criterion < 0.0);
}

/* One batch tells nothing, nor do batches of one motor each, nor motors that are all the same. */
static void test_what_tells_nothing_of_batches(void)
{
    hci_trend_point one[3] = {{1.0, 0.1, NAN, "x"}, {3.0, 0.1, NAN, "x"}, {9.0, 0.1, NAN, ""}},
                    each[2] = {{1.0, 0.1, NAN, "x"}, {3.0, 0.1, NAN, "y"}},
                    same[4] = {{1.0, 0.1, NAN, "x"},
                               {2.0, 0.1, NAN, "y"},
                               {1.0, 0.1, NAN, "x"},
                               {2.0, 0.1, NAN, "y"}};
    const hci_trend_of_batches found[4] = {hci_trend_batches(one, 3), hci_trend_batches(each, 2),
                                           hci_trend_batches(same, 4), hci_trend_batches(one, 0)};
    for (int k = 0; k < 4; ++k) {
        TEST_ASSERT_TRUE(isnan(found[k].deviation) && isnan(found[k].criterion));
        TEST_ASSERT_NULL(found[k].furthest);
        TEST_ASSERT_EQUAL_DOUBLE(1.0, found[k].widening);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_line_over_the_day);
    RUN_TEST(test_three_days_are_a_trend);
    RUN_TEST(test_quantiles_of_F);
    RUN_TEST(test_batches_that_differ);
    RUN_TEST(test_batches_that_are_alike);
    RUN_TEST(test_what_tells_nothing_of_batches);
    return UNITY_END();
}
