/* Multiples of an angle from one to the next, against sine and cosine of each. */
#include "core/math/turning.h"

#include "support/reference.h"
#include "unity.h"

/* Of 40 rotations with a few roundings each, and of the product of order and angle. */
static double rounding(double angle_rad)
{
    return 3e-14 + 4e-16 * fabs(angle_rad);
}

void setUp(void)
{
}

void tearDown(void)
{
}

static void is_right(const double *k, size_t count)
{
    uint64_t seed = 3;
    for (int trial = 0; trial < 200; ++trial) {
        const double angle = ref_uniform(&seed, -30.0, 30.0);
        hci_turning turning = HCI_TURNING;
        for (size_t j = 0; j < count; ++j) {
            hci_turning_to(&turning, k[j], angle);
            TEST_ASSERT_DOUBLE_WITHIN(rounding(k[j] * angle), sin(k[j] * angle), turning.s);
            TEST_ASSERT_DOUBLE_WITHIN(rounding(k[j] * angle), cos(k[j] * angle), turning.c);
        }
    }
}

static void test_orders_of_a_back_emf(void)
{
    is_right((double[]){1, 5, 7, 11, 13, 17, 19, 23, 25, 29, 31}, 11);
}

static void test_even_steps_back_and_fractions(void)
{
    double k[44];
    for (int j = 0; j < 40; ++j)
        k[j] = 6.0 * (j + 1);
    k[40] = k[41] = 0.0;
    k[42] = 1.0 / 7.0;
    k[43] = -3.0;
    is_right(k, 44);
}

/* Their differences are not equal to the last bit: one rotation does for all of them all the same. */
static void test_fifths_need_one_rotation(void)
{
    double k[40];
    hci_turning turning = HCI_TURNING;
    for (int j = 0; j < 40; ++j) {
        k[j] = (j + 1) / 5.0;
        hci_turning_to(&turning, k[j], 0.7);
        TEST_ASSERT_EQUAL_INT(1, turning.next);
    }
    is_right(k, 40);
}

/* Three kinds of steps and more, of which two are known at a time. */
static void test_errors_do_not_multiply(void)
{
    double k[1500], last = 0.0;
    uint64_t seed = 5;
    for (int j = 0; j < 1500; ++j)
        k[j] = last += ref_integer(&seed, 1, 4) / 8.0;
    for (int trial = 0; trial < 20; ++trial) {
        const double angle = ref_uniform(&seed, -30.0, 30.0);
        hci_turning turning = HCI_TURNING;
        for (size_t j = 0; j < 1500; ++j) {
            hci_turning_to(&turning, k[j], angle);
            TEST_ASSERT_DOUBLE_WITHIN(1e-11, sin(k[j] * angle), turning.s);
        }
    }
}

static void test_a_step_of_rounding_from_the_beginning(void)
{
    is_right((double[]){1e-15, 1.0}, 2);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_orders_of_a_back_emf);
    RUN_TEST(test_even_steps_back_and_fractions);
    RUN_TEST(test_fifths_need_one_rotation);
    RUN_TEST(test_errors_do_not_multiply);
    RUN_TEST(test_a_step_of_rounding_from_the_beginning);
    return UNITY_END();
}
