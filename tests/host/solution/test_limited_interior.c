/* labels: slow */
/* Hundreds of programs of forty unknowns take half a minute of processor time with sanitizers. */
/* Limits on a machine with interior magnets, whose torque is not linear in the current: the largest mean
 * torque against the best current of all at each angle by search, and field weakening. */
#include <math.h>
#include <string.h>

#include "hci/host/solve/solve.h"
#include "hci/machine/frames.h"
#include "hci/machine/torque.h"
#include "support/reference.h"
#include "support/solving.h"

enum { ANGLES = 64, ALONG_A_SIDE = 200 };

void setUp(void)
{
    solving_start("data/machine_c", 8.0);
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
    TEST_ASSERT_NULL(strstr(solution.remark.text, "limits: "));
}

/* The most torque at one angle of all currents with |i_s| <= 5 A and no sum, which stands at their edge. */
static double most_Nm(double theta_rad, double limit_A)
{
    static const int CORNER[7][3] = {{1, -1, 0}, {1, 0, -1}, {0, 1, -1}, {-1, 1, 0},
                                     {-1, 0, 1}, {0, -1, 1}, {1, -1, 0}};
    double most = -HUGE_VAL;
    for (int side = 0; side < 6; ++side)
        for (int k = 0; k < ALONG_A_SIDE; ++k) {
            const double t = (double)k / ALONG_A_SIDE;
            double i[3];
            for (int s = 0; s < 3; ++s)
                i[s] = limit_A * ((1.0 - t) * CORNER[side][s] + t * CORNER[side + 1][s]);
            most = fmax(most, hci_torque_at(&machine.model, theta_rad, i));
        }
    return most;
}

static void test_the_largest_torque_of_a_peak_current(void)
{
    double bound_Nm = 0.0;
    options.limit_current_A = 5.0;
    solve(HCI_NOT_REACHED);
    for (int k = 0; k < ANGLES; ++k)
        bound_Nm += most_Nm(2.0 * REF_PI * k / ANGLES, 5.0) / ANGLES;
    TEST_ASSERT_EQUAL(HCI_COST_TORQUE, solution.limit_cost);
    TEST_ASSERT_TRUE(solution.newton_converged && solution.within_limits);
    TEST_ASSERT_TRUE(solution.peak_phase_current_A <= 5.0);
    TEST_ASSERT_TRUE(solution.order[0].torque_Nm.cosine < bound_Nm + 1e-4);
    TEST_ASSERT_TRUE(solution.order[0].torque_Nm.cosine > 0.999 * bound_Nm); /* orders up to 61 only */
}

static double mean_i_d_A(void)
{
    double sum = 0.0;
    for (int k = 0; k < 512; ++k) {
        const double theta_rad = 2.0 * REF_PI * k / 512.0;
        double i[3];
        hci_waves_at(solution.current.wave, solution.current.count, theta_rad, i);
        sum += hci_park(hci_clarke(i), theta_rad).d / 512.0;
    }
    return sum;
}

static void test_field_weakening(void)
{
    double free_A;
    solve(HCI_OK);
    free_A = mean_i_d_A();
    options.speed_rad_per_s = 1500.0 * REF_PI / 30.0; /* behind the dc link of 311 V that is declared */
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_TRUE(solution.limit[0].is_declared && solution.limit[0].binds);
    TEST_ASSERT_TRUE(solution.peak_line_voltage_V <= 311.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 8.0, solution.order[0].torque_Nm.cosine);
    TEST_ASSERT_TRUE(mean_i_d_A() < 2.0 * free_A && free_A < 0.0);
}

/* A limit that is just not kept costs nothing of the torque, and little copper: with the components that the
 * currents have without it. The less it is kept the more, and 1 A of it what the slope of that says. */
static void test_a_limit_a_little_below_the_peak(void)
{
    double limit_A[2], copper_A2[2], gain[2];
    solve(HCI_OK);
    const double peak_A = solution.peak_phase_current_A, least_A2 = solution.mean_square_A2;
    const size_t count = solution.current.count;
    for (int k = 0; k < 2; ++k) {
        options.limit_current_A = limit_A[k] = (k == 0 ? 0.98 : 0.99) * peak_A;
        solve(HCI_OK);
        TEST_ASSERT_TRUE(solution.within_limits && solution.newton_converged);
        TEST_ASSERT_EQUAL(HCI_COST_COPPER, solution.limit_cost);
        TEST_ASSERT_EQUAL(count, solution.current.count);
        copper_A2[k] = solution.mean_square_A2;
        gain[k] = solution.limit[0].gain;
    }
    const double slope = (copper_A2[0] - copper_A2[1]) / (limit_A[1] - limit_A[0]);
    TEST_ASSERT_TRUE(least_A2 < copper_A2[1] && copper_A2[0] < 1.003 * least_A2);
    TEST_ASSERT_TRUE(gain[1] < slope && slope < gain[0]);
}

/* Every component up to order 61, which the currents within limits have where none are named. */
enum { COMPONENTS = 21 };

static void use_components(void)
{
    static hci_component component[COMPONENTS];
    static hci_set name[COMPONENTS];
    static const hci_component_set SET = {component, name, COMPONENTS, {{0}}};
    for (int k = 0; k < COMPONENTS; ++k) {
        component[k] =
            (hci_component){1.0 + 6.0 * ((k + 1) / 2) - (k % 2 == 1 ? 2.0 : 0.0), k % 2 == 1 ? -1 : 1};
        name[k] = k % 2 == 1 ? HCI_SET_NEG : HCI_SET_POS;
    }
    options.set = &SET;
}

/* Where the torque is as wanted within a limit, there is no ripple to be made smallest. */
static void test_a_wish_that_is_met_changes_nothing(void)
{
    static const hci_minimise WHAT[] = {HCI_MINIMISE_WORST, HCI_MINIMISE_PEAK_TO_PEAK, HCI_MINIMISE_RMS};
    solve(HCI_OK);
    const double least_A2 = solution.mean_square_A2;
    const size_t count = solution.current.count;
    options.limits.rms_A[0] = options.limits.rms_A[1] = options.limits.rms_A[2] = 5.0;
    for (int k = 0; k < 3; ++k) {
        options.minimise = WHAT[k];
        solve(HCI_OK);
        TEST_ASSERT_EQUAL(count, solution.current.count);
        TEST_ASSERT_EQUAL_DOUBLE(least_A2, solution.mean_square_A2);
        TEST_ASSERT_EQUAL(HCI_COST_NONE, solution.limit_cost);
    }
}

/* A limit that is never touched leaves the way to the smallest ripple as it is without one. */
static void test_a_limit_far_off_leaves_the_smallest_ripple(void)
{
    double worst_Nm[2];
    use_components();
    options.minimise = HCI_MINIMISE_WORST;
    for (int k = 0; k < 2; ++k) {
        for (int s = 0; s < 3; ++s)
            options.limits.rms_A[s] = k == 0 ? 0.0 : 5.0;
        solve(HCI_NOT_REACHED);
        TEST_ASSERT_TRUE(solution.newton_converged);
        worst_Nm[k] = solution.worst_error_Nm;
    }
    TEST_ASSERT_TRUE(worst_Nm[0] < 1e-4);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, worst_Nm[0], worst_Nm[1]);
}

/* Nor are currents within limits worse than those without that keep them. */
static void test_the_currents_without_limits_stay_where_none_are_better(void)
{
    use_components();
    solve(HCI_NOT_REACHED);
    const double least_A2 = solution.mean_square_A2;
    for (int s = 0; s < 3; ++s)
        options.limits.rms_A[s] = 5.0;
    options.minimise = HCI_MINIMISE_RMS;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_TRUE(solution.mean_square_A2 <= (1.0 + 1e-9) * least_A2);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_wish_that_is_met_changes_nothing);
    RUN_TEST(test_a_limit_far_off_leaves_the_smallest_ripple);
    RUN_TEST(test_the_currents_without_limits_stay_where_none_are_better);
    RUN_TEST(test_the_largest_torque_of_a_peak_current);
    RUN_TEST(test_field_weakening);
    RUN_TEST(test_a_limit_a_little_below_the_peak);
    return UNITY_END();
}
