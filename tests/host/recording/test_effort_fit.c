/* All that the fit of effort.h gives, compared with least squares over all columns at once. */
#include "host/recording/effort.h"

#include <math.h>
#include <string.h>

#include "support/draws.h"
#include "support/least_squares.h"
#include "unity.h"

enum { N = 4003, MOST = 512, COLUMNS = 7 }; /* columns: acceleration, sign, one, four waves */

static uint64_t seed;
static double at_s[N], speed[N], iq_A[N], theta_rad[N];
static double x[MOST][COLUMNS], y[MOST];

void setUp(void)
{
    seed = 5;
}

void tearDown(void)
{
}

/* ---- the same by one design matrix ---- */

/* Means over window j of count, time, speed, i_q, sign, waves. */
static void window_of(size_t n, size_t j, size_t count, double *out)
{
    const size_t from = j * n / count, to = (j + 1) * n / count;
    memset(out, 0, 8 * sizeof *out);
    for (size_t k = from; k < to; ++k) {
        const double of[8] = {at_s[k],
                              speed[k],
                              iq_A[k],
                              speed[k] > 0.0 ? 1.0 : -1.0,
                              sin(theta_rad[k]),
                              cos(theta_rad[k]),
                              sin(2.0 * theta_rad[k]),
                              cos(2.0 * theta_rad[k])};
        for (int i = 0; i < 8; ++i)
            out[i] += of[i] / (double)(to - from);
    }
}

/* The rows of a fit to windows of n samples; a window whose speed has both signs or is small tells nothing.
 */
static size_t make_rows(size_t n, size_t count)
{
    static double w[MOST][8];
    static bool told[MOST];
    size_t rows = 0;
    double square = 0.0;
    for (size_t k = 0; k < n; ++k)
        square += speed[k] * speed[k] / (double)n;
    for (size_t j = 0; j < count; ++j) {
        window_of(n, j, count, w[j]);
        told[j] = fabs(w[j][3]) > 0.9 && fabs(w[j][1]) > 0.1 * sqrt(square);
    }
    for (size_t j = 1; j + 1 < count; ++j) {
        if (!told[j - 1] || !told[j] || !told[j + 1]) continue;
        x[rows][0] = (w[j + 1][1] - w[j - 1][1]) / (w[j + 1][0] - w[j - 1][0]);
        x[rows][2] = 1.0;
        y[rows] = (w[j - 1][2] + 2.0 * w[j][2] + w[j + 1][2]) / 4.0;
        x[rows][1] = (w[j - 1][3] + 2.0 * w[j][3] + w[j + 1][3]) / 4.0;
        for (int i = 4; i < 8; ++i)
            x[rows][i - 1] = (w[j - 1][i] + 2.0 * w[j][i] + w[j + 1][i]) / 4.0;
        ++rows;
    }
    return rows;
}

/* Inverts XᵀX of the columns from `first` on, m of them, by Gauss and Jordan. */
static void invert_normal(size_t rows, int first, int m, double inverse[COLUMNS][COLUMNS])
{
    double a[COLUMNS][2 * COLUMNS] = {{0.0}};
    for (int i = 0; i < m; ++i) {
        a[i][m + i] = 1.0;
        for (int j = 0; j < m; ++j)
            for (size_t r = 0; r < rows; ++r)
                a[i][j] += x[r][first + i] * x[r][first + j];
    }
    ref_reduce(&a[0][0], m, 2 * m, 2 * COLUMNS);
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < m; ++j)
            inverse[i][j] = a[i][m + j];
}

typedef struct {
    double value[COLUMNS], error[COLUMNS];
    double rms; /* of what is left */
} solution;

/* Of m columns from `first` on; unknowns: how many of them the rows have to tell. */
static solution solve_from(size_t rows, int first, int m, int unknowns)
{
    solution s = {{0.0}, {0.0}, 0.0};
    double inverse[COLUMNS][COLUMNS], square = 0.0, beside = 0.0, before = 0.0;
    invert_normal(rows, first, m, inverse);
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < m; ++j)
            for (size_t r = 0; r < rows; ++r)
                s.value[i] += inverse[i][j] * x[r][first + j] * y[r];
    for (size_t r = 0; r < rows; ++r) {
        double rest = y[r];
        for (int i = 0; i < m; ++i)
            rest -= s.value[i] * x[r][first + i];
        square += rest * rest;
        beside += rest * before;
        before = rest;
    }
    const double alike = fmin(0.95, fmax(0.0, beside / square)); /* of one with the next */
    for (int i = 0; i < m; ++i)
        s.error[i] =
            sqrt(square / (double)(rows - (size_t)unknowns) * (1.0 + alike) / (1.0 - alike) * inverse[i][i]);
    s.rms = sqrt(square / (double)rows);
    return s;
}

static solution solve(size_t rows, int m, int unknowns)
{
    return solve_from(rows, 0, m, unknowns);
}

static double rms_of(const double *values, size_t n)
{
    double square = 0.0;
    for (size_t k = 0; k < n; ++k)
        square += values[k] * values[k] / (double)n;
    return sqrt(square);
}

/* ---- */

static hci_effort find(size_t n, const double *angle)
{
    return hci_effort_find(&(hci_effort_samples){at_s, speed, iq_A, angle, n});
}

static void is_near(double expected, double value)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-7 * fabs(expected), expected, value);
}

/* Stamps that are not even, speed mean + swing·sin(rate·t), and i_q = a·acceleration + c·sign + weight with
 * noise of which neighbours have much in common. */
static void make(double mean, double swing, double rate, double a, double c)
{
    double noise = 0.0;
    for (size_t k = 0; k < N; ++k) {
        const double t = 1e-3 * ((double)k + 0.3 * sin(0.01 * (double)k));
        if (k % 100 == 0) noise = 0.6 * noise + 0.04 * ref_normal(&seed);
        at_s[k] = t;
        speed[k] = mean + swing * sin(rate * t);
        theta_rad[k] = 0.7 + mean * t - swing / rate * cos(rate * t);
        iq_A[k] = a * swing * rate * cos(rate * t) + (speed[k] > 0.0 ? c : -c) + 0.07 + noise;
    }
}

static void test_one_way(void)
{
    make(-10.0, 8.0, 3.0, 0.02, 0.3);
    const size_t rows = make_rows(N, 32);
    TEST_ASSERT_EQUAL(30, rows);
    const solution s = solve(rows, 2, 3);
    const hci_effort effort = find(N, theta_rad);
    TEST_ASSERT_FALSE(effort.has_both_ways);
    is_near(s.value[0], effort.slope);
    is_near(s.value[0] / s.error[0], effort.accelerating);
    is_near(s.value[1] / s.error[1], effort.braking);
    is_near(s.value[1] / rms_of(y, rows), effort.share);
    is_near(s.value[1] / rms_of(iq_A, N), effort.of_all);
}

/* Beside the friction a weight is fitted, and windows in which the shaft turns round are left out. */
static void test_both_ways(void)
{
    make(0.8, 8.0, 3.0, -0.004, 0.3);
    const size_t rows = make_rows(N, 32);
    TEST_ASSERT_TRUE(rows >= 14 && rows < 30);
    const solution s = solve(rows, 3, 3);
    const hci_effort effort = find(N, NULL);
    TEST_ASSERT_TRUE(effort.has_both_ways);
    is_near(s.value[0], effort.slope);
    is_near(s.value[0] / s.error[0], effort.accelerating);
    is_near(s.value[1] / s.error[1], effort.braking);
    is_near(s.value[1] / rms_of(y, rows), effort.share);
    is_near(s.value[1] / rms_of(iq_A, N), effort.of_all);
}

/* A motion with 20 periods needs 256 windows: of fewer, no three in a row go one way and get faster. */
static void test_shorter_windows(void)
{
    make(3.0, 100.0, 31.0, 0.002, 0.1);
    const size_t rows = make_rows(N, 256);
    const solution s = solve(rows, 3, 3);
    const hci_effort effort = find(N, NULL);
    is_near(s.value[0], effort.slope);
    is_near(s.value[0] / s.error[0], effort.accelerating);
    is_near(s.value[1] / s.error[1], effort.braking);
}

/* A steady shaft does not accelerate: whatever the slope, it tells nothing. */
static void test_a_steady_shaft(void)
{
    make(10.0, 1.0, 3.0, 0.02, 0.3);
    const size_t rows = make_rows(N, 32);
    const solution s = solve(rows, 2, 3);
    const hci_effort effort = find(N, NULL);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, effort.accelerating);
    is_near(s.value[1] / s.error[1], effort.braking);
}

/* ---- beside an arm ---- */

/* There and back at a steady pace over some turns, with waves of order 1 and 2 that hide the friction. */
static void make_arm(double c)
{
    double noise = 0.0;
    for (size_t k = 0; k < N; ++k) {
        const double way = k < N / 2 ? 1.0 : -1.0, turn = 11.0 * (double)(k < N / 2 ? k : N - k) / (N / 2);
        if (k % 100 == 0) noise = 0.5 * noise + 0.03 * ref_normal(&seed);
        at_s[k] = 1e-2 * ((double)k + 0.3 * sin(0.01 * (double)k));
        theta_rad[k] = turn + 0.4;
        speed[k] = 0.6 * way * (1.0 + 0.1 * sin(0.013 * (double)k));
        iq_A[k] =
            c * way + 2.0 * sin(theta_rad[k] + 1.0) + 0.7 * cos(2.0 * theta_rad[k] - 0.3) + 0.05 + noise;
    }
}

/* What is left of i_q beside each wave, by itself. */
static double rms_without_waves(void)
{
    double square = rms_of(iq_A, N) * rms_of(iq_A, N);
    for (int i = 0; i < 4; ++i) {
        double along = 0.0, of = 0.0;
        for (size_t k = 0; k < N; ++k) {
            const double turn = (i < 2 ? 1.0 : 2.0) * theta_rad[k], wave = i % 2 == 0 ? sin(turn) : cos(turn);
            along += wave * iq_A[k];
            of += wave * wave;
        }
        square -= along * along / of / N;
    }
    return sqrt(square);
}

static void test_beside_an_arm(void)
{
    make_arm(-0.1);
    const size_t rows = make_rows(N, 32);
    const solution s = solve(rows, COLUMNS, COLUMNS);
    const hci_effort effort = find(N, theta_rad);
    TEST_ASSERT_EQUAL(-1, hci_effort_way(&effort));
    TEST_ASSERT_TRUE(effort.has_both_ways);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, effort.accelerating);
    is_near(s.value[1] / s.error[1], effort.braking);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, s.value[1] / rms_without_waves(), effort.of_all);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, s.value[1] / solve_from(rows, 2, 5, 5).rms, effort.share);
}

/* ---- how little is enough ---- */

/* 16 windows of four samples. */
static void test_few_samples(void)
{
    make(10.0, 1.0, 70.0, 0.0, 0.3);
    for (size_t k = 0; k < 100; ++k)
        iq_A[k] = 0.2 + 0.01 * ref_normal(&seed);
    const size_t rows = make_rows(64, 16);
    const hci_effort effort = find(64, NULL), none = find(63, NULL);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, none.braking);
    TEST_ASSERT_TRUE(none.accelerating == 0.0 && none.slope == 0.0 && none.share == 0.0 &&
                     none.of_all == 0.0 && !none.has_both_ways);
    is_near(solve(rows, 2, 3).value[1] / rms_of(iq_A, 64), effort.of_all);
}

/* ---- laws ---- */

/* The same samples in other units. */
static void is_alike_in_units(const double *angle)
{
    const hci_effort before = find(N, angle);
    for (size_t k = 0; k < N; ++k) {
        at_s[k] *= 1e-2;
        speed[k] *= 1e-3;
        iq_A[k] *= 1e4;
    }
    const hci_effort after = find(N, angle);
    TEST_ASSERT_EQUAL(before.has_both_ways, after.has_both_ways);
    is_near(before.accelerating, after.accelerating);
    is_near(before.slope * 1e4 * 1e-2 / 1e-3, after.slope);
    is_near(before.braking, after.braking);
    is_near(before.share, after.share);
    is_near(before.of_all, after.of_all);
}

static void test_units_do_not_matter(void)
{
    make(-10.0, 8.0, 3.0, 0.02, 0.3);
    is_alike_in_units(NULL);
    make(0.8, 8.0, 3.0, -0.004, 0.3);
    is_alike_in_units(NULL);
    make(3.0, 100.0, 31.0, 0.002, 0.1);
    is_alike_in_units(NULL);
    make_arm(-0.1);
    is_alike_in_units(theta_rad);
}

enum { EVEN = 2048 }; /* windows of 64 samples: their means of a constant speed are the same to the bit */

/* Without noise a sign is as sure as can be; without a current there is none. */
static void test_currents_without_noise(void)
{
    for (int sign = -1; sign <= 1; ++sign) {
        for (size_t k = 0; k < EVEN; ++k) {
            at_s[k] = 1e-3 * (double)k;
            speed[k] = 8.0;
            iq_A[k] = 0.4 * sign;
        }
        const hci_effort effort = find(EVEN, NULL);
        TEST_ASSERT_DOUBLE_WITHIN(1.0, 1e6 * sign, effort.braking);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, sign, effort.share);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, sign, effort.of_all);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, effort.accelerating);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, effort.slope);
        TEST_ASSERT_EQUAL(sign, hci_effort_way(&effort));
    }
}

/* At a constant speed there is no slope to fit: what is left is a mean and its error. */
static void test_a_constant_speed(void)
{
    make(10.0, 0.0, 3.0, 0.0, 0.3);
    for (size_t k = 0; k < EVEN; ++k)
        speed[k] = 8.0;
    const size_t rows = make_rows(EVEN, 32);
    const solution s = solve_from(rows, 1, 1, 3);
    const hci_effort effort = find(EVEN, NULL);
    is_near(s.value[0] / s.error[0], effort.braking);
    is_near(s.value[0] / rms_of(iq_A, EVEN), effort.of_all);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, effort.slope);
}

/* Six standard errors, a tenth of the rms of the windows and a twentieth of all samples. */
static void test_what_tells_a_sign(void)
{
    static const struct {
        hci_effort effort;
        int way;
    } CASES[] = {
        {{.accelerating = 6.1, .braking = -9.0, .share = -0.5, .of_all = -0.5}, 1},
        {{.accelerating = -6.1, .braking = 9.0, .share = 0.5, .of_all = 0.5}, -1},
        {{.accelerating = 5.9, .braking = -6.1, .share = -0.11, .of_all = -0.06}, -1},
        {{.accelerating = -5.9, .braking = 6.1, .share = 0.11, .of_all = 0.06}, 1},
        {{.accelerating = 5.9, .braking = 5.9, .share = 0.11, .of_all = 0.06}, 0},
        {{.accelerating = 5.9, .braking = 6.1, .share = 0.09, .of_all = 0.06}, 0},
        {{.accelerating = 5.9, .braking = 6.1, .share = 0.11, .of_all = 0.04}, 0},
    };
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k)
        TEST_ASSERT_EQUAL_MESSAGE(CASES[k].way, hci_effort_way(&CASES[k].effort), "a case");
    TEST_ASSERT_TRUE(hci_effort_accelerates(&CASES[1].effort));
    TEST_ASSERT_FALSE(hci_effort_accelerates(&CASES[2].effort));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_one_way);
    RUN_TEST(test_both_ways);
    RUN_TEST(test_shorter_windows);
    RUN_TEST(test_a_steady_shaft);
    RUN_TEST(test_beside_an_arm);
    RUN_TEST(test_few_samples);
    RUN_TEST(test_units_do_not_matter);
    RUN_TEST(test_currents_without_noise);
    RUN_TEST(test_a_constant_speed);
    RUN_TEST(test_what_tells_a_sign);
    return UNITY_END();
}
