/* Numbers of clock.h: where each rule begins and ends, and the stamps that come out of it. */
#include <math.h>
#include <string.h>

#include "host/recording/clock.h"
#include "support/draws.h"
#include "support/texts.h"
#include "unity.h"

enum { N = 4000 };

static double t[N], was[N], work[N], angle[N];
static size_t rows[N];
static hci_note remark;
static uint64_t seed;

void setUp(void)
{
    seed = 21;
    memset(&remark, 0, sizeof remark);
}

void tearDown(void)
{
}

static hci_stamps first(size_t n)
{
    return (hci_stamps){t, NULL, n};
}

/* Stamps k·step_s that are a little uneven, so that no rounded clock makes them. */
static void make_uneven(size_t n, double step_s)
{
    for (size_t k = 0; k < n; ++k)
        was[k] = t[k] = step_s * ((double)k + 0.2 * sin(1.3 * (double)k * (double)k));
}

static bool mends(size_t n)
{
    memset(&remark, 0, sizeof remark);
    return hci_clock_mend(first(n), &remark);
}

/* ---- the usual step ---- */

/* 2, 3 … 3 and 4 ms with two stamps twice and a step back, behind a pause: twenty times the mean of those
 * that go on. */
static void test_a_gap_is_twenty_mean_steps(void)
{
    double sum = 0.0, steps = 0.0;
    t[0] = 5.0;
    for (size_t k = 1; k < 60; ++k) {
        double step = k == 1 ? 0.002 : k == 59 ? 0.004 : 0.003;
        if (k == 20 || k == 41) step = 0.0;
        if (k == 30) step = 9.0;
        if (k == 50) step = -4.0;
        t[k] = t[k - 1] + step;
        if (step > 0.0 && step < 1.0) sum += step, steps += 1.0;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 20.0 * sum / steps, hci_clock_gap_s(t, 60));
}

/* ---- early and late by turns ---- */

/* Steps of 1 and what is given, again and again. */
static bool is_rough(size_t n, const double *off, size_t period)
{
    t[0] = 3.0;
    for (size_t k = 1; k < n; ++k)
        t[k] = t[k - 1] + 1.0 + off[(k - 1) % period];
    return hci_clock_is_rough(first(n));
}

/* A tenth of the step, on average over all samples. */
static void test_how_rough_is_rough(void)
{
    const double by_0p15[] = {0.0, 0.17, -0.17}, by_0p13[] = {0.0, 0.13, -0.13};
    TEST_ASSERT_TRUE(is_rough(301, by_0p15, 3));
    TEST_ASSERT_FALSE(is_rough(301, by_0p13, 3));
    TEST_ASSERT_TRUE(is_rough(16, by_0p15, 3));
    TEST_ASSERT_FALSE(is_rough(15, by_0p15, 3));
}

/* One up, one down of two pairs is no more than half. */
static void test_noise_does_not_come_by_turns(void)
{
    const double half[] = {0.0, 0.3, 0.3, -0.6}, more[] = {0.0, 0.3, -0.6, 0.3};
    TEST_ASSERT_FALSE(is_rough(301, half, 4));
    TEST_ASSERT_TRUE(is_rough(301, more, 4));
}

/* A clock of 1.5, or of 1.4, whose stamps are whole numbers, for an even and for an odd number of samples:
 * its usual step is none of its steps. */
static void test_whole_milliseconds_come_by_turns(void)
{
    const double of_1p5[] = {0.0, 1.0}, of_1p4[] = {0.0, 1.0, 0.0, 1.0, 0.0};
    for (size_t n = 100; n < 104; ++n) {
        TEST_ASSERT_TRUE(is_rough(n, of_1p5, 2));
        for (size_t k = 0; k < n; ++k)
            t[k] *= 1e-3;
        TEST_ASSERT_TRUE(hci_clock_is_rough(first(n)));
        TEST_ASSERT_TRUE(is_rough(n, of_1p4, 5));
    }
}

/* A pause counts as one step: 100 samples off by 0.05 and it are 5.9 steps, by 0.1 they are 10.9, of 10.1. */
static void test_a_pause_makes_nothing_rough(void)
{
    for (int more = 0; more < 2; ++more) {
        t[0] = 0.0;
        for (size_t k = 1; k < 101; ++k)
            t[k] = t[k - 1] + (k == 50      ? 70.0
                               : k % 3 == 0 ? 1.0
                                            : 1.0 + (k % 3 == 1 ? 1.5 : -1.5) * (more ? 0.1 : 0.05));
        TEST_ASSERT_EQUAL(more, hci_clock_is_rough(first(101)));
    }
}

/* ---- steps back ---- */

/* Each period that a clock has, in steps of a thousandth of it. */
static void test_every_period_goes_on(void)
{
    static const double PERIODS[] = {60.0,        3600.0,      43200.0,     86400.0,     0.065536,   65.536,
                                     2147.483648, 4294.967296, 4294967.296, 4.294967296, 2147483.648};
    for (size_t p = 0; p < sizeof PERIODS / sizeof *PERIODS; ++p) {
        char text[80];
        make_uneven(2500, 1e-3 * PERIODS[p]);
        for (size_t k = 0; k < 2500; ++k)
            t[k] = fmod(was[k], PERIODS[p]);
        TEST_ASSERT_TRUE(mends(2500));
        for (size_t k = 0; k < 2500; ++k)
            TEST_ASSERT_DOUBLE_WITHIN(1e-9 * PERIODS[p], was[k], t[k]);
        snprintf(text, sizeof text, "the time begins again after %.10g s (2 times): it goes on", PERIODS[p]);
        text_has(text, remark.text);
        text_lacks("piece", remark.text);
    }
}

/* A step back of an hour, by which the time then goes on by up to twenty steps; by more it is a piece. */
static void test_a_period_with_a_pause(void)
{
    for (int far = 0; far < 2; ++far) {
        make_uneven(100, 1.0);
        for (size_t k = 50; k < 100; ++k)
            t[k] = was[k] + (far ? 22.0 : 17.0) - 3600.0;
        TEST_ASSERT_TRUE(mends(100));
        text_has(far ? "steps back 1 time: what follows is a piece of its own" : "(1 time): it goes on",
                 remark.text);
        TEST_ASSERT_DOUBLE_WITHIN(1.0, far ? 100.0 : 18.0, t[50] - t[49]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, was[99] - was[50], t[99] - t[50]);
    }
}

/* A gap as long as the record: the mean step times the samples. */
static void test_a_piece_begins_behind_a_gap(void)
{
    make_uneven(200, 1.0);
    for (size_t k = 80; k < 200; ++k)
        t[k] = was[k] - (k < 150 ? 30.0 : 70.0);
    double sum = 0.0;
    for (size_t k = 1; k < 200; ++k)
        if (k != 80 && k != 150) sum += was[k] - was[k - 1];
    TEST_ASSERT_TRUE(mends(200));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 200.0 * sum / 197.0, t[80] - t[79]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 200.0 * sum / 197.0, t[150] - t[149]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, was[149] - was[80], t[149] - t[80]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, was[199] - was[150], t[199] - t[150]);
    text_has("the time steps back 2 times: what follows", remark.text);
}

/* One step back for twenty samples is allowed, one more is too many. */
static void test_how_often_a_time_may_step_back(void)
{
    for (int more = 0; more < 2; ++more) {
        make_uneven(100, 1.0);
        for (size_t k = 0; k < 100; ++k)
            t[k] = was[k] - 30.0 * floor((double)k / (more ? 16.0 : 18.0));
        TEST_ASSERT_EQUAL(!more, mends(100));
        if (more) text_has("the time does not go on: it is not used", remark.text);
    }
}

/* Three usual steps back and more are a piece; less is a stamp that came early, and is spread. */
static void test_a_stamp_that_is_early(void)
{
    for (int far = 0; far < 2; ++far) {
        make_uneven(100, 1e-4);
        t[41] = t[40] - (far ? 3.2e-4 : 2.8e-4);
        TEST_ASSERT_TRUE(mends(100));
        if (far) {
            text_has("a piece of its own", remark.text);
            continue;
        }
        text_has("1 stamp is not later than the one before: its sample is spread evenly", remark.text);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, 0.5 * (was[40] + was[42]), t[41]);
        t[41] = was[41];
        TEST_ASSERT_EQUAL_MEMORY(was, t, 100 * sizeof *t);
    }
}

/* ---- stamps that repeat ---- */

/* Two and three of one stamp, evenly to the next; behind a pause as dense as before it, and at the end. */
static void test_repeated_stamps_are_spread(void)
{
    const double stamps[] = {0.0, 1.1, 1.1, 2.0, 2.0, 2.0, 90.0, 91.3, 92.0, 93.0, 93.0};
    const double spread[] = {0.0, 1.1, 1.55, 2.0, 2.45, 2.9, 90.0, 91.3, 92.0, 93.0, 94.0};
    make_uneven(90, 1.0);
    for (size_t k = 0; k < 11; ++k)
        t[90 + k] = 100.0 + stamps[k];
    TEST_ASSERT_TRUE(mends(101));
    TEST_ASSERT_EQUAL_MEMORY(was, t, 90 * sizeof *t);
    for (size_t k = 0; k < 11; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.0 + spread[k], t[90 + k]);
    text_has("4 stamps are not later than the one before: their samples are spread evenly", remark.text);
}

/* The line through stamps over their rows, of k = from … end − 1. */
static double on_line(size_t from, size_t end, size_t k)
{
    double row = 0.0, time = 0.0, square = 0.0, product = 0.0;
    for (size_t j = from; j < end; ++j)
        row += (double)rows[j] / (double)(end - from), time += was[j] / (double)(end - from);
    for (size_t j = from; j < end; ++j) {
        square += pow((double)rows[j] - row, 2.0);
        product += ((double)rows[j] - row) * (was[j] - time);
    }
    return time + product / square * ((double)rows[k] - row);
}

/* Two pieces of a clock in whole milliseconds, of which rows are missing; each becomes its line. */
static void test_pieces_of_a_rounded_clock(void)
{
    const size_t n = 500, cut = 150;
    for (size_t k = 0; k < n; ++k) {
        rows[k] = 7 + k + k / 9;
        t[k] = was[k] =
            40.0 + 1e-3 * floor((k < cut ? 0.37 : 0.29) * (double)rows[k] + (k < cut ? 0.0 : 9000.0));
    }
    TEST_ASSERT_TRUE(hci_clock_mend((hci_stamps){t, rows, n}, &remark));
    for (size_t k = 0; k < n; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, k < cut ? on_line(0, cut, k) : on_line(cut, n, k), t[k]);
    text_has("the time is a uniform clock of 0.00029 s rounded to 0.001 s", remark.text);
}

/* A piece needs eight samples. */
static void test_a_short_piece_is_no_uniform_clock(void)
{
    for (size_t last = 7; last <= 8; ++last) {
        const size_t n = 400 + last;
        for (size_t k = 0; k < n; ++k)
            t[k] = 1e-3 * floor(0.37 * (double)k + (k < 400 ? 0.0 : 9000.0));
        TEST_ASSERT_TRUE(mends(n));
        text_has(last < 8 ? "spread evenly" : "a uniform clock", remark.text);
    }
}

/* ---- beside the angle ---- */

/* A shaft at a steady speed, which is by_row off to and fro from row to row, and whose stamps are by_time:
 * in rad. One row of ten is off by neither, so that the angle has no step of its own. */
static hci_clock_kind judge(size_t n, int pole_pairs, double by_row, double by_time)
{
    const double speed = 0.3;
    for (size_t k = 0; k < n; ++k) {
        const double way = (k % 40) >= 36 ? 0.0 : k % 2 ? 1.0 : -1.0;
        t[k] = (double)k - way * by_time / speed;
        angle[k] = speed * (double)k + 1e-6 * (double)k * (double)k + way * by_row;
    }
    return hci_clock_judge(first(n), angle, pole_pairs, work);
}

/* x_k less a cubic through its neighbours is 8/3 of what goes to and fro, which noise of 1 makes √(35/18): of
 * the median that is as much as a deviation of 1/2.835. */
#define SEEN (8.0 / 3.0 / 1.3944333775567928 / 0.6745)

/* 0.01 rad of the electrical angle. */
static void test_how_far_stamps_may_jitter(void)
{
    TEST_ASSERT_EQUAL(HCI_CLOCK_AGREES, judge(N, 4, 0.0, 0.95 * 0.0025 / SEEN));
    TEST_ASSERT_EQUAL(HCI_CLOCK_JITTERS, judge(N, 4, 0.0, 1.05 * 0.0025 / SEEN));
    TEST_ASSERT_EQUAL(HCI_CLOCK_AGREES, judge(N, 2, 0.0, 1.05 * 0.0025 / SEEN));
    TEST_ASSERT_EQUAL(HCI_CLOCK_JITTERS, judge(16, 4, 0.0, 1.3 * 0.0025 / SEEN));
    TEST_ASSERT_EQUAL(HCI_CLOCK_AGREES, judge(15, 4, 0.0, 1.3 * 0.0025 / SEEN));
}

/* Three times what it is over the rows. */
static void test_an_angle_that_is_rough_over_rows_as_well(void)
{
    TEST_ASSERT_EQUAL(HCI_CLOCK_AGREES, judge(N, 4, 0.002, 0.0036));
    TEST_ASSERT_EQUAL(HCI_CLOCK_JITTERS, judge(N, 4, 0.002, 0.0044));
}

/* 0.02 rad of the mechanical angle, whatever the pole pairs. */
static void test_how_far_an_angle_is_of_another_instant(void)
{
    TEST_ASSERT_EQUAL(HCI_CLOCK_AGREES, judge(N, 4, 0.95 * 0.02 / SEEN, 0.0));
    TEST_ASSERT_EQUAL(HCI_CLOCK_FOREIGN, judge(N, 4, 1.05 * 0.02 / SEEN, 0.0));
}

/* ---- smoothed ---- */

/* Each stamp is the mean of as many neighbours on both sides, at most 20, less what the rows between them
 * take; the slope is that of the ends. */
static void test_stamps_are_means_of_their_neighbours(void)
{
    const size_t n = 120;
    for (size_t k = 0; k < n; ++k) {
        rows[k] = 3 + k + (k > 50 ? 4 : 0) + k / 7;
        t[k] = was[k] = 1e-3 * ((double)rows[k] + 0.4 * ref_uniform(&seed, -1.0, 1.0)) + 9.0;
    }
    hci_clock_smooth((hci_stamps){t, rows, n}, work, &remark);
    text_has("smooth over the rows and not over the time: the time is smoothed", remark.text);
    for (size_t k = 0; k < n; ++k) {
        size_t half = 0;
        while (half < 20 && half < k && k + half + 1 < n)
            ++half;
        const double slope =
            half > 0 ? (was[k + half] - was[k - half]) / (double)(rows[k + half] - rows[k - half]) : 0.0;
        double mean = 0.0;
        for (size_t j = k - half; j <= k + half; ++j)
            mean += (was[j] - slope * ((double)rows[j] - (double)rows[k])) / (double)(2 * half + 1);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, mean, t[k]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_gap_is_twenty_mean_steps);
    RUN_TEST(test_how_rough_is_rough);
    RUN_TEST(test_noise_does_not_come_by_turns);
    RUN_TEST(test_whole_milliseconds_come_by_turns);
    RUN_TEST(test_a_pause_makes_nothing_rough);
    RUN_TEST(test_every_period_goes_on);
    RUN_TEST(test_a_period_with_a_pause);
    RUN_TEST(test_a_piece_begins_behind_a_gap);
    RUN_TEST(test_how_often_a_time_may_step_back);
    RUN_TEST(test_a_stamp_that_is_early);
    RUN_TEST(test_repeated_stamps_are_spread);
    RUN_TEST(test_pieces_of_a_rounded_clock);
    RUN_TEST(test_a_short_piece_is_no_uniform_clock);
    RUN_TEST(test_how_far_stamps_may_jitter);
    RUN_TEST(test_an_angle_that_is_rough_over_rows_as_well);
    RUN_TEST(test_how_far_an_angle_is_of_another_instant);
    RUN_TEST(test_stamps_are_means_of_their_neighbours);
    return UNITY_END();
}
