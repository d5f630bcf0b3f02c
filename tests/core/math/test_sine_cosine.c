/* Sine and cosine together, against those of the C library of what is left of an angle when quarters of a
 * turn are taken off: of large angles themselves some libraries have a π of 66 bits. */
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

/* π/2 in parts of 26 and 27 bits, so that 2²⁰ times each is exact, and a last one. */
static void reference(double angle_rad, double *s, double *c)
{
    static const double PART[] = {1.5707963109016418, 1.5893254712295857e-08, 6.123233932053594e-17,
                                  6.36831716351095e-25};
    const double n = floor(angle_rad / (0.5 * HCI_PI) + 0.5);
    const double left = angle_rad - n * PART[0] - n * PART[1] - n * PART[2] - n * PART[3];
    const int quarter = (int)(n - 4.0 * floor(n / 4.0));
    const double x = quarter % 2 ? cos(left) : sin(left), y = quarter % 2 ? sin(left) : cos(left);
    *s = quarter < 2 ? x : -x;
    *c = quarter == 1 || quarter == 2 ? -y : y;
}

static void is_right(double angle_rad)
{
    double s, c, sine = sin(angle_rad), cosine = cos(angle_rad);
    if (fabs(angle_rad) < HCI_MOST_REDUCED)
        reference(angle_rad, &sine, &cosine); /* beyond, those of the library */
    hci_sine_cosine(angle_rad, &s, &c);
    TEST_ASSERT_DOUBLE_WITHIN(WITHIN, sine, s);
    TEST_ASSERT_DOUBLE_WITHIN(WITHIN, cosine, c);
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
        double s, c, sine, cosine;
        const double angle_rad = 0.5 * HCI_PI * k;
        is_right(angle_rad);
        hci_sine_cosine(angle_rad, &s, &c);
        reference(angle_rad, &sine, &cosine);
        const double small = k % 2 ? cosine : sine;
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
