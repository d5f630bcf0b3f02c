/* Lines of the torque of a turn: sums of sines at whole orders, and which of them are taken. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/check/data/run_samples.h"
#include "unity.h"

enum { MOST = 6000 };

static const double TURN = 6.28318530717958647693;

static double theta[MOST], torque[MOST];
static check_run run;

void setUp(void)
{
    memset(&run, 0, sizeof run);
    memset(torque, 0, sizeof torque);
    run.theta = theta;
    run.torque = torque;
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
}

/* Samples in the middle of each of as many bins, backwards from `from` turns on; so many turns. */
static void turn(size_t count, double turns, double from)
{
    run.count = count;
    for (size_t k = 0; k < count; ++k)
        theta[k] = TURN * (from - turns * ((double)k + 0.5) / (double)count);
}

/* a sin(order·θ + 0.4), with a mean besides. */
static void add(double order, double a)
{
    run.torque_mean += 0.3;
    for (size_t k = 0; k < run.count; ++k)
        torque[k] += a * sin(order * theta[k] + 0.4) + 0.3;
}

static void lines_are(int count, const int *line)
{
    TEST_ASSERT_TRUE(hci_check_run_orders(&run));
    TEST_ASSERT_EQUAL(count, run.lines);
    for (int k = 0; k < count; ++k)
        TEST_ASSERT_EQUAL(line[k], run.line[k]);
}

/* At least 8 % of the largest, from the third order on. */
static void test_lines(void)
{
    turn(600, 1.0, 0.25);
    add(24.0, 2.0);
    add(36.0, 0.17);
    add(48.0, 0.15);
    add(7.0, 0.5);
    add(3.0, 0.2);
    add(2.0, 5.0);
    add(149.0, 0.3);
    lines_are(5, (const int[]){3, 7, 24, 36, 149});
    lines_are(5, (const int[]){3, 7, 24, 36, 149}); /* anew */
}

/* Noise that is the same at all orders: a line is six times the median. An impulse has the amplitude 2/600 at
 * each. */
static void test_lines_in_noise(void)
{
    for (int more = 0; more < 2; ++more) {
        setUp();
        turn(600, 1.0, 0.0);
        torque[0] = torque[599] = 0.5; /* at one place, an even one */
        add(30.0, (more ? 6.2 : 5.0) * 2.0 / 600.0);
        for (size_t k = 0; k < 600; ++k)
            torque[k] -= 1.0 / 600.0;
        lines_are(more, (const int[]){30});
    }
}

/* Orders from a quarter of the bins to half of them with more than 0.3 of the largest: there may be higher
 * ones that look like all of these. */
static void test_orders_that_may_be_higher_ones(void)
{
    for (int more = 0; more < 2; ++more) {
        setUp();
        turn(600, 1.0, 0.0);
        add(20.0, 1.0);
        add(more ? 150.0 : 299.0, more ? 0.31 : 0.29);
        lines_are(more ? 0 : 1, (const int[]){20});
    }
    setUp();
    turn(600, 1.0, 0.0);
    add(20.0, 1.0);
    add(299.0, 0.31);
    lines_are(0, NULL);
}

/* More than four samples in ten bins, of at least 400; the bins between have the value before them. */
static void test_a_turn_with_gaps(void)
{
    for (int more = 0; more < 2; ++more) {
        setUp();
        turn(1000, more ? 0.42 : 0.38, 0.0);
        add(5.0, 1.0);
        TEST_ASSERT_TRUE(hci_check_run_orders(&run));
        TEST_ASSERT_EQUAL(more, run.lines > 0);
    }
    setUp();
    turn(399, 1.0, 0.0);
    add(5.0, 1.0);
    lines_are(0, NULL);
    setUp();
    turn(400, 1.0, 0.0);
    add(5.0, 1.0);
    add(99.0, 0.2);
    add(100.0, 0.2);
    lines_are(2, (const int[]){5, 99});
}

/* Every third sample of an angle that stands: the means are held over empty bins, the first ones over the
 * end. */
static void test_means_are_held(void)
{
    turn(900, 1.0, 0.0);
    for (size_t k = 0; k < 900; ++k)
        theta[k] = -TURN * ((double)(k / 2 * 2) + 1.5) / 900.0; /* two in a bin, and an empty one */
    add(9.0, 1.0);
    lines_are(1, (const int[]){9});
}

/* Three turns of 2000 samples at the same places: orders below a quarter of these, and the first 16 lines. */
static void test_several_turns(void)
{
    turn(6000, 3.0, 2.7);
    add(12.0, 1.0);
    add(499.0, 0.1);
    add(500.0, 0.1);
    lines_are(2, (const int[]){12, 499});
    setUp();
    turn(6000, 3.0, 2.7);
    for (int n = 10; n < 30; ++n)
        add(n, 1.0);
    TEST_ASSERT_TRUE(hci_check_run_orders(&run));
    TEST_ASSERT_EQUAL(CHECK_MOST_LINES, run.lines);
    for (int k = 0; k < CHECK_MOST_LINES; ++k)
        TEST_ASSERT_EQUAL(10 + k, run.line[k]);
}

/* Mean torque of each bin of a turn, that of the bin before where it is empty. Returns how many are not. */
static int bins_by_hand(int bins, double *mean)
{
    static int hits[MOST];
    int filled = 0;
    memset(hits, 0, sizeof hits);
    memset(mean, 0, (size_t)bins * sizeof *mean);
    for (size_t k = 0; k < run.count; ++k) {
        const double share = theta[k] / TURN - floor(theta[k] / TURN);
        const int bin = (int)(share * bins) % bins;
        mean[bin] += torque[k];
        ++hits[bin];
    }
    for (int k = 0; k < bins; ++k)
        filled += hits[k] > 0;
    for (int k = 0; k < bins; ++k) {
        if (hits[k] > 0)
            mean[k] /= hits[k];
        else
            mean[k] = NAN; /* until all means are known */
    }
    for (int k = 0; k < 2 * bins; ++k)
        if (isnan(mean[k % bins])) mean[k % bins] = mean[(k + bins - 1) % bins];
    return filled;
}

static double by_hand(const double *mean, int bins, int order)
{
    double re = 0.0, im = 0.0;
    for (int k = 0; k < bins; ++k) {
        re += mean[k] * cos(TURN * order * k / bins);
        im += mean[k] * sin(TURN * order * k / bins);
    }
    return sqrt(re * re + im * im);
}

static double chance(void)
{
    static unsigned long x = 7;
    x = x * 16807 % 2147483647;
    return (double)x / 2147483647.0;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* The same lines as by the rule written out here, of turns in which four bins in ten to nearly all have
 * samples, some of them two; the mean of all is not 0. */
static void test_lines_of_any_turn(void)
{
    static double mean[MOST], size[MOST], sorted[MOST];
    int all = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const int bins = 400 + 3 * trial;
        setUp();
        run.count = (size_t)bins;
        for (int k = 0; k < bins; ++k)
            theta[k] =
                -TURN * (floor((0.07 * trial + chance() * (0.45 + 0.009 * trial)) * bins) + 0.5) / bins;
        for (int n = 3; n < 60; n += 1 + trial % 5)
            add(n, exp(-4.0 * chance()));
        const int filled = bins_by_hand(bins, mean), trusted = filled / 4;
        double beyond = 0.0;
        for (int n = 3; n < 2 * trusted; ++n)
            size[n] = by_hand(mean, bins, n);
        for (int n = trusted; n < 2 * trusted; ++n)
            beyond = fmax(beyond, size[n]);
        size[0] = size[1] = size[2] = 0.0;
        memcpy(sorted, size, sizeof sorted);
        qsort(sorted, (size_t)trusted, sizeof *sorted, compare);
        const double largest = sorted[trusted - 1], least = fmax(0.08 * largest, 6.0 * sorted[trusted / 2]);
        TEST_ASSERT_TRUE(hci_check_run_orders(&run));
        int count = 0;
        for (int n = 3;
             n < trusted && count < CHECK_MOST_LINES && filled > 0.4 * bins && beyond <= 0.3 * largest; ++n)
            if (size[n] > least) TEST_ASSERT_EQUAL(n, run.line[count++]);
        TEST_ASSERT_EQUAL(count, run.lines);
        all += count;
    }
    TEST_ASSERT_TRUE(all > 60);
}

static void test_what_has_no_turn(void)
{
    turn(600, 1.0, 0.0);
    add(5.0, 1.0);
    run.is_electrical = true;
    lines_are(0, NULL);
    run.is_electrical = false;
    run.theta = NULL;
    lines_are(0, NULL);
    run.theta = theta;
    run.torque = NULL;
    lines_are(0, NULL);
    run.torque = torque;
    for (long k = 0; k < 3; ++k) {
        hci_memory_fail_after(k);
        TEST_ASSERT_FALSE(hci_check_run_orders(&run));
        TEST_ASSERT_EQUAL(0, run.lines);
    }
    hci_memory_fail_after(-1);
    lines_are(1, (const int[]){5});
    memset(torque, 0, sizeof torque);
    run.torque_mean = 0.0;
    lines_are(0, NULL);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_lines);
    RUN_TEST(test_lines_in_noise);
    RUN_TEST(test_orders_that_may_be_higher_ones);
    RUN_TEST(test_a_turn_with_gaps);
    RUN_TEST(test_means_are_held);
    RUN_TEST(test_several_turns);
    RUN_TEST(test_lines_of_any_turn);
    RUN_TEST(test_what_has_no_turn);
    return UNITY_END();
}
