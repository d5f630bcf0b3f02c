/* Slow turns whose inertia answers a part of the cogging torque: J dω/dt = k i_q + T(θ) holds at each angle,
 * with ω²/2 as a sum of sines of the angle, so that dω/dt = d(ω²/2)/dθ in closed form. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/recording/rotor_frame.h"
#include "support/run_file.h"
#include "support/texts.h"
#include "unity.h"

enum { P = 7, EVENTS = 84, N = 2500, FINE = 40 };

#define INERTIA     2e-5
#define CONSTANT    0.05
#define COGGING_Nm  0.004
#define FRICTION_Nm 0.001
#define STEP_S      0.004

void setUp(void)
{
    run_file_begin();
}

void tearDown(void)
{
    run_file_end();
}

/* A way whose speed varies by a share of it, with the phase of a loop that answers late. */
typedef struct {
    double speed, share, lag_rad;
} way;

static double cogging_Nm(double theta)
{
    return COGGING_Nm * sin(EVENTS * theta + 0.7);
}

static double phase(const way *w, double theta)
{
    return EVENTS * theta + 0.7 - (w->speed > 0.0 ? w->lag_rad : -w->lag_rad);
}

/* ω = ±|ω₀| √(1 + 2 share sin) */
static double speed_at(const way *w, double theta)
{
    return w->speed * sqrt(1.0 + 2.0 * w->share * sin(phase(w, theta)));
}

static double acceleration_at(const way *w, double theta)
{
    return w->speed * w->speed * w->share * EVENTS * cos(phase(w, theta));
}

/* The time goes on from *from, the angle from *theta. */
static void write_way(FILE *file, const way *w, double *from, double *theta)
{
    for (int k = 0; k < N; ++k, *from += STEP_S) {
        const double friction = w->speed > 0.0 ? FRICTION_Nm : -FRICTION_Nm;
        fprintf(file, "%.4f,%.9f,%.9f\n", *from, *theta,
                (INERTIA * acceleration_at(w, *theta) - cogging_Nm(*theta) + friction) / CONSTANT);
        for (int j = 0; j < FINE; ++j) {
            const double half = *theta + 0.5 * STEP_S / FINE * speed_at(w, *theta);
            *theta += STEP_S / FINE * speed_at(w, half);
        }
    }
}

static void write_ways(const char *name, const way *ways, size_t count)
{
    double from = 0.0, theta = 0.3;
    FILE *file = fopen(name, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,iq_A\n");
    for (size_t k = 0; k < count; ++k)
        write_way(file, &ways[k], &from, &theta);
    fclose(file);
}

static void read_ways(const way *ways, size_t count, double inertia)
{
    const hci_run_options options = {
        .pole_pairs = P, .inertia_kgm2 = inertia, .torque_constant_Nm_per_A = CONSTANT, .holding = true};
    write_ways(path, ways, count);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &options, &run, &note), note.text);
}

/* The current of a run is that which holds the shaft at each angle. */
static void is_held(const hci_run *r, double share)
{
    double square = 0.0;
    TEST_ASSERT_EQUAL(HCI_TORQUE_HOLDING, r->torque_source);
    for (size_t k = 0; k < r->count; ++k) {
        const double friction = r->speed_rad_per_s[k] > 0.0 ? FRICTION_Nm : -FRICTION_Nm;
        const double left = CONSTANT * hci_run_dq(r, P, k).q - friction + cogging_Nm(r->theta_m_rad[k]);
        if (fabs(r->speed_rad_per_s[k]) > 0.5) square += left * left / (double)r->count;
    }
    TEST_ASSERT_DOUBLE_WITHIN(share * COGGING_Nm, 0.0, sqrt(square));
}

/* J α is 0.7 of the cogging torque, at 42 samples a second of an event: slopes would be late or noisy. */
static const way FAST[] = {{2.0, 0.2, 0.9}, {-2.0, 0.2, 0.9}};

static void test_the_inertia_that_is_given_takes_its_part_out(void)
{
    read_ways(FAST, 1, INERTIA);
    is_held(&run, 0.02);
    text_has("acceleration by the orders of the angle over time", run.remark.text);
    hci_run_release(&run);
    read_ways(FAST, 2, INERTIA);
    is_held(&run, 0.03);
}

/* Forward and back the loop answers late by an angle of the other sign: one inertia alone makes them agree.
 */
static void test_forward_and_back_tell_the_inertia(void)
{
    read_ways(FAST, 2, 0.0);
    is_held(&run, 0.05);
    text_has("an inertia of 2", run.remark.text);
    text_has("e-08 kg·m² makes the torque of its turns agree", run.remark.text);
    TEST_ASSERT_FALSE(run.needs_inertia);
}

static void inertia_is(bool denied)
{
    TEST_ASSERT_TRUE(run.least_inertia_kgm2 < INERTIA && run.most_inertia_kgm2 > INERTIA);
    TEST_ASSERT_TRUE(run.most_inertia_kgm2 < 1.3 * run.least_inertia_kgm2);
    TEST_ASSERT_EQUAL(denied, run.denies_inertia);
    TEST_ASSERT_EQUAL(denied, strstr(run.remark.text, "and not the declared") != NULL);
    hci_run_release(&run);
}

/* A declared one that is ten times too large or too small makes the directions disagree; one that is a fifth
 * off may be an error of the torque per ampere; one direction tells nothing. */
static void test_turns_deny_a_wrong_inertia(void)
{
    for (int k = 0; k < 4; ++k) {
        read_ways(FAST, 2, INERTIA * (double[]){1.0, 1.2, 10.0, 0.1}[k]);
        inertia_is(k > 1);
    }
    read_ways(FAST, 1, 10.0 * INERTIA);
    TEST_ASSERT_FALSE(run.denies_inertia || run.least_inertia_kgm2 > 0.0);
}

/* A free shaft that its current hastens and slows down, beside friction. */
static void read_free(double inertia)
{
    const hci_run_options options = {
        .pole_pairs = P, .inertia_kgm2 = inertia, .torque_constant_Nm_per_A = CONSTANT};
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,speed_rad_per_s,iq_A\n");
    for (int k = 0; k < N; ++k) {
        const double t = STEP_S * k, wave = 0.01 * sin(700.0 * t);
        fprintf(file, "%.4f,%.9f,%.9f,%.9f\n", t, 50.0 * t + 30.0 * (1.0 - cos(t)), 50.0 + 30.0 * sin(t),
                (INERTIA * 30.0 * cos(t) + FRICTION_Nm) / CONSTANT + wave);
    }
    fclose(file);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &options, &run, &note), note.text);
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, run.torque_source);
}

static void test_a_free_shaft_denies_a_wrong_inertia(void)
{
    for (int k = 0; k < 4; ++k) {
        read_free(INERTIA * (double[]){1.0, 1.2, 10.0, 0.1}[k]);
        inertia_is(k > 1);
    }
}

/* One way, or two that are alike in everything: nothing tells what the inertia answers. */
static void test_what_is_not_told_is_not_given(void)
{
    const way alike[] = {{2.0, 0.2, 0.0}, {-2.0, 0.2, 0.0}};
    for (size_t count = 1; count < 3; ++count) {
        read_ways(alike, count, 0.0);
        TEST_ASSERT_TRUE(run.needs_inertia);
        TEST_ASSERT_EQUAL(HCI_TORQUE_NONE, run.torque_source);
        TEST_ASSERT_NULL(run.torque_Nm);
        text_has("give the inertia, or record more slowly", run.remark.text);
        hci_run_release(&run);
    }
}

/* A speed that hardly varies, or events that come slowly: the current answers. */
static void test_a_quiet_turn_is_held_without_it(void)
{
    const way quiet = {2.0, 0.002, 0.5}, slow = {0.8, 0.1, 0.5};
    read_ways(&quiet, 1, 0.0);
    is_held(&run, 0.1);
    hci_run_release(&run);
    read_ways(&slow, 1, 0.0);
    is_held(&run, 0.1);
}

/* A shaft that sticks and slips and goes back a little has no one time at each angle: orders of it would be
 * accelerations without end. */
static void test_a_shaft_that_goes_back_is_not_taken_by_orders(void)
{
    const hci_run_options options = {
        .pole_pairs = P, .inertia_kgm2 = INERTIA, .torque_constant_Nm_per_A = CONSTANT, .holding = true};
    double most_Nm = 0.0;
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,iq_A\n");
    for (int k = 0; k < N; ++k) {
        const double even = 0.8 * STEP_S * k;
        fprintf(file, "%.4f,%.9f,%.9f\n", STEP_S * k, even + 1.3 / EVENTS * sin(EVENTS * even),
                0.1 + 0.05 * sin(EVENTS * even));
    }
    fclose(file);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &options, &run, &note), note.text);
    TEST_ASSERT_NULL(strstr(run.remark.text, "by the orders of the angle"));
    for (size_t k = 0; k < run.count; ++k)
        most_Nm = fmax(most_Nm, fabs(CONSTANT * hci_run_dq(&run, P, k).q));
    TEST_ASSERT_TRUE(most_Nm < 0.05);
}

static void read_two(const way *ways, hci_runs *runs)
{
    const hci_run_options reading = {.pole_pairs = P, .torque_constant_Nm_per_A = CONSTANT};
    write_ways(path, ways, 1);
    write_ways(files_path("back.csv"), ways + 1, 1);
    FILE *file = fopen(files_path("runs.csv"), "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "file,role\nrun.csv,fit\nback.csv,fit\n");
    fclose(file);
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK, hci_runs_read(files_path("runs.csv"), &(hci_runs_options){reading, NULL, NULL}, runs, &note),
        note.text);
}

/* Each of two files goes one way: beside each other they are forward and back. */
static void test_forward_in_one_file_and_back_in_another(void)
{
    hci_runs runs;
    read_two(FAST, &runs);
    for (size_t k = 0; k < 2; ++k) {
        is_held(&runs.run[k], 0.05);
        text_has("forward in one recording and back in another", runs.run[k].remark.text);
        text_has("e-05 ± ", runs.run[k].remark.text);
        TEST_ASSERT_TRUE(runs.run[k].turns_inertia_error_kgm2 > 0.0);
        TEST_ASSERT_TRUE(fabs(runs.run[k].turns_inertia_kgm2 - INERTIA) < 0.05 * INERTIA);
    }
    hci_runs_release(&runs);
    read_two((way[]){FAST[0], FAST[0]}, &runs); /* the same way twice */
    for (size_t k = 0; k < 2; ++k)
        TEST_ASSERT_EQUAL(HCI_TORQUE_NONE, runs.run[k].torque_source);
    hci_runs_release(&runs);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_inertia_that_is_given_takes_its_part_out);
    RUN_TEST(test_forward_and_back_tell_the_inertia);
    RUN_TEST(test_turns_deny_a_wrong_inertia);
    RUN_TEST(test_a_free_shaft_denies_a_wrong_inertia);
    RUN_TEST(test_what_is_not_told_is_not_given);
    RUN_TEST(test_a_quiet_turn_is_held_without_it);
    RUN_TEST(test_a_shaft_that_goes_back_is_not_taken_by_orders);
    RUN_TEST(test_forward_in_one_file_and_back_in_another);
    return UNITY_END();
}
