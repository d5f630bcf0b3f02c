/* Rows of a trajectory from steps that are made up: which column holds what, means of the voltage over a row,
 * and currents of an ideal source that are read at the next step. */
#include "host/samples/trajectory.h"

#include <math.h>
#include <string.h>

#include "support/recording.h"
#include "unity.h"

enum { POLE_PAIRS = 3, MOST_ROWS = 8 };

static hci_trajectory trajectory;
static double row[MOST_ROWS][HCI_TRAJECTORY_COLUMNS];
static size_t rows, columns;

static void sink(void *context, const double *values, size_t count)
{
    TEST_ASSERT_EQUAL_PTR(&rows, context);
    TEST_ASSERT_TRUE(rows < MOST_ROWS && count <= HCI_TRAJECTORY_COLUMNS);
    memcpy(row[rows++], values, count * sizeof *values);
    columns = count;
}

void setUp(void)
{
    rows = columns = 0;
}

void tearDown(void)
{
}

static void begin(size_t steps_per_row, bool voltage, bool sensors)
{
    const hci_simulation_plan plan = {.step_s = 1e-3,
                                      .steps_per_row = steps_per_row,
                                      .temperature_C = NAN,
                                      .pole_pairs = POLE_PAIRS,
                                      .has_voltage = voltage,
                                      .has_sensors = sensors};
    hci_trajectory_begin(&trajectory, &plan, sink, &rows);
}

/* Step k: true angle 0.01 + k/10 and measured 0.02 more; i_d = 1, i_q = 2 + k at the true electrical angle;
 * phases read are 0.5 A, 1 A and −1.5 A higher; the reference is 4 A in phase a alone, αβ of the constant
 * length. */
static void step_at(int k)
{
    const double to_plane = sqrt(1.5);
    hci_drive_state state;
    double i[3];
    memset(&state, 0, sizeof state);
    hci_simulation_step s = {.time_s = 1e-3 * k,
                             .theta_e_rad = POLE_PAIRS * (0.01 + 0.1 * k),
                             .speed_rad_per_s = 40.0 + k,
                             .torque_Nm = 5.0 + k,
                             .load_Nm = 0.5 * k,
                             .state = &state};
    rec_phases(1.0, 2.0 + k, s.theta_e_rad, i);
    s.i_A[0] = to_plane * i[0];
    s.i_A[1] = to_plane * (i[1] - i[2]) / sqrt(3.0);
    s.v_V[0] = to_plane * 10.0 * k;
    s.v_V[1] = to_plane * 3.0;
    state.measured.theta_m_rad = 0.03 + 0.1 * k;
    state.measured.speed_rad_per_s = 41.0 + k;
    for (int p = 0; p < 3; ++p)
        state.measured.i_abc[p] = i[p] + (p == 0 ? 0.5 : p == 1 ? 1.0 : -1.5);
    state.control.reference[0] = to_plane * 4.0;
    state.control.torque_Nm = 6.0 + k;
    state.torque_measured_Nm = 7.0 + k;
    hci_trajectory_add(&trajectory, &s);
}

static void check_dq(const double *at, double theta_e_rad, const double *i_abc)
{
    double d, q;
    rec_rotor(i_abc, theta_e_rad, &d, &q);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, d, at[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, q, at[1]);
}

static void check_currents(const double *at, int k, bool read)
{
    double i[3];
    rec_phases(1.0, 2.0 + k, POLE_PAIRS * (0.01 + 0.1 * k), i);
    for (int p = 0; p < 3; ++p)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, i[p] + (!read ? 0.0 : p == 0 ? 0.5 : p == 1 ? 1.0 : -1.5), at[p]);
}

/* Time, angles, speed, currents, their d and q by the angle that was read, torque; load and references. */
static void test_what_is_read_without_sensors(void)
{
    static const double REFERENCE[] = {4.0, -2.0, -2.0};
    begin(1, false, false);
    for (int k = 0; k < 3; ++k)
        step_at(k);
    hci_trajectory_end(&trajectory);
    TEST_ASSERT_EQUAL(3, rows);
    TEST_ASSERT_EQUAL(13, columns);
    for (int k = 0; k < 3; ++k) {
        const double *r = row[k], theta_e = POLE_PAIRS * (0.03 + 0.1 * k);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1e-3 * k, r[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.03 + 0.1 * k, r[1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, theta_e, r[2]);
        TEST_ASSERT_EQUAL_DOUBLE(41.0 + k, r[3]);
        check_currents(r + 4, k, false);
        check_dq(r + 7, theta_e, r + 4);
        TEST_ASSERT_EQUAL_DOUBLE(7.0 + k, r[9]);
        TEST_ASSERT_EQUAL_DOUBLE(0.5 * k, r[10]);
        check_dq(r + 11, theta_e, REFERENCE);
    }
}

/* Two steps a row: v_α is 0, 10, 20 … V, so that the means are 5, 25 and, of the last step alone, 40 V. */
static void test_voltages_are_means_over_a_row(void)
{
    static const double MEAN_V[] = {5.0, 25.0, 40.0};
    begin(2, true, false);
    trajectory.plan.has_command = true;
    trajectory.plan.temperature_C = 55.0;
    for (int k = 0; k < 5; ++k)
        step_at(k);
    hci_trajectory_end(&trajectory);
    TEST_ASSERT_EQUAL(3, rows);
    TEST_ASSERT_EQUAL(18, columns);
    for (int j = 0; j < 3; ++j) {
        const double *v = row[j] + 10, of_beta = 3.0 * sqrt(3.0) / 2.0;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2e-3 * j, row[j][0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, MEAN_V[j], v[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.5 * MEAN_V[j] + of_beta, v[1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.5 * MEAN_V[j] - of_beta, v[2]);
        TEST_ASSERT_EQUAL_DOUBLE(1.0 * j, row[j][13]);
        TEST_ASSERT_EQUAL_DOUBLE(6.0 + 2.0 * j, row[j][16]);
        TEST_ASSERT_EQUAL_DOUBLE(55.0, row[j][17]);
    }
}

/* With sensors the currents are those that were read, and behind the references is the truth. */
static void test_truth_beside_what_is_read(void)
{
    begin(1, true, true);
    step_at(0);
    step_at(1);
    hci_trajectory_end(&trajectory);
    TEST_ASSERT_EQUAL(2, rows);
    TEST_ASSERT_EQUAL(22, columns);
    check_currents(row[1] + 4, 1, true);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.11, row[1][16]);
    TEST_ASSERT_EQUAL_DOUBLE(41.0, row[1][17]);
    check_currents(row[1] + 18, 1, false);
    TEST_ASSERT_EQUAL_DOUBLE(6.0, row[1][21]);
}

/* The current of an ideal source flows from a step on: what is read of it comes with the next one, and of the
 * last one never. */
static void test_an_ideal_source_is_read_late(void)
{
    begin(1, false, true);
    for (int k = 0; k < 3; ++k)
        step_at(k);
    hci_trajectory_end(&trajectory);
    TEST_ASSERT_EQUAL(2, rows);
    TEST_ASSERT_EQUAL(19, columns);
    for (int k = 0; k < 2; ++k) {
        check_currents(row[k] + 4, k + 1, true);
        check_dq(row[k] + 7, POLE_PAIRS * (0.03 + 0.1 * k), row[k] + 4);
        check_currents(row[k] + 15, k, false);
    }
    rows = 0;
    begin(2, false, true); /* the row is full at the second step, which has read it */
    for (int k = 0; k < 4; ++k)
        step_at(k);
    hci_trajectory_end(&trajectory);
    TEST_ASSERT_EQUAL(2, rows);
    check_currents(row[1] + 4, 3, true);
}

/* Angles are within a turn, and one that is smaller than 0 by less than rounding is 0. */
static void test_angles_are_within_a_turn(void)
{
    static const double ANGLE[] = {-1e-20, 2.0 * REF_PI + 0.25, -0.25, 2.0 * REF_PI / POLE_PAIRS + 0.1},
                        OF_TURN[] = {0.0, 0.25, 2.0 * REF_PI - 0.25, 2.0 * REF_PI / POLE_PAIRS + 0.1},
                        OF_PERIOD[] = {0.0, 0.75, 2.0 * REF_PI - 0.75, 0.3};
    begin(1, false, false);
    for (int k = 0; k < 4; ++k) {
        hci_drive_state state;
        memset(&state, 0, sizeof state);
        state.measured.theta_m_rad = ANGLE[k];
        const hci_simulation_step s = {.state = &state};
        hci_trajectory_add(&trajectory, &s);
    }
    hci_trajectory_end(&trajectory);
    for (int k = 0; k < 4; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, OF_TURN[k], row[k][1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, OF_PERIOD[k], row[k][2]);
    }
}

/* As many names as columns. */
static void test_names(void)
{
    for (int k = 0; k < 16; ++k) {
        char names[HCI_SAMPLES_COLUMNS];
        size_t count = 1;
        rows = 0;
        begin(1, k & 1, k & 2);
        trajectory.plan.has_command = k & 4;
        if (k & 8) trajectory.plan.temperature_C = 20.0;
        hci_trajectory_names(&trajectory.plan, names, sizeof names);
        for (const char *c = names; *c; ++c)
            count += *c == ',';
        step_at(0);
        step_at(1);
        hci_trajectory_end(&trajectory);
        TEST_ASSERT_EQUAL(count, columns);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_read_without_sensors);
    RUN_TEST(test_voltages_are_means_over_a_row);
    RUN_TEST(test_truth_beside_what_is_read);
    RUN_TEST(test_an_ideal_source_is_read_late);
    RUN_TEST(test_angles_are_within_a_turn);
    RUN_TEST(test_names);
    return UNITY_END();
}
