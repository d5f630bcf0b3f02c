/* Models that have left the table are not looked at any more. */
#include "host/diagnose/search/forward.c"

#include <string.h>

#include "unity.h"

static hci_candidate_models table;

void setUp(void)
{
    memset(&table, 0, sizeof table);
}

void tearDown(void)
{
}

static size_t type_of(const char *name)
{
    size_t k = 0;
    while (hci_candidate_type(k) != hci_effect_type_find(name))
        ++k;
    return k;
}

static void put(size_t at, const char *a, const char *b, double gain)
{
    table.model[at] = (hci_candidate_model){.a = type_of(a), .b = type_of(b), .gain = gain, .terms = 2};
}

/* Behind two that stay: a series, a single effect and a pair that promise more. */
static void test_what_has_left_is_not_picked(void)
{
    const hci_candidate_model *picked[SINGLES + PAIRS];
    put(0, "cogging", "cogging", 100.0);
    put(1, "friction", "reluctance", 30.0);
    table.count = 2;
    const char *const behind[][2] = {
        {"saturation", "saturation"}, {"back_emf", "back_emf"}, {"friction", "back_emf"}};
    for (size_t k = 0; k < sizeof behind / sizeof *behind; ++k) {
        put(2, behind[k][0], behind[k][1], 1e4);
        TEST_ASSERT_FALSE(powers_lead(&table));
        TEST_ASSERT_EQUAL_PTR(&table.model[1], best_pair(&table, NULL));
        TEST_ASSERT_NULL(best_pair(&table, &table.model[0]));
        TEST_ASSERT_NULL(frugal_pair(&table, &table.model[0]));
        TEST_ASSERT_EQUAL_DOUBLE(0.0, single_gain(&table, type_of("back_emf")));
        TEST_ASSERT_FALSE(one_does(&table, &table.model[2]));
        memset(picked, 0, sizeof picked);
        TEST_ASSERT_EQUAL_UINT64(2, models_pick(&table, picked));
        TEST_ASSERT_EQUAL_PTR(&table.model[0], picked[0]);
        TEST_ASSERT_EQUAL_PTR(&table.model[1], picked[1]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_has_left_is_not_picked);
    return UNITY_END();
}
