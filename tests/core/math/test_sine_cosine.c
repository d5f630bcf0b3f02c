/* Sine and cosine together, against those of the C library. */
#include "core/math/sine_cosine.h"

#include "hci/math/harmonic.h"
#include "support/reference.h"
#include "unity.h"

#define WITHIN 2.3e-16

void setUp(void)
{
}

void tearDown(void)
{
}

static void is_right(double angle_rad)
{
    double s, c;
    hci_sine_cosine(angle_rad, &s, &c);
    TEST_ASSERT_DOUBLE_WITHIN(WITHIN, sin(angle_rad), s);
    TEST_ASSERT_DOUBLE_WITHIN(WITHIN, cos(angle_rad), c);
}

static void test_angles_of_any_size(void)
{
    static const double SIZE[] = {1e-9, 1.0, 30.0, 1e4, 1.59e6, 1e9};
    uint64_t seed = 5;
    for (size_t k = 0; k < sizeof SIZE / sizeof *SIZE; ++k)
        for (int trial = 0; trial < 20000; ++trial)
            is_right(ref_uniform(&seed, -SIZE[k], SIZE[k]));
}

/* Near its zeros each is right to its own last digits. */
static void test_quarters_of_a_turn(void)
{
    for (int k = -100000; k <= 100000; ++k) {
        double s, c;
        const double angle_rad = 0.5 * HCI_PI * k;
        is_right(angle_rad);
        hci_sine_cosine(angle_rad, &s, &c);
        const double small = k % 2 ? cos(angle_rad) : sin(angle_rad);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15 * fabs(small), small, k % 2 ? c : s);
    }
}

static void test_no_angle(void)
{
    double s, c;
    hci_sine_cosine(INFINITY, &s, &c);
    TEST_ASSERT_TRUE(isnan(s) && isnan(c));
    hci_sine_cosine(NAN, &s, &c);
    TEST_ASSERT_TRUE(isnan(s) && isnan(c));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_angles_of_any_size);
    RUN_TEST(test_quarters_of_a_turn);
    RUN_TEST(test_no_angle);
    return UNITY_END();
}
