/* How fast the currents of a run change beside the turning of the rotor. */
#include "hci/host/recording/predict.h"

#include <math.h>

#include "hci/effects/effect.h"
#include "support/recording.h"
#include "unity.h"

enum { N = 400, P = 3 };

#define STEP_S  1e-4
#define SPEED   40.0
#define PER_S_D 3.0
#define PER_S_Q -7.0
#define PER_S_0 11.0

void setUp(void)
{
}

void tearDown(void)
{
}

/* i_d, i_q and the zero sequence rise and fall evenly, each at a rate of its own. */
static void test_each_component_has_its_own_rate(void)
{
    hci_run run = rec_make(N);
    hci_sample reading[N];
    hci_note note = {{0}};
    for (int k = 0; k < N; ++k) {
        const double t = STEP_S * k;
        run.time_s[k] = t, run.theta_m_rad[k] = SPEED * t, run.speed_rad_per_s[k] = SPEED;
        rec_phases(1.0 + PER_S_D * t, 2.0 + PER_S_Q * t, P * SPEED * t, run.i_A + 3 * k);
        for (int s = 0; s < 3; ++s)
            run.i_A[3 * k + s] += 0.5 + PER_S_0 * t;
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_predict_readings(&run, P, HCI_EFFECT_NEEDS_RATE, reading, &note));
    for (int k = 0; k < N; ++k) {
        double expected[3];
        rec_phases(PER_S_D, PER_S_Q, P * run.theta_m_rad[k], expected);
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(1e-6, expected[s] + PER_S_0, reading[k].change_A_per_s[s]);
    }
    rec_release(&run);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_component_has_its_own_rate);
    return UNITY_END();
}
