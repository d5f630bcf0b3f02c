/* labels: slow */
/* Cogging torque that a slow turn has shown has side bands of an encoder that is not centred; with a turn
 * under load beside it the search finds the encoder where that cogging torque is not held, and keeps it where
 * it explains all. */
#include <math.h>

#include "support/diagnosing.h"

enum { TURN = 1500, SAMPLES = 4 * TURN };

static const double COGGING_NM = 0.06, ENCODER_RAD = 0.012, COULOMB_NM = 0.05, FIFTH = 0.05;

static hci_harmonic declared[5];

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    machine.model.cogging = machine.cogging;
    machine.model.cogging_count = 0;
    dataset_end();
}

/* Two turns forward and two back against a load, over the angle that an encoder reads. */
static void turn_slowly(double encoder_rad, double load_Nm)
{
    hci_run *r = add_run(SAMPLES);
    r->torque_source = HCI_TORQUE_HOLDING;
    r->mean_is_unknown = load_Nm > 0.0;
    for (size_t k = 0; k < r->count; ++k) {
        const bool back = k >= r->count / 2;
        const double x = 2.0 * REF_PI * (double)(back ? r->count - 1 - k : k) / TURN, theta = P * x;
        const double per_A = 1.5 * K_NM_PER_A * (1.0 + FIFTH * cos(6.0 * theta));
        const double torque = load_Nm + (back ? -COULOMB_NM : COULOMB_NM) - COGGING_NM * sin(12.0 * theta);
        r->time_s[k] = 0.02 * (double)k;
        r->theta_m_rad[k] = x + encoder_rad * sin(x);
        r->speed_rad_per_s[k] = (back ? -2.0 : 2.0) * REF_PI / TURN / 0.02;
        rec_phases(0.0, torque / per_A + 0.01 * ref_normal(&seed), P * r->theta_m_rad[k], r->i_A + 3 * k);
    }
}

/* J_n by its integral over a turn. */
static double bessel(int n, double z)
{
    double sum = 0.0;
    for (int k = 0; k < 360; ++k) {
        const double x = 2.0 * REF_PI * k / 360.0;
        sum += cos(n * x - z * sin(x)) / 360.0;
    }
    return sum;
}

/* Of sin(12 θ) over the angle of the encoder, which is what such a turn shows without a load. */
static void declare_what_one_turn_shows(void)
{
    const double z = 12.0 * P * ENCODER_RAD;
    for (int n = -2; n <= 2; ++n)
        declared[n + 2] = (hci_harmonic){12.0 - n / (double)P, COGGING_NM * bessel(n, z), 0.0};
    machine.model.cogging = declared;
    machine.model.cogging_count = 5;
}

static hci_status diagnose_further(void)
{
    hci_note note = {{0}};
    const hci_effects none = {NULL, 0};
    hci_diagnosis_release(&diagnosis);
    const hci_status status = hci_diagnose_further(&machine, &none, &runs, &options, &diagnosis, &note);
    TEST_ASSERT_TRUE_MESSAGE(status <= HCI_NOT_REACHED, note.text);
    return status;
}

static void test_side_bands_are_of_the_encoder(void)
{
    declare_what_one_turn_shows();
    turn_slowly(ENCODER_RAD, 0.0);
    turn_slowly(ENCODER_RAD, 0.9);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_TRUE(diagnosis.rms_after_Nm > 5.0 * diagnosis.noise_Nm);
    (void)diagnose_further();
    TEST_ASSERT_TRUE(diagnosis.without_cogging);
    TEST_ASSERT_TRUE(diagnosis.rms_after_Nm < 1.05 * diagnosis.noise_Nm);
    TEST_ASSERT_EQUAL_UINT64(5, machine.model.cogging_count); /* the caller's stays */
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * COGGING_NM, COGGING_NM, term("cogging", "sine", 12.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.02 * ENCODER_RAD, ENCODER_RAD,
                              term("position_eccentricity", "mech_sine", 1.0)->value);
}

/* What explains the recordings as it is stays. */
static void test_cogging_torque_that_holds(void)
{
    declared[0] = (hci_harmonic){12.0, COGGING_NM, 0.0};
    machine.model.cogging = declared;
    machine.model.cogging_count = 1;
    turn_slowly(0.0, 0.0);
    turn_slowly(0.0, 0.0);
    (void)diagnose_further();
    TEST_ASSERT_FALSE(diagnosis.without_cogging);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_cogging_torque_that_holds);
    RUN_TEST(test_side_bands_are_of_the_encoder);
    return UNITY_END();
}
