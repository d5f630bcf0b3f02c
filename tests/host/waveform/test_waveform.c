/* Orders of recorded waveforms: recordings written by their sine formulas, with noise whose size is known,
 * and measured ones. */
#include "hci/host/report/write.h"
#include "hci/host/waveform/waveform.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hci/host/machine/machine.h"
#include "hci/host/report/summary.h"
#include "host/base/memory.h"
#include "support/draws.h"
#include "support/files.h"
#include "support/reference.h"
#include "support/texts.h"
#include "unity.h"

#define MEASURED "../shared/measured/"
#define TURN     (2.0 * REF_PI)

enum { MOST = 60000 };

/* Whether the claims that take some hundred recordings are tested: test_waveform_at_length. */
#ifdef AT_LENGTH
enum { MANY_TRIALS = 1 };
#else
enum { MANY_TRIALS = 0 };
#endif

static double time_s[MOST], theta_m[MOST], speed[MOST], current[3 * MOST], torque[MOST], voltage[3 * MOST];
static hci_run run;
static hci_waveform w;
static hci_waveform_options options;
static hci_note note;
static uint64_t seed;

void setUp(void)
{
    memset(&run, 0, sizeof run);
    memset(&w, 0, sizeof w);
    memset(&note, 0, sizeof note);
    memset(current, 0, sizeof current);
    memset(torque, 0, sizeof torque);
    options = (hci_waveform_options){HCI_WAVEFORM_COGGING, 3, NULL, 0, NAN, NAN};
    run.name = "run.csv";
    run.i_A = current;
    run.turn_known = true;
    run.torque_source = HCI_TORQUE_MEASURED;
    seed = 5;
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_waveform_release(&w);
}

static double gauss(void)
{
    const double u = ref_uniform(&seed, 1e-300, 1.0);
    return sqrt(-2.0 * log(u)) * cos(ref_uniform(&seed, 0.0, TURN));
}

static void find(void)
{
    hci_waveform_release(&w);
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_waveform_find(&run, &options, &w, &note), note.text);
}

static void refused(hci_status status, const char *why)
{
    hci_waveform none;
    hci_note said = {{0}};
    TEST_ASSERT_EQUAL(status, hci_waveform_find(&run, &options, &none, &said));
    text_has(why, said.text);
    TEST_ASSERT_NULL(none.order);
}

static const hci_waveform_order *order_at(double order)
{
    for (size_t k = 0; k < w.count; ++k)
        if (fabs(w.order[k].order - order) < 1e-6) return &w.order[k];
    TEST_FAIL_MESSAGE("order not looked at");
    return NULL;
}

static bool kept(double order)
{
    for (size_t k = 0; k < w.count; ++k)
        if (fabs(w.order[k].order - order) < 1e-6) return w.order[k].kept;
    return false;
}

/* ---- cogging ---- */

/* Three pole pairs; 8/3 once in 1/8 of the mechanical turn. */
static const ref_wave COGGING[] = {
    {2.0, 0.0, 0.02, 0.7},
    {8.0 / 3.0, 0.0, 0.005, -2.0},
    {6.0, 0.0, 0.05, 2.5},
};
enum { COGGING_COUNT = 3 };

static double cogging_at(double theta_m_rad)
{
    return ref_waves_at(COGGING, COGGING_COUNT, 0, 3.0 * theta_m_rad);
}

/* n samples over `turns`, spaced unevenly. noise: rms; resemblance: of a sample's noise to the next. */
static void record_cogging(int n, double turns, double noise, double resemblance)
{
    double error = gauss() * noise;
    for (int k = 0; k < n; ++k) {
        theta_m[k] = turns * TURN * (k + 0.3 * sin(0.7 * k)) / n;
        error = resemblance * error + sqrt(1.0 - resemblance * resemblance) * noise * gauss();
        torque[k] = cogging_at(theta_m[k]) + error;
    }
    run.count = (size_t)n;
    run.theta_m_rad = theta_m;
    run.torque_Nm = torque;
}

static void assert_cogging(double tolerance)
{
    for (int k = 0; k < COGGING_COUNT; ++k) {
        const hci_waveform_order *o = order_at(COGGING[k].order);
        TEST_ASSERT_TRUE(o->kept);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, COGGING[k].amplitude, o->amplitude);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance / COGGING[k].amplitude, COGGING[k].phase, o->phase_rad);
    }
}

/* The mean of samples in a cell of 1/64 of the highest order's length is short by (2π/64)²/24 at that order.
 */
static void test_without_noise_cogging_is_exact(void)
{
    options.max_order = 10.0;
    record_cogging(1500, 1.0, 0.0, 0.0);
    find();
    assert_cogging(0.05 * 4e-4);
    TEST_ASSERT_EQUAL(COGGING_COUNT, (int)w.kept);
    TEST_ASSERT_EQUAL(30, (int)w.count);
    TEST_ASSERT_EQUAL(1, (int)w.turns_forward);
    TEST_ASSERT_FALSE(w.between_turns);
    record_cogging(9000, 6.0, 0.0, 0.0);
    find();
    assert_cogging(0.05 * 4e-4);
    TEST_ASSERT_EQUAL(6, (int)w.turns_forward);
    TEST_ASSERT_TRUE(w.between_turns);
}

/* The squares of error/standard error of S and C have the mean 1. */
static double calibration(int trials, int n, double turns, double noise, double resemblance)
{
    double sum = 0.0;
    for (int trial = 0; trial < trials; ++trial) {
        record_cogging(n, turns, noise, resemblance);
        find();
        for (int k = 0; k < COGGING_COUNT; ++k) {
            const hci_waveform_order *o = order_at(COGGING[k].order);
            const double s = o->amplitude * cos(o->phase_rad) - COGGING[k].amplitude * cos(COGGING[k].phase);
            const double c = o->amplitude * sin(o->phase_rad) - COGGING[k].amplitude * sin(COGGING[k].phase);
            sum += (s * s + c * c) / (o->std_error * o->std_error);
        }
    }
    return sum / (2.0 * COGGING_COUNT * trials);
}

/* Expected: freedom/(freedom − 2) for errors from few turns, less for the factor that allows for resemblance.
 * 120 values of a mean of 1: within 0.13 three times of four. */
static void test_standard_errors_are_what_they_say(void)
{
    options.max_order = 12.0;
    TEST_ASSERT_DOUBLE_WITHIN(0.22, 1.0, calibration(40, 2000, 1.0, 0.01, 0.0));
    TEST_ASSERT_DOUBLE_WITHIN(0.22, 1.0, calibration(40, 4000, 12.0, 0.01, 0.0));
}

/* Noise that hardly changes from sample to sample is larger at low orders; taken for white it would be sure
 * of twenty times too much. */
static void test_standard_errors_respect_serial_correlation(void)
{
    options.max_order = 12.0;
    TEST_ASSERT_DOUBLE_WITHIN(0.22, 1.0, calibration(40, 2000, 1.0, 0.01, 0.97));
    TEST_ASSERT_DOUBLE_WITHIN(0.3, 1.0, calibration(40, 2000, 1.0, 0.01, 0.995));
    TEST_ASSERT_DOUBLE_WITHIN(0.22, 1.0, calibration(40, 4000, 12.0, 0.01, 0.97));
}

/* A torque ripple that drifts from turn to turn: neighbours resemble each other, so that 30 turns tell as
 * much as 8 independent ones. */
static void test_standard_errors_respect_drift_between_turns(void)
{
    double sum = 0.0;
    options.max_order = 12.0;
    for (int trial = 0; trial < 60; ++trial) {
        double drift = 0.004 * gauss();
        record_cogging(4500, 30.0, 0.001, 0.0);
        for (int k = 0; k < 4500; ++k) {
            if (k % 150 == 0) drift = 0.6 * drift + 0.8 * 0.004 * gauss();
            torque[k] += drift * sin(18.0 * theta_m[k]);
        }
        find();
        const hci_waveform_order *o = order_at(6.0);
        const double s = o->amplitude * cos(o->phase_rad) - COGGING[2].amplitude * cos(COGGING[2].phase);
        const double c = o->amplitude * sin(o->phase_rad) - COGGING[2].amplitude * sin(COGGING[2].phase);
        sum += (s * s + c * c) / (o->std_error * o->std_error);
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.8, 1.2, sum / 120.0); /* 4 for turns that were independent */
}

/* One recording in a hundred may have a false order. */
static void test_noise_alone_has_no_orders(void)
{
    size_t found = 0;
    options.max_order = 12.0;
    for (int trial = 0; trial < 120; ++trial) {
        record_cogging(2000, trial % 2 == 0 ? 1.0 : 6.0, 0.01, trial % 3 == 0 ? 0.9 : 0.0);
        for (int k = 0; k < 2000; ++k)
            torque[k] -= cogging_at(theta_m[k]);
        find();
        found += w.kept;
    }
    TEST_ASSERT_TRUE(found <= 4);
}

static void test_orders_that_stand_out_are_kept_and_others_named(void)
{
    record_cogging(6000, 8.0, 0.02, 0.0);
    find();
    TEST_ASSERT_TRUE(kept(2.0) && kept(6.0) && kept(8.0 / 3.0));
    TEST_ASSERT_TRUE(w.kept <= 4);
    TEST_ASSERT_TRUE(w.largest_left > 0.0 && !kept(w.largest_left));
}

/* ---- friction ---- */

/* There and back; friction that depends on the angle too. */
static void record_strokes(int strokes, double turns, double coulomb, double ripple)
{
    const int each = 2500;
    for (int k = 0; k < strokes * each; ++k) {
        const int stroke = k / each;
        const double within = turns * TURN * (k % each) / each, sign = stroke % 2 == 0 ? 1.0 : -1.0;
        theta_m[k] = sign > 0.0 ? within : turns * TURN - within;
        torque[k] = cogging_at(theta_m[k]) - sign * (coulomb + ripple * sin(9.0 * theta_m[k] + 0.3)) +
                    0.002 * gauss();
    }
    run.count = (size_t)(strokes * each);
    run.theta_m_rad = theta_m;
    run.torque_Nm = torque;
}

static void test_friction_drops_out_of_both_directions(void)
{
    options.max_order = 12.0;
    record_strokes(2, 1.02, 0.03, 0.01);
    find();
    TEST_ASSERT_EQUAL(1, (int)w.turns_forward);
    TEST_ASSERT_EQUAL(1, (int)w.turns_backward);
    assert_cogging(5e-4);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * w.friction_error_Nm, 0.03, w.friction_Nm);
    TEST_ASSERT_TRUE(w.friction_error_Nm > 1e-5 && w.friction_error_Nm < 3e-4);
    TEST_ASSERT_FALSE(kept(3.0)); /* the ripple of the friction */
    record_strokes(10, 1.02, 0.03, 0.01);
    find();
    TEST_ASSERT_TRUE(w.between_turns);
    assert_cogging(3e-4);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * w.friction_error_Nm, 0.03, w.friction_Nm);
}

static void test_one_direction_knows_no_friction(void)
{
    record_strokes(1, 1.02, 0.03, 0.0);
    find();
    TEST_ASSERT_TRUE(isnan(w.friction_Nm));
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, -0.03, w.mean_Nm);
    text_has("only whole turns in one direction are used", w.remark.text);
}

/* The angle of an encoder that flickers by a count does not turn round at each sample. */
static void test_flicker_is_no_reversal(void)
{
    const double count = TURN / 8192.0;
    record_strokes(2, 1.02, 0.03, 0.0);
    for (size_t k = 0; k < run.count; ++k)
        theta_m[k] = count * floor(theta_m[k] / count + 2.0 * gauss());
    find();
    TEST_ASSERT_EQUAL(1, (int)w.turns_forward);
    TEST_ASSERT_EQUAL(1, (int)w.turns_backward);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.03, w.friction_Nm);
}

/* ---- currents ---- */

static void set_iq(size_t k, double iq)
{
    for (int s = 0; s < 3; ++s)
        current[3 * k + (size_t)s] = iq * sin(3.0 * theta_m[k] - TURN * s / 3.0);
}

static void test_the_current_that_holds_is_the_torque(void)
{
    record_strokes(2, 1.02, 0.03, 0.0);
    for (size_t k = 0; k < run.count; ++k) {
        set_iq(k, -torque[k] / 0.08);
        torque[k] = 0.0;
    }
    run.torque_source = HCI_TORQUE_HOLDING;
    refused(HCI_ERROR_INPUT, "--torque-constant");
    options.torque_constant_Nm_per_A = 0.08;
    find();
    assert_cogging(5e-4);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * w.friction_error_Nm, 0.03, w.friction_Nm);
}

static void test_torque_of_a_current_is_taken_away(void)
{
    record_cogging(3000, 2.0, 0.001, 0.0);
    for (size_t k = 0; k < run.count; ++k) {
        set_iq(k, 3.0 + sin(theta_m[k]));
        torque[k] += 0.08 * (3.0 + sin(theta_m[k]));
    }
    find();
    text_has("currents of 2.18 A rms flow", w.remark.text); /* √((9 + 1/2)/2) */
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.08, order_at(1.0 / 3.0)->amplitude);
    options.torque_constant_Nm_per_A = 0.08;
    find();
    assert_cogging(3e-4);
    TEST_ASSERT_FALSE(kept(1.0 / 3.0));
}

/* ---- angles ---- */

static void test_a_wrapped_electrical_angle_has_whole_orders_only(void)
{
    record_cogging(6000, 6.0, 0.001, 0.0);
    run.turn_known = false;
    find();
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, w.step);
    TEST_ASSERT_TRUE(kept(2.0) && kept(6.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.05, order_at(6.0)->amplitude);
    text_has("only whole electrical orders", w.remark.text);
}

/* 25 samples a turn bear 10 mechanical orders; over many turns they lie between each other. */
static void test_turns_with_few_samples_are_put_together(void)
{
    for (int k = 0; k < 10000; ++k) {
        theta_m[k] = TURN * k / 25.037;
        torque[k] = cogging_at(theta_m[k]) + 0.001 * gauss();
    }
    run.count = 10000;
    run.theta_m_rad = theta_m;
    run.torque_Nm = torque;
    options.max_order = 10.0;
    find();
    TEST_ASSERT_EQUAL(30, (int)w.count);
    assert_cogging(4e-4);
    for (int k = 0; k < 10000; ++k)
        theta_m[k] = TURN * k / 51.0; /* the same angles in each turn */
    find();
    TEST_ASSERT_EQUAL(20, (int)w.count);
    text_has("orders above 6.66667 are not looked at", w.remark.text);
}

/* Ten times as many samples in one half of the turn, and an order above those that are looked at: each part
 * of the turn counts as much as it is wide, so that the order stays out of the others. */
static void test_dense_samples_do_not_count_more(void)
{
    for (int k = 0; k < 8800; ++k) {
        theta_m[k] = k < 8000 ? REF_PI * k / 8000.0 : REF_PI * (1.0 + (k - 8000) / 800.0);
        torque[k] = cogging_at(theta_m[k]) + 0.1 * sin(60.0 * theta_m[k]);
    }
    run.count = 8800;
    run.theta_m_rad = theta_m;
    run.torque_Nm = torque;
    options.max_order = 19.0;
    find();
    assert_cogging(1e-4);
}

static void test_points_in_no_order(void)
{
    for (int k = 0; k < 4000; ++k) {
        theta_m[k] = ref_uniform(&seed, 0.0, TURN);
        torque[k] = cogging_at(theta_m[k]) + 0.001 * gauss();
    }
    run.count = 4000;
    run.theta_m_rad = theta_m;
    run.torque_Nm = torque;
    options.max_order = 10.0;
    find();
    assert_cogging(4e-4);
}

static void test_a_part_of_a_turn_needs_orders(void)
{
    const double orders[] = {2.0, 8.0 / 3.0, 6.0};
    record_cogging(800, 0.2, 0.0005, 0.0);
    refused(HCI_ERROR_INPUT, "--orders");
    options.orders = orders;
    options.order_count = 3;
    find();
    for (int k = 0; k < 3; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(0.002, COGGING[k].amplitude, order_at(orders[k])->amplitude);
    text_has("do not go round", w.remark.text);
    record_cogging(800, 0.0001, 0.0, 0.0);
    refused(HCI_ERROR_INPUT, "cannot tell these orders apart");
}

/* Over a third of a turn orders 2 and 8/3 are hard to tell apart, and their errors say so. */
static void test_errors_of_a_part_of_a_turn(void)
{
    const double orders[] = {2.0, 8.0 / 3.0, 6.0}, resemblance[] = {0.0, 0.8};
    for (int kind = 0; kind < 2; ++kind) {
        double sum = 0.0;
        for (int trial = 0; trial < 60; ++trial) {
            record_cogging(1500, 0.3, 0.01, resemblance[kind]);
            options.orders = orders;
            options.order_count = 3;
            find();
            for (int k = 0; k < 2; ++k) {
                const hci_waveform_order *o = order_at(orders[k]);
                const double s =
                    o->amplitude * cos(o->phase_rad) - COGGING[k].amplitude * cos(COGGING[k].phase);
                const double c =
                    o->amplitude * sin(o->phase_rad) - COGGING[k].amplitude * sin(COGGING[k].phase);
                sum += (s * s + c * c) / (2.0 * o->std_error * o->std_error);
            }
        }
        TEST_ASSERT_DOUBLE_WITHIN(0.35, 1.0, sum / 120.0);
    }
}

static void test_given_orders_and_no_others(void)
{
    const double orders[] = {2.0, 6.0, 7.0};
    record_cogging(9000, 6.0, 0.001, 0.0);
    options.orders = orders;
    options.order_count = 3;
    find();
    TEST_ASSERT_EQUAL(3, (int)w.count);
    TEST_ASSERT_EQUAL(3, (int)w.kept);
    TEST_ASSERT_DOUBLE_WITHIN(2e-4, 0.05, order_at(6.0)->amplitude);
    TEST_ASSERT_TRUE(order_at(7.0)->chance > 1e-3);
}

static void test_options_and_runs_that_are_refused(void)
{
    const double zero[] = {0.0}, falling[] = {2.0, 1.0};
    record_cogging(1000, 1.0, 0.0, 0.0);
    options.orders = zero;
    options.order_count = 1;
    refused(HCI_ERROR_ARGUMENT, "order 0");
    options.orders = falling;
    options.order_count = 2;
    refused(HCI_ERROR_ARGUMENT, "ascending");
    options.orders = NULL;
    options.order_count = 0;
    run.torque_Nm = NULL;
    refused(HCI_ERROR_INPUT, "no torque");
    run.theta_m_rad = NULL;
    refused(HCI_ERROR_INPUT, "no angle");
    options.quantity = HCI_WAVEFORM_BACK_EMF;
    refused(HCI_ERROR_INPUT, "no voltages");
    run.v_V = voltage;
    refused(HCI_ERROR_INPUT, "neither a speed nor the time");
    options.pole_pairs = 0;
    refused(HCI_ERROR_ARGUMENT, "pole pairs");
}

/* ---- back-EMF ---- */

static const ref_wave EMF[] = {
    {1.0, 1.0, 0.10, 0.0},
    {3.0, 3.0, 0.01, 0.4},
    {5.0, 5.0, 0.02, -1.0},
    {7.0, 7.0, 0.004, 2.0},
};
enum { EMF_COUNT = 4 };

typedef struct {
    double gain[3], offset_V[3], lag_rad[3]; /* of the channels */
    double noise_V;
    int swapped; /* channels b and c exchanged */
} channels;

static const channels EVEN = {.gain = {1.0, 1.0, 1.0}};

/* Sample k at a mechanical angle and speed; ahead_rad: of the recorded zero of θ. */
static void record_voltage(size_t k, double theta_m_rad, double speed_rad_per_s, const channels *c)
{
    theta_m[k] = theta_m_rad;
    speed[k] = speed_rad_per_s;
    for (int s = 0; s < 3; ++s) {
        const int phase = c->swapped && s > 0 ? 3 - s : s;
        const double e = ref_waves_at(EMF, EMF_COUNT, phase, 3.0 * theta_m_rad - c->lag_rad[s]);
        voltage[3 * k + (size_t)s] = c->gain[s] * speed_rad_per_s * e + c->offset_V[s] + c->noise_V * gauss();
    }
}

/* A drive at `start` rad/s, which changes by `change` rad/s² and ripples by a share of it. */
static void record_drive(int n, double duration_s, double start, double change, const channels *c)
{
    for (int k = 0; k < n; ++k) {
        const double t = duration_s * (k + 0.3 * sin(0.7 * k)) / n;
        time_s[k] = t;
        record_voltage((size_t)k, 0.2 + start * t + 0.5 * change * t * t, start + change * t, c);
    }
    run.count = (size_t)n;
    run.v_V = voltage;
    options.quantity = HCI_WAVEFORM_BACK_EMF;
}

static void with_angle(void)
{
    run.time_s = NULL;
    run.theta_m_rad = theta_m;
    run.speed_rad_per_s = speed;
}

static void without_angle(void)
{
    run.time_s = time_s;
    run.theta_m_rad = run.speed_rad_per_s = NULL;
}

static void assert_emf(double tolerance)
{
    for (int k = 0; k < EMF_COUNT; ++k) {
        const hci_waveform_order *o = order_at(EMF[k].order);
        TEST_ASSERT_TRUE(o->kept);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, EMF[k].amplitude, o->amplitude);
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, 0.0,
                                  EMF[k].amplitude * remainder(EMF[k].phase - o->phase_rad, TURN));
    }
}

static void test_back_emf_with_an_angle(void)
{
    channels c = EVEN;
    c.noise_V = 0.05;
    record_drive(20000, 1.0, 100.0, 0.0, &c);
    with_angle();
    find();
    assert_emf(1e-4);
    TEST_ASSERT_TRUE(w.kept <= 5);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.0, w.speed_rad_per_s);
    TEST_ASSERT_TRUE(isnan(w.frequency_Hz));
    TEST_ASSERT_EQUAL_STRING("", w.remark.text);
    for (int s = 0; s < 3; ++s) {
        TEST_ASSERT_FALSE(w.channel[s].left_out);
        TEST_ASSERT_DOUBLE_WITHIN(5.0 * w.channel[s].ratio_error, 1.0, w.channel[s].ratio);
        TEST_ASSERT_DOUBLE_WITHIN(5.0 * w.channel[s].phase_error, 0.0, w.channel[s].phase_error_rad);
        TEST_ASSERT_DOUBLE_WITHIN(5.0 * w.channel[s].offset_error_V, 0.0, w.channel[s].offset_V);
    }
}

/* A rotor that runs down to a fifth, with offsets that grow against the voltage. */
static void test_back_emf_of_a_run_down(void)
{
    channels c = {.gain = {1.0, 1.0, 1.0}, .offset_V = {5.0, -3.0, 0.0}, .noise_V = 0.02};
    record_drive(40000, 2.0, 100.0, -40.0, &c);
    with_angle();
    find();
    assert_emf(1e-4);
    TEST_ASSERT_DOUBLE_WITHIN(5.0 * w.channel[0].offset_error_V + 1e-3, 5.0, w.channel[0].offset_V);
    TEST_ASSERT_DOUBLE_WITHIN(5.0 * w.channel[1].offset_error_V + 1e-3, -3.0, w.channel[1].offset_V);
    text_has("channel va has an offset of 5 V", w.remark.text);
}

static void test_turned_backward_with_an_angle(void)
{
    record_drive(20000, 1.0, -100.0, 0.0, &EVEN);
    with_angle();
    find();
    assert_emf(1e-5);
    TEST_ASSERT_TRUE(w.turns_backward > 40 && w.turns_forward == 0);
    TEST_ASSERT_EQUAL_STRING("", w.remark.text);
}

static void test_channels_that_differ(void)
{
    const channels c = {
        .gain = {1.0, 9.6, 1.03}, .offset_V = {0.0, 0.0, 1.0}, .lag_rad = {0.0, 0.0, 0.05}, .noise_V = 0.02};
    record_drive(20000, 1.0, 100.0, 0.0, &c);
    with_angle();
    find();
    TEST_ASSERT_TRUE(w.channel[1].left_out && !w.channel[0].left_out && !w.channel[2].left_out);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 9.6 / 1.015, w.channel[1].ratio);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 1.03, w.channel[2].ratio);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, -0.05, w.channel[2].phase_error_rad);
    TEST_ASSERT_DOUBLE_WITHIN(0.1015 * 1e-3, 0.1015, order_at(1.0)->amplitude);
    text_has("channel vb reads 9.46 times the others: a x10 probe?", w.remark.text);
    text_has("channel vc reads 1.03 times the others", w.remark.text);
    text_has("channel vc has an offset of 1 V", w.remark.text);
    text_has("rad off its third of a turn", w.remark.text);
}

static void test_an_angle_with_another_zero_is_told(void)
{
    const channels c = {.gain = {1.0, 1.0, 1.0}, .lag_rad = {0.3, 0.3, 0.3}};
    record_drive(5000, 0.25, 100.0, 0.0, &c);
    with_angle();
    find();
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, -0.3, order_at(1.0)->phase_rad);
    text_has("at -0.3 rad of phase a's fundamental", w.remark.text);
}

/* Does with the angle what the remark says. */
static void follow_the_advice(void)
{
    char direction[16], preposition[8];
    double electrical, mechanical;
    const char *advice = strstr(w.remark.text, "crossing: ");
    TEST_ASSERT_NOT_NULL_MESSAGE(advice, w.remark.text);
    TEST_ASSERT_EQUAL_MESSAGE(4,
                              sscanf(advice, "crossing: %15s %lf rad %7s theta_e (%lf rad", direction,
                                     &electrical, preposition, &mechanical),
                              advice);
    const bool add = strcmp(direction, "add") == 0;
    TEST_ASSERT_EQUAL_STRING(add ? "add" : "subtract", direction);
    TEST_ASSERT_EQUAL_STRING(add ? "to" : "from", preposition);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, electrical / 3.0, mechanical);
    for (size_t k = 0; k < run.count; ++k)
        theta_m[k] += (add ? electrical : -electrical) / 3.0;
}

/* v_a = sin(θ − lag). */
static void test_the_advice_on_the_angle_mends_it(void)
{
    static const double LAG_rad[] = {0.3, -0.3, 1.7, -2.9};
    for (int k = 0; k < 4; ++k) {
        const channels c = {.gain = {1.0, 1.0, 1.0}, .lag_rad = {LAG_rad[k], LAG_rad[k], LAG_rad[k]}};
        record_drive(5000, 0.25, 100.0, 0.0, &c);
        with_angle();
        find();
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, -LAG_rad[k], order_at(1.0)->phase_rad);
        follow_the_advice();
        find();
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, 0.0, order_at(1.0)->phase_rad);
        TEST_ASSERT_EQUAL_STRING("", w.remark.text);
    }
}

/* 2 A peak of a sine. */
static void test_currents_are_told_as_rms_of_a_phase(void)
{
    record_drive(5000, 0.25, 100.0, 0.0, &EVEN);
    with_angle();
    for (size_t k = 0; k < run.count; ++k)
        set_iq(k, 2.0);
    find();
    text_has("currents of 1.41 A rms flow", w.remark.text);
}

/* What sensors make of no current: noise, and an offset that does not turn with the angle. */
static void test_noise_of_sensors_is_no_current(void)
{
    record_drive(5000, 0.25, 100.0, 0.0, &EVEN);
    with_angle();
    uint64_t state = 7;
    for (size_t k = 0; k < 3 * run.count; ++k)
        run.i_A[k] = 0.008 + 0.02 * ref_normal(&state);
    find();
    TEST_ASSERT_NULL_MESSAGE(strstr(w.remark.text, "flow"), w.remark.text);
}

static void test_swapped_phases_are_told(void)
{
    channels c = EVEN;
    c.swapped = 1;
    record_drive(20000, 1.0, 100.0, 0.0, &c);
    with_angle();
    find();
    assert_emf(1e-5);
    text_has("two phases are swapped", w.remark.text);
}

/* 60 periods; to a thousandth of a period at the ends. */
static void test_back_emf_without_an_angle(void)
{
    channels c = EVEN;
    c.noise_V = 0.05;
    record_drive(20000, 1.25, 100.0, 4.0, &c);
    without_angle();
    find();
    assert_emf(2e-4);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 / 1.25, 3.0 * (100.0 + 4.0 * 0.625) / TURN, w.frequency_Hz);
    TEST_ASSERT_DOUBLE_WITHIN(8e-3, 3.0 * 4.0 / TURN, w.drift_Hz_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.0, order_at(1.0)->phase_rad);
}

static void test_frequency_is_exact_without_noise(void)
{
    record_drive(5000, 0.11, 100.0, 30.0, &EVEN);
    without_angle();
    find();
    assert_emf(1e-6);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 3.0 * (100.0 + 30.0 * 0.5 * (time_s[0] + time_s[4999])) / TURN,
                              w.frequency_Hz);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 3.0 * 30.0 / TURN, w.drift_Hz_per_s);
}

/* Few periods, and phases by their labels: the machine has turned the other way. */
static void test_backward_without_an_angle(void)
{
    record_drive(6000, 0.1, -100.0, 0.0, &EVEN);
    without_angle();
    find();
    assert_emf(1e-5);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, -300.0 / TURN, w.frequency_Hz);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, -100.0, w.speed_rad_per_s);
    text_has("taken as turned backward", w.remark.text);
}

static void test_voltages_without_a_period(void)
{
    record_drive(2000, 1.0, 100.0, 0.0, &EVEN);
    without_angle();
    for (size_t k = 0; k < 6000; ++k)
        voltage[k] = gauss();
    refused(HCI_ERROR_INPUT, "without an even period");
    for (size_t k = 0; k < 6000; ++k)
        voltage[k] = 1.0;
    refused(HCI_ERROR_INPUT, "without an even period");
    record_drive(2000, 0.02, 100.0, 0.0, &EVEN);
    refused(HCI_ERROR_INPUT, "without an even period");
}

static void test_one_dead_channel(void)
{
    const channels c = {.gain = {1.0, 0.0, 1.0}};
    record_drive(5000, 0.25, 100.0, 0.0, &c);
    with_angle();
    find();
    TEST_ASSERT_TRUE(w.channel[1].left_out);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, w.channel[1].ratio);
    assert_emf(1e-5);
}

static void test_back_emf_orders_are_whole(void)
{
    const double orders[] = {1.0, 2.5};
    record_drive(5000, 0.25, 100.0, 0.0, &EVEN);
    with_angle();
    options.orders = orders;
    options.order_count = 2;
    refused(HCI_ERROR_ARGUMENT, "whole electrical orders");
}

/* ---- what is written ---- */

static void test_what_is_written_is_a_machine_table(void)
{
    hci_machine_data data;
    files_begin();
    files_write(files_path("machine.csv"), "name,value,unit,source\npole_pairs,3,1,\n");
    record_cogging(1500, 1.0, 0.0, 0.0);
    find();
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_waveform_write(&w, files_root, &note), note.text);
    record_drive(5000, 0.25, 100.0, 0.0, &EVEN);
    with_angle();
    find();
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_waveform_write(&w, files_root, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read(files_root, &data, &note), note.text);
    TEST_ASSERT_EQUAL(COGGING_COUNT, (int)data.model.cogging_count);
    TEST_ASSERT_EQUAL(EMF_COUNT, (int)data.model.back_emf_count);
    double e[3];
    hci_waves_at(data.model.back_emf, data.model.back_emf_count, 1.234, e);
    for (int s = 0; s < 3; ++s)
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, ref_waves_at(EMF, EMF_COUNT, s, 1.234), e[s]);
    hci_machine_release(&data);
    char *json = hci_waveform_json(&w);
    text_has("\"errors_from\":\t\"turns\"", json);
    hci_text_free(json);
    TEST_ASSERT_EQUAL_INT(5, files_count(files_root)); /* machine.csv, two tables, two pictures */
    files_end();
}

static void memory_runs_out(void)
{
    hci_status status = HCI_ERROR_MEMORY;
    long allowed = 0;
    for (; status == HCI_ERROR_MEMORY; ++allowed) {
        hci_note said = {{0}};
        hci_memory_fail_after(allowed);
        status = hci_waveform_find(&run, &options, &w, &said);
        if (status == HCI_ERROR_MEMORY) text_has("memory", said.text);
    }
    hci_memory_fail_after(-1);
    TEST_ASSERT_EQUAL(HCI_OK, status);
    TEST_ASSERT_TRUE(allowed > 8);
    hci_waveform_release(&w);
}

static void test_memory_runs_out_everywhere(void)
{
    const double orders[] = {2.0};
    options.max_order = 4.0;
    record_cogging(600, 1.0, 0.0, 0.0);
    memory_runs_out();
    record_drive(1000, 1.0, 10.0, 0.0, &EVEN);
    without_angle();
    memory_runs_out();
    options = (hci_waveform_options){HCI_WAVEFORM_COGGING, 3, orders, 1, NAN, NAN};
    record_cogging(600, 0.1, 0.0, 0.0);
    memory_runs_out();
}

/* ---- measured ---- */

static hci_run recording;

static bool measured(const char *file, int pole_pairs)
{
    char path[160];
    struct stat info;
    snprintf(path, sizeof path, MEASURED "%s", file);
    if (stat(path, &info) != 0) return false;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK,
                              hci_run_read(path,
                                           &(hci_run_options){.pole_pairs = pole_pairs, .inertia_kgm2 = NAN},
                                           &recording, &note),
                              note.text);
    run = recording;
    options.pole_pairs = pole_pairs;
    return true;
}

/* T-Motor MN4004, 12 pole pairs, 18 slots: K_t 0.0279 N·m/A, Coulomb friction about 0.054 A; cogging at the
 * mechanical orders 12, 18, 24, 36, 72. */
static void test_measured_holding_run(void)
{
    const double expected[] = {12, 18, 24, 36, 72};
    if (!measured("laas_mn4004/hold.csv", 12)) TEST_IGNORE_MESSAGE("no " MEASURED);
    options.torque_constant_Nm_per_A = 0.0279;
    find();
    for (int k = 0; k < 5; ++k)
        TEST_ASSERT_TRUE(kept(expected[k] / 12.0));
    const double largest = order_at(6.0)->amplitude;
    for (size_t k = 0; k < w.count; ++k)
        TEST_ASSERT_TRUE(w.order[k].amplitude <= largest);
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 0.054, w.friction_Nm / 0.0279);
    TEST_ASSERT_EQUAL(1, (int)w.turns_forward);
    TEST_ASSERT_EQUAL(1, (int)w.turns_backward);
    hci_run_release(&recording);
}

/* The same trial at a finer step, and a repeat: amplitudes agree within the errors that are told. */
static void test_measured_repeats_agree(void)
{
    const double orders[] = {7, 12, 14, 28, 36, 84};
    double first[6], error[6];
    if (!measured("odrive_holding_maps/a_16.csv", 7)) TEST_IGNORE_MESSAGE("no " MEASURED);
    options.torque_constant_Nm_per_A = 1.0;
    find();
    for (int k = 0; k < 6; ++k) {
        TEST_ASSERT_TRUE(kept(orders[k] / 7.0));
        first[k] = order_at(orders[k] / 7.0)->amplitude;
        error[k] = order_at(orders[k] / 7.0)->std_error;
    }
    hci_run_release(&recording);
    TEST_ASSERT_TRUE(measured("odrive_holding_maps/b_16.csv", 7));
    find();
    for (int k = 0; k < 6; ++k) {
        const hci_waveform_order *o = order_at(orders[k] / 7.0);
        TEST_ASSERT_DOUBLE_WITHIN(4.0 * hypot(error[k], o->std_error), first[k], o->amplitude);
    }
    hci_run_release(&recording);
}

/* One constant at three speeds; channel c was recorded through a ×10 probe, b has an offset. */
static void test_measured_back_emf(void)
{
    const char *const file[] = {"trampa6340_back_emf/0250rpm.csv", "trampa6340_back_emf/0500rpm.csv",
                                "trampa6340_back_emf/1000rpm.csv"};
    const double rpm[] = {250.0, 500.0, 1000.0};
    options.quantity = HCI_WAVEFORM_BACK_EMF;
    for (int k = 0; k < 3; ++k) {
        if (!measured(file[k], 7)) TEST_IGNORE_MESSAGE("no " MEASURED);
        find();
        TEST_ASSERT_DOUBLE_WITHIN(0.01 * rpm[k], rpm[k], w.speed_rad_per_s * 60.0 / TURN);
        TEST_ASSERT_DOUBLE_WITHIN(0.0004, 0.0381, order_at(1.0)->amplitude);
        TEST_ASSERT_TRUE(w.channel[2].left_out && !w.channel[0].left_out && !w.channel[1].left_out);
        TEST_ASSERT_DOUBLE_WITHIN(0.001, 0.1, w.channel[2].ratio);
        TEST_ASSERT_TRUE(w.channel[1].offset_V < -0.1);
        text_has("channel vc reads 0.0",
                 strstr(w.remark.text, "reads 0.1 ") ? "channel vc reads 0.0" : w.remark.text);
        text_has("a x10 probe?", w.remark.text);
        text_has("channel vb has an offset", w.remark.text);
        hci_run_release(&recording);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_without_noise_cogging_is_exact);
    RUN_TEST(test_standard_errors_are_what_they_say);
    if (MANY_TRIALS) {
        RUN_TEST(test_standard_errors_respect_serial_correlation);
        RUN_TEST(test_standard_errors_respect_drift_between_turns);
        RUN_TEST(test_noise_alone_has_no_orders);
    }
    RUN_TEST(test_orders_that_stand_out_are_kept_and_others_named);
    RUN_TEST(test_friction_drops_out_of_both_directions);
    RUN_TEST(test_one_direction_knows_no_friction);
    RUN_TEST(test_flicker_is_no_reversal);
    RUN_TEST(test_the_current_that_holds_is_the_torque);
    RUN_TEST(test_torque_of_a_current_is_taken_away);
    RUN_TEST(test_a_wrapped_electrical_angle_has_whole_orders_only);
    RUN_TEST(test_turns_with_few_samples_are_put_together);
    RUN_TEST(test_dense_samples_do_not_count_more);
    RUN_TEST(test_points_in_no_order);
    RUN_TEST(test_a_part_of_a_turn_needs_orders);
    RUN_TEST(test_errors_of_a_part_of_a_turn);
    RUN_TEST(test_given_orders_and_no_others);
    RUN_TEST(test_options_and_runs_that_are_refused);
    RUN_TEST(test_back_emf_with_an_angle);
    RUN_TEST(test_back_emf_of_a_run_down);
    RUN_TEST(test_turned_backward_with_an_angle);
    RUN_TEST(test_channels_that_differ);
    RUN_TEST(test_an_angle_with_another_zero_is_told);
    RUN_TEST(test_the_advice_on_the_angle_mends_it);
    RUN_TEST(test_currents_are_told_as_rms_of_a_phase);
    RUN_TEST(test_noise_of_sensors_is_no_current);
    RUN_TEST(test_swapped_phases_are_told);
    RUN_TEST(test_back_emf_without_an_angle);
    RUN_TEST(test_frequency_is_exact_without_noise);
    RUN_TEST(test_backward_without_an_angle);
    RUN_TEST(test_voltages_without_a_period);
    RUN_TEST(test_one_dead_channel);
    RUN_TEST(test_back_emf_orders_are_whole);
    RUN_TEST(test_what_is_written_is_a_machine_table);
    RUN_TEST(test_memory_runs_out_everywhere);
    RUN_TEST(test_measured_holding_run);
    RUN_TEST(test_measured_repeats_agree);
    RUN_TEST(test_measured_back_emf);
    return UNITY_END();
}
