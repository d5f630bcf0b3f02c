/* What is asked for is not in the list already. */
#include <math.h>

#include "host/diagnose/next/operating_points.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static hci_run_statistics steady(double id_A, double iq_A, double speed_rad_per_s, double turns)
{
    return (hci_run_statistics){.mean_id_A = id_A,
                                .mean_iq_A = iq_A,
                                .current_A = hypot(id_A, iq_A),
                                .mean_speed_rad_per_s = speed_rad_per_s,
                                .turns = turns};
}

static size_t points_beside(const hci_run_statistics *recorded, const bool *use, size_t count,
                            hci_operating_point point[HCI_OPERATING_POINTS])
{
    const hci_playable playable = {.source = HCI_TORQUE_MEASURED,
                                   .most_A = 8.0,
                                   .least_rad_per_s = 6.28,
                                   .most_rad_per_s = 25.0,
                                   .most_V = INFINITY,
                                   .recorded = recorded,
                                   .use = use,
                                   .recorded_count = count};
    return hci_operating_points(&playable, point);
}

static bool has(const hci_operating_point *point, size_t count, double iq_A, double speed_rad_per_s)
{
    for (size_t k = 0; k < count; ++k)
        if (point[k].id_A == 0.0 && point[k].iq_A == iq_A && point[k].speed_rad_per_s == speed_rad_per_s)
            return true;
    return false;
}

static void test_recorded_points_are_not_asked_for(void)
{
    /* two with the noise of sensors, one that is short, one held out, one whose current swings */
    hci_run_statistics run[] = {steady(0.01, -0.02, 6.3, 11.98), steady(0.0, 0.0, -6.2, 12.0),
                                steady(0.0, 2.0, 6.28, 4.0), steady(0.0, 4.0, 6.28, 20.0),
                                steady(0.0, 8.0, 6.28, 20.0)};
    const bool use[] = {true, true, true, false, true};
    run[4].current_A = 10.0;
    hci_operating_point point[HCI_OPERATING_POINTS], all[HCI_OPERATING_POINTS];
    const size_t whole = points_beside(NULL, NULL, 0, all), left = points_beside(run, use, 5, point);
    TEST_ASSERT_TRUE(has(all, whole, 0.0, 6.28) && has(all, whole, 0.0, -6.28));
    TEST_ASSERT_EQUAL_UINT64(whole - 2, left);
    TEST_ASSERT_FALSE(has(point, left, 0.0, 6.28) || has(point, left, 0.0, -6.28));
    TEST_ASSERT_TRUE(has(point, left, 0.0, 25.0) && has(point, left, 2.0, 6.28) &&
                     has(point, left, 4.0, 6.28));
    TEST_ASSERT_TRUE(has(point, left, 8.0, 6.28));
}

static void test_something_is_left_where_all_is_recorded(void)
{
    hci_operating_point all[HCI_OPERATING_POINTS], point[HCI_OPERATING_POINTS];
    hci_run_statistics run[HCI_OPERATING_POINTS];
    bool use[HCI_OPERATING_POINTS];
    const size_t whole = points_beside(NULL, NULL, 0, all);
    for (size_t k = 0; k < whole; ++k) {
        run[k] = steady(all[k].id_A, all[k].iq_A, all[k].speed_rad_per_s, 12.0);
        use[k] = true;
    }
    TEST_ASSERT_EQUAL_UINT64(whole, points_beside(run, use, whole, point));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_recorded_points_are_not_asked_for);
    RUN_TEST(test_something_is_left_where_all_is_recorded);
    return UNITY_END();
}
