/* Which loads lie on a curve in the rotor frame, and its direction at a torque. */
#include "hci/host/waveform/load_curve.h"

#include <math.h>
#include <string.h>

#include "support/reference.h"
#include "unity.h"

static hci_load load[6];
static size_t count;

void setUp(void)
{
    count = 0;
}

void tearDown(void)
{
}

/* i_d = -I sin β, i_q = I cos β. */
static void add(double length_A, double angle_deg, double torque_Nm)
{
    const double b = angle_deg * REF_PI / 180.0;
    load[count++] = (hci_load){-length_A * sin(b), length_A * cos(b), torque_Nm};
}

static bool is_curve(void)
{
    return hci_loads_are_on_curve(load, count);
}

static double angle_deg_at(double torque_Nm)
{
    return hci_load_curve_angle_rad(load, count, torque_Nm) * 180.0 / REF_PI;
}

static void test_the_shortest_current_of_each_torque(void)
{
    add(80.0, 31.7, 45.0);
    add(29.7, 19.7, 14.0);
    add(59.9, 27.8, 31.0);
    TEST_ASSERT_TRUE(is_curve());
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 29.7, hypot(load[0].id_A, load[0].iq_A)); /* sorted */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 19.7, angle_deg_at(5.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 19.7, angle_deg_at(14.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 19.7 + 8.1 * 8.5 / 17.0, angle_deg_at(22.5));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 27.8, angle_deg_at(31.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 27.8 + 3.9 * 7.0 / 14.0, angle_deg_at(-38.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 31.7, angle_deg_at(100.0));
}

static void test_two_at_least(void)
{
    TEST_ASSERT_FALSE(is_curve());
    add(10.0, 5.0, 1.0);
    TEST_ASSERT_FALSE(is_curve());
    add(20.0, 5.0, 2.0);
    TEST_ASSERT_TRUE(is_curve());
}

/* The opposite current has the same direction, one mirrored at the d axis has not. */
static void test_opposite_currents(void)
{
    add(10.0, 25.0, 1.0);
    add(-10.2, 25.0, -1.0);
    TEST_ASSERT_TRUE(is_curve());
    add(10.4, 180.0 - 25.0, -1.0);
    TEST_ASSERT_FALSE(is_curve());
}

static void test_how_far_directions_may_go(void)
{
    static const struct {
        double length_A, angle_deg;
        bool is_curve;
    } NEXT[] = {{10.9, 12.9, true},  {10.9, 13.1, false}, {10.9, 7.1, true},
                {10.9, 6.9, false},  {11.1, 13.1, true},  {11.1, 29.9, true},
                {11.1, 30.1, false}, {11.1, -9.9, true},  {11.1, -10.1, false}};
    for (size_t k = 0; k < sizeof NEXT / sizeof *NEXT; ++k) {
        setUp();
        add(10.0, 10.0, 1.0);
        add(NEXT[k].length_A, NEXT[k].angle_deg, 2.0);
        TEST_ASSERT_EQUAL(NEXT[k].is_curve, is_curve());
    }
}

static void test_no_further_than_sixty_degrees(void)
{
    for (int k = 0; k < 4; ++k) {
        const double sign = k % 2 ? -1.0 : 1.0;
        setUp();
        add(10.0, sign * (k < 2 ? 59.0 : 61.0), 1.0);
        add(20.0, sign * 55.0, 1.0);
        TEST_ASSERT_EQUAL(k < 2, is_curve());
        setUp();
        add(10.0, sign * 55.0, 1.0);
        add(20.0, sign * (k < 2 ? 59.0 : 61.0), 1.0);
        TEST_ASSERT_EQUAL(k < 2, is_curve());
    }
}

/* Forward and backward at one load: either will do. */
static void test_two_of_one_torque(void)
{
    add(60.0, 27.0, 31.0);
    add(60.1, 28.0, 31.0);
    TEST_ASSERT_TRUE(is_curve());
    TEST_ASSERT_DOUBLE_WITHIN(1.0, 27.5, angle_deg_at(31.0));
    TEST_ASSERT_DOUBLE_WITHIN(1.0, 27.5, angle_deg_at(10.0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_shortest_current_of_each_torque);
    RUN_TEST(test_two_at_least);
    RUN_TEST(test_opposite_currents);
    RUN_TEST(test_how_far_directions_may_go);
    RUN_TEST(test_no_further_than_sixty_degrees);
    RUN_TEST(test_two_of_one_torque);
    return UNITY_END();
}
