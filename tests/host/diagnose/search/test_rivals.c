/* Effects in place of others: what the recordings cannot tell apart is ambiguous, what they can is not. */
#include "host/diagnose/search/rivals.h"

#include "host/diagnose/attribute/attribute.h"
#include "host/diagnose/search/candidate_models.h"
#include "support/searching.h"

enum { SAMPLES = 300 }; /* of a run: a mechanical turn */

static hci_attribution attribution;

void setUp(void)
{
    dataset_start();
    memset(&attribution, 0, sizeof attribution);
}

void tearDown(void)
{
    hci_attribution_release(&attribution);
    search_end();
    dataset_end();
}

/* Friction at one speed, in four runs of which the last ones turn back. current_A: of every second one. */
static void record_friction(int back, double current_A)
{
    for (int k = 0; k < 4; ++k) {
        const double direction = k + back < 4 ? 1.0 : -1.0;
        record(SAMPLES,
               &(point){60.0 * direction, k % 2 ? current_A : 0.2 * current_A, 0.0, 0.05 * direction, 0.0});
    }
    search_start();
}

static size_t index_of(const char *effect)
{
    size_t k = 0;
    while (hci_candidate_type(k) != hci_effect_type_find(effect))
        ++k;
    return k;
}

/* The verdicts on the effects that could stand in place of one. */
static void rivals_of(const char *effect)
{
    attribution.types = hci_candidate_types();
    for (size_t r = 0; r < attribution.types; ++r)
        attribution.verdict[r].type = hci_candidate_type(r);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fitted_model_copy(&model, &attribution.model, &note));
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_search_rivals(&search, hci_effect_type_find(effect), &attribution, &note));
}

static size_t count_ambiguous(void)
{
    size_t count = 0;
    for (size_t r = 0; r < attribution.types; ++r)
        count += attribution.verdict[r].ambiguous;
    return count;
}

/* One speed and direction: a constant torque, which a wrong zero of the torque sensor is, too. */
static void test_what_looks_the_same_is_ambiguous(void)
{
    record_friction(0, 9.0);
    model_add("friction", "coulomb", NULL, 0.0);
    model_fit();
    rivals_of("friction");
    const hci_verdict *zero = &attribution.verdict[index_of("torque_sensor")];
    TEST_ASSERT_TRUE(zero->ambiguous && attribution.verdict[index_of("friction")].ambiguous);
    TEST_ASSERT_EQUAL_UINT64(2, count_ambiguous());
    TEST_ASSERT_TRUE(zero->rival_of == hci_effect_type_find("friction"));
    const hci_effect_term *offset = term_in(&zero->alternative.candidates, "torque_sensor", "offset", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * offset->std_error, -0.05, offset->value);
    TEST_ASSERT_DOUBLE_WITHIN(0.5, model.fit.score, zero->alternative.fit.score);
}

static void test_what_can_be_told_apart_is_not(void)
{
    record_friction(2, 9.0);
    model_add("friction", "coulomb", NULL, 0.0);
    model_fit();
    rivals_of("friction");
    TEST_ASSERT_EQUAL_UINT64(0, count_ambiguous());
}

/* Two effects in the model that are one and the same in the recordings: each could take over from the other.
 */
static void test_columns_that_are_the_same(void)
{
    for (int both = 0; both < 2; ++both) {
        const hci_effect_type *same_as[HCI_MOST_TYPES];
        record_friction(2 * both, 9.0);
        model_add("friction", "coulomb", NULL, 0.0);
        model_fit();
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidate_models_same(&search, &model.candidates, same_as, &note));
        TEST_ASSERT_TRUE(same_as[index_of("torque_sensor")] ==
                         (both ? NULL : hci_effect_type_find("friction")));
        TEST_ASSERT_NULL(same_as[index_of("current_offset")]);
        tearDown();
        setUp();
    }
}

/* ---- another effect instead ---- */

/* A wrong zero describes a part of a friction that has one sign in three runs and the other in one.
 * Without current: with it powers of the current would do as well. */
static void test_a_better_effect_takes_the_place(void)
{
    bool swapped = false;
    record_friction(1, 0.0);
    model_add("torque_sensor", "offset", NULL, 0.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_swap(&search, &model, &swapped, &note));
    if (swapped) model_is_renewed();
    TEST_ASSERT_TRUE(swapped && model_has("friction") && !model_has("torque_sensor"));
}

static void test_the_right_effect_stays(void)
{
    bool swapped = true;
    record_friction(1, 0.0);
    model_add("friction", "coulomb", NULL, 0.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_swap(&search, &model, &swapped, &note));
    if (swapped) model_is_renewed();
    TEST_ASSERT_TRUE(!swapped && model_has("friction"));
}

/* Where these rounds have been at the better one and left it, they do not go there again. */
static void test_no_model_is_returned_to(void)
{
    hci_candidates left = {0};
    bool swapped = true;
    const hci_candidate friction = candidate_of("friction", "coulomb", NULL, 0.0);
    record_friction(1, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&left, &friction, &note));
    hci_search_see(&search, &left);
    model_add("torque_sensor", "offset", NULL, 0.0);
    model_fit();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_search_swap(&search, &model, &swapped, &note));
    if (swapped) model_is_renewed();
    TEST_ASSERT_TRUE(!swapped && model_has("torque_sensor"));
    hci_candidates_release(&left);
}

/* ---- an angle that is read wrong ---- */

/* A cogging torque of 0.1 N·m at order 6 is declared; the torque is that at another angle, or of order 8
 * besides. */
static void record_declared(double error_rad, double more_Nm)
{
    hci_machine_release(&machine);
    files_write(files_path("cogging.csv"), "order,amplitude_Nm,phase_rad\n6,0.1,0\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_root, &machine, &note), note.text);
    for (size_t k = 0; k < 4; ++k) {
        record(SAMPLES, &(point){k % 2 ? -60.0 : 60.0, 0.0, 0.0, 0.0, 0.0});
        for (size_t j = 0; j < SAMPLES; ++j) {
            const double x = P * run[k].theta_m_rad[j];
            run[k].torque_Nm[j] += 0.1 * sin(6.0 * (x + error_rad * sin(x))) + more_Nm * sin(8.0 * x);
        }
    }
    search_start();
}

static bool cogging_is_of_angle(const double order[3])
{
    bool of_angle = false;
    for (int k = 0; k < 3 && order[k] > 0.0; ++k)
        model_add("cogging", "sine", "cosine", order[k]);
    model_fit();
    model_fit();
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_search_is_of_angle(&search, &model, hci_effect_type_find("cogging"), &of_angle, &note));
    return of_angle;
}

static void test_sidebands_of_a_declared_torque_are_of_the_angle(void)
{
    record_declared(0.03, 0.004);
    TEST_ASSERT_TRUE(cogging_is_of_angle((const double[]){5.0, 7.0, 8.0}));
}

static void test_another_order_is_none(void)
{
    record_declared(0.0, 0.02);
    TEST_ASSERT_FALSE(cogging_is_of_angle((const double[]){8.0, 0.0, 0.0}));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_looks_the_same_is_ambiguous);
    RUN_TEST(test_what_can_be_told_apart_is_not);
    RUN_TEST(test_columns_that_are_the_same);
    RUN_TEST(test_a_better_effect_takes_the_place);
    RUN_TEST(test_the_right_effect_stays);
    RUN_TEST(test_no_model_is_returned_to);
    RUN_TEST(test_sidebands_of_a_declared_torque_are_of_the_angle);
    RUN_TEST(test_another_order_is_none);
    return UNITY_END();
}
