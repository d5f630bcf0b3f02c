/* Two or three effects of few values before a series in the currents that describes nearly anything. */
#include "host/diagnose/search/few_values.h"

#include "host/diagnose/search/backward.h"
#include "host/diagnose/search/forward.h"
#include "support/searching.h"

#define WEAKER    0.06   /* share of the torque per ampere */
#define SALIENT_H 0.0004 /* L_d − L_q */

enum { SAMPLES = 300, POINTS = 7 }; /* a mechanical turn */

static const double SPEED[POINTS] = {25.0, -25.0, 25.0, -150.0, 150.0, -25.0, 150.0};
static const double D_A[POINTS] = {0.0, 0.0, 0.0, -4.5, 3.0, 0.0, 0.0};
static const double Q_A[POINTS] = {0.0, 0.0, 10.0, 6.0, 8.0, -10.0, 3.0};

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* Weak magnets and a salient rotor: T = 3/2 K (1 − w) i_q + 3/2 p ΔL i_d i_q. */
static void record_salient(double brake_Nm)
{
    for (int k = 0; k < POINTS; ++k) {
        const double d = D_A[k], q = Q_A[k];
        record(SAMPLES, &(point){SPEED[k], q, 0.0, SPEED[k] < 0.0 ? -brake_Nm : brake_Nm, 0.0});
        for (size_t j = 0; j < SAMPLES; ++j) { /* i_d makes no torque with a sinusoidal back-EMF */
            rec_phases(d, q, P * run[k].theta_m_rad[j], run[k].i_A + 3 * j);
            run[k].torque_Nm[j] += 1.5 * q * (P * SALIENT_H * d - K_NM_PER_A * WEAKER);
        }
    }
    search_start();
}

static void is_weak_and_salient(void)
{
    const hci_effect_term *weak = term_in(&model.candidates, "back_emf", "sine", 1.0);
    const hci_effect_term *salient = term_in(&model.candidates, "reluctance", "dd_cosine", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * weak->std_error, -WEAKER * K_NM_PER_A, weak->value);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * salient->std_error, SALIENT_H, salient->value);
    TEST_ASSERT_FALSE(model_has("saturation"));
}

/* A back-EMF out of phase, two values of one effect, describes it better than either alone. */
static void test_a_pair_of_no_more_values_competes(void)
{
    bool added = false;
    record_salient(0.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_forward(&search, &model, &added, &note));
    TEST_ASSERT_TRUE(added);
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_terms_in(&model.candidates));
    is_weak_and_salient();
}

static void test_a_series_gives_way_to_few_values(void)
{
    bool changed = false;
    record_salient(0.05);
    model.candidates.reference_current_A = 10.0;
    model_add("saturation", "d1q2_cosine", NULL, 0.0);
    model_add("friction", "coulomb", "viscous", 0.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_few_values(&search, &model, &changed, &note));
    TEST_ASSERT_TRUE(changed && model_has("friction"));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_prune(&search, &model, &note));
    is_weak_and_salient();
}

/* Without a series nothing is looked for. */
static void test_few_values_stay(void)
{
    bool changed = false;
    record_salient(0.05);
    model_add("friction", "coulomb", "viscous", 0.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_few_values(&search, &model, &changed, &note));
    TEST_ASSERT_FALSE(changed);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_pair_of_no_more_values_competes);
    RUN_TEST(test_a_series_gives_way_to_few_values);
    RUN_TEST(test_few_values_stay);
    return UNITY_END();
}
