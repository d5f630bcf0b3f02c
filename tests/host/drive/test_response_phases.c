/* Phases of a measured response that no loop has: degrees for radians, the wrong sign, half a turn on. */
#include "host/drive/response_file.c"

#include "unity.h"

static hci_loop_point point[3];

void setUp(void)
{
    for (int k = 0; k < 3; ++k)
        point[k] = (hci_loop_point){10.0 * (k + 1), {1.0, 1.0}, {-0.1, -0.1}};
}

void tearDown(void)
{
}

/* Half a period of lateness, of either axis and sign, where the gain is above 0.7. */
static void test_degrees(void)
{
    for (int axis = 0; axis < 2; ++axis)
        for (int sign = -1; sign <= 1; sign += 2) {
            setUp();
            TEST_ASSERT_FALSE(is_of_degrees(&point[0], axis));
            point[0].phase_rad[axis] = sign * 3.15;
            TEST_ASSERT_TRUE(is_of_degrees(&point[0], axis));
            TEST_ASSERT_FALSE(is_of_degrees(&point[0], 1 - axis));
            point[0].phase_rad[axis] = sign * 3.13;
            TEST_ASSERT_FALSE(is_of_degrees(&point[0], axis));
            point[0].phase_rad[axis] = sign * 30.0;
            point[0].gain[axis] = 0.69;
            TEST_ASSERT_FALSE(is_of_degrees(&point[0], axis));
            point[0].gain[axis] = 0.71;
            TEST_ASSERT_TRUE(is_of_degrees(&point[0], axis));
        }
}

/* No phase below 0, and one above a tenth of half a turn, wherever it is. */
static void test_a_current_that_is_early(void)
{
    TEST_ASSERT_FALSE(is_early(point, 3, 0));
    for (int k = 0; k < 3; ++k)
        for (int more = 0; more < 2; ++more) {
            for (int j = 0; j < 3; ++j)
                point[j].phase_rad[1] = 0.0;
            point[k].phase_rad[1] = more ? 0.315 : 0.313;
            TEST_ASSERT_EQUAL(more, is_early(point, 3, 1));
            point[(k + 1) % 3].phase_rad[1] = -1e-3;
            TEST_ASSERT_FALSE(is_early(point, 3, 1));
        }
}

/* The first point half a turn on within half a radian, and none beyond two turns. */
static void test_half_a_turn_on(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        setUp();
        point[0].phase_rad[0] = sign * 3.63;
        TEST_ASSERT_TRUE(is_half_a_turn_on(point, 3, 0));
        TEST_ASSERT_EQUAL_STRING(HALF_TURN, remedy_of_phases(point, 3, 0));
        TEST_ASSERT_FALSE(is_half_a_turn_on(point, 3, 1));
        point[0].phase_rad[0] = sign * 3.65;
        TEST_ASSERT_FALSE(is_half_a_turn_on(point, 3, 0));
        point[0].phase_rad[0] = sign * 2.65;
        TEST_ASSERT_TRUE(is_half_a_turn_on(point, 3, 0));
        point[0].phase_rad[0] = sign * 2.63;
        TEST_ASSERT_FALSE(is_half_a_turn_on(point, 3, 0));
        point[0].phase_rad[0] = sign * 3.2;
        point[2].phase_rad[0] = -12.5;
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 12.5, largest_phase_rad(point, 3, 0));
        TEST_ASSERT_TRUE(is_half_a_turn_on(point, 3, 0));
        point[2].phase_rad[0] = 12.6;
        TEST_ASSERT_FALSE(is_half_a_turn_on(point, 3, 0));
    }
    TEST_ASSERT_EQUAL_STRING("degrees are in a column `phase_d_deg`, which is converted",
                             remedy_of_phases(point, 3, 0));
    TEST_ASSERT_EQUAL_STRING("degrees are in a column `phase_q_deg`, which is converted",
                             remedy_of_phases(point, 3, 1));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_degrees);
    RUN_TEST(test_a_current_that_is_early);
    RUN_TEST(test_half_a_turn_on);
    return UNITY_END();
}
