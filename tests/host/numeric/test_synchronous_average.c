/* Polynomials of each turn, found again from samples at uneven angles: which turns there are, how many orders
 * they bear, and waves that differ from turn to turn. */
#include "host/numeric/synchronous_average.h"

#include <math.h>

#include "host/base/memory.h"
#include "support/least_squares.h"
#include "support/reference.h"
#include "unity.h"

enum { MOST = 2000, CHANNELS = 2, ORDERS = 6 };

static double angle[MOST], value[MOST * CHANNELS];
static size_t count;
static hci_average average;

void setUp(void)
{
    count = 0;
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_average_release(&average);
}

/* S and C of an order in a part of the path; the second channel has twice the first one's and another mean.
 */
static hci_average_harmonic made(int part, size_t order)
{
    return (hci_average_harmonic){order > 0 ? 1.0 / ((double)order + part) : 0.0,
                                  0.3 * (double)order - 0.1 * part + 0.7};
}

static void add(double at, int part)
{
    double sum = 0.0;
    for (size_t n = 0; n <= ORDERS; ++n)
        sum += made(part, n).sine * sin((double)n * at) + made(part, n).cosine * cos((double)n * at);
    angle[count] = at;
    value[CHANNELS * count] = sum;
    value[CHANNELS * count++ + 1] = 2.0 * sum + 5.0;
}

/* `samples` a turn from one angle to another, whose steps vary by a third. */
static void go(double from, double to, double samples, int part)
{
    const double step = (to > from ? 2.0 : -2.0) * REF_PI / samples;
    double at = from;
    for (int k = 0; step * (to - at) > 1e-9; ++k) {
        add(at, part);
        at += step * (k % 2 ? 1.3 : 0.7);
    }
}

static hci_status fit(size_t wanted, size_t enough, size_t least)
{
    const hci_average_samples samples = {angle, value, count, CHANNELS};
    const hci_average_orders orders = {wanted, enough, least};
    hci_average_release(&average);
    return hci_average_fit(&samples, &orders, &average);
}

static void check_pass(size_t k, int direction, int part)
{
    TEST_ASSERT_EQUAL(direction, average.pass[k].direction);
    for (size_t n = 0; n <= average.highest; ++n) {
        const hci_average_harmonic *first = hci_average_at(&average, k, 0, n),
                                   *second = hci_average_at(&average, k, 1, n);
        const hci_average_harmonic w = n <= ORDERS ? made(part, n) : (hci_average_harmonic){0.0, 0.0};
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, w.sine, first->sine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, w.cosine, first->cosine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0 * w.sine, second->sine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0 * w.cosine + (n == 0 ? 5.0 : 0.0), second->cosine);
    }
}

/* Three turns forward and two back, each way with waves of its own. */
static void test_turns_of_both_ways(void)
{
    const double turn = 2.0 * REF_PI;
    go(0.3, 0.3 + 3.0 * turn, 40.0, 1);
    go(0.3 + 3.0 * turn, 0.3 + turn, 40.0, 2);
    TEST_ASSERT_EQUAL(HCI_OK, fit(ORDERS, ORDERS, 1));
    TEST_ASSERT_EQUAL(ORDERS, average.highest);
    TEST_ASSERT_EQUAL(CHANNELS, average.channels);
    TEST_ASSERT_EQUAL(1, average.turns_each);
    TEST_ASSERT_EQUAL(5, average.count);
    for (size_t k = 0; k < 5; ++k)
        check_pass(k, k < 3 ? 1 : -1, k < 3 ? 1 : 2);
    TEST_ASSERT_EQUAL(0, average.pass[0].first);
    TEST_ASSERT_EQUAL(average.pass[1].first, average.pass[0].count);
    hci_average back;
    TEST_ASSERT_EQUAL(HCI_OK, hci_average_of_direction(&average, -1, &back));
    TEST_ASSERT_EQUAL(2, back.count);
    TEST_ASSERT_EQUAL(average.pass[3].first, back.pass[0].first);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, made(2, 4).sine, hci_average_at(&back, 1, 0, 4)->sine);
    TEST_ASSERT_EQUAL(ORDERS, back.highest);
    hci_average_release(&back);
}

/* The way back of less than a fiftieth of a turn is flicker. */
static void test_flicker(void)
{
    for (int more = 0; more < 2; ++more) {
        const double top = 0.3 + 2.0 * REF_PI * 1.5, back = 2.0 * REF_PI * (more ? 0.024 : 0.016);
        count = 0;
        go(0.3, top, 100.0, 1);
        const double last = angle[count - 1];
        for (int k = 1; k < 5; ++k)
            add(last - back * k / 4.0, 1);
        go(last - back + 1e-3, last + 2.0 * REF_PI * 1.5, 100.0, 1);
        TEST_ASSERT_EQUAL(HCI_OK, fit(ORDERS, 1, 1));
        for (size_t k = 0; k < average.count; ++k)
            TEST_ASSERT_EQUAL(1, average.pass[k].direction);
        TEST_ASSERT_EQUAL(more ? 2 : 3, average.count); /* without it three turns, else one of each part */
    }
}

/* M times the largest gap stays below 0.8 π: even steps of 1/41 turn bear 16 orders. */
static void test_orders_that_samples_bear(void)
{
    for (size_t k = 0; k < 3 * 41; ++k)
        add(2.0 * REF_PI * (double)k * (1.0 + 1e-9) / 41.0 + 1e-3, 1);
    TEST_ASSERT_EQUAL(HCI_OK, fit(100, 10, 1));
    TEST_ASSERT_EQUAL(16, average.highest);
    TEST_ASSERT_EQUAL(1, average.turns_each);
    check_pass(0, 1, 1);
    TEST_ASSERT_EQUAL(HCI_OK, fit(12, 10, 1));
    TEST_ASSERT_EQUAL(12, average.highest);
    TEST_ASSERT_EQUAL(HCI_ERROR_SINGULAR, fit(100, 10, 17));
    TEST_ASSERT_EQUAL(HCI_OK, fit(100, 10, 16));
}

/* Where turns bear too few, several are put together: 20.5 samples a turn are 41 in two. */
static void test_turns_together(void)
{
    for (size_t k = 0; k < 6 * 41; ++k)
        add(2.0 * REF_PI * (double)k * (1.0 + 1e-9) / 20.5 + 1e-3, 1); /* for rounding */
    TEST_ASSERT_EQUAL(HCI_OK, fit(100, 8, 1));
    TEST_ASSERT_EQUAL(1, average.turns_each);
    TEST_ASSERT_EQUAL(8, average.highest);
    TEST_ASSERT_EQUAL(HCI_OK, fit(100, 9, 1));
    TEST_ASSERT_EQUAL(2, average.turns_each);
    TEST_ASSERT_EQUAL(16, average.highest);
    TEST_ASSERT_EQUAL(6, average.count);
    check_pass(3, 1, 1);
    TEST_ASSERT_EQUAL(HCI_OK, fit(100, 40, 1)); /* four turns have the same angles once more */
    TEST_ASSERT_EQUAL(2, average.turns_each);
}

/* Samples in no order, or movements to and fro that go round only together, are one pass. */
static void test_samples_in_no_order(void)
{
    for (size_t k = 0; k < 41; ++k)
        add(2.0 * REF_PI * (double)(k * 17 % 41) / 41.0, 1);
    TEST_ASSERT_EQUAL(HCI_OK, fit(ORDERS, ORDERS, 1));
    TEST_ASSERT_EQUAL(1, average.count);
    check_pass(0, 0, 1);
    TEST_ASSERT_EQUAL(41, average.pass[0].count);
    count = 0;
    go(0.0, 4.0, 40.0, 1);
    go(4.0, -2.5, 40.0, 1);
    TEST_ASSERT_EQUAL(HCI_OK, fit(ORDERS, ORDERS, 4));
    TEST_ASSERT_EQUAL(0, average.pass[average.count - 1].direction == 0 ? 0 : average.pass[0].count < 3);
    for (size_t k = 0; k < average.count; ++k)
        check_pass(k, average.pass[k].direction, 1);
}

/* Half a turn tells nothing, nor do two samples. */
static void test_what_tells_no_orders(void)
{
    go(0.0, 3.0, 40.0, 1);
    TEST_ASSERT_EQUAL(HCI_ERROR_SINGULAR, fit(ORDERS, ORDERS, 1));
    count = 2;
    TEST_ASSERT_EQUAL(HCI_ERROR_SINGULAR, fit(ORDERS, ORDERS, 1));
    TEST_ASSERT_EQUAL(0, average.count);
}

/* Many samples in a cell are one mean, at their mean angle: of 2π/64 of the highest order, 4e-4 of its size.
 */
static void test_many_samples(void)
{
    go(0.0, 2.0 * REF_PI * 1.02, 1500.0, 1);
    TEST_ASSERT_EQUAL(HCI_OK, fit(ORDERS, ORDERS, 1));
    for (size_t n = 1; n <= ORDERS; ++n) {
        const hci_average_harmonic w = made(1, n), *found = hci_average_at(&average, 0, 0, n);
        const double size = hypot(w.sine, w.cosine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3 * size, w.sine, found->sine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3 * size, w.cosine, found->cosine);
    }
}

/* ---- what no polynomial describes ---- */

enum { LOW = 3, WAVES = 2 * LOW + 1 };

/* Least squares of `n` means at ascending angles of one turn, each with the weight of half the way between
 * its neighbours, by Gauss and Jordan: S_1, C_1, S_2, …, and the mean last. */
static void weighted_fit(const double *at, const double *value_of, size_t n, double out[WAVES])
{
    double a[WAVES][WAVES + 1] = {{0.0}};
    for (size_t k = 0; k < n; ++k) {
        const double before = k > 0 ? at[k - 1] : at[n - 1] - 2.0 * REF_PI,
                     after = k + 1 < n ? at[k + 1] : at[0] + 2.0 * REF_PI;
        double row[WAVES + 1] = {0.0};
        for (int m = 1; m <= LOW; ++m)
            row[2 * m - 2] = sin(m * at[k]), row[2 * m - 1] = cos(m * at[k]);
        row[WAVES - 1] = 1.0;
        row[WAVES] = value_of[k];
        for (int i = 0; i < WAVES; ++i)
            for (int j = 0; j <= WAVES; ++j)
                a[i][j] += (after - before) * row[i] * row[j];
    }
    ref_reduce(&a[0][0], WAVES, WAVES + 1, WAVES + 1);
    for (int i = 0; i < WAVES; ++i)
        out[i] = a[i][WAVES];
}

/* Noise of one turn forward or backward, of which two neighbours in a cell are one: their mean, at their mean
 * angle. Cells are a 64th of the highest order that is asked for, and the mean. */
static void test_noise_is_fitted_by_weights(void)
{
    enum { N = 60 };
    uint64_t seed = 6;
    for (int direction = -1; direction <= 1; direction += 2) {
        double at[N], mean_of[N], fitted[WAVES];
        const double cell = 2.0 * REF_PI / (64.0 * (LOW + 1));
        count = 0;
        for (size_t k = 0; k < N; ++k) {
            const size_t row = direction > 0 ? k : N - 1 - k;
            at[k] = cell * (floor(4.2 * (double)k + ref_uniform(&seed, 0.0, 1.6)) + 0.5);
            mean_of[k] = ref_normal(&seed);
            angle[row] = at[k] + 4.0 * REF_PI * direction;
            value[CHANNELS * row] = 2.0;
            value[CHANNELS * row + 1] = mean_of[k];
        }
        count = N;
        if (direction > 0) { /* the last of them twice, apart by less than its cell */
            angle[N - 1] -= 0.2 * cell;
            angle[N] = angle[N - 1] + 0.5 * cell;
            value[CHANNELS * N] = 2.0;
            value[CHANNELS * N + 1] = mean_of[N - 1] + 3.0;
            at[N - 1] += 0.05 * cell;
            mean_of[N - 1] += 1.5;
            ++count;
        }
        weighted_fit(at, mean_of, N, fitted);
        TEST_ASSERT_EQUAL(HCI_OK, fit(LOW, LOW, LOW));
        TEST_ASSERT_EQUAL(1, average.count);
        TEST_ASSERT_EQUAL(direction, average.pass[0].direction);
        for (size_t m = 0; m <= LOW; ++m) {
            const hci_average_harmonic *found = hci_average_at(&average, 0, 1, m);
            TEST_ASSERT_DOUBLE_WITHIN(1e-7, m > 0 ? fitted[2 * m - 2] : 0.0, found->sine);
            TEST_ASSERT_DOUBLE_WITHIN(1e-7, m > 0 ? fitted[2 * m - 1] : fitted[WAVES - 1], found->cosine);
        }
    }
}

static void test_memory_that_is_short(void)
{
    go(0.0, 13.0, 40.0, 1);
    long k = 0;
    for (;; ++k) {
        hci_memory_fail_after(k);
        const hci_status status = fit(ORDERS, ORDERS, 1);
        hci_memory_fail_after(-1);
        if (status == HCI_OK) break;
        TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY, status);
        TEST_ASSERT_NULL(average.wave);
    }
    TEST_ASSERT_TRUE(k >= 8);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_turns_of_both_ways);
    RUN_TEST(test_flicker);
    RUN_TEST(test_orders_that_samples_bear);
    RUN_TEST(test_turns_together);
    RUN_TEST(test_samples_in_no_order);
    RUN_TEST(test_what_tells_no_orders);
    RUN_TEST(test_many_samples);
    RUN_TEST(test_noise_is_fitted_by_weights);
    RUN_TEST(test_memory_that_is_short);
    return UNITY_END();
}
