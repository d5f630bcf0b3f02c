/* What current sensors make of each other's current looks like phases that differ, and what two of them have
 * in common like a weaker magnet: neither is said to be certain, and the bound allows for both. In a holding
 * test no gain of the sensors is found in the noise of their sum. Some tenths of a second. */
#include <math.h>

#include "support/expecting.h"

enum { SAMPLES = 240 };

static const double READ_A = 0.01;

static double phase_b; /* times its declared back-EMF, besides */

void setUp(void)
{
    phase_b = 1.0;
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* ---- the truth ---- */

static double magnets; /* times the declared back-EMF */

static double torque_of(double theta, double d, double q)
{
    double i[3], sum_Nm = 0.0;
    rec_phases(d, q, theta, i);
    for (int s = 0; s < 3; ++s)
        sum_Nm +=
            magnets * (s == 1 ? phase_b : 1.0) * K_NM_PER_A * i[s] * sin(theta - 2.0 * REF_PI * s / 3.0);
    return sum_Nm;
}

/* ---- recordings ---- */

/* Sensor a reads so much of i_b besides; gains of all three. */
typedef struct {
    double a_of_b, gain[3];
} sensors;

static void measure_at(const sensors *x, double d, double q)
{
    hci_run *r = add_run(4 * SAMPLES);
    r->has_sum = true;
    for (size_t k = 0; k < r->count; ++k) {
        const double theta = 2.0 * REF_PI * (double)k / SAMPLES;
        double *i_A = r->i_A + 3 * k;
        r->theta_m_rad[k] = theta / P;
        r->time_s[k] = 1e-3 * (double)k;
        r->speed_rad_per_s[k] = 2.0 * REF_PI / P / SAMPLES / 1e-3;
        rec_phases(d, q, theta, i_A);
        r->torque_Nm[k] = torque_of(theta, d, q) + NOISE_NM * ref_normal(&seed);
        i_A[0] += x->a_of_b * i_A[1];
        for (int s = 0; s < 3; ++s)
            i_A[s] = (1.0 + x->gain[s]) * i_A[s] + READ_A * ref_normal(&seed);
    }
}

static void measure(const sensors *x)
{
    measure_at(x, 0.0, 0.0);
    measure_at(x, 0.0, 9.0);
    measure_at(x, -6.0, 9.0);
    measure_at(x, 5.0, 4.0);
    measure_at(x, 0.0, -7.0);
    TEST_ASSERT_EQUAL(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL(HCI_DIAGNOSIS_AMBIGUOUS, diagnosis.verdict);
}

static void bound_holds(double d, double q)
{
    char text[96];
    const double error_Nm = expected_error_Nm(&(current){d, q, 0.2}, torque_of);
    TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_KNOWN, expected.state);
    snprintf(text, sizeof text, "error %g N·m, bound %g N·m", error_Nm, expected.error_peak_to_peak_Nm);
    TEST_ASSERT_TRUE_MESSAGE(error_Nm <= expected.error_peak_to_peak_Nm, text);
}

static bool is_said(const char *words)
{
    char text[4096];
    hci_diagnosis_words(&diagnosis, text, sizeof text);
    return strstr(text, words) != NULL;
}

/* ---- tests ---- */

static void test_a_sensor_that_reads_another_current(void)
{
    magnets = 1.0;
    measure(&(sensors){.a_of_b = 0.03});
    TEST_ASSERT_EQUAL(HCI_FINDING_AMBIGUOUS, found("current_gain")->verdict);
    TEST_ASSERT_EQUAL(0, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_TRUE(is_said("apart from current sensors") || is_said("from current sensors that read"));
    bound_holds(0.0, 8.0);
    bound_holds(-4.0, 6.0);
}

static void test_what_gains_have_in_common_may_be_magnets(void)
{
    magnets = 0.98;
    measure(&(sensors){.gain = {0.0, 0.0, 0.02}});
    TEST_ASSERT_EQUAL(HCI_FINDING_AMBIGUOUS, found("current_gain")->verdict);
    TEST_ASSERT_EQUAL(HCI_FINDING_AMBIGUOUS, found("back_emf")->verdict);
    bound_holds(0.0, 8.0);
}

/* One sensor alone has nothing in common with others. */
static void test_one_gain_is_told(void)
{
    magnets = 1.0;
    const sensors x = {.gain = {0.0, 0.0, 0.02}};
    measure_at(&x, 0.0, 0.0);
    measure_at(&x, 0.0, 9.0);
    measure_at(&x, -6.0, 9.0);
    measure_at(&x, 5.0, 4.0);
    TEST_ASSERT_EQUAL(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("current_gain")->verdict);
    TEST_ASSERT_EQUAL(1, count_of(HCI_FINDING_ADDED));
}

/* Three gains of which no two are alike have nothing in common, whichever sensor has which. */
static void test_gains_that_differ_are_told(void)
{
    static const double GAIN[] = {0.03, 0.01, -0.02};
    magnets = 1.0;
    for (int turn = 0; turn < 3; ++turn) {
        const sensors x = {.gain = {GAIN[turn], GAIN[(turn + 1) % 3], GAIN[(turn + 2) % 3]}};
        dataset_end();
        dataset_start();
        measure_at(&x, 0.0, 0.0);
        measure_at(&x, 0.0, 9.0);
        measure_at(&x, -6.0, 9.0);
        measure_at(&x, 5.0, 4.0);
        measure_at(&x, 0.0, -7.0);
        TEST_ASSERT_EQUAL(HCI_OK, diagnose(NULL));
        TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("current_gain")->verdict);
        TEST_ASSERT_EQUAL(1, count_of(HCI_FINDING_ADDED));
        TEST_ASSERT_EQUAL(0, count_of(HCI_FINDING_AMBIGUOUS));
    }
}

/* Of the torque at the sensor, and of order 6 of the cogging torque beside what is declared. */
static void read_wrong(double gain, double differs_Nm)
{
    for (size_t k = 0; k < runs.count; ++k)
        for (size_t j = 0; j < run[k].count; ++j) {
            const double theta = P * run[k].theta_m_rad[j],
                         declared_Nm = 0.1 * sin(6.0 * theta) + 0.06 * sin(12.0 * theta);
            run[k].torque_Nm[j] = (1.0 + gain) * (run[k].torque_Nm[j] + declared_Nm +
                                                  differs_Nm * (cos(6.0 * theta) - sin(6.0 * theta)));
        }
}

static void with_cogging(void)
{
    hci_note text = {{0}};
    files_write(files_path("cogging.csv"), "order,amplitude_Nm,phase_rad\n6,0.1,0\n12,0.06,0\n");
    hci_machine_release(&machine);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &text), text.text);
}

static void measure_five(void)
{
    static const double D_A[] = {0.0, 0.0, -6.0, 5.0, 0.0}, Q_A[] = {0.0, 9.0, 9.0, 4.0, -7.0};
    for (int k = 0; k < 5; ++k)
        measure_at(&(sensors){.a_of_b = 0.0}, D_A[k], Q_A[k]);
}

/* A torque sensor that reads too little, of a machine one order of whose cogging torque is another one: the
 * other order shows that it is the sensor, and no gain that the phases or their sensors have in common. */
static void test_a_gain_of_the_torque_sensor_beside_another_cogging_torque(void)
{
    magnets = 1.0;
    with_cogging();
    measure_five();
    read_wrong(-0.06, 0.08);
    TEST_ASSERT_EQUAL(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("torque_gain")->verdict);
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("cogging")->verdict);
    TEST_ASSERT_EQUAL(2, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_DOUBLE_WITHIN(0.002, -0.06, term("torque_gain", "gain", 0.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.004, 0.08, term("cogging", "cosine", 6.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.004, -0.08, term("cogging", "sine", 6.0)->value);
}

/* The same beside a phase that is weaker than the others, which is not taken for the gain. */
static void test_a_gain_of_the_torque_sensor_beside_a_weak_phase(void)
{
    magnets = 1.0;
    phase_b = 0.95;
    with_cogging();
    measure_five();
    read_wrong(-0.06, 0.08);
    diagnose(NULL);
    TEST_ASSERT_EQUAL(HCI_FINDING_ADDED, found("torque_gain")->verdict);
    TEST_ASSERT_DOUBLE_WITHIN(0.004, 0.08, term("cogging", "cosine", 6.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.004, -0.06, term("torque_gain", "gain", 0.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.012, -0.05, term("phase_imbalance", "b", 0.0)->value);
}

/* The current that holds a shaft which turns slowly, one way all the time, against friction and cogging. */
static void hold_at(double speed_rad_per_s)
{
    hci_run *r = add_run(8000);
    r->torque_source = HCI_TORQUE_HOLDING;
    r->has_sum = true;
    for (size_t k = 0; k < r->count; ++k) {
        r->time_s[k] = 5e-3 * (double)k;
        r->theta_m_rad[k] = speed_rad_per_s * r->time_s[k];
        r->speed_rad_per_s[k] = speed_rad_per_s;
        const double held_Nm = copysign(0.1, speed_rad_per_s) - 0.1 * sin(12.0 * P * r->theta_m_rad[k]);
        rec_phases(0.0, held_Nm / (1.5 * K_NM_PER_A), P * r->theta_m_rad[k], r->i_A + 3 * k);
        for (size_t s = 0; s < 3; ++s)
            r->i_A[3 * k + s] += 0.05 * ref_normal(&seed);
    }
}

static void test_no_gain_is_found_in_noise(void)
{
    hold_at(0.314);
    hold_at(-0.314);
    hold_at(0.42);
    TEST_ASSERT_EQUAL(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL(HCI_FINDING_REJECTED, found("current_gain")->verdict);
    TEST_ASSERT_EQUAL(2, count_of(HCI_FINDING_ADDED));
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 0.1, term("friction", "coulomb", 0.0)->value);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_sensor_that_reads_another_current);
    RUN_TEST(test_what_gains_have_in_common_may_be_magnets);
    RUN_TEST(test_one_gain_is_told);
    RUN_TEST(test_gains_that_differ_are_told);
    RUN_TEST(test_a_gain_of_the_torque_sensor_beside_another_cogging_torque);
    RUN_TEST(test_a_gain_of_the_torque_sensor_beside_a_weak_phase);
    RUN_TEST(test_no_gain_is_found_in_noise);
    return UNITY_END();
}
