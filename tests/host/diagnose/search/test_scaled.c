/* Where the means of runs are off by something unknown: an effect that a wrong scale of all torque would make
 * as well is none. */
#include "host/diagnose/search/scaled.h"

#include "support/searching.h"

enum { SAMPLES = 600 };

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* Six runs with a cogging torque of ripple_Nm; the sensor reads `share` of the torque too much while that is
 * positive and too little while it is negative. */
static void record_ripple(double share, double ripple_Nm)
{
    static const double IQ_A[] = {9.0, -9.0, 6.0, -6.0, 3.0, -3.0};
    for (int k = 0; k < 6; ++k) {
        record(SAMPLES, &(point){60.0, IQ_A[k], 0.0, 0.0, 0.0});
        for (size_t j = 0; j < SAMPLES; ++j) {
            const double torque_Nm = run[k].torque_Nm[j] + ripple_Nm * sin(6.0 * P * run[k].theta_m_rad[j]);
            run[k].torque_Nm[j] = torque_Nm + share * fabs(torque_Nm);
        }
    }
    search_start();
    model_add("cogging", "sine", "cosine", 6.0);
    model_fit();
}

static void test_share_of_the_means(void)
{
    double share = 0.0;
    record_ripple(0.05, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_mean_share(&search, &model.candidates, &share, &note));
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 0.05, share);
}

/* Whether means are free is as before. */
static void test_means_are_not_free_for_it(void)
{
    double share = 0.0;
    record_ripple(0.05, 0.0);
    search.regression->free_means = true;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_mean_share(&search, &model.candidates, &share, &note));
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 0.05, share);
    TEST_ASSERT_TRUE(search.regression->free_means);
}

static void test_without_a_mean_there_is_no_share(void)
{
    double share = 1.0;
    record(SAMPLES, &(point){60.0, 0.0, 0.0, 0.0, 0.0});
    memset(run[0].torque_Nm, 0, SAMPLES * sizeof *run[0].torque_Nm);
    search_start();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_mean_share(&search, &model.candidates, &share, &note));
    TEST_ASSERT_TRUE(share == 0.0);
}

/* Of 2 N·m rms some twentieth; of its ripple next to nothing. */
static void test_what_a_scale_makes_leaves(void)
{
    record_ripple(0.0, 0.05);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_scaled_leave(&search, &model, 0.05, &note));
    TEST_ASSERT_EQUAL_UINT64(0, hci_candidates_types_in(&model.candidates));
}

static void test_a_larger_effect_stays(void)
{
    record_ripple(0.0, 0.05);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_scaled_leave(&search, &model, 0.005, &note));
    TEST_ASSERT_EQUAL_UINT64(1, hci_candidates_types_in(&model.candidates));
}

static void test_of_the_ripple_where_means_are_free(void)
{
    record_ripple(0.0, 0.05);
    search.regression->free_means = true;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_scaled_leave(&search, &model, 0.05, &note));
    TEST_ASSERT_EQUAL_UINT64(1, hci_candidates_types_in(&model.candidates));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_share_of_the_means);
    RUN_TEST(test_means_are_not_free_for_it);
    RUN_TEST(test_without_a_mean_there_is_no_share);
    RUN_TEST(test_what_a_scale_makes_leaves);
    RUN_TEST(test_a_larger_effect_stays);
    RUN_TEST(test_of_the_ripple_where_means_are_free);
    return UNITY_END();
}
