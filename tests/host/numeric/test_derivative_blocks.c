/* Parts of the derivative: sums of a block about its own middle, added to those of a window about another
 * one, are the sums over all; the usual step is the mean of those that are no gaps. */
#include "host/numeric/derivative.c"

#include "support/draws.h"
#include "unity.h"

enum { N = 40 };

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_sums_about_another_origin(void)
{
    uint64_t seed = 5;
    double t[N], x[N];
    for (size_t k = 0; k < N; ++k) {
        t[k] = 3.0 + 0.2 * (double)k + ref_uniform(&seed, 0.0, 0.1);
        x[k] = ref_uniform(&seed, -2.0, 2.0);
    }
    for (size_t first = 0; first + 5 <= N; first += 5) {
        sums_about sum = sums_for(t, x, 0, N), block = sums_for(t, x, first, first + 5), all = sum;
        for (size_t k = first; k < first + 5; ++k) {
            add_to(&block, t[k], x[k], 1.0);
            add_to(&all, t[k], x[k], 1.0);
        }
        add_block(&sum, &block);
        for (int j = 0; j < 5; ++j)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, all.moment[j], sum.moment[j]);
        for (int j = 0; j < 3; ++j)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, all.product[j], sum.product[j]);
    }
}

static void test_the_usual_step(void)
{
    double t[N];
    for (size_t k = 0; k < N; ++k)
        t[k] = 0.5 * (double)k + (k < 20 ? 0.0 : 100.0) + (k < 30 ? 0.0 : 1e4);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, usual_step(t, N, GAP));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, usual_step(t, 3, GAP));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, (0.5 * (N - 1) + 1e4 + 100.0) / (N - 1), usual_step(t, N, 1e9));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_sums_about_another_origin);
    RUN_TEST(test_the_usual_step);
    return UNITY_END();
}
