/* What a run's currents tell of its sign, its zero of the angle and its pole pairs (effort.h). */
#include <math.h>
#include <string.h>

#include "host/recording/effort.h"
#include "support/draws.h"
#include "support/recording.h"
#include "support/texts.h"
#include "unity.h"

enum { N = 600, P = 3 };

#define STEP_S 2e-3
#define SLOPE  0.04 /* A s²/rad */

static hci_run run;

void setUp(void)
{
}

void tearDown(void)
{
    rec_release(&run);
}

/* A shaft that gets faster and slower; the current lies ahead_rad from i_q. */
static void make(double sign, double ahead_rad)
{
    uint64_t seed = 9;
    rec_release(&run);
    run = rec_make(N);
    run.pole_pairs = P;
    run.has_sum = true;
    for (size_t k = 0; k < N; ++k) {
        const double t = STEP_S * (double)k, w = 6.0;
        run.time_s[k] = t;
        run.speed_rad_per_s[k] = 12.0 + 9.0 * sin(w * t);
        run.theta_m_rad[k] = 0.3 + 12.0 * t - 9.0 / w * cos(w * t);
        const double i_A = sign * SLOPE * 9.0 * w * cos(w * t) + 0.5 + 0.02 * ref_normal(&seed);
        rec_phases(-i_A * sin(ahead_rad), i_A * cos(ahead_rad), P * run.theta_m_rad[k], run.i_A + 3 * k);
    }
}

static void set(void)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL(HCI_OK, hci_run_effort_set(&run, &note));
}

/* The fit to i_q, at times or at the numbers of rows. */
static hci_effort effort_by(bool with_time)
{
    static double iq_A[N], at[N];
    for (size_t k = 0; k < N; ++k) {
        double d;
        rec_rotor(run.i_A + 3 * k, P * run.theta_m_rad[k], &d, &iq_A[k]);
        at[k] = with_time ? run.time_s[k] : (double)k;
    }
    return hci_effort_find(&(hci_effort_samples){at, run.speed_rad_per_s, iq_A, run.theta_m_rad, N});
}

static void test_a_run_has_the_slope_of_its_current(void)
{
    make(1.0, 0.0);
    const hci_effort effort = effort_by(true);
    set();
    TEST_ASSERT_EQUAL(1, run.current_way);
    TEST_ASSERT_DOUBLE_WITHIN(0.2 * SLOPE, SLOPE, run.iq_per_acceleration);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, effort.slope, run.iq_per_acceleration);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, effort.slope / effort.accelerating, run.iq_per_acceleration_error);
    TEST_ASSERT_TRUE(run.counts_pole_pairs);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, run.off_iq_rad);
    TEST_ASSERT_EQUAL_STRING("", run.remark.text);
}

/* By the numbers of rows the sign is told, and no slope. */
static void test_rows_without_time(void)
{
    make(1.0, 0.0);
    TEST_ASSERT_TRUE(effort_by(false).accelerating > 6.0);
    free(run.time_s);
    run.time_s = NULL;
    set();
    TEST_ASSERT_EQUAL(1, run.current_way);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, run.iq_per_acceleration);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, run.iq_per_acceleration_error);
}

static void test_a_current_against_the_motion(void)
{
    make(-1.0, 0.0);
    set();
    TEST_ASSERT_EQUAL(-1, run.current_way);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, run.iq_per_acceleration);
    text_has("half an electrical turn off, or the phase currents, or angle and speed", run.remark.text);
    make(-1.0, 0.0);
    run.has_sum = false;
    set();
    TEST_ASSERT_EQUAL(-1, run.current_way);
    text_has("does which turns by itself: i_q, or angle and speed", run.remark.text);
}

/* 20 degrees from i_q are allowed to phase currents, of a drive whose zero of the angle may be another. */
static void test_currents_beside_iq(void)
{
    for (int side = -1; side <= 1; side += 2) {
        make(1.0, side * 0.32);
        set();
        TEST_ASSERT_EQUAL(1, run.current_way);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, run.off_iq_rad);
        make(1.0, side * 0.38);
        set();
        TEST_ASSERT_EQUAL(0, run.current_way);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, side * 0.38, run.off_iq_rad);
        TEST_ASSERT_TRUE(run.counts_pole_pairs);
    }
}

/* i_d and i_q of the drive are told whatever their direction, and count no pole pairs. */
static void test_currents_of_the_drive(void)
{
    make(1.0, 0.6);
    run.has_sum = false;
    set();
    TEST_ASSERT_EQUAL(1, run.current_way);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, run.off_iq_rad);
    TEST_ASSERT_FALSE(run.counts_pole_pairs);
    run.computed_phase = 1; /* a phase that was computed of two others: phase currents too */
    run.current_way = 0;
    set();
    TEST_ASSERT_EQUAL(0, run.current_way);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.6, run.off_iq_rad);
    TEST_ASSERT_TRUE(run.counts_pole_pairs);
}

/* Currents that go round in the rotor frame lie on no line. */
static void test_currents_on_no_line(void)
{
    make(1.0, 0.0);
    for (size_t k = 0; k < N; ++k) {
        const double turn = 5.0 * run.theta_m_rad[k];
        rec_phases(cos(turn), sin(turn), P * run.theta_m_rad[k], run.i_A + 3 * k);
    }
    set();
    TEST_ASSERT_EQUAL(0, run.current_way);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, run.off_iq_rad);
    TEST_ASSERT_FALSE(run.counts_pole_pairs);
}

static void test_turns_that_are_not_known(void)
{
    make(1.0, 0.0);
    run.turn_known = false;
    set();
    TEST_ASSERT_FALSE(run.counts_pole_pairs);
    TEST_ASSERT_EQUAL(1, run.current_way);
    run.turn_known = run.is_electrical = true;
    set();
    TEST_ASSERT_FALSE(run.counts_pole_pairs);
}

/* Without currents, angle or speed there is nothing to tell. */
static void test_what_is_missing(void)
{
    for (int which = 0; which < 3; ++which) {
        make(1.0, 0.0);
        double **column = which == 0 ? &run.i_A : which == 1 ? &run.theta_m_rad : &run.speed_rad_per_s;
        free(*column);
        *column = NULL;
        set();
        TEST_ASSERT_EQUAL(0, run.current_way);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, run.off_iq_rad);
        TEST_ASSERT_EQUAL(which == 2, run.counts_pole_pairs);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_run_has_the_slope_of_its_current);
    RUN_TEST(test_rows_without_time);
    RUN_TEST(test_a_current_against_the_motion);
    RUN_TEST(test_currents_beside_iq);
    RUN_TEST(test_currents_of_the_drive);
    RUN_TEST(test_currents_on_no_line);
    RUN_TEST(test_turns_that_are_not_known);
    RUN_TEST(test_what_is_missing);
    return UNITY_END();
}
