/* Derivatives of a predicted reading by the model's values: those of its torque, sample by sample, up to the
 * first and the last, at samples and between them; and a lag where few samples are in a period. */
#include "host/diagnose/reading/predicted_reading.h"

#include "support/searching.h"

enum { N = 400, TERMS = 4 };

static const double STEP_S = 1e-3;
static hci_predicted_reading reading;

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* At rising speed, so that no two turns are alike; without noise. */
static void record_rising(double slow, double fast, hci_torque_source source)
{
    hci_run *r = add_run(N);
    const double rate = (fast - slow) / (N * STEP_S);
    r->torque_source = source;
    r->torque_window = 5;
    for (size_t k = 0; k < N; ++k) {
        const double t = STEP_S * (double)k;
        r->time_s[k] = t;
        r->speed_rad_per_s[k] = slow + rate * t;
        r->theta_m_rad[k] = 0.2 + slow * t + 0.5 * rate * t * t;
        rec_phases(0.0, 1.0 + 0.5 * sin(30.0 * t), P * r->theta_m_rad[k], r->i_A + 3 * k);
        r->torque_Nm[k] = 0.1;
    }
    search_start();
    TEST_ASSERT_EQUAL_UINT64(1, dataset.samples.segment_count);
}

/* Cogging torque of an order, and friction; the torque is linear in all four. */
static hci_effects linear_effects(hci_effect_term term[TERMS], hci_effect effect[2])
{
    const hci_candidate wave = candidate_of("cogging", "cosine", "sine", 6.0);
    const hci_candidate brake = candidate_of("friction", "coulomb", "viscous", 0.0);
    const double value[TERMS] = {0.03, -0.02, 0.01, 1e-4};
    for (size_t k = 0; k < TERMS; ++k) {
        term[k] = k < 2 ? wave.term[k] : brake.term[k - 2];
        term[k].value = value[k];
    }
    effect[0] = (hci_effect){wave.type, term, 2};
    effect[1] = (hci_effect){brake.type, term + 2, 2};
    return (hci_effects){effect, 2};
}

static void fill(const hci_effects *effects, bool derivatives)
{
    TEST_ASSERT_TRUE(hci_predicted_reading_make(&dataset.regression, effects, derivatives, &reading));
    hci_predicted_reading_fill(&dataset.regression, effects, dataset.samples.segment, &reading);
}

/* Each value by turns one larger: a linear torque is larger by its derivative, but for rounding. */
static void check_linear(void)
{
    hci_effect_term term[TERMS];
    hci_effect effect[2];
    const hci_effects effects = linear_effects(term, effect);
    static double before_Nm[N], by_value[N * TERMS];
    const size_t count = dataset.samples.segment[0].count;
    fill(&effects, true);
    memcpy(before_Nm, reading.torque_Nm, count * sizeof *before_Nm);
    memcpy(by_value, reading.by_value, count * TERMS * sizeof *by_value);
    hci_predicted_reading_release(&reading);
    for (size_t c = 0; c < TERMS; ++c) {
        term[c].value += 1.0;
        fill(&effects, false);
        term[c].value -= 1.0;
        for (size_t k = 0; k < count; ++k)
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, reading.torque_Nm[k] - before_Nm[k], by_value[k * TERMS + c]);
        hci_predicted_reading_release(&reading);
    }
}

static void test_derivatives_at_samples(void)
{
    record_rising(5.0, 30.0, HCI_TORQUE_MEASURED);
    check_linear();
}

/* Order 6 of three pole pairs turns by up to 5 rad from sample to sample of an acceleration. */
static void test_derivatives_between_samples(void)
{
    record_rising(20.0, 280.0, HCI_TORQUE_INERTIA);
    check_linear();
}

/* Of a lag of no duration the derivative is −dT/dt: of a cogging torque 0.1 sin 6θ_e, −0.6 p ω cos 6θ_e, and
 * of the current's 1.5 K (1 + 0.5 sin 30t). */
static void test_a_lag_of_no_duration(void)
{
    const hci_candidate wave = candidate_of("cogging", "sine", NULL, 6.0),
                        lag = candidate_of("torque_sensor", "time_constant", NULL, 0.0);
    hci_effect_term term[2] = {wave.term[0], lag.term[0]};
    term[0].value = 0.1;
    const hci_effect effect[2] = {{wave.type, term, 1}, {lag.type, term + 1, 1}};
    const hci_effects effects = {effect, 2};
    record_rising(1.0, 3.0, HCI_TORQUE_MEASURED);
    dataset.samples.segment[0].smooth = true; /* its readings are free of noise */
    TEST_ASSERT_TRUE(hci_predicted_reading_is_dynamic(&dataset.regression, dataset.samples.segment));
    fill(&effects, true);
    for (size_t k = 0; k < N; ++k) {
        const double by_s = 6.0 * P * run[0].speed_rad_per_s[k], turn = by_s * STEP_S;
        const double expected = -0.1 * by_s * cos(6.0 * P * run[0].theta_m_rad[k]) -
                                1.5 * K_NM_PER_A * 15.0 * cos(30.0 * run[0].time_s[k]);
        const bool is_end = k == 0 || k + 1 == N; /* there from one side, with half a step of the curvature */
        TEST_ASSERT_DOUBLE_WITHIN(0.1 * by_s * (is_end ? 0.6 * turn : 0.2 * turn * turn) + 1e-3, expected,
                                  reading.by_value[2 * k + 1]);
    }
    hci_predicted_reading_release(&reading);
}

/* Four turns of a shaft that hardly accelerates, as one mean turn: what a constant current makes of the
 * torque is the same all around, whatever window a slope is taken over, and beside it the derivatives are
 * those of the torque. */
static void test_a_free_shaft_at_a_steady_speed(void)
{
    enum { TURN = 2000 };
    const double speed = 50.0, iq_A = 2.0, declared = 1.5 * K_NM_PER_A * iq_A;
    hci_run *r = add_run(4 * TURN);
    r->torque_source = HCI_TORQUE_INERTIA;
    r->hardly_accelerates = true;
    r->torque_window = 9;
    for (size_t k = 0; k < r->count; ++k) {
        r->theta_m_rad[k] = 2.0 * REF_PI * ((double)k + 0.5) / TURN;
        r->time_s[k] = r->theta_m_rad[k] / speed;
        r->speed_rad_per_s[k] = speed;
        rec_phases(0.0, iq_A, P * r->theta_m_rad[k], r->i_A + 3 * k);
    }
    search_start();
    const hci_segment *segment = dataset.samples.segment;
    TEST_ASSERT_TRUE(segment->turns > 0);
    hci_effect_term term[TERMS];
    hci_effect effect[2];
    const hci_effects effects = linear_effects(term, effect);
    fill(&effects, true);
    TEST_ASSERT_NOT_NULL(reading.current_Nm);
    for (size_t k = 0; k < segment->count; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, declared, reading.current_Nm[k]);
    hci_predicted_reading_release(&reading);
}

/* ---- a lag at two or three samples in a period ---- */

enum { LONG = 4200 };

static const double FAST_RAD_PER_S = 134.0, LAG_S = 2e-4, WAVE_NM = 0.1;

/* samples_of_turn of them; faster at the end by so much of the speed. */
static void record_fast(size_t n, double samples_of_turn, double rise)
{
    hci_run *r = add_run(n);
    for (size_t k = 0; k < n; ++k) {
        const double turns = (double)k / samples_of_turn, share = (double)k / (double)n;
        r->theta_m_rad[k] = 2.0 * REF_PI * turns * (1.0 + 0.5 * rise * share);
        r->time_s[k] = 2.0 * REF_PI * turns / FAST_RAD_PER_S;
        r->speed_rad_per_s[k] = FAST_RAD_PER_S * (1.0 + rise * share);
        rec_phases(0.0, 0.0, P * r->theta_m_rad[k], r->i_A + 3 * k);
        r->torque_Nm[k] = 0.01 * sin(3.0 * r->theta_m_rad[k]);
    }
    search_start();
    dataset.samples.segment[0].smooth = true;
}

/* A wave of order 6 of three pole pairs through a lag is smaller by 1/sqrt(1 + (wτ)²) and later by atan wτ;
 * where a sample is the mean over angles, smaller by half their variance times the square of its periods in a
 * turn again. From one sample on, before which the sensor settles. */
static void check_lag(size_t first)
{
    const hci_candidate wave = candidate_of("cogging", "sine", NULL, 6.0),
                        lag = candidate_of("torque_sensor", "time_constant", NULL, 0.0);
    hci_effect_term term[2] = {wave.term[0], lag.term[0]};
    term[0].value = WAVE_NM;
    term[1].value = LAG_S;
    const hci_effect effect[2] = {{wave.type, term, 1}, {lag.type, term + 1, 1}};
    const hci_effects effects = {effect, 2};
    const hci_segment *segment = dataset.samples.segment;
    fill(&effects, true);
    for (size_t k = first; k + 1 < segment->count; ++k) {
        const hci_binned_sample *x = &dataset.samples.sample[segment->first + k];
        const double w = 6.0 * P * x->reading.speed_rad_per_s * LAG_S, n = 6.0 * P;
        const double mean = 1.0 - 0.5 * n * n * x->spread_rad2;
        const double expected = mean * sin(n * x->reading.theta_m_rad - atan(w)) / sqrt(1.0 + w * w);
        TEST_ASSERT_DOUBLE_WITHIN(0.02 * WAVE_NM, WAVE_NM * expected, reading.torque_Nm[k]);
        TEST_ASSERT_DOUBLE_WITHIN(0.02, expected, reading.by_value[2 * k]);
    }
    hci_predicted_reading_release(&reading);
}

static void test_a_lag_between_samples(void)
{
    record_fast(N, 46.8, 0.1);
    TEST_ASSERT_EQUAL_UINT64(0, dataset.samples.segment[0].turns);
    check_lag(60);
}

/* The samples of each of ninety turns lie where those of the turn before lie, but for a little. */
static void test_a_lag_of_a_mean_turn_of_few_angles(void)
{
    record_fast(LONG, 46.002, 0.0);
    TEST_ASSERT_TRUE(dataset.samples.segment[0].turns > 0);
    TEST_ASSERT_TRUE(dataset.samples.segment[0].count < 300);
    TEST_ASSERT_TRUE(dataset.samples.sample[5].spread_rad2 > 0.0);
    check_lag(0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_derivatives_at_samples);
    RUN_TEST(test_derivatives_between_samples);
    RUN_TEST(test_a_lag_of_no_duration);
    RUN_TEST(test_a_free_shaft_at_a_steady_speed);
    RUN_TEST(test_a_lag_between_samples);
    RUN_TEST(test_a_lag_of_a_mean_turn_of_few_angles);
    return UNITY_END();
}
