/* Whether what is left is noise. */
#include "host/diagnose/attribute/settle.h"

#include "host/diagnose/attribute/attribute.h"
#include "host/diagnose/search/noise_left.h"
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

/* Of one run, without any effect. */
static bool is_noise(void)
{
    bool noise = false;
    search_start();
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_is_noise(&search, &model.candidates, &noise, &note));
    return noise;
}

/* How uneven the errors are is known badly from few samples: 1230 of white noise are 50 blocks. */
static void test_short_noise_is_noise(void)
{
    for (uint64_t k = 0; k < 40; ++k) {
        seed = 500 + k;
        record(1230, &(point){60.0, 0.0, 0.0, 0.0, 0.0});
        TEST_ASSERT_TRUE(is_noise());
        tearDown();
        setUp();
    }
    search_start();
}

/* Every second tenth of a run three times as large is none. */
static void test_bursts_are_no_noise(void)
{
    record(3000, &(point){60.0, 0.0, 0.0, 0.0, 0.0});
    for (size_t j = 0; j < 3000; ++j)
        if (j / 300 % 2) run[0].torque_Nm[j] *= 3.0;
    TEST_ASSERT_FALSE(is_noise());
}

/* A free shaft whose current steps now and then, read behind a filter of so many samples. */
static void record_steps(double filter)
{
    double before = 5.0, flows = 5.0, next = 0.0;
    record(3000, &(point){60.0, 0.0, 0.0, 0.0, 0.0});
    run[0].torque_source = HCI_TORQUE_INERTIA;
    for (size_t j = 0; j < 3000; ++j) {
        if ((double)j >= next) {
            flows = ref_uniform(&seed, 2.0, 5.0);
            next += ref_uniform(&seed, 20.0, 120.0);
        }
        before += (flows - before) / (1.0 + filter);
        rec_phases(0.0, before, P * run[0].theta_m_rad[j], run[0].i_A + 3 * j);
        run[0].torque_Nm[j] = 1.5 * K_NM_PER_A * flows + 0.1 * ref_normal(&seed);
    }
}

/* What a current behind a filter leaves follows the rate of its torque. */
static void test_what_a_filter_leaves_is_no_noise(void)
{
    record_steps(0.0);
    TEST_ASSERT_TRUE(is_noise());
    tearDown();
    setUp();
    record_steps(8.0);
    TEST_ASSERT_FALSE(is_noise());
}

/* Means of runs that are off by little more than chance: a friction of as many terms as there are describes
 * them, and says nothing of a run left out. Without it nothing but noise is left, and that is not unknown. */
static void test_means_of_noise_are_known(void)
{
    static const double OFF_NM[] = {1.0, -1.0, -0.6, 1.1, 0.4, -0.9, -0.2, 0.8};
    hci_attribution a = {.types = 0};
    for (size_t r = 0; r < 8; ++r)
        record(450, &(point){60.0 + 30.0 * (double)r, 0.0, 0.0, 0.14 * NOISE_NM * OFF_NM[r], 0.0});
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
    model_add("friction", "viscous", NULL, 0.0);
    model_add("friction", "quadratic", NULL, 0.0);
    model_fit();
    a.model = model;
    memset(&model, 0, sizeof model);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_settle(&search, &a, &note));
    TEST_ASSERT_FALSE(a.means_open || a.unknown);
    TEST_ASSERT_EQUAL_UINT64(0, hci_candidates_types_in(&a.model.candidates));
    hci_attribution_release(&a);
}

/* Nothing of a model that stands for a whole co-energy stays, and the means are not known. */
static void leaves_all_to_the_means(void)
{
    hci_attribution a = {.types = 0};
    search.whole_coenergy = true;
    model_fit();
    a.model = model;
    memset(&model, 0, sizeof model);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_settle(&search, &a, &note));
    TEST_ASSERT_EQUAL_UINT64(0, hci_candidates_types_in(&a.model.candidates));
    TEST_ASSERT_TRUE(a.unknown && a.means_open);
    TEST_ASSERT_FALSE(search.whole_coenergy);
    hci_attribution_release(&a);
}

/* Those of ten times the noise are not known, of a model that stands for a whole co-energy too. */
static void test_means_that_no_law_predicts(void)
{
    static const double OFF_NM[] = {1.0, -1.0, -0.6, 1.1, 0.4, -0.9, -0.2, 0.8};
    for (size_t r = 0; r < 8; ++r)
        record(450, &(point){60.0 + 30.0 * (double)r, 0.0, 0.0, 10.0 * NOISE_NM * OFF_NM[r], 0.0});
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
    model_add("friction", "viscous", NULL, 0.0);
    model_add("friction", "quadratic", NULL, 0.0);
    leaves_all_to_the_means();
}

/* Beside them only noise is left, or a ripple as large as they. */
static void test_means_beside_a_ripple(void)
{
    static const double OFF_NM[] = {1.0, -1.0, -0.6, 1.1, 0.4, -0.9, -0.2, 0.8};
    for (int is_alone = 0; is_alone < 2; ++is_alone) {
        hci_attribution a = {.types = 0};
        for (size_t r = 0; r < 8; ++r)
            record(450, &(point){60.0 + 30.0 * (double)r, 0.0, 0.0, 10.0 * NOISE_NM * OFF_NM[r],
                                 is_alone ? 0.0 : 20.0 * NOISE_NM});
        search_start();
        model_add("friction", "coulomb", NULL, 0.0);
        model_fit();
        a.model = model;
        memset(&model, 0, sizeof model);
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_settle(&search, &a, &note));
        TEST_ASSERT_EQUAL(is_alone, a.means_alone);
        hci_attribution_release(&a);
        if (is_alone) break;
        tearDown();
        setUp();
    }
}

/* Four loads of one sign, with a mean that falls with the current, and a whole co-energy of which the mean
 * is one that keeps its sign: single: the model of single terms that was kept beside it. */
static hci_candidates settled_beside(const char *single)
{
    hci_attribution a = {.types = 0};
    for (size_t r = 0; r < 4; ++r) {
        const double iq_A = 2.0 + 2.0 * (double)r;
        record(450, &(point){60.0, iq_A, 0.0, 4e-4 * pow(iq_A, 3.0), 0.0});
        for (size_t j = 0; j < 450; ++j) /* as of an angle that is off */
            rec_phases(0.02 * iq_A, iq_A, P * run[r].theta_m_rad[j], run[r].i_A + 3 * j);
    }
    search_start();
    search.whole_coenergy = true;
    model.candidates.reference_current_A = 8.0;
    model_add("saturation", single, NULL, 0.0);
    model_fit();
    search.single = model;
    memset(&model, 0, sizeof model);
    model.candidates.reference_current_A = 8.0;
    model_add("saturation", "d1q3_cosine", NULL, 0.0);
    model_add("reluctance", "qq_cosine", NULL, 6.0);
    model_fit();
    a.model = model;
    memset(&model, 0, sizeof model);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_settle(&search, &a, &note));
    const hci_candidates found = a.model.candidates;
    a.model.candidates = (hci_candidates){0};
    hci_attribution_release(&a);
    hci_fitted_model_release(&search.single);
    return found;
}

static bool has_mean(const hci_candidates *found, const char *parameter)
{
    bool has = false;
    for (size_t k = 0; k < found->count; ++k) {
        const hci_candidate *x = &found->candidate[k];
        has = has || (x->in && strcmp(x->type->parameter[x->term[0].parameter].name, parameter) == 0);
    }
    return has;
}

/* The single terms take its place where their mean turns its sign, and else nothing does. */
static void test_a_whole_that_keeps_its_sign_gives_way(void)
{
    hci_candidates found = settled_beside("d1q2_cosine");
    TEST_ASSERT_TRUE(has_mean(&found, "d1q2_cosine") && !has_mean(&found, "d1q3_cosine"));
    TEST_ASSERT_FALSE(search.whole_coenergy);
    hci_candidates_release(&found);
    tearDown();
    setUp();
    found = settled_beside("d0q3_cosine");
    TEST_ASSERT_FALSE(has_mean(&found, "d0q3_cosine"));
    hci_candidates_release(&found);
}

/* Runs of another torque per ampere each, as of magnets whose temperature nobody wrote down. */
static void record_heat(void)
{
    static const double KELVIN[] = {0.0, 10.0, 75.0, 15.0, 5.0, 60.0, 46.0, 30.0};
    static const double IQ_A[] = {0.0, 0.0, 9.0, 4.0, 5.0, -9.0, 5.0, 7.0};
    for (size_t r = 0; r < 8; ++r)
        record(450, &(point){60.0 + 30.0 * (double)r, IQ_A[r], 0.0,
                             1.5 * K_NM_PER_A * IQ_A[r] * 0.0011 * KELVIN[r], 0.0});
}

/* Powers of the currents describe them nearly, of those left out too; a mean of each run describes them all.
 */
static void test_a_scale_of_each_run_is_no_saturation(void)
{
    record_heat();
    search_start();
    model.candidates.reference_current_A = 9.0;
    model_add("saturation", "d1q2_cosine", NULL, 0.0);
    model_add("saturation", "d1q3_cosine", NULL, 0.0);
    leaves_all_to_the_means();
}

/* Too few samples for a spectrum: noise is noise, and a wave that is slow beside them is none. */
static void test_few_samples(void)
{
    for (uint64_t k = 0; k < 40; ++k) {
        seed = 900 + k;
        for (size_t r = 0; r < 3; ++r)
            record(40, &(point){60.0, 2.0, 0.0, 0.0, 0.0});
        TEST_ASSERT_TRUE(is_noise());
        for (size_t j = 0; j < 120; ++j)
            run[j / 40].torque_Nm[j % 40] += 3.0 * NOISE_NM * sin(2.0 * REF_PI * (double)(j % 40) / 20.0);
        search_end();
        TEST_ASSERT_FALSE(is_noise());
        tearDown();
        setUp();
    }
    search_start();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_short_noise_is_noise);
    RUN_TEST(test_bursts_are_no_noise);
    RUN_TEST(test_a_scale_of_each_run_is_no_saturation);
    RUN_TEST(test_few_samples);
    RUN_TEST(test_what_a_filter_leaves_is_no_noise);
    RUN_TEST(test_means_of_noise_are_known);
    RUN_TEST(test_means_that_no_law_predicts);
    RUN_TEST(test_means_beside_a_ripple);
    RUN_TEST(test_a_whole_that_keeps_its_sign_gives_way);
    return UNITY_END();
}
