/* Windows and slopes of derivative.h against a second implementation: each window by itself, its parabola by
 * orthogonal polynomials. */
#include <math.h>
#include <stdbool.h>

#include "host/numeric/derivative.h"
#include "support/draws.h"
#include "unity.h"

enum { MOST = 3000, LEAST = 5 };

static double t[MOST], x[MOST], slope[MOST], rate[MOST];
static uint64_t seed;

void setUp(void)
{
    seed = 17;
}

void tearDown(void)
{
}

/* Slope at `at` of the parabola through y[first … end − 1], or of the line through two samples. */
static double slope_of(const double *y, size_t first, size_t end, double at)
{
    double mean = 0.0, square = 0.0, cube = 0.0, c1 = 0.0, p2_square = 0.0, c2 = 0.0;
    const double count = (double)(end - first);
    for (size_t k = first; k < end; ++k)
        mean += t[k] / count;
    for (size_t k = first; k < end; ++k) {
        const double u = t[k] - mean;
        square += u * u, cube += u * u * u, c1 += u * y[k];
    }
    for (size_t k = first; k < end; ++k) {
        const double u = t[k] - mean, p2 = u * u - cube / square * u - square / count;
        p2_square += p2 * p2, c2 += p2 * (y[k] - y[first]);
    }
    return c1 / square + (end - first > 2 ? c2 / p2_square * (2.0 * (at - mean) - cube / square) : 0.0);
}

/* ---- the rule of the window ---- */

static double usual_step(size_t n)
{
    double usual = (t[n - 1] - t[0]) / (double)(n - 1);
    for (int pass = 0; pass < 6; ++pass) {
        double sum = 0.0;
        size_t count = 0;
        for (size_t k = 1; k < n; ++k)
            if (t[k] - t[k - 1] <= 20.0 * usual) sum += t[k] - t[k - 1], ++count;
        usual = sum / (double)count;
    }
    return usual;
}

/* x stands still in more than a fifth of the steps: its smallest step, else 0. */
static double quantum_of(const double *y, size_t n)
{
    double least = HUGE_VAL;
    size_t still = 0;
    for (size_t k = 1; k < n; ++k) {
        if (fabs(y[k] - y[k - 1]) > 0.0)
            least = fmin(least, fabs(y[k] - y[k - 1]));
        else
            ++still;
    }
    return 5 * still > n ? least : 0.0;
}

static size_t most_of(size_t n)
{
    return n / 4 > LEAST ? n / 4 : n < LEAST ? n : LEAST;
}

static double rms_way(const double *y, size_t n, size_t window)
{
    double square = 0.0;
    for (size_t k = 0; k + window <= n; ++k)
        square += pow(y[k + window - 1] - y[k], 2.0) / (double)(n - window + 1);
    return sqrt(square);
}

static size_t bridging(const double *y, size_t n)
{
    size_t window = most_of(n) < LEAST ? most_of(n) : LEAST;
    while (window < most_of(n) && rms_way(y, n, window) < 20.0 * quantum_of(y, n))
        window += window / 2;
    return window;
}

/* By what samples are off the cubic through four neighbours, but beside gaps, and by the steps of an encoder.
 */
static double noise_of(const double *y, size_t n)
{
    const double quantum = quantum_of(y, n), step_s = usual_step(n);
    double square = 0.0, count = 0.0;
    for (size_t k = 2; k + 2 < n; ++k) {
        if (t[k + 2] - t[k - 2] > 80.0 * step_s) continue;
        double off = y[k], variance = 1.0;
        for (int i = -2; i <= 2; ++i) {
            double weight = 1.0;
            for (int j = -2; j <= 2; ++j)
                if (i != 0 && j != 0 && j != i)
                    weight *= (t[k] - t[k + (size_t)j]) / (t[k + (size_t)i] - t[k + (size_t)j]);
            off -= i != 0 ? weight * y[k + (size_t)i] : 0.0;
            variance += i != 0 ? weight * weight : 0.0;
        }
        square += off * off / variance;
        count += 1.0;
    }
    const size_t window = bridging(y, n);
    const double lasting = quantum > 0.0 ? (double)window * quantum / rms_way(y, n, window) : 0.0;
    return fmax(count > 0.0 ? sqrt(square / count) : 0.0, quantum * sqrt(lasting / 12.0));
}

/* How near a decision was, as a share: the second implementation rounds otherwise. */
static double nearest;

static bool is_less(double a, double b)
{
    nearest = fmin(nearest, fabs(a - b) / fmax(1e-300, fabs(a) + fabs(b)));
    return a <= b;
}

/* Grows a window by half of it while noise, of the variance `scale`/samples^power, is more than 2 % of the
 * slopes and explains half of how they change. */
static size_t grow(const double *y, size_t n, size_t window, double scale, double power)
{
    for (;;) {
        const size_t next = window + window / 2, distinct = 4 * n / window;
        size_t probes = n < 512 ? n : 512, used = 0;
        double square = 0.0, change = 0.0;
        if (next > most_of(n)) return window;
        probes = distinct < probes ? distinct : probes;
        for (size_t p = 0; p < probes; ++p) {
            const size_t first = p * (n - window) / (probes - 1), centre = first + window / 2;
            const double found = slope_of(y, first, first + window, t[centre]);
            square += found * found / (double)probes;
            if (centre < next / 2 || centre - next / 2 + next > n) continue;
            change += pow(slope_of(y, centre - next / 2, centre - next / 2 + next, t[centre]) - found, 2.0);
            ++used;
        }
        const double variance = scale / pow((double)window, power);
        const double explained = variance * (1.0 - pow((double)window / (double)next, power));
        if (is_less(variance, 0.0004 * (square - variance))) return window;
        if (used > 0 && !is_less(change / (double)used, 2.0 * explained)) return window;
        window = next;
    }
}

static size_t window_of(const double *y, size_t n)
{
    const size_t window = bridging(y, n);
    if (window >= most_of(n)) return most_of(n);
    return grow(y, n, window, 12.0 * pow(noise_of(y, n) / usual_step(n), 2.0), 3.0);
}

static size_t window_of_slope(size_t n)
{
    const double noise = noise_of(x, n) / pow(usual_step(n), 2.0);
    return grow(slope, n, window_of(slope, n), 720.0 * noise * noise, 5.0);
}

/* ---- records ---- */

/* Uneven times with a pause, a wave with noise, and the steps of an encoder or none. */
static size_t make(int which)
{
    static const size_t COUNTS[] = {23, 60, 151, 420, 700, 1100, 2200, 3000};
    const size_t n = COUNTS[which % 8];
    const double step_s = pow(10.0, ref_uniform(&seed, -5.0, 1.0)), periods = ref_uniform(&seed, 0.3, 12.0),
                 noise = pow(10.0, ref_uniform(&seed, -5.0, 0.0)),
                 quantum = which % 3 == 0 ? pow(10.0, ref_uniform(&seed, -3.0, -1.0)) : 0.0,
                 trend = ref_uniform(&seed, -20.0, 20.0), gap = which % 5 == 0 ? 300.0 : 0.0;
    t[0] = 0.3 * step_s;
    for (size_t k = 0; k < n; ++k) {
        const double turn = (double)k / (double)n;
        if (k > 0) t[k] = t[k - 1] + step_s * (ref_uniform(&seed, 0.7, 1.4) + (k == n / 3 ? gap : 0.0));
        x[k] = trend * turn + sin(2.0 * REF_PI * periods * turn) + 40.0;
        x[k] = quantum > 0.0 ? quantum * floor(x[k] / quantum) : x[k] + noise * ref_normal(&seed);
    }
    return n;
}

enum { RECORDS = 80 };

static void test_windows_grow_by_the_rule(void)
{
    size_t least = MOST, most = 0;
    for (int which = 0; which < RECORDS; ++which) {
        const size_t n = make(which);
        nearest = HUGE_VAL;
        const size_t expected = window_of(x, n), found = hci_derivative_window(t, x, n);
        if (nearest < 1e-6) continue;
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(expected, found, "a record");
        least = found < least ? found : least;
        most = found > most ? found : most;
    }
    TEST_ASSERT_TRUE(least == LEAST && most > 300);
}

static void test_windows_of_a_slope_grow_by_the_rule(void)
{
    size_t most = 0;
    for (int which = 0; which < RECORDS; ++which) {
        const size_t n = make(which);
        hci_derivative(t, x, n, slope);
        nearest = HUGE_VAL;
        const size_t expected = window_of_slope(n), found = hci_derivative_window_of_slope(t, x, slope, n);
        if (nearest < 1e-6) continue;
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(expected, found, "a record");
        most = found > most ? found : most;
    }
    TEST_ASSERT_TRUE(most > 100);
}

/* ---- slopes ---- */

/* Slopes of the samples from … end − 1 by windows between low and high. */
static void check_slopes_within(double share, size_t from, size_t end, size_t low, size_t high, size_t window)
{
    if (window > high - low) window = high - low;
    for (size_t k = from; k < end; ++k) {
        size_t first = k < low + window / 2 ? low : k - window / 2;
        if (first + window > high) first = high - window;
        const double expected = slope_of(x, first, first + window, t[k]);
        TEST_ASSERT_DOUBLE_WITHIN(share * (1.0 + fabs(expected)), expected, rate[k]);
    }
}

static void check_slopes(size_t from, size_t end, size_t low, size_t high, size_t window)
{
    check_slopes_within(1e-7, from, end, low, high, window);
}

/* Two long pieces and one of four samples, whose windows reach over both gaps; a piece of five does not. */
static void test_slopes_between_gaps(void)
{
    for (size_t few = 4; few <= 5; ++few)
        for (size_t window = 5; window <= 24; window += 3) {
            const size_t n = 90 + few, cut = 50;
            for (size_t k = 0; k < n; ++k) {
                t[k] = (k > 0 ? t[k - 1] : 2.0) + ref_uniform(&seed, 0.7, 1.3);
                if (k == cut || k == cut + few) t[k] += 60.0;
                x[k] = 3.0 * sin(0.2 * t[k]) + 0.1 * ref_normal(&seed);
            }
            hci_derivative_over(t, x, n, window, rate);
            check_slopes(0, cut, 0, cut, window);
            check_slopes(cut, cut + few, few < 5 ? 0 : cut, few < 5 ? n : cut + few, window);
            check_slopes(cut + few, n, cut + few, n, window);
        }
}

/* A gap is twenty mean steps, of which it is one while it is no gap: s > 20·(118 + s)/119 is 23.8; and longer
 * than a window of 30, 39.8. */
static void test_what_a_gap_is(void)
{
    static const struct {
        size_t window;
        double steps;
        bool is_gap;
    } CASES[] = {{7, 22.5, false}, {7, 25.0, true}, {30, 25.0, false}, {30, 38.0, false}, {30, 42.0, true}};
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; ++c) {
        const size_t n = 120, cut = 55;
        for (size_t k = 0; k < n; ++k) {
            t[k] = (k > 0 ? t[k - 1] : -4.0) + 0.01 * (k == cut ? CASES[c].steps : k % 2 ? 1.02 : 0.98);
            x[k] = ref_uniform(&seed, -1.0, 1.0);
        }
        hci_derivative_over(t, x, n, CASES[c].window, rate);
        check_slopes(0, cut, 0, CASES[c].is_gap ? cut : n, CASES[c].window);
        check_slopes(cut, n, CASES[c].is_gap ? cut : 0, n, CASES[c].window);
    }
}

/* Sums that are carried on from window to window are made anew before they are worn. */
static void test_slopes_far_from_the_origin(void)
{
    for (size_t k = 0; k < MOST; ++k) {
        t[k] = 1e5 + 1e-2 * (double)k + 2e-3 * sin((double)k);
        x[k] = 1e4 * sin(0.01 * (double)k);
    }
    hci_derivative_over(t, x, MOST, 40, rate);
    check_slopes_within(1e-5, 0, MOST, 0, MOST,
                        40); /* times of 1e5 are rounded to 1e-11, of windows of 0.4 */
}

/* Two, three and four samples: one window for all. */
static void test_few_samples(void)
{
    for (size_t n = 2; n <= 4; ++n) {
        for (size_t k = 0; k < n; ++k) {
            t[k] = 0.1 * (double)(k * k) + 0.3 * (double)k;
            x[k] = ref_uniform(&seed, -1.0, 1.0);
        }
        TEST_ASSERT_EQUAL_UINT64(n, hci_derivative_window(t, x, n));
        hci_derivative(t, x, n, rate);
        check_slopes(0, n, 0, n, n);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_windows_grow_by_the_rule);
    RUN_TEST(test_windows_of_a_slope_grow_by_the_rule);
    RUN_TEST(test_slopes_between_gaps);
    RUN_TEST(test_what_a_gap_is);
    RUN_TEST(test_slopes_far_from_the_origin);
    RUN_TEST(test_few_samples);
    return UNITY_END();
}
