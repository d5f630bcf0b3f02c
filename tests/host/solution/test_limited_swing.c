/* The smallest swing of machine A within a peak current, which is a straight line over the limit between two
 * corners of the program. */
#include <string.h>

#include "hci/host/solve/solve.h"
#include "support/solving.h"

void setUp(void)
{
    solving_start("data/machine_a", 2.46);
}

void tearDown(void)
{
    solving_end();
}

static double swing_Nm(double limit_A)
{
    hci_note note = {{0}};
    hci_solution_release(&solution);
    options.limit_current_A = limit_A;
    options.minimise = HCI_MINIMISE_PEAK_TO_PEAK;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_NOT_REACHED, hci_solve(&machine, &options, &solution, &note), note.text);
    TEST_ASSERT_NULL(strstr(solution.remark.text, "limits: "));
    TEST_ASSERT_TRUE(solution.within_limits);
    TEST_ASSERT_EQUAL(HCI_COST_RIPPLE, solution.limit_cost);
    return solution.minimised_Nm;
}

/* A first answer between the angles whose torque is as good as flat says nothing of the angles that matter.
 */
static void test_a_flat_torque_leaves_no_angle_out(void)
{
    const double narrow_Nm = swing_Nm(23.40), wide_Nm = swing_Nm(23.44);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.5 * (narrow_Nm + wide_Nm), swing_Nm(23.42));
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * solution.limit[0].gain, solution.limit[0].gain,
                              (narrow_Nm - wide_Nm) / 0.04);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_flat_torque_leaves_no_angle_out);
    return UNITY_END();
}
