/* Rows of the torque's orders against U x − h written out here: of each row its right side less what it makes
 * of the currents. */
#include <math.h>
#include <string.h>

#include "host/limit/rows.h"
#include "unity.h"

enum { COUNT = 3, UNKNOWNS = 2 * COUNT, ORDERS = 4, ROWS = 7 };

#define SCALE_A   3.0
#define SCALE_NM  0.7
#define OBJECTIVE 0.45
#define MEAN_NM   1.3 /* that is wanted */

/* Mean, order 6, order 12, whose sine no current reaches, and order 18, which none reaches. */
static const double U[ROWS][UNKNOWNS] = {{1.1, 0.0, -0.4, 0.3, 0.0, 0.2},
                                         {0.5, 0.2, 0.0, 0.7, 0.0, 0.0},
                                         {0.0, -0.6, 0.9, 0.0, 0.0, 0.35},
                                         {0.0},
                                         {0.0, 0.0, 0.45, 0.0, -0.8, 0.0},
                                         {0.0},
                                         {0.0}};
static const double H[2 * ROWS] = {2.5,  0.1,   -0.2, 0.3,  0.4,   0.5,  0.6,
                                   0.05, -0.15, 0.25, 0.35, -0.45, 0.55, -0.65};
static const double X[UNKNOWNS] = {1.2, -0.7, 0.9, 0.4, -0.6, 0.8};
static const double CENTRE[UNKNOWNS] = {0.3, 0.5, -0.2, 0.6, 0.7, -0.4};

static double order[ORDERS] = {0.0, 6.0, 12.0, 18.0}, weight[ROWS] = {2.5, 0.5, 0.6, 0.7, 0.8, 0.9, 1.1};
static double value[ROWS * UNKNOWNS], h[2 * ROWS];
static int64_t start[UNKNOWNS + 1], row_of[ROWS * UNKNOWNS];
static hci_harmonic_system orders;
static hci_component component[COUNT];
static hci_set name[COUNT];
static hci_component_set set;
static hci_limit_program program;
static hci_limit_build build;

/* The system of the rows of U from one on, `rows` of them. */
static void make_system(size_t from, size_t rows)
{
    int64_t entries = 0;
    for (size_t j = 0; j < UNKNOWNS; ++j) {
        start[j] = entries;
        for (size_t k = 0; k < rows; ++k)
            if (U[from + k][j] != 0.0) {
                row_of[entries] = (int64_t)k;
                value[entries++] = U[from + k][j];
            }
    }
    start[UNKNOWNS] = entries;
    for (size_t k = 0; k < rows; ++k)
        h[k] = H[from + k], h[rows + k] = H[ROWS + from + k];
    orders = (hci_harmonic_system){.order = order + (from + 1) / 2,
                                   .order_count = (rows + 1) / 2,
                                   .rows = rows,
                                   .unknowns = UNKNOWNS,
                                   .row_weight = weight + from,
                                   .h = h,
                                   .u = {rows, UNKNOWNS, start, row_of, value}};
}

void setUp(void)
{
    make_system(0, ROWS);
    set = (hci_component_set){component, name, COUNT, {{0}}};
    program = (hci_limit_program){.scale_A = SCALE_A,
                                  .scale_Nm = SCALE_NM,
                                  .minimise = HCI_MINIMISE_WORST,
                                  .centre = CENTRE,
                                  .mean_Nm = 1.15,
                                  .ripple_Nm = 0.21,
                                  .slack = 0.013};
    program.field.set = &set;
    program.field.system = &orders;
    program.field.mean_Nm = MEAN_NM;
    memset(&build, 0, sizeof build);
}

void tearDown(void)
{
    hci_limit_build_release(&build);
}

static void begin(hci_limit_stage stage)
{
    hci_limit_build_release(&build);
    TEST_ASSERT_TRUE(hci_limit_build_begin(&program, stage, &build));
}

/* Row k of U x − h, as a share of the torque. */
static double error_at(const double *x, size_t k)
{
    double sum = -MEAN_NM * H[k] - H[ROWS + k];
    for (size_t j = 0; j < UNKNOWNS; ++j)
        sum += U[k][j] * x[j];
    return sum / SCALE_NM;
}

static double error(size_t k)
{
    return error_at(X, k);
}

/* Right side less the row; behind the currents stand what is minimised and two ends. */
static double left_of(const double *row)
{
    static const double BEHIND[] = {OBJECTIVE, 0.9, 0.2};
    double sum = row[build.n];
    for (size_t j = 0; j < build.n; ++j)
        sum -= row[j] * (j < UNKNOWNS ? X[j] / SCALE_A : BEHIND[j - UNKNOWNS]);
    return sum;
}

static void is_left(double expected, size_t row)
{
    TEST_ASSERT_TRUE(row < build.rows);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected, left_of(build.row + row * build.width));
}

static void is_equation(double expected, size_t k)
{
    TEST_ASSERT_TRUE(k < build.equalities);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected, left_of(build.equal + k * build.width));
}

/* ---- the mean ---- */

static void test_the_nearest_mean(void)
{
    begin(HCI_STAGE_MEAN);
    hci_limit_add_mean(&build);
    TEST_ASSERT_EQUAL_UINT64(2, build.rows);
    is_left(OBJECTIVE - error(0) / 2.5, 0);
    is_left(OBJECTIVE + error(0) / 2.5, 1);
    make_system(1, ROWS - 1); /* not compared */
    begin(HCI_STAGE_MEAN);
    hci_limit_add_mean(&build);
    TEST_ASSERT_EQUAL_UINT64(1, build.rows);
    is_left(OBJECTIVE, 0);
}

/* As far from the wanted one as was reached, and a little further. */
static void test_the_mean_that_was_reached(void)
{
    const double means_Nm[] = {1.15, -1.6, 0.4};
    for (int k = 0; k < 3; ++k) {
        program.mean_Nm = means_Nm[k];
        const double room =
            (fabs(program.mean_Nm - MEAN_NM) + HCI_LIMIT_SLACK * fmax(SCALE_NM, fabs(means_Nm[k]))) /
            SCALE_NM;
        begin(k == 0 ? HCI_STAGE_COPPER : HCI_STAGE_RIPPLE);
        hci_limit_add_mean(&build);
        TEST_ASSERT_EQUAL_UINT64(2, build.rows);
        is_left(room - error(0) / 2.5, 0);
        is_left(room + error(0) / 2.5, 1);
    }
}

static void has_no_mean(hci_limit_stage stage)
{
    begin(stage);
    hci_limit_add_mean(&build);
    TEST_ASSERT_EQUAL_UINT64(0, build.rows);
}

static void test_stages_without_a_mean(void)
{
    has_no_mean(HCI_STAGE_FIT);
    program.has_mean = true;
    has_no_mean(HCI_STAGE_RIPPLE);
    program.has_mean = false;
    make_system(1, ROWS - 1);
    has_no_mean(HCI_STAGE_COPPER);
}

/* ---- orders ---- */

/* A cone from a row on, of the errors of two orders' rows or more. */
static void is_cone(size_t cone, size_t row, double head, const size_t *errors, size_t count)
{
    TEST_ASSERT_TRUE(cone < build.cones);
    TEST_ASSERT_EQUAL_UINT64(1 + count, build.cone[cone]);
    is_left(head, row);
    for (size_t k = 0; k < count; ++k)
        is_left(-error(errors[k]), row + 1 + k);
}

static const size_t SIX[] = {1, 2}, TWELVE[] = {3, 4}, ALL[] = {1, 2, 3, 4};

static void test_a_cone_of_each_order(void)
{
    for (int copper = 0; copper < 2; ++copper)
        for (size_t from = 0; from < 2; ++from) {
            const double head = copper ? 0.21 / SCALE_NM + 0.013 : OBJECTIVE;
            make_system(from, ROWS - from);
            begin(copper ? HCI_STAGE_COPPER : HCI_STAGE_RIPPLE);
            hci_limit_add_torque_cones(&build);
            TEST_ASSERT_EQUAL_UINT64(2, build.cones);
            TEST_ASSERT_EQUAL_UINT64(6, build.rows);
            /* COPPER has no unknown behind the currents */
            TEST_ASSERT_EQUAL_UINT64(copper ? UNKNOWNS : UNKNOWNS + 1, build.n);
            is_cone(0, 0, head, SIX, 2);
            is_cone(1, 3, head, TWELVE, 2);
        }
}

static void test_one_cone_of_all_orders(void)
{
    program.minimise = HCI_MINIMISE_RMS;
    for (size_t from = 0; from < 2; ++from) {
        make_system(from, ROWS - from);
        begin(HCI_STAGE_RIPPLE);
        hci_limit_add_torque_cones(&build);
        TEST_ASSERT_EQUAL_UINT64(1, build.cones);
        TEST_ASSERT_EQUAL_UINT64(5, build.rows);
        is_cone(0, 0, OBJECTIVE, ALL, 4);
    }
    make_system(5, 2); /* that nothing reaches */
    begin(HCI_STAGE_RIPPLE);
    hci_limit_add_torque_cones(&build);
    TEST_ASSERT_EQUAL_UINT64(0, build.cones + build.rows);
}

static void has_no_cones(hci_limit_stage stage)
{
    begin(stage);
    hci_limit_add_torque_cones(&build);
    TEST_ASSERT_EQUAL_UINT64(0, build.cones + build.rows);
}

static void test_stages_without_cones(void)
{
    has_no_cones(HCI_STAGE_FIT);
    has_no_cones(HCI_STAGE_MEAN);
    program.minimise = HCI_MINIMISE_PEAK_TO_PEAK;
    has_no_cones(HCI_STAGE_RIPPLE);
    has_no_cones(HCI_STAGE_COPPER);
    program.minimise = HCI_MINIMISE_WORST;
    program.has_ripple = true;
    has_no_cones(HCI_STAGE_COPPER);
    begin(HCI_STAGE_RIPPLE);
    hci_limit_add_torque_cones(&build);
    TEST_ASSERT_EQUAL_UINT64(2, build.cones);
}

/* ---- orders that cannot count ---- */

/* The largest error of the cone of order 12 within a radius of the centre, at most. */
static double most_Nm(double radius_A)
{
    double square = 0.0;
    for (size_t j = 0; j < UNKNOWNS; ++j)
        square += U[3][j] * U[3][j] + U[4][j] * U[4][j];
    return SCALE_NM * hypot(error_at(CENTRE, 3), error_at(CENTRE, 4)) + radius_A * sqrt(square);
}

static size_t cones_with(double idle_Nm, hci_limit_stage stage)
{
    program.idle_Nm = idle_Nm;
    begin(stage);
    hci_limit_add_torque_cones(&build);
    TEST_ASSERT_EQUAL_UINT64(3 * build.cones, build.rows);
    return build.cones;
}

/* The first is kept in any case. */
static void test_orders_that_cannot_count_are_left_out(void)
{
    for (double radius_A = 0.0; radius_A < 3.0; radius_A += 1.3) {
        program.radius_A = radius_A;
        TEST_ASSERT_EQUAL_UINT64(2, cones_with(0.999 * most_Nm(radius_A), HCI_STAGE_RIPPLE));
        TEST_ASSERT_EQUAL_UINT64(1, cones_with(1.001 * most_Nm(radius_A), HCI_STAGE_RIPPLE));
        TEST_ASSERT_EQUAL_UINT64(2, cones_with(1.001 * most_Nm(radius_A), HCI_STAGE_COPPER));
        TEST_ASSERT_EQUAL_UINT64(2, cones_with(0.0, HCI_STAGE_RIPPLE));
    }
    TEST_ASSERT_EQUAL_UINT64(1, cones_with(1e3, HCI_STAGE_RIPPLE));
    is_cone(0, 0, OBJECTIVE, SIX, 2);
}

/* ---- the swing ---- */

static void test_the_swing(void)
{
    program.minimise = HCI_MINIMISE_PEAK_TO_PEAK;
    begin(HCI_STAGE_RIPPLE);
    hci_limit_add_swing(&build);
    TEST_ASSERT_EQUAL_UINT64(1, build.rows);
    is_left(OBJECTIVE - (0.9 - 0.2), 0);
    begin(HCI_STAGE_COPPER);
    hci_limit_add_swing(&build);
    TEST_ASSERT_EQUAL_UINT64(1, build.rows);
    is_left(0.21 / SCALE_NM + 0.013 - (0.9 - 0.2), 0);
    begin(HCI_STAGE_MEAN);
    hci_limit_add_swing(&build);
    TEST_ASSERT_EQUAL_UINT64(0, build.rows);
}

/* Where no order is reached the ripple has a bound of its own. */
static void test_a_ripple_that_nothing_reaches(void)
{
    static const struct {
        size_t from, rows, bounds;
    } CASES[] = {{0, ROWS, 0}, {1, ROWS - 1, 0}, {0, 1, 1}, {5, 2, 1}, {3, 4, 0}};
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; ++c) {
        make_system(CASES[c].from, CASES[c].rows);
        begin(HCI_STAGE_RIPPLE);
        hci_limit_add_swing(&build);
        TEST_ASSERT_EQUAL_UINT64(CASES[c].bounds, build.rows);
        if (CASES[c].bounds == 1) is_left(OBJECTIVE, 0);
        begin(HCI_STAGE_COPPER);
        hci_limit_add_swing(&build);
        TEST_ASSERT_EQUAL_UINT64(0, build.rows);
    }
}

/* ---- equations ---- */

static size_t equations_of(hci_limit_stage stage, bool has_mean, bool has_ripple)
{
    program.has_mean = has_mean;
    program.has_ripple = has_ripple;
    begin(stage);
    hci_limit_add_orders(&build);
    TEST_ASSERT_EQUAL_UINT64(0, build.rows);
    return build.equalities;
}

static void test_equations_of_what_is_as_wanted(void)
{
    TEST_ASSERT_EQUAL_UINT64(5, equations_of(HCI_STAGE_COPPER, true, true));
    for (size_t k = 0; k < 5; ++k)
        is_equation(-error(k) / weight[k], k);
    TEST_ASSERT_EQUAL_UINT64(4, equations_of(HCI_STAGE_COPPER, false, true));
    for (size_t k = 0; k < 4; ++k)
        is_equation(-error(k + 1) / weight[k + 1], k);
    TEST_ASSERT_EQUAL_UINT64(1, equations_of(HCI_STAGE_RIPPLE, true, true));
    TEST_ASSERT_EQUAL_UINT64(1, equations_of(HCI_STAGE_COPPER, true, false));
    TEST_ASSERT_EQUAL_UINT64(0, equations_of(HCI_STAGE_MEAN, true, true));
    make_system(1, ROWS - 1);
    TEST_ASSERT_EQUAL_UINT64(4, equations_of(HCI_STAGE_COPPER, true, true));
    for (size_t k = 0; k < 4; ++k)
        is_equation(-error(k + 1) / weight[k + 1], k);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_nearest_mean);
    RUN_TEST(test_the_mean_that_was_reached);
    RUN_TEST(test_stages_without_a_mean);
    RUN_TEST(test_a_cone_of_each_order);
    RUN_TEST(test_one_cone_of_all_orders);
    RUN_TEST(test_stages_without_cones);
    RUN_TEST(test_orders_that_cannot_count_are_left_out);
    RUN_TEST(test_the_swing);
    RUN_TEST(test_a_ripple_that_nothing_reaches);
    RUN_TEST(test_equations_of_what_is_as_wanted);
    return UNITY_END();
}
