/* Whether a holding test is among the runs that are used. */
#include "host/diagnose/attribute/attribute.c"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static bool held(bool first_in_use, hci_torque_source first, bool second_in_use, hci_torque_source second)
{
    const hci_run run[2] = {{.torque_source = first}, {.torque_source = second}};
    const bool use[2] = {first_in_use, second_in_use};
    const hci_binned_samples samples = {.run_count = 2};
    const hci_regression regression = {.samples = &samples, .runs = run, .use = use};
    return any_is_held(&regression);
}

static void test_holding_tests_that_are_used(void)
{
    const hci_torque_source measured = HCI_TORQUE_MEASURED, holding = HCI_TORQUE_HOLDING;
    TEST_ASSERT_TRUE(held(true, measured, true, holding) && held(true, holding, false, measured));
    TEST_ASSERT_FALSE(held(true, measured, true, measured));
    TEST_ASSERT_FALSE(held(true, measured, false, holding) || held(false, holding, false, holding));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_holding_tests_that_are_used);
    return UNITY_END();
}
