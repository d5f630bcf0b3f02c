/* Bins of a turn: where an angle belongs, means, and the scatter that does not follow the angle. */
#include "host/numeric/angle_bins.h"

#include <math.h>

#include "support/reference.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_an_angle_belongs_to_its_bin(void)
{
    const hci_angle_bins b = {.bins = 8};
    TEST_ASSERT_EQUAL_UINT(0, hci_angle_bins_at(&b, 0.0));
    TEST_ASSERT_EQUAL_UINT(0, hci_angle_bins_at(&b, 0.124));
    TEST_ASSERT_EQUAL_UINT(1, hci_angle_bins_at(&b, 0.125));
    TEST_ASSERT_EQUAL_UINT(7, hci_angle_bins_at(&b, 0.999));
    TEST_ASSERT_EQUAL_UINT(0, hci_angle_bins_at(&b, 1.0));
    TEST_ASSERT_EQUAL_UINT(7, hci_angle_bins_at(&b, -0.01));
    TEST_ASSERT_EQUAL_UINT(4, hci_angle_bins_at(&b, -1234.5));
}

/* −1e-20 turns are a whole turn less nothing once they are rounded: bin 8 of 8 would be out of the array. */
static void test_the_last_bin_is_not_passed(void)
{
    const hci_angle_bins b = {.bins = 8};
    TEST_ASSERT_EQUAL_UINT(0, hci_angle_bins_at(&b, -1e-20));
    TEST_ASSERT_EQUAL_UINT(7, hci_angle_bins_at(&b, nextafter(1.0, 0.0)));
}

static void test_means_are_of_the_samples_in_the_bin(void)
{
    hci_angle_bins b = {.bins = 4};
    hci_angle_bins_add(&b, 0.1, 1.0);
    hci_angle_bins_add(&b, 5.2, 2.0);
    hci_angle_bins_add(&b, 0.6, 7.0);
    TEST_ASSERT_EQUAL_DOUBLE(1.5, hci_angle_bins_mean(&b, 0));
    TEST_ASSERT_EQUAL_DOUBLE(7.0, hci_angle_bins_mean(&b, 2));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_angle_bins_mean(&b, 1));
}

/* Two values a bin: (1, 3) and (10, 10): Σ of squares about the means 2, two degrees of freedom. A bin with
 * one sample has none. */
static void test_scatter_is_about_the_mean_of_each_bin(void)
{
    hci_angle_bins b = {.bins = 4};
    hci_angle_bins_add(&b, 0.0, 1.0);
    hci_angle_bins_add(&b, 1.0, 3.0);
    hci_angle_bins_add(&b, 0.25, 10.0);
    hci_angle_bins_add(&b, 1.25, 10.0);
    hci_angle_bins_add(&b, 0.5, 99.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, hci_angle_bins_rms(&b, 1.0));
    TEST_ASSERT_TRUE(isnan(hci_angle_bins_rms(&b, 2.0)));
}

/* What follows the angle is no scatter: a wave of 4 N·m with noise of 0.1 reads as 0.1. 20000 samples tell it
 * to 0.1/√40000 = 0.5 %; within a bin of 1/256 the wave itself moves by 4·2π/256/√12 = 0.03 rms, in squares 4
 * %. */
static void test_noise_is_told_from_a_wave(void)
{
    hci_angle_bins b = {.bins = 256};
    uint64_t seed = 3;
    for (size_t k = 0; k < 20000; ++k) {
        const double turns = 0.0137 * (double)k;
        hci_angle_bins_add(&b, turns, 4.0 * sin(2.0 * REF_PI * turns) + 0.1 * ref_normal(&seed));
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.005, 0.1, hci_angle_bins_rms(&b, 100.0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_angle_belongs_to_its_bin);
    RUN_TEST(test_the_last_bin_is_not_passed);
    RUN_TEST(test_means_are_of_the_samples_in_the_bin);
    RUN_TEST(test_scatter_is_about_the_mean_of_each_bin);
    RUN_TEST(test_noise_is_told_from_a_wave);
    return UNITY_END();
}
