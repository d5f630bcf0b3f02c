/* Currents of a drive with an open phase against what the best current at each angle by itself makes: with a
 * neutral conductor the shortest current of the two phases that are left, found by search; without one the
 * torque that they can make at all. */
#include <math.h>
#include <string.h>

#include "hci/host/solve/solve.h"
#include "support/reference.h"
#include "unity.h"

enum { ANGLES = 720 };

#define K_E  0.2 /* V·s/rad */
#define MEAN 3.0 /* N·m */

static hci_machine_data machine;
static hci_wave emf[2];
static hci_harmonic cogging[1];
static hci_target target;
static hci_target_order order[1];
static hci_solve_options options;
static hci_solution solution;

void setUp(void)
{
    memset(&machine, 0, sizeof machine);
    memset(&options, 0, sizeof options);
    memset(&solution, 0, sizeof solution);
    emf[0] = (hci_wave){1.0, 1, K_E, 0.0};
    emf[1] = (hci_wave){5.0, -1, 0.06 * K_E, 0.02 * K_E};
    cogging[0] = (hci_harmonic){6.0, 0.05, 0.02};
    machine.model = (hci_machine){.pole_pairs = 3, .back_emf = emf, .back_emf_count = 2};
    machine.pole_pairs = 3.0;
    machine.resistance_ohm = machine.inductance_d_H = machine.inductance_q_H = NAN;
    machine.dc_link_voltage_V = machine.max_current_A = machine.rated_current_A = NAN;
    order[0] = (hci_target_order){{0.0, 0.0, MEAN}, 1.0};
    target = (hci_target){order, 1};
    options.target = &target;
    options.limits.is_open[0] = true;
}

void tearDown(void)
{
    hci_solution_release(&solution);
}

static void solve(hci_status expected)
{
    hci_note note = {{0}};
    hci_solution_release(&solution);
    TEST_ASSERT_EQUAL_MESSAGE(expected, hci_solve(&machine, &options, &solution, &note), note.text);
    TEST_ASSERT_TRUE(solution.within_limits);
}

static double angle_of(int k)
{
    return 2.0 * REF_PI * k / ANGLES;
}

static double torque_Nm(double theta, const double i[3])
{
    double e[3];
    hci_waves_at(emf, machine.model.back_emf_count, theta, e);
    return e[0] * i[0] + e[1] * i[1] + e[2] * i[2] +
           hci_harmonics_at(cogging, machine.model.cogging_count, theta);
}

/* ---- with a neutral conductor ---- */

/* The shortest (i_b, i_c) of the wanted torque, whose direction is searched for: of each direction the length
 * that makes the torque. */
static double shortest_A2(double theta, double i[3])
{
    double least = HUGE_VAL, low = 0.0, high = 2.0 * REF_PI;
    for (int round = 0; round < 8; ++round) {
        const double width = (high - low) / 64.0;
        double best = low;
        for (int k = 0; k <= 64; ++k) {
            const double angle = low + width * k, unit[3] = {0.0, cos(angle), sin(angle)},
                         none[3] = {0.0, 0.0, 0.0};
            const double rest = torque_Nm(theta, none),
                         length = (MEAN - rest) / (torque_Nm(theta, unit) - rest);
            if (!(length > 0.0) || length * length >= least) continue;
            least = length * length;
            best = angle;
            for (int s = 0; s < 3; ++s)
                i[s] = length * unit[s];
        }
        low = best - width;
        high = best + width;
    }
    return least;
}

static void test_a_neutral_carries_what_the_open_phase_does_not(void)
{
    double copper_A2 = 0.0;
    machine.has_neutral = true;
    machine.model.cogging = cogging;
    machine.model.cogging_count = 1;
    solve(HCI_OK);
    TEST_ASSERT_EQUAL(HCI_COST_COPPER, solution.limit_cost);
    for (int k = 0; k < ANGLES; ++k) {
        double i[3], best[3];
        hci_waves_at(solution.current.wave, solution.current.count, angle_of(k), i);
        copper_A2 += shortest_A2(angle_of(k), best) / ANGLES;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, i[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, MEAN, torque_Nm(angle_of(k), i));
        TEST_ASSERT_DOUBLE_WITHIN(0.03, best[1], i[1]); /* orders up to 25 only */
        TEST_ASSERT_DOUBLE_WITHIN(0.03, best[2], i[2]);
    }
    const double made_A2 = hci_waves_mean_square(solution.current.wave, solution.current.count);
    TEST_ASSERT_TRUE(made_A2 > copper_A2 * (1.0 - 1e-6));
    TEST_ASSERT_DOUBLE_WITHIN(1e-5 * copper_A2, copper_A2, made_A2);
}

static void test_the_largest_torque_of_one_phase_and_the_neutral(void)
{
    double most_Nm = 0.0;
    machine.has_neutral = true;
    options.limits.is_open[1] = true;
    options.limit_current_A = 10.0;
    solve(HCI_NOT_REACHED);
    for (int k = 0; k < ANGLES; ++k) {
        const double i[3] = {0.0, 0.0, 10.0};
        most_Nm += fabs(torque_Nm(angle_of(k), i)) / ANGLES;
    }
    TEST_ASSERT_EQUAL(HCI_COST_TORQUE, solution.limit_cost);
    TEST_ASSERT_TRUE(solution.order[0].torque_Nm.cosine < most_Nm);
    TEST_ASSERT_TRUE(solution.order[0].torque_Nm.cosine >
                     0.99 * most_Nm); /* a rectangle of orders up to 25 */
}

/* ---- without one ---- */

/* At most what the peak makes at each angle, at most `most` of it: the mean. */
static double mean_of_clipped(double limit_A, double most_Nm)
{
    double sum_Nm = 0.0;
    for (int k = 0; k < ANGLES; ++k) {
        const double i[3] = {0.0, limit_A, -limit_A};
        sum_Nm += fmin(most_Nm, fabs(torque_Nm(angle_of(k), i))) / ANGLES;
    }
    return sum_Nm;
}

/* i_b = −i_c makes no torque where e_b = e_c, twice in a turn. So the least swing is the highest torque of
 * all that have the mean: no less than where each angle makes the lower of that and what its peak current
 * makes. */
static double least_swing_Nm(double limit_A)
{
    double low = 0.0, high = 100.0;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        *(mean_of_clipped(limit_A, middle) < MEAN ? &low : &high) = middle;
    }
    return high;
}

static double swing_Nm(void)
{
    double high = -HUGE_VAL, low = HUGE_VAL;
    for (int k = 0; k < ANGLES; ++k) {
        double i[3];
        hci_waves_at(solution.current.wave, solution.current.count, angle_of(k), i);
        high = fmax(high, torque_Nm(angle_of(k), i));
        low = fmin(low, torque_Nm(angle_of(k), i));
    }
    return high - low;
}

static void test_a_star_has_no_torque_twice_in_a_turn(void)
{
    static const double LIMIT_A[] = {16.0, 20.0, 30.0};
    options.minimise = HCI_MINIMISE_PEAK_TO_PEAK;
    for (int k = 0; k < 3; ++k) {
        const double least_Nm = least_swing_Nm(LIMIT_A[k]);
        options.limit_current_A = LIMIT_A[k];
        solve(HCI_NOT_REACHED);
        TEST_ASSERT_EQUAL(HCI_COST_RIPPLE, solution.limit_cost);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, MEAN, solution.order[0].torque_Nm.cosine);
        TEST_ASSERT_TRUE(swing_Nm() > least_Nm * (1.0 - 1e-3));
        TEST_ASSERT_TRUE(swing_Nm() < least_Nm * 1.03); /* orders up to 25 only */
    }
}

static void test_a_star_without_a_limit_has_the_torque_but_for_that(void)
{
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_EQUAL(HCI_COST_RIPPLE, solution.limit_cost);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, MEAN, solution.order[0].torque_Nm.cosine);
    TEST_ASSERT_TRUE(swing_Nm() >= MEAN);
}

/* ---- what is refused ---- */

static void test_a_choice_of_few_is_for_phases_alike(void)
{
    hci_note note = {{0}};
    options.choose_at_most = 5;
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, hci_solve(&machine, &options, &solution, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "at most K components"), note.text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_neutral_carries_what_the_open_phase_does_not);
    RUN_TEST(test_the_largest_torque_of_one_phase_and_the_neutral);
    RUN_TEST(test_a_star_has_no_torque_twice_in_a_turn);
    RUN_TEST(test_a_star_without_a_limit_has_the_torque_but_for_that);
    RUN_TEST(test_a_choice_of_few_is_for_phases_alike);
    return UNITY_END();
}
