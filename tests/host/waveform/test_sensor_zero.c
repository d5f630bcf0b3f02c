/* A torque of electrical order 1, which zeros of the current sensors make as well as cogging torque. */
#include "host/waveform/sensor_zero.h"

#include <unity.h>

#include "hci/math/harmonic.h"

static const hci_effects NO_EFFECTS = {NULL, 0};
static const hci_wave BACK_EMF = {.order = 1.0, .sequence = 1, .sine = 0.2};

static double idle_A[6], load_A[6];
static hci_run run[2];
static hci_role role[2];
static hci_runs runs;

void setUp(void)
{
    for (size_t k = 0; k < 6; ++k) {
        idle_A[k] = 0.001;
        load_A[k] = 2.0;
    }
    run[0] = (hci_run){.torque_source = HCI_TORQUE_MEASURED, .i_A = idle_A, .count = 2};
    run[1] = (hci_run){.torque_source = HCI_TORQUE_MEASURED, .i_A = load_A, .count = 2};
    role[0] = role[1] = HCI_ROLE_FIT;
    runs = (hci_runs){.run = run, .role = role, .count = 2};
}

void tearDown(void)
{
}

/* 3/2 of 0.2 N·m/A: 0.3 N·m for each ampere of a zero. */
static double of_order(double order, double zeros_read_A)
{
    const hci_harmonic cogging[] = {{12.0, 0.03, 0.04}, {order, 0.006, 0.008}};
    const hci_machine machine = {
        .pole_pairs = 5, .back_emf = &BACK_EMF, .back_emf_count = 1, .cogging = cogging, .cogging_count = 2};
    return hci_sensor_zero_Nm(&machine, &NO_EFFECTS, &runs, zeros_read_A);
}

static void test_order(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0.01, of_order(1.0, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, of_order(2.0, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, of_order(0.2, 0.0));
}

/* Without a drive there is no current that a zero could make. */
static void test_run_without_current(void)
{
    for (size_t k = 0; k < 6; ++k)
        idle_A[k] = 0.0;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, of_order(1.0, 0.0));
    role[0] = HCI_ROLE_HOLDOUT;
    TEST_ASSERT_EQUAL_DOUBLE(0.01, of_order(1.0, 0.0));
    role[0] = HCI_ROLE_FIT;
    run[0].torque_source = HCI_TORQUE_NONE;
    TEST_ASSERT_EQUAL_DOUBLE(0.01, of_order(1.0, 0.0));
    run[1].torque_source = HCI_TORQUE_NONE;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, of_order(1.0, 0.0));
}

/* 0.01 N·m are 33 mA: where the sensors read such zeros, no drive hides them, and the torque is another's. */
static void test_zeros_read(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0.01, of_order(1.0, 0.003));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, of_order(1.0, 0.02));
}

/* What is taken for zeros may be cogging torque as well; what all three sensors have in common flows nowhere.
 */
static void test_zeros_found(void)
{
    const hci_effect_type *type = hci_effect_type_find("current_offset");
    TEST_ASSERT_NOT_NULL(type);
    hci_effect_term term[3] = {{0, 0.0, 0.04, 0.0}, {1, 0.0, -0.02, 0.0}, {2, 0.0, -0.02, 0.0}};
    const hci_effect effect = {type, term, 3};
    const hci_effects effects = {&effect, 1};
    const hci_machine machine = {.pole_pairs = 5, .back_emf = &BACK_EMF, .back_emf_count = 1};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.3 * 0.04, hci_sensor_zero_Nm(&machine, &effects, &runs, 0.0));
    term[0].value = -0.02;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, hci_sensor_zero_Nm(&machine, &effects, &runs, 0.0));
}

/* Zeros of 0.04, -0.02 and -0.02 A that are read on top of three amperes over 2.6 electrical turns backwards,
 * by rows that are not even: no drive hides them. */
static void test_zeros_found_and_read(void)
{
    enum { ROWS = 400 };
    static double theta_m_rad[ROWS], i_A[3 * ROWS];
    static const double ZERO_A[] = {0.04, -0.02, -0.02};
    hci_effect_term term[3] = {{0, 0.0, 0.04, 0.0}, {1, 0.0, -0.02, 0.0}, {2, 0.0, -0.02, 0.0}};
    const hci_effect effect = {hci_effect_type_find("current_offset"), term, 3};
    const hci_effects effects = {&effect, 1};
    const hci_machine machine = {.pole_pairs = 5, .back_emf = &BACK_EMF, .back_emf_count = 1};
    for (int hidden = 0; hidden < 2; ++hidden) {
        for (size_t n = 0; n < ROWS; ++n) {
            const double x = (double)n / ROWS, way = x + 0.05 * sin(2.0 * HCI_PI * x);
            theta_m_rad[n] = 0.3 - 2.6 * 2.0 * HCI_PI / 5.0 * way;
            for (size_t s = 0; s < 3; ++s)
                i_A[3 * n + s] = 3.0 * sin(5.0 * theta_m_rad[n] - 2.0 * HCI_PI * (double)s / 3.0) +
                                 (hidden ? 0.0 : ZERO_A[s]);
        }
        run[0] = run[1] = (hci_run){
            .torque_source = HCI_TORQUE_MEASURED, .i_A = i_A, .theta_m_rad = theta_m_rad, .count = ROWS};
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, hidden ? 0.3 * 0.04 : 0.0,
                                  hci_sensor_zero_Nm(&machine, &effects, &runs, 0.0));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_order);
    RUN_TEST(test_run_without_current);
    RUN_TEST(test_zeros_read);
    RUN_TEST(test_zeros_found);
    RUN_TEST(test_zeros_found_and_read);
    return UNITY_END();
}
