/* A torque per ampere that voltages show: another one is not believed, whether it is more or less. */
#include "host/diagnose/search/belief.c"

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

/* Two currents in each direction, with a share of the declared torque. */
static void record_share(double share)
{
    for (int k = 0; k < 4; ++k) {
        record(SAMPLES, &(point){k < 2 ? 60.0 : -150.0, k % 2 ? 9.0 : 2.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < SAMPLES; ++j)
            run[k].torque_Nm[j] *= share;
    }
    search_start();
}

/* Fitted, and then where nobody asks while fitting: whether it is believed. */
static bool is_share_believed(double share, bool known)
{
    record_share(share);
    how.constant_is_known = known;
    model_add("back_emf", "sine", NULL, 1.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_fit(&search, &model, &note));
    const bool believed = isfinite(model.fit.score);
    TEST_ASSERT_EQUAL_PTR(believed ? NULL : hci_effect_type_find("back_emf"), search.disbelieved.type);
    if (!believed) {
        TEST_ASSERT_DOUBLE_WITHIN(0.005, share, search.disbelieved.constant_share);
    }
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_keep_believed(&search, &model, &note));
    TEST_ASSERT_EQUAL(believed, model_has("back_emf"));
    tearDown();
    setUp();
    return believed;
}

/* A twentieth is the border. */
static void test_a_twentieth_off_is_not_believed(void)
{
    TEST_ASSERT_FALSE(is_share_believed(0.94, true));
    TEST_ASSERT_TRUE(is_share_believed(0.96, true));
    TEST_ASSERT_TRUE(is_share_believed(1.04, true));
    TEST_ASSERT_FALSE(is_share_believed(1.06, true));
    record_share(1.0);
}

/* And of one that is only declared anything from a half on is. */
static void test_what_nobody_knows_may_be_more(void)
{
    TEST_ASSERT_TRUE(is_share_believed(1.3, false));
    TEST_ASSERT_TRUE(is_share_believed(0.7, false));
    record_share(1.0);
}

/* Magnets of 1.3 times the torque behind sensors that read 1.1 times the current: without the magnets 0.91 is
 * left, which is the nearest to all; without the sensors most. */
static void test_who_makes_it_another_one(void)
{
    static const char *const PHASE[] = {"a", "b", "c"};
    const hci_effect_type *culprit = NULL;
    record_share(1.0);
    model_add("back_emf", "sine", NULL, 1.0);
    model.candidates.candidate[0].term[0].value = 0.3 * K_NM_PER_A;
    for (size_t s = 0; s < 3; ++s) {
        model_add("current_gain", PHASE[s], NULL, 0.0);
        model.candidates.candidate[model.candidates.count - 1].term[0].value = 0.1;
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, culprit_find(&search, &model.candidates, &culprit, &note));
    TEST_ASSERT_EQUAL_STRING("current_gain", culprit->name);
    how.constant_is_known = true;
    TEST_ASSERT_EQUAL_INT(HCI_OK, culprit_find(&search, &model.candidates, &culprit, &note));
    TEST_ASSERT_EQUAL_STRING("back_emf", culprit->name);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_twentieth_off_is_not_believed);
    RUN_TEST(test_what_nobody_knows_may_be_more);
    RUN_TEST(test_who_makes_it_another_one);
    return UNITY_END();
}
