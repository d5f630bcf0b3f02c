/* Polynomials of each turn, found again from samples at uneven angles: which turns there are, how many orders
 * they bear, and waves that differ from turn to turn. */
#include "host/numeric/synchronous_average.h"

#include <math.h>

#include "host/base/memory.h"
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
    RUN_TEST(test_memory_that_is_short);
    return UNITY_END();
}
