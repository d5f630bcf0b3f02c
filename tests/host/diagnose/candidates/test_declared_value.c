/* What a machine has declared of a term, wherever it stands. */
#include "host/diagnose/candidates/make_candidates.c"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_each_declared_term(void)
{
    const hci_effect_type *cogging = hci_effect_type_find("cogging"),
                          *friction = hci_effect_type_find("friction");
    const hci_effect_term first[] = {{1, 0.0, 0.7, NAN}},
                          second[] = {{0, 6.0, 0.1, NAN}, {1, 6.0, 0.2, NAN}, {0, 12.0, 0.3, NAN}};
    const hci_effect effect[] = {{friction, first, 1}, {cogging, second, 3}};
    const hci_effects declared = {effect, 2};
    builder b = {.type = cogging, .declared = &declared};
    TEST_ASSERT_EQUAL_DOUBLE(0.1, declared_value(&b, 0, 6.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.2, declared_value(&b, 1, 6.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.3, declared_value(&b, 0, 12.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, declared_value(&b, 1, 12.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, declared_value(&b, 1, 0.0));
    b.type = friction;
    TEST_ASSERT_EQUAL_DOUBLE(0.7, declared_value(&b, 1, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, declared_value(&b, 0, 6.0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_declared_term);
    return UNITY_END();
}
