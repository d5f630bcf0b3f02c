/* Machine A beyond its base speed: the voltage alone makes i_d negative. Its plain sine against the closed
 * form of the voltage circle; then its
 * smooth torque, with all harmonics. */
#include <math.h>

#include "hci/host/solve/solve.h"
#include "support/reference.h"
#include "support/solving.h"

#define RESISTANCE_OHM 0.1 /* assumed: the paper gives neither */
#define INDUCTANCE_H   0.5e-3

static hci_component fundamental[1] = {{1.0, 1}};
static hci_set name[1] = {HCI_SET_POS};
static hci_component_set set;

void setUp(void)
{
    solving_start("data/machine_a", 2.46);
    machine.resistance_ohm = RESISTANCE_OHM;
    machine.inductance_d_H = machine.inductance_q_H = INDUCTANCE_H;
    set = (hci_component_set){fundamental, name, 1, {{0}}};
}

void tearDown(void)
{
    solving_end();
}

static void solve(hci_status expected)
{
    hci_note note = {{0}};
    hci_solution_release(&solution);
    TEST_ASSERT_EQUAL_MESSAGE(expected, hci_solve(&machine, &options, &solution, &note), note.text);
    TEST_ASSERT_TRUE(solution.within_limits);
}

static double i_d_A(void)
{
    for (size_t k = 0; k < solution.current.count; ++k)
        if (solution.current.wave[k].order == 1.0 && solution.current.wave[k].sequence == 1)
            return -solution.current.wave[k].cosine;
    TEST_FAIL_MESSAGE("no fundamental");
    return 0.0;
}

/* ---- the plain sine ---- */

/* Smallest |i_d| with (R i_d − ωL i_q)² + (R i_q + ωL i_d + ω_m k)² = U²/3, 0 where the sine keeps U by
 * itself; k: back-EMF per rad/s. */
static double closed_form_A(double speed_rad_per_s, double line_V)
{
    const double k = machine.model.back_emf[0].sine, i_q = 2.46 / (1.5 * k),
                 x = 2.0 * speed_rad_per_s * INDUCTANCE_H, r = RESISTANCE_OHM, e = speed_rad_per_s * k;
    const double a = r * r + x * x, b = x * e,
                 c = pow(x * i_q, 2.0) + pow(r * i_q + e, 2.0) - line_V * line_V / 3.0;
    return c <= 0.0 ? 0.0 : (-b + sqrt(b * b - a * c)) / a;
}

static void only_the_fundamental(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(0.0, 1.0, machine.model.back_emf[0].order);
    machine.model.back_emf_count = 1;
    machine.model.cogging_count = 0;
    options.set = &set;
}

static void test_the_plain_sine_follows_the_voltage_circle(void)
{
    only_the_fundamental();
    for (double rpm = 1000.0; rpm <= 2000.0; rpm += 200.0) {
        const double speed = rpm * REF_PI / 30.0;
        options.speed_rad_per_s = speed;
        options.limit_voltage_V = 40.0;
        const double expected_A = closed_form_A(speed, 40.0);
        TEST_ASSERT_TRUE((rpm > 1500.0) == (expected_A < 0.0)); /* base speed between 1400 and 1600 rpm */
        solve(HCI_OK);
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, expected_A, i_d_A());
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 2.46, solution.order[0].torque_Nm.cosine);
    }
}

/* ---- with all harmonics ---- */

/* Smooth torque within 90 V: the further the currents without a limit are beyond it, the more i_d goes
 * against the magnets. (Beyond 2000 rpm harmonics of the voltage are in the way, and ripple takes the place
 * of i_d.) */
static void test_smooth_torque_takes_a_negative_i_d(void)
{
    double before_A = 0.0;
    for (double rpm = 1500.0; rpm <= 1900.0; rpm += 200.0) {
        options.speed_rad_per_s = rpm * REF_PI / 30.0;
        options.limit_voltage_V = 1e4;
        solve(HCI_OK);
        const double free_A = i_d_A();
        TEST_ASSERT_TRUE(solution.peak_line_voltage_V > 90.0);
        options.limit_voltage_V = 90.0;
        solve(HCI_OK);
        TEST_ASSERT_EQUAL(HCI_COST_COPPER, solution.limit_cost);
        TEST_ASSERT_TRUE(rpm < 1600.0 || i_d_A() < free_A - 0.3);
        TEST_ASSERT_TRUE(rpm < 1600.0 || i_d_A() < before_A - 0.3);
        before_A = i_d_A();
    }
    TEST_ASSERT_TRUE(before_A < -1.0);
}

/* ---- without a zero sequence, and in a circle ---- */

static double vector_V; /* amplitude that voltages_by_samples has seen */

/* The largest phase and line voltage of the solved currents by v = R i + ω (L di/dθ) + ω_m e, and differences
 * of neighbours for the derivative. */
static void voltages_by_samples(double *phase_V, double *line_V)
{
    enum { N = 20000 };
    static double i_A[N][3], e[3];
    const double speed = options.speed_rad_per_s, step = 2.0 * REF_PI / N;
    *phase_V = *line_V = vector_V = 0.0;
    for (size_t k = 0; k < N; ++k)
        hci_waves_at(solution.current.wave, solution.current.count, step * (double)k, i_A[k]);
    for (size_t k = 0; k < N; ++k) {
        double v[3];
        hci_waves_at(machine.model.back_emf, machine.model.back_emf_count, step * (double)k, e);
        const double zero = (e[0] + e[1] + e[2]) / 3.0; /* the star point takes it */
        for (int s = 0; s < 3; ++s) {
            const double slope = (i_A[(k + 1) % N][s] - i_A[(k + N - 1) % N][s]) / (2.0 * step);
            v[s] = RESISTANCE_OHM * i_A[k][s] + 2.0 * speed * INDUCTANCE_H * slope + speed * (e[s] - zero);
            *phase_V = fmax(*phase_V, fabs(v[s]));
        }
        vector_V = fmax(vector_V, sqrt((v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 1.5));
        for (int s = 0; s < 3; ++s)
            *line_V = fmax(*line_V, fabs(v[s] - v[(s + 1) % 3]));
    }
}

/* Half of the dc link in each phase is less than the line voltage alone would allow, and of harmonics it is
 * not √3/2 of that. */
static void test_sinusoidal_modulation_keeps_each_phase(void)
{
    double phase_V, line_V;
    options.speed_rad_per_s = 1500.0 * REF_PI / 30.0;
    options.limit_voltage_V = 102.0;
    options.limits.modulation = HCI_MODULATION_SINUSOIDAL;
    solve(HCI_OK);
    voltages_by_samples(&phase_V, &line_V);
    TEST_ASSERT_EQUAL(HCI_COST_COPPER, solution.limit_cost); /* it acts */
    TEST_ASSERT_DOUBLE_WITHIN(1e-4 * 51.0, 51.0, phase_V);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4 * line_V, line_V, solution.peak_line_voltage_V);
    TEST_ASSERT_TRUE(solution.limit_count == 1 && solution.limit[0].modulation == HCI_MODULATION_SINUSOIDAL);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 102.0, solution.limit[0].value);
    TEST_ASSERT_EQUAL_STRING("c", hci_limit_place_name(&solution.limit[0], 2));
    options.limits.modulation = HCI_MODULATION_SPACE_VECTOR;
    solve(HCI_OK);
    voltages_by_samples(&phase_V, &line_V);
    TEST_ASSERT_TRUE(phase_V > 51.0);
    TEST_ASSERT_EQUAL_STRING("ca", hci_limit_place_name(&solution.limit[0], 2));
}

/* Largest speed at which the plain sine makes the torque with i_d = 0 within an amplitude of the phase
 * voltage: (ωL i_q)² + (R i_q + ω_m k)² = V². */
static double largest_speed(double amplitude_V)
{
    const double k = machine.model.back_emf[0].sine, i_q = 2.46 / (1.5 * k), x = 2.0 * INDUCTANCE_H * i_q,
                 r = RESISTANCE_OHM * i_q, a = x * x + k * k, b = r * k,
                 c = r * r - amplitude_V * amplitude_V;
    return (-b + sqrt(b * b - a * c)) / a;
}

/* A plain sine turns through all directions: up to U/√3 in the circle and in the hexagon, up to U/2 without a
 * zero sequence. */
static void test_the_largest_speed_of_a_plain_sine(void)
{
    static const double SHARE[] = {[HCI_MODULATION_SPACE_VECTOR] = 0.57735026918962576,
                                   [HCI_MODULATION_SINUSOIDAL] = 0.5,
                                   [HCI_MODULATION_CIRCLE] = 0.57735026918962576};
    only_the_fundamental();
    options.limit_voltage_V = 100.0;
    for (int m = 0; m < 3; ++m) {
        const double speed = largest_speed(100.0 * SHARE[m]), around[2] = {0.9999 * speed, 1.0001 * speed};
        options.limits.modulation = (hci_modulation)m;
        for (int k = 0; k < 2; ++k) {
            options.speed_rad_per_s = around[k];
            solve(HCI_OK);
            TEST_ASSERT_EQUAL(k == 0 ? HCI_COST_NONE : HCI_COST_COPPER, solution.limit_cost);
            TEST_ASSERT_DOUBLE_WITHIN(1e-4, closed_form_A(around[k], sqrt(3.0) * SHARE[m] * 100.0), i_d_A());
        }
    }
}

/* Of harmonics the hexagon has more than the circle within it, whatever the phases and line voltages. */
static void test_a_circle_keeps_the_vector(void)
{
    double phase_V, line_V;
    options.speed_rad_per_s = 1500.0 * REF_PI / 30.0;
    options.limit_voltage_V = 90.0;
    options.limits.modulation = HCI_MODULATION_CIRCLE;
    solve(HCI_OK);
    voltages_by_samples(&phase_V, &line_V);
    const double circle_A2 = solution.mean_square_A2;
    TEST_ASSERT_EQUAL(HCI_COST_COPPER, solution.limit_cost); /* it acts */
    TEST_ASSERT_DOUBLE_WITHIN(1e-4 * 90.0, 90.0, sqrt(3.0) * vector_V);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * 90.0, 90.0, solution.limit[0].value);
    TEST_ASSERT_EQUAL_STRING("vector", hci_limit_place_name(&solution.limit[0], 0));
    options.limits.modulation = HCI_MODULATION_SPACE_VECTOR;
    solve(HCI_OK);
    voltages_by_samples(&phase_V, &line_V);
    TEST_ASSERT_TRUE(line_V < 90.01 && sqrt(3.0) * vector_V > 90.5);
    TEST_ASSERT_TRUE(solution.mean_square_A2 < circle_A2);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_largest_speed_of_a_plain_sine);
    RUN_TEST(test_a_circle_keeps_the_vector);
    RUN_TEST(test_the_plain_sine_follows_the_voltage_circle);
    RUN_TEST(test_smooth_torque_takes_a_negative_i_d);
    RUN_TEST(test_sinusoidal_modulation_keeps_each_phase);
    return UNITY_END();
}
