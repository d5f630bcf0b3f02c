/* When known effects alone take the place of a model with something unknown: where they leave more than noise
 * they have to be better, whichever of both the noise is taken from. */
#include "host/diagnose/search/rounds.c"

#include "support/searching.h"

enum { N = 100 }; /* of a run: too short for a spectrum, so that all that is left counts as its noise */

static hci_fitted_model known;

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    hci_fitted_model_release(&known);
    memset(&known, 0, sizeof known);
    search_end();
    dataset_end();
}

/* Two waves, slow beside the samples, of which no noise is. */
static void record_waves(double order_2_Nm, double order_4_Nm)
{
    for (size_t r = 0; r < 4; ++r) {
        record(N, &(point){r % 2 ? -60.0 : 60.0, r < 2 ? 2.0 : 9.0, 0.0, 0.0, 0.0});
        for (size_t k = 0; k < N; ++k) {
            const double x = P * run[r].theta_m_rad[k];
            run[r].torque_Nm[k] += order_2_Nm * sin(2.0 * x) + order_4_Nm * sin(4.0 * x);
        }
    }
    search_start();
}

/* The known effects have nothing of these, the model has the second one at a price. */
static void models_make(double price)
{
    model_add("friction", "coulomb", NULL, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fitted_model_copy(&model, &known, &note));
    model_add("cogging", "sine", "cosine", 4.0);
    TEST_ASSERT_EQUAL_UINT64(2, model.candidates.count);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, model.candidates.candidate[1].term[0].order);
    model.candidates.candidate[1].price = price;
}

/* Whether the known effects are worse with the noise that one of both leaves, which is decided. */
static bool is_behind(const hci_fitted_model *noise_of)
{
    double behind = NAN;
    TEST_ASSERT_EQUAL_INT(HCI_OK, behind_by(&search, noise_of, &known, &model, &behind, &note));
    TEST_ASSERT_TRUE(fabs(behind) > HCI_DECISIVE);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, known.fit.score - model.fit.score, behind);
    return behind > 0.0;
}

static void known_are_better(bool expected)
{
    bool better = !expected;
    TEST_ASSERT_EQUAL_INT(HCI_OK, is_better(&search, &known, &model, &better, &note));
    TEST_ASSERT_EQUAL(expected, better);
}

static bool leave_noise_alone(void)
{
    bool noise = false;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_is_noise(&search, &known.candidates, &noise, &note));
    return noise;
}

/* A wave that neither describes is no reason to keep what describes nothing. */
static void test_better_beside_what_neither_describes(void)
{
    record_waves(3.0 * NOISE_NM, 0.0);
    models_make(5.0);
    TEST_ASSERT_FALSE(leave_noise_alone());
    TEST_ASSERT_FALSE(is_behind(&known) || is_behind(&model));
    known_are_better(true);
}

/* Where the wave that the model has counts as noise its price is more than it explains, and else less. */
static void test_better_by_their_own_noise_alone(void)
{
    record_waves(0.0, 2.0 * NOISE_NM);
    models_make(400.0);
    TEST_ASSERT_FALSE(leave_noise_alone());
    TEST_ASSERT_FALSE(is_behind(&known));
    TEST_ASSERT_TRUE(is_behind(&model));
    known_are_better(false);
}

static void test_worse_by_their_own_noise(void)
{
    record_waves(3.0 * NOISE_NM, 3.0 * NOISE_NM);
    models_make(5.0);
    TEST_ASSERT_TRUE(is_behind(&known));
    known_are_better(false);
}

/* Down to the noise they may be a little worse: by a hundredth of the score, which is 4 here. */
static void test_nearly_as_well_where_nothing_but_noise_is_left(void)
{
    for (int more = 0; more < 2; ++more) {
        double behind = NAN;
        record_waves(0.0, (more ? 0.46 : 0.40) * NOISE_NM);
        models_make(5.0);
        TEST_ASSERT_TRUE(leave_noise_alone());
        TEST_ASSERT_EQUAL_INT(HCI_OK, behind_by(&search, &known, &known, &model, &behind, &note));
        TEST_ASSERT_TRUE(more ? behind > 5.0 : behind > 0.0 && behind < 3.0);
        known_are_better(!more);
        if (more) break;
        tearDown();
        setUp();
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_better_beside_what_neither_describes);
    RUN_TEST(test_better_by_their_own_noise_alone);
    RUN_TEST(test_worse_by_their_own_noise);
    RUN_TEST(test_nearly_as_well_where_nothing_but_noise_is_left);
    return UNITY_END();
}
