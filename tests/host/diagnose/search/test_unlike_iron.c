/* What iron cannot make: of a rotor that looks alike both ways round a mean torque that keeps its sign when
 * i_q turns its own, and of any a torque along q that grows faster than the current. */
#include "host/diagnose/search/unlike_iron.h"

#include "support/searching.h"

enum { SAMPLES = 150 };

void setUp(void)
{
    dataset_start();
    for (int k = 0; k < 4; ++k) {
        record(SAMPLES, &(point){60.0, k % 2 ? -9.0 : 6.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < SAMPLES; ++j)
            rec_phases(k < 2 ? -4.0 : 0.0, k % 2 ? -9.0 : 6.0, P * run[k].theta_m_rad[j], run[k].i_A + 3 * j);
    }
    search_start();
    model.candidates.reference_current_A = 9.0;
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

static void add(const char *effect, const char *parameter, double order, double value)
{
    model_add(effect, parameter, NULL, order);
    size_t k = model.candidates.count;
    while (k-- > 0)
        if (strcmp(model.candidates.candidate[k]
                       .type->parameter[model.candidates.candidate[k].term[0].parameter]
                       .name,
                   parameter) == 0)
            model.candidates.candidate[k].term[0].value = value;
}

static bool is_broken(size_t k)
{
    return hci_mirror_is_broken(search.regression, &model.candidates, k);
}

/* T = 3/2 p (L_dq (i_d² − i_q²) …): the same way round with either sign of i_q. */
static void test_cross_inductance_alone_is_none(void)
{
    add("reluctance", "dq_cosine", 0.0, 1e-4);
    TEST_ASSERT_TRUE(is_broken(0));
    model.candidates.candidate[0].in = false;
    TEST_ASSERT_FALSE(is_broken(0));
}

/* Poles that are a little skew. */
static void test_beside_a_larger_saliency_it_is_believed(void)
{
    add("reluctance", "dd_cosine", 0.0, -1e-3);
    add("reluctance", "dq_cosine", 0.0, 1e-4);
    TEST_ASSERT_FALSE(is_broken(0));
    TEST_ASSERT_FALSE(is_broken(1));
}

/* The saliency is none of it, however small it is. */
static void test_only_what_keeps_its_sign_leaves(void)
{
    add("reluctance", "dd_cosine", 0.0, -1e-5);
    add("reluctance", "dq_cosine", 0.0, 1e-4);
    TEST_ASSERT_FALSE(is_broken(0));
    TEST_ASSERT_TRUE(is_broken(1));
}

/* i_d i_q³ and i_d i_q², in units of the reference current. */
static void test_powers_of_the_currents(void)
{
    add("saturation", "d1q2_cosine", 0.0, 0.01);
    TEST_ASSERT_FALSE(is_broken(0));
    add("saturation", "d1q3_cosine", 0.0, 0.05);
    TEST_ASSERT_FALSE(is_broken(0));
    TEST_ASSERT_TRUE(is_broken(1));
}

/* Orders above the mean have sine and cosine where phases are turned, and are asked nothing. */
static void test_of_the_mean_alone(void)
{
    add("reluctance", "dq_cosine", 6.0, 1e-4);
    TEST_ASSERT_FALSE(is_broken(0));
}

/* Only runs in use are asked. */
static void test_of_runs_in_use(void)
{
    static const bool NONE[MOST_RUNS] = {false};
    add("reluctance", "dq_cosine", 0.0, 1e-4);
    const bool *use = search.regression->use;
    search.regression->use = NONE;
    TEST_ASSERT_FALSE(is_broken(0));
    search.regression->use = use;
}

/* Together they are a torque for one sign of i_q alone, as of a force along the shaft. */
static void test_a_torque_of_one_sign_leaves(void)
{
    add("saturation", "d1q2_cosine", 0.0, 0.05);
    add("saturation", "d1q3_cosine", 0.0, 0.035);
    TEST_ASSERT_FALSE(is_broken(0));
    TEST_ASSERT_TRUE(is_broken(1));
}

/* ---- more torque per ampere ---- */

/* W' = w i_d i_q²/I³ makes p w at i_q = I, beside 3/2 K I. */
static bool rises_by(double share)
{
    add("saturation", "d1q2_cosine", 0.0, share * 1.5 * K_NM_PER_A * 9.0 / P);
    return hci_iron_would_rise(search.regression, &model.candidates, 0);
}

static void test_iron_makes_no_more_torque_per_ampere(void)
{
    TEST_ASSERT_TRUE(rises_by(0.05));
}

static void test_a_little_more_is_believed(void)
{
    TEST_ASSERT_FALSE(rises_by(0.02));
}

static void test_less_is_saturation(void)
{
    TEST_ASSERT_FALSE(rises_by(-0.2));
}

/* i_d of half of i_q: what the current along q makes was not recorded. */
static void test_not_without_a_current_along_q(void)
{
    for (int k = 2; k < 4; ++k)
        dataset.samples.statistics[k].mean_id_A = -4.5;
    TEST_ASSERT_FALSE(rises_by(0.05));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_cross_inductance_alone_is_none);
    RUN_TEST(test_beside_a_larger_saliency_it_is_believed);
    RUN_TEST(test_only_what_keeps_its_sign_leaves);
    RUN_TEST(test_powers_of_the_currents);
    RUN_TEST(test_a_torque_of_one_sign_leaves);
    RUN_TEST(test_of_the_mean_alone);
    RUN_TEST(test_of_runs_in_use);
    RUN_TEST(test_iron_makes_no_more_torque_per_ampere);
    RUN_TEST(test_a_little_more_is_believed);
    RUN_TEST(test_less_is_saturation);
    RUN_TEST(test_not_without_a_current_along_q);
    return UNITY_END();
}
