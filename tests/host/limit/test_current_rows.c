/* Rows of limits, against what they limit of currents that are written as sines of the phases here: of each
 * row its right side less what it makes of the currents, which a program keeps at 0 or above, and in a cone
 * the head at the length of the others or above. */
#include "host/limit/rows.h"

#include <math.h>
#include <string.h>

#include "support/reference.h"
#include "unity.h"

enum { COUNT = 6, ROWS = 64, SAMPLES = 360 };

#define SCALE_A   3.0
#define WIDENED   0.1
#define OBJECTIVE 0.4 /* share by which FIT widens */

static const hci_component COMPONENT[COUNT] = {{1.0, -1}, {5.0, -1}, {5.0, 1}, {3.0, 0}, {0.0, 1}, {0.0, 0}};
static const double X[2 * COUNT] = {1.2, -0.7, 0.9, 0.4, -0.6, 0.8, 0.5, -0.3, 0.35, -0.2, 0.0, 0.45};
static const hci_wave HELD[] = {{1.0, 1, 0.8, -1.1},
                                {7.0, 1, 0.8, -1.1}}; /* of an order that is there; not */

static hci_component component[COUNT];
static hci_set name[COUNT];
static hci_component_set set;
static hci_bounds bounds;
static hci_limit_program program;
static hci_limit_build build;

void setUp(void)
{
    memcpy(component, COMPONENT, sizeof component);
    set = (hci_component_set){component, name, COUNT, {{0}}};
    bounds = (hci_bounds){.current_A = {7.0, 8.0, 9.0},
                          .rms_A = {2.5, 3.5, HUGE_VAL},
                          .line_V = HUGE_VAL,
                          .mean_square_A2 = 40.0};
    program = (hci_limit_program){.bounds = &bounds, .scale_A = SCALE_A, .scale_Nm = 0.5, .widened = WIDENED};
    program.field.set = &set;
}

void tearDown(void)
{
    hci_limit_build_release(&build);
    memset(&build, 0, sizeof build);
    hci_limit_grid_release(&program.grid[0]);
    hci_limit_points_release(&program.points);
}

static void begin(hci_limit_stage stage)
{
    hci_limit_build_release(&build);
    TEST_ASSERT_TRUE(hci_limit_build_begin(&program, stage, &build));
}

static double sine_of(hci_wave w, int phase, double theta)
{
    const double x = w.order * theta - w.sequence * 2.0 * REF_PI * phase / 3.0;
    return w.sine * sin(x) + w.cosine * cos(x);
}

static double current_A(int phase, double theta)
{
    double sum = program.field.held ? sine_of(*program.field.held, phase, theta) : 0.0;
    for (int k = 0; k < COUNT; ++k)
        sum += sine_of((hci_wave){component[k].order, component[k].sequence, X[2 * k], X[2 * k + 1]}, phase,
                       theta);
    return sum;
}

static double square_A2(int phase)
{
    double sum = 0.0;
    for (int k = 0; k < SAMPLES; ++k)
        sum += pow(current_A(phase, 2.0 * REF_PI * k / SAMPLES), 2.0) / SAMPLES;
    return sum;
}

/* Right side less the row at X and, of what is minimised, OBJECTIVE. */
static double left_of(const double *row)
{
    double sum = row[build.n];
    for (size_t j = 0; j < build.n; ++j)
        sum -= row[j] * (j < build.coordinates ? X[j] / SCALE_A : j == build.coordinates ? OBJECTIVE : 0.0);
    return sum;
}

static double left(size_t row)
{
    return left_of(build.row + row * build.width);
}

/* The length of a cone's rows but for its head. */
static double length_of(size_t row, size_t rows)
{
    double square = 0.0;
    for (size_t k = 1; k < rows; ++k)
        square += left(row + k) * left(row + k);
    return sqrt(square);
}

static const hci_wave *held_of(int k)
{
    return k > 0 ? &HELD[k - 1] : NULL;
}

/* ---- heat ---- */

/* Of a phase alone: it has orders of two sequences, a direct current, and one that is held. No row for a
 * phase without a limit. */
static void test_rms_of_phases(void)
{
    for (int k = 0; k < 3; ++k)
        for (int fit = 0; fit < 2; ++fit) {
            program.field.held = held_of(k);
            begin(fit ? HCI_STAGE_FIT : HCI_STAGE_MEAN);
            hci_limit_add_rms(&build);
            TEST_ASSERT_EQUAL_UINT64(2, build.cones);
            TEST_ASSERT_EQUAL_UINT64(build.rows, build.cone[0] + build.cone[1]);
            for (int phase = 0, row = 0; phase < 2; row += (int)build.cone[phase++]) {
                hci_limit_kind kind;
                int of;
                hci_limit_of_tag(build.limit_of[row], &kind, &of);
                TEST_ASSERT_TRUE(kind == HCI_LIMIT_RMS && of == phase);
                TEST_ASSERT_EQUAL_DOUBLE(fit ? 1.0 + OBJECTIVE : 1.0, left((size_t)row));
                TEST_ASSERT_DOUBLE_WITHIN(1e-12,
                                          sqrt(square_A2(phase)) / (bounds.rms_A[phase] * (1.0 + WIDENED)),
                                          length_of((size_t)row, build.cone[phase]));
            }
        }
}

/* Of all phases: the sum of their mean squares. What makes none counts a millionth: its sine of order 0. */
static void test_copper(void)
{
    for (int k = 0; k < 3; ++k)
        for (int fit = 0; fit < 2; ++fit) {
            program.field.held = held_of(k);
            begin(fit ? HCI_STAGE_FIT : HCI_STAGE_COPPER);
            hci_limit_add_copper(&build);
            TEST_ASSERT_EQUAL_UINT64(1, build.cones);
            TEST_ASSERT_EQUAL_UINT64(build.rows, build.cone[0]);
            TEST_ASSERT_EQUAL_UINT64(hci_limit_tag(HCI_LIMIT_COPPER, 0), build.limit_of[0]);
            TEST_ASSERT_EQUAL_DOUBLE(fit ? 1.0 + OBJECTIVE : 1.0, left(0));
            TEST_ASSERT_DOUBLE_WITHIN(
                1e-12, sqrt((square_A2(0) + square_A2(1) + square_A2(2)) / 40.0) / (1.0 + WIDENED),
                length_of(0, build.rows));
        }
    TEST_ASSERT_EQUAL_DOUBLE(1e-6, hci_limit_copper_of(COMPONENT[5], 0));
    TEST_ASSERT_EQUAL_DOUBLE(2.0, hci_limit_copper_of(COMPONENT[5], 1));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_limit_copper_of(COMPONENT[3], 0));
    bounds.mean_square_A2 = HUGE_VAL;
    begin(HCI_STAGE_COPPER);
    hci_limit_add_copper(&build);
    TEST_ASSERT_EQUAL_UINT64(0, build.rows + build.cones);
}

/* ---- distance ---- */

static void test_distance_from_the_last_answer(void)
{
    double centre[2 * COUNT], square = 0.0;
    for (int j = 0; j < 2 * COUNT; ++j) {
        centre[j] = 0.1 * j - 0.4;
        square += (X[j] - centre[j]) * (X[j] - centre[j]);
    }
    program.centre = centre;
    for (int k = 0; k < 3; ++k) { /* no distance; with one; FIT has to have room */
        program.radius_A = k == 0 ? 0.0 : 1.7;
        begin(k == 2 ? HCI_STAGE_FIT : HCI_STAGE_RIPPLE);
        hci_limit_add_rms(&build);
        const size_t row = build.rows, cones = build.cones;
        hci_limit_add_trust(&build);
        TEST_ASSERT_EQUAL_UINT64(cones + (k == 1), build.cones);
        TEST_ASSERT_EQUAL_UINT64(row + (k == 1 ? 1 + 2 * COUNT : 0), build.rows);
        TEST_ASSERT_EQUAL_UINT64(k == 1 ? row + 1 : 0, build.distance);
        if (k != 1) continue;
        TEST_ASSERT_EQUAL_UINT64(1 + 2 * COUNT, build.cone[cones]);
        TEST_ASSERT_EQUAL_DOUBLE(1.0, left(row));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(square) / 1.7, length_of(row, build.cone[cones]));
    }
}

/* ---- open phases ---- */

/* Sine and cosine of each order of its current; a direct one has no sine. */
static void test_a_phase_that_is_open(void)
{
    static const double ORDER[] = {1.0, 1.0, 5.0, 5.0, 3.0, 3.0, 0.0};
    bounds.current_A[1] = 0.0;
    program.field.held = &HELD[0];
    begin(HCI_STAGE_MEAN);
    hci_limit_add_open(&build);
    TEST_ASSERT_EQUAL_UINT64(7, build.equalities);
    for (size_t q = 0; q < 7; ++q) {
        double pair = 0.0;
        for (int k = 0; k < SAMPLES; ++k) {
            const double theta = 2.0 * REF_PI * k / SAMPLES;
            const double x = q == 6 ? 0.5 : q % 2 == 0 ? sin(ORDER[q] * theta) : cos(ORDER[q] * theta);
            pair += current_A(1, theta) * x * 2.0 / SAMPLES;
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, -pair / SCALE_A, left_of(build.equal + q * build.width));
    }
}

/* ---- angles ---- */

/* A current at two angles: between both ends of its limit, of which a share is kept free; where FIT widens
 * it, by a row for each end. */
static void test_currents_at_angles(void)
{
    for (int fit = 0; fit < 2; ++fit) {
        program.field.held = &HELD[1];
        program.grids = 1;
        program.grid[0] =
            (hci_limit_grid){.kind = HCI_POINT_CURRENT, .phase = 2, .samples = 3, .period_rad = 1.2};
        TEST_ASSERT_EQUAL(HCI_OK, hci_limit_grid_make(&program.field, &program.grid[0]));
        program.grid[0].is_row[1] = program.grid[0].is_row[2] = true;
        begin(fit ? HCI_STAGE_FIT : HCI_STAGE_MEAN);
        hci_limit_add_angles(&build);
        TEST_ASSERT_EQUAL_UINT64(fit ? 4 : 2, build.rows);
        for (size_t k = 0; k < build.rows; ++k) {
            const double theta = program.grid[0].step_rad * (double)(1 + (fit ? k / 2 : k));
            const double sign = fit && k % 2 ? -1.0 : 1.0;
            const double limit = 9.0 * (1.0 + WIDENED) * (1.0 - 2e-9), share = current_A(2, theta) / limit;
            TEST_ASSERT_EQUAL_DOUBLE(theta, build.at[k].theta_rad);
            TEST_ASSERT_TRUE(build.at[k].kind == HCI_POINT_CURRENT && build.at[k].phase == 2);
            TEST_ASSERT_EQUAL_UINT64(hci_limit_tag(HCI_LIMIT_CURRENT, 2), build.limit_of[k]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-14, 1.0 - sign * share + (fit ? OBJECTIVE : 0.0), left(k));
            if (!fit) /* row·x >= low */
                TEST_ASSERT_DOUBLE_WITHIN(1e-14, 1.0 + share,
                                          build.row[k * build.width + build.n] - left(k) - build.low[k]);
        }
        hci_limit_grid_release(&program.grid[0]);
    }
}

/* A current that stays below its limit within the distance from the centre has no row: its steepest change
 * is √(2·COUNT/2) here, of sines and cosines of each component. */
static void test_currents_out_of_reach(void)
{
    const double steepest = sqrt((double)COUNT), theta = 0.3;
    const hci_limit_point point = {HCI_POINT_CURRENT, 0, theta, 0.0};
    double at_A;
    program.centre = X;
    at_A = fabs(current_A(0, theta));
    for (int beyond = 0; beyond < 2; ++beyond)
        for (int fit = 0; fit < 2; ++fit) {
            const double limit = 7.0 * (1.0 + WIDENED) * (1.0 - 2e-9), room = (limit - at_A) / steepest;
            program.radius_A = room * (beyond ? 1.0001 : 0.9999);
            program.points = (hci_limit_points){0};
            TEST_ASSERT_EQUAL(HCI_OK, hci_limit_points_add(&program.points, point));
            TEST_ASSERT_EQUAL(HCI_OK, hci_limit_points_fill(&program.field, &program.points));
            begin(fit ? HCI_STAGE_FIT : HCI_STAGE_RIPPLE);
            hci_limit_add_angles(&build);
            TEST_ASSERT_EQUAL_UINT64(fit ? 2 : beyond, build.rows);
            hci_limit_points_release(&program.points);
        }
}

/* The size of a voltage vector: a cone with a row for each axis of the plane, whose head has the multiplier.
 */
static void test_sizes_of_voltages(void)
{
    static hci_wave emf[] = {{1.0, 1, 0.2, 0.05}};
    hci_machine_data machine = {
        .pole_pairs = 2, .resistance_ohm = 0.5, .inductance_d_H = 1e-3, .inductance_q_H = 1e-3};
    const hci_solve_options options = {.speed_rad_per_s = 300.0};
    hci_voltage_model model;
    hci_note note;
    machine.model = (hci_machine){.pole_pairs = 2, .back_emf = emf, .back_emf_count = 1};
    TEST_ASSERT_EQUAL(HCI_OK, hci_voltage_model_make(&machine, &options, &model, &note));
    bounds.line_V = 90.0;
    for (int fit = 0; fit < 2; ++fit) {
        const hci_limit_point point = {HCI_POINT_VECTOR, 0, 0.8, 0.0};
        double g[8 * COUNT];
        program.field.voltage = &model;
        program.points = (hci_limit_points){0};
        TEST_ASSERT_EQUAL(HCI_OK, hci_limit_points_add(&program.points, point));
        TEST_ASSERT_EQUAL(HCI_OK, hci_limit_points_fill(&program.field, &program.points));
        begin(fit ? HCI_STAGE_FIT : HCI_STAGE_COPPER);
        hci_limit_add_angles(&build); /* no row of an angle */
        hci_limit_add_vectors(&build);
        TEST_ASSERT_TRUE(build.cones == 1 && build.cone[0] == 3 && build.rows == 3);
        TEST_ASSERT_EQUAL_DOUBLE(fit ? 1.0 + OBJECTIVE : 1.0, left(0));
        hci_limit_rows(&program.field, &point, g);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12,
                                  hci_limit_value(HCI_POINT_VECTOR, 2 * COUNT, g, X) /
                                      (90.0 * (1.0 + WIDENED) * (1.0 - 2e-9)),
                                  length_of(0, 3));
        for (size_t k = 0; k < 3; ++k) {
            TEST_ASSERT_EQUAL_UINT64(k == 0 ? hci_limit_tag(HCI_LIMIT_VOLTAGE, 0) : 0, build.limit_of[k]);
            TEST_ASSERT_EQUAL(HCI_POINT_VECTOR, build.at[k].kind);
        }
        hci_limit_points_release(&program.points);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rms_of_phases);
    RUN_TEST(test_copper);
    RUN_TEST(test_distance_from_the_last_answer);
    RUN_TEST(test_a_phase_that_is_open);
    RUN_TEST(test_currents_at_angles);
    RUN_TEST(test_currents_out_of_reach);
    RUN_TEST(test_sizes_of_voltages);
    return UNITY_END();
}
