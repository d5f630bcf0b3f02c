/* One step forward: what comes into the model, and that nothing does on noise. */
#include "host/diagnose/search/forward.h"

#include "support/searching.h"

enum { SAMPLES = 100 }; /* of a run: one electrical period */

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* Two currents in each direction. */
static void record_small(double offset_A, double brake_Nm)
{
    for (int k = 0; k < 4; ++k)
        record(SAMPLES, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : 2.0, offset_A,
                                 k < 2 ? brake_Nm : -brake_Nm, 0.0});
}

static bool step_forward(void)
{
    bool added = false;
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_search_forward(&search, &model, &added, &note), note.text);
    return added;
}

/* The score must fall by 10: for noise that is once in thousands. */
static void test_nothing_comes_in_on_noise(void)
{
    for (int k = 0; k < 3; ++k) {
        seed = 1000 + (uint64_t)k;
        record_small(0.0, 0.0);
        search_start();
        model_fit();
        TEST_ASSERT_FALSE(step_forward());
        TEST_ASSERT_EQUAL_UINT64(0, hci_candidates_terms_in(&model.candidates));
        tearDown();
        setUp();
    }
}

static void test_the_true_effect_comes_in_alone(void)
{
    record_small(0.3, 0.0);
    search_start();
    model_fit();
    TEST_ASSERT_TRUE(step_forward());
    TEST_ASSERT_TRUE(model_has("current_offset"));
    TEST_ASSERT_EQUAL_UINT64(1, hci_candidates_types_in(&model.candidates));
    const hci_effect_term *a = term_in(&model.candidates, "current_offset", "a", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * a->std_error, 0.3, a->value);
    TEST_ASSERT_FALSE(step_forward()); /* and nothing beside it */
}

/* With one effect in the model the other comes in, and the first keeps its terms. */
static void test_a_second_effect(void)
{
    record_small(0.3, 0.05);
    search_start();
    model_add("friction", "coulomb", NULL, 0.0);
    model_fit();
    TEST_ASSERT_TRUE(step_forward());
    TEST_ASSERT_TRUE(model_has("current_offset") && model_has("friction"));
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_types_in(&model.candidates));
    const hci_effect_term *coulomb = term_in(&model.candidates, "friction", "coulomb", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * coulomb->std_error, 0.05, coulomb->value);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nothing_comes_in_on_noise);
    RUN_TEST(test_the_true_effect_comes_in_alone);
    RUN_TEST(test_a_second_effect);
    return UNITY_END();
}
