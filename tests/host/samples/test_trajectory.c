/* trajectory.csv: figures recomputed from it, what a logger reads of sensors, the same bytes every time. */
#include "hci/host/simulate/simulate.h"
#include "support/simulating.h"

void setUp(void)
{
    drives_start();
}

void tearDown(void)
{
    drives_end();
}

/* ---- figures from the trajectory ---- */

/* Formulas (27), (28) of the paper by the trapezoidal rule, from every row of the evaluated time. */
static void test_figures_are_those_of_the_trajectory(void)
{
    const hci_scenario scenario = scenario_of("duration,0.15,s\nprescribed_speed,240,rpm\ntorque_reference,5,"
                                              "Nm\nstrategy,id0,\ncurrent_control,pi,\n"
                                              "trajectory_every,1,\nsettle,0.02,s\n");
    hci_simulation s = simulate_into(&machine_c, &scenario, files_path("out"));
    size_t rows;
    double *t = column("out/trajectory.csv", "time_s", &rows),
           *torque = column("out/trajectory.csv", "torque_Nm", &rows);
    double *a = column("out/trajectory.csv", "ia_A", &rows), *b = column("out/trajectory.csv", "ib_A", &rows);
    double *va = column("out/trajectory.csv", "va_V", &rows),
           *vb = column("out/trajectory.csv", "vb_V", &rows);
    double most = -1e9, least = 1e9, sum = 0.0, square = 0.0, mean, length = 0.0, input = 0.0,
           last_s = s.to_s;
    for (size_t k = 0; k + 1 < rows; ++k) {
        const double h = t[k + 1] - t[k];
        if (t[k] < s.from_s - 1e-9 || t[k] > last_s - 0.5 * h) continue;
        most = fmax(most, torque[k]);
        least = fmin(least, torque[k]);
        sum += 0.5 * h * (torque[k] + torque[k + 1]);
        length += 0.5 * h *
                  (sqrt((a[k] * a[k] + b[k] * b[k] + a[k] * b[k]) * 4.0 / 3.0) +
                   sqrt((a[k + 1] * a[k + 1] + b[k + 1] * b[k + 1] + a[k + 1] * b[k + 1]) * 4.0 / 3.0));
        /* v·i with i_c = −i_a − i_b, v_c = −v_a − v_b, current straight over a step */
        input +=
            0.5 * h * ((2.0 * va[k] + vb[k]) * (a[k] + a[k + 1]) + (va[k] + 2.0 * vb[k]) * (b[k] + b[k + 1]));
    }
    mean = sum / (s.to_s - s.from_s);
    for (size_t k = 0; k + 1 < rows; ++k)
        if (t[k] >= s.from_s - 1e-9 && t[k] <= last_s - 0.5 * (t[k + 1] - t[k]))
            square += 0.5 * (t[k + 1] - t[k]) * (pow(torque[k] - mean, 2.0) + pow(torque[k + 1] - mean, 2.0));
    /* The period has 12 500 steps, and ends within one of them for rounding alone. */
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, mean, s.torque_Nm.mean);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4 * s.T_ripple_percent, 100.0 * (most - least) / mean, s.T_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * s.F_ripple_percent, 100.0 * sqrt(square / (s.to_s - s.from_s)) / mean,
                              s.F_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, length / (s.to_s - s.from_s), s.current_A.mean);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4 * input, input, s.energy_J.electrical);
    TEST_ASSERT_TRUE(s.T_ripple_percent > 10.0); /* there is something to compare */
    free(t);
    free(torque);
    free(a);
    free(b);
    free(va);
    free(vb);
    hci_simulation_release(&s);
}

/* By default the evaluation begins where ideal currents change. */
static void test_strategy_2_takes_over_at_its_time(void)
{
    const hci_scenario scenario =
        scenario_of("duration,0.6,s\nprescribed_speed,80,rpm\ntorque_reference,8,Nm\nstrategy,"
                    "id0,\nstrategy_2,cancel,\nstrategy_2_from,0.2,s\n");
    hci_simulation s = simulate_into(&machine_c, &scenario, files_path("out"));
    size_t rows;
    double *t = column("out/trajectory.csv", "time_s", &rows),
           *torque = column("out/trajectory.csv", "torque_Nm", &rows), before = 0.0;
    for (size_t k = 0; k < rows; ++k) {
        if (t[k] < 0.2)
            before = fmax(before, fabs(torque[k] - 8.0));
        else
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, 8.0, torque[k]);
    }
    TEST_ASSERT_TRUE(before > 0.5);
    TEST_ASSERT_DOUBLE_WITHIN(s.step_s, 0.2, s.from_s);
    TEST_ASSERT_EQUAL_UINT64(1, s.periods);
    free(t);
    free(torque);
    hci_simulation_release(&s);
}

/* ---- sensors ---- */

#define LOGGED "duration,0.05,s\nprescribed_speed,80,rpm\ntorque_reference,4,Nm\ntrajectory_every,1,\n"

static void compare_columns(const char *reading, const char *truth, double gain, double offset,
                            double tolerance)
{
    size_t rows;
    double *x = column("out/trajectory.csv", reading, &rows), *y = column("out/trajectory.csv", truth, &rows);
    TEST_ASSERT_TRUE(rows > 100);
    for (size_t k = 0; k < rows; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, gain * y[k] + offset, x[k]);
    free(x);
    free(y);
}

static void test_the_trajectory_is_what_a_logger_reads(void)
{
    static const char *const CONTROL[] = {"current_control,ideal,\n", "current_control,pi,\n"};
    for (size_t k = 0; k < 2; ++k) {
        char rows[512];
        hci_scenario scenario;
        hci_simulation s;
        snprintf(rows, sizeof rows,
                 LOGGED
                 "current_offset_a,0.3,A\ncurrent_gain_b,0.05,\nangle_offset,0.2,rad\ntorque_delay,0,s\n%s",
                 CONTROL[k]);
        scenario = scenario_of(rows);
        s = simulate_into(&machine_c, &scenario, files_path("out"));
        compare_columns("ia_A", "ia_true_A", 1.0, 0.3, 1e-12);
        compare_columns("ib_A", "ib_true_A", 1.05, 0.0, 1e-12);
        compare_columns("ic_A", "ic_true_A", 1.0, 0.0, 1e-12);
        compare_columns("theta_m_rad", "theta_m_true_rad", 1.0, 0.1, 1e-12);
        compare_columns("torque_Nm", "torque_true_Nm", 1.0, 0.0, 0.0);
        hci_simulation_release(&s);
    }
}

static void test_readings_are_coarse_and_late(void)
{
    const hci_scenario scenario = scenario_of(LOGGED "step,10,us\nencoder_counts,256,\ntorque_delay,30,us\n");
    hci_simulation s = simulate_into(&machine_c, &scenario, files_path("out"));
    size_t rows;
    double *angle = column("out/trajectory.csv", "theta_m_rad", &rows),
           *late = column("out/trajectory.csv", "torque_Nm", &rows),
           *truth = column("out/trajectory.csv", "torque_true_Nm", &rows);
    for (size_t k = 3; k < rows; ++k) {
        const double counts = angle[k] * 256.0 / (2.0 * REF_PI);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, floor(counts + 0.5), counts);
        TEST_ASSERT_EQUAL_DOUBLE(truth[k - 3], late[k]);
    }
    TEST_ASSERT_TRUE(s.F_ripple_percent > 0.01); /* the controller read the coarse angle too */
    free(angle);
    free(late);
    free(truth);
    hci_simulation_release(&s);
}

static void test_same_input_same_bytes(void)
{
    static const char *const FILES[] = {"trajectory.csv", "spectrum.csv", "summary.json"};
    char rows[512];
    char *first[3];
    for (int run = 0; run < 3; ++run) {
        hci_scenario scenario;
        hci_simulation s;
        snprintf(rows, sizeof rows,
                 "duration,0.04,s\nprescribed_speed,1600,rpm\ntorque_reference,4,Nm\ncurrent_control,"
                 "hysteresis,\nsettle,0.001,s\ntrajectory_every,50,\n"
                 "current_noise,0.02,A\nseed,%d,\n",
                 run == 2 ? 8 : 7);
        scenario = scenario_of(rows);
        s = simulate_into(&machine_c, &scenario, files_path("out"));
        TEST_ASSERT_EQUAL_INT(3, files_count(files_path("out")));
        for (int k = 0; k < 3; ++k) {
            char name[64], *text;
            snprintf(name, sizeof name, "out/%s", FILES[k]);
            text = files_read(files_path(name));
            if (run == 0) {
                strcpy(first[k] = malloc(strlen(text) + 1), text);
                continue;
            }
            TEST_ASSERT_EQUAL_INT_MESSAGE(run == 1, strcmp(text, first[k]) == 0, FILES[k]);
        }
        hci_simulation_release(&s);
    }
    for (int k = 0; k < 3; ++k)
        free(first[k]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_figures_are_those_of_the_trajectory);
    RUN_TEST(test_strategy_2_takes_over_at_its_time);
    RUN_TEST(test_the_trajectory_is_what_a_logger_reads);
    RUN_TEST(test_readings_are_coarse_and_late);
    RUN_TEST(test_same_input_same_bytes);
    return UNITY_END();
}
