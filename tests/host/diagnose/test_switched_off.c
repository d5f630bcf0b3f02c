/* Recordings of a drive that is switched off, beside others whose current sensors have zeros that are off:
 * its control keeps what they read, so that the zeros make a torque of order 1 wherever a current flows, and
 * none where none does. */
#include <math.h>

#include "support/diagnosing.h"

enum { SAMPLES = 300, TURNS = 4 };

static const double ZERO_A[3] = {0.5, -0.3, -0.2}, COGGING_NM = 0.08;

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* What flows is what is read less the zeros; nothing where the drive is off. */
static void measure(double iq_A, bool is_off, double way)
{
    hci_run *r = add_run(SAMPLES * TURNS);
    r->switched_off = is_off;
    for (size_t k = 0; k < r->count; ++k) {
        const double theta_m = way * 2.0 * REF_PI * (double)k / SAMPLES, theta = P * theta_m;
        r->theta_m_rad[k] = theta_m;
        r->time_s[k] = 2e-3 * (double)k;
        r->speed_rad_per_s[k] = way * 2.0 * REF_PI / SAMPLES / 2e-3;
        if (!is_off) rec_phases(0.0, iq_A, theta, r->i_A + 3 * k);
        r->torque_Nm[k] = COGGING_NM * sin(6.0 * theta) + NOISE_NM * ref_normal(&seed);
        for (int s = 0; s < 3 && !is_off; ++s)
            r->torque_Nm[k] +=
                K_NM_PER_A * sin(theta - 2.0 * REF_PI * s / 3.0) * (r->i_A[3 * k + (size_t)s] - ZERO_A[s]);
    }
}

static void test_zeros_are_told_from_cogging_torque(void)
{
    measure(0.0, true, 1.0);
    measure(0.0, true, -1.0);
    measure(4.0, false, 1.0);
    measure(8.0, false, 1.0);
    measure(8.0, false, -1.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("current_offset")->verdict);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, COGGING_NM, term("cogging", "sine", 6.0)->value);
    for (size_t k = 0; k < diagnosis.effects.list.count; ++k) {
        const hci_effect *e = &diagnosis.effects.list.effect[k];
        for (size_t j = 0; j < e->count; ++j)
            TEST_ASSERT_FALSE_MESSAGE(e->type->any_phase && fabs(e->term[j].order - 1.0) < 0.1,
                                      e->type->name);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_zeros_are_told_from_cogging_torque);
    return UNITY_END();
}
