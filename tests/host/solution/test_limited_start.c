/* Which component of a set the best sine is, where the torque is not linear in the current. */
#include "host/solution/limited.c"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_the_fundamental(void)
{
    TEST_ASSERT_TRUE(is_fundamental((hci_component){1.0, 1}));
    TEST_ASSERT_TRUE(is_fundamental((hci_component){1.0 + 0.5 * HCI_ORDER_TOLERANCE, 1}));
    TEST_ASSERT_TRUE(is_fundamental((hci_component){1.0 - 0.5 * HCI_ORDER_TOLERANCE, 1}));
    TEST_ASSERT_FALSE(is_fundamental((hci_component){1.0 + 2.0 * HCI_ORDER_TOLERANCE, 1}));
    TEST_ASSERT_FALSE(is_fundamental((hci_component){1.0 - 2.0 * HCI_ORDER_TOLERANCE, 1}));
    TEST_ASSERT_FALSE(is_fundamental((hci_component){1.0, -1}));
    TEST_ASSERT_FALSE(is_fundamental((hci_component){1.0, 0}));
    TEST_ASSERT_FALSE(is_fundamental((hci_component){0.0, 1}));
    TEST_ASSERT_FALSE(is_fundamental((hci_component){5.0, 1}));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_fundamental);
    return UNITY_END();
}
