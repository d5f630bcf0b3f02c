/* Lists of candidates: types that stand together, what is in, the same terms, and what is left of one. */
#include "host/diagnose/candidates/candidates.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "unity.h"

static hci_candidates list;
static hci_note note;

void setUp(void)
{
    memset(&list, 0, sizeof list);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_candidates_release(&list);
}

static const hci_effect_type *type(const char *name)
{
    return hci_effect_type_find(name);
}

static hci_candidate make(const char *name, size_t count, double order)
{
    hci_candidate x = {.type = type(name), .count = count, .in = true};
    for (size_t k = 0; k < count; ++k)
        x.term[k] = (hci_effect_term){k, order, 1.0 + (double)k, NAN};
    return x;
}

static void add(const char *name, size_t count, double order)
{
    const hci_candidate x = make(name, count, order);
    TEST_ASSERT_EQUAL(HCI_OK, hci_candidates_add(&list, &x, &note));
}

static void test_types_stand_together(void)
{
    static const double ORDER[] = {6.0, 12.0, 18.0, 0.0, 1.0, 2.0};
    add("cogging", 2, 6.0);
    add("friction", 1, 0.0);
    add("cogging", 2, 12.0);
    add("back_emf", 2, 2.0);
    add("friction", 1, 1.0);
    add("cogging", 2, 18.0);
    TEST_ASSERT_EQUAL(6, list.count);
    for (size_t k = 0; k < 6; ++k) {
        TEST_ASSERT_EQUAL_DOUBLE(ORDER[k], list.candidate[k].term[0].order);
        TEST_ASSERT_EQUAL_PTR(type(k < 3   ? "cogging"
                                   : k < 5 ? "friction"
                                           : "back_emf"),
                              list.candidate[k].type);
    }
}

/* All of the registry, and one behind them. */
static void test_the_types_that_there_are(void)
{
    const size_t count = hci_candidate_types();
    for (size_t k = 0; k + 1 < count; ++k)
        TEST_ASSERT_TRUE(hci_candidate_type(k) != NULL && hci_candidate_type(k) == hci_effect_type_at(k));
    TEST_ASSERT_NULL(hci_effect_type_at(count - 1));
    TEST_ASSERT_EQUAL_PTR(&hci_empirical_type, hci_candidate_type(count - 1));
    TEST_ASSERT_NULL(hci_candidate_type(count));
}

static void test_what_is_in(void)
{
    add("cogging", 2, 6.0);
    add("cogging", 2, 12.0);
    add("friction", 1, 0.0);
    TEST_ASSERT_EQUAL(2, hci_candidates_types_in(&list));
    TEST_ASSERT_EQUAL(5, hci_candidates_terms_in(&list));
    list.candidate[1].in = false;
    TEST_ASSERT_EQUAL(2, hci_candidates_types_in(&list));
    TEST_ASSERT_EQUAL(3, hci_candidates_terms_in(&list));
    TEST_ASSERT_TRUE(hci_candidates_have(&list, type("cogging")) &&
                     hci_candidates_have(&list, type("friction")));
    hci_candidates_remove_type(&list, type("cogging"));
    TEST_ASSERT_FALSE(hci_candidates_have(&list, type("cogging")));
    TEST_ASSERT_TRUE(hci_candidates_have(&list, type("friction")));
    TEST_ASSERT_EQUAL(1, hci_candidates_types_in(&list));
    TEST_ASSERT_EQUAL(1, hci_candidates_terms_in(&list));
    TEST_ASSERT_FALSE(hci_candidates_have_series(&list));
    add("saturation", 2, 0.0);
    TEST_ASSERT_TRUE(hci_candidates_have_series(&list));
    list.candidate[3].in = false;
    TEST_ASSERT_FALSE(hci_candidates_have_series(&list));
}

/* Of the same effect, parameters and orders. */
static void test_the_same_terms(void)
{
    add("friction", 2, 6.0);
    add("cogging", 2, 6.0);
    add("cogging", 2, 12.0);
    hci_candidate x = make("cogging", 2, 12.0);
    TEST_ASSERT_EQUAL_PTR(&list.candidate[2], hci_candidates_find_in(&list, &x));
    x.term[1].value = 77.0; /* values do not count */
    x.term[1].order = 12.0 + 1e-12;
    TEST_ASSERT_EQUAL_PTR(&list.candidate[2], hci_candidates_find_in(&list, &x));
    x.term[1].order = 12.01;
    TEST_ASSERT_NULL(hci_candidates_find_in(&list, &x));
    x = make("cogging", 2, 12.0);
    x.term[1].parameter = 0;
    TEST_ASSERT_NULL(hci_candidates_find_in(&list, &x));
    x = make("cogging", 2, 12.0);
    x.count = 1;
    TEST_ASSERT_NULL(hci_candidates_find_in(&list, &x));
    x = make("cogging", 2, 12.0);
    list.candidate[2].in = false;
    TEST_ASSERT_NULL(hci_candidates_find_in(&list, &x));
}

static void test_copies_and_shorter_ones(void)
{
    hci_candidates copy;
    add("cogging", 2, 6.0);
    add("friction", 1, 0.0);
    list.reference_current_A = 7.0;
    TEST_ASSERT_EQUAL(HCI_OK, hci_candidates_copy(&list, &copy, &note));
    TEST_ASSERT_EQUAL(2, copy.count);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, copy.reference_current_A);
    TEST_ASSERT_TRUE(copy.candidate != list.candidate);
    TEST_ASSERT_EQUAL_MEMORY(list.candidate, copy.candidate, 2 * sizeof *list.candidate);
    hci_candidate_shorten(&copy.candidate[0]);
    TEST_ASSERT_TRUE(copy.candidate[0].count == 1 && copy.candidate[0].shortened);
    TEST_ASSERT_TRUE(list.candidate[0].count == 2 && !list.candidate[0].shortened);
    hci_candidates_release(&copy);
    TEST_ASSERT_TRUE(copy.count == 0 && copy.candidate == NULL);
}

/* From the declared value; a scale, such as the speed at which friction fades, is nothing by itself. */
static void test_departures(void)
{
    size_t scales = 0;
    for (size_t r = 0; hci_effect_type_at(r); ++r)
        for (size_t p = 0; p < hci_effect_type_at(r)->parameter_count; ++p) {
            hci_candidate x = {.type = hci_effect_type_at(r), .count = 1};
            const bool is_scale = (x.type->parameter[p].traits & HCI_PARAMETER_SCALE) != 0;
            x.term[0] = (hci_effect_term){p, 0.0, 5.0, NAN};
            x.declared[0] = 2.0;
            scales += is_scale;
            TEST_ASSERT_EQUAL_DOUBLE(is_scale ? 0.0 : 3.0, hci_candidate_departure(&x, 0));
        }
    TEST_ASSERT_TRUE(scales > 0);
}

static void test_memory_that_is_short(void)
{
    hci_candidates copy;
    const hci_candidate x = make("cogging", 2, 12.0);
    add("cogging", 2, 6.0);
    hci_memory_fail_after(0);
    TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY, hci_candidates_add(&list, &x, &note));
    TEST_ASSERT_EQUAL(1, list.count);
    TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY, hci_candidates_copy(&list, &copy, &note));
    TEST_ASSERT_TRUE(copy.count == 0 && copy.candidate == NULL);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_types_stand_together);
    RUN_TEST(test_the_types_that_there_are);
    RUN_TEST(test_what_is_in);
    RUN_TEST(test_the_same_terms);
    RUN_TEST(test_copies_and_shorter_ones);
    RUN_TEST(test_departures);
    RUN_TEST(test_memory_that_is_short);
    return UNITY_END();
}
