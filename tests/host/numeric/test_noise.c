/* The noise under the lines of a recording, against processes whose equations are written here. */
#include "host/numeric/noise.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "support/reference.h"
#include "unity.h"

enum { MOST = 4096, SAMPLES = 20000 /* of a process, in as many records as that takes */ };

static uint64_t seed;
static double x[MOST];

void setUp(void)
{
    seed = 77;
}

void tearDown(void)
{
}

/* ---- processes ---- */

/* x_k = a x_{k−1} + b x_{k−2} + innovation·N(0, 1), settled. */
typedef struct {
    double a, b, innovation;
} process;

static void draw(const process *p, size_t n)
{
    double one = 0.0, two = 0.0;
    for (size_t k = 0; k < n + 500; ++k) {
        const double next = p->a * one + p->b * two + p->innovation * ref_normal(&seed);
        two = one;
        one = next;
        if (k >= 500) x[k - 500] = next;
    }
}

/* Standard deviation, from the Yule–Walker equations of second order. */
static double deviation(const process *p)
{
    const double a = p->a, b = p->b;
    return p->innovation * sqrt((1.0 - b) / ((1.0 + b) * ((1.0 - b) * (1.0 - b) - a * a)));
}

static hci_noise find(size_t n, bool closed, double floor)
{
    hci_noise noise;
    double *work = malloc(hci_noise_workspace(n) * sizeof *work);
    TEST_ASSERT_NOT_NULL(work);
    hci_noise_find(x, n, closed, floor, &noise, work);
    free(work);
    return noise;
}

/* What stands in the workspace before does not matter. */
static void test_a_workspace_that_was_used(void)
{
    enum { LENGTH = 1000 };
    double *work = malloc(hci_noise_workspace(LENGTH) * sizeof *work);
    TEST_ASSERT_NOT_NULL(work);
    for (size_t k = 0; k < LENGTH; ++k)
        x[k] = ref_normal(&seed);
    for (int closed = 0; closed < 2; ++closed) {
        hci_noise found[2];
        for (int used = 0; used < 2; ++used) {
            for (size_t k = 0; k < hci_noise_workspace(LENGTH); ++k)
                work[k] = used ? 1e9 : 0.0;
            hci_noise_find(x, LENGTH, closed, 0.0, &found[used], work);
        }
        TEST_ASSERT_EQUAL_MEMORY(&found[0], &found[1], sizeof found[0]);
    }
    free(work);
}

static const process WHITE = {0.0, 0.0, 0.02};
static const process SLOW = {0.8, 0.0, 0.02};       /* a low pass */
static const process RINGING = {1.2, -0.72, 0.003}; /* poles 0.85 exp(±0.78 j) */
static const process FAST = {-0.6, 0.0, 5.0};
static const process *const COLOURED[] = {&SLOW, &RINGING, &FAST};

/* Mean of what is found in records of n samples. */
static hci_noise mean_of(const process *p, size_t n, bool closed)
{
    hci_noise mean = {{0.0}, 0.0, 0.0};
    const size_t records = SAMPLES / n + 1;
    for (size_t k = 0; k < records; ++k) {
        draw(p, n);
        const hci_noise found = find(n, closed, 0.0);
        for (int j = 0; j < HCI_NOISE_MEMORY; ++j)
            mean.prediction[j] += found.prediction[j] / (double)records;
        mean.innovation += found.innovation / (double)records;
        mean.rms += found.rms / (double)records;
    }
    return mean;
}

/* ---- finding ---- */

/* 20000 samples tell a standard deviation to 0.5 %, from medians to 1 %; the bins of an open record depend on
 * each other, which moves their median by 2 %. */
static void test_white_noise(void)
{
    static const size_t LENGTH[] = {HCI_NOISE_LEAST, 129, 200, 511, 1000, 2048, 4001};
    for (size_t l = 0; l < sizeof LENGTH / sizeof *LENGTH; ++l)
        for (int closed = 0; closed < 2; ++closed) {
            const hci_noise found = mean_of(&WHITE, LENGTH[l], closed);
            TEST_ASSERT_DOUBLE_WITHIN(0.05, 1.0, found.rms / WHITE.innovation);
            TEST_ASSERT_DOUBLE_WITHIN(0.05, 1.0, found.innovation / WHITE.innovation);
            for (int j = 0; j < HCI_NOISE_MEMORY; ++j)
                TEST_ASSERT_DOUBLE_WITHIN(0.06, 0.0, found.prediction[j]);
        }
}

/* A window of 41 bins is a third of a spectrum of 128: shorter records than these blur the colour. */
static void test_coloured_noise(void)
{
    for (size_t p = 0; p < 3; ++p)
        for (size_t n = 777; n < 3000; n += 1271)
            for (int closed = 0; closed < 2; ++closed) {
                const hci_noise found = mean_of(COLOURED[p], n, closed);
                TEST_ASSERT_DOUBLE_WITHIN(0.06, 1.0, found.rms / deviation(COLOURED[p]));
                TEST_ASSERT_DOUBLE_WITHIN(0.04, 1.0, found.innovation / COLOURED[p]->innovation);
                TEST_ASSERT_DOUBLE_WITHIN(0.06, COLOURED[p]->a, found.prediction[0]);
                TEST_ASSERT_DOUBLE_WITHIN(0.06, COLOURED[p]->b, found.prediction[1]);
                for (int j = 2; j < HCI_NOISE_MEMORY; ++j)
                    TEST_ASSERT_DOUBLE_WITHIN(0.06, 0.0, found.prediction[j]);
            }
}

/* Orders ten times as large as the noise, and a mean a hundred times, in one and the same record without and
 * with them. */
static void test_lines_are_not_noise(void)
{
    static const double WHOLE[] = {6.0, 12.0, 48.0, 96.0, 200.0}, BROKEN[] = {5.3, 31.7, 77.45, 140.2, 230.6};
    for (int record = 0; record < 12; ++record) {
        const bool closed = record % 2 == 0;
        const process *p = record % 4 < 2 ? &WHITE : &FAST;
        const size_t n = record < 6 ? 1000 : 2048;
        draw(p, n);
        const hci_noise before = find(n, closed, 0.0);
        for (size_t k = 0; k < n; ++k) {
            x[k] += 100.0 * p->innovation;
            for (int j = 0; j < 5; ++j)
                x[k] += 10.0 * p->innovation *
                        sin(2.0 * REF_PI * (closed ? WHOLE : BROKEN)[j] * (double)k / (double)n + j);
        }
        const hci_noise after = find(n, closed, 0.0);
        TEST_ASSERT_DOUBLE_WITHIN(0.15, 1.0, after.rms / before.rms);
        TEST_ASSERT_DOUBLE_WITHIN(0.15, 1.0, after.innovation / before.innovation);
    }
}

/* White noise that is added, and nothing else in the record. */
static void test_floor(void)
{
    memset(x, 0, sizeof x);
    for (int closed = 0; closed < 2; ++closed) {
        const hci_noise found = find(300, closed, 0.25), none = find(300, closed, 0.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.25, found.rms);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.25, found.innovation);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, found.prediction[0]);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, none.prediction[0]);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, none.rms);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, none.innovation);
    }
    draw(&WHITE, 2000);
    const hci_noise alone = find(2000, true, 0.0), with = find(2000, true, 0.03);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(alone.rms * alone.rms + 9e-4), with.rms);
}

/* ---- whitening ---- */

/* Variance and correlations of what is left, over all records: 1 and 0 to 3/√20000 and what the noise that
 * was found is off. */
static void whitens(const process *p, size_t n, bool closed)
{
    double product[6] = {0.0}, count = 0.0;
    for (size_t record = 0; record < SAMPLES / n + 1; ++record) {
        draw(p, n);
        const hci_noise noise = find(n, closed, 0.0);
        hci_noise_whiten(&noise, x, n, 1);
        for (size_t k = 5; k < n; ++k, ++count)
            for (size_t lag = 0; lag < 6; ++lag)
                product[lag] += x[k] * x[k - lag];
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.08, 1.0, product[0] / count);
    for (int lag = 1; lag < 6; ++lag)
        TEST_ASSERT_DOUBLE_WITHIN(0.04, 0.0, product[lag] / count);
}

static void test_whitened_is_white(void)
{
    whitens(&WHITE, 300, true);
    for (size_t p = 0; p < 3; ++p)
        for (int closed = 0; closed < 2; ++closed)
            whitens(COLOURED[p], 1500, closed);
}

/* The filter written out, with as many rows as it remembers, fewer and more; the columns do not mix. */
static void test_whitening_of_columns(void)
{
    const hci_noise noise = {{0.5, -0.25, 0.125, 0.1, -0.05, 0.3}, 0.2, 0.7};
    double in[3][20], out[20 * 3];
    for (size_t n = 0; n <= 20; ++n) {
        for (size_t k = 0; k < 3 * n; ++k)
            out[k] = in[k % 3][k / 3] = ref_normal(&seed);
        hci_noise_whiten(&noise, out, n, 3);
        for (size_t k = 0; k < 3 * n; ++k) {
            const double *column = in[k % 3] + k / 3;
            double expected = column[0] / 0.7;
            if (k / 3 >= 6)
                expected = (column[0] - 0.5 * column[-1] + 0.25 * column[-2] - 0.125 * column[-3] -
                            0.1 * column[-4] + 0.05 * column[-5] - 0.3 * column[-6]) /
                           0.2;
            TEST_ASSERT_DOUBLE_WITHIN(1e-13, expected, out[k]);
        }
    }
}

static void test_white_noise_of_a_known_size(void)
{
    const hci_noise noise = hci_noise_white(0.5);
    double column[8] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0};
    hci_noise_whiten(&noise, column, 8, 1);
    for (int k = 0; k < 8; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(2.0 * (k + 1), column[k]);
}

/* What varies slowly is no noise, whatever its size; and a few samples tell nothing. */
static void test_noise_of_neighbours(void)
{
    double wave[400], plain;
    for (size_t k = 0; k < 400; ++k)
        wave[k] = 0.3 * ref_normal(&seed);
    plain = hci_noise_of_neighbours(wave, 400);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * 0.3 * sqrt(35.0 / 36.0 / 400.0), 0.3, plain); /* of second differences */
    for (size_t k = 0; k < 400; ++k)
        wave[k] += 5.0 + 3.0 * sin(2.0 * REF_PI * (double)k / 200.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * plain, plain, hci_noise_of_neighbours(wave, 400));
    TEST_ASSERT_TRUE(isnan(hci_noise_of_neighbours(wave, HCI_NOISE_FEWEST - 1)));
    TEST_ASSERT_FALSE(isnan(hci_noise_of_neighbours(wave, HCI_NOISE_FEWEST)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_workspace_that_was_used);
    RUN_TEST(test_white_noise);
    RUN_TEST(test_coloured_noise);
    RUN_TEST(test_lines_are_not_noise);
    RUN_TEST(test_floor);
    RUN_TEST(test_whitened_is_white);
    RUN_TEST(test_whitening_of_columns);
    RUN_TEST(test_white_noise_of_a_known_size);
    RUN_TEST(test_noise_of_neighbours);
    return UNITY_END();
}
