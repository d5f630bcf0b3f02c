/* Clocks of recordings: rounded, repeated, beginning again, or taken at other instants than the angle. */
#include "host/recording/clock.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/recording/run.h"
#include "support/draws.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

enum { N = 4000 };

static double t[N], truth[N], angle[N], work[N];
static size_t rows[N];
static hci_note remark;
static uint64_t seed;

void setUp(void)
{
    seed = 11;
    memset(&remark, 0, sizeof remark);
    files_begin();
}

void tearDown(void)
{
    files_end();
}

static hci_stamps all(void)
{
    return (hci_stamps){t, NULL, N};
}

static void make_uniform(double from, double step_s)
{
    for (size_t k = 0; k < N; ++k)
        t[k] = truth[k] = from + step_s * (double)k;
}

static void round_to(double quantum)
{
    for (size_t k = 0; k < N; ++k)
        t[k] = quantum * floor(t[k] / quantum + 1e-9);
}

/* Up to a constant, which nobody knows of a rounded clock. */
static void is_truth(double within)
{
    const double ahead = t[N / 2] - truth[N / 2];
    for (size_t k = 0; k < N; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(within, truth[k] + ahead, t[k]);
}

/* ---- rounded ---- */

/* 20 kHz and 700 Hz with stamps of whole milliseconds; the second has no stamp twice. */
static void test_a_rounded_clock_becomes_the_uniform_one(void)
{
    make_uniform(3600.0, 5e-5);
    round_to(1e-3);
    TEST_ASSERT_TRUE(hci_clock_mend(all(), &remark));
    is_truth(2e-5); /* a line through steps of 1 ms */
    text_has("a uniform clock of 5e-05 s rounded to 0.001 s: the uniform one is taken", remark.text);
    make_uniform(0.0, 5.3e-3);
    round_to(1e-3);
    memset(&remark, 0, sizeof remark);
    hci_clock_smooth(all(), work, &remark);
    is_truth(2e-5);
    text_has("a uniform clock of 0.0053 s rounded to 0.001 s", remark.text);
}

/* Rows that were left out do not bend the clock. */
static void test_a_rounded_clock_with_rows_left_out(void)
{
    size_t n = 0;
    for (size_t k = 0; k < N && n < 1000; ++k) {
        if (k % 7 == 3 || (k > 500 && k < 520)) continue;
        rows[n] = k;
        t[n++] = 1e-3 * floor(0.05 * (double)k + 1e-9);
    }
    TEST_ASSERT_TRUE(hci_clock_mend((hci_stamps){t, rows, n}, &remark));
    for (size_t k = 1; k < n; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-7, 5e-5 * (double)(rows[k] - rows[k - 1]), t[k] - t[k - 1]);
}

/* Packets of 5 to 15 samples with one stamp each: evenly in between. */
static void test_uneven_repeated_stamps_are_spread(void)
{
    double at = 0.0;
    for (size_t k = 0, left = 0; k < N; ++k, --left) {
        if (left == 0) {
            left = 5 + (size_t)(10.0 * ref_uniform(&seed, 0.0, 1.0));
            at += 0.01;
        }
        t[k] = at;
    }
    TEST_ASSERT_TRUE(hci_clock_mend(all(), &remark));
    text_has("their samples are spread evenly", remark.text);
    for (size_t k = 1; k < N; ++k)
        TEST_ASSERT_TRUE(t[k] - t[k - 1] > 0.01 / 16.0 && t[k] - t[k - 1] < 0.01 / 4.0);
}

static void test_a_clock_that_ascends_is_left_alone(void)
{
    for (size_t k = 0; k < N; ++k)
        t[k] = truth[k] = (double)k + 0.4 * sin(1.7 * (double)k);
    TEST_ASSERT_TRUE(hci_clock_mend(all(), &remark));
    is_truth(0.0);
    TEST_ASSERT_EQUAL_STRING("", remark.text);
}

/* ---- steps back ---- */

static void test_a_clock_that_begins_again_goes_on(void)
{
    static const struct {
        double from, period;
    } CASES[] = {{86399.0, 86400.0}, {4294.0, 4294.967296}, {59.0, 60.0}};
    for (size_t c = 0; c < 3; ++c) {
        memset(&remark, 0, sizeof remark);
        make_uniform(CASES[c].from, 1e-3);
        for (size_t k = 0; k < N; ++k)
            t[k] = fmod(t[k], CASES[c].period);
        TEST_ASSERT_TRUE(hci_clock_mend(all(), &remark));
        is_truth(1e-8);
        text_has("(1 time): it goes on", remark.text);
    }
}

/* In whole milliseconds, over midnight. */
static void test_a_rounded_clock_over_midnight(void)
{
    make_uniform(86399.0, 5e-4);
    round_to(1e-3);
    for (size_t k = 0; k < N; ++k)
        t[k] = fmod(t[k], 86400.0);
    TEST_ASSERT_TRUE(hci_clock_mend(all(), &remark));
    is_truth(1e-6);
}

static void test_another_step_back_begins_a_piece(void)
{
    make_uniform(0.0, 1e-3);
    for (size_t k = 1000; k < N; ++k)
        t[k] = 0.25 + 1e-3 * (double)(k - 1000);
    TEST_ASSERT_TRUE(hci_clock_mend(all(), &remark));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1e-3, t[999] - t[998]);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 4.0, t[1000] - t[999]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1e-3, t[1001] - t[1000]);
    text_has("steps back 1 time: what follows is a piece of its own", remark.text);
}

static void test_a_clock_that_says_nothing(void)
{
    for (size_t k = 0; k < N; ++k)
        t[k] = 7.0;
    TEST_ASSERT_FALSE(hci_clock_mend(all(), &remark));
    text_has("does not go on: it is not used", remark.text);
    for (size_t k = 0; k < N; ++k)
        t[k] = -(double)k;
    TEST_ASSERT_FALSE(hci_clock_mend(all(), &remark));
    for (size_t k = 0; k < N; ++k)
        t[k] = fmod((double)k, 10.0);
    TEST_ASSERT_FALSE(hci_clock_mend(all(), &remark));
}

/* ---- beside the angle ---- */

static void make_motion(double speed)
{
    for (size_t k = 0; k < N; ++k)
        angle[k] = speed * truth[k] + 0.3 * sin(2.0 * truth[k]);
}

/* Stamps that jitter by a third of a step beside a steady shaft, and those of a shaft that was sampled so. */
static void test_stamps_that_jitter_are_smoothed(void)
{
    make_uniform(0.0, 1e-3);
    make_motion(200.0);
    TEST_ASSERT_EQUAL(HCI_CLOCK_AGREES, hci_clock_judge(all(), angle, 4, work));
    for (size_t k = 0; k < N; ++k)
        t[k] += ref_uniform(&seed, -3.3e-4, 3.3e-4);
    TEST_ASSERT_EQUAL(HCI_CLOCK_JITTERS, hci_clock_judge(all(), angle, 4, work));
    hci_clock_smooth(all(), work, &remark);
    for (size_t k = 50; k < N - 50; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1.5e-4, truth[k], t[k]);
    text_has("the time is smoothed", remark.text);
    memcpy(truth, t, sizeof t);
    for (size_t k = 0; k < N; ++k)
        truth[k] = t[k] = 1e-3 * ((double)k + ref_uniform(&seed, -0.33, 0.33));
    make_motion(200.0);
    TEST_ASSERT_EQUAL(HCI_CLOCK_AGREES, hci_clock_judge(all(), angle, 4, work));
}

/* The steps of an encoder, and a rounding that moves the angle by less than them, are no contradiction. */
static void test_small_departures_are_let_pass(void)
{
    make_uniform(0.0, 1e-3);
    make_motion(200.0);
    for (size_t k = 0; k < N; ++k)
        angle[k] = 0.02 * floor(angle[k] / 0.02);
    for (size_t k = 0; k < N; ++k)
        t[k] += ref_uniform(&seed, -1e-6, 1e-6);
    TEST_ASSERT_EQUAL(HCI_CLOCK_AGREES, hci_clock_judge(all(), angle, 4, work));
}

static void test_an_angle_of_another_instant(void)
{
    make_uniform(0.0, 5e-3);
    make_motion(100.0);
    for (size_t k = 0; k < N; ++k)
        angle[k] += 100.0 * ref_uniform(&seed, -1e-3, 1e-3);
    TEST_ASSERT_EQUAL(HCI_CLOCK_FOREIGN, hci_clock_judge(all(), angle, 4, work));
}

/* ---- in a run ---- */

/* dt: stamps rounded to it; late: the angle is read up to so late. */
static void read_motion(double dt, double late, const char *header, hci_run *run)
{
    char path[96];
    hci_note note = {{0}};
    snprintf(path, sizeof path, "%s", files_path("run.csv"));
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,%s\n", header);
    for (size_t k = 0; k < N; ++k) {
        const double at = 5e-4 * (double)k, read = at + ref_uniform(&seed, 0.0, late);
        fprintf(file, "%.4f,%.9f,90,0\n", dt * floor(at / dt + 1e-9), fmod(90.0 * read, 2.0 * REF_PI));
    }
    fclose(file);
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK, hci_run_read(path, &(hci_run_options){.pole_pairs = 4, .inertia_kgm2 = 1e-3}, run, &note),
        note.text);
}

static void test_a_run_with_a_coarse_clock_is_read(void)
{
    hci_run run;
    read_motion(1e-3, 0.0, "lamp,iq_A", &run);
    TEST_ASSERT_EQUAL(N, run.count);
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, run.torque_source);
    for (size_t k = 0; k < N; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-2, 90.0, run.speed_rad_per_s[k]);
    text_has("rounded to 0.001 s", run.remark.text);
    hci_run_release(&run);
}

/* Where the torque is not of the acceleration, and the speed was recorded. */
static void test_a_foreign_clock_is_left_out(void)
{
    hci_run run;
    read_motion(5e-4, 2e-3, "speed_rad_per_s,torque_Nm", &run);
    TEST_ASSERT_NULL(run.time_s);
    text_has("angle and time were not taken at the same instants: the time is not used", run.remark.text);
    hci_run_release(&run);
    read_motion(5e-4, 2e-3, "lamp,torque_Nm", &run);
    TEST_ASSERT_NOT_NULL(run.time_s);
    hci_run_release(&run);
    read_motion(5e-4, 0.0, "speed_rad_per_s,torque_Nm", &run);
    TEST_ASSERT_NOT_NULL(run.time_s);
    hci_run_release(&run);
}

/* A line a second beside a fast shaft. */
static void test_samples_turns_apart_stand_for_themselves(void)
{
    char path[96];
    hci_run run;
    hci_note note = {{0}};
    snprintf(path, sizeof path, "%s", files_path("run.csv"));
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fputs("time_s,theta_m_rad,speed_rad_per_s,torque_Nm\n", file);
    for (int k = 0; k < 100; ++k)
        fprintf(file, "%d,%.6f,70,1\n", k, fmod(70.0 * k, 2.0 * REF_PI));
    fclose(file);
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK, hci_run_read(path, &(hci_run_options){.pole_pairs = 4, .inertia_kgm2 = NAN}, &run, &note),
        note.text);
    TEST_ASSERT_NULL(run.time_s);
    text_has("more than half a turn apart: each is taken by itself", run.remark.text);
    hci_run_release(&run);
}

/* Steps of 1 ms, some of 3 ms, and two pauses. */
static void test_gaps(void)
{
    static double time_s[600];
    for (int k = 1; k < 600; ++k)
        time_s[k] = time_s[k - 1] + (k % 200 == 0 ? 7.0 : k % 50 == 0 ? 0.003 : 0.001);
    const double gap_s = hci_clock_gap_s(time_s, 600);
    TEST_ASSERT_TRUE(gap_s > 0.003 && gap_s < 7.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.0, 0.0, hci_clock_gap_s(time_s, 1));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_rounded_clock_becomes_the_uniform_one);
    RUN_TEST(test_a_rounded_clock_with_rows_left_out);
    RUN_TEST(test_uneven_repeated_stamps_are_spread);
    RUN_TEST(test_a_clock_that_ascends_is_left_alone);
    RUN_TEST(test_a_clock_that_begins_again_goes_on);
    RUN_TEST(test_a_rounded_clock_over_midnight);
    RUN_TEST(test_another_step_back_begins_a_piece);
    RUN_TEST(test_a_clock_that_says_nothing);
    RUN_TEST(test_stamps_that_jitter_are_smoothed);
    RUN_TEST(test_small_departures_are_let_pass);
    RUN_TEST(test_an_angle_of_another_instant);
    RUN_TEST(test_a_run_with_a_coarse_clock_is_read);
    RUN_TEST(test_a_foreign_clock_is_left_out);
    RUN_TEST(test_gaps);
    RUN_TEST(test_samples_turns_apart_stand_for_themselves);
    return UNITY_END();
}
