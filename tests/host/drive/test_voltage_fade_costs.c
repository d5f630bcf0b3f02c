/* What a choice of orders costs at a speed, and which numbers of orders are tried. */
#include "host/drive/voltage_fade.c"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static double cost(double mean_Nm, double ripple_Nm, double wanted_Nm)
{
    const hci_sampled_torque torque = {.mean_Nm = mean_Nm, .ripple_Nm = ripple_Nm};
    return cost_of(&torque, wanted_Nm);
}

/* The ripple by the mean along what is wanted, of either sign and of any size; the ripple itself where
 * nothing is wanted; of no answer more than of any. */
static void test_what_a_torque_costs(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, log(0.1), cost(sign * 2.0, 0.2, sign * 2.0));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, log(0.2), cost(sign * 0.25, 0.05, sign * 0.25));
        TEST_ASSERT_TRUE(cost(-sign * 2.0, 0.2, sign * 2.0) > log(1.0)); /* it brakes */
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, log(0.2), cost(0.5, 0.2, 0.0));
    TEST_ASSERT_TRUE(isfinite(cost(0.5, 0.0, 0.0)));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, log(DBL_MAX), cost((double)NAN, 0.2, 1.0));
    TEST_ASSERT_TRUE(cost(1.0, 0.2, 1.0) < cost(1.0, 0.21, 1.0));
    TEST_ASSERT_TRUE(cost(1.0, 0.2, 1.0) < cost(0.9, 0.2, 1.0));
}

/* From all orders down to one, none twice while there are enough of them. */
static void test_how_many_orders_are_tried(void)
{
    static fade f;
    for (uint32_t orders = 1; orders < 40; ++orders) {
        set_choices(orders, &f);
        TEST_ASSERT_EQUAL_INT(orders < CHOICES ? (int)orders : CHOICES, f.choices);
        TEST_ASSERT_EQUAL_UINT32(orders, f.kept[0]);
        TEST_ASSERT_EQUAL_UINT32(1, f.kept[f.choices - 1]);
        for (int c = 1; c < f.choices; ++c)
            TEST_ASSERT_TRUE(f.kept[c] < f.kept[c - 1]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_a_torque_costs);
    RUN_TEST(test_how_many_orders_are_tried);
    return UNITY_END();
}
