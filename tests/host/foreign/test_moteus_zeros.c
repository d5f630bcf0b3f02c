/* A map of nothing is one of zeros, and no unit makes anything else of it. */
#include "host/foreign/moteus.c"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_nothing_is_zeros(void)
{
    static double value[POINTS];
    hci_foreign_map map = {.points = POINTS, .columns = 1, .value = value};
    fit(&map);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, map.unit);
    for (size_t k = 0; k < POINTS; ++k) {
        TEST_ASSERT_EQUAL_DOUBLE(0.0, value[k]);
        TEST_ASSERT_EQUAL_INT(0, byte_of(&map, k));
    }
}

/* The largest value takes all of the byte, either way. */
static void test_the_largest_takes_the_byte(void)
{
    static double value[POINTS];
    hci_foreign_map map = {.points = POINTS, .columns = 1, .value = value};
    value[3] = -0.5, value[4] = 0.25;
    fit(&map);
    TEST_ASSERT_EQUAL_INT(-127, byte_of(&map, 3));
    TEST_ASSERT_EQUAL_INT(64, byte_of(&map, 4));
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, -0.5, value[3]);
    TEST_ASSERT_DOUBLE_WITHIN(0.5 / 254.0 + 1e-7, 0.25, value[4]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nothing_is_zeros);
    RUN_TEST(test_the_largest_takes_the_byte);
    return UNITY_END();
}
