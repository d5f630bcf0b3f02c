/* What is much beside what is known, what a model costs whose runs have means of their own, and when single
 * terms take the place of a whole. */
#include "host/diagnose/attribute/cancelling_orders.c"
#include "host/diagnose/attribute/settle.c"
#include "host/diagnose/attribute/settle_means.c"

#include "support/searching.h"

void setUp(void)
{
    dataset_start();
    memset(&search, 0, sizeof search);
}

void tearDown(void)
{
    hci_fitted_model_release(&search.single);
    if (search.residual_Nm) search_end();
    dataset_end();
}

/* By sizes far from 1, either way: a share is of what is known. */
static void test_what_is_much(void)
{
    for (double size_Nm = 1e-3; size_Nm < 2e3; size_Nm *= 1e3) {
        understanding u = {.known_Nm = size_Nm, .unexplained_Nm = 1.01 * SMALL * size_Nm};
        TEST_ASSERT_TRUE(is_much(&u));
        u.unexplained_Nm = 0.99 * SMALL * size_Nm;
        TEST_ASSERT_FALSE(is_much(&u));
        u.known_ripple_Nm = size_Nm, u.unexplained_ripple_Nm = 1.01 * SMALL * size_Nm;
        TEST_ASSERT_TRUE(is_much(&u));
        u.noise_Nm = 1.02 * SMALL * size_Nm; /* within the noise */
        TEST_ASSERT_FALSE(is_much(&u));
        u.noise_Nm = 0.0, u.unexplained_ripple_Nm = 0.99 * SMALL * size_Nm;
        TEST_ASSERT_FALSE(is_much(&u));
    }
}

/* A mean for each run costs the logarithm of the rows, as any value does. */
static void test_what_means_of_their_own_cost(void)
{
    hci_fitted_model free = {0};
    double score = 0.0;
    record_map(0.0, 0.0);
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fitted_model_copy(&model, &free, &note));
    search.regression->free_means = true;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_fit(&search, &free, &note));
    search.regression->free_means = false;
    TEST_ASSERT_EQUAL_INT(HCI_OK, score_of_means(&search, &model, &score, &note));
    TEST_ASSERT_FALSE(search.regression->free_means);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, free.fit.score + 4.0 * log(model.fit.rows), score);
    hci_fitted_model_release(&free);
}

/* Single terms that say as little of runs left out do not take the place of a whole co-energy. */
static void test_single_terms_that_predict_nothing(void)
{
    static const double OFF_NM[] = {1.0, -1.0, -0.6, 1.1, 0.4, -0.9, -0.2, 0.8};
    bool unpredicted = true;
    for (size_t r = 0; r < 8; ++r)
        record(450, &(point){60.0 + 30.0 * (double)r, 0.0, 0.0, 10.0 * NOISE_NM * OFF_NM[r], 0.0});
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
    model_add("friction", "viscous", NULL, 0.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fitted_model_copy(&model, &search.single, &note));
    model_add("friction", "quadratic", NULL, 0.0);
    model_fit();
    search.whole_coenergy = true;
    TEST_ASSERT_EQUAL_INT(HCI_OK, single_try(&search, &model, &unpredicted, &note));
    TEST_ASSERT_TRUE(unpredicted);
    TEST_ASSERT_EQUAL_UINT64(3, hci_candidates_terms_in(&model.candidates));
    hci_fitted_model_release(&search.single);
}

/* Of runs left out without the iron that saturates nothing is asked: their ripple may be described badly. */
static void test_ripple_is_asked_of_saturation(void)
{
    bool of_ripple = true;
    double share = 0.0;
    for (size_t r = 0; r < 8; ++r) {
        record(450, &(point){60.0 + 30.0 * (double)r, 0.0, 0.0, 0.0, 0.0});
        for (size_t k = 0; k < 450; ++k)
            run[r].torque_Nm[k] += 0.1 * (1.0 + 0.2 * (double)(r % 3)) * sin(6.0 * P * run[r].theta_m_rad[k]);
    }
    search_start();
    model_add("cogging", "sine", "cosine", 6.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_unpredicted(&search, &model.candidates, &share, &note));
    TEST_ASSERT_TRUE(share > 0.0 && share < MOSTLY);
    TEST_ASSERT_EQUAL_INT(HCI_OK, is_of_ripple(&search, &model.candidates, share, &of_ripple, &note));
    TEST_ASSERT_FALSE(of_ripple);
}

/* Eight loads with a torque that falls with the cube of the current, and a ripple that nothing describes. */
static void record_cube(void)
{
    for (size_t r = 0; r < 8; ++r) {
        const double iq_A = 2.0 + (double)r;
        record(450, &(point){60.0, iq_A, 0.0, 4e-4 * pow(iq_A, 3.0), 0.0});
        for (size_t k = 0; k < 450; ++k)
            run[r].torque_Nm[k] += 0.05 * sin(4.0 * P * run[r].theta_m_rad[k]);
    }
    search_start();
}

static void iron_fit(const char *power)
{
    memset(&model, 0, sizeof model);
    model.candidates.reference_current_A = 9.0;
    if (power) model_add("saturation", power, NULL, 0.0);
    model_fit();
}

/* Beside a model whose iron goes with the seventh power, and describes it worse than a mean of each load; in
 * its place stood a single one. */
static bool means_are_better(const char *single, bool whole)
{
    bool better = !whole;
    double score = 0.0;
    hci_attribution a = {.types = 0};
    record_cube();
    iron_fit(single);
    search.single = model;
    iron_fit("d1q6_cosine");
    search.whole_coenergy = whole;
    a.model = model;
    TEST_ASSERT_EQUAL_INT(HCI_OK, are_means_better(&search, &a, &better, &note));
    TEST_ASSERT_EQUAL_INT(HCI_OK, score_of_iron(&search, &model, &score, &note));
    TEST_ASSERT_EQUAL_DOUBLE(better ? model.fit.score : search.single.fit.score, score);
    tearDown();
    setUp();
    return better;
}

/* Single terms that describe it keep the iron in, where they were what a whole co-energy stands for. */
static void test_means_against_single_terms(void)
{
    TEST_ASSERT_FALSE(means_are_better("d1q2_cosine", true));
    TEST_ASSERT_TRUE(means_are_better("d1q2_cosine", false));
    TEST_ASSERT_TRUE(means_are_better("d0q3_cosine", true));
    TEST_ASSERT_TRUE(means_are_better(NULL, true));
}

static void value_set(double order, double value)
{
    for (size_t k = 0; k < model.candidates.count; ++k)
        if (model.candidates.candidate[k].term[0].order == order)
            model.candidates.candidate[k].term[0].value = value;
}

/* Four loads with i_q alone, at which orders 5 and 7 of the back-EMF make the same torque; another order of
 * which so much is in the torque. */
static void record_of_order(double order, double burst_Nm)
{
    static const double CURRENT_A[] = {3.0, -6.0, 9.0, -4.0};
    for (size_t r = 0; r < 4; ++r) {
        record(600, &(point){60.0 + 10.0 * (double)r, CURRENT_A[r], 0.0, 0.0, 0.0});
        for (size_t k = 0; k < 600; ++k)
            run[r].torque_Nm[k] += 0.001 * CURRENT_A[r] * cos(order * P * run[r].theta_m_rad[k]) +
                                   (k / 60 % 2 ? burst_Nm * ref_normal(&seed) : 0.0);
    }
    search_start();
}

/* One of two orders that cancel stands for both where nothing but noise is left of it, and not where bursts
 * are.
 */
static void test_orders_that_cancel(void)
{
    for (int is_left = 0; is_left < 2; ++is_left) {
        record_of_order(6.0, is_left ? 5.0 * NOISE_NM : 0.0);
        model_add("back_emf", "sine", NULL, 5.0);
        model_add("back_emf", "sine", NULL, 7.0);
        model_fit();
        value_set(5.0, 0.03);
        value_set(7.0, 0.029);
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_cancelling_orders_leave(&search, &model, &note));
        TEST_ASSERT_EQUAL_UINT64(is_left ? 2 : 1, hci_candidates_terms_in(&model.candidates));
        tearDown();
        setUp();
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_much);
    RUN_TEST(test_what_means_of_their_own_cost);
    RUN_TEST(test_single_terms_that_predict_nothing);
    RUN_TEST(test_ripple_is_asked_of_saturation);
    RUN_TEST(test_means_against_single_terms);
    RUN_TEST(test_orders_that_cancel);
    return UNITY_END();
}
