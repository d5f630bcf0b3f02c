/* An angle that was written in steps tells them, whether it was rounded or cut off; one that was not tells
 * none. */
#include "host/angle/steps_of.h"

#include <math.h>

#include "support/reference.h"
#include "unity.h"

enum { N = 4000 };

static double angle[N];
static uint64_t seed;

void setUp(void)
{
    seed = 7;
    for (size_t k = 0; k < N; ++k)
        angle[k] = 6e-3 * (double)k + 0.3 * sin(0.01 * (double)k) + 1e-3 * ref_normal(&seed);
}

void tearDown(void)
{
}

static double step_of(size_t n)
{
    return hci_steps_of(angle, n);
}

static void test_steps_are_told(void)
{
    const double step = 0.1 * REF_PI / 180.0;
    for (size_t k = 0; k < N; ++k)
        angle[k] = step * (k % 2 ? floor(angle[k] / step) : ceil(angle[k] / step)) + 0.123;
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * step, step, step_of(N));
    for (size_t k = 0; k < N; ++k) /* never less than three of them from one reading to the next */
        angle[k] = step * floor(3.5 * (double)k + sin(0.01 * (double)k));
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * step, step, step_of(N));
}

static void test_no_steps(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0.0, step_of(N));
    for (size_t k = 0; k < N; ++k) /* an even turn, read evenly */
        angle[k] = 6e-3 * (double)k;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, step_of(N));
}

static void test_one_that_stands_or_is_short(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0.0, step_of(15));
    for (size_t k = 0; k < N; ++k)
        angle[k] = 1.25;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, step_of(N));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_steps_are_told);
    RUN_TEST(test_no_steps);
    RUN_TEST(test_one_that_stands_or_is_short);
    return UNITY_END();
}
