/* Units that a column of frequencies may be in, by the factor that mends it. */
#include "host/drive/response_reading.c"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_each_unit_has_its_name(void)
{
    TEST_ASSERT_EQUAL_STRING("rad/s", unit_of(0.5 / HCI_PI));
    TEST_ASSERT_EQUAL_STRING("turns for rad", unit_of(2.0 * HCI_PI));
    TEST_ASSERT_EQUAL_STRING("kHz", unit_of(1000.0));
    TEST_ASSERT_EQUAL_STRING("1/min", unit_of(1.0 / 60.0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_unit_has_its_name);
    return UNITY_END();
}
