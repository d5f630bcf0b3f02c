/* A locked rotor with direct current: at each angle one direction of the current vector, and few samples. The
 * iron saturates as no polynomial does, and nothing else is wrong: what a series in the currents misses is
 * neither a sensor's error nor a torque without current, nor is it noise. */
#define _XOPEN_SOURCE 700
#include "support/diagnosing.h"

enum { SAMPLES = 23 };

static const double CURRENT_A[] = {2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0};

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* W' = ∫ψ_q di_q + ¾ L_d i_d², ψ_q = 3/2 L_q I asinh(i_q/I): T = p (i_q ∂W'/∂i_d − i_d ∂W'/∂i_q) beside the
 * torque of the magnets. */
static double torque_of(double id, double iq)
{
    static const double D_H = 0.004, Q_H = 0.03, KNEE_A = 1.5;
    return 1.5 * K_NM_PER_A * iq + 1.5 * P * (D_H * id * iq - id * Q_H * KNEE_A * asinh(iq / KNEE_A));
}

/* Half an electrical turn with so much in phase a, and half of it back in b and in c. */
static void record_locked(double current_A)
{
    hci_run *r = add_run(SAMPLES);
    free(r->time_s);
    free(r->speed_rad_per_s);
    r->time_s = r->speed_rad_per_s = NULL;
    for (size_t k = 0; k < SAMPLES; ++k) {
        const double theta = REF_PI * (double)k / SAMPLES;
        r->theta_m_rad[k] = theta / P;
        r->i_A[3 * k] = current_A;
        r->i_A[3 * k + 1] = r->i_A[3 * k + 2] = -0.5 * current_A;
        r->torque_Nm[k] =
            torque_of(-current_A * cos(theta), current_A * sin(theta)) + NOISE_NM * ref_normal(&seed);
    }
}

/* Every run but those with their bit in left_out. */
static void diagnose_but(unsigned left_out)
{
    for (unsigned k = 0; k < sizeof CURRENT_A / sizeof *CURRENT_A; ++k)
        if (!(left_out >> k & 1u)) record_locked(CURRENT_A[k]);
    TEST_ASSERT_TRUE(diagnose(NULL) <= HCI_NOT_REACHED);
}

static void test_iron_is_all_that_is_found(void)
{
    static const unsigned LEFT_OUT[] = {0x00, 0x01, 0x40, 0x0a, 0x2a, 0x38, 0x55, 0x0f, 0x71, 0x1c};
    size_t said = 0;
    for (size_t k = 0; k < sizeof LEFT_OUT / sizeof *LEFT_OUT; ++k) {
        diagnose_but(LEFT_OUT[k]);
        TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("reluctance")->verdict);
        said += diagnosis.magnetic_only;
        for (size_t j = 0; j < diagnosis.findings; ++j) {
            const hci_finding *f = &diagnosis.finding[j];
            const bool iron = strcmp(f->effect, "reluctance") == 0 || strcmp(f->effect, "saturation") == 0 ||
                              strcmp(f->effect, "unknown") == 0;
            TEST_ASSERT_TRUE_MESSAGE(iron || f->verdict == HCI_FINDING_REJECTED, f->effect);
        }
        tearDown();
        setUp();
    }
    TEST_ASSERT_TRUE(said > 0); /* where an error of sensors would have come in */
}

/* What neighbours have in common is none of the noise: the iron that a series misses is larger than that by
 * far, and an error beside which it is not small is not called explained. */
static void test_what_is_smooth_is_no_noise(void)
{
    static const unsigned LEFT_OUT[] = {0x00, 0x01, 0x40, 0x0a};
    for (size_t k = 0; k < sizeof LEFT_OUT / sizeof *LEFT_OUT; ++k) {
        diagnose_but(LEFT_OUT[k]);
        TEST_ASSERT_DOUBLE_WITHIN(0.5 * NOISE_NM, NOISE_NM, diagnosis.noise_Nm);
        if (diagnosis.rms_after_Nm > 0.1 * diagnosis.rms_before_Nm)
            TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_PARTLY, diagnosis.verdict);
        tearDown();
        setUp();
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_iron_is_all_that_is_found);
    RUN_TEST(test_what_is_smooth_is_no_noise);
    return UNITY_END();
}
