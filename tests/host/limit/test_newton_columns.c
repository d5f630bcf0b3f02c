/* Constraints of Newton's method against what they stand for: the highest of a current, of a voltage vector
 * and of a torque over the angle, by their sine formulas, and lengths of cones. Gradients and Hessians are
 * differences of these. */
#define hci_limit_newton       newtons_method
#define hci_limit_rest_release rest_release
#include "host/limit/newton.h"

#include "host/limit/newton.c"
#undef hci_limit_newton
#undef hci_limit_rest_release

#include "support/draws.h"
#include "unity.h"

enum { COUNT = 3, UNKNOWNS = 2 * COUNT, ORDERS = 2, ROWS = 5, KINDS = 3, SAMPLES = 180 };

#define SCALE_A  3.0
#define SCALE_NM 0.7
#define WIDENED  0.04
#define R_OHM    0.5
#define L_H      1.2e-3
#define SPEED    120.0 /* mechanical, of two pole pairs */
#define STEP_RAD (2.0 * REF_PI / SAMPLES)

static hci_component component[COUNT] = {{1.0, 1}, {5.0, -1}, {7.0, 1}};
static hci_set name[COUNT] = {HCI_SET_POS, HCI_SET_NEG, HCI_SET_POS};
static hci_wave emf[] = {{1.0, 1, 0.2, 0.0}, {5.0, -1, 0.02, 0.01}};
static const double U[ROWS][UNKNOWNS] = {{1.1, 0.0, -0.4, 0.3, 0.0, 0.2},
                                         {0.5, 0.2, 0.1, 0.7, 0.3, 0.4},
                                         {0.2, -0.6, 0.9, 0.1, 0.5, 0.35},
                                         {0.3, -0.1, 0.6, 0.25, 0.4, -0.7},
                                         {0.15, 0.35, 0.45, -0.2, -0.8, 0.1}};
static double order[] = {0.0, 6.0, 12.0}, row_weight[ROWS] = {2.5, 0.5, 0.6, 0.7, 0.8};
static double h[2 * ROWS] = {2.5, 0.1, -0.2, 0.3, 0.4, 0.05, -0.15, 0.25, 0.35, -0.45};
static const double X[UNKNOWNS + 3] = {1.6, -0.5, 0.4, 0.25, -0.3, 0.2, 0.9, 0.6, -0.4};

static double value[ROWS * UNKNOWNS];
static int64_t start[UNKNOWNS + 1], row_of[ROWS * UNKNOWNS];
static hci_harmonic_system orders;
static hci_component_set set;
static hci_bounds bounds;
static hci_machine_data machine;
static hci_solve_options options;
static hci_voltage_model model;
static hci_task task;
static hci_limit_program program;
static hci_limit_grid grid[KINDS];
static hci_limit_build build;
static hci_newton newton;

static void make_system(void)
{
    int64_t entries = 0;
    for (size_t j = 0; j < UNKNOWNS; ++j) {
        start[j] = entries;
        for (size_t k = 0; k < ROWS; ++k) {
            row_of[entries] = (int64_t)k;
            value[entries++] = U[k][j];
        }
    }
    start[UNKNOWNS] = entries;
    orders = (hci_harmonic_system){.order = order,
                                   .order_count = ORDERS + 1,
                                   .rows = ROWS,
                                   .unknowns = UNKNOWNS,
                                   .row_weight = row_weight,
                                   .h = h,
                                   .u = {ROWS, UNKNOWNS, start, row_of, value}};
}

void setUp(void)
{
    hci_note note = {{0}};
    make_system();
    memset(&machine, 0, sizeof machine);
    memset(&options, 0, sizeof options);
    memset(&task, 0, sizeof task);
    machine.pole_pairs = machine.model.pole_pairs = 2;
    machine.model.back_emf = emf;
    machine.model.back_emf_count = 2;
    machine.resistance_ohm = R_OHM;
    machine.inductance_d_H = machine.inductance_q_H = L_H;
    options.speed_rad_per_s = SPEED;
    TEST_ASSERT_EQUAL(HCI_OK, hci_voltage_model_make(&machine, &options, &model, &note));
    set = (hci_component_set){component, name, COUNT, {{0}}};
    bounds = (hci_bounds){
        .current_A = {5.0, 5.5, 6.0}, .rms_A = {3.3, HUGE_VAL, 3.9}, .line_V = 46.0, .mean_square_A2 = 30.0};
    program = (hci_limit_program){.bounds = &bounds,
                                  .scale_A = SCALE_A,
                                  .scale_Nm = SCALE_NM,
                                  .widened = WIDENED,
                                  .minimise = HCI_MINIMISE_PEAK_TO_PEAK,
                                  .task = &task,
                                  .ripple_Nm = 0.2};
    program.field =
        (hci_limit_field){.set = &set, .voltage = &model, .system = &orders, .mean_Nm = 1.3, .turns = 1};
    const hci_point_kind kinds[KINDS] = {HCI_POINT_CURRENT, HCI_POINT_VECTOR, HCI_POINT_TORQUE};
    for (int k = 0; k < KINDS; ++k) {
        grid[k] = (hci_limit_grid){
            .kind = kinds[k], .phase = k == 0 ? 1 : 0, .samples = SAMPLES, .period_rad = 2.0 * REF_PI};
        TEST_ASSERT_EQUAL(HCI_OK, hci_limit_grid_make(&program.field, &grid[k]));
        program.grid[k] = grid[k];
    }
}

void tearDown(void)
{
    end(&newton);
    hci_limit_build_release(&build);
    for (int k = 0; k < KINDS; ++k)
        hci_limit_grid_release(&grid[k]);
    memset(&newton, 0, sizeof newton);
    memset(&build, 0, sizeof build);
}

/* At X, without peaks; the grids are those that it may search. */
static void begin_at_x(hci_limit_stage stage)
{
    end(&newton);
    hci_limit_build_release(&build);
    memset(&newton, 0, sizeof newton);
    program.grids = 0;
    TEST_ASSERT_TRUE(hci_limit_build_begin(&program, stage, &build));
    hci_limit_stage_fill(&build);
    program.grids = KINDS;
    TEST_ASSERT_EQUAL(HCI_OK, begin(&build, &newton));
    memcpy(newton.x, X, newton.n * sizeof *newton.x);
    memset(newton.rest_weight, 0, newton.build.rows * sizeof *newton.rest_weight);
}

/* ---- the same by sine formulas: x over SCALE_A ---- */

static double phase_of(const double *x, int s, double theta, double by_theta[1])
{
    double sum = 0.0;
    *by_theta = 0.0;
    for (int k = 0; k < COUNT; ++k) {
        const double n = component[k].order, a = n * theta - component[k].sequence * 2.0 * REF_PI * s / 3.0;
        sum += SCALE_A * (x[2 * k] * sin(a) + x[2 * k + 1] * cos(a));
        *by_theta += SCALE_A * n * (x[2 * k] * cos(a) - x[2 * k + 1] * sin(a));
    }
    return sum;
}

static double vector_of(const double *x, double theta)
{
    double square = 0.0;
    for (int s = 0; s < 3; ++s) {
        double slope, e = 0.0;
        const double i = phase_of(x, s, theta, &slope);
        for (int k = 0; k < 2; ++k) {
            const double a = emf[k].order * theta - emf[k].sequence * 2.0 * REF_PI * s / 3.0;
            e += emf[k].sine * sin(a) + emf[k].cosine * cos(a);
        }
        const double v = R_OHM * i + 2.0 * SPEED * L_H * slope + SPEED * e;
        square += v * v;
    }
    return sqrt(2.0 * square);
}

static double torque_of(const double *x, double theta)
{
    double sum = 0.0;
    for (size_t k = 1; k < ROWS; ++k) {
        double error = -1.3 * h[k] - h[ROWS + k];
        for (size_t j = 0; j < UNKNOWNS; ++j)
            error += U[k][j] * SCALE_A * x[j];
        const double a = order[(k + 1) / 2] * theta;
        sum += error / row_weight[k] * (k % 2 ? sin(a) : cos(a));
    }
    return sum;
}

/* What a peak is of its limit, at an angle. */
static double size_of(const hci_newton_peak *p, const double *x, double theta)
{
    double ignored;
    if (p->at.kind == HCI_POINT_CURRENT)
        return fabs(phase_of(x, p->at.phase, theta, &ignored)) /
               (bounds.current_A[p->at.phase] * (1.0 + WIDENED));
    if (p->at.kind == HCI_POINT_VECTOR) return vector_of(x, theta) / (bounds.line_V * (1.0 + WIDENED));
    const double sign = p->at.phase == 0 ? 1.0 : -1.0;
    return sign * (torque_of(x, theta) / SCALE_NM - x[UNKNOWNS + 1 + p->at.phase]);
}

/* The top of it within two samples of an angle. */
static double top_of(const hci_newton_peak *p, const double *x, double near_rad, double *at_rad)
{
    double low = near_rad - 2.0 * STEP_RAD, high = near_rad + 2.0 * STEP_RAD;
    while (high - low > 1e-10) {
        const double third = (high - low) / 3.0;
        if (size_of(p, x, low + third) < size_of(p, x, high - third))
            low += third;
        else
            high -= third;
    }
    *at_rad = 0.5 * (low + high);
    return size_of(p, x, *at_rad);
}

/* The angle of the highest of all. */
static double highest_of(const hci_newton_peak *p)
{
    double best = 0.0, at;
    for (int k = 0; k < SAMPLES; ++k)
        if (size_of(p, X, k * STEP_RAD) > size_of(p, X, best)) best = k * STEP_RAD;
    top_of(p, X, best, &at);
    return at;
}

static void add_peak(int kind, int end_of_range, double off_samples, double weight)
{
    static hci_newton_peak peak[8];
    hci_newton_peak p = {
        {program.grid[kind].kind, kind == 0 ? 1 : end_of_range, 0.0, 0.0}, &grid[kind], weight};
    p.at.theta_rad = highest_of(&p) + off_samples * STEP_RAD;
    hci_newton_peak *more = hci_memory_resize(newton.peak, newton.peaks + 1, sizeof *peak);
    TEST_ASSERT_NOT_NULL(more);
    newton.peak = more;
    newton.peak[newton.peaks++] = p;
}

/* ---- differences ---- */

typedef double function(const double *x, size_t which);

static double peak_value(const double *x, size_t which)
{
    double ignored;
    const hci_newton_peak *p = &newton.peak[which];
    return top_of(p, x, p->at.theta_rad, &ignored);
}

/* |u_1 …| − u_0 of a cone that begins with row `which`. */
static double cone_value(const double *x, size_t which)
{
    const hci_limit_build *b = &newton.build;
    double square = 0.0, head = 0.0;
    size_t cone = 0, at = b->linear;
    for (; at != which; at += b->cone[cone++])
        TEST_ASSERT_TRUE(cone < b->cones);
    for (size_t k = 0; k < b->cone[cone]; ++k) {
        const double *row = b->row + (at + k) * b->width;
        double u = row[b->n];
        for (size_t j = 0; j < b->n; ++j)
            u -= row[j] * x[j];
        if (k == 0)
            head = u;
        else
            square += u * u;
    }
    return sqrt(square) - head;
}

static double by_one(function *f, size_t which, size_t j)
{
    double x[UNKNOWNS + 3], end[2];
    for (int side = 0; side < 2; ++side) {
        memcpy(x, newton.x, newton.n * sizeof *x);
        x[j] += side ? 1e-5 : -1e-5;
        end[side] = f(x, which);
    }
    return (end[1] - end[0]) / 2e-5;
}

static double by_two(function *f, size_t which, size_t i, size_t j)
{
    const double step = 2e-3;
    double x[UNKNOWNS + 3], sum = 0.0;
    for (int a = -1; a <= 1; a += 2)
        for (int b = -1; b <= 1; b += 2) {
            memcpy(x, newton.x, newton.n * sizeof *x);
            x[i] += a * step;
            x[j] += b * step;
            sum += a * b * f(x, which);
        }
    return sum / (4.0 * step * step);
}

/* ---- peaks ---- */

/* Each column has the value and the gradient of its constraint; H is that of the sum of all, with their
 * weights, beside what pulls to the last currents. Tops are found by differences over a tenth of a sample, so
 * that their angles are some 1e-5 off, and gradients 1e-4. */
static void test_columns_of_peaks(void)
{
    double f[UNKNOWNS + 3];
    begin_at_x(HCI_STAGE_RIPPLE);
    add_peak(0, 0, 0.0, 0.7);
    add_peak(1, 0, 0.0, 0.4);
    add_peak(2, 0, 0.0, 0.3);
    add_peak(2, 1, 0.0, 0.9);
    TEST_ASSERT_EQUAL(HCI_OK, hci_newton_linearise(&newton, f));
    TEST_ASSERT_FALSE(newton.has_failed);
    for (size_t q = 0; q < 4; ++q) {
        const double margin = q < 2 ? 1.0 - 2.0 * HCI_LIMIT_MARGIN : 0.0;
        TEST_ASSERT_EQUAL_UINT64(q, newton.act.row[q]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-7, peak_value(newton.x, q) - margin, newton.act.beyond[q]);
        TEST_ASSERT_EQUAL_DOUBLE(newton.peak[q].weight, newton.act.weight[q]);
        TEST_ASSERT_FALSE(newton.act.is_equation[q]);
        for (size_t j = 0; j < newton.n; ++j) {
            const double by = by_one(peak_value, q, j);
            TEST_ASSERT_DOUBLE_WITHIN(1e-3 * (1.0 + fabs(by)), by, newton.act.gradient[q * newton.n + j]);
        }
    }
    for (size_t j = 0; j < newton.n; ++j)
        for (size_t i = j; i < newton.n; ++i) {
            double sum = i == j ? 1e-5 : 0.0;
            for (size_t q = 0; q < 4; ++q)
                sum += newton.peak[q].weight * by_two(peak_value, q, i, j);
            TEST_ASSERT_DOUBLE_WITHIN(3e-3 * (1.0 + fabs(sum)), sum, newton.hessian[j * newton.n + i]);
        }
    for (size_t j = 0; j < newton.n; ++j)
        TEST_ASSERT_EQUAL_DOUBLE(j == UNKNOWNS ? 1.0 : 0.0, f[j]);
}

/* From some samples off a peak is followed to its top. */
static void test_peaks_are_followed(void)
{
    for (int off = -5; off <= 5; ++off) {
        double f[UNKNOWNS + 3], at;
        begin_at_x(HCI_STAGE_RIPPLE);
        for (int kind = 0; kind < KINDS; ++kind) {
            add_peak(kind, 0, 0.0, 0.0);
            newton.peak[kind].at.theta_rad += 0.6 * off * STEP_RAD * (kind == 2 ? 0.4 : 1.0);
        }
        TEST_ASSERT_EQUAL(HCI_OK, hci_newton_linearise(&newton, f));
        for (size_t q = 0; q < KINDS; ++q) {
            top_of(&newton.peak[q], X, highest_of(&newton.peak[q]), &at);
            TEST_ASSERT_DOUBLE_WITHIN(0.12 * STEP_RAD, at, newton.peak[q].at.theta_rad);
        }
    }
}

/* A peak without a weight is a column where it is beyond its limit, and bends nothing. */
static void test_peaks_without_a_weight(void)
{
    double f[UNKNOWNS + 3];
    for (int inside = 0; inside < 2; ++inside) {
        begin_at_x(HCI_STAGE_RIPPLE);
        bounds.current_A[1] = inside ? 50.0 : 1.0;
        add_peak(0, 0, 0.0, 0.0);
        TEST_ASSERT_EQUAL(HCI_OK, hci_newton_linearise(&newton, f));
        TEST_ASSERT_EQUAL(!inside, newton.act.count > 0 && newton.act.row[0] == 0);
        for (size_t j = 0; j < newton.n; ++j)
            for (size_t i = j; i < newton.n; ++i)
                TEST_ASSERT_EQUAL_DOUBLE(i == j ? 1e-5 : 0.0, newton.hessian[j * newton.n + i]);
    }
}

/* ---- cones and the copper ---- */

/* What a square of a coordinate counts: more of what turns fast against the rotor. */
static double price_of(size_t j)
{
    return 1.0 + task.rotor_price * pow(component[j / 2].order - component[j / 2].sequence, 8.0);
}

/* Rms of two phases, the copper and two orders as cones, whose heads are the ripple that is kept, or that is
 * minimised; f and H of what else there is. */
static void check_cones(hci_limit_stage stage)
{
    double f[UNKNOWNS + 3], hessian[UNKNOWNS + 1][UNKNOWNS + 1] = {{0.0}};
    const bool copper = stage == HCI_STAGE_COPPER;
    size_t columns = 0;
    begin_at_x(stage);
    const hci_limit_build *b = &newton.build;
    TEST_ASSERT_EQUAL_UINT64(5, b->cones);
    TEST_ASSERT_EQUAL_UINT64(copper ? UNKNOWNS : UNKNOWNS + 1, newton.n);
    for (size_t k = 0, at = b->linear; k < b->cones; at += b->cone[k++])
        newton.rest_weight[at] = 0.3 + 0.2 * (double)k;
    TEST_ASSERT_EQUAL(HCI_OK, hci_newton_linearise(&newton, f));
    for (size_t q = 0; q < newton.act.count; ++q) {
        const size_t row = newton.act.row[q];
        if (row < b->linear || newton.act.is_equation[q]) continue;
        ++columns;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, cone_value(newton.x, row), newton.act.beyond[q]);
        TEST_ASSERT_EQUAL_DOUBLE(newton.rest_weight[row], newton.act.weight[q]);
        for (size_t j = 0; j < newton.n; ++j) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-7, by_one(cone_value, row, j),
                                      newton.act.gradient[q * newton.n + j]);
            for (size_t i = j; i < newton.n; ++i)
                hessian[i][j] += newton.rest_weight[row] * by_two(cone_value, row, i, j);
        }
    }
    TEST_ASSERT_EQUAL_UINT64(5, columns);
    for (size_t j = 0; j < newton.n; ++j) {
        const double price = copper ? price_of(j) : 1e-5;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, copper ? price * X[j] : j == UNKNOWNS ? 1.0 : 0.0, f[j]);
        for (size_t i = j; i < newton.n; ++i)
            TEST_ASSERT_DOUBLE_WITHIN(1e-4, hessian[i][j] + (i == j ? price : 0.0),
                                      newton.hessian[j * newton.n + i]);
    }
}

static void test_columns_of_cones(void)
{
    program.minimise = HCI_MINIMISE_WORST;
    task.rotor_price = 1e-7;
    check_cones(HCI_STAGE_COPPER);
    check_cones(HCI_STAGE_RIPPLE);
}

/* The mean that was reached, from both sides, and the swing: the rows themselves, where they act or are not
 * kept. */
static void test_columns_of_lines(void)
{
    double f[UNKNOWNS + 3];
    program.mean_Nm = 1.2;
    for (int acts = 0; acts < 2; ++acts) {
        size_t q = 0;
        begin_at_x(HCI_STAGE_RIPPLE);
        const hci_limit_build *b = &newton.build;
        TEST_ASSERT_EQUAL_UINT64(3, b->linear);
        for (size_t k = 0; k < 3 && acts; ++k)
            newton.rest_weight[k] = 0.2 + 0.1 * (double)k;
        TEST_ASSERT_EQUAL(HCI_OK, hci_newton_linearise(&newton, f));
        for (size_t k = 0; k < 3; ++k) {
            const double *row = b->row + k * b->width;
            double beyond = -row[b->n];
            for (size_t j = 0; j < b->n; ++j)
                beyond += row[j] * newton.x[j];
            if (!acts && beyond < 0.0) continue;
            TEST_ASSERT_EQUAL_UINT64(k, newton.act.row[q]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, beyond, newton.act.beyond[q]);
            TEST_ASSERT_EQUAL_DOUBLE(newton.rest_weight[k], newton.act.weight[q]);
            TEST_ASSERT_EQUAL_MEMORY(row, newton.act.gradient + q++ * newton.n, newton.n * sizeof *row);
        }
        TEST_ASSERT_TRUE(acts ? q == 3 : q > 0 && q < 3);
        for (size_t j = 0; j < newton.n; ++j)
            TEST_ASSERT_EQUAL_DOUBLE(1e-5, newton.hessian[j * (newton.n + 1)]);
    }
}

/* The mean that is as wanted, and orders that are. */
static void test_columns_of_equations(void)
{
    double f[UNKNOWNS + 3];
    program.minimise = HCI_MINIMISE_WORST;
    program.has_mean = program.has_ripple = true;
    begin_at_x(HCI_STAGE_COPPER);
    TEST_ASSERT_EQUAL(HCI_OK, hci_newton_linearise(&newton, f));
    size_t equation = 0;
    for (size_t q = 0; q < newton.act.count; ++q) {
        if (!newton.act.is_equation[q]) continue;
        double error = -1.3 * h[equation] - h[ROWS + equation];
        for (size_t j = 0; j < UNKNOWNS; ++j) {
            error += U[equation][j] * SCALE_A * X[j];
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, U[equation][j] * SCALE_A / SCALE_NM / row_weight[equation],
                                      newton.act.gradient[q * newton.n + j]);
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, error / SCALE_NM / row_weight[equation], newton.act.beyond[q]);
        TEST_ASSERT_EQUAL_UINT64(newton.build.rows + equation, newton.act.row[q]);
        ++equation;
    }
    TEST_ASSERT_EQUAL_UINT64(ROWS, equation);
}

/* ---- what is taken up, and what is dropped ---- */

/* Of a multiplier and the room of its constraint the larger one stays. */
static void test_slack_is_dropped(void)
{
    for (int more = 0; more < 2; ++more) {
        double g[UNKNOWNS + 3], square = 0.0;
        begin_at_x(HCI_STAGE_RIPPLE);
        bounds.current_A[1] = 8.0;
        add_peak(0, 0, 0.0, 0.0);
        hci_newton_peak *p = &newton.peak[0];
        const double room = 1.0 - size_of(p, X, p->at.theta_rad);
        TEST_ASSERT_TRUE(room > 0.05);
        for (size_t j = 0; j < newton.n; ++j)
            square += pow(g[j] = by_one(peak_value, 0, j), 2.0);
        p->weight = (more ? 1.01 : 0.99) * room / square;
        hci_newton_drop_slack(&newton);
        TEST_ASSERT_EQUAL(more, p->weight > 0.0);
    }
}

/* Every local top of what is limited, but for a share, once. */
static void test_peaks_that_are_found(void)
{
    size_t added, expected = 0;
    program.grids = 1;
    begin_at_x(HCI_STAGE_RIPPLE);
    program.grids = 1;
    bounds.current_A[1] = 3.0;
    const hci_newton_peak p = {{HCI_POINT_CURRENT, 1, 0.0, 0.0}, &grid[0], 0.0};
    for (int k = 0; k < 20 * SAMPLES; ++k) {
        const double fine = STEP_RAD / 20.0, here = size_of(&p, X, k * fine);
        expected +=
            here >= size_of(&p, X, (k - 1) * fine) && here > size_of(&p, X, (k + 1) * fine) && here > 0.95;
    }
    TEST_ASSERT_TRUE(expected >= 2);
    TEST_ASSERT_EQUAL(HCI_OK, hci_newton_search(&newton, 0.05, &added));
    TEST_ASSERT_EQUAL_UINT64(expected, added);
    TEST_ASSERT_EQUAL_UINT64(expected, newton.peaks);
    for (size_t q = 0; q < newton.peaks; ++q) {
        double at;
        top_of(&newton.peak[q], X, newton.peak[q].at.theta_rad, &at);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, at, newton.peak[q].at.theta_rad);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, newton.peak[q].weight);
        TEST_ASSERT_EQUAL_PTR(&program.grid[0], newton.peak[q].grid);
    }
    TEST_ASSERT_EQUAL(HCI_OK, hci_newton_search(&newton, 0.05, &added));
    TEST_ASSERT_EQUAL_UINT64(0, added);
}

/* A torque has tops at both ends of its range. */
static void test_peaks_of_a_torque(void)
{
    size_t added, upper = 0;
    begin_at_x(HCI_STAGE_RIPPLE);
    newton.x[UNKNOWNS + 1] = 0.3;
    newton.x[UNKNOWNS + 2] = -0.2;
    TEST_ASSERT_EQUAL(HCI_OK, hci_newton_search(&newton, 0.0, &added));
    for (size_t q = 0; q < newton.peaks; ++q) {
        const hci_newton_peak *p = &newton.peak[q];
        if (p->at.kind != HCI_POINT_TORQUE) continue;
        const double torque = torque_of(X, p->at.theta_rad) / SCALE_NM;
        TEST_ASSERT_EQUAL(p->at.phase == 0, torque > 0.05);
        TEST_ASSERT_TRUE(p->at.phase == 0 ? torque > 0.3 : torque < -0.2);
        upper += p->at.phase == 0;
    }
    TEST_ASSERT_TRUE(upper > 0 && upper < newton.peaks);
}

/* The nearest of its kind and phase, within 16 samples, over the end of the period too. */
static void test_which_peak_a_point_belongs_to(void)
{
    begin_at_x(HCI_STAGE_RIPPLE);
    add_peak(0, 0, 0.0, 0.0);
    add_peak(0, 0, 0.0, 0.0);
    newton.peak[0].at.theta_rad = 3.0 * STEP_RAD;
    newton.peak[1].at.theta_rad = 13.0 * STEP_RAD;
    const struct {
        double samples;
        int phase, peak;
    } CASES[] = {{7.5, 1, 0},   {8.5, 1, 1},    {28.5, 1, 1},           {29.5, 1, -1},
                 {-12.5, 1, 0}, {-13.5, 1, -1}, {SAMPLES - 12.5, 1, 0}, {SAMPLES - 13.5, 1, -1},
                 {7.5, 0, -1}};
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; ++c) {
        const hci_limit_point at = {HCI_POINT_CURRENT, CASES[c].phase, CASES[c].samples * STEP_RAD, 0.0};
        TEST_ASSERT_EQUAL_PTR(CASES[c].peak < 0 ? NULL : &newton.peak[CASES[c].peak],
                              hci_newton_peak_of(&newton, &at));
    }
    const hci_limit_point other = {HCI_POINT_VECTOR, 1, 3.0 * STEP_RAD, 0.0};
    TEST_ASSERT_NULL(hci_newton_peak_of(&newton, &other));
}

static void test_ranges_and_what_is_asked(void)
{
    double range[2];
    begin_at_x(HCI_STAGE_RIPPLE);
    hci_newton_range_of(&newton, &grid[0], 0.1, range);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.9 * 5.5 * (1.0 + WIDENED), range[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.9 * 5.5 * (1.0 + WIDENED), range[0]);
    hci_newton_range_of(&newton, &grid[2], 0.1, range); /* 0.6 and −0.4 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, SCALE_NM * 0.5, range[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -SCALE_NM * 0.3, range[0]);
    for (int stage = HCI_STAGE_MEAN; stage <= HCI_STAGE_COPPER; ++stage)
        for (int has_ripple = 0; has_ripple < 2; ++has_ripple) {
            program.has_ripple = has_ripple == 1;
            build.stage = (hci_limit_stage)stage;
            TEST_ASSERT_TRUE(hci_newton_is_asked(&newton, &grid[0]));
            TEST_ASSERT_EQUAL(stage == HCI_STAGE_RIPPLE || (stage == HCI_STAGE_COPPER && !has_ripple),
                              hci_newton_is_asked(&newton, &grid[2]));
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_columns_of_peaks);
    RUN_TEST(test_peaks_are_followed);
    RUN_TEST(test_peaks_without_a_weight);
    RUN_TEST(test_columns_of_cones);
    RUN_TEST(test_columns_of_lines);
    RUN_TEST(test_columns_of_equations);
    RUN_TEST(test_slack_is_dropped);
    RUN_TEST(test_peaks_that_are_found);
    RUN_TEST(test_peaks_of_a_torque);
    RUN_TEST(test_which_peak_a_point_belongs_to);
    RUN_TEST(test_ranges_and_what_is_asked);
    return UNITY_END();
}
