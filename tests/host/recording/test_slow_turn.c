/* Slow turns under position or speed control, without a torque column: a holding test, told or found. */
#include "host/recording/slow_turn.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/recording/run.h"
#include "host/base/memory.h"
#include "host/recording/rotor_frame.h"
#include "support/draws.h"
#include "support/run_file.h"
#include "support/texts.h"
#include "unity.h"

enum { N = 2000, P = 7 };

#define STEP_S     0.004
#define INERTIA    2e-5
#define CONSTANT   0.05
#define COGGING_Nm 0.01

void setUp(void)
{
    run_file_begin();
}

void tearDown(void)
{
    run_file_end();
}

/* A shaft at a steady speed whose current answers 12 events a turn and a load; wobble_rad: what the events
 * leave of them in the angle. */
static void read_turn(double speed, double load_Nm, double wobble_rad, const hci_run_options *options,
                      const char *last)
{
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,speed_rad_per_s,iq_A,%s\n", last);
    for (size_t k = 0; k < N; ++k) {
        const double t = STEP_S * (double)k, turn = speed * t;
        const double wobble = wobble_rad * sin(12.0 * turn),
                     rate = 12.0 * speed * wobble_rad * cos(12.0 * turn);
        fprintf(file, "%.4f,%.9f,%.9f,%.9f,%.4f\n", t, turn + wobble, speed + rate,
                (load_Nm + COGGING_Nm * sin(12.0 * turn)) / CONSTANT, 0.01 + 0.001 * cos(12.0 * turn));
    }
    fclose(file);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, options, &run, &note), note.text);
}

/* A holding map without time: there and back in the order of its rows, or one row there, one back. */
static void read_map(bool ordered)
{
    const hci_run_options options = {.pole_pairs = P};
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "theta_m_rad,iq_A,torque_Nm\n");
    for (int k = 0; k < 400; ++k) {
        const int at = ordered ? (k < 200 ? k : 399 - k) : 200 * (k % 2) + k / 2;
        fprintf(file, "%.6f,%.6f,0\n", 0.004 * at, 0.1 * sin(0.3 * at));
    }
    fclose(file);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &options, &run, &note), note.text);
    TEST_ASSERT_EQUAL(HCI_TORQUE_HOLDING, run.torque_source);
}

/* The order of the rows tells which way the shaft went, which friction goes by. */
static void test_a_map_goes_the_way_of_its_rows(void)
{
    read_map(true);
    TEST_ASSERT_NOT_NULL(run.speed_rad_per_s);
    for (size_t k = 0; k < 400; ++k)
        if (k != 199 && k != 200) TEST_ASSERT_EQUAL_DOUBLE(k < 199 ? 0.1 : -0.1, run.speed_rad_per_s[k]);
    text_has("the way the angle goes from row to row", run.remark.text);
    hci_run_release(&run);
    read_map(false);
    TEST_ASSERT_NULL(run.speed_rad_per_s);
}

static const hci_run_options KNOWN = {
    .pole_pairs = P, .inertia_kgm2 = INERTIA, .torque_constant_Nm_per_A = CONSTANT};

static void test_a_slow_turn_is_found(void)
{
    read_turn(0.6, 0.02, 0.0, &KNOWN, "lamp");
    TEST_ASSERT_EQUAL(HCI_TORQUE_HOLDING, run.torque_source);
    for (size_t k = 0; k < N; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(0.0, run.torque_Nm[k]);
    text_has("so slowly that its current answers cogging and friction, read as a holding test",
             run.remark.text);
}

/* J ω²/2 = 0.2 J against 0.007 N·m / 7: the rotor goes on whatever the current does. */
static void test_a_fast_shaft_under_load_is_none(void)
{
    read_turn(140.0, 0.02, 0.0, &KNOWN, "lamp");
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, run.torque_source);
}

/* i_q with a mean, or noise about none, of a motor of any size. */
static bool is_loaded(double mean_A, double noise_A)
{
    static double theta_m_rad[N], i_A[3 * N];
    uint64_t seed = 11;
    for (size_t k = 0; k < N; ++k) {
        theta_m_rad[k] = 0.01 * (double)k;
        const double q_A = mean_A + noise_A * ref_normal(&seed);
        for (int s = 0; s < 3; ++s)
            i_A[3 * k + (size_t)s] = q_A * sin(P * theta_m_rad[k] - s * 2.0943951023931953);
    }
    const hci_run one = {.theta_m_rad = theta_m_rad, .i_A = i_A, .count = N};
    return hci_run_is_loaded(&one, P);
}

static void test_a_load_is_more_than_a_current_varies_by(void)
{
    for (double unit_A = 1e-4; unit_A < 1e4; unit_A *= 10.0) {
        TEST_ASSERT_TRUE(is_loaded(4.1 * unit_A, unit_A));
        TEST_ASSERT_TRUE(is_loaded(-4.1 * unit_A, unit_A));
        TEST_ASSERT_FALSE(is_loaded(3.8 * unit_A, unit_A));
        TEST_ASSERT_FALSE(is_loaded(0.0, unit_A));
    }
}

/* A shaft that runs down from 30 rad/s in a second and stands for seven more; its sensors read a zero and
 * noise, in A. */
static void read_coast(double zero_A, double noise_A)
{
    uint64_t seed = 7;
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,speed_rad_per_s,iq_A\n");
    for (size_t k = 0; k < N; ++k) {
        const double t = STEP_S * (double)k, left = t < 1.0 ? 1.0 - t : 0.0;
        fprintf(file, "%.4f,%.9f,%.9f,%.9f\n", t, 15.0 * (1.0 - left * left), 30.0 * left,
                zero_A + noise_A * ref_normal(&seed));
    }
    fclose(file);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &KNOWN, &run, &note), note.text);
}

/* On average over the recording it is slow; but it has not been turned slowly. */
static void test_a_coast_with_a_long_rest_is_free(void)
{
    read_coast(0.0, 0.01);
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, run.torque_source);
    hci_run_release(&run);
    read_coast(0.02, 0.002);
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, run.torque_source);
}

/* J (12 ω)² × 0.1 rad = 3.7e-3 N·m beside 1e-2: a part of the current accelerates. */
static void test_a_shaft_that_is_accelerated_is_none(void)
{
    read_turn(0.6 * 6.0, 0.0, 0.1, &KNOWN, "lamp");
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, run.torque_source);
    hci_run_release(&run);
    read_turn(0.6 * 6.0, 0.0, 0.01, &KNOWN, "lamp");
    TEST_ASSERT_EQUAL(HCI_TORQUE_HOLDING, run.torque_source);
}

static void test_it_takes_inertia_and_torque_constant(void)
{
    read_turn(0.6, 0.02, 0.0, &(hci_run_options){.pole_pairs = P, .inertia_kgm2 = INERTIA}, "lamp");
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, run.torque_source);
    hci_run_release(&run);
    read_turn(0.6, 0.02, 0.0, &(hci_run_options){.pole_pairs = P, .inertia_kgm2 = NAN}, "lamp");
    TEST_ASSERT_EQUAL(HCI_TORQUE_NONE, run.torque_source);
}

/* Whatever is known of the machine; but a torque that was measured stays. */
static void test_it_can_be_said(void)
{
    const hci_run_options said = {.pole_pairs = P, .inertia_kgm2 = NAN, .holding = true};
    read_turn(140.0, 0.02, 0.0, &said, "lamp");
    TEST_ASSERT_EQUAL(HCI_TORQUE_HOLDING, run.torque_source);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, run.torque_Nm[7]);
    text_has("turned slowly, as --holding says, read as a holding test", run.remark.text);
    hci_run_release(&run);
    read_turn(0.6, 0.02, 0.0, &said, "torque_Nm");
    TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, run.torque_source);
}

/* Its speed varies by 1.2 / √2 = 85 %, less what is in the mean over 6/7 of a period; and by a tenth of it.
 */
static void test_a_shaft_that_sticks_and_slips_is_told(void)
{
    const hci_run_options said = {.pole_pairs = P, .inertia_kgm2 = NAN, .holding = true};
    read_turn(0.6, 0.02, 0.1, &said, "lamp");
    TEST_ASSERT_TRUE(run.is_unsteady);
    text_has("varies by 73 %", run.remark.text);
    text_has("sticks and slips", run.remark.text);
    hci_run_release(&run);
    read_turn(0.6, 0.02, 0.01, &said, "lamp");
    TEST_ASSERT_FALSE(run.is_unsteady);
}

/* Samples every 2 ms of a shaft whose speed varies by 0.2 / √2; a bus stamps them up to 4 ms late, in whole
 * ms. */
static void read_late(const char *speed_name, double wobble)
{
    const hci_run_options said = {.pole_pairs = P, .inertia_kgm2 = NAN, .holding = true};
    uint64_t seed = 3;
    double before_s = 0.0;
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,iq_A,%s\n", speed_name);
    for (size_t k = 0; k < 2 * N; ++k) {
        const double t = 0.002 * (double)k,
                     late_s = 0.001 * fmin(4.0, -1.2 * log(ref_uniform(&seed, 1e-9, 1.0)));
        before_s = fmax(before_s, floor(1e3 * (t + late_s)) * 1e-3);
        fprintf(file, "%.3f,%.9f,%.9f,%.9f\n", before_s, 0.6 * t + wobble / 12.0 * sin(12.0 * 0.6 * t),
                0.2 * sin(12.0 * 0.6 * t), 0.6 * (1.0 + wobble * cos(12.0 * 0.6 * t)));
    }
    fclose(file);
    hci_run_release(&run);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &said, &run, &note), note.text);
    TEST_ASSERT_TRUE(run.rough_clock);
}

/* Late stamps are no sticking: the recorded speed tells, or else the stamps when they are smoothed. */
static void test_late_stamps_are_no_sticking(void)
{
    read_late("speed_rad_per_s", 0.2);
    TEST_ASSERT_FALSE_MESSAGE(run.is_unsteady, run.remark.text);
    read_late("lamp", 0.2);
    TEST_ASSERT_FALSE_MESSAGE(run.is_unsteady, run.remark.text);
    read_late("speed_rad_per_s", 0.9);
    TEST_ASSERT_TRUE(run.is_unsteady);
    text_lacks("too coarse to tell", run.remark.text);
    read_late("lamp", 0.9);
    TEST_ASSERT_TRUE(run.is_unsteady);
    text_has("its stamps, which come early and late by turns, are too coarse to tell", run.remark.text);
}

/* Forward and back, so slowly that a shaft without control would not do it; inertia not known. */
static void test_a_turn_forward_and_back_is_found(void)
{
    const hci_run_options constant = {.pole_pairs = P, .torque_constant_Nm_per_A = CONSTANT};
    const double pace[] = {0.8, 8.0};
    for (size_t j = 0; j < 2; ++j) {
        FILE *file = fopen(path, "w");
        TEST_ASSERT_NOT_NULL(file);
        fprintf(file, "time_s,theta_m_rad,iq_A\n");
        for (size_t k = 0; k < N; ++k) {
            const double t = STEP_S * (double)k, half = STEP_S * 0.5 * N;
            const double turn = pace[j] * (half - fabs(t - half));
            fprintf(file, "%.4f,%.9f,%.9f\n", t, turn,
                    ((t < half ? 0.02 : -0.02) + COGGING_Nm * sin(12.0 * turn)) / CONSTANT);
        }
        fclose(file);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &constant, &run, &note), note.text);
        TEST_ASSERT_EQUAL(j == 0 ? HCI_TORQUE_HOLDING : HCI_TORQUE_NONE, run.torque_source);
        TEST_ASSERT_FALSE(run.is_unsteady);
        hci_run_release(&run);
    }
    read_turn(0.8, 0.02, 0.0, &constant, "lamp"); /* one way */
    TEST_ASSERT_EQUAL(HCI_TORQUE_NONE, run.torque_source);
}

/* It waits for a second, runs down for another, and stands for the rest: of what is left it moves nearly all
 * the time, and the slope of its speed is what it was. */
static void test_a_free_shaft_has_no_rows_at_rest(void)
{
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,speed_rad_per_s\n");
    for (size_t k = 0; k < N; ++k) {
        const double t = STEP_S * (double)k, left = t < 1.0 ? 0.0 : t < 2.0 ? 2.0 - t : 0.0;
        fprintf(file, "%.4f,%.9f,%.9f\n", t, t < 1.0 ? 0.0 : 15.0 * (1.0 - left * left), 30.0 * left);
    }
    fclose(file);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &KNOWN, &run, &note), note.text);
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, run.torque_source);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 1.5, run.time_s[run.count / 2]);
    TEST_ASSERT_TRUE(run.time_s[0] > 0.8 && run.time_s[run.count - 1] < 2.2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * 30.0 * KNOWN.inertia_kgm2, -30.0 * KNOWN.inertia_kgm2,
                              run.torque_Nm[run.count / 2]);
    text_has("rows, in which the shaft stands before or after it runs, are not used", run.remark.text);
}

/* i_q = (T + J α) / k with α = −(12 ω)² a sin 12 ω t: what is left is T, within what slopes smooth away. */
static void test_what_accelerates_is_taken_out(void)
{
    const double w = 12.0 * 0.6, a = 0.02, inertia = 2e-3;
    const hci_run_options said = {
        .pole_pairs = P, .inertia_kgm2 = inertia, .torque_constant_Nm_per_A = CONSTANT, .holding = true};
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,speed_rad_per_s,iq_A\n");
    for (size_t k = 0; k < N; ++k) {
        const double t = STEP_S * (double)k, x = w * t;
        fprintf(file, "%.4f,%.12f,%.12f,%.12f\n", t, 0.6 * t + a * sin(x), 0.6 + a * w * cos(x),
                (COGGING_Nm - inertia * w * w * a * sin(x)) / CONSTANT);
    }
    fclose(file);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &said, &run, &note), note.text);
    for (size_t k = 20; k < N - 20; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(0.02 * inertia * w * w * a / CONSTANT, COGGING_Nm / CONSTANT,
                                  hci_run_dq(&run, P, k).q);
    text_has("inertia x acceleration, 0.00146 N·m rms, is taken out of the", run.remark.text);
}

/* ---- of columns that are written down */

static double angle_rad[N], way_speed[N], clock_s[N], phases_A[3 * N];

/* Of so many rows, with i_q of both signs; angles and speeds of none. */
static hci_run columns_make(size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        angle_rad[k] = way_speed[k] = 0.0;
        clock_s[k] = STEP_S * (double)k;
    }
    return (hci_run){.theta_m_rad = angle_rad,
                     .speed_rad_per_s = way_speed,
                     .time_s = clock_s,
                     .i_A = phases_A,
                     .count = count};
}

static double size_A = 1.0; /* of all currents below */

static void currents_set(size_t count)
{
    for (size_t k = 0; k < count; ++k)
        hci_phases_of_dq((hci_dq){.d = 0.0, .q = size_A * (0.2 + sin(0.05 * (double)k))}, P * angle_rad[k],
                         &phases_A[3 * k]);
}

/* Between two rests a shaft turns at a pace for so many rows, from 0.5 on to 0.5 before its last angle. */
static bool is_slow_between_rests(size_t rows, double pace, double last_rad)
{
    const hci_run one = columns_make(200);
    for (size_t k = 100; k < 200; ++k)
        angle_rad[k] = last_rad;
    for (size_t k = 0; k < rows; ++k) {
        angle_rad[100 + k] = last_rad * (0.05 + 0.9 * (double)k / (double)(rows - 1));
        way_speed[100 + k] = k % 3 ? pace : -pace;
    }
    currents_set(200);
    return hci_is_slow(&one, P);
}

/* What it does while it moves, forward or back, of 16 rows or more; of fewer all rows are asked, of which it
 * stands for most. */
static void test_how_slow_a_shaft_is_while_it_moves(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        TEST_ASSERT_FALSE(is_slow_between_rests(16, 10.0, sign * 10.0));
        TEST_ASSERT_TRUE(is_slow_between_rests(15, 10.0, sign * 10.0));
        TEST_ASSERT_TRUE(is_slow_between_rests(40, 0.99 * HCI_SLOW_TURN_RAD_PER_S, sign * 10.0));
        TEST_ASSERT_FALSE(is_slow_between_rests(40, 1.01 * HCI_SLOW_TURN_RAD_PER_S, sign * 10.0));
    }
}

/* From a tenth of a radian on it has moved: 0.05 of 2.2 and of 1.8 at either end. */
static void test_when_a_shaft_has_moved(void)
{
    for (int more = 0; more < 2; ++more) {
        const double last_rad = more ? 2.2 : 1.8;
        TEST_ASSERT_EQUAL(!more, is_slow_between_rests(16, 10.0, last_rad)); /* 14 of 16 rows */
        TEST_ASSERT_FALSE(is_slow_between_rests(18, 10.0, last_rad));
    }
}

/* By a tenth of a radian it has; the fast rows that lie there, next to rest, count. */
static void test_a_way_of_exactly_a_tenth(void)
{
    for (int at_end = 0; at_end < 2; ++at_end)
        for (int off = 0; off < 2; ++off) {
            const hci_run one = columns_make(40);
            const size_t fast = at_end ? 38 : 1;
            for (size_t k = 2; k < 38; ++k)
                angle_rad[k] = 1.0 + 0.01 * (double)k;
            angle_rad[1] = angle_rad[38] = off ? 0.0999 : 0.1;
            way_speed[fast] = 40.0 * HCI_SLOW_TURN_RAD_PER_S;
            currents_set(40);
            TEST_ASSERT_EQUAL(off, hci_is_slow(&one, P));
        }
}

static bool goes_both_ways(double up_rad, double down_rad)
{
    const hci_run one = columns_make(400);
    for (size_t k = 0; k < 400; ++k) {
        angle_rad[k] =
            3.0 + (k < 200 ? up_rad * (double)k / 199.0 : up_rad - down_rad * (double)(k - 200) / 199.0);
        way_speed[k] = 0.5;
    }
    currents_set(400);
    return hci_is_slow_turn_both_ways(&one, P);
}

/* Half an electrical period there and half of one back. */
static void test_how_far_both_ways(void)
{
    const double half_rad = HCI_PI / P;
    TEST_ASSERT_TRUE(goes_both_ways(1.01 * half_rad, 1.01 * half_rad));
    TEST_ASSERT_FALSE(goes_both_ways(0.99 * half_rad, 3.0 * half_rad));
    TEST_ASSERT_FALSE(goes_both_ways(3.0 * half_rad, 0.99 * half_rad));
    TEST_ASSERT_TRUE(goes_both_ways(-1.01 * half_rad, -1.01 * half_rad));
    TEST_ASSERT_FALSE(goes_both_ways(-0.99 * half_rad, -3.0 * half_rad));
}

/* Of a motor of many poles half a period is short; one way is one way. */
static void test_one_way_of_many_poles(void)
{
    hci_run one = columns_make(200);
    for (int sign = -1; sign <= 1; sign += 2) {
        for (size_t k = 0; k < 200; ++k)
            angle_rad[k] = sign * 0.01 * (double)k;
        currents_set(200);
        TEST_ASSERT_TRUE(hci_is_slow(&one, 14));
        TEST_ASSERT_FALSE(hci_is_slow_turn_both_ways(&one, 14));
    }
}

/* A current of noise, that is none, where samples are near each other; where they are not, it may be one:
 * 2π/48 electrical from one to the next. */
static void test_noise_of_near_samples_is_no_current(void)
{
    for (int near = 0; near < 2; ++near) {
        hci_run one = columns_make(N);
        const double step_rad = 2.0 * HCI_PI / 48.0 / P * (near ? 0.99 : 1.01);
        uint64_t seed = 5;
        for (size_t k = 0; k < N; ++k)
            angle_rad[k] = step_rad * (double)(k % 2);
        for (size_t k = 0; k < N; ++k) {
            const hci_dq noise = {.d = size_A * ref_normal(&seed), .q = size_A * ref_normal(&seed)};
            hci_phases_of_dq(noise, P * angle_rad[k], &phases_A[3 * k]);
        }
        TEST_ASSERT_EQUAL(!near, hci_is_slow(&one, P));
        currents_set(N);
        TEST_ASSERT_TRUE(hci_is_slow(&one, P));
    }
}

/* The same of a motor of milliamperes. */
static void test_a_small_motor(void)
{
    size_A = 1e-3;
    test_how_slow_a_shaft_is_while_it_moves();
    test_when_a_shaft_has_moved();
    test_noise_of_near_samples_is_no_current();
    size_A = 1.0;
}

/* Of a current that makes no torque nothing can be a share. */
static void test_no_share_of_no_torque(void)
{
    static double torque_Nm[20];
    hci_run one = columns_make(20);
    one.torque_Nm = torque_Nm;
    for (size_t k = 0; k < 20; ++k) {
        torque_Nm[k] = k % 2 ? 0.1 : -0.1;
        hci_phases_of_dq((hci_dq){.d = 1.0, .q = 2.0}, P * angle_rad[k], &phases_A[3 * k]);
    }
    hci_slow_turn_correct(&one, P, 0.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, one.inertia_share);
}

/* i_q of each row less a constant, or less what accelerates: rms 3 of 10 N·m. */
static void test_what_is_taken_from_the_current(void)
{
    static double torque_Nm[N];
    hci_run one = columns_make(100);
    one.torque_Nm = torque_Nm;
    for (size_t k = 0; k < 100; ++k) {
        angle_rad[k] = 0.01 * (double)k;
        torque_Nm[k] = k % 4 < 2 ? 3.0 : -3.0;
        hci_phases_of_dq((hci_dq){.d = 0.7, .q = k % 2 ? 12.0 : 2.0}, P * angle_rad[k], &phases_A[3 * k]);
    }
    hci_slow_turn_take_constant(&one, P, 1.5);
    for (size_t k = 0; k < 100; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, k % 2 ? 10.5 : 0.5, hci_run_dq(&one, P, k).q);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.7, hci_run_dq(&one, P, k).d);
    }
    hci_slow_turn_correct(&one, P, 2.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0 / 10.0, one.inertia_share);
    for (size_t k = 0; k < 100; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, (k % 2 ? 10.5 : 0.5) - (k % 4 < 2 ? 1.5 : -1.5),
                                  hci_run_dq(&one, P, k).q);
}

/* Rows that go on by 0.01 rad, and turn back that often, some of them behind a row that stays. */
static bool has_direction(size_t rows, size_t turns)
{
    hci_run one = columns_make(rows);
    double step = 0.01;
    for (size_t k = 1, left = turns; k < rows; ++k) {
        if (left > 0 && k > 1 && k % 5 % 2 == 1) {
            step = -step;
            --left;
        }
        angle_rad[k] = angle_rad[k - 1] + (k % 5 == 0 ? 0.0 : step);
    }
    one.time_s = one.speed_rad_per_s = NULL;
    memset(&one.remark, 0, sizeof one.remark);
    TEST_ASSERT_TRUE(hci_row_direction_set(&one));
    if (!one.speed_rad_per_s) return false;
    double before = 0.0;
    for (size_t k = 0; k < rows; ++k) {
        const size_t at = k + 1 < rows ? k : k - 1;
        const double way = angle_rad[at + 1] - angle_rad[at];
        before = way > 0.0 ? 0.1 : way < 0.0 ? -0.1 : before;
        TEST_ASSERT_EQUAL_DOUBLE(before, one.speed_rad_per_s[k]);
    }
    hci_memory_free(one.speed_rad_per_s);
    return true;
}

/* One row in twenty may turn back, of 16 rows or more. */
static void test_how_often_rows_turn_back(void)
{
    TEST_ASSERT_TRUE(has_direction(16, 0));
    TEST_ASSERT_FALSE(has_direction(15, 0));
    TEST_ASSERT_TRUE(has_direction(110, 5));
    TEST_ASSERT_FALSE(has_direction(110, 6));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_map_goes_the_way_of_its_rows);
    RUN_TEST(test_a_slow_turn_is_found);
    RUN_TEST(test_a_fast_shaft_under_load_is_none);
    RUN_TEST(test_a_load_is_more_than_a_current_varies_by);
    RUN_TEST(test_a_coast_with_a_long_rest_is_free);
    RUN_TEST(test_a_free_shaft_has_no_rows_at_rest);
    RUN_TEST(test_a_shaft_that_is_accelerated_is_none);
    RUN_TEST(test_it_takes_inertia_and_torque_constant);
    RUN_TEST(test_it_can_be_said);
    RUN_TEST(test_a_shaft_that_sticks_and_slips_is_told);
    RUN_TEST(test_late_stamps_are_no_sticking);
    RUN_TEST(test_a_turn_forward_and_back_is_found);
    RUN_TEST(test_what_accelerates_is_taken_out);
    RUN_TEST(test_how_slow_a_shaft_is_while_it_moves);
    RUN_TEST(test_when_a_shaft_has_moved);
    RUN_TEST(test_a_way_of_exactly_a_tenth);
    RUN_TEST(test_how_far_both_ways);
    RUN_TEST(test_one_way_of_many_poles);
    RUN_TEST(test_noise_of_near_samples_is_no_current);
    RUN_TEST(test_a_small_motor);
    RUN_TEST(test_no_share_of_no_torque);
    RUN_TEST(test_what_is_taken_from_the_current);
    RUN_TEST(test_how_often_rows_turn_back);
    return UNITY_END();
}
