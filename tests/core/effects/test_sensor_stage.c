/* A resonance that swings by itself, y = cos ωt, against its closed form: how far its phase is behind after
 * ten periods. */
#include "core/effects/sensor_stage.h"

#include <math.h>

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* Phase that is lacking after ten periods, in parts of the steps of so many radians. */
static double phase_behind_rad(double step_rad)
{
    const double omega = 2.0 * 3.14159265358979 * 200.0, periods_rad = 20.0 * 3.14159265358979;
    const hci_sensor_stage stage = {omega, 0.0, 0.0};
    const size_t steps = (size_t)(periods_rad / step_rad), parts = hci_stage_parts(&stage, step_rad / omega);
    hci_stage_state state = {0.0, 1.0, 0.0};
    for (size_t k = 0; k < steps * parts; ++k)
        hci_stage_step(&stage, &state, step_rad / omega / (double)parts, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0, hypot(state.y, state.v / omega)); /* trapezoids keep the energy */
    return fabs(
        remainder((double)steps * step_rad - atan2(-state.v / omega, state.y), 2.0 * 3.14159265358979));
}

/* Parts of 0.04 rad swing 0.04²/12 too slowly; twelve of them do for samples at a thirteenth of the period.
 */
static void test_a_resonance_keeps_its_frequency(void)
{
    static const double STEP_RAD[] = {0.05, 0.2, 0.44, 0.48};
    for (size_t k = 0; k < 4; ++k)
        TEST_ASSERT_TRUE(phase_behind_rad(STEP_RAD[k]) < 20.0 * 3.14159265358979 * 0.0401 * 0.0401 / 12.0);
}

static void test_parts_of_a_step(void)
{
    const hci_sensor_stage lag = {0.0, 0.0, 1e-3}, resonance = {1000.0, 0.1, 0.0};
    TEST_ASSERT_EQUAL_UINT64(4, hci_stage_parts(&lag, 1e-6));
    TEST_ASSERT_EQUAL_UINT64(6, hci_stage_parts(&lag, 0.21e-3));
    TEST_ASSERT_EQUAL_UINT64(6, hci_stage_parts(&resonance, 0.21e-3));
    TEST_ASSERT_EQUAL_UINT64(12, hci_stage_parts(&resonance, 1.0));
}

/* Many stages side by side are each of them alone, where steps are so short that all take as many parts of
 * them; a step back in time, and steps of two lengths. */
static void check_many(const hci_sensor_stage stage[HCI_EFFECT_SENSORS])
{
    enum { N = 400 };
    static double time_s[N], torque_Nm[N], alone[N], many[N * HCI_EFFECT_SENSORS];
    for (int k = 0; k < N; ++k) {
        time_s[k] = (k % 7 == 3 ? 1.7e-6 : 1e-6) + (k > 0 && k != 200 ? time_s[k - 1] : 0.0);
        torque_Nm[k] = sin(0.05 * k) + (k > 90 ? 0.5 : 0.0);
    }
    const hci_effect_run run = {.time_s = time_s, .count = N, .torque_Nm = torque_Nm};
    hci_stage_filter_many(stage, &run, many);
    for (int j = 0; j < HCI_EFFECT_SENSORS; ++j) {
        TEST_ASSERT_EQUAL_UINT64(hci_stage_parts(&stage[0], 1e-6), hci_stage_parts(&stage[j], 1e-6));
        for (int k = 0; k < N; ++k)
            alone[k] = torque_Nm[k];
        hci_stage_filter(&stage[j], &run, alone, 1, 1);
        for (int k = 0; k < N; ++k)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, alone[k], many[k * HCI_EFFECT_SENSORS + j]);
    }
}

static void test_many_stages_are_each_alone(void)
{
    hci_sensor_stage lag[HCI_EFFECT_SENSORS], resonance[HCI_EFFECT_SENSORS], slow[HCI_EFFECT_SENSORS];
    for (int j = 0; j < HCI_EFFECT_SENSORS; ++j) {
        lag[j] = (hci_sensor_stage){0.0, 0.0, 1e-4 * (j + 1)};
        resonance[j] = (hci_sensor_stage){1000.0 * (j + 1), 0.1 * j, 0.0};
        slow[j] = (hci_sensor_stage){0.01 * (j + 1), 0.1 * j, 0.0};
    }
    check_many(lag);
    check_many(resonance);
    check_many(slow);
}

/* Even where two steps before and one behind are as long; the last sample has none behind it. */
static void test_where_samples_are_even(void)
{
    static const double TIME_S[] = {0.0, 1.0, 2.0, 3.0, 4.5};
    static const bool EVEN[] = {false, false, true, false, false};
    for (size_t k = 0; k < 5; ++k) {
        TEST_ASSERT_EQUAL_INT(EVEN[k], hci_stage_is_even(TIME_S, 5, k));
        TEST_ASSERT_EQUAL_INT(k == 2, hci_stage_is_even(TIME_S, 4, k));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_resonance_keeps_its_frequency);
    RUN_TEST(test_parts_of_a_step);
    RUN_TEST(test_many_stages_are_each_alone);
    RUN_TEST(test_where_samples_are_even);
    return UNITY_END();
}
