/* What a rotor that looks alike both ways round cannot make: a mean torque of the iron that keeps its sign
 * when i_q turns its own. */
#include "host/diagnose/search/mirror.h"

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
    return UNITY_END();
}
