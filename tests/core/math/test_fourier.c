/* Fourier analysis against sums in long double, against known spectra, and at the edges of what samples can
 * tell. */
#include "hci/math/fourier.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "support/draws.h"
#include "unity.h"

static const long double two_pi = 6.28318530717958647692528676655900577L;

static uint64_t seed;

void setUp(void)
{
    seed = 20240607u;
}

void tearDown(void)
{
}

static double draw(void)
{
    return ref_uniform(&seed, -1.0, 1.0);
}

static double *doubles(size_t count)
{
    double *p = (double *)calloc(count > 0 ? count : 1, sizeof(double));
    TEST_ASSERT_NOT_NULL(p);
    return p;
}

static double *random_samples(size_t count)
{
    double *x = doubles(count);
    for (size_t j = 0; j < count; j++)
        x[j] = draw();
    return x;
}

/* Σ S sin(nθ) + C cos(nθ), with the angle in long double. */
static double waveform(const hci_harmonic *terms, size_t count, long double theta)
{
    long double sum = 0.0L;
    for (size_t k = 0; k < count; k++)
        sum += terms[k].sine * sinl(terms[k].order * theta) + terms[k].cosine * cosl(terms[k].order * theta);
    return (double)sum;
}

static void check_harmonic(double tolerance, hci_harmonic expected, hci_harmonic actual)
{
    TEST_ASSERT_EQUAL_DOUBLE(expected.order, actual.order);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, expected.sine, actual.sine);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, expected.cosine, actual.cosine);
}

/* --- uniform
 * ------------------------------------------------------------------------------------------------- */

static void test_uniform_against_sums_in_long_double(void)
{
    if (LDBL_MANT_DIG <= DBL_MANT_DIG) TEST_IGNORE_MESSAGE("long double is double here");
    const size_t counts[] = {1, 2, 3, 7, 64, 97, 360, 1001};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        const size_t count = counts[c], turns = 1 + c % 3;
        double *x = random_samples(count);
        for (size_t bin = 0; 2 * bin < count; bin += 1 + bin / 3) {
            long double sine = 0.0L, cosine = 0.0L;
            for (size_t j = 0; j < count; j++) {
                const long double angle = two_pi * (long double)bin * (long double)j / (long double)count;
                sine += x[j] * sinl(angle);
                cosine += x[j] * cosl(angle);
            }
            const long double weight = (bin == 0 ? 1.0L : 2.0L) / (long double)count;
            const hci_harmonic expected = {(double)bin / (double)turns, (double)(sine * weight),
                                           (double)(cosine * weight)};
            hci_harmonic actual = {0};
            TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fourier_uniform(x, count, turns, expected.order, &actual));
            check_harmonic(1e-15 + 4.0 * DBL_EPSILON, expected,
                           actual); /* angles to 1 ulp of 2π, sums of order 1 */
        }
        free(x);
    }
}

/* Band-limited over three turns, thirds included: each coefficient comes back, and an order not there is
 * zero. */
static void test_uniform_is_exact_for_fractional_orders(void)
{
    enum { COUNT = 240, TURNS = 3, TERMS = 5 };
    const hci_harmonic terms[TERMS] = {{0.0, 0.0, -2.5},
                                       {1.0 / 3.0, 0.3, -0.1},
                                       {1.0, 12.0, 5.0},
                                       {7.0 / 3.0, 0.0, 0.7},
                                       {39.0 + 2.0 / 3.0, -1.0, 0.2}};
    const double tolerance = 2e-13; /* 119/3 is rounded by 4e-15, over 19 rad; ulp of the 13 of order 1 */
    double x[COUNT];
    for (size_t j = 0; j < COUNT; j++)
        x[j] = waveform(terms, TERMS, two_pi * TURNS * (long double)j / COUNT);
    for (size_t k = 0; k < TERMS; k++) {
        hci_harmonic actual;
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fourier_uniform(x, COUNT, TURNS, terms[k].order, &actual));
        check_harmonic(tolerance, terms[k], actual);
    }
    const hci_harmonic absent = {2.0, 0.0, 0.0};
    hci_harmonic actual;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fourier_uniform(x, COUNT, TURNS, 2.0, &actual));
    check_harmonic(tolerance, absent, actual);
    /* an order read from text with six digits is still this order */
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fourier_uniform(x, COUNT, TURNS, 0.3333333, &actual));
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, 0.3, actual.sine);
    TEST_ASSERT_EQUAL_DOUBLE(0.3333333, actual.order);
}

/* bin·j reaches 10¹⁰: an angle formed by multiplying in floating point would be wrong in its sixth digit. */
static void test_uniform_keeps_the_angle_of_long_records(void)
{
    const size_t count = 200003, bin = 99991;
    const hci_harmonic term = {(double)bin, 0.6, -0.8};
    double *x = doubles(count);
    for (size_t j = 0; j < count; j++) {
        const uint64_t index = (uint64_t)bin * j % count;
        const long double angle = two_pi * (long double)index / (long double)count;
        x[j] = (double)(0.6L * sinl(angle) - 0.8L * cosl(angle));
    }
    hci_harmonic actual;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fourier_uniform(x, count, 1, (double)bin, &actual));
    check_harmonic(1e-13, term, actual); /* rounding of 2·10⁵ sums, √N u */
    free(x);
}

/* Where a sample stands at the start of each period the angle is 0, however many turns on: no rounding of a
 * sine is left. */
static void test_uniform_starts_each_period_at_nothing(void)
{
    double x[12] = {0.0};
    hci_harmonic actual;
    x[0] = x[4] = x[8] = 1.0;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fourier_uniform(x, 12, 1, 3.0, &actual));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, actual.sine);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, actual.cosine);
}

static void test_uniform_refuses(void)
{
    double x[12] = {1.0, 2.0, 3.0};
    hci_harmonic out = {-7.0, -7.0, -7.0};
    const struct {
        size_t count, turns;
        double order;
    } bad[] = {
        {12, 1, 6.0},  /* count/2 is its own alias */
        {12, 1, 7.0},  /* alias of 5 */
        {12, 2, 3.0},  /* count/2 again, over two turns */
        {12, 1, 1.5},  /* not a whole number of periods */
        {12, 3, 0.4},  /* 1.2 periods */
        {12, 1, -1.0}, /* orders are not negative */
        {12, 0, 1.0},  /* no turn */
        {0, 1, 0.0},   /* no sample */
        {12, 1, (double)NAN}, {12, 1, HUGE_VAL},
        {12, 1, 1.0 + 1e-5}, /* farther from 1 than the order tolerance */
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT,
                              hci_fourier_uniform(x, bad[k].count, bad[k].turns, bad[k].order, &out));
    x[5] = (double)NAN;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_NOT_FINITE, hci_fourier_uniform(x, 12, 1, 2.0, &out));
    x[5] = HUGE_VAL;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_NOT_FINITE, hci_fourier_uniform(x, 12, 1, 0.0, &out));
    const hci_harmonic untouched = {-7.0, -7.0, -7.0};
    check_harmonic(0.0, untouched, out);
}

/* --- least-squares fit
 * --------------------------------------------------------------------------------------- */

static hci_status fit(const double *theta, const double *x, size_t count, const double *orders,
                      size_t order_count, hci_harmonic *out)
{
    double *work = doubles(hci_fourier_fit_workspace(order_count));
    for (size_t k = 0; k < hci_fourier_fit_workspace(order_count); ++k)
        work[k] = (double)NAN; /* what was there before counts for nothing */
    const hci_status status = hci_fourier_fit(theta, x, count, orders, order_count, out, work);
    free(work);
    return status;
}

static double *random_angles(size_t count, double reach_rad)
{
    double *theta = random_samples(count);
    for (size_t j = 0; j < count; j++)
        theta[j] *= reach_rad;
    return theta;
}

/* Without noise the spectrum comes back from any angles, around every edge of a block of rows. */
static void test_fit_recovers_a_spectrum_from_uneven_angles(void)
{
    enum { TERMS = 6 };
    const hci_harmonic terms[TERMS] = {{0.0, 0.0, 8.0},  {0.25, 0.2, -0.4}, {1.0, 12.0, 5.0},
                                       {1.25, 0.1, 0.1}, {6.0, -1.0, 0.5},  {37.0, 0.01, 0.02}};
    const double orders[TERMS] = {0.0, 0.25, 1.0, 1.25, 6.0, 37.0};
    const size_t counts[] = {31, 32, 33, 63, 64, 65, 100, 1000};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        double *theta = random_angles(counts[c], 40.0), *x = doubles(counts[c]);
        hci_harmonic out[TERMS];
        for (size_t j = 0; j < counts[c]; j++)
            x[j] = waveform(terms, TERMS, theta[j]);
        TEST_ASSERT_EQUAL_INT(HCI_OK, fit(theta, x, counts[c], orders, TERMS, out));
        for (size_t k = 0; k < TERMS; k++)
            check_harmonic(1e-11, terms[k],
                           out[k]); /* nθ <= 1500 is known to 2e-13; condition of 31 draws up to 100 */
        free(theta), free(x);
    }
}

/* As many samples as unknowns: interpolation, one row at a time into the triangle. */
static void test_fit_interpolates(void)
{
    const double orders[] = {0.0, 1.0, 2.0}, theta[] = {0.1, 1.0, 2.5, 3.9, 5.0};
    const double x[] = {1.0, -2.0, 3.0, -4.0, 5.0};
    hci_harmonic out[3];
    TEST_ASSERT_EQUAL_INT(HCI_OK, fit(theta, x, 5, orders, 3, out));
    for (size_t j = 0; j < 5; j++)
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, x[j], waveform(out, 3, theta[j]));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, fit(theta, x, 4, orders, 3, out));
}

/* Normal equations in long double with Gauss elimination: the second implementation, on noise. */
static void normal_equations(const double *theta, const double *x, size_t count, const double *orders,
                             size_t n, hci_harmonic *out)
{
    long double a[12][13] = {{0}}, row[13];
    const size_t p = 2 * n;
    for (size_t j = 0; j < count; j++) {
        for (size_t k = 0; k < n; k++) {
            row[2 * k] = sinl((long double)orders[k] * theta[j]);
            row[2 * k + 1] = cosl((long double)orders[k] * theta[j]);
        }
        row[p] = x[j];
        for (size_t r = 0; r < p; r++)
            for (size_t c = 0; c <= p; c++)
                a[r][c] += row[r] * row[c];
    }
    for (size_t k = 0; k < p; k++)
        for (size_t r = 0; r < p; r++) {
            const long double f = a[r][k] / a[k][k];
            for (size_t c = k; r != k && c <= p; c++)
                a[r][c] -= f * a[k][c];
        }
    for (size_t k = 0; k < n; k++) {
        out[k].order = orders[k];
        out[k].sine = (double)(a[2 * k][p] / a[2 * k][2 * k]);
        out[k].cosine = (double)(a[2 * k + 1][p] / a[2 * k + 1][2 * k + 1]);
    }
}

static void test_fit_of_noise_against_normal_equations(void)
{
    enum { ORDERS = 5 };
    const double orders[ORDERS] = {0.5, 1.0, 1.5, 6.0, 12.5};
    for (size_t count = 20; count < 400; count += 37) {
        double *theta = random_angles(count, 30.0), *x = random_samples(count);
        hci_harmonic expected[ORDERS], actual[ORDERS];
        normal_equations(theta, x, count, orders, ORDERS, expected);
        TEST_ASSERT_EQUAL_INT(HCI_OK, fit(theta, x, count, orders, ORDERS, actual));
        for (size_t k = 0; k < ORDERS; k++)
            check_harmonic(1e-11, expected[k], actual[k]); /* nθ to 5e-14, condition */
        free(theta), free(x);
    }
}

/* On even angles over whole turns the orders are orthogonal: the fit is the transform. */
static void test_fit_is_the_transform_on_even_angles(void)
{
    enum { COUNT = 180, TURNS = 2, ORDERS = 4 };
    const double orders[ORDERS] = {0.0, 0.5, 3.0, 44.5};
    double theta[COUNT], *x = random_samples(COUNT);
    hci_harmonic out[ORDERS], expected;
    for (size_t j = 0; j < COUNT; j++)
        theta[j] = (double)(two_pi * TURNS * (long double)j / COUNT);
    TEST_ASSERT_EQUAL_INT(HCI_OK, fit(theta, x, COUNT, orders, ORDERS, out));
    for (size_t k = 0; k < ORDERS; k++) {
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_fourier_uniform(x, COUNT, TURNS, orders[k], &expected));
        check_harmonic(1e-13, expected, out[k]); /* 44.5·4π is known to 6e-14 */
    }
    free(x);
}

static void test_fit_takes_whole_orders_wrapped_or_not(void)
{
    enum { COUNT = 500, ORDERS = 3 };
    const double orders[ORDERS] = {1.0, 5.0, 7.0};
    double wrapped[COUNT], unwrapped[COUNT], *x = random_samples(COUNT);
    hci_harmonic a[ORDERS], b[ORDERS];
    for (size_t j = 0; j < COUNT; j++) {
        unwrapped[j] = 0.137 * (double)j + 0.05 * draw();
        wrapped[j] = fmod(unwrapped[j], (double)two_pi);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, fit(wrapped, x, COUNT, orders, ORDERS, a));
    TEST_ASSERT_EQUAL_INT(HCI_OK, fit(unwrapped, x, COUNT, orders, ORDERS, b));
    for (size_t k = 0; k < ORDERS; k++)
        check_harmonic(1e-12, a[k], b[k]); /* 7·68 rad to 6e-14, and 2π in double */
    free(x);
}

/* Orders 1 and 1.02 over two turns drift apart by 0.04 of a period only: the columns differ by 0.1, their
 * second differences by less. Conditioning enters once, so the digits lost are those of the angle times some
 * 10³. */
static void test_fit_separates_close_orders_over_few_turns(void)
{
    enum { COUNT = 400, TERMS = 3 };
    const double orders[TERMS] = {0.98, 1.0, 1.02};
    const hci_harmonic terms[TERMS] = {{0.98, 0.3, -0.2}, {1.0, 10.0, 1.0}, {1.02, -0.1, 0.4}};
    double theta[COUNT], x[COUNT];
    hci_harmonic out[TERMS];
    for (size_t j = 0; j < COUNT; j++) {
        theta[j] = (double)two_pi * (1.0 + draw());
        x[j] = waveform(terms, TERMS, theta[j]);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, fit(theta, x, COUNT, orders, TERMS, out));
    for (size_t k = 0; k < TERMS; k++)
        check_harmonic(1e-11, terms[k], out[k]); /* normal equations: about 1e-9 */
}

static void test_fit_says_when_the_angles_cannot_tell(void)
{
    enum { COUNT = 24 };
    double theta[COUNT], x[COUNT], same[COUNT];
    hci_harmonic out[2] = {{-7.0, -7.0, -7.0}, {-7.0, -7.0, -7.0}};
    for (size_t j = 0; j < COUNT; j++) {
        theta[j] = (double)(two_pi * (long double)j / COUNT);
        x[j] = draw();
        same[j] = 1.0;
    }
    const double alias[2] = {5.0, 19.0}, half[1] = {12.0}, mean_alias[2] = {0.0, 24.0}, pair[2] = {1.0, 2.0};
    const double close[2] = {1.0, 1.0 + 2e-6};
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, fit(theta, x, COUNT, alias, 2, out)); /* 19 = 24 − 5 */
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR,
                          fit(theta, x, COUNT, half, 1, out)); /* sin 12θ is zero at all of them */
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, fit(theta, x, COUNT, mean_alias, 2, out));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, fit(same, x, COUNT, pair, 2, out));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, fit(theta, x, 3, pair, 2, out));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, fit(theta, x, 0, pair, 2, out));
    TEST_ASSERT_EQUAL_INT(HCI_OK, fit(theta, x, COUNT, close, 2, out)); /* hard, but told apart */

    double far[COUNT]; /* the same even angles a million turns on: 19θ is known to 2e-8 only */
    for (size_t j = 0; j < COUNT; j++)
        far[j] = theta[j] + (double)(two_pi * 1e6L);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_SINGULAR, fit(far, x, COUNT, alias, 2, out));
}

static void test_fit_refuses(void)
{
    double theta[4] = {0.0, 1.0, 2.0, 3.0}, x[4] = {1.0, 1.0, 1.0, 1.0};
    hci_harmonic out[2] = {{-7.0, -7.0, -7.0}, {-7.0, -7.0, -7.0}};
    const double bad[][2] = {{2.0, 1.0},  {1.0, 1.0},      {1.0, 1.0 + 1e-7},
                             {-1.0, 1.0}, {1.0, HUGE_VAL}, {(double)NAN, 1.0}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT, fit(theta, x, 4, bad[k], 2, out));
    const double one[1] = {1.0};
    for (size_t j = 0; j < 4; j++) {
        const double kept_theta = theta[j], kept_x = x[j];
        theta[j] = (double)NAN;
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_NOT_FINITE, fit(theta, x, 4, one, 1, out));
        theta[j] = kept_theta;
        x[j] = -HUGE_VAL;
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_NOT_FINITE, fit(theta, x, 4, one, 1, out));
        x[j] = kept_x;
    }
    const hci_harmonic untouched = {-7.0, -7.0, -7.0};
    check_harmonic(0.0, untouched, out[0]);
    check_harmonic(0.0, untouched, out[1]);
    TEST_ASSERT_EQUAL_INT(HCI_OK, fit(theta, x, 4, one, 0, out)); /* nothing asked, nothing written */
    check_harmonic(0.0, untouched, out[0]);
}

static void test_fit_of_the_mean_alone(void)
{
    const double order[1] = {0.0}, theta[3] = {0.0, 5.0, 9.0}, x[3] = {1.0, 2.0, 6.0};
    const hci_harmonic mean = {0.0, 0.0, 3.0};
    hci_harmonic out;
    TEST_ASSERT_EQUAL_INT(HCI_OK, fit(theta, x, 3, order, 1, &out));
    check_harmonic(1e-15, mean, out);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_uniform_against_sums_in_long_double);
    RUN_TEST(test_uniform_is_exact_for_fractional_orders);
    RUN_TEST(test_uniform_keeps_the_angle_of_long_records);
    RUN_TEST(test_uniform_starts_each_period_at_nothing);
    RUN_TEST(test_uniform_refuses);
    RUN_TEST(test_fit_recovers_a_spectrum_from_uneven_angles);
    RUN_TEST(test_fit_interpolates);
    RUN_TEST(test_fit_of_noise_against_normal_equations);
    RUN_TEST(test_fit_is_the_transform_on_even_angles);
    RUN_TEST(test_fit_takes_whole_orders_wrapped_or_not);
    RUN_TEST(test_fit_separates_close_orders_over_few_turns);
    RUN_TEST(test_fit_says_when_the_angles_cannot_tell);
    RUN_TEST(test_fit_refuses);
    RUN_TEST(test_fit_of_the_mean_alone);
    return UNITY_END();
}
