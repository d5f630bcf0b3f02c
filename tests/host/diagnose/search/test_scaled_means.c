/* The share of the means of segments that is left, and the torque of a model, by hand. */
#include "host/diagnose/search/scaled.c"

#include "support/one_segment.h"
#include "unity.h"

static hci_segment two[2];

void setUp(void)
{
    uint64_t seed = 1;
    one_segment_start(&seed);
    two[0] = (hci_segment){.first = 0, .count = 4};
    two[1] = (hci_segment){.first = 4, .count = 3};
    samples.segment = two;
    samples.segment_count = 2;
}

void tearDown(void)
{
}

/* Torques and what is left of them, in N·m times `size`; the third sample tells nothing. */
static void fill(double size)
{
    static const double TORQUE[7] = {1.0, 2.0, 99.0, 6.0, -1.0, -2.0, -3.0},
                        LEFT[7] = {0.1, -0.2, 99.0, 0.4, 0.3, 0.1, 0.2};
    for (size_t k = 0; k < 7; ++k) {
        sample[k].torque_Nm = size * TORQUE[k];
        residual[k] = size * LEFT[k];
        sample[k].count = k == 2 ? 0.0 : 1.0;
    }
}

/* Means 0.1 and 0.2 of 3 and −2, of three samples each. */
static void test_the_share_of_the_means(void)
{
    static const double SIZE[] = {1e-4, 1.0, 1e4};
    for (size_t k = 0; k < 3; ++k) {
        fill(SIZE[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt((0.01 + 0.04) / (9.0 + 4.0)), share_of_means(&search));
    }
    fill(0.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, share_of_means(&search));
}

/* Of the torque less what is left of it: 0.9, 2.2, 5.6 and −1.3, −2.1, −3.2; about the means of segments
 * where these are free. */
static void test_the_torque_of_a_model(void)
{
    static const double SIZE[] = {1e-4, 1.0};
    const double square = 0.81 + 4.84 + 31.36 + 1.69 + 4.41 + 10.24, of_means = 3.0 * (2.9 * 2.9 + 2.2 * 2.2);
    for (size_t k = 0; k < 2; ++k) {
        fill(SIZE[k]);
        regression.free_means = false;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * SIZE[k], SIZE[k] * sqrt(square / 6.0), torque_rms(&search));
        regression.free_means = true;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * SIZE[k], SIZE[k] * sqrt((square - of_means) / 6.0),
                                  torque_rms(&search));
    }
    for (size_t k = 0; k < 7; ++k)
        sample[k].count = 0.0;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, torque_rms(&search));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_share_of_the_means);
    RUN_TEST(test_the_torque_of_a_model);
    return UNITY_END();
}
