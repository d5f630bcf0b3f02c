/* What logs have already: loads by their direction and size, and a slow turn without one. */
#include "cli/tune/tune_known.h"

#include <math.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "unity.h"

enum { SAMPLES = 200, MOST = 6, POLE_PAIRS = 3 };

static cli_tuning tune;
static hci_run run[MOST];
static double angle[MOST][SAMPLES], current[MOST][3 * SAMPLES];

void setUp(void)
{
    memset(&tune, 0, sizeof tune);
    memset(run, 0, sizeof run);
    tune.runs.run = run;
}

void tearDown(void)
{
}

/* A turn with these currents. */
static void record(hci_torque_source source, double id_A, double iq_A)
{
    const size_t n = tune.runs.count++;
    run[n].theta_m_rad = angle[n];
    run[n].i_A = current[n];
    run[n].count = SAMPLES;
    run[n].pole_pairs = POLE_PAIRS;
    run[n].torque_source = source;
    for (size_t k = 0; k < SAMPLES; ++k) {
        const hci_dq i = {id_A, iq_A, 0.0};
        angle[n][k] = 2.0 * 3.14159265358979 * (double)k / SAMPLES;
        hci_clarke_inverse(hci_park_inverse(i, POLE_PAIRS * angle[n][k]), current[n] + 3 * k);
    }
}

static void test_loads_by_their_direction(void)
{
    record(HCI_TORQUE_MEASURED, 0.0, 0.0);
    TEST_ASSERT_FALSE(cli_tune_has_load_along_q(&tune));
    record(HCI_TORQUE_MEASURED, 0.6, 10.0); /* 3.4 degrees */
    record(HCI_TORQUE_HOLDING, 0.0, 10.0);  /* no sensor */
    TEST_ASSERT_FALSE(cli_tune_has_load_along_q(&tune));
    record(HCI_TORQUE_MEASURED, 0.4, -10.0);
    TEST_ASSERT_TRUE(cli_tune_has_load_along_q(&tune));
    TEST_ASSERT_FALSE(cli_tune_has_both_id(&tune));
    record(HCI_TORQUE_MEASURED, 3.0, 10.0);
    TEST_ASSERT_FALSE(cli_tune_has_both_id(&tune));
    record(HCI_TORQUE_MEASURED, -3.0, -10.0);
    TEST_ASSERT_TRUE(cli_tune_has_both_id(&tune));
}

static void test_loads_by_their_size(void)
{
    record(HCI_TORQUE_MEASURED, 0.0, 0.0);
    record(HCI_TORQUE_MEASURED, 0.0, 10.0);
    record(HCI_TORQUE_MEASURED, 6.6, -8.8); /* 11 A */
    TEST_ASSERT_EQUAL_UINT64(1, cli_tune_load_sizes(&tune));
    record(HCI_TORQUE_MEASURED, 0.0, 12.5);
    record(HCI_TORQUE_MEASURED, 0.0, 8.0);
    TEST_ASSERT_EQUAL_UINT64(2, cli_tune_load_sizes(&tune)); /* 12.5 A is near 11 */
    record(HCI_TORQUE_MEASURED, 0.0, 20.0);
    TEST_ASSERT_EQUAL_UINT64(3, cli_tune_load_sizes(&tune));
}

/* Nothing is asked for that is there. */
static void test_what_tells_a_turn(void)
{
    record(HCI_TORQUE_MEASURED, -3.0, 10.0);
    TEST_ASSERT_EQUAL_STRING(
        "runs with i_d of both signs at two currents, or voltages of the open machine, tell them apart",
        cli_tune_turn_told_by(&tune));
    tune.has_emf = true;
    TEST_ASSERT_TRUE(cli_tune_has_zero_of_voltages(&tune));
    TEST_ASSERT_EQUAL_STRING("runs with i_d of both signs at two currents tell it",
                             cli_tune_turn_told_by(&tune));
    record(HCI_TORQUE_MEASURED, 3.0, 10.0);
    TEST_ASSERT_EQUAL_STRING("these loads do not tell it better", cli_tune_turn_told_by(&tune));
    tune.emf_is_size_alone = true;
    TEST_ASSERT_FALSE(cli_tune_has_zero_of_voltages(&tune));
    TEST_ASSERT_EQUAL_STRING("voltages of the open machine tell them apart", cli_tune_turn_told_by(&tune));
    tune.turn_is_of_dq = true; /* of i_d and i_q no zero is told */
    TEST_ASSERT_EQUAL_STRING("phase currents with i_d of both signs at two currents, or voltages of the open "
                             "machine, tell them apart",
                             cli_tune_turn_told_by(&tune));
}

static void test_a_turn_without_a_load(void)
{
    record(HCI_TORQUE_MEASURED, 0.0, 0.1);
    TEST_ASSERT_FALSE(cli_tune_has_free_turn(&tune));
    record(HCI_TORQUE_NONE, 0.0, 0.1);
    TEST_ASSERT_FALSE(cli_tune_has_free_turn(&tune));
    run[1].needs_inertia = true;
    TEST_ASSERT_TRUE(cli_tune_has_free_turn(&tune));
    run[1].needs_inertia = false;
    record(HCI_TORQUE_HOLDING, 0.0, 0.0);
    TEST_ASSERT_TRUE(cli_tune_has_free_turn(&tune));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_loads_by_their_direction);
    RUN_TEST(test_loads_by_their_size);
    RUN_TEST(test_what_tells_a_turn);
    RUN_TEST(test_a_turn_without_a_load);
    return UNITY_END();
}
