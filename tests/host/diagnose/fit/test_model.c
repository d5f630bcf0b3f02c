/* Declared effects and candidates in one list: what replaces what, in which order, and where columns stand.
 */
#include "host/diagnose/fit/model.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "support/effect_list.h"
#include "unity.h"

static el_list declared;
static hci_candidates candidates;
static hci_model model;
static hci_note note;

void setUp(void)
{
    memset(&declared, 0, sizeof declared);
    memset(&candidates, 0, sizeof candidates);
    memset(&note, 0, sizeof note);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_model_release(&model);
    hci_candidates_release(&candidates);
}

static void propose(const char *effect, const char *parameter, double order, double value, bool in)
{
    hci_candidate x = {.type = hci_effect_type_find(effect), .count = 1, .in = in};
    x.term[0] = (hci_effect_term){el_parameter(x.type, parameter), order, value, 0.125};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&candidates, &x, &note));
}

/* The value of a term of the list; fails where it is not there exactly once. */
static double value_of(const char *effect, const char *parameter, double order)
{
    const hci_effect_type *type = hci_effect_type_find(effect);
    double value = NAN;
    size_t times = 0;
    for (size_t k = 0; k < model.list.count; ++k)
        for (size_t j = 0; j < model.list.effect[k].count; ++j) {
            const hci_effect_term *t = &model.list.effect[k].term[j];
            if (model.list.effect[k].type != type || t->parameter != el_parameter(type, parameter) ||
                fabs(t->order - order) > 1e-9)
                continue;
            value = t->value;
            ++times;
        }
    TEST_ASSERT_EQUAL_MESSAGE(1, times, parameter);
    return value;
}

static size_t terms(void)
{
    size_t sum = 0;
    for (size_t k = 0; k < model.list.count; ++k)
        sum += model.list.effect[k].count;
    return sum;
}

static void make(bool all)
{
    hci_model_release(&model);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_model_make(&declared.list, &candidates, all, &model, &note));
}

/* Three declared effects, of which a candidate replaces a value of the last and adds one to the second. */
static void test_candidates_on_top_of_what_is_declared(void)
{
    el_add(&declared, "cogging", "sine", 6.0, 0.1);
    el_add(&declared, "cogging", "cosine", 6.0, 0.2);
    el_add(&declared, "friction", "coulomb", 0.0, 0.3);
    el_add(&declared, "current_offset", "a", 0.0, 0.4);
    el_add(&declared, "current_offset", "b", 0.0, 0.5);
    propose("friction", "viscous", 0.0, 7.0, true);
    propose("current_offset", "b", 0.0, 8.0, true);
    propose("back_emf", "sine", 5.0, 9.0, true);
    propose("cogging", "sine", 12.0, 10.0, false);
    make(false);
    TEST_ASSERT_EQUAL(4, model.list.count);
    TEST_ASSERT_EQUAL(7, terms());
    TEST_ASSERT_EQUAL_DOUBLE(0.1, value_of("cogging", "sine", 6.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.2, value_of("cogging", "cosine", 6.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.3, value_of("friction", "coulomb", 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(7.0, value_of("friction", "viscous", 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.4, value_of("current_offset", "a", 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(8.0, value_of("current_offset", "b", 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(9.0, value_of("back_emf", "sine", 5.0));
    TEST_ASSERT_EQUAL(3, model.columns);
    make(true);
    TEST_ASSERT_EQUAL(8, terms());
    TEST_ASSERT_EQUAL(4, model.columns);
    TEST_ASSERT_EQUAL_DOUBLE(10.0, value_of("cogging", "sine", 12.0));
}

/* A column stands where its term does, counted through all effects of the list. */
static void test_places_of_columns(void)
{
    el_add(&declared, "friction", "coulomb", 0.0, 0.3);
    propose("current_offset", "c", 0.0, 1.0, true);
    propose("friction", "coulomb", 0.0, 2.0, true);
    propose("cogging", "sine", 6.0, 3.0, false);
    propose("cogging", "cosine", 6.0, 4.0, true);
    make(false);
    TEST_ASSERT_EQUAL(3, model.columns);
    for (size_t c = 0; c < model.columns; ++c) {
        const hci_model_column *x = &model.column[c];
        const hci_effect_term *wanted = &x->candidate->term[x->term];
        const hci_effect_term *first = model.list.effect[0].term;
        TEST_ASSERT_TRUE(x->candidate->in);
        TEST_ASSERT_TRUE(x->place < terms());
        TEST_ASSERT_EQUAL_DOUBLE(wanted->value, first[x->place].value);
        for (size_t other = 0; other < c; ++other)
            TEST_ASSERT_NOT_EQUAL(model.column[other].place, x->place);
    }
}

/* Orders that are one within the tolerance, and no others. */
static void test_orders_that_are_the_same(void)
{
    el_add(&declared, "cogging", "sine", 6.0, 0.1);
    propose("cogging", "sine", 6.0 + 0.5 * HCI_ORDER_TOLERANCE, 5.0, true);
    propose("cogging", "sine", 6.0 + 2.0 * HCI_ORDER_TOLERANCE, 7.0, true);
    make(false);
    TEST_ASSERT_EQUAL(2, terms());
    TEST_ASSERT_EQUAL_DOUBLE(5.0, model.list.effect[0].term[model.column[0].place].value);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, model.list.effect[0].term[model.column[1].place].value);
}

/* The reference current comes with the first candidate, unless the effect is declared, which has its own. */
static void test_the_reference_current(void)
{
    propose("saturation", "d1q2_cosine", 0.0, -0.01, true);
    candidates.reference_current_A = 7.5;
    make(false);
    TEST_ASSERT_EQUAL(2, terms());
    TEST_ASSERT_EQUAL_DOUBLE(7.5, value_of("saturation", "reference_current", 0.0));
    el_add(&declared, "saturation", "d1q2_cosine", 0.0, -0.02);
    el_add(&declared, "saturation", "reference_current", 0.0, 3.0);
    make(false);
    TEST_ASSERT_EQUAL(2, terms());
    TEST_ASSERT_EQUAL_DOUBLE(3.0, value_of("saturation", "reference_current", 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(-0.01, value_of("saturation", "d1q2_cosine", 0.0));
}

static void test_nothing_and_no_memory(void)
{
    make(true);
    TEST_ASSERT_EQUAL(0, model.list.count);
    TEST_ASSERT_EQUAL(0, model.columns);
    propose("friction", "coulomb", 0.0, 2.0, true);
    for (int left = 0; left < 3; ++left) {
        hci_model_release(&model);
        hci_memory_fail_after(left);
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY,
                              hci_model_make(&declared.list, &candidates, true, &model, &note));
        TEST_ASSERT_NULL(model.term);
        TEST_ASSERT_NULL(model.effect);
        TEST_ASSERT_NULL(model.column);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_candidates_on_top_of_what_is_declared);
    RUN_TEST(test_places_of_columns);
    RUN_TEST(test_orders_that_are_the_same);
    RUN_TEST(test_the_reference_current);
    RUN_TEST(test_nothing_and_no_memory);
    return UNITY_END();
}
