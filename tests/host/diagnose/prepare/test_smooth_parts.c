/* The parts of smoothing by themselves: parabolas, lists of periods, series and their slopes, and each bound
 * from both sides. */
#include "host/diagnose/prepare/smooth.c"

#include "support/least_squares.h"
#include "support/recording.h"
#include "unity.h"

enum { P = 4, N = 2000 };

static const double TURN = 2.0 * REF_PI;

static uint64_t seed;
static hci_binned_sample sample[N];

/* So many turns, evenly. */
static void turn(double turns)
{
    memset(sample, 0, sizeof sample);
    for (size_t k = 0; k < N; ++k) {
        sample[k].time_s = 1e-3 * (double)k;
        sample[k].reading.theta_m_rad = TURN * turns * (double)k / (N - 1);
        sample[k].reading.speed_rad_per_s = 10.0;
        rec_phases(-1.0, 3.0, P * sample[k].reading.theta_m_rad, sample[k].reading.i_abc);
    }
}

void setUp(void)
{
    seed = 6;
    turn(10.0);
}

void tearDown(void)
{
}

/* ---- the angle ---- */

static void test_periods_that_samples_resolve(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.48 * 199.9, periods_resolved(sample, N));
    turn(-4.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.48 * 1999.0 / 4.0, periods_resolved(sample, N));
    turn(0.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, periods_resolved(sample, N));
}

static bool turns_at(double least, double most)
{
    sample[7].reading.speed_rad_per_s = least, sample[9].reading.speed_rad_per_s = most;
    return is_turning(sample, 10);
}

static void test_what_turns(void)
{
    TEST_ASSERT_TRUE(turns_at(5.1, 10.0));
    TEST_ASSERT_FALSE(turns_at(4.9, 10.0));
    for (size_t k = 0; k < 10; ++k)
        sample[k].reading.speed_rad_per_s = -10.0;
    TEST_ASSERT_TRUE(turns_at(-5.1, -10.0));
    TEST_ASSERT_FALSE(turns_at(-4.9, -10.0) || turns_at(5.1, -10.0) || turns_at(0.0, -10.0));
}

/* Least squares by a system of three, at uneven times; exact for a parabola. */
static void test_the_value_of_a_parabola(void)
{
    for (size_t k = 0; k < 40; ++k) {
        sample[k].time_s = 2.0 + 1e-3 * ((double)k + ref_uniform(&seed, -0.3, 0.3));
        sample[k].reading.theta_m_rad = 5.0 + 80.0 * sample[k].time_s + 0.1 * ref_normal(&seed);
    }
    for (size_t at = 12; at <= 20; at += 4) {
        double a[3][4] = {{0.0}};
        for (size_t k = 10; k <= 22; ++k) {
            const double t = 1e3 * (sample[k].time_s - sample[at].time_s),
                         row[] = {1.0, t, t * t, sample[k].reading.theta_m_rad};
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 4; ++j)
                    a[i][j] += row[i] * row[j];
        }
        ref_reduce(&a[0][0], 3, 4, 4);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, a[0][3], parabola_at(sample, 10, 22, at));
    }
    for (size_t k = 0; k < 40; ++k)
        sample[k].reading.theta_m_rad =
            3.0 - 7.0 * sample[k].time_s + 200.0 * sample[k].time_s * sample[k].time_s;
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, sample[17].reading.theta_m_rad, parabola_at(sample, 10, 22, 17));
    for (size_t k = 10; k <= 12; ++k)
        sample[k].time_s = k == 12 ? 1.0 : 0.0; /* two times alone tell none */
    TEST_ASSERT_EQUAL_DOUBLE(sample[11].reading.theta_m_rad, parabola_at(sample, 10, 12, 11));
}

/* Those that the angle goes through: once, twice and four times an electrical period, once and twice a turn.
 */
static void test_usual_errors_of_an_angle(void)
{
    double period[ERROR_PERIODS];
    turn(1.01);
    TEST_ASSERT_EQUAL_UINT64(5, error_periods(sample, N, P, true, period));
    const double all[] = {4.0, 8.0, 16.0, 1.0, 2.0};
    for (int k = 0; k < 5; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(all[k], period[k]);
    TEST_ASSERT_EQUAL_UINT64(3, error_periods(sample, N, P, false, period));
    turn(-0.99);
    TEST_ASSERT_EQUAL_UINT64(4, error_periods(sample, N, P, true, period));
    TEST_ASSERT_EQUAL_DOUBLE(2.0, period[3]);
    turn(0.24);
    TEST_ASSERT_EQUAL_UINT64(2, error_periods(sample, N, P, true, period));
    TEST_ASSERT_EQUAL_DOUBLE(8.0, period[0]);
    turn(3.0);
    TEST_ASSERT_EQUAL_UINT64(3, error_periods(sample, N, 1, true, period)); /* 1, 2 and 4 are in it already */
    TEST_ASSERT_EQUAL_UINT64(4, error_periods(sample, N, 2, true, period));
}

/* What smoothing takes that repeats is put back where χ² of the waves is more than 60, but for the ends. */
static void test_errors_are_put_back(void)
{
    static double smooth[N];
    const double period[] = {4.0, 2.0};
    for (int more = 0; more < 2; ++more) {
        turn(10.0);
        for (size_t k = 0; k < N; ++k) {
            const double rest = 0.01 * (k % 2 ? 1.0 : -1.0);
            smooth[k] = sample[k].reading.theta_m_rad;
            sample[k].reading.theta_m_rad += rest;
        }
        const double size =
            sqrt((more ? 66.0 : 54.0) / (N - 66.0) * 2.0) * 0.01; /* N a²/2 over the mean square */
        for (size_t k = 0; k < N; ++k)
            sample[k].reading.theta_m_rad += size * sin(4.0 * smooth[k] + 0.7);
        const double before = smooth[777];
        errors_keep(sample, N, period, 2, smooth);
        TEST_ASSERT_DOUBLE_WITHIN(2e-4, more ? size * sin(4.0 * before + 0.7) : 0.0, smooth[777] - before);
        TEST_ASSERT_EQUAL(more, smooth[3] == sample[3].reading.theta_m_rad);
        TEST_ASSERT_EQUAL(more, smooth[N - 10] == sample[N - 10].reading.theta_m_rad);
        TEST_ASSERT_FALSE(smooth[N - 11] == sample[N - 11].reading.theta_m_rad);
        TEST_ASSERT_FALSE(smooth[10] == sample[10].reading.theta_m_rad);
    }
}

/* ---- the currents ---- */

static bool steady_with(double step_A)
{
    turn(10.0);
    for (size_t k = N / 2; k < N; ++k)
        rec_phases(-1.0 - 0.6 * step_A, 3.0 + 0.8 * step_A, P * sample[k].reading.theta_m_rad,
                   sample[k].reading.i_abc);
    return is_steady(sample, N, P);
}

static void test_a_current_that_is_steady(void)
{
    const double length = sqrt(10.0);
    TEST_ASSERT_TRUE(steady_with(0.049 * length) && steady_with(-0.047 * length));
    TEST_ASSERT_FALSE(steady_with(0.053 * length) || steady_with(-0.053 * length));
}

/* The same list by hand: first what drives ripple at and an encoder makes; others as far as there are
 * samples. */
static size_t periods_by_hand(int p, bool turns, size_t n, double resolved, size_t *out)
{
    const int spare = (int)(n / 40) - 12;
    int others = spare > 0 ? spare : 0;
    size_t count = 0;
    for (int k = 1; k <= 24 * p && k <= resolved && count < 200; ++k) {
        const bool first = (turns && k < 3) || (k % p == 0 && k / p <= 12);
        if (!first && (others == 0 || (k % p != 0 && (!turns || k > 7 * p)))) continue;
        if (!first) --others;
        out[count++] = (size_t)k;
    }
    return count;
}

static void test_lists_of_periods(void)
{
    size_t found[MOST_PERIODS], hand[MOST_PERIODS];
    static const size_t SAMPLES[] = {400, 480, 519, 520, 560, 900, 1400, 4000, 20000};
    for (int p = 1; p <= 50; p += p < 8 ? 1 : 14)
        for (int turns = 0; turns < 2; ++turns)
            for (size_t k = 0; k < sizeof SAMPLES / sizeof *SAMPLES; ++k)
                for (int resolved = 5; resolved <= 1300; resolved *= 6) {
                    const size_t count = periods_list(p, turns, SAMPLES[k], resolved, found);
                    TEST_ASSERT_EQUAL_UINT64(periods_by_hand(p, turns, SAMPLES[k], resolved, hand), count);
                    for (size_t j = 0; j < count; ++j)
                        TEST_ASSERT_EQUAL_UINT64(hand[j], found[j]);
                }
}

/* Of four pole pairs: 12 periods in a turn are an electrical order, in which the turn has no part, and of the
 * turn all others, up to the most that there is room for. */
static void test_waves_of_the_period_and_of_the_turn(void)
{
    static double value[N], theta_m_rad[N];
    static const size_t WAVES[] = {5, 7, 12, 13};
    const double *const axis[] = {value};
    hci_standing_waves q = {.theta_m_rad = theta_m_rad, .value = axis, .n = N, .axes = 1, .apart = 1};
    size_t found[MOST_PERIODS], count = 0;
    for (size_t k = 0; k < N; ++k) {
        theta_m_rad[k] = sample[k].reading.theta_m_rad;
        value[k] = 0.1 * ref_normal(&seed);
        for (int j = 0; j < 4; ++j)
            value[k] += 0.1 * sin((double)WAVES[j] * theta_m_rad[k] + 0.7);
    }
    for (int turns = 0; turns < 2; ++turns) {
        static const size_t FOUND[] = {12, 5, 7, 13};
        TEST_ASSERT_TRUE(waves_find(&q, P, turns, 90.0, found, &count));
        TEST_ASSERT_EQUAL_UINT64(turns ? 4 : 1, count);
        for (size_t j = 0; j < count; ++j)
            TEST_ASSERT_EQUAL_UINT64(FOUND[j], found[j]);
    }
}

static void test_a_series_and_its_slopes(void)
{
    const size_t periods[] = {1, 4, 11};
    const double c[] = {0.5, 0.1, -0.2, 0.3, 0.05, -0.02, 0.04};
    double row[7], slope, curvature;
    for (double theta = -9.0; theta < 9.0; theta += 0.77) {
        double value = c[0], first = 0.0, second = 0.0;
        basis_at(theta, periods, 3, row);
        TEST_ASSERT_EQUAL_DOUBLE(1.0, row[0]);
        for (int j = 0; j < 3; ++j) {
            const double n = (double)periods[j], x = cos(n * theta), y = sin(n * theta);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, x, row[1 + 2 * j]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, y, row[2 + 2 * j]);
            value += c[1 + 2 * j] * x + c[2 + 2 * j] * y;
            first += n * (c[2 + 2 * j] * x - c[1 + 2 * j] * y);
            second -= n * n * (c[1 + 2 * j] * x + c[2 + 2 * j] * y);
        }
        slopes_at(row, c, periods, 3, &slope, &curvature);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, value, series_at(row, c, 7));
        TEST_ASSERT_DOUBLE_WITHIN(1e-11, first, slope);
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, second, curvature);
    }
}

/* Ten times the mean square that noise has at an order, 4 σ²/n. */
static void test_orders_of_noise_leave(void)
{
    const double most = 10.0 * 4.0 * 0.25 / 100.0;
    double c[] = {1e-9, sqrt(0.6 * most), sqrt(0.39 * most), sqrt(0.6 * most), sqrt(0.41 * most)};
    series_workspace r = {.coefficients = c, .normal = {.n = 5}};
    noise_leave(&r, 100, 0.25);
    TEST_ASSERT_TRUE(c[0] == 1e-9 && c[1] == 0.0 && c[2] == 0.0 && c[3] > 0.0 && c[4] > 0.0);
}

/* A segment is smoothed where it is long enough: 960 samples as they are, 240 of a mean over turns. */
static bool smoothed(size_t n, size_t mean_of)
{
    bool series = false;
    const hci_segment segment = {.count = n, .timed = true, .turns = mean_of};
    turn(10.0);
    TEST_ASSERT_TRUE(hci_segment_smooth(sample, &segment, P, true, true, &series));
    return series;
}

static void test_the_least_samples_of_a_series(void)
{
    TEST_ASSERT_TRUE(smoothed(960, 0) && smoothed(240, 5));
    TEST_ASSERT_FALSE(smoothed(959, 0) || smoothed(239, 5));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_periods_that_samples_resolve);
    RUN_TEST(test_what_turns);
    RUN_TEST(test_the_value_of_a_parabola);
    RUN_TEST(test_usual_errors_of_an_angle);
    RUN_TEST(test_errors_are_put_back);
    RUN_TEST(test_a_current_that_is_steady);
    RUN_TEST(test_lists_of_periods);
    RUN_TEST(test_waves_of_the_period_and_of_the_turn);
    RUN_TEST(test_a_series_and_its_slopes);
    RUN_TEST(test_orders_of_noise_leave);
    RUN_TEST(test_the_least_samples_of_a_series);
    return UNITY_END();
}
