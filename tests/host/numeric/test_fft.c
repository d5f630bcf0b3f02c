/* The transform against its sum, and the harmonics that it gives against those that the samples are made of.
 */
#include "host/numeric/fft.h"

#include <math.h>

#include "hci/math/harmonic.h"
#include "support/draws.h"
#include "unity.h"

enum { MOST = 64 };

static double re[MOST], im[MOST];

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_sizes_are_powers_of_two(void)
{
    static const double LEAST[] = {0.0, 1.0, 2.0, 2.5, 3.0, 4.0, 4.001, 1000.0, 1024.0, 1025.0};
    static const size_t SIZE[] = {2, 2, 2, 4, 4, 4, 8, 1024, 1024, 2048};
    for (int k = 0; k < 10; ++k)
        TEST_ASSERT_EQUAL_UINT64(SIZE[k], hci_fft_size(LEAST[k]));
}

static void test_transform_is_its_sum(void)
{
    uint64_t seed = 41;
    for (size_t n = 2; n <= MOST; n *= 2)
        for (int sign = -1; sign <= 1; sign += 2) {
            double x[MOST], y[MOST];
            for (size_t k = 0; k < n; ++k) {
                re[k] = x[k] = ref_uniform(&seed, -1.0, 1.0);
                im[k] = y[k] = ref_uniform(&seed, -1.0, 1.0);
            }
            hci_fft(re, im, n, sign);
            for (size_t k = 0; k < n; ++k) {
                double a = 0.0, b = 0.0;
                for (size_t j = 0; j < n; ++j) {
                    const double angle = sign * 2.0 * REF_PI * (double)(j * k % n) / (double)n;
                    a += x[j] * cos(angle) - y[j] * sin(angle);
                    b += x[j] * sin(angle) + y[j] * cos(angle);
                }
                TEST_ASSERT_DOUBLE_WITHIN(1e-13, a, re[k]);
                TEST_ASSERT_DOUBLE_WITHIN(1e-13, b, im[k]);
            }
        }
}

/* Two signals over three turns at once: each its own mean, sines and cosines. */
static void test_harmonics_of_two_signals(void)
{
    const hci_fft_pair pair = {re, im, MOST, 3};
    uint64_t seed = 42;
    hci_harmonic a[MOST / 2], b[MOST / 2];
    for (size_t k = 0; k < MOST / 2; ++k) {
        a[k] = (hci_harmonic){(double)k / 3.0, ref_uniform(&seed, -1.0, 1.0), ref_uniform(&seed, -1.0, 1.0)};
        b[k] = (hci_harmonic){(double)k / 3.0, ref_uniform(&seed, -1.0, 1.0), ref_uniform(&seed, -1.0, 1.0)};
    }
    a[0].sine = b[0].sine = 0.0;
    for (size_t j = 0; j < MOST; ++j) {
        re[j] = hci_harmonics_at(a, MOST / 2, 3.0 * 2.0 * REF_PI * (double)j / MOST);
        im[j] = hci_harmonics_at(b, MOST / 2, 3.0 * 2.0 * REF_PI * (double)j / MOST);
    }
    hci_fft(re, im, MOST, -1);
    for (size_t k = 0; k < MOST / 2; ++k) {
        hci_harmonic of_re, of_im;
        hci_fft_bin(&pair, k, &of_re, &of_im);
        TEST_ASSERT_EQUAL_DOUBLE((double)k / 3.0, of_re.order);
        TEST_ASSERT_EQUAL_DOUBLE((double)k / 3.0, of_im.order);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, a[k].sine, of_re.sine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, a[k].cosine, of_re.cosine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, b[k].sine, of_im.sine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, b[k].cosine, of_im.cosine);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_sizes_are_powers_of_two);
    RUN_TEST(test_transform_is_its_sum);
    RUN_TEST(test_harmonics_of_two_signals);
    return UNITY_END();
}
