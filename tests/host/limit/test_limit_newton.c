/* Where Newton's method does not come to rest at the optimum within limits: the rounds of more angles find it
 * without it, to the same precision, and a beginning that leads nowhere leaves the answer it was given. The
 * library's function is replaced by one that lets it be used, refuses, or begins far off. */
#define hci_limit_newton newtons_method
#include "host/limit/newton.h"

#include "host/limit/newton.c"
#undef hci_limit_newton
hci_limit_finish hci_limit_newton;

#include "hci/host/solve/solve.h"
#include "support/reference.h"
#include "unity.h"

#define K_E 0.2 /* V·s/rad */

enum { COMPONENTS = 5 };

static const hci_component ALL[COMPONENTS] = {{1.0, 1}, {5.0, -1}, {7.0, 1}, {11.0, -1}, {13.0, 1}};
static hci_wave emf[COMPONENTS];
static hci_machine_data machine;
static hci_target_order mean = {{0.0, 0.0, 3.0}, 1.0};
static const hci_target target = {&mean, 1};
static hci_component_set set;
static hci_solve_options options;
static hci_solution solution;
typedef enum { USED, REFUSED, FAR_OFF } beginning;
static beginning mode;
static int found, left;
static int rested, again; /* where it ended last it is at rest; and is asked once more with an answer */

/* From −2 x, which keeps no limit. */
static hci_status begin_far_off(const hci_limit_build *build, const hci_cone_answer *answer,
                                hci_limit_rest *last, hci_limit_optimum *optimum)
{
    const hci_limit_optimum before = *optimum;
    if (!answer) return HCI_OK;
    hci_cone_answer far_off = *answer;
    double *x = hci_memory_new(build->n, sizeof *x);
    for (size_t j = 0; j < build->n; ++j)
        x[j] = 0.3 - 2.0 * answer->x[j];
    far_off.x = x;
    const hci_status status = newtons_method(build, &far_off, last, optimum);
    hci_memory_free(x);
    if (!optimum->is_settled) TEST_ASSERT_EQUAL_MEMORY(&before, optimum, sizeof before);
    return status;
}

hci_status hci_limit_newton(const hci_limit_build *build, const hci_cone_answer *answer, hci_limit_rest *last,
                            hci_limit_optimum *optimum)
{
    const hci_status status = mode == USED      ? newtons_method(build, answer, last, optimum)
                              : mode == FAR_OFF ? begin_far_off(build, answer, last, optimum)
                                                : HCI_OK;
    static bool at_rest;
    again += answer && at_rest;
    at_rest = !answer && optimum->is_settled;
    rested += at_rest;
    found += optimum->is_settled;
    left += answer && !optimum->is_settled;
    return status;
}

void setUp(void)
{
    static hci_set name[COMPONENTS];
    static hci_component component[COMPONENTS];
    memcpy(component, ALL, sizeof ALL);
    for (int k = 0; k < COMPONENTS; ++k)
        name[k] = ALL[k].sequence > 0 ? HCI_SET_POS : HCI_SET_NEG;
    memset(&options, 0, sizeof options);
    memset(&solution, 0, sizeof solution);
    set = (hci_component_set){component, name, COMPONENTS, {{0}}};
    options.set = &set;
    options.target = &target;
    machine.model = (hci_machine){.pole_pairs = 3, .back_emf = emf, .back_emf_count = COMPONENTS};
    machine.pole_pairs = 3.0;
    machine.resistance_ohm = 0.4;
    machine.inductance_d_H = machine.inductance_q_H = 2e-3;
    machine.dc_link_voltage_V = machine.max_current_A = machine.rated_current_A = NAN;
}

void tearDown(void)
{
    hci_solution_release(&solution);
}

static void draw_machine(uint64_t seed)
{
    emf[0] = (hci_wave){1.0, 1, K_E, 0.0};
    for (int k = 1; k < COMPONENTS; ++k)
        emf[k] = hci_wave_polar(ALL[k].order, ALL[k].sequence, ref_uniform(&seed, 0.05, 0.3) * K_E,
                                ref_uniform(&seed, -3.0, 3.0));
    options.limit_current_A = ref_uniform(&seed, 8.0, 11.0);
    options.speed_rad_per_s = 100.0;
    options.limit_voltage_V = ref_uniform(&seed, 45.0, 60.0);
}

static void solve(beginning how)
{
    hci_note note = {{0}};
    mode = how;
    found = left = rested = again = 0;
    hci_solution_release(&solution);
    const hci_status status = hci_solve(&machine, &options, &solution, &note);
    TEST_ASSERT_TRUE_MESSAGE(status <= HCI_NOT_REACHED, note.text);
}

/* Mean, ripple and copper of the rounds alone beside those with Newton's method: ten machines. */
static void compare(beginning how, int *with, int *without)
{
    *with = *without = 0;
    for (uint64_t seed = 1; seed <= 10; ++seed) {
        draw_machine(seed);
        solve(USED);
        const double mean_Nm = solution.order[0].torque_Nm.cosine, ripple_Nm = solution.minimised_Nm,
                     copper_A2 = solution.mean_square_A2;
        *with += found;
        solve(how);
        *without += found;
        TEST_ASSERT_TRUE(solution.within_limits);
        TEST_ASSERT_DOUBLE_WITHIN(3e-6, mean_Nm, solution.order[0].torque_Nm.cosine);
        TEST_ASSERT_DOUBLE_WITHIN(3e-6, ripple_Nm, solution.minimised_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-4 * copper_A2, copper_A2, solution.mean_square_A2);
    }
}

static void compare_with_rounds(void)
{
    int with, without;
    compare(REFUSED, &with, &without);
    TEST_ASSERT_GREATER_THAN(10, with);
    TEST_ASSERT_EQUAL(0, without);
}

static void test_rounds_alone_end_at_the_same_optimum(void)
{
    compare_with_rounds();
}

/* Two ends of the torque's range that move, each with its peaks. */
static void test_the_smallest_swing(void)
{
    options.minimise = HCI_MINIMISE_PEAK_TO_PEAK;
    compare_with_rounds();
}

/* The vector of the voltage bends across its direction. */
static void test_a_vector_in_a_circle(void)
{
    options.limits.modulation = HCI_MODULATION_CIRCLE;
    compare_with_rounds();
}

static void test_a_beginning_far_off_leaves_the_answer(void)
{
    int with, without;
    compare(FAR_OFF, &with, &without);
    TEST_ASSERT_GREATER_THAN(0, left);
}

/* Of a torque that is not linear programs follow each other: one that is at rest where the last one ended is
 * not solved. The inductances of three alike phases: L' = 2 p l sin(2θ − φ). */
static void test_where_it_rests_nothing_is_solved(void)
{
    static const int THIRDS[HCI_PHASE_MATRIX] = {
        [HCI_AA] = 0, [HCI_BB] = 2, [HCI_CC] = 1, [HCI_AB] = 1, [HCI_BC] = 0, [HCI_CA] = 2};
    static hci_inductance_slope slope = {.order = 2.0};
    for (int k = 0; k < HCI_PHASE_MATRIX; ++k) {
        slope.sine[k] = 6.0 * 0.3e-3 * cos(2.0 * REF_PI / 3.0 * THIRDS[k]);
        slope.cosine[k] = -6.0 * 0.3e-3 * sin(2.0 * REF_PI / 3.0 * THIRDS[k]);
    }
    machine.model.slope = &slope;
    machine.model.slope_count = 1;
    draw_machine(1);
    solve(USED);
    TEST_ASSERT_GREATER_THAN(0, rested);
    TEST_ASSERT_EQUAL(0, again);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rounds_alone_end_at_the_same_optimum);
    RUN_TEST(test_the_smallest_swing);
    RUN_TEST(test_a_vector_in_a_circle);
    RUN_TEST(test_a_beginning_far_off_leaves_the_answer);
    RUN_TEST(test_where_it_rests_nothing_is_solved);
    return UNITY_END();
}
