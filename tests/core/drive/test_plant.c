/* The plant against closed forms and conservation laws; plant_machine.h has the machine's formulas. */
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "hci/drive/plant.h"
#include "support/plant_machine.h"
#include "support/reference.h"
#include "unity.h"

enum { POINTS = 16384 };

static double rows[12 * (POINTS + 1)];
static pm_lists lists;
static hci_plant plant;

void setUp(void)
{
    memset(&plant, 0, sizeof plant);
    plant.resistance_ohm = 1.5;
    plant.inertia_kgm2 = 0.01;
}

void tearDown(void)
{
}

static void use_machine(const pm_machine *m, size_t points)
{
    pm_list(m, &lists);
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_plant_table_fill(&lists.machine, &lists.given, points, rows, &plant.table));
}

/* ---- table ---- */

/* uᵀLu of the phase formulas, u the orthonormal α or β vector. */
static double plane_entry(const pm_machine *m, double (*entry)(const pm_machine *, int, int, double), int a,
                          int b, double theta)
{
    static const double axis[2][3] = {{2.0, -1.0, -1.0}, {0.0, 1.0, -1.0}};
    static const double square[2] = {6.0, 2.0};
    double sum = 0.0;
    for (int r = 0; r < 3; ++r)
        for (int t = 0; t < 3; ++t)
            sum += axis[a][r] * entry(m, r, t, theta) * axis[b][t];
    return sum / sqrt(square[a] * square[b]);
}

/* Errors of e (by its highest order 13), T_cog (36), L (12) and, one power lower, L'. */
static void assert_point(const pm_machine *m, const hci_plant_point *p, double theta, double step)
{
    const double e[3] = {pm_emf(m, 0, theta), pm_emf(m, 1, theta), pm_emf(m, 2, theta)};
    static const int index[3][2] = {{0, 0}, {0, 1}, {1, 1}};
    double plane[2];
    hci_plane_from_abc(e, plane);
    TEST_ASSERT_DOUBLE_WITHIN(pow(13.0 * step, 4) / 384.0, plane[0], p->magnetic.e[0]);
    TEST_ASSERT_DOUBLE_WITHIN(pow(13.0 * step, 4) / 384.0, plane[1], p->magnetic.e[1]);
    TEST_ASSERT_DOUBLE_WITHIN(0.3 * pow(36.0 * step, 4) / 384.0, pm_cogging(m, theta),
                              p->magnetic.cogging_Nm);
    for (int k = 0; k < 3; ++k) {
        const double l = plane_entry(m, pm_inductance, index[k][0], index[k][1], theta);
        const double dl =
            m->pole_pairs * plane_entry(m, pm_inductance_slope, index[k][0], index[k][1], theta);
        TEST_ASSERT_DOUBLE_WITHIN(0.001 * pow(12.0 * step, 4), l, p->inductance_H[k]);
        TEST_ASSERT_DOUBLE_WITHIN(0.01 * pow(12.0 * step, 3), dl, p->magnetic.slope[k]);
    }
    TEST_ASSERT_EQUAL_DOUBLE(0.0, p->shaft_Nm);
}

static void test_table_follows_the_formulas(void)
{
    uint64_t seed = 1;
    use_machine(&PM_INTERIOR, 1000);
    TEST_ASSERT_EQUAL_INT(1, plant.table.turns);
    for (int k = 0; k < 2000; ++k) {
        const double theta_m = ref_uniform(&seed, -20.0, 20.0);
        const hci_plant_point p = hci_plant_table_at(&plant.table, theta_m);
        assert_point(&PM_INTERIOR, &p, 2.0 * theta_m, 2.0 * REF_PI / 1000.0);
    }
}

/* L' must be the derivative of the very L that is used, or energy is not conserved: central difference, h =
 * 1e-6 of a table whose third derivative is below 1e3: 1e3·1e-12/6 + rounding 1e-17/1e-6. */
static void test_slope_is_the_derivative_of_the_interpolant(void)
{
    uint64_t seed = 2;
    use_machine(&PM_INTERIOR, 128);
    for (int k = 0; k < 500; ++k) {
        const double x = ref_uniform(&seed, 0.01, 6.2), h = 1e-6;
        const hci_plant_point a = hci_plant_table_at(&plant.table, x - h),
                              b = hci_plant_table_at(&plant.table, x + h);
        const hci_plant_point p = hci_plant_table_at(&plant.table, x);
        const double turns = x * plant.table.points_per_rad;
        if (fabs(turns - floor(turns + 0.5)) < 1e-3) continue; /* a knot, where L'' jumps */
        for (int l = 0; l < 3; ++l)
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, (b.inductance_H[l] - a.inductance_H[l]) / (2.0 * h),
                                      p.magnetic.slope[l]);
    }
}

static void test_fractional_orders_span_the_mechanical_turn(void)
{
    const hci_harmonic cogging[2] = {hci_harmonic_polar(0.5, 0.1, 0.3), hci_harmonic_polar(5.5, 0.2, 1.0)};
    pm_list(&PM_SMOOTH, &lists);
    lists.machine.cogging = cogging;
    lists.machine.cogging_count = 2;
    TEST_ASSERT_EQUAL_INT(2, hci_plant_table_turns(&lists.machine, &lists.given));
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_plant_table_fill(&lists.machine, &lists.given, 4096, rows, &plant.table));
    for (int k = -50; k < 100; ++k) {
        const double theta_m = 0.1 * k, theta = 2.0 * theta_m;
        const double expected = 0.1 * sin(0.5 * theta + 0.3) + 0.2 * sin(5.5 * theta + 1.0);
        const hci_plant_point p = hci_plant_table_at(&plant.table, theta_m);
        /* (5.5·2π·2/4096)⁴/384 = 2e-10 */
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, expected, p.magnetic.cogging_Nm);
    }
}

/* Whatever the memory held. */
static void test_every_row_is_filled(void)
{
    enum { FEW = 16 };
    pm_list(&PM_SMOOTH, &lists);
    for (size_t k = 0; k < hci_plant_table_size(FEW); ++k)
        rows[k] = NAN;
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_plant_table_fill(&lists.machine, &lists.given, FEW, rows, &plant.table));
    for (size_t k = 0; k < hci_plant_table_size(FEW); ++k)
        TEST_ASSERT_FALSE(isnan(rows[k]));
}

static void test_table_refuses(void)
{
    const hci_harmonic third = hci_harmonic_polar(1.0 / 3.0, 0.1, 0.0), bad = {2.0, NAN, 0.0};
    hci_plant_inductance none = {NULL, 0, 0.0, 0.0};
    hci_plant_table untouched = plant.table;
    pm_list(&PM_SMOOTH, &lists);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT,
                          hci_plant_table_fill(&lists.machine, &lists.given, 3, rows, &plant.table));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR,
                          hci_plant_table_fill(&lists.machine, &none, 64, rows, &plant.table));
    lists.machine.cogging = &third;
    TEST_ASSERT_EQUAL_INT(0, hci_plant_table_turns(&lists.machine, &lists.given));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT,
                          hci_plant_table_fill(&lists.machine, &lists.given, 64, rows, &plant.table));
    lists.machine.cogging = &bad;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_NOT_FINITE,
                          hci_plant_table_fill(&lists.machine, &lists.given, 64, rows, &plant.table));
    TEST_ASSERT_EQUAL_MEMORY(&untouched, &plant.table, sizeof untouched);
}

/* An order that is whole in no turn, wherever it stands; below 0; no pole pairs; more rows than an int
 * counts; an inductance below 0 in both axes, whose determinant is above. */
static void test_table_refuses_each_alone(void)
{
    const hci_inductance odd = {.order = 0.3}, last_odd[2] = {{.order = 2.0}, {.order = 0.3}};
    const hci_wave waves[3] = {{1.0, 1, 0.5, 0.0}, {0.3, 1, 0.1, 0.0}, {1.0, 1, 0.5, 0.0}};
    const hci_harmonic below = {-2.0, 0.1, 0.0}, last_half[2] = {{6.0, 0.1, 0.0}, {0.5, 0.1, 0.0}};
    const hci_plant_inductance negative = {NULL, 0, -0.02, -0.01}, given = {NULL, 0, 0.02, 0.01};
    const hci_plant_inductance other = {&odd, 1, 0.02, 0.01}, last = {last_odd, 2, 0.02, 0.01};
    hci_machine machine = {.pole_pairs = 2, .back_emf = waves, .back_emf_count = 1};
    TEST_ASSERT_EQUAL_INT(1, hci_plant_table_turns(&machine, &given));
    TEST_ASSERT_EQUAL_INT(0, hci_plant_table_turns(&machine, &other));
    TEST_ASSERT_EQUAL_INT(0, hci_plant_table_turns(&machine, &last));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_plant_table_fill(&machine, &given, 4, rows, &plant.table));
    TEST_ASSERT_EQUAL_UINT(12 * 5, hci_plant_table_size(4));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR,
                          hci_plant_table_fill(&machine, &negative, 64, rows, &plant.table));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT,
                          hci_plant_table_fill(&machine, &given, INT_MAX / 12 + 1, rows, &plant.table));
    machine.back_emf_count = 2;
    TEST_ASSERT_EQUAL_INT(0, hci_plant_table_turns(&machine, &given));
    machine.back_emf = waves + 1;
    TEST_ASSERT_EQUAL_INT(0, hci_plant_table_turns(&machine, &given));
    machine.back_emf = waves;
    machine.back_emf_count = 1;
    machine.cogging = &below;
    machine.cogging_count = 1;
    TEST_ASSERT_EQUAL_INT(0, hci_plant_table_turns(&machine, &given));
    machine.cogging = last_half; /* whole over both pole pairs, not over one */
    machine.cogging_count = 2;
    TEST_ASSERT_EQUAL_INT(2, hci_plant_table_turns(&machine, &given));
    machine.cogging_count = 0;
    machine.pole_pairs = 0;
    TEST_ASSERT_EQUAL_INT(0, hci_plant_table_turns(&machine, &given));
}

/* A state that is not a number any more must not read outside the table: for the address sanitizer. */
static void test_any_angle_stays_within_the_table(void)
{
    static const double angles[] = {NAN,
                                    INFINITY,
                                    -INFINITY,
                                    1e300,
                                    -1e300,
                                    1e9,
                                    -0.0,
                                    -1e-300,
                                    6.283185307179586,
                                    6.2831853071795856,
                                    12.566370614359172,
                                    -6.283185307179586,
                                    3.1415926535897931};
    use_machine(&PM_INTERIOR, 999);
    for (size_t k = 0; k < sizeof angles / sizeof *angles; ++k) {
        const hci_plant_point p = hci_plant_table_at(&plant.table, angles[k]);
        TEST_ASSERT_TRUE(isfinite(p.inductance_H[0]));
    }
}

/* Nor may it keep the search for a rotor's rest from ending. */
static void test_a_state_that_is_not_a_number_ends_its_step(void)
{
    const double bad[2] = {NAN, 0.0};
    hci_plant_state y = {{0.0, 0.0}, 1.0, 0.0, 0.0};
    use_machine(&PM_INTERIOR, 256);
    plant.coulomb_Nm = 0.1;
    for (int k = 0; k < 3; ++k)
        hci_plant_step(&plant, &y, bad, 0.0, 1e-3);
    TEST_ASSERT_TRUE(isnan(y.speed_rad_per_s));
}

/* Constant L_d, L_q: L_αα = L_d cos² + L_q sin², whose derivative gives T = p (L_d − L_q) i_d i_q. */
static void test_saliency_from_constants(void)
{
    const hci_plant_inductance given = {NULL, 0, 0.03, 0.05};
    pm_list(&PM_SINE, &lists);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_plant_table_fill(&lists.machine, &given, 4096, rows, &plant.table));
    TEST_ASSERT_TRUE(plant.table.salient);
    for (int k = 0; k < 20; ++k) {
        const double theta = 0.3 * k, s = sin(theta), c = cos(theta), d = -3.0, q = 4.0;
        const hci_plant_state state = {{s * q - c * d, -s * d - c * q}, 0.0, theta / 3.0, 0.0};
        const double expected = 3.0 * (0.03 - 0.05) * d * q + sqrt(1.5) * 0.9 * q;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, expected, hci_plant_torque_Nm(&plant, &state));
    }
}

/* ---- order and energy ---- */

static const double VOLTAGE[2] = {14.0, 9.0};

static hci_plant_state run(size_t steps, double total_s)
{
    hci_plant_state y = {{1.0, -2.0}, 12.0, 0.4, 0.0};
    for (size_t k = 0; k < steps; ++k)
        hci_plant_step(&plant, &y, VOLTAGE, 0.3, total_s / (double)steps);
    return y;
}

static double distance(const hci_plant_state *a, const hci_plant_state *b)
{
    const double speed = a->speed_rad_per_s - b->speed_rad_per_s;
    const double angle = 10.0 * (hci_plant_angle_rad(a) - hci_plant_angle_rad(b));
    return sqrt(pow(a->i[0] - b->i[0], 2) + pow(a->i[1] - b->i[1], 2) + speed * speed + angle * angle);
}

static void test_order_is_four(void)
{
    hci_plant_state y[5];
    use_machine(&PM_SMOOTH, POINTS);
    plant.viscous_Nms = 0.01;
    for (int k = 0; k < 5; ++k)
        y[k] = run((size_t)(100 << k), 0.2);
    for (int k = 0; k < 3; ++k) {
        const double order = log2(distance(&y[k], &y[k + 1]) / distance(&y[k + 1], &y[k + 2]));
        TEST_ASSERT_DOUBLE_WITHIN(0.2, 4.0, order);
    }
    /* and it converges to where the finest run is: the next difference is 16 times smaller */
    TEST_ASSERT_TRUE(distance(&y[3], &y[4]) < 1e-6);
}

static double magnetic_energy(const hci_plant_state *y)
{
    const hci_plant_point p = hci_plant_at(&plant, y);
    const double *l = p.inductance_H;
    return 0.5 * l[0] * y->i[0] * y->i[0] + l[1] * y->i[0] * y->i[1] + 0.5 * l[2] * y->i[1] * y->i[1];
}

/* −∫T_cog dθ_m by its formula. */
static double cogging_potential(const pm_machine *m, double theta_m)
{
    double sum = 0.0;
    for (size_t k = 0; k < m->cogging_count; ++k) {
        const double n = m->cogging[k].order * m->pole_pairs;
        sum += m->cogging[k].amplitude / n * cos(n * theta_m + m->cogging[k].phase);
    }
    return sum;
}

static double stored_energy(const pm_machine *m, const hci_plant_state *y)
{
    return magnetic_energy(y) + 0.5 * plant.inertia_kgm2 * y->speed_rad_per_s * y->speed_rad_per_s +
           cogging_potential(m, hci_plant_angle_rad(y));
}

static double power_in(const hci_plant_state *y, double load_Nm)
{
    const double r = plant.resistance_ohm, w = y->speed_rad_per_s;
    return VOLTAGE[0] * y->i[0] + VOLTAGE[1] * y->i[1] - r * (y->i[0] * y->i[0] + y->i[1] * y->i[1]) -
           plant.viscous_Nms * w * w - load_Nm * w;
}

/* Energy in by Simpson's rule over pairs of steps, less what is stored: falls as h⁴ as both the method and
 * the rule do. */
static double energy_defect(const pm_machine *m, int pairs, double total_s)
{
    hci_plant_state y = {{1.0, -2.0}, 12.0, 0.4, 0.0};
    const double h = 0.5 * total_s / pairs, before = stored_energy(m, &y);
    double in = 0.0;
    for (int k = 0; k < pairs; ++k) {
        in += h / 3.0 * power_in(&y, 0.3);
        hci_plant_step(&plant, &y, VOLTAGE, 0.3, h);
        in += 4.0 * h / 3.0 * power_in(&y, 0.3);
        hci_plant_step(&plant, &y, VOLTAGE, 0.3, h);
        in += h / 3.0 * power_in(&y, 0.3);
    }
    return in - (stored_energy(m, &y) - before);
}

static void test_energy_balance_falls_with_the_order(void)
{
    double defect[4];
    use_machine(&PM_SMOOTH, POINTS);
    plant.viscous_Nms = 0.01;
    for (int k = 0; k < 4; ++k)
        defect[k] = energy_defect(&PM_SMOOTH, 50 << k, 0.2);
    for (int k = 1; k < 4; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(0.35, 4.0, log2(fabs(defect[k - 1] / defect[k])));
    TEST_ASSERT_TRUE(fabs(defect[3]) < 1e-5);
}

/* No resistance, short circuit, no friction: all energy stays, over 200 electrical turns of a machine full of
 * harmonics. The coarse table must not matter, as what it interpolates is conservative itself; the cogging
 * potential of the formula differs from the table's by its error, 0.12·(24·2π/2048)⁴/384/48 < 1e-8 J. */
static void test_energy_of_a_free_machine_is_conserved(void)
{
    hci_plant_state y = {{1.0, -2.0}, 60.0, 0.4, 0.0};
    const double none[2] = {0.0, 0.0};
    use_machine(&PM_INTERIOR, 2048);
    plant.resistance_ohm = 0.0;
    const double before = stored_energy(&PM_INTERIOR, &y);
    double least = 1e9, most = 0.0;
    for (int k = 0; k < 200000; ++k) {
        hci_plant_step(&plant, &y, none, 0.0, 5e-5);
        const double magnetic = magnetic_energy(&y);
        least = fmin(least, magnetic);
        most = fmax(most, magnetic);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-7 * before, before, stored_energy(&PM_INTERIOR, &y));
    TEST_ASSERT_TRUE(most - least > 0.1); /* J that went to and fro */
}

/* ---- closed forms ---- */

/* Locked rotor: i = V/R (1 − e^{−Rt/L}) along each axis of L. RK4 at h/τ = 1/133 is within (h/τ)⁴/120. */
static void test_locked_rotor_is_a_resistance_and_an_inductance(void)
{
    hci_plant_state y = {{0.0, 0.0}, 0.0, 0.9, 0.0};
    const double l = 0.02, h = 1e-4;
    use_machine(&PM_SINE, 256);
    TEST_ASSERT_FALSE(plant.table.salient);
    plant.inertia_kgm2 = INFINITY;
    for (int k = 1; k <= 400; ++k) {
        hci_plant_step(&plant, &y, VOLTAGE, 5.0, h);
        const double rise = (1.0 - exp(-1.5 / l * h * k)) / 1.5;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, VOLTAGE[0] * rise, y.i[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, VOLTAGE[1] * rise, y.i[1]);
    }
    TEST_ASSERT_EQUAL_DOUBLE(0.9, y.theta_m_rad);
}

/* J dω/dt = −T_c − Bω: ω = (ω_0 + T_c/B)e^{−Bt/J} − T_c/B until t_0 = J/B ln(1 + Bω_0/T_c), then rest, after
 * J ω_0/B − T_c t_0/B. The rest falls within a step, and either way round. */
static void check_run_down(double direction)
{
    const double j = 0.01, b = 0.02, tc = 0.05, w0 = 30.0, none[2] = {0.0, 0.0}, h = 1e-3;
    const double rest_s = j / b * log(1.0 + b * w0 / tc), way = j * w0 / b - tc * rest_s / b;
    hci_plant_state y = {{0.0, 0.0}, direction * w0, 1.0, 0.0};
    for (int k = 1; k <= 3000; ++k) {
        hci_plant_step_imposed(&plant, &y, none, 0.0, h);
        const double w = h * k < rest_s ? (w0 + tc / b) * exp(-b * h * k / j) - tc / b : 0.0;
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, direction * w, y.speed_rad_per_s);
    }
    TEST_ASSERT_EQUAL_DOUBLE(0.0, y.speed_rad_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, 1.0 + direction * way, hci_plant_angle_rad(&y));
}

static void test_run_down_with_friction(void)
{
    use_machine(&PM_SINE, 256);
    plant.inertia_kgm2 = 0.01;
    plant.viscous_Nms = 0.02;
    plant.coulomb_Nm = 0.05;
    check_run_down(1.0);
    check_run_down(-1.0);
}

/* As above, but a rotor that rests long before its only step ends: a straight line of the speed would end it
 * 5 % later. */
static void test_rest_within_a_long_step(void)
{
    const double j = 0.01, b = 0.02, tc = 0.05, rest_s = 0.1, none[2] = {0.0, 0.0};
    const double w0 = tc / b * (exp(b * rest_s / j) - 1.0), way = j * w0 / b - tc * rest_s / b;
    hci_plant_state y = {{0.0, 0.0}, w0, 1.0, 0.0};
    use_machine(&PM_SINE, 256);
    plant.inertia_kgm2 = j;
    plant.viscous_Nms = b;
    plant.coulomb_Nm = tc;
    hci_plant_step_imposed(&plant, &y, none, 0.0, 1.5 * rest_s);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, y.speed_rad_per_s);
    /* by Runge and Kutta (ω_0 + T_c/B)(J/B)(Bt/J)⁵/120 = 4e-6 */
    TEST_ASSERT_DOUBLE_WITHIN(8e-6, 1.0 + way, hci_plant_angle_rad(&y));
}

static void test_run_down_without_coulomb_friction(void)
{
    hci_plant_state y = {{0.0, 0.0}, 30.0, 1.0, 0.0};
    const double none[2] = {0.0, 0.0};
    use_machine(&PM_SINE, 256);
    plant.viscous_Nms = 0.02;
    for (int k = 1; k <= 1000; ++k) {
        hci_plant_step_imposed(&plant, &y, none, 0.0, 1e-3);
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, 30.0 * exp(-2.0 * 1e-3 * k), y.speed_rad_per_s);
    }
}

static void test_stiction_holds_and_lets_go(void)
{
    hci_plant_state y = {{0.0, 0.0}, 0.0, 1.0, 0.0};
    const double none[2] = {0.0, 0.0}, h = 1e-3;
    use_machine(&PM_SINE, 256);
    plant.coulomb_Nm = 0.05;
    for (int k = 0; k < 1000; ++k)
        hci_plant_step_imposed(&plant, &y, none, k % 2 ? 0.0499 : -0.0499, h);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, y.speed_rad_per_s);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, y.theta_m_rad);
    for (int k = 0; k < 100; ++k)
        hci_plant_step_imposed(&plant, &y, none, -0.08, h);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, (0.08 - 0.05) / 0.01 * 0.1, y.speed_rad_per_s);
    /* 0.3 rad/s upwards, now pushed down by 0.08: slows down by 13 rad/s², then starts downwards by 3 rad/s²
     */
    for (int k = 0; k < 100; ++k)
        hci_plant_step_imposed(&plant, &y, none, 0.08, h);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -3.0 * (0.1 - 0.3 / 13.0), y.speed_rad_per_s);
}

static void pull(const void *context, const hci_plant_state *state, hci_plant_point *point)
{
    const double *torque = context;
    (void)state;
    point->shaft_Nm += *torque;
}

/* What an effect adds to the shaft counts as load at rest, too. */
static void test_stiction_sees_all_torque_at_the_shaft(void)
{
    const double torque = 0.04, none[2] = {0.0, 0.0};
    const hci_plant_effect effect = {pull, &torque};
    hci_plant_state y = {{0.0, 0.0}, 0.0, 1.0, 0.0};
    use_machine(&PM_SINE, 256);
    plant.coulomb_Nm = 0.05;
    plant.effects = &effect;
    plant.effect_count = 1;
    hci_plant_step_imposed(&plant, &y, none, -0.0899, 1e-3);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, y.speed_rad_per_s);
    hci_plant_step_imposed(&plant, &y, none, 0.0101, 1e-3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, -0.0001 / 0.01 * 1e-3, y.speed_rad_per_s);
}

/* A rotor that swings in the cogging torque under Coulomb friction: its energy never rises, whatever the step
 * (20 to 2000 a swing), and it ends where the cogging torque cannot overcome friction. The swing of one step
 * of RK4 adds at most (ωh)⁶/144 of the energy. */
static void check_swing(double h)
{
    hci_plant_state y = {{0.0, 0.0}, 0.0, 0.4, 0.0};
    const double none[2] = {0.0, 0.0};
    double energy = stored_energy(&PM_SMOOTH, &y);
    int stopped = 0;
    for (int k = 0; k < (int)(4.0 / h); ++k) {
        hci_plant_step_imposed(&plant, &y, none, 0.0, h);
        const double now = stored_energy(&PM_SMOOTH, &y);
        TEST_ASSERT_TRUE(now <= energy + 1e-7);
        TEST_ASSERT_FALSE(stopped && y.speed_rad_per_s != 0.0);
        stopped =
            y.speed_rad_per_s == 0.0 && fabs(pm_cogging(&PM_SMOOTH, 2.0 * y.theta_m_rad)) <= plant.coulomb_Nm;
        energy = now;
    }
    TEST_ASSERT_TRUE(stopped);
}

static void test_friction_never_feeds_in_energy(void)
{
    use_machine(&PM_SMOOTH, POINTS);
    plant.coulomb_Nm = 0.011;
    check_swing(1e-4);
    check_swing(1.3e-3);
    check_swing(1e-2);
}

static void test_open_terminals_show_the_back_emf(void)
{
    const hci_plant_state y = {{0.0, 0.0}, -37.0, 1.234, 0.0};
    double v[3], mean = 0.0;
    use_machine(&PM_INTERIOR, POINTS);
    hci_plant_emf_V(&plant, &y, v);
    for (int s = 0; s < 3; ++s)
        mean += pm_emf(&PM_INTERIOR, s, 2.468) / 3.0;
    for (int s = 0; s < 3; ++s)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, -37.0 * (pm_emf(&PM_INTERIOR, s, 2.468) - mean), v[s]);
}

/* Constant speed, sinusoidal voltage V sin(θ + δ): I = (V − E)/(R + jω_e L). The voltage is held at its value
 * of the middle of each step, which makes it sinc(ω_e h/2) = 1 − (0.003)²/24 of itself. */
static void test_sinusoidal_steady_state_is_the_phasor_solution(void)
{
    const double w = 20.0, h = 5e-5, we = 3.0 * w, l = 0.02, r = 1.5, v = 30.0, delta = 0.25;
    const double re = v * cos(delta) - 0.9 * w, im = v * sin(delta), size = r * r + we * we * l * l;
    const double ire = (re * r + im * we * l) / size, iim = (im * r - re * we * l) / size;
    hci_plant_state y = {{0.0, 0.0}, w, 0.0, 0.0};
    double abc[3], plane[2];
    use_machine(&PM_SINE, 4096);
    plant.inertia_kgm2 = INFINITY;
    for (int k = 0; k < 12000; ++k) {
        const double theta = we * h * (k + 0.5);
        for (int s = 0; s < 3; ++s)
            abc[s] = v * sin(theta - 2.0 * REF_PI * s / 3.0 + delta);
        hci_plane_from_abc(abc, plane);
        const double torque = hci_plant_step(&plant, &y, plane, 0.0, h);
        if (k > 11000) TEST_ASSERT_DOUBLE_WITHIN(3e-5, 1.5 * 0.9 * ire, torque);
    }
    hci_plane_to_abc(y.i, abc);
    for (int s = 0; s < 3; ++s) {
        const double x = we * h * 12000 - 2.0 * REF_PI * s / 3.0;
        TEST_ASSERT_DOUBLE_WITHIN(2e-5, ire * sin(x) + iim * cos(x), abc[s]);
    }
}

/* ---- inverter ---- */

static void test_switched_voltages(void)
{
    double v[2], abc[3];
    for (unsigned legs = 0; legs < 8; ++legs) {
        const double on = (legs & 1u) + (legs >> 1 & 1u) + (legs >> 2);
        hci_inverter_switched(300.0, legs, v);
        hci_plane_to_abc(v, abc);
        for (unsigned s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, 300.0 * ((legs >> s & 1u) - on / 3.0), abc[s]);
    }
}

/* The hexagon's corners are the switched voltages, sqrt(2/3) V_dc long; its edges are V_dc/√2 away. */
static void test_average_voltage_is_within_the_hexagon(void)
{
    for (int k = 0; k < 360; ++k) {
        const double angle = k * REF_PI / 180.0, from_edge = fmod(angle, REF_PI / 3.0) - REF_PI / 6.0;
        double v[2] = {1000.0 * cos(angle), 1000.0 * sin(angle)},
               small[2] = {150.0 * cos(angle), 150.0 * sin(angle)};
        const double factor = hci_inverter_average(300.0, v);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 300.0 / sqrt(2.0) / cos(from_edge), hypot(v[0], v[1]));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, hypot(v[0], v[1]) / 1000.0, factor);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, sin(atan2(v[1], v[0]) - angle));
        TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_inverter_average(300.0, small));
        TEST_ASSERT_EQUAL_DOUBLE(150.0 * cos(angle), small[0]);
    }
}

/* ---- effects, angle, repeatability ---- */

static void drag(const void *context, const hci_plant_state *state, hci_plant_point *point)
{
    const double *c = context;
    point->shaft_Nm += *c * state->speed_rad_per_s * fabs(state->speed_rad_per_s);
}

static void warm_magnet(const void *context, const hci_plant_state *state, hci_plant_point *point)
{
    const double *factor = context;
    (void)state;
    point->magnetic.e[0] *= *factor;
    point->magnetic.e[1] *= *factor;
}

/* J dω/dt = −c ω²: ω = ω_0/(1 + c ω_0 t/J), while a magnet at 80 % makes 80 % of the torque. */
static void test_effects(void)
{
    const double c = 1e-4, factor = 0.8, none[2] = {0.0, 0.0}, alpha[2] = {2.0, 0.0};
    const hci_plant_effect effects[2] = {{drag, &c}, {warm_magnet, &factor}};
    hci_plant_state y = {{0.0, 0.0}, 100.0, 0.0, 0.0};
    use_machine(&PM_SINE, 4096);
    plant.effects = effects;
    plant.effect_count = 2;
    for (int k = 0; k < 500; ++k)
        hci_plant_step_imposed(&plant, &y, none, 0.0, 1e-3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.0 / (1.0 + 1e-4 * 100.0 * 0.5 / 0.01), y.speed_rad_per_s);
    y.theta_m_rad = 0.2;
    /* α of the back-EMF is sqrt(3/2)·0.9 sin θ */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.8 * sqrt(1.5) * 0.9 * sin(0.6) * 2.0,
                              hci_plant_step_imposed(&plant, &y, alpha, 0.0, 1e-3));
}

static void test_angle_is_wrapped_and_counted(void)
{
    const double none[2] = {0.0, 0.0};
    use_machine(&PM_SINE, 64);
    plant.inertia_kgm2 = INFINITY;
    for (int sign = -1; sign <= 1; sign += 2) {
        hci_plant_state y = {{0.0, 0.0}, sign * 1000.0, 0.0, 0.0};
        for (int k = 0; k < 100000; ++k) {
            hci_plant_step_imposed(&plant, &y, none, 0.0, 1e-4);
            TEST_ASSERT_TRUE(y.theta_m_rad >= 0.0 && y.theta_m_rad < 2.0 * REF_PI);
        }
        /* 1e5 additions and 1592 turns at an ulp of 2π each */
        TEST_ASSERT_DOUBLE_WITHIN(1e-7, sign * 1e4, hci_plant_angle_rad(&y));
        TEST_ASSERT_EQUAL_DOUBLE(sign > 0 ? 1591.0 : -1592.0, y.turns);
    }
    hci_plant_state y = {{0.0, 0.0}, 0.0, 2.0 * REF_PI, 3.0}; /* a turn is no angle any more */
    hci_plant_step_imposed(&plant, &y, none, 0.0, 1e-4);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, y.theta_m_rad);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, y.turns);
}

static void test_runs_repeat_to_the_bit(void)
{
    use_machine(&PM_INTERIOR, 512);
    plant.coulomb_Nm = 0.1;
    const hci_plant_state a = run(5000, 0.5), b = run(5000, 0.5);
    TEST_ASSERT_EQUAL_MEMORY(&a, &b, sizeof a);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_table_follows_the_formulas);
    RUN_TEST(test_slope_is_the_derivative_of_the_interpolant);
    RUN_TEST(test_fractional_orders_span_the_mechanical_turn);
    RUN_TEST(test_every_row_is_filled);
    RUN_TEST(test_table_refuses);
    RUN_TEST(test_table_refuses_each_alone);
    RUN_TEST(test_any_angle_stays_within_the_table);
    RUN_TEST(test_a_state_that_is_not_a_number_ends_its_step);
    RUN_TEST(test_saliency_from_constants);
    RUN_TEST(test_order_is_four);
    RUN_TEST(test_energy_balance_falls_with_the_order);
    RUN_TEST(test_energy_of_a_free_machine_is_conserved);
    RUN_TEST(test_locked_rotor_is_a_resistance_and_an_inductance);
    RUN_TEST(test_run_down_with_friction);
    RUN_TEST(test_run_down_without_coulomb_friction);
    RUN_TEST(test_stiction_holds_and_lets_go);
    RUN_TEST(test_stiction_sees_all_torque_at_the_shaft);
    RUN_TEST(test_friction_never_feeds_in_energy);
    RUN_TEST(test_open_terminals_show_the_back_emf);
    RUN_TEST(test_sinusoidal_steady_state_is_the_phasor_solution);
    RUN_TEST(test_switched_voltages);
    RUN_TEST(test_average_voltage_is_within_the_hexagon);
    RUN_TEST(test_effects);
    RUN_TEST(test_angle_is_wrapped_and_counted);
    RUN_TEST(test_runs_repeat_to_the_bit);
    RUN_TEST(test_rest_within_a_long_step);
    return UNITY_END();
}
