/* The curvature of the fit of a frequency and its drift: what offsets and harmonics cannot make of the
 * slopes, against residuals of least squares. */
#include "host/waveform/clock.c"

#include "support/least_squares.h"
#include "support/reference.h"
#include "unity.h"

enum { N = 90, COLUMNS = 5 };

static double time_s[N], v[3 * N];
static clock_fit c;

/* Two and a half periods with a third harmonic of each channel. */
void setUp(void)
{
    uint64_t seed = 3;
    for (int k = 0; k < N; ++k) {
        time_s[k] = 1e-3 * k;
        for (int s = 0; s < 3; ++s) {
            const double phase = 2.0 * REF_PI * (28.0 * time_s[k] - s / 3.0);
            v[3 * k + s] =
                (1.0 + 0.4 * s) * sin(phase) + 0.2 * sin(2.0 * phase + s) + 0.05 * ref_normal(&seed);
        }
    }
    c = (clock_fit){.time_s = time_s, .v = v, .n = N, .harmonics = 2, .columns = COLUMNS};
    c.middle_s = 0.5 * time_s[N - 1], c.half_s = c.middle_s;
    c.frequency_Hz = 27.5, c.drift_Hz_per_s = 3.0;
    for (int s = 0; s < 3; ++s)
        c.weight[s] = 1.0 / (1.0 + s);
}

void tearDown(void)
{
}

/* By the columns of row_at: β of least squares of y. */
static void least_squares(const double y[N], double beta[COLUMNS])
{
    double a[COLUMNS * (COLUMNS + 1)] = {0.0};
    for (size_t k = 0; k < N; ++k) {
        double x[COLUMNS_MOST], by[2];
        row_at(&c, k, x, by);
        for (int i = 0; i < COLUMNS; ++i) {
            for (int j = 0; j < COLUMNS; ++j)
                a[i * (COLUMNS + 1) + j] += x[i] * x[j];
            a[i * (COLUMNS + 1) + COLUMNS] += x[i] * y[k];
        }
    }
    ref_reduce(a, COLUMNS, COLUMNS + 1, COLUMNS + 1);
    for (int i = 0; i < COLUMNS; ++i)
        beta[i] = a[i * (COLUMNS + 1) + COLUMNS];
}

/* What the columns leave of y, in place. */
static void leave(double y[N])
{
    double beta[COLUMNS];
    least_squares(y, beta);
    for (size_t k = 0; k < N; ++k) {
        double x[COLUMNS_MOST], by[2];
        row_at(&c, k, x, by);
        for (int i = 0; i < COLUMNS; ++i)
            y[k] -= beta[i] * x[i];
    }
}

/* ∂v/∂φ (∂φ/∂f, ∂φ/∂a) of a channel. */
static void slopes_of(int s, double slope[2][N])
{
    double y[N], beta[COLUMNS];
    for (size_t k = 0; k < N; ++k)
        y[k] = v[3 * k + (size_t)s];
    least_squares(y, beta);
    for (size_t k = 0; k < N; ++k) {
        double x[COLUMNS_MOST], by[2];
        row_at(&c, k, x, by);
        const double by_phase = beta[1] * x[2] - beta[2] * x[1] + 2.0 * (beta[3] * x[4] - beta[4] * x[3]);
        slope[0][k] = by_phase * by[0];
        slope[1][k] = by_phase * by[1];
    }
}

static void test_what_the_linear_part_cannot_make(void)
{
    double expected[3] = {0.0, 0.0, 0.0};
    for (int s = 0; s < 3; ++s) {
        static double slope[2][N];
        slopes_of(s, slope);
        leave(slope[0]);
        leave(slope[1]);
        for (size_t k = 0; k < N; ++k) {
            expected[0] += c.weight[s] * slope[0][k] * slope[0][k];
            expected[1] += c.weight[s] * slope[0][k] * slope[1][k];
            expected[2] += c.weight[s] * slope[1][k] * slope[1][k];
        }
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, fit_linear(&c));
    (void)improve(&c);
    for (int k = 0; k < 3; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * expected[0], expected[k], c.slope_gram[k]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_the_linear_part_cannot_make);
    return UNITY_END();
}
