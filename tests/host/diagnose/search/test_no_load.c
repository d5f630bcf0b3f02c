/* What runs without a current show by themselves, beside runs that nothing explains. */
#define _XOPEN_SOURCE 700
#include "host/diagnose/search/no_load.h"

#include "support/searching.h"

enum { N = 600 };

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    hci_fitted_model_release(&search.no_load);
    search_end();
    dataset_end();
}

/* There and back at two speeds with friction and cogging. odd_Nm: of what is another torque each time. */
static void record_idle(double odd_Nm)
{
    static const double SPEED[] = {60.0, -60.0, 150.0, -150.0};
    for (size_t r = 0; r < 4; ++r) {
        record(N, &(point){SPEED[r], 0.0, 0.0, SPEED[r] > 0.0 ? 0.04 : -0.04, odd_Nm});
        for (size_t k = 0; k < N; ++k)
            run[r].torque_Nm[k] += 0.05 * sin(6.0 * P * run[r].theta_m_rad[k]);
    }
}

static void record_loads(size_t count)
{
    for (size_t r = 0; r < count; ++r)
        record(N, &(point){60.0, 3.0 + 2.0 * (double)r, 0.0, r % 2 ? 0.3 : -0.2, 0.5});
}

static void find(void)
{
    search_start();
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_search_no_load(&search, &model, &note), note.text);
}

static void test_they_show_their_effects(void)
{
    record_idle(0.0);
    record_loads(3);
    find();
    TEST_ASSERT_TRUE(model_has("friction") && model_has("cogging"));
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_types_in(&model.candidates));
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_types_in(&search.no_load.candidates));
    TEST_ASSERT_EQUAL_UINT64(7, hci_regression_runs_in_use(&dataset.regression)); /* all of them again */
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 0.04, term_in(&model.candidates, "friction", "coulomb", 0.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 0.05, term_in(&model.candidates, "cogging", "sine", 6.0)->value);
}

/* Something in them that no effect explains. */
static void test_what_is_no_noise_shows_nothing(void)
{
    record_idle(0.05);
    record_loads(3);
    find();
    TEST_ASSERT_EQUAL_UINT64(0, hci_candidates_terms_in(&model.candidates));
    TEST_ASSERT_EQUAL_UINT64(0, hci_candidates_terms_in(&search.no_load.candidates));
}

static void test_without_such_runs(void)
{
    record_loads(3);
    find();
    TEST_ASSERT_EQUAL_UINT64(0, hci_candidates_terms_in(&model.candidates));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_they_show_their_effects);
    RUN_TEST(test_what_is_no_noise_shows_nothing);
    RUN_TEST(test_without_such_runs);
    return UNITY_END();
}
