/* What is known beside what is not: each bound from both sides. */
#include "host/diagnose/attribute/cancelling_orders.c"
#include "host/diagnose/attribute/settle.c"
#include "host/diagnose/attribute/settle_means.c"

#include "support/one_segment.h"
#include "unity.h"

void setUp(void)
{
    uint64_t seed = 3;
    one_segment_start(&seed);
}

void tearDown(void)
{
}

/* Six tenths of what is known, of all or of the ripple, which has to be more than the noise too. */
static void test_what_is_much(void)
{
    understanding u = {.known_Nm = 1.0,
                       .unexplained_Nm = 0.59,
                       .known_ripple_Nm = 0.5,
                       .unexplained_ripple_Nm = 0.29,
                       .noise_Nm = 0.1};
    TEST_ASSERT_FALSE(is_much(&u));
    u.unexplained_Nm = 0.61;
    TEST_ASSERT_TRUE(is_much(&u));
    u.unexplained_Nm = 0.59, u.unexplained_ripple_Nm = 0.31;
    TEST_ASSERT_TRUE(is_much(&u));
    u.noise_Nm = 0.32;
    TEST_ASSERT_FALSE(is_much(&u));
    u.noise_Nm = 0.30;
    TEST_ASSERT_TRUE(is_much(&u));
}

static void test_what_runs_left_out_may_miss(void)
{
    TEST_ASSERT_FALSE(is_unpredicted(&search, 0.039));
    TEST_ASSERT_TRUE(is_unpredicted(&search, 0.041));
    search.whole_coenergy = true;
    TEST_ASSERT_FALSE(is_unpredicted(&search, 0.249));
    TEST_ASSERT_TRUE(is_unpredicted(&search, 0.251));
}

/* About the mean of each way; a sample that tells nothing has no residual. */
static void test_ripple_beside_the_means(void)
{
    double mean[2] = {0.0, 0.0}, count[2] = {0.0, 0.0}, square = 0.0;
    for (size_t k = 0; k < N; ++k) {
        sample[k].reading.speed_rad_per_s = k % 5 < 2 ? -1.0 : 1.0;
        residual[k] += k % 5 < 2 ? 3.0 : -1.0;
        if (k % 7 == 0) sample[k].count = residual[k] = 0.0;
        if (k % 7 == 0) continue;
        mean[k % 5 < 2] += residual[k];
        count[k % 5 < 2] += 1.0;
    }
    for (size_t k = 0; k < N; ++k)
        square += k % 7 == 0 ? 0.0 : pow(residual[k] - mean[k % 5 < 2] / count[k % 5 < 2], 2.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(square / (count[0] + count[1])), hci_search_ripple_rms(&search));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_much);
    RUN_TEST(test_what_runs_left_out_may_miss);
    RUN_TEST(test_ripple_beside_the_means);
    return UNITY_END();
}
