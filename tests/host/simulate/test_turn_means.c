/* Means over the angle of an electrical turn: which step an angle is of, and sums of several steps. */
#include "host/simulate/turn_means.h"

#include <math.h>

#include "unity.h"

static const double PI = 3.14159265358979323846;
static hci_turn_means turn;

void setUp(void)
{
    hci_turn_means_begin(&turn);
}

void tearDown(void)
{
}

static void add_at(double degrees, double torque_Nm)
{
    hci_turn_means_add(&turn, degrees * PI / 180.0, torque_Nm, (hci_dq){-torque_Nm, 2.0 * torque_Nm, 0.0});
}

/* A step is a degree; angles of any turn, of either sign; the end of the last step is no further one. */
static void test_which_step_it_is(void)
{
    static const struct {
        double degrees;
        size_t step;
    } CASE[] = {{0.5, 0},    {1.5, 1},    {359.5, 359},        {360.5, 0},
                {-0.5, 359}, {-359.5, 0}, {3600.0 + 77.5, 77}, {-1e-17, 359}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        hci_turn_means_begin(&turn);
        add_at(CASE[k].degrees, 2.0);
        for (size_t step = 0; step < HCI_TURN_STEPS; ++step)
            TEST_ASSERT_EQUAL(step == CASE[k].step, hci_turn_mean_of(&turn, step, 1).samples);
    }
    hci_turn_means_begin(&turn);
    add_at(NAN, 2.0);
    add_at(INFINITY, 2.0);
    TEST_ASSERT_EQUAL(0, hci_turn_mean_of(&turn, 0, HCI_TURN_STEPS).samples);
}

static void test_means_and_ranges(void)
{
    add_at(10.2, 1.0);
    add_at(370.7, 4.0);
    add_at(11.5, -2.0);
    add_at(359.5, 9.0);
    hci_turn_mean m = hci_turn_mean_of(&turn, 10, 1);
    TEST_ASSERT_EQUAL(2, m.samples);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.5, m.torque_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -2.5, m.current_A.d);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.0, m.current_A.q);
    TEST_ASSERT_TRUE(m.torque_range_Nm.low == 1.0 && m.torque_range_Nm.high == 4.0);
    m = hci_turn_mean_of(&turn, 9, 3);
    TEST_ASSERT_EQUAL(3, m.samples);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, m.torque_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -1.0, m.current_A.d);
    TEST_ASSERT_TRUE(m.torque_range_Nm.low == -2.0 && m.torque_range_Nm.high == 4.0);
    m = hci_turn_mean_of(&turn, 358, 10); /* no further than the turn */
    TEST_ASSERT_EQUAL(1, m.samples);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 9.0, m.torque_Nm);
    m = hci_turn_mean_of(&turn, 100, 10);
    TEST_ASSERT_TRUE(m.samples == 0 && m.torque_Nm == 0.0 && m.torque_range_Nm.low > m.torque_range_Nm.high);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_which_step_it_is);
    RUN_TEST(test_means_and_ranges);
    return UNITY_END();
}
