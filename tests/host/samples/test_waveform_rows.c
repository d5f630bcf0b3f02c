/* Rows of a waveform beside sums of waves, and how many there are in a turn. */
#include "host/samples/waveform_rows.h"

#include <string.h>

#include "support/reference.h"
#include "unity.h"

static hci_wave emf[1], wave[2];
static hci_solved_order order[3];
static hci_machine_data machine;
static hci_solution solution;

void setUp(void)
{
    memset(&machine, 0, sizeof machine);
    memset(&solution, 0, sizeof solution);
    memset(order, 0, sizeof order);
    emf[0] = (hci_wave){.order = 1.0, .sequence = 1, .sine = 0.2};
    wave[0] = (hci_wave){.order = 1.0, .sequence = 1, .sine = 5.0, .cosine = 1.0};
    wave[1] = (hci_wave){.order = 5.0, .sequence = -1, .sine = 0.5};
    order[0].torque_Nm.cosine = 1.5;
    order[1].torque_Nm.order = 6.0, order[1].torque_Nm.sine = 0.3;
    order[2].torque_Nm.order = 12.0, order[2].torque_Nm.cosine = 0.1;
    machine.model = (hci_machine){.pole_pairs = 3, .back_emf = emf, .back_emf_count = 1};
    solution.current.wave = wave, solution.current.count = 2;
    solution.order = order, solution.order_count = 3;
}

void tearDown(void)
{
}

/* Eight in the shortest wave of current or torque, and at least one in each degree. */
static void test_points_in_a_turn(void)
{
    TEST_ASSERT_EQUAL_UINT64(360, hci_waveform_points_per_turn(&solution));
    order[2].torque_Nm.order = 46.0;
    TEST_ASSERT_EQUAL_UINT64(368, hci_waveform_points_per_turn(&solution));
    wave[1].order = 61.5;
    TEST_ASSERT_EQUAL_UINT64(496, hci_waveform_points_per_turn(&solution));
    order[0].torque_Nm.order = 100.0;
    TEST_ASSERT_EQUAL_UINT64(800, hci_waveform_points_per_turn(&solution));
}

static void test_rows_by_hand(void)
{
    double row[HCI_WAVEFORM_COLUMNS];
    for (double theta = -3.0; theta < 3.0; theta += 0.37) {
        double q = 0.0, d = 0.0, torque = 0.0;
        solution.with_effects = false;
        hci_waveform_row(&machine, &solution, theta, row);
        TEST_ASSERT_EQUAL_DOUBLE(theta, row[0]);
        for (int s = 0; s < 3; ++s) {
            const double x = theta - 2.0 * REF_PI * s / 3.0, y = 5.0 * theta + 2.0 * REF_PI * s / 3.0;
            const double i = 5.0 * sin(x) + cos(x) + 0.5 * sin(y);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, i, row[1 + s]);
            q += 2.0 / 3.0 * i * sin(x), d -= 2.0 / 3.0 * i * cos(x);
            torque += 0.2 * sin(x) * i;
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, d, row[4]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, q, row[5]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, torque, row[6]);
        solution.with_effects = true; /* what the spectrum says */
        hci_waveform_row(&machine, &solution, theta, row);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5 + 0.3 * sin(6.0 * theta) + 0.1 * cos(12.0 * theta), row[6]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_points_in_a_turn);
    RUN_TEST(test_rows_by_hand);
    return UNITY_END();
}
