/* Which recordings take part in a fit. */
#include "host/diagnose/fit/dataset.h"

#include "support/searching.h"

enum { SAMPLES = 300 };

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* Voltages of the open machine have a role, an angle and a speed of their own and no torque: neither their
 * speed nor the noise of currents that nobody measured is one of the fit. */
static void test_a_recording_without_a_torque_is_not_fitted(void)
{
    record(SAMPLES, &(point){60.0, 9.0, 0.0, 0.0, 0.0});
    record(SAMPLES, &(point){600.0, 0.0, 0.0, 0.0, 0.0});
    record(SAMPLES, &(point){60.0, 4.0, 0.0, 0.0, 0.0});
    run[1].torque_source = HCI_TORQUE_NONE;
    role[2] = HCI_ROLE_HOLDOUT;
    search_start();
    TEST_ASSERT_TRUE(dataset.regression.use[0]);
    TEST_ASSERT_FALSE(dataset.regression.use[1]);
    TEST_ASSERT_FALSE(dataset.regression.use[2]);
    TEST_ASSERT_EQUAL_UINT64(1, hci_regression_runs_in_use(&dataset.regression));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_recording_without_a_torque_is_not_fitted);
    return UNITY_END();
}
