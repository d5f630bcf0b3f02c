/* Gains of current sensors by the sum of what they read, beside least squares in two differences. */
#include "host/fleet/current_sum.h"

#include <math.h>
#include <string.h>

#include "support/draws.h"
#include "unity.h"

enum { ROWS = 200, RUNS = 4 };

static hci_run run[RUNS];
static hci_role role[RUNS];
static hci_runs runs;
static double i_A[RUNS][3 * ROWS], gain[3], std_error[3];

/* Sensors that read 2 % more, 1 % less and 0.5 % less than they should, of currents of the run's size, with
 * an offset that all runs share and noise. */
static void make(double noise_A)
{
    uint64_t seed = 4;
    memset(run, 0, sizeof run);
    for (size_t r = 0; r < RUNS; ++r) {
        for (size_t k = 0; k < ROWS; ++k) {
            const double x = 0.11 * (double)k, q_A = 3.0 + (double)r;
            double *i = &i_A[r][3 * k];
            for (size_t s = 0; s < 3; ++s) {
                const double factor = s == 0 ? 1.02 : s == 1 ? 0.99 : 0.995;
                i[s] = factor * q_A * sin(x - 2.0 * REF_PI * (double)s / 3.0) + noise_A * ref_normal(&seed);
            }
            i[2] += 0.07;
        }
        run[r].count = ROWS;
        run[r].i_A = i_A[r];
        run[r].has_sum = true;
        role[r] = HCI_ROLE_FIT;
    }
    runs = (hci_runs){.run = run, .role = role, .count = RUNS};
}

void setUp(void)
{
    make(0.002);
}

void tearDown(void)
{
}

/* The sum over o + x i_a + y i_b by normal equations about the means, of runs from … to; then gains less
 * their mean. */
static void expect(size_t from, size_t to)
{
    double mean[3] = {0.0}, aa = 0.0, bb = 0.0, ab = 0.0, as = 0.0, bs = 0.0, ss = 0.0;
    const double *const flat = i_A[0], rows = (double)((to - from) * ROWS);
    for (size_t k = from * ROWS; k < to * ROWS; ++k) {
        const double *i = flat + 3 * k;
        mean[0] += i[0] / rows;
        mean[1] += i[1] / rows;
        mean[2] += (i[0] + i[1] + i[2]) / rows;
    }
    for (size_t k = from * ROWS; k < to * ROWS; ++k) {
        const double *i = flat + 3 * k;
        const double a = i[0] - mean[0], b = i[1] - mean[1], s = i[0] + i[1] + i[2] - mean[2];
        aa += a * a;
        bb += b * b;
        ab += a * b;
        as += a * s;
        bs += b * s;
        ss += s * s;
    }
    const double det = aa * bb - ab * ab, x = (bb * as - ab * bs) / det, y = (aa * bs - ab * as) / det;
    const double variance = (ss - x * as - y * bs) / (rows - 3.0);
    const double weight[3][2] = {{2.0 / 3.0, -1.0 / 3.0}, {-1.0 / 3.0, 2.0 / 3.0}, {-1.0 / 3.0, -1.0 / 3.0}};
    TEST_ASSERT_TRUE(hci_current_sum_gains(&runs, gain, std_error));
    for (int s = 0; s < 3; ++s) {
        const double u = weight[s][0], v = weight[s][1];
        const double square = (u * u * bb + v * v * aa - 2.0 * u * v * ab) / det;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, u * x + v * y, gain[s]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * sqrt(variance * square), sqrt(variance * square), std_error[s]);
    }
}

static void expect_none(void)
{
    TEST_ASSERT_TRUE(hci_current_sum_gains(&runs, gain, std_error));
    for (int s = 0; s < 3; ++s)
        TEST_ASSERT_TRUE(isnan(gain[s]) && isnan(std_error[s]));
}

/* By how much they read more than all of them, (2, −1, −0.5 less 1/6) %. */
static void test_gains_and_their_errors(void)
{
    static const double GAIN[3] = {0.02 - 0.005 / 3.0, -0.01 - 0.005 / 3.0, -0.005 - 0.005 / 3.0};
    expect(0, RUNS);
    for (int s = 0; s < 3; ++s)
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, GAIN[s], gain[s]); /* of first order in gains of 2 % */
}

/* Runs that are not fitted, have no currents or no sum of their own say nothing. */
static void test_which_runs_tell(void)
{
    role[0] = HCI_ROLE_HOLDOUT;
    run[3].has_sum = false;
    expect(1, 3);
    run[2].i_A = NULL;
    expect(1, 2);
    run[1].has_sum = false;
    expect_none();
}

/* A third current that was made of two has no sum but rounding. */
static void test_a_current_that_was_made(void)
{
    for (size_t r = 0; r < RUNS; ++r)
        for (size_t k = 0; k < ROWS; ++k)
            i_A[r][3 * k + 2] = -i_A[r][3 * k] - i_A[r][3 * k + 1];
    expect_none();
}

/* An error of more than a hundredth is too much. Noise that is as large as the currents adds to them too. */
static void test_noise_hides_gains(void)
{
    expect(0, RUNS);
    const double least = fmin(std_error[0], fmin(std_error[1], std_error[2])),
                 most = fmax(std_error[0], fmax(std_error[1], std_error[2]));
    make(0.002 * 0.008 / most);
    TEST_ASSERT_TRUE(hci_current_sum_gains(&runs, gain, std_error));
    TEST_ASSERT_FALSE(isnan(gain[0]) || isnan(gain[1]) || isnan(gain[2]));
    make(0.002 * 0.02 / least);
    expect_none();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_gains_and_their_errors);
    RUN_TEST(test_which_runs_tell);
    RUN_TEST(test_a_current_that_was_made);
    RUN_TEST(test_noise_hides_gains);
    return UNITY_END();
}
