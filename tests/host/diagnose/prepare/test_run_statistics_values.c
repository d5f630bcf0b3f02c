/* Statistics of a run that is written down here, by sums; each threshold from both sides. */
#include <math.h>
#include <string.h>

#include "host/diagnose/prepare/run_statistics.h"
#include "support/recording.h"
#include "unity.h"

enum { P = 3, N = 500 };

static hci_run run;

/* Half a turn; currents, speeds and torques that differ from sample to sample. */
void setUp(void)
{
    run = rec_make(N);
    run.temperature_C = calloc(N, sizeof *run.temperature_C);
    for (size_t k = 0; k < N; ++k) {
        run.theta_m_rad[k] = 1.0 - REF_PI * (double)(k * k) / ((N - 1) * (N - 1));
        run.time_s[k] = 0.001 * (double)k;
        run.speed_rad_per_s[k] = -40.0 - 3.0 * (double)(k % 5);
        rec_phases(-1.0 - 0.1 * (double)(k % 3), 4.0 + 0.2 * (double)(k % 7), P * run.theta_m_rad[k],
                   run.i_A + 3 * k);
        run.torque_Nm[k] = -0.5 + 0.1 * (double)(k % 11);
        run.temperature_C[k] = 30.0 + 0.5 * (double)(k % 13);
    }
}

void tearDown(void)
{
    rec_release(&run);
}

static void test_sums(void)
{
    double id = 0.0, iq = 0.0, square = 0.0, speed = 0.0, speed_2 = 0.0, torque = 0.0, torque_2 = 0.0,
           heat = 0.0;
    for (size_t k = 0; k < N; ++k) {
        const double d = -1.0 - 0.1 * (double)(k % 3), q = 4.0 + 0.2 * (double)(k % 7);
        id += d / N;
        iq += q / N;
        square += (d * d + q * q) / N;
        speed += run.speed_rad_per_s[k] / N;
        speed_2 += run.speed_rad_per_s[k] * run.speed_rad_per_s[k] / N;
        torque += run.torque_Nm[k] / N;
        torque_2 += run.torque_Nm[k] * run.torque_Nm[k] / N;
        heat += run.temperature_C[k] / N;
    }
    const hci_run_statistics x = hci_run_statistics_of(&run, P);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, id, x.mean_id_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, iq, x.mean_iq_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sqrt(square), x.current_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, speed, x.mean_speed_rad_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sqrt(speed_2 - speed * speed), x.speed_deviation);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, torque, x.mean_torque_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sqrt(torque_2), x.rms_torque_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, heat, x.temperature_C);
    TEST_ASSERT_EQUAL_DOUBLE(30.0, x.coldest_C);
    TEST_ASSERT_EQUAL_DOUBLE(36.0, x.hottest_C);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, x.turns);
    TEST_ASSERT_TRUE(isnan(x.repeat_Nm)); /* half a turn repeats nothing */
    TEST_ASSERT_TRUE(x.is_loaded);
    TEST_ASSERT_FALSE(x.no_current || x.stands || x.is_direct);
}

/* What was not recorded is 0, or not known; of means alone nothing is said of the angle. */
static void test_what_was_not_recorded(void)
{
    free(run.temperature_C);
    free(run.speed_rad_per_s);
    free(run.torque_Nm);
    run.temperature_C = run.speed_rad_per_s = run.torque_Nm = NULL;
    hci_run_statistics x = hci_run_statistics_of(&run, P);
    TEST_ASSERT_TRUE(isnan(x.temperature_C) && isnan(x.coldest_C) && isnan(x.hottest_C));
    TEST_ASSERT_TRUE(x.mean_speed_rad_per_s == 0.0 && x.speed_deviation == 0.0 && x.mean_torque_Nm == 0.0 &&
                     x.rms_torque_Nm == 0.0);
    TEST_ASSERT_TRUE(x.mean_iq_A > 4.0 && x.turns > 0.4);
    run.only_mean = true;
    x = hci_run_statistics_of(&run, P);
    TEST_ASSERT_TRUE(x.mean_iq_A > 4.0 && x.turns == 0.0 && x.angle_step_rad == 0.0);
    run.only_mean = false;
    double *theta = run.theta_m_rad;
    run.theta_m_rad = NULL;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_run_statistics_of(&run, P).current_A);
    run.theta_m_rad = theta;
}

/* The smallest step between neighbours that is more than rounding, wherever it is. */
static void test_the_smallest_step_of_the_angle(void)
{
    for (size_t k = 0; k < N; ++k)
        run.theta_m_rad[k] = 0.01 * (double)k;
    run.theta_m_rad[1] = run.theta_m_rad[0] - 0.003;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.003, hci_run_statistics_of(&run, P).angle_step_rad);
    run.theta_m_rad[N - 1] = run.theta_m_rad[N - 2] + 1.1e-7;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.1e-7, hci_run_statistics_of(&run, P).angle_step_rad);
    run.theta_m_rad[N - 1] = run.theta_m_rad[N - 2] + 0.9e-7;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.003, hci_run_statistics_of(&run, P).angle_step_rad);
    for (size_t k = 0; k < N; ++k)
        run.theta_m_rad[k] = 0.5;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_run_statistics_of(&run, P).angle_step_rad);
}

/* Currents that vary by a twentieth of their rms, over a tenth of an electrical turn. */
static void test_direct_currents(void)
{
    for (int k = 0; k < 4; ++k) {
        const double vary = k == 1 ? 0.051 : 0.049, turns = k == 2 ? 0.099 : 0.101;
        /* (3, −1, −2) and in each phase ± c: c² against 14/3 */
        const double c = vary * sqrt(14.0 / 3.0 + 0.012);
        for (size_t j = 0; j < N; ++j) {
            const double sign = j % 4 < 2 ? c : -c;
            const double i[3] = {3.0 + sign, -1.0 + sign, -2.0 + sign};
            memcpy(run.i_A + 3 * j, i, sizeof i);
            run.theta_m_rad[j] = 2.0 * REF_PI / P * turns * (double)j / (N - 1);
        }
        TEST_ASSERT_EQUAL(k == 0 || k == 3, hci_run_statistics_of(&run, P).is_direct);
    }
}

/* Means over ten electrical turns or more are told, phase by phase. */
static void test_means_of_phases(void)
{
    for (int told = 0; told < 2; ++told) {
        double mean[3] = {0.0};
        for (size_t k = 0; k < N; ++k) {
            run.theta_m_rad[k] = 2.0 * REF_PI / P * (told ? 10.01 : 9.99) * (double)k / (N - 1);
            rec_phases(0.0, 2.0, P * run.theta_m_rad[k], run.i_A + 3 * k);
            for (size_t s = 0; s < 3; ++s) {
                run.i_A[3 * k + s] += 0.1 * (double)(s + 1);
                mean[s] += run.i_A[3 * k + s] / N;
            }
        }
        const hci_run_statistics x = hci_run_statistics_of(&run, P);
        for (size_t s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, told ? mean[s] : 0.0, x.standing_A[s]);
        TEST_ASSERT_FALSE(x.stands); /* a current flows beside them */
    }
}

/* ---- beside each other ---- */

/* A twentieth of the largest current of the runs, or of the rated one; the largest of three, of any sign. */
static void test_zeros_beside_the_largest_current(void)
{
    for (int k = 0; k < 6; ++k) {
        const double zero_A = k % 2 ? 0.401 : 0.399;
        hci_run_statistics x[3] = {{.current_A = 1.0, .stands = true, .is_loaded = true},
                                   {.current_A = k < 4 ? 8.0 : 3.0, .is_loaded = true},
                                   {.current_A = 2.0, .standing_A = {0.01, 0.0, 0.0}, .is_loaded = true}};
        x[0].standing_A[k / 2] = k < 2 ? -zero_A : zero_A;
        hci_run_statistics_zeros_find(x, 3, k < 4 ? (double)NAN : 8.0);
        TEST_ASSERT_EQUAL(k % 2 == 0, x[0].zeros_read);
        TEST_ASSERT_EQUAL(k % 2 == 1, x[0].is_loaded);
        TEST_ASSERT_TRUE(!x[1].zeros_read && !x[2].zeros_read && x[1].is_loaded && x[2].is_loaded);
    }
}

/* Whichever recording has it. */
static void test_zeros_wherever_the_largest_current_is(void)
{
    for (size_t largest = 0; largest < 3; ++largest) {
        hci_run_statistics x[3] = {{.current_A = 1.0}, {.current_A = 1.0}, {.current_A = 1.0}};
        x[largest].current_A = 8.0;
        for (size_t r = 0; r < 3; ++r) {
            x[r].stands = x[r].is_loaded = true;
            x[r].standing_A[r] = 0.39;
        }
        hci_run_statistics_zeros_find(x, 3, (double)NAN);
        for (size_t r = 0; r < 3; ++r)
            TEST_ASSERT_TRUE(x[r].zeros_read && !x[r].is_loaded);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_sums);
    RUN_TEST(test_what_was_not_recorded);
    RUN_TEST(test_the_smallest_step_of_the_angle);
    RUN_TEST(test_direct_currents);
    RUN_TEST(test_means_of_phases);
    RUN_TEST(test_zeros_beside_the_largest_current);
    RUN_TEST(test_zeros_wherever_the_largest_current_is);
    return UNITY_END();
}
