/* With i_d = 0 a back-EMF of order 5 makes the same torque as one of order 7, and more of reluctance too: the
 * bound on currents that tell them apart allows for each of them. Seven diagnoses of small recordings: some
 * tenths of a second. */
#include "host/machine/expected_ripple.h"
#include "support/expecting.h"

enum { SAMPLES = 240 };

static double fifth[2], seventh[2]; /* back-EMF, N·m/A: of the sine and of the cosine */
static double self_H, mutual_H;     /* of the q axis, cos 6θ, and of both axes, sin 6θ */
static double saliency_H;           /* L_d − L_q, at all angles */
static const double LOW_NOISE_NM = 2e-3;

/* A rotor with magnets on the surface, whose L_d and L_q are on its sheet. */
static void declare_round_rotor(void)
{
    machine.inductance_d_H = machine.inductance_q_H = 2e-4;
}

void setUp(void)
{
    dataset_start();
    declare_round_rotor();
    fifth[0] = fifth[1] = seventh[0] = seventh[1] = self_H = mutual_H = saliency_H = 0.0;
}

void tearDown(void)
{
    dataset_end();
}

/* ---- the truth ---- */

static double wave(const double x[2], int n, double theta)
{
    return x[0] * sin(n * theta) + x[1] * cos(n * theta);
}

/* p (∂W'/∂θ + i_q ∂W'/∂i_d − i_d ∂W'/∂i_q), W' = 3/4 L i_q² cos 6θ + 3/2 M i_d i_q sin 6θ */
static double torque_of_iron(double theta, double d, double q)
{
    const double sine = sin(6.0 * theta), cosine = cos(6.0 * theta);
    return P * (1.5 * saliency_H * d * q + 0.75 * self_H * (-6.0 * sine * q * q - 2.0 * cosine * d * q) +
                1.5 * mutual_H * (6.0 * cosine * d * q + sine * (q * q - d * d)));
}

static double torque_of(double theta, double d, double q)
{
    double i[3], sum_Nm = 0.0;
    rec_phases(d, q, theta, i);
    for (int s = 0; s < 3; ++s) {
        const double x = theta - 2.0 * REF_PI * s / 3.0;
        sum_Nm += i[s] * (K_NM_PER_A * sin(x) + wave(fifth, 5, x) + wave(seventh, 7, x));
    }
    return sum_Nm + torque_of_iron(theta, d, q);
}

/* ---- recordings ---- */

static void measure_at(double d, double q)
{
    hci_run *r = add_run(2 * SAMPLES);
    for (size_t k = 0; k < r->count; ++k) {
        const double theta = 2.0 * REF_PI * (double)k / SAMPLES;
        r->theta_m_rad[k] = theta / P;
        r->time_s[k] = 1e-3 * (double)k;
        r->speed_rad_per_s[k] = 2.0 * REF_PI / P / SAMPLES / 1e-3;
        rec_phases(d, q, theta, r->i_A + 3 * k);
        r->torque_Nm[k] = torque_of(theta, d, q) + LOW_NOISE_NM * ref_normal(&seed);
    }
}

static void measure_without_id(void)
{
    for (int k = 0; k < 4; ++k)
        measure_at(0.0, 2.7 * k);
}

/* ---- what is said and what is so ---- */

static double error_at(double d, double q, double ripple_A)
{
    const double error_Nm = expected_error_Nm(&(current){d, q, ripple_A}, torque_of);
    TEST_ASSERT_EQUAL_INT(HCI_RIPPLE_KNOWN, expected.state);
    return error_Nm;
}

static void is_within(double error_Nm, double most_times)
{
    char text[96];
    snprintf(text, sizeof text, "error %g N·m, bound %g N·m", error_Nm, expected.error_peak_to_peak_Nm);
    TEST_ASSERT_TRUE_MESSAGE(error_Nm <= expected.error_peak_to_peak_Nm, text);
    TEST_ASSERT_TRUE_MESSAGE(expected.error_peak_to_peak_Nm <= most_times * error_Nm, text);
}

/* ---- tests ---- */

static void diagnose_without_id(void)
{
    measure_without_id();
    TEST_ASSERT_TRUE(diagnose(NULL) <= HCI_NOT_REACHED);
    TEST_ASSERT_EQUAL_UINT(200, diagnosis.uncertainty.machines);
}

static void test_two_orders_of_the_back_emf(void)
{
    fifth[0] = 0.004;
    seventh[0] = -0.003;
    diagnose_without_id();
    is_within(error_at(-2.0, 6.0, 0.2), 6.0);
    is_within(error_at(0.0, 6.0, 0.4), 6.0);
}

/* Phases that a rotor which looks alike both ways round does not have. */
static void test_two_orders_of_any_phase(void)
{
    fifth[1] = 0.004;
    seventh[1] = -0.003;
    diagnose_without_id();
    is_within(error_at(-2.0, 6.0, 0.2), 6.0);
}

static void test_two_inductances(void)
{
    self_H = 2e-4;
    mutual_H = -4e-4;
    diagnose_without_id();
    is_within(error_at(-3.0, 5.0, 0.2), 6.0);
}

/* The torque of i_d i_q shows in no recording, and is as large as rotors with magnets inside have it. */
static void test_saliency(void)
{
    machine.inductance_d_H = machine.inductance_q_H = NAN;
    saliency_H = -1.6e-3;
    diagnose_without_id();
    is_within(error_at(0.0, 6.0, 0.4), 5.0);
    is_within(error_at(-2.0, 6.0, 0.2), 5.0);
}

/* What sensors read as i_d did not flow, so that it tells nothing of L_d − L_q, however long it is read. */
static void test_saliency_where_id_is_noise(void)
{
    machine.inductance_d_H = machine.inductance_q_H = NAN;
    saliency_H = -1.6e-3;
    measure_without_id();
    for (size_t r = 0; r < runs.count; ++r)
        for (size_t k = 0; k < 3 * run[r].count; ++k)
            run[r].i_A[k] += 0.01 * ref_normal(&seed);
    TEST_ASSERT_TRUE(diagnose(NULL) <= HCI_NOT_REACHED);
    is_within(error_at(0.0, 6.0, 0.4), 5.0);
    is_within(error_at(-2.0, 6.0, 0.2), 5.0);
}

/* Currents that tell how all grows, and so that cubes and more are not as large as what was found. */
static void test_growth_is_recorded(void)
{
    fifth[0] = 0.004;
    seventh[0] = -0.003;
    measure_without_id();
    measure_at(-3.0, 2.7);
    measure_at(-3.0, 8.1);
    measure_at(-6.0, 5.4);
    TEST_ASSERT_TRUE(diagnose(NULL) <= HCI_NOT_REACHED);
    const double error_Nm = error_at(-5.0, 6.0, 0.4);
    char text[96];
    snprintf(text, sizeof text, "error %g N·m, bound %g N·m", error_Nm, expected.error_peak_to_peak_Nm);
    TEST_ASSERT_TRUE_MESSAGE(error_Nm <= expected.error_peak_to_peak_Nm, text);
    TEST_ASSERT_TRUE_MESSAGE(expected.error_peak_to_peak_Nm < 0.6 * LOW_NOISE_NM, text);
}

/* A run with i_d tells them apart: that it is to be recorded is said, and with it the bound is as narrow as
 * the noise. */
static void test_told_apart(void)
{
    fifth[0] = 0.004;
    seventh[0] = -0.003;
    diagnose_without_id();
    error_at(-2.0, 6.0, 0.2);
    const double before_Nm = expected.error_peak_to_peak_Nm;
    TEST_ASSERT_EQUAL_UINT(2, diagnosis.next_points); /* there and back, so that its friction is told too */
    TEST_ASSERT_EQUAL_DOUBLE(diagnosis.next[0].id_A, diagnosis.next[1].id_A);
    TEST_ASSERT_EQUAL_DOUBLE(diagnosis.next[0].iq_A, diagnosis.next[1].iq_A);
    TEST_ASSERT_EQUAL_DOUBLE(diagnosis.next[0].speed_rad_per_s, -diagnosis.next[1].speed_rad_per_s);
    TEST_ASSERT_EQUAL_DOUBLE(diagnosis.next[0].turns, diagnosis.next[1].turns);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(diagnosis.next[0].why, "back_emf sine_5"), diagnosis.next[0].why);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(diagnosis.next[0].why, "back_emf sine_7"), diagnosis.next[0].why);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(diagnosis.advice, "in part: 10 turns at"), diagnosis.advice);
    const hci_next_point next = diagnosis.next[0];
    TEST_ASSERT_TRUE(next.id_A != 0.0 && isfinite(next.iq_A));
    hci_diagnosis_release(&diagnosis);
    for (int k = 0; k < 5; ++k)
        measure_at(next.id_A, next.iq_A);
    TEST_ASSERT_TRUE(diagnose(NULL) <= HCI_NOT_REACHED);
    error_at(-2.0, 6.0, 0.2);
    TEST_ASSERT_TRUE(expected.error_peak_to_peak_Nm < 0.25 * before_Nm);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_two_orders_of_the_back_emf);
    RUN_TEST(test_two_orders_of_any_phase);
    RUN_TEST(test_two_inductances);
    RUN_TEST(test_saliency);
    RUN_TEST(test_saliency_where_id_is_noise);
    RUN_TEST(test_growth_is_recorded);
    RUN_TEST(test_told_apart);
    return UNITY_END();
}
