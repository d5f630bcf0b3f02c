/* What shows beside the noise of slopes, by all samples of all runs. */
#include "host/diagnose/search/search.c"

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

/* A torque of order 6 with so much of the noise, in the second of two runs or in none. */
static bool shows(double share)
{
    static const hci_candidates none;
    bool shown = false;
    record(450, &(point){60.0, 0.0, 0.0, 0.0, 0.0});
    record(450, &(point){-60.0, 0.0, 0.0, 0.0, 0.0});
    search_start();
    model_add("cogging", "sine", "cosine", 6.0);
    model_fit();
    hci_candidate *x = &model.candidates.candidate[0];
    x->term[0].value = share * NOISE_NM * sqrt(2.0), x->term[1].value = 0.0;
    TEST_ASSERT_EQUAL_INT(HCI_OK, shows_beside_slopes(&search, &model.candidates, &none, &shown, &note));
    tearDown();
    setUp();
    return shown;
}

/* A twentieth of the noise, rms. */
static void test_a_twentieth_of_the_noise_shows(void)
{
    TEST_ASSERT_FALSE(shows(0.0));
    TEST_ASSERT_FALSE(shows(0.045));
    TEST_ASSERT_FALSE(shows(0.048));
    TEST_ASSERT_TRUE(shows(0.055));
    search_start();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_twentieth_of_the_noise_shows);
    return UNITY_END();
}
