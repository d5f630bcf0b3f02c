/* Torques that a loop's table is asked for: any number, 0 too, and none where the levels have it. */
#include <math.h>

#include "hci/loop.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static int asked(float low_Nm, float high_Nm, float torque_Nm)
{
    const hci_loop_f32 loop = {.torque_low_Nm = low_Nm, .torque_high_Nm = high_Nm};
    return hci_loop_is_asked(&loop, torque_Nm);
}

static void test_numbers_are_asked_for(void)
{
    const float torque_Nm[] = {-2.0f, 0.0f, -0.0f, 1e-30f, 3.0f, INFINITY, -INFINITY};
    for (unsigned k = 0; k < sizeof torque_Nm / sizeof *torque_Nm; ++k) {
        TEST_ASSERT_TRUE(asked(1.0f, 2.0f, torque_Nm[k]));
        TEST_ASSERT_TRUE(asked(-2.0f, -1.0f, torque_Nm[k]));
        TEST_ASSERT_TRUE(asked(-1.0f, 1.0f, torque_Nm[k]));
    }
}

static void test_no_number_is_none(void)
{
    TEST_ASSERT_FALSE(asked(1.0f, 2.0f, NAN) || asked(-2.0f, -1.0f, NAN));
    TEST_ASSERT_TRUE(asked(-1.0f, 1.0f, NAN) && asked(0.0f, 1.0f, NAN) && asked(-1.0f, 0.0f, NAN));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_numbers_are_asked_for);
    RUN_TEST(test_no_number_is_none);
    return UNITY_END();
}
