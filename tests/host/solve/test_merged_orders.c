/* Orders of components that come one after the other are each there once, and none that stands behind them.
 */
#include "host/solve/harmonic_system.c"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_each_order_once(void)
{
    double order[] = {0.0, 6.0, 12.0, 12.0, 18.0, 6.0, 3.0, 99.0};
    const double expected[] = {0.0, 3.0, 6.0, 12.0, 18.0};
    TEST_ASSERT_EQUAL_UINT64(5, merge_orders(order, 3, 4));
    for (int k = 0; k < 5; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(expected[k], order[k]);
}

static void test_nothing_more(void)
{
    double order[] = {0.0, 6.0, 99.0};
    TEST_ASSERT_EQUAL_UINT64(2, merge_orders(order, 2, 0));
    TEST_ASSERT_EQUAL_DOUBLE(6.0, order[1]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_order_once);
    RUN_TEST(test_nothing_more);
    return UNITY_END();
}
