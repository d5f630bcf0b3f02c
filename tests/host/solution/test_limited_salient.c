/* Limits on a sinusoidal machine whose reluctance torque is much of it, L_q = 2.5 L_d: its plain sine against
 * a search over i_d and i_q, and a mean torque beyond that of the sine, which harmonics make as it is wanted.
 */
#include "hci/host/solve/solve.h"

#include <math.h>
#include <string.h>

#include "support/reference.h"
#include "unity.h"

#define PAIRS        4
#define FLUX_Vs      0.07
#define D_H          0.2e-3
#define Q_H          0.5e-3
#define RESISTANCE   0.02
#define MOST_A       300.0
#define DC_LINK_V    320.0
#define ACROSS_H     ((Q_H - D_H) / 3.0) /* of each inductance over the angle */
#define SLOPE(phi)   (2.0 * PAIRS * ACROSS_H * cos(phi))
#define SLOPE_C(phi) (-2.0 * PAIRS * ACROSS_H * sin(phi))
#define THIRD        (2.0 * REF_PI / 3.0)

static hci_component component[3] = {{1.0, 1}, {5.0, -1}, {7.0, 1}};
static hci_set name[3] = {HCI_SET_POS, HCI_SET_NEG, HCI_SET_POS};
static hci_component_set set;
static hci_wave emf[1];
static hci_inductance_slope slope[1];
static hci_machine_data machine;
static hci_target target;
static hci_target_order order[1];
static hci_solve_options options;
static hci_solution solution;

/* L_a = L_0 − l cos 2θ and so on: L' = 2 p l sin(2θ − φ), φ = 0, 4π/3, 2π/3 and for the mutual ones 2π/3, 0,
 * 4π/3. */
static void fill_slope(void)
{
    const double phi[HCI_PHASE_MATRIX] = {[HCI_AA] = 0.0,   [HCI_BB] = 2.0 * THIRD, [HCI_CC] = THIRD,
                                          [HCI_AB] = THIRD, [HCI_BC] = 0.0,         [HCI_CA] = 2.0 * THIRD};
    slope[0].order = 2.0;
    for (int k = 0; k < HCI_PHASE_MATRIX; ++k) {
        slope[0].sine[k] = SLOPE(phi[k]);
        slope[0].cosine[k] = SLOPE_C(phi[k]);
    }
}

void setUp(void)
{
    memset(&machine, 0, sizeof machine);
    memset(&options, 0, sizeof options);
    memset(&solution, 0, sizeof solution);
    fill_slope();
    emf[0] = (hci_wave){1.0, 1, PAIRS * FLUX_Vs, 0.0};
    machine.model = (hci_machine){
        .pole_pairs = PAIRS, .back_emf = emf, .back_emf_count = 1, .slope = slope, .slope_count = 1};
    machine.pole_pairs = PAIRS;
    machine.resistance_ohm = RESISTANCE;
    machine.inductance_d_H = D_H;
    machine.inductance_q_H = Q_H;
    machine.dc_link_voltage_V = DC_LINK_V;
    machine.max_current_A = MOST_A;
    machine.rated_current_A = NAN;
    target = (hci_target){order, 1};
    options.target = &target;
    options.set = &set;
}

void tearDown(void)
{
    hci_solution_release(&solution);
}

static void solve(size_t components, double wanted_Nm)
{
    hci_note note = {{0}};
    set = (hci_component_set){component, name, components, {{0}}};
    order[0] = (hci_target_order){{0.0, 0.0, wanted_Nm}, 1.0};
    hci_solution_release(&solution);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_NOT_REACHED, hci_solve(&machine, &options, &solution, &note), note.text);
    TEST_ASSERT_EQUAL_STRING("", solution.remark.text);
    TEST_ASSERT_TRUE(solution.within_limits && solution.peak_phase_current_A <= MOST_A);
}

/* ---- the plain sine ---- */

/* The largest torque of i_d, i_q on the circle of radius A that keep the voltage; 0: none. */
static double most_on_circle_Nm(double a_A, double w)
{
    enum { STEPS = 4000 };
    double most = 0.0;
    for (int k = 0; k <= STEPS; ++k) {
        const double d = -a_A * sin(0.5 * REF_PI * k / STEPS), q = a_A * cos(0.5 * REF_PI * k / STEPS);
        const double v_d = RESISTANCE * d - w * Q_H * q, v_q = RESISTANCE * q + w * (D_H * d + FLUX_Vs);
        if (sqrt(3.0) * hypot(v_d, v_q) <= DC_LINK_V)
            most = fmax(most, 1.5 * PAIRS * (FLUX_Vs + (D_H - Q_H) * d) * q);
    }
    return most;
}

static double most_Nm(double rpm)
{
    double most = 0.0;
    for (int k = 1; k <= 600; ++k)
        most = fmax(most, most_on_circle_Nm(MOST_A * k / 600, PAIRS * rpm * REF_PI / 30.0));
    return most;
}

static void test_the_largest_torque_of_the_sine(void)
{
    static const double RPM[] = {0.0, 4000.0, 6000.0, 12000.0}, MOST[] = {179.679, 168.081, 124.418, 63.677};
    options.at_speed = true;
    for (size_t k = 0; k < sizeof RPM / sizeof *RPM; ++k) {
        const double wanted_Nm[] = {180.0, 181.0, 250.0};
        const double most = most_Nm(RPM[k]);
        TEST_ASSERT_DOUBLE_WITHIN(2e-3 * MOST[k], MOST[k], most); /* the steps of the search */
        options.speed_rad_per_s = RPM[k] * REF_PI / 30.0;
        for (size_t w = 0; w < 3; ++w) {
            solve(1, wanted_Nm[w]);
            TEST_ASSERT_EQUAL(HCI_COST_TORQUE, solution.limit_cost);
            TEST_ASSERT_DOUBLE_WITHIN(1e-5 * MOST[k], MOST[k], solution.order[0].torque_Nm.cosine);
            TEST_ASSERT_TRUE(solution.order[0].torque_Nm.cosine >= most - 1e-6 * most);
        }
    }
}

/* ---- beyond it ---- */

static void test_a_mean_beyond_the_sine_is_as_wanted(void)
{
    for (int k = 0; k <= 10; ++k) {
        const double wanted_Nm = 180.0 + 1.8 * k;
        solve(3, wanted_Nm);
        TEST_ASSERT_EQUAL(HCI_COST_RIPPLE, solution.limit_cost);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * wanted_Nm, wanted_Nm, solution.order[0].torque_Nm.cosine);
    }
    solve(3, 200.0);
    TEST_ASSERT_EQUAL(HCI_COST_TORQUE, solution.limit_cost);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 198.683, solution.order[0].torque_Nm.cosine);
}

/* The largest torque of a peak current grows without bends: one that is too small lies in a lesser optimum.
 */
static void test_the_largest_torque_grows_evenly(void)
{
    double most_Nm[3];
    for (int k = 0; k < 3; ++k) {
        options.limit_current_A = 236.0 + 2.0 * k;
        solve(3, 150.0);
        most_Nm[k] = solution.order[0].torque_Nm.cosine;
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.5 * (most_Nm[0] + most_Nm[2]), most_Nm[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 143.909, most_Nm[1]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_largest_torque_of_the_sine);
    RUN_TEST(test_a_mean_beyond_the_sine_is_as_wanted);
    RUN_TEST(test_the_largest_torque_grows_evenly);
    return UNITY_END();
}
