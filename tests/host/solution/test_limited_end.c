/* The work of an answer within limits is bounded: where the steps end before the currents rest, the best of
 * them stay, keep the limits, and that is said. The bound is the test's here, in place of the library's. */
#include "host/solution/limited_path.h"

static int most_steps;
#define HCI_LIMITED_MOST_STEPS ((size_t)most_steps)
#include "host/solution/limited_path.c"
#undef HCI_LIMITED_MOST_STEPS

#include "hci/host/solve/solve.h"
#include "support/reference.h"
#include "unity.h"

#define PAIRS      4.0
#define FLUX_Vs    0.05 /* of the magnets */
#define ACROSS_H   1e-4 /* of each inductance over the angle: L_q − L_d is three times that */
#define WANTED_Nm  60.0
#define MOST_A     100.0
#define THIRD      (2.0 * REF_PI / 3.0)
#define COMPONENTS 5

static hci_component component[COMPONENTS] = {{1.0, 1}, {5.0, -1}, {7.0, 1}, {11.0, -1}, {13.0, 1}};
static hci_set name[COMPONENTS] = {HCI_SET_POS, HCI_SET_NEG, HCI_SET_POS, HCI_SET_NEG, HCI_SET_POS};
static hci_component_set set = {component, name, COMPONENTS, {{0}}};
static hci_wave emf[3];
static hci_inductance_slope slope[1];
static hci_target_order mean = {{0.0, 0.0, WANTED_Nm}, 1.0};
static const hci_target target = {&mean, 1};
static hci_machine_data machine;
static hci_solve_options options;
static hci_solution solution;

/* L_a = L_0 − l cos 2θ and so on. */
static void fill_slope(void)
{
    const double phi[HCI_PHASE_MATRIX] = {[HCI_AA] = 0.0,   [HCI_BB] = 2.0 * THIRD, [HCI_CC] = THIRD,
                                          [HCI_AB] = THIRD, [HCI_BC] = 0.0,         [HCI_CA] = 2.0 * THIRD};
    slope[0].order = 2.0;
    for (int k = 0; k < HCI_PHASE_MATRIX; ++k) {
        slope[0].sine[k] = 2.0 * PAIRS * ACROSS_H * cos(phi[k]);
        slope[0].cosine[k] = -2.0 * PAIRS * ACROSS_H * sin(phi[k]);
    }
}

void setUp(void)
{
    memset(&machine, 0, sizeof machine);
    memset(&options, 0, sizeof options);
    memset(&solution, 0, sizeof solution);
    fill_slope();
    emf[0] = (hci_wave){1.0, 1, PAIRS * FLUX_Vs, 0.0};
    emf[1] = (hci_wave){5.0, -1, 0.12 * PAIRS * FLUX_Vs, 0.0};
    emf[2] = (hci_wave){7.0, 1, 0.0, 0.07 * PAIRS * FLUX_Vs};
    machine.model = (hci_machine){
        .pole_pairs = PAIRS, .back_emf = emf, .back_emf_count = 3, .slope = slope, .slope_count = 1};
    machine.pole_pairs = PAIRS;
    machine.resistance_ohm = machine.inductance_d_H = machine.inductance_q_H = NAN;
    machine.dc_link_voltage_V = machine.max_current_A = machine.rated_current_A = NAN;
    options.target = &target;
    options.set = &set;
    options.limit_current_A = MOST_A;
}

void tearDown(void)
{
    hci_solution_release(&solution);
}

static double solve(int steps)
{
    hci_note note = {{0}};
    most_steps = steps;
    hci_solution_release(&solution);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_NOT_REACHED, hci_solve(&machine, &options, &solution, &note), note.text);
    TEST_ASSERT_TRUE(solution.within_limits);
    TEST_ASSERT_TRUE(solution.peak_phase_current_A <= MOST_A);
    return solution.order[0].torque_Nm.cosine;
}

static bool says_end(void)
{
    return strstr(solution.remark.text, "ended before they came to rest") != NULL;
}

static void test_currents_that_rest_say_nothing(void)
{
    solve(120);
    TEST_ASSERT_TRUE(solution.newton_converged);
    TEST_ASSERT_TRUE(solution.limit[0].gain > 0.0);
    TEST_ASSERT_FALSE(says_end());
}

/* Fewer steps find no more, and what they found stays. */
static void test_steps_that_end_are_said(void)
{
    const double rest_Nm = solve(120);
    for (int steps = 1; steps <= 5; ++steps) {
        char words[64];
        const double found_Nm = solve(steps);
        snprintf(words, sizeof words, "the best currents of %d,", steps);
        TEST_ASSERT_FALSE(solution.newton_converged);
        TEST_ASSERT_TRUE(says_end());
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(solution.remark.text, words), solution.remark.text);
        TEST_ASSERT_TRUE(found_Nm <= rest_Nm * (1.0 + 1e-6));
        TEST_ASSERT_TRUE(found_Nm > 0.9 * rest_Nm);
        TEST_ASSERT_TRUE(isnan(solution.limit[0].gain)); /* which is the slope of an optimum */
    }
}

/* The remedy is in the option that chose the components. */
static void test_the_remedy_is_of_the_choice(void)
{
    solve(3);
    TEST_ASSERT_NOT_NULL(strstr(solution.remark.text, "fewer components (--harmonics)"));
    options.set = NULL;
    options.choose_at_most = 4;
    solve(3);
    TEST_ASSERT_NOT_NULL(strstr(solution.remark.text, "fewer components (a smaller K of --auto)"));
    TEST_ASSERT_TRUE(solution.current.count <= 4);
}

/* Orders are left out of rough steps that are bounded, from a best answer, and where the worst order counts.
 */
static void test_orders_that_act_on_no_step(void)
{
    double x = 1.0;
    for (int lacks = 0; lacks < 5; ++lacks) {
        hci_wishes wishes = {.is_coarse = lacks != 1};
        wishes.program.minimise = lacks == 2 ? HCI_MINIMISE_RMS : HCI_MINIMISE_WORST;
        const path p = {
            .wishes = &wishes, .best = lacks == 3 ? NULL : &x, .radius_A = lacks == 4 ? 0.0 : 0.1};
        TEST_ASSERT_EQUAL(lacks == 0, has_idle_orders(&p));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_currents_that_rest_say_nothing);
    RUN_TEST(test_steps_that_end_are_said);
    RUN_TEST(test_the_remedy_is_of_the_choice);
    RUN_TEST(test_orders_that_act_on_no_step);
    return UNITY_END();
}
