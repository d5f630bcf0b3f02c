/* What leaves a model: terms and effects that the recordings do not need, and no others. */
#include "host/diagnose/search/backward.h"

#include "support/searching.h"

enum { SAMPLES = 100 };

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* Cogging of order 6, an offset of a current reading, friction. */
static void record_small(double cogging_Nm, double offset_A, double brake_Nm)
{
    for (int k = 0; k < 4; ++k) {
        const double speed = k < 2 ? 60.0 : -150.0;
        record(SAMPLES, &(point){speed, k % 2 ? 9.0 : 2.0, offset_A, k < 2 ? brake_Nm : -brake_Nm, 0.0});
        for (size_t j = 0; j < SAMPLES; ++j)
            run[k].torque_Nm[j] += cogging_Nm * sin(6.0 * P * run[k].theta_m_rad[j]);
    }
    search_start();
}

static size_t drop_all(void)
{
    size_t count = 0;
    for (bool dropped = true; dropped; count += dropped)
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_drop(&search, &model, &dropped, &note));
    return count;
}

/* ---- single terms ---- */

static void test_orders_that_are_not_there_leave(void)
{
    record_small(0.05, 0.0, 0.0);
    for (int n = 1; n <= 4; ++n)
        model_add("cogging", "sine", "cosine", 6.0 * n);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_prune(&search, &model, &note));
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_terms_in(&model.candidates));
    const hci_effect_term *sine = term_in(&model.candidates, "cogging", "sine", 6.0);
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * NOISE_NM / sqrt(2.0 * SAMPLES), 0.05, sine->value);
}

/* Of two terms that are one the second says nothing, whatever value it has been given. */
static void test_a_term_that_depends_on_another_leaves(void)
{
    record_small(0.05, 0.0, 0.0);
    model_add("cogging", "sine", NULL, 6.0);
    model_add("cogging", "sine", NULL, 6.0);
    model_fit();
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_terms_in(&model.candidates));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_prune(&search, &model, &note));
    TEST_ASSERT_EQUAL_UINT64(1, hci_candidates_terms_in(&model.candidates));
    const hci_effect_term *sine = term_in(&model.candidates, "cogging", "sine", 6.0);
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * NOISE_NM / sqrt(2.0 * SAMPLES), 0.05, sine->value);
}

static void test_orders_that_are_there_stay(void)
{
    record_small(0.05, 0.3, 0.0);
    model_add("cogging", "sine", "cosine", 6.0);
    model_add("current_offset", "a", NULL, 0.0);
    model_fit();
    const double score = model.fit.score;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_prune(&search, &model, &note));
    TEST_ASSERT_EQUAL_UINT64(3, hci_candidates_terms_in(&model.candidates));
    TEST_ASSERT_EQUAL_DOUBLE(score, model.fit.score);
}

/* An order that costs much leaves although it is there; the limit is where its part of χ² is its price. */
static void test_a_price_decides(void)
{
    for (int k = 0; k < 2; ++k) {
        record_small(0.01, 0.0, 0.0);
        model_add("cogging", "sine", NULL, 6.0);
        model_fit();
        model_fit(); /* with the noise beside that order */
        const hci_effect_term *sine = term_in(&model.candidates, "cogging", "sine", 6.0);
        const double share = pow(sine->value / sine->std_error, 2.0); /* of χ² */
        model.candidates.candidate[0].price = share - log(4.0 * SAMPLES) + (k == 0 ? -2.0 : 2.0);
        model_fit();
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_prune(&search, &model, &note));
        TEST_ASSERT_EQUAL_UINT64(k == 0 ? 1 : 0, hci_candidates_terms_in(&model.candidates));
        tearDown();
        setUp();
    }
}

/* Three speeds each way; the excess is gone at the second. */
static void record_stribeck(double coulomb_Nm, double excess_Nm, double viscous_Nms)
{
    static const double SPEED[] = {20.0, 60.0, 150.0};
    for (int k = 0; k < 6; ++k) {
        const double speed = SPEED[k / 2], sign = k % 2 ? -1.0 : 1.0;
        const double brake_Nm = coulomb_Nm + excess_Nm * exp(-pow(speed / 25.0, 2.0)) + viscous_Nms * speed;
        record(SAMPLES, &(point){sign * speed, 2.0, 0.0, sign * brake_Nm, 0.0});
    }
    search_start();
    model_add("friction", "coulomb", "viscous", 0.0);
}

static void add_stribeck(void)
{
    model_add("stribeck_friction", "excess", "speed", 0.0);
    model.candidates.candidate[1].term[1].value = 20.0;
}

/* As many values as speeds tell nothing of another speed. */
static void test_powers_beside_another_brake_leave(void)
{
    record_stribeck(0.1, 0.2, 0.0);
    add_stribeck();
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_prune(&search, &model, &note));
    TEST_ASSERT_EQUAL_UINT64(3, hci_candidates_terms_in(&model.candidates));
    TEST_ASSERT_TRUE(model.candidates.candidate[0].shortened);
    TEST_ASSERT_DOUBLE_WITHIN(5e-3, 0.1, term_in(&model.candidates, "friction", "coulomb", 0.0)->value);
}

static void test_powers_that_are_there_stay(void)
{
    record_stribeck(0.1, 0.2, 1e-3);
    add_stribeck();
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_prune(&search, &model, &note));
    TEST_ASSERT_EQUAL_UINT64(4, hci_candidates_terms_in(&model.candidates));
}

/* Alone the law stays whole: a part left out would go into the others. */
static void test_powers_of_a_law_alone_stay(void)
{
    record_stribeck(0.1, 0.0, 0.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_prune(&search, &model, &note));
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_terms_in(&model.candidates));
}

/* ---- effects ---- */

/* An offset of a current makes a wave of order 1 that grows with nothing: cogging of order 1 described it
 * before the offset came in. */
static void test_an_effect_that_became_superfluous_leaves(void)
{
    record_small(0.0, 0.3, 0.0);
    model_add("cogging", "sine", "cosine", 1.0);
    model_fit();
    TEST_ASSERT_EQUAL_UINT64(0, drop_all()); /* as long as it stands alone it is needed */
    model_add("current_offset", "a", NULL, 0.0);
    model_fit();
    model.candidates.candidate[0].price = 6.0; /* so that of the two the offset is the cheaper one */
    model_fit();
    TEST_ASSERT_EQUAL_UINT64(1, drop_all());
    TEST_ASSERT_TRUE(model_has("current_offset") && !model_has("cogging"));
}

static void test_effects_that_are_there_stay(void)
{
    record_small(0.05, 0.3, 0.05);
    model_add("cogging", "sine", "cosine", 6.0);
    model_add("current_offset", "a", NULL, 0.0);
    model_add("friction", "coulomb", NULL, 0.0);
    model_fit();
    TEST_ASSERT_EQUAL_UINT64(0, drop_all());
    TEST_ASSERT_EQUAL_UINT64(3, hci_candidates_types_in(&model.candidates));
}

static void test_effects_that_are_not_there_leave(void)
{
    record_small(0.0, 0.0, 0.05);
    model_add("cogging", "sine", "cosine", 6.0);
    model_add("current_offset", "a", NULL, 0.0);
    model_add("friction", "coulomb", NULL, 0.0);
    model_fit();
    TEST_ASSERT_EQUAL_UINT64(2, drop_all());
    TEST_ASSERT_TRUE(model_has("friction"));
}

/* Short pieces in which an order has one sign or the other, 7 times and 5 times: on the average it is a sixth
 * of its size, six standard errors of white noise, and half of one over such pieces. */
static void test_an_order_that_wanders_leaves(void)
{
    static const double SIGN[MOST_RUNS] = {1, -1, 1, -1, 1, 1, -1, 1, -1, 1, -1, 1};
    for (int wanders = 0; wanders < 2; ++wanders) {
        for (int k = 0; k < MOST_RUNS; ++k) {
            record(120, &(point){60.0, 2.0, 0.0, 0.0, 0.0});
            for (size_t j = 0; j < 120; ++j)
                run[k].torque_Nm[j] +=
                    (wanders ? 0.05 * SIGN[k] : 0.005) * sin(6.0 * P * run[k].theta_m_rad[j]);
        }
        search_start();
        model_add("cogging", "sine", "cosine", 6.0);
        model_fit();
        model_fit();
        TEST_ASSERT_EQUAL_UINT64(0, drop_all());
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_drop_unsure(&search, &model, &note));
        TEST_ASSERT_EQUAL(!wanders, model_has("cogging"));
        tearDown();
        setUp();
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_orders_that_are_not_there_leave);
    RUN_TEST(test_a_term_that_depends_on_another_leaves);
    RUN_TEST(test_orders_that_are_there_stay);
    RUN_TEST(test_a_price_decides);
    RUN_TEST(test_powers_beside_another_brake_leave);
    RUN_TEST(test_powers_that_are_there_stay);
    RUN_TEST(test_powers_of_a_law_alone_stay);
    RUN_TEST(test_an_effect_that_became_superfluous_leaves);
    RUN_TEST(test_effects_that_are_there_stay);
    RUN_TEST(test_effects_that_are_not_there_leave);
    RUN_TEST(test_an_order_that_wanders_leaves);
    return UNITY_END();
}
