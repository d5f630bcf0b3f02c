/* What a model leaves of candidates of several columns, from equations by hand. */
#include "host/diagnose/search/candidate_models.c"

#include "unity.h"

enum { COLUMNS = 5 };

static hci_candidate item[3];
static hci_candidates list;
static hci_normal_equations normal;
static dataset b;

static const hci_effect_type *type(const char *name)
{
    return hci_effect_type_find(name);
}

/* Friction in the model, two cogging orders of two columns each; 100 rows. */
void setUp(void)
{
    memset(item, 0, sizeof item);
    item[0] = (hci_candidate){.type = type("friction"), .count = 1, .in = true};
    item[1] = (hci_candidate){.type = type("cogging"), .count = 2, .price = 3.0};
    item[2] = (hci_candidate){.type = type("cogging"), .count = 2, .price = 3.0};
    list = (hci_candidates){.candidate = item, .count = 3};
    TEST_ASSERT_TRUE(hci_normal_equations_start(&normal, COLUMNS));
    normal.rows = 100.0, normal.square = 1e4;
    for (size_t c = 0; c < COLUMNS; ++c)
        normal.gram[c * COLUMNS + c] = 1.0;
}

void tearDown(void)
{
    bench_release(&b);
    hci_normal_equations_release(&normal);
}

static void couple(size_t i, size_t j, double correlation)
{
    normal.gram[i * COLUMNS + j] = normal.gram[j * COLUMNS + i] = correlation;
}

/* The model leaves 1 - correlation² of a column. */
static void leave(size_t column, double share)
{
    couple(0, column, sqrt(1.0 - share));
}

static void make(void)
{
    TEST_ASSERT_TRUE(dataset_make(&list, &normal, &b));
    TEST_ASSERT_EQUAL_UINT64(1, b.column[1]);
    TEST_ASSERT_EQUAL_UINT64(3, b.column[2]);
    TEST_ASSERT_TRUE(b.base.in[0] && !b.base.in[1]);
}

/* All columns of a candidate have to be made by the model, the first and the last. */
static void test_each_column_has_to_be_made(void)
{
    leave(1, 1e-3);
    leave(4, 1e-3);
    make();
    TEST_ASSERT_FALSE(is_within(&b, &b.base, 1, 1e-2)); /* the second is not */
    TEST_ASSERT_FALSE(is_within(&b, &b.base, 2, 1e-2)); /* the first is not */
}

static void test_the_share_that_is_left(void)
{
    leave(1, 1e-3);
    couple(1, 2, sqrt(1.0 - 1e-3) * sqrt(1.0 - 5e-3));
    leave(2, 5e-3);
    make();
    TEST_ASSERT_TRUE(is_within(&b, &b.base, 1, 5.1e-3));
    TEST_ASSERT_FALSE(is_within(&b, &b.base, 1, 4.9e-3));
    TEST_ASSERT_FALSE(is_within(&b, &b.base, 0, 1e9) && is_within(&b, &b.base, 2, 1e-2));
}

/* What is expected of a value is a row of its own, and no part of the column. */
static void test_what_is_expected_is_aside(void)
{
    item[2].deviation = 2.0; /* 1/4 */
    leave(4, 0.5);
    leave(3, 0.3);
    couple(3, 4, sqrt(0.7 * 0.5));
    make();
    TEST_ASSERT_TRUE(is_within(&b, &b.base, 2, 0.334)); /* (0.5 - 0.25)/(1 - 0.25) */
    TEST_ASSERT_FALSE(is_within(&b, &b.base, 2, 0.333));
    normal.gram[4 * COLUMNS + 4] = 0.25;
    couple(0, 4, 0.0);
    couple(3, 4, 0.0);
    bench_release(&b);
    TEST_ASSERT_TRUE(dataset_make(&list, &normal, &b));
    TEST_ASSERT_FALSE(is_within(&b, &b.base, 2, 1e9)); /* nothing but what is expected */
}

/* A law with further terms than the one that is in: what these lower, less what they cost; the price is
 * paid. */
static void test_what_more_terms_of_a_law_bring(void)
{
    item[2].type = type("friction");
    item[2].grown_from = 1;
    normal.moment[3] = 9.0;
    normal.moment[4] = 5.0;
    make();
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 25.0 - log(100.0), growth_gain(&b.choice, type("friction")));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, growth_gain(&b.choice, type("cogging")));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_column_has_to_be_made);
    RUN_TEST(test_the_share_that_is_left);
    RUN_TEST(test_what_is_expected_is_aside);
    RUN_TEST(test_what_more_terms_of_a_law_bring);
    return UNITY_END();
}
