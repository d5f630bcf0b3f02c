/* When the whole co-energy may be fitted: where the currents differ from run to run. */
#include "host/diagnose/search/coenergy.h"

#include "support/searching.h"

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* Six runs whose iron saturates, at 8 A or from 3 to 8 A; nearly without noise. */
static void record_saturated(double step_A)
{
    for (int k = 0; k < 6; ++k) {
        const double q = 8.0 - step_A * k;
        record(150, &(point){k % 2 ? 60.0 : -60.0, q, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < 150; ++j)
            run[k].torque_Nm[j] += -4e-4 * q * q * q * (1.0 + 0.2 * sin(6.0 * P * run[k].theta_m_rad[j]));
    }
    search_start();
    how.resolution_Nm = 0.5 * NOISE_NM;
    model_add("saturation", "d0q3_sine", NULL, 6.0);
    model_add("saturation", "d1q2_cosine", NULL, 0.0);
    model.candidates.reference_current_A = 8.0;
    model_fit();
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_search_coenergy(&search, &model, &note), note.text);
}

static void test_of_runs_at_different_currents(void)
{
    record_saturated(1.0);
    TEST_ASSERT_TRUE(search.whole_coenergy);
}

static void test_not_of_runs_at_the_same_currents(void)
{
    record_saturated(0.0);
    TEST_ASSERT_FALSE(search.whole_coenergy);
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_terms_in(&model.candidates));
}

/* Twelve short runs to 11 A of iron that saturates from 4 A on: the model with the lowest powers leaves most
 * of its torque, which is no noise of so few samples, and the mean takes powers up to the eighth. */
static void record_sharp(size_t samples)
{
    for (int k = 0; k < 12; ++k) {
        const double q = (k % 2 ? -1.0 : 1.0) * k;
        record(samples, &(point){k % 4 < 2 ? 60.0 : -60.0, q, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < samples; ++j)
            run[k].torque_Nm[j] -= 0.1 * q * (sqrt(1.0 + q * q / 16.0) - 1.0);
    }
    search_start();
    how.resolution_Nm = 0.5 * NOISE_NM;
    model_add("saturation", "d1q2_cosine", NULL, 0.0);
    model.candidates.reference_current_A = 11.0;
    model_fit();
}

static void test_short_runs_whose_iron_saturates_early(void)
{
    record_sharp(100);
    TEST_ASSERT_TRUE(hci_search_noise_rms(&search) > 10.0 * how.resolution_Nm);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_search_coenergy(&search, &model, &note), note.text);
    TEST_ASSERT_TRUE(search.whole_coenergy);
    (void)term_in(&model.candidates, "saturation", "d1q6_cosine", 0.0);
    TEST_ASSERT_TRUE(hci_search_noise_rms(&search) < 1.3 * NOISE_NM);
}

/* What saturates gently has no high power of the mean. */
static void test_gentle_iron_has_no_high_powers(void)
{
    record_saturated(1.0);
    for (size_t k = 0; k < model.candidates.count; ++k)
        TEST_ASSERT_LESS_OR_EQUAL_INT(6, model.candidates.candidate[k].power);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_of_runs_at_different_currents);
    RUN_TEST(test_not_of_runs_at_the_same_currents);
    RUN_TEST(test_short_runs_whose_iron_saturates_early);
    RUN_TEST(test_gentle_iron_has_no_high_powers);
    return UNITY_END();
}
