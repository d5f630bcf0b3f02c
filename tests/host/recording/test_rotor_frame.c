/* Currents in the rotor frame: against their definition by cosines, and back again. */
#include "host/recording/rotor_frame.h"

#include <math.h>

#include "support/recording.h"
#include "unity.h"

enum { N = 50, P = 3 };

void setUp(void)
{
}

void tearDown(void)
{
}

/* A few roundings of numbers up to 10. */
#define ROUNDING 1e-14

static void test_a_run_is_turned_by_its_electrical_angle(void)
{
    uint64_t seed = 4;
    hci_run run = rec_make(N);
    for (size_t k = 0; k < N; ++k) {
        const double d = ref_uniform(&seed, -5.0, 5.0), q = ref_uniform(&seed, -5.0, 5.0);
        run.theta_m_rad[k] = ref_uniform(&seed, -20.0, 20.0);
        rec_phases(d, q, P * run.theta_m_rad[k], run.i_A + 3 * k);
        const hci_dq i = hci_run_dq(&run, P, k);
        TEST_ASSERT_DOUBLE_WITHIN(10.0 * ROUNDING, d, i.d);
        TEST_ASSERT_DOUBLE_WITHIN(10.0 * ROUNDING, q, i.q);
        TEST_ASSERT_DOUBLE_WITHIN(10.0 * ROUNDING, 0.0, i.zero);
    }
    rec_release(&run);
}

static void test_phases_come_back(void)
{
    uint64_t seed = 5;
    for (int trial = 0; trial < N; ++trial) {
        hci_sample x = {.theta_m_rad = ref_uniform(&seed, -20.0, 20.0)};
        double back[3];
        for (int s = 0; s < 3; ++s)
            x.i_abc[s] = ref_uniform(&seed, -5.0, 5.0);
        hci_phases_of_dq(hci_sample_dq(&x, P), P * x.theta_m_rad, back);
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(10.0 * ROUNDING, x.i_abc[s], back[s]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_run_is_turned_by_its_electrical_angle);
    RUN_TEST(test_phases_come_back);
    return UNITY_END();
}
