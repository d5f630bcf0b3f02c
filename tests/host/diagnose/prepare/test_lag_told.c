/* Which recordings tell how slow a torque sensor is. */
#include "host/diagnose/prepare/lag_told.h"

#include <math.h>

#include "unity.h"

enum { RUNS = 3 };

static double time_s[2] = {0.0, 1.0};
static hci_wave back_emf[2] = {{1.0, 1, 0.2, 0.0}, {5.0, -1, 0.01, 0.0}};
static hci_harmonic cogging = {6.0, 0.05, 0.0};
static hci_machine machine;
static hci_run run[RUNS];
static hci_run_statistics statistics[RUNS];
static bool use[RUNS];

/* No load, 3 A and 6 A at one speed, measured in time; noise of the currents. */
void setUp(void)
{
    back_emf[1].sine = 0.01;
    cogging.sine = 0.05;
    machine = (hci_machine){.pole_pairs = 5, .back_emf = back_emf, .back_emf_count = 1};
    for (int r = 0; r < RUNS; ++r) {
        run[r] = (hci_run){.torque_source = HCI_TORQUE_MEASURED, .time_s = time_s, .count = 2};
        statistics[r] = (hci_run_statistics){.mean_speed_rad_per_s = 2.0,
                                             .speed_deviation = 0.02,
                                             .mean_iq_A = 3.0 * r,
                                             .current_A = hypot(3.0 * r, 0.05)};
        use[r] = true;
    }
}

void tearDown(void)
{
}

static bool is_told(void)
{
    return hci_lag_is_told(&machine, run, statistics, use, RUNS);
}

static void test_not_at_one_speed(void)
{
    TEST_ASSERT_FALSE(is_told());
    statistics[1].mean_speed_rad_per_s = 2.2;
    TEST_ASSERT_FALSE(is_told());
    for (int r = 0; r < RUNS; ++r)
        statistics[r].mean_speed_rad_per_s = -2.0;
    TEST_ASSERT_FALSE(is_told());
}

static void test_by_another_speed(void)
{
    statistics[1].mean_speed_rad_per_s = 3.0;
    TEST_ASSERT_TRUE(is_told());
    statistics[1].mean_speed_rad_per_s = -2.0;
    TEST_ASSERT_TRUE(is_told());
    statistics[1].mean_speed_rad_per_s = 0.0;
    TEST_ASSERT_TRUE(is_told());
}

static void test_by_a_ramp(void)
{
    statistics[1].speed_deviation = 0.5;
    TEST_ASSERT_TRUE(is_told());
}

static void test_not_by_a_run_that_is_not_used(void)
{
    statistics[1].mean_speed_rad_per_s = 3.0;
    use[1] = false;
    TEST_ASSERT_FALSE(is_told());
}

/* Nor by one of another source, which that sensor has not read, or without time. */
static void test_not_by_what_no_sensor_read_in_time(void)
{
    statistics[1].mean_speed_rad_per_s = 3.0;
    run[1].torque_source = HCI_TORQUE_INERTIA;
    TEST_ASSERT_FALSE(is_told());
    run[1].torque_source = HCI_TORQUE_MEASURED;
    run[1].time_s = NULL;
    TEST_ASSERT_FALSE(is_told());
    use[0] = use[2] = false;
    TEST_ASSERT_FALSE(is_told());
}

/* Of the runs without a current alone all that is read is noise. */
static void test_not_by_the_noise_of_no_current(void)
{
    use[1] = use[2] = false;
    TEST_ASSERT_FALSE(is_told());
    statistics[1].current_A = statistics[2].current_A = 0.0;
    statistics[0].zeros_read = true;
    TEST_ASSERT_FALSE(is_told());
}

/* Steps between 3 and 5 A make a torque that is known; the noise of the currents does not. */
static void test_by_a_current_that_varies(void)
{
    statistics[1].mean_iq_A = 4.0;
    statistics[1].current_A = hypot(4.0, 1.0);
    TEST_ASSERT_TRUE(is_told());
}

static void test_by_a_ripple_that_is_declared(void)
{
    machine.back_emf_count = 2;
    TEST_ASSERT_TRUE(is_told());
    back_emf[1].sine = 0.0; /* an order alone */
    TEST_ASSERT_FALSE(is_told());
    machine.cogging = &cogging;
    machine.cogging_count = 1;
    TEST_ASSERT_TRUE(is_told());
    cogging.sine = 0.0;
    TEST_ASSERT_FALSE(is_told());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_not_at_one_speed);
    RUN_TEST(test_by_another_speed);
    RUN_TEST(test_by_a_ramp);
    RUN_TEST(test_not_by_a_run_that_is_not_used);
    RUN_TEST(test_not_by_what_no_sensor_read_in_time);
    RUN_TEST(test_not_by_the_noise_of_no_current);
    RUN_TEST(test_by_a_current_that_varies);
    RUN_TEST(test_by_a_ripple_that_is_declared);
    return UNITY_END();
}
