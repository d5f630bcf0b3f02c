/* What voltages and the sum of currents tell, of samples in closed form. */
#include <math.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "host/fleet/current_sum.h"
#include "host/fleet/voltages.h"
#include "unity.h"

enum { SAMPLES = 400, RUNS = 3, POLE_PAIRS = 3 };

static const double R_ohm = 0.8, L_D_H = 2e-3, L_Q_H = 3e-3, K = 0.15;
static const hci_wave EMF[] = {{1.0, 1, 0.15, 0.0}};
static const hci_machine MACHINE = {.pole_pairs = POLE_PAIRS, .back_emf = EMF, .back_emf_count = 1};

static double angle[RUNS][SAMPLES], speed[RUNS][SAMPLES], current[RUNS][3 * SAMPLES],
    voltage[RUNS][3 * SAMPLES];
static hci_run run[RUNS];
static hci_role role[RUNS];
static hci_runs runs;

/* A steady run of two mechanical turns: i_d, i_q with a ripple of order 6, and what the voltages are then. */
static void make(size_t r, double omega_m, double id_A, double iq_A, double ripple_A)
{
    for (size_t k = 0; k < SAMPLES; ++k) {
        const double theta = copysign(4.0 * HCI_PI * (double)k / (SAMPLES - 1), omega_m) * POLE_PAIRS,
                     omega = POLE_PAIRS * omega_m;
        const hci_dq i = {id_A, iq_A + ripple_A * sin(6.0 * theta), 0.0};
        const hci_dq u = {R_ohm * i.d - omega * L_Q_H * i.q,
                          R_ohm * i.q + omega * L_D_H * i.d + omega_m * K +
                              6.0 * omega * L_Q_H * ripple_A * cos(6.0 * theta),
                          1.5}; /* to another point than the neutral one */
        hci_clarke_inverse(hci_park_inverse(i, theta), &current[r][3 * k]);
        hci_clarke_inverse(hci_park_inverse(u, theta), &voltage[r][3 * k]);
        angle[r][k] = theta / POLE_PAIRS;
        speed[r][k] = omega_m;
    }
    run[r] = (hci_run){.count = SAMPLES,
                       .pole_pairs = POLE_PAIRS,
                       .theta_m_rad = angle[r],
                       .speed_rad_per_s = speed[r],
                       .i_A = current[r],
                       .v_V = voltage[r],
                       .has_sum = true};
    role[r] = HCI_ROLE_FIT;
}

void setUp(void)
{
    memset(&runs, 0, sizeof runs);
    runs.run = run;
    runs.role = role;
    runs.count = RUNS;
    make(0, 30.0, 0.0, 4.0, 0.3);
    make(1, -30.0, 0.0, 4.0, 0.3);
    make(2, 60.0, -3.0, 2.0, 0.3);
}

void tearDown(void)
{
}

static void test_resistance_and_inductances(void)
{
    double value[HCI_VOLTAGES_MOST], std_error[HCI_VOLTAGES_MOST];
    TEST_ASSERT_TRUE(hci_voltages_fit(&MACHINE, &runs, value, std_error));
    TEST_ASSERT_DOUBLE_WITHIN(1e-2 * R_ohm, R_ohm, value[HCI_VOLTAGES_R]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-2 * L_D_H, L_D_H, value[HCI_VOLTAGES_L_D]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-2 * L_Q_H, L_Q_H, value[HCI_VOLTAGES_L_Q]);
}

/* No i_d, no L_d; nothing recorded under current, nothing. */
static void test_what_voltages_do_not_tell(void)
{
    double value[HCI_VOLTAGES_MOST], std_error[HCI_VOLTAGES_MOST];
    runs.count = 2;
    TEST_ASSERT_TRUE(hci_voltages_fit(&MACHINE, &runs, value, std_error));
    TEST_ASSERT_FALSE(isnan(value[HCI_VOLTAGES_R]));
    TEST_ASSERT_TRUE(isnan(value[HCI_VOLTAGES_L_D]));
    make(0, 30.0, 0.0, 0.0, 0.0);
    runs.count = 1;
    TEST_ASSERT_TRUE(hci_voltages_fit(&MACHINE, &runs, value, std_error));
    for (size_t k = 0; k < HCI_VOLTAGES_MOST; ++k)
        TEST_ASSERT_TRUE(isnan(value[k]) && isnan(std_error[k]));
    run[0].v_V = NULL;
    TEST_ASSERT_TRUE(hci_voltages_fit(&MACHINE, &runs, value, std_error));
    TEST_ASSERT_TRUE(isnan(value[HCI_VOLTAGES_R]));
}

/* Of what a sensor reads 3 % is too much: 2 % above the mean of the three, the others 1 % below. */
static void test_gain_of_one_sensor(void)
{
    double gain[3], std_error[3];
    for (size_t k = 0; k < SAMPLES; ++k) {
        current[0][3 * k + 1] = current[0][3 * k + 1] / 0.97 + 0.2;
        current[0][3 * k] += 1e-3 * sin(977.0 * (double)k);
    }
    runs.count = 1;
    TEST_ASSERT_TRUE(hci_current_sum_gains(&runs, gain, std_error));
    TEST_ASSERT_DOUBLE_WITHIN(5e-4, -0.01, gain[0]);
    TEST_ASSERT_DOUBLE_WITHIN(5e-4, 0.02, gain[1]);
    TEST_ASSERT_DOUBLE_WITHIN(5e-4, -0.01, gain[2]);
    run[0].has_sum = false; /* the third current was made of the others */
    TEST_ASSERT_TRUE(hci_current_sum_gains(&runs, gain, std_error));
    TEST_ASSERT_TRUE(isnan(gain[1]));
}

/* Nor do currents whose sum is nothing but rounding, or that do not flow. */
static void test_sums_that_tell_nothing(void)
{
    double gain[3], std_error[3];
    TEST_ASSERT_TRUE(hci_current_sum_gains(&runs, gain, std_error));
    TEST_ASSERT_TRUE(isnan(gain[0]));
    for (size_t k = 0; k < 3 * SAMPLES; ++k)
        current[0][k] = 1e-3 * sin(977.0 * (double)(k * k % 1009));
    runs.count = 1;
    TEST_ASSERT_TRUE(hci_current_sum_gains(&runs, gain, std_error));
    TEST_ASSERT_TRUE(isnan(gain[0]));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_resistance_and_inductances);
    RUN_TEST(test_what_voltages_do_not_tell);
    RUN_TEST(test_gain_of_one_sensor);
    RUN_TEST(test_sums_that_tell_nothing);
    return UNITY_END();
}
