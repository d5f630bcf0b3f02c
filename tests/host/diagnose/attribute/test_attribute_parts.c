/* Parts of the attribution by themselves: values that are equal, what is beside something unknown, what the
 * machine leaves. */
#include "host/diagnose/attribute/attribute.c"

#include "support/searching.h"

static hci_attribution a;
static hci_candidate list[3];
static hci_candidates candidates;
static hci_fitted_model known;

void setUp(void)
{
    dataset_start();
    memset(&a, 0, sizeof a);
    memset(list, 0, sizeof list);
    candidates = (hci_candidates){.candidate = list, .count = 0};
}

void tearDown(void)
{
    hci_fitted_model_release(&known);
    hci_fitted_model_release(&search.single);
    search_end();
    dataset_end();
}

static void put(const char *effect, const char *parameter, double value)
{
    list[candidates.count] = candidate_of(effect, parameter, NULL, 0.0);
    list[candidates.count++].term[0].value = value;
}

/* Three values within a fifth of their mean, of either sign. */
static void test_values_that_are_equal(void)
{
    const hci_effect_type *gain = hci_effect_type_find("current_gain");
    for (int sign = -1; sign <= 1; sign += 2) {
        candidates.count = 0;
        put("current_gain", "a", sign * 0.10);
        put("current_gain", "b", sign * 0.09);
        TEST_ASSERT_FALSE(are_equal(&candidates, gain));
        put("current_gain", "c", sign * 0.1094);
        TEST_ASSERT_TRUE(are_equal(&candidates, gain));
        list[2].term[0].value = sign * 0.1107; /* 0.0207 of 0.1002 */
        TEST_ASSERT_FALSE(are_equal(&candidates, gain));
        list[2].term[0].value = sign * 0.1, list[1].in = false;
        TEST_ASSERT_FALSE(are_equal(&candidates, gain));
    }
}

static void test_what_is_beside_something_unknown(void)
{
    TEST_ASSERT_FALSE(is_beside_unknown(&a));
    a.unknown = true;
    TEST_ASSERT_TRUE(is_beside_unknown(&a));
    a.no_load_alone = true;
    TEST_ASSERT_FALSE(is_beside_unknown(&a));
    a.slip = hci_slip_of_load();
    TEST_ASSERT_TRUE(is_beside_unknown(&a));
    TEST_ASSERT_TRUE(is_convention(hci_effect_type_find("position_offset"), hci_effect_type_find("cogging")));
    TEST_ASSERT_FALSE(
        is_convention(hci_effect_type_find("position_offset"), hci_effect_type_find("reluctance")) ||
        is_convention(hci_effect_type_find("cogging"), hci_effect_type_find("cogging")));
}

/* Half of all torque, as rms, over all samples: of one run with the torque that the machine makes and one
 * with g times it (g - 1)/√(1 + g²) is left, which is a half where g is 2.215. */
static void test_a_machine_that_leaves_most(void)
{
    for (int more = 0; more < 2; ++more) {
        bool other = !more;
        for (int k = 0; k < 2; ++k) {
            record(150, &(point){k ? -60.0 : 60.0, 5.0, 0.0, 0.0, 0.0});
            for (size_t j = 0; j < 150; ++j)
                run[k].torque_Nm[j] = 1.5 * K_NM_PER_A * 5.0 * (k == 0 ? 1.0 : more ? 2.23 : 2.20);
        }
        search_start();
        TEST_ASSERT_EQUAL_INT(HCI_OK, is_of_another(&search, &model, &other, &note));
        TEST_ASSERT_EQUAL(more, other);
        tearDown();
        setUp();
    }
    search_start();
}

static void test_what_runs_without_a_current_show_is_marked(void)
{
    static hci_candidate shown;
    shown = candidate_of("cogging", "sine", NULL, 6.0);
    put("cogging", "sine", 0.1);
    put("friction", "coulomb", 0.1);
    a.no_load.candidates = (hci_candidates){.candidate = &shown, .count = 1};
    a.model.candidates = candidates;
    a.types = 3;
    a.verdict[0].type = hci_effect_type_find("friction");
    a.verdict[1].type = hci_effect_type_find("cogging");
    a.verdict[2].type = hci_effect_type_find("back_emf");
    a.verdict[2].established = true;
    established_mark(&a);
    TEST_ASSERT_TRUE(!a.verdict[0].established && a.verdict[1].established && !a.verdict[2].established);
    TEST_ASSERT_EQUAL_UINT64(2, verdict_at(&a, hci_effect_type_find("back_emf")));
    list[0].in = false;
    established_mark(&a);
    TEST_ASSERT_FALSE(a.verdict[1].established);
    search_start();
}

/* Of each type that may be in, from the first to the last. */
static void test_what_was_told_apart_is_forgotten_of_all(void)
{
    for (size_t k = 0; k < 4; ++k)
        a.verdict[k] = (hci_verdict){.ambiguous = true, .rival_of = hci_effect_type_at(0)};
    a.types = 3;
    ambiguities_forget(&a);
    for (size_t k = 0; k < 4; ++k) {
        TEST_ASSERT_EQUAL(k == 3, a.verdict[k].ambiguous);
        TEST_ASSERT_EQUAL(k == 3, a.verdict[k].rival_of != NULL);
    }
}

/* Six loads whose iron saturates, of different currents or of one, which tells no powers. */
static void record_saturated(double step_A)
{
    for (int k = 0; k < 6; ++k) {
        const double q = 8.0 - step_A * k;
        record(150, &(point){k % 2 ? 60.0 : -60.0, q, 0.0, 4e-4 * q * q * q, 0.0});
    }
    search_start();
    how.resolution_Nm = 0.5 * NOISE_NM;
    model.candidates.reference_current_A = 8.0;
    model_add("saturation", "d1q2_cosine", NULL, 0.0);
    model_fit();
}

/* Where all of the co-energy takes the place of a term that said nothing of runs left out, that term is kept
 * beside it; else nothing is. */
static void whole_is_tried(bool told)
{
    known.candidates.reference_current_A = 8.0;
    record_saturated(told ? 1.0 : 0.0);
    const double fitted = term_in(&model.candidates, "saturation", "d1q2_cosine", 0.0)->value;
    TEST_ASSERT_EQUAL_INT(HCI_OK, whole_try(&search, &model, &known, &note));
    TEST_ASSERT_EQUAL(told, search.whole_coenergy);
    TEST_ASSERT_EQUAL_UINT64(told, hci_candidates_terms_in(&search.single.candidates));
    if (told) {
        const hci_effect_term *t = term_in(&search.single.candidates, "saturation", "d1q2_cosine", 0.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * fabs(fitted), fitted, t->value);
        TEST_ASSERT_TRUE(hci_candidates_terms_in(&known.candidates) > 1);
    }
}

static void test_single_terms_are_kept_beside_the_whole(void)
{
    whole_is_tried(true);
    tearDown();
    setUp();
    whole_is_tried(false);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_values_that_are_equal);
    RUN_TEST(test_what_is_beside_something_unknown);
    RUN_TEST(test_a_machine_that_leaves_most);
    RUN_TEST(test_what_runs_without_a_current_show_is_marked);
    RUN_TEST(test_what_was_told_apart_is_forgotten_of_all);
    RUN_TEST(test_single_terms_are_kept_beside_the_whole);
    return UNITY_END();
}
