/* What nobody would believe: it loses against everything, is remembered, and takes with it what only imitates
 * it. */
#include "host/diagnose/search/belief.h"

#include "support/searching.h"

enum { SAMPLES = 100 };

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    hci_fitted_model_release(&search.disbelieved.model);
    search_end();
    dataset_end();
}

/* Two currents in each direction; the torque is a share of what it should be, and another one in the first
 * run. */
static void record_shares(double first, double others, double brake_Nm)
{
    for (int k = 0; k < 4; ++k) {
        const double speed = k < 2 ? 60.0 : -150.0;
        record(SAMPLES, &(point){speed, k % 2 ? 9.0 : 2.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < SAMPLES; ++j)
            run[k].torque_Nm[j] =
                (k == 0 ? first : others) * run[k].torque_Nm[j] - (k < 2 ? brake_Nm : -brake_Nm);
    }
    search_start();
}

static void record_share(double share, double brake_Nm)
{
    record_shares(share, share, brake_Nm);
}

static void fit(void)
{
    hci_search_noise(&search, &model.candidates, &note);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_search_fit(&search, &model, &note), note.text);
}

/* Half of the torque per ampere is the border. */
static void test_weak_magnets_are_believed(void)
{
    record_share(0.7, 0.0);
    model_add("back_emf", "sine", NULL, 1.0);
    fit();
    TEST_ASSERT_TRUE(isfinite(model.fit.score));
    TEST_ASSERT_NULL(search.disbelieved.type);
}

static void test_a_tenth_of_the_magnets_is_not(void)
{
    record_share(0.1, 0.05);
    model_add("friction", "coulomb", NULL, 0.0);
    model_add("back_emf", "sine", NULL, 1.0);
    fit();
    TEST_ASSERT_TRUE(model.fit.score == (double)INFINITY);
    TEST_ASSERT_EQUAL_STRING("back_emf", search.disbelieved.type->name);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.1, search.disbelieved.constant_share);
}

/* A mean that keeps its sign when i_q turns its own leaves by itself: the ripple of the same iron is no less
 * likely for it. */
static void test_a_mean_that_keeps_its_sign_leaves_alone(void)
{
    for (int k = 0; k < 2; ++k)
        record(SAMPLES, &(point){60.0, k ? -9.0 : 9.0, 0.0, 0.0, 0.0});
    search_start();
    model_add("reluctance", "qq_cosine", NULL, 6.0);
    model_add("reluctance", "dq_cosine", NULL, 0.0);
    model.candidates.candidate[0].term[0].value = 1e-4;
    model.candidates.candidate[1].term[0].value = 1e-3;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_keep_brakes(&search, &model, &note));
    TEST_ASSERT_TRUE(model.candidates.candidate[0].in);
    TEST_ASSERT_FALSE(model.candidates.candidate[1].in);
    TEST_ASSERT_EQUAL_STRING("reluctance", search.disbelieved.type->name);
}

/* Of the declared torque per ampere: what a back-EMF that is less by a fifth leaves; of a machine that
 * declares none, all. */
static void test_share_of_the_declared_torque(void)
{
    double share = 0.0;
    record_share(0.8, 0.0);
    model_add("back_emf", "sine", NULL, 1.0);
    model.candidates.candidate[0].term[0].value = -0.2 * K_NM_PER_A;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_constant_share(&search, &model.candidates, &share, &note));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.8, share);
    dataset.regression.declared_constant = 0.0;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_constant_share(&search, &model.candidates, &share, &note));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, share);
}

/* Three times what is expected of a sensor's gain, 0.1, is the border. */
static void test_a_sensor_with_half_its_gain_is_not(void)
{
    record_share(0.5, 0.0);
    for (int s = 0; s < 3; ++s) {
        hci_candidate x = candidate_of("current_gain", s == 0 ? "a" : s == 1 ? "b" : "c", NULL, 0.0);
        x.deviation = 0.1;
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&model.candidates, &x, &note));
    }
    fit();
    TEST_ASSERT_EQUAL_STRING("current_gain", search.disbelieved.type->name);
}

/* A sensor that needs longer than a turn shows nothing of any torque: that describes a machine without one.
 */
static void test_a_lag_of_more_than_a_turn_is_not(void)
{
    record_share(0.0, 0.0);
    model_add("torque_sensor", "time_constant", NULL, 0.0);
    model.candidates.candidate[0].term[0].value = 0.3;
    fit();
    TEST_ASSERT_NOT_NULL(search.disbelieved.type);
    TEST_ASSERT_EQUAL_STRING("torque_sensor", search.disbelieved.type->name);
}

/* A run in which the shaft stands has no turn, and says nothing of how long one takes. */
static void test_nor_beside_a_shaft_that_stands(void)
{
    record(SAMPLES, &(point){0.0, 2.0, 0.0, 0.0, 0.0});
    record(SAMPLES, &(point){60.0, 2.0, 0.0, 0.0, 0.0});
    for (int k = 0; k < 2; ++k)
        for (size_t j = 0; j < SAMPLES; ++j)
            run[k].torque_Nm[j] = 0.0;
    search_start();
    TEST_ASSERT_EQUAL_DOUBLE(0.0, search.regression->samples->statistics[0].mean_speed_rad_per_s);
    model_add("torque_sensor", "time_constant", NULL, 0.0);
    model.candidates.candidate[0].term[0].value = 0.3;
    fit();
    TEST_ASSERT_NOT_NULL(search.disbelieved.type);
    TEST_ASSERT_EQUAL_STRING("torque_sensor", search.disbelieved.type->name);
}

static void test_nor_a_resonance_that_is_one(void)
{
    record_share(0.0, 0.0);
    model_add("torque_sensor", "natural_frequency", "damping", 0.0);
    model.candidates.candidate[0].term[0].value = 70.0;
    model.candidates.candidate[0].term[1].value = 1e4;
    fit();
    TEST_ASSERT_NOT_NULL(search.disbelieved.type);
    TEST_ASSERT_EQUAL_STRING("torque_sensor", search.disbelieved.type->name);
}

/* ---- what brakes ---- */

/* Two speeds in each direction, with what the sensor reads too little at the slower and the faster. */
static void record_brake(double slow_Nm, double fast_Nm)
{
    for (int k = 0; k < 4; ++k) {
        const double sign = k < 2 ? 1.0 : -1.0, brake_Nm = k % 2 ? fast_Nm : slow_Nm;
        record(SAMPLES, &(point){sign * (k % 2 ? 150.0 : 60.0), 2.0, 0.0, sign * brake_Nm, 0.0});
    }
    search_start();
}

static void keep_brakes(void)
{
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_keep_brakes(&search, &model, &note));
}

static void test_a_friction_that_drives_is_not(void)
{
    record_brake(-0.05, -0.05);
    model_add("friction", "coulomb", NULL, 0.0);
    keep_brakes();
    TEST_ASSERT_FALSE(model_has("friction"));
    TEST_ASSERT_EQUAL_STRING("friction", search.disbelieved.type->name);
}

/* It says nothing of what brakes at other speeds, and would drive at some. */
static void test_nor_one_that_falls_with_the_speed(void)
{
    record_brake(0.2, 0.1);
    model_add("friction", "coulomb", "viscous", 0.0);
    keep_brakes();
    TEST_ASSERT_FALSE(model_has("friction"));
    TEST_ASSERT_NOT_NULL(search.disbelieved.type);
    TEST_ASSERT_EQUAL_STRING("friction", search.disbelieved.type->name);
}

/* Where the search ended early it may fall for what was not found: what of it brakes stays. */
static void test_where_the_search_ended_early_it_keeps_what_brakes(void)
{
    record_brake(0.2, 0.1);
    search.ended = HCI_WORK_LIMITED;
    model_add("friction", "coulomb", "viscous", 0.0);
    keep_brakes();
    TEST_ASSERT_TRUE(model_has("friction"));
    TEST_ASSERT_EQUAL_UINT64(1, hci_candidates_terms_in(&model.candidates));
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.15, term_in(&model.candidates, "friction", "coulomb", 0.0)->value);
    TEST_ASSERT_NULL(search.disbelieved.type);
}

/* One more run in one direction at another speed: that the law falls hangs on its mean, where any zero is,
 * and what both directions of the others show stays. */
static void test_what_hangs_on_one_direction_leaves_the_friction(void)
{
    record(SAMPLES, &(point){150.0, 2.0, 0.0, 0.1, 0.0});
    record(SAMPLES, &(point){-150.0, 2.0, 0.0, -0.1, 0.0});
    record(SAMPLES, &(point){60.0, 2.0, 0.0, 0.2, 0.0});
    search_start();
    model_add("friction", "coulomb", "viscous", 0.0);
    keep_brakes();
    TEST_ASSERT_TRUE(model_has("friction"));
    TEST_ASSERT_EQUAL_UINT64(1, hci_candidates_terms_in(&model.candidates));
}

/* Nor, of a shaft that goes back and forth, any that drives. */
static void test_nor_one_of_a_shaft_that_goes_back(void)
{
    record(2 * SAMPLES, &(point){60.0, 2.0, 0.0, 0.0, 0.0});
    for (size_t j = 0; j < 2 * SAMPLES; ++j) {
        run[0].speed_rad_per_s[j] = j < SAMPLES ? 60.0 : -60.0;
        run[0].torque_Nm[j] += j < SAMPLES ? 0.05 : -0.05;
    }
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
    keep_brakes();
    TEST_ASSERT_FALSE(model_has("friction"));
}

static void test_one_that_grows_is(void)
{
    record_brake(0.1, 0.2);
    model_add("friction", "coulomb", "viscous", 0.0);
    keep_brakes();
    TEST_ASSERT_NULL(search.disbelieved.type);
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_terms_in(&model.candidates));
}

/* What is more at low speeds falls by its nature. */
static void test_and_one_of_stribeck(void)
{
    record_brake(0.2, 0.1);
    model_add("friction", "coulomb", NULL, 0.0);
    model_add("stribeck_friction", "excess", "speed", 0.0);
    model.candidates.candidate[1].term[1].value = 80.0;
    keep_brakes();
    TEST_ASSERT_NULL(search.disbelieved.type);
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_types_in(&model.candidates));
}

/* ---- what becomes of it ---- */

/* Fitted without being asked, as where the means of the runs do not count, it leaves; friction stays. */
static void test_what_is_not_believed_leaves(void)
{
    record_share(0.1, 0.05);
    model_add("friction", "coulomb", NULL, 0.0);
    model_add("back_emf", "sine", NULL, 1.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_keep_believed(&search, &model, &note));
    TEST_ASSERT_TRUE(model_has("friction"));
    TEST_ASSERT_FALSE(model_has("back_emf"));
}

static void test_what_is_believed_stays(void)
{
    record_share(0.8, 0.05);
    model_add("friction", "coulomb", NULL, 0.0);
    model_add("back_emf", "sine", NULL, 1.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_keep_believed(&search, &model, &note));
    TEST_ASSERT_TRUE(model_has("friction") && model_has("back_emf"));
}

/* Friction is in both, cogging only in the one that is believed. */
static void test_what_both_have_in_common_stays(void)
{
    hci_yield yield = HCI_YIELD_NOTHING;
    record_share(0.1, 0.05);
    model_add("friction", "coulomb", NULL, 0.0);
    model_add("back_emf", "sine", NULL, 1.0);
    fit();
    hci_candidates_remove_type(&model.candidates, hci_effect_type_find("back_emf"));
    model_add("cogging", "sine", "cosine", 6.0);
    fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_yield(&search, &model, &yield, &note));
    TEST_ASSERT_EQUAL_INT(HCI_YIELD_BETTER, yield);
    TEST_ASSERT_TRUE(model_has("friction"));
    TEST_ASSERT_FALSE(model_has("cogging"));
}

/* The first run is said to be next to free of noise, as one is whose noise was found from a model that hits
 * it by chance. */
static void trust_first_run(void)
{
    for (const hci_segment *x = NULL; (x = hci_regression_next(&dataset.regression, x)) != NULL;)
        *hci_regression_noise(&dataset.regression, x) = hci_noise_white(x->run == 0 ? 1e-6 : 1.0);
}

/* The magnets of a tenth suit the first run and nothing else: the colour of the noise alone makes no model
 * better. */
static void test_better_by_the_noise_alone(void)
{
    hci_yield yield = HCI_YIELD_BETTER;
    record_shares(0.1, 1.0, 0.0);
    model_add("back_emf", "sine", NULL, 1.0);
    trust_first_run();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_fit(&search, &model, &note));
    TEST_ASSERT_EQUAL_STRING("back_emf", search.disbelieved.type->name);
    hci_candidates_remove_type(&model.candidates, hci_effect_type_find("back_emf"));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_yield(&search, &model, &yield, &note));
    TEST_ASSERT_EQUAL_INT(HCI_YIELD_RIVAL, yield);
}

/* Shafts that turn steadily against a load and have no torque sensor: a machine that makes no torque
 * describes that they do not accelerate, whatever holds them back. It does not take the friction away. */
static void test_no_torque_at_a_steady_speed(void)
{
    hci_yield yield = HCI_YIELD_BETTER;
    for (int k = 0; k < 4; ++k) {
        record(SAMPLES, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 5.2 : 4.8, 0.0, 0.0, 0.0});
        run[k].torque_source = HCI_TORQUE_INERTIA;
        for (size_t j = 0; j < SAMPLES; ++j)
            run[k].torque_Nm[j] = 1e-3 * ref_normal(&seed);
    }
    search_start();
    model_add("back_emf", "sine", NULL, 1.0);
    fit();
    TEST_ASSERT_EQUAL_STRING("back_emf", search.disbelieved.type->name);
    hci_candidates_remove_type(&model.candidates, hci_effect_type_find("back_emf"));
    model_add("friction", "coulomb", NULL, 0.0);
    fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_yield(&search, &model, &yield, &note));
    TEST_ASSERT_EQUAL_INT(HCI_YIELD_RIVAL, yield);
    TEST_ASSERT_TRUE(model_has("friction"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_weak_magnets_are_believed);
    RUN_TEST(test_a_tenth_of_the_magnets_is_not);
    RUN_TEST(test_a_lag_of_more_than_a_turn_is_not);
    RUN_TEST(test_nor_beside_a_shaft_that_stands);
    RUN_TEST(test_nor_a_resonance_that_is_one);
    RUN_TEST(test_a_mean_that_keeps_its_sign_leaves_alone);
    RUN_TEST(test_share_of_the_declared_torque);
    RUN_TEST(test_a_sensor_with_half_its_gain_is_not);
    RUN_TEST(test_a_friction_that_drives_is_not);
    RUN_TEST(test_nor_one_that_falls_with_the_speed);
    RUN_TEST(test_where_the_search_ended_early_it_keeps_what_brakes);
    RUN_TEST(test_what_hangs_on_one_direction_leaves_the_friction);
    RUN_TEST(test_nor_one_of_a_shaft_that_goes_back);
    RUN_TEST(test_one_that_grows_is);
    RUN_TEST(test_and_one_of_stribeck);
    RUN_TEST(test_what_is_not_believed_leaves);
    RUN_TEST(test_what_is_believed_stays);
    RUN_TEST(test_what_both_have_in_common_stays);
    RUN_TEST(test_better_by_the_noise_alone);
    RUN_TEST(test_no_torque_at_a_steady_speed);
    return UNITY_END();
}
