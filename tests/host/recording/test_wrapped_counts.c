/* Whether an encoder's counts begin anew within a recording. */
#include "host/recording/run_columns.c"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* A step back over more than half of all of them, which are more than a turn in degrees. */
static void test_what_begins_anew(void)
{
    const double turn[] = {0.0, 200.0, 400.0, 600.0, 800.0, 1000.0, 100.0, 300.0};
    TEST_ASSERT_TRUE(is_wrapped_over(turn, 8, 360.0));
    TEST_ASSERT_FALSE(is_wrapped_over(turn, 8, 1000.0)); /* no more than a turn */
    TEST_ASSERT_FALSE(is_wrapped_over(turn, 6, 360.0));  /* it goes on */
}

/* Three samples of an even climb step over half of it, and do not begin anew. */
static void test_an_even_climb(void)
{
    const double up[] = {0.0, 500.0, 1000.0}, down[] = {4000.0, 2000.0, 0.0};
    TEST_ASSERT_FALSE(is_wrapped_over(up, 3, 360.0));
    TEST_ASSERT_FALSE(is_wrapped_over(down, 3, 360.0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_begins_anew);
    RUN_TEST(test_an_even_climb);
    return UNITY_END();
}
