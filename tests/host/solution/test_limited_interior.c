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

/* A limit that is just not kept costs next to nothing of the torque. */
static void test_a_limit_a_little_below_the_peak(void)
{
    solve(HCI_OK);
    options.limit_current_A = 0.99 * solution.peak_phase_current_A;
    solve(HCI_NOT_REACHED);
    TEST_ASSERT_TRUE(solution.within_limits && solution.newton_converged);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 8.0, solution.order[0].torque_Nm.cosine);
    TEST_ASSERT_TRUE(solution.worst_error_Nm < 1e-3);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_largest_torque_of_a_peak_current);
    RUN_TEST(test_field_weakening);
    RUN_TEST(test_a_limit_a_little_below_the_peak);
    return UNITY_END();
}
