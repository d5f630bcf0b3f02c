/* Statistics of a recording against their closed forms, for samples that are made up of sines and constants.
 */
#include "host/check/data/run_samples.h"

#include <math.h>
#include <string.h>

#include "unity.h"

enum { N = 240 }; /* whole periods of all waves */

#define PI 3.14159265358979323846
static const double TIGHT = 1e-12, DT_S = 0.01;

static double column[16][N];
static check_vector vector[2][N];
static check_samples s;
static check_run run;
static const double *const NONE[3];

void setUp(void)
{
    s = (check_samples){.count = N, .phase = NONE, .volt = NONE};
    memset(&run, 0, sizeof run);
    memset(column, 0, sizeof column);
}

void tearDown(void)
{
}

/* constant + amplitude·cos(2π·periods·k/N + phase) */
static const double *wave(int which, double constant, double amplitude, int periods, double phase)
{
    for (size_t k = 0; k < N; ++k)
        column[which][k] = constant + amplitude * cos(2.0 * PI * periods * (double)k / N + phase);
    return column[which];
}

static const double *ramp(int which, double from, double step, double range)
{
    for (size_t k = 0; k < N; ++k)
        column[which][k] = range > 0.0 ? fmod(from + step * (double)k, range) : from + step * (double)k;
    return column[which];
}

/* ---- angles */

/* An electrical angle that goes from 0 to 0.8 turns between samples: wrapped steps of what is more than half
 * a turn go backward, and the speed tells how far they went. */
static void test_an_angle_too_coarse_to_unwrap(void)
{
    const double turn = 2.0 * 3.14159265358979323846;
    double theta = 0.3, path = 0.0;
    s.time = ramp(0, 0.0, DT_S, 0.0);
    s.speed = ramp(2, 0.0, 0.8 * turn / DT_S / 23.0 / N, 0.0);
    for (int k = 0; k < N; ++k) {
        const double step = k > 0 ? 0.5 * 23.0 * DT_S * (column[2][k] + column[2][k - 1]) : 0.0;
        theta += step, path += step;
        column[1][k] = fmod(theta, turn);
    }
    s.theta = column[1];
    run.is_electrical = true;
    run.declared_pole_pairs = 23.0;
    hci_check_run_means(&s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * path, path / (DT_S * (N - 1)), run.angle_rate);
    for (int k = 0; k < N; ++k)
        column[2][k] *= 9.549; /* of another unit, which the angle does not follow */
    hci_check_run_means(&s, &run);
    TEST_ASSERT_FALSE(fabs(run.angle_rate * DT_S * (N - 1) - path) < 0.1 * path);
}

/* An angle that goes on at 50 rad/s in a second that was not recorded, and stands where it likes behind it.
 */
static void test_rates_beside_a_gap(void)
{
    s.time = ramp(0, 3.0, DT_S, 0.0);
    s.theta = ramp(1, 0.25, 0.5, 0.0);
    s.speed = ramp(2, 50.0, 0.0, 0.0);
    for (size_t k = N / 2; k < N; ++k)
        column[0][k] += 60.0, column[1][k] -= 3.0;
    s.gap_s = 20.0 * DT_S;
    hci_check_run_means(&s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5 / DT_S, run.angle_rate);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 50.0, run.speed_over_time);
}

/* An angle that is wrapped at 7 goes on at 0.5 a sample; the steps at its wraps are left out. */
static void test_rates_of_an_angle(void)
{
    s.time = ramp(0, 3.0, DT_S, 0.0);
    s.theta = ramp(1, 0.25, 0.5, 7.0);
    s.speed = ramp(2, 40.0, 0.1, 0.0);
    hci_check_run_means(&s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5 / DT_S, run.angle_rate);
    TEST_ASSERT_DOUBLE_WITHIN(TIGHT, 6.5, run.angle_range); /* 0.25 to 6.75 */
    double sum = 0.0, steps = 0.0;                          /* the mean speed over the steps that are left */
    for (int k = 1; k < N; ++k)
        if (s.theta[k] > s.theta[k - 1]) {
            sum += 40.0 + 0.1 * (k - 0.5);
            steps += 1.0;
        }
    TEST_ASSERT_TRUE(steps < N - 1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sum / steps, run.speed_over_time);
    TEST_ASSERT_TRUE(isnan(run.angle_ratio));
    TEST_ASSERT_TRUE(isnan(run.current_order) && isnan(run.voltage_order));
}

/* Samples that do not follow the one before them are left out too; without time, with two samples, or with an
 * angle that jumps there are no rates. */
static void test_rates_that_are_not_known(void)
{
    bool follows[N];
    s.follows = follows;
    s.time = ramp(0, 0.0, DT_S, 0.0);
    s.theta = ramp(1, 0.0, 0.5, 0.0);
    for (size_t k = 0; k < N; ++k) {
        follows[k] = k != 100;
        column[1][k] += k < 100 ? 0.0 : 40.0;
    }
    hci_check_run_means(&s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5 / DT_S, run.angle_rate);
    TEST_ASSERT_TRUE(isnan(run.speed_over_time));
    s.follows = NULL;
    s.time = NULL;
    hci_check_run_means(&s, &run);
    TEST_ASSERT_TRUE(isnan(run.angle_rate));
    s.time = ramp(0, 0.0, DT_S, 0.0);
    s.count = 2;
    hci_check_run_means(&s, &run);
    TEST_ASSERT_TRUE(isnan(run.angle_rate));
    s.count = 3;
    column[1][1] = 0.2;
    column[1][2] = 1.0; /* four fifths of the range: wrapped */
    hci_check_run_means(&s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.2 / DT_S, run.angle_rate);
    s.count = N;
    s.theta = ramp(1, 0.0, 3.0, 7.0); /* steps of 3 and of −4 */
    hci_check_run_means(&s, &run);
    TEST_ASSERT_TRUE(isnan(run.angle_rate));
}

/* θ_e = 4 θ_m + 1, either of them wrapped. */
static void test_ratio_of_two_angles(void)
{
    s.theta = ramp(1, 1.0, 0.4, 2.0 * PI);
    s.other = ramp(2, 0.0, 0.1, 2.0 * PI);
    hci_check_run_means(&s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 4.0, run.angle_ratio);
    s.other = ramp(2, 0.0, -0.1, 0.0);
    hci_check_run_means(&s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -4.0, run.angle_ratio);
    s.other = wave(2, 1.0, 0.0, 0, 0.0);
    hci_check_run_means(&s, &run);
    TEST_ASSERT_TRUE(isnan(run.angle_ratio));
}

/* ---- speed and torque */

/* speed = 50 + 0.1 k: the mean of the last 49 samples less that of the first ones is 0.1 · 191. */
static void test_speed(void)
{
    s.speed = ramp(2, 50.0, 0.1, 0.0);
    hci_check_run_means(&s, &run);
    const double mean = 50.0 + 0.1 * (N - 1) / 2.0;
    TEST_ASSERT_TRUE(run.has_speed);
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, mean, run.speed);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 * (N - 49) / mean, run.speed_change);
    s.speed = wave(2, 1.0, 8.0, 4, 0.3); /* a mean of 1 beside an rms of √33 is noise */
    hci_check_run_means(&s, &run);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, run.speed);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, run.speed_change);
    s.speed = wave(2, -1.0, 4.0, 4, 0.3); /* 1 beside 3 is more than 0.3 */
    hci_check_run_means(&s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -1.0, run.speed);
    s.speed = NULL;
    hci_check_run_means(&s, &run);
    TEST_ASSERT_TRUE(isnan(run.speed) && !run.has_speed);
}

/* Power over speed: (M + m cos)(ω + w cos) has the mean Mω + mw/2. */
static void test_torque(void)
{
    s.torque = wave(3, 2.0, 0.6, 5, 0.2);
    hci_check_run_means(&s, &run);
    TEST_ASSERT_TRUE(run.has_torque && !run.is_held);
    TEST_ASSERT_DOUBLE_WITHIN(TIGHT, 2.0, run.torque_at_speed);
    s.speed = wave(2, 30.0, 4.0, 5, 0.2);
    hci_check_run_means(&s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(TIGHT, 2.0 + 0.5 * 0.6 * 4.0 / 30.0, run.torque_at_speed);
    run.torque = column[3];
    run.count = N;
    hci_check_run_ripple(&run);
    TEST_ASSERT_DOUBLE_WITHIN(TIGHT, 2.0, run.torque_mean);
    TEST_ASSERT_DOUBLE_WITHIN(TIGHT, 0.18, run.torque_variance);
    s.torque = wave(3, 0.0, 0.0, 0, 0.0);
    hci_check_run_means(&s, &run);
    TEST_ASSERT_FALSE(run.has_torque || run.is_held);
    s.q = wave(4, 1.0, 0.0, 0, 0.0);
    hci_check_run_means(&s, &run);
    TEST_ASSERT_TRUE(run.is_held && !run.has_torque);
}

/* Below 3 rad/s, within a fifth of the mean, and without a load: i_q whose mean is not more than four times
 * its rms of variation. */
static void test_what_turns_steadily(void)
{
    static const struct {
        double mean, wave;
        bool is_steady;
    } CASE[] = {{2.0, 0.5, true},  {-2.0, 0.5, true}, {2.9, 0.1, true}, {3.1, 0.1, false},
                {2.0, 0.6, false}, {1.0, 0.27, true}, {1.0, 0.3, false}};
    s.theta = ramp(1, 0.0, 0.02, 0.0);
    s.q = wave(4, 1.0, 0.36, 6, 0.0);
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        s.speed = wave(2, CASE[k].mean, CASE[k].wave, 3, 1.0);
        hci_check_run_means(&s, &run);
        TEST_ASSERT_EQUAL(CASE[k].is_steady, run.turns_steadily);
    }
    s.speed = wave(2, 2.0, 0.1, 3, 1.0);
    s.q = wave(4, 1.0, 0.35, 6, 0.0); /* 1 of 0.2475 */
    hci_check_run_means(&s, &run);
    TEST_ASSERT_FALSE(run.turns_steadily);
    s.q = wave(4, 1.0, 0.36, 6, 0.0); /* of 0.2546 */
    hci_check_run_means(&s, &run);
    TEST_ASSERT_TRUE(run.turns_steadily);
    s.torque = column[4];
    hci_check_run_means(&s, &run);
    TEST_ASSERT_FALSE(run.turns_steadily);
    s.torque = s.theta = NULL;
    hci_check_run_means(&s, &run);
    TEST_ASSERT_FALSE(run.turns_steadily);
}

/* ---- currents and voltages */

/* i_d = −1 + 0.5 cos, i_q = 3 + 0.8 cos of the same wave. */
static void test_dq_currents(void)
{
    s.d = wave(3, -1.0, 0.5, 6, 0.4);
    s.q = wave(4, 3.0, 0.8, 6, 0.4);
    hci_check_run_means(&s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(TIGHT, -1.0, run.dq.re);
    TEST_ASSERT_DOUBLE_WITHIN(TIGHT, 3.0, run.dq.im);
    TEST_ASSERT_DOUBLE_WITHIN(TIGHT, 1.0 + 0.125 + 9.0 + 0.32, run.current_square);
    TEST_ASSERT_DOUBLE_WITHIN(TIGHT, -3.0 + 0.2, run.product_dq);
    TEST_ASSERT_TRUE(run.dq_is_steady && !run.lacks_d_current);
    s.q = wave(4, 1.0, 2.0, 5, 0.0); /* |mean|² = 2 of 1.125 + 3 */
    hci_check_run_means(&s, &run);
    TEST_ASSERT_FALSE(run.dq_is_steady);
    s.d = NULL;
    hci_check_run_means(&s, &run);
    TEST_ASSERT_TRUE(run.lacks_d_current);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, run.dq.re);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, run.product_dq);
    TEST_ASSERT_DOUBLE_WITHIN(TIGHT, 3.0, run.current_square);
}

/* Three per cent of the rms. */
static void test_no_d_current(void)
{
    s.q = wave(4, 2.0, 0.0, 0, 0.0);
    for (int k = 0; k < 2; ++k) {
        s.d = wave(3, k ? 0.061 : -0.059, 0.0, 0, 0.0);
        hci_check_run_means(&s, &run);
        TEST_ASSERT_EQUAL(k == 0, run.lacks_d_current);
    }
}

/* Three sinusoids a third of a period apart, phase b of 1.5 times the size and all on top of 0.2. */
static void test_phase_currents(void)
{
    const double *phase[] = {wave(5, 0.2, 2.0, 8, 0.0), wave(6, 0.2, 3.0, 8, -2.0 * PI / 3.0),
                             wave(7, 0.2, 2.0, 8, 2.0 * PI / 3.0)};
    s.phase = phase;
    hci_check_run_means(&s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5, run.current_balance);
    /* the sum is 0.6 + cos, that of the squares 3·0.04 + (4 + 9 + 4)/2 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt((0.36 + 0.5) / (0.12 + 8.5)), run.current_sum);
    TEST_ASSERT_TRUE(isnan(run.frequency));
    for (size_t k = 0; k < N; ++k) /* a thousandth of it is as uneven */
        for (int p = 5; p < 8; ++p)
            column[p][k] *= 1e-3;
    hci_check_run_means(&s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5, run.current_balance);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt((0.36 + 0.5) / (0.12 + 8.5)), run.current_sum);
    for (int p = 0; p < 3; ++p) { /* any of the three may be missing */
        const double *const there = phase[p];
        phase[p] = NULL;
        hci_check_run_means(&s, &run);
        TEST_ASSERT_TRUE(isnan(run.current_balance) && isnan(run.current_sum));
        phase[p] = there;
    }
    phase[2] = wave(7, 1.0, 0.0, 0, 0.0);
    hci_check_run_means(&s, &run);
    TEST_ASSERT_FALSE(run.current_balance < 1e6); /* the least is rounding, or none */
}

/* Current 2 A behind a voltage of 10 V by 0.5 rad: S = 20 e^{j0.5}. */
static void test_power_and_frequency_of_phases(void)
{
    s.time = ramp(0, 0.0, DT_S, 0.0);
    s.current = vector[0];
    s.voltage = vector[1];
    for (size_t k = 0; k < N; ++k) {
        const double x = 2.0 * PI * 6.0 * (double)k / N;
        vector[0][k] = (check_vector){2.0 * cos(x - 0.5), 2.0 * sin(x - 0.5)};
        vector[1][k] = (check_vector){10.0 * cos(x), 10.0 * sin(x)};
    }
    hci_check_run_means(&s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0 * PI * 6.0 / (N * DT_S), run.frequency);
    TEST_ASSERT_DOUBLE_WITHIN(1e-11, 4.0, run.current_square);
    TEST_ASSERT_DOUBLE_WITHIN(1e-11, 100.0, run.voltage_square);
    TEST_ASSERT_DOUBLE_WITHIN(1e-11, 20.0 * cos(0.5), run.power.re);
    TEST_ASSERT_DOUBLE_WITHIN(1e-11, 20.0 * sin(0.5), run.power.im);
    TEST_ASSERT_TRUE(isnan(run.voltage_balance));
    bool follows[N];
    for (size_t k = 0; k < N; ++k)
        follows[k] = k != 120;
    for (size_t k = 120; k < N; ++k) /* a jump of a quarter of a turn where a part was cut out */
        vector[1][k] = (check_vector){-vector[1][k].im, vector[1][k].re};
    s.follows = follows;
    hci_check_run_means(&s, &run);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0 * PI * 6.0 / (N * DT_S), run.frequency);
    s.count = 2;
    hci_check_run_means(&s, &run);
    TEST_ASSERT_TRUE(isnan(run.frequency));
}

/* v = R i + jω(L i) + jωk with a speed that varies: Σ v ω / Σ |ω| is the same equation of the sums. */
static void test_voltages_weighted_by_speed(void)
{
    const double r = 0.7, l = 0.02, k_e = 0.3, w = 100.0, dw = 30.0;
    s.speed = wave(2, -w, dw, 4, 0.0);
    s.d = wave(3, -1.0, 0.0, 0, 0.0);
    s.q = wave(4, 3.0, 0.0, 0, 0.0);
    s.vd = column[5];
    s.vq = column[6];
    for (size_t k = 0; k < N; ++k) {
        column[5][k] = r * s.d[k] - s.speed[k] * l * s.q[k];
        column[6][k] = r * s.q[k] + s.speed[k] * (l * s.d[k] + k_e);
    }
    hci_check_run_means(&s, &run);
    const check_voltage_terms t = run.terms;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, (w * w + 0.5 * dw * dw) / w, t.speed);
    TEST_ASSERT_DOUBLE_WITHIN(1e-11, 1.0, t.current.re); /* Σ ω/|ω| = −1 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-11, -3.0, t.current.im);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -t.speed, t.speed_current.re);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3.0 * t.speed, t.speed_current.im);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, r * t.current.re - l * t.speed_current.im, t.voltage.re);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, r * t.current.im + l * t.speed_current.re + k_e * t.speed, t.voltage.im);
    /* mean v conj(i) by mean(v): both currents are constant */
    const double vd = r * -1.0 + w * l * 3.0, vq = r * 3.0 - w * (-l + k_e);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -vd + 3.0 * vq, run.power.re);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -vq - 3.0 * vd, run.power.im);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, vd * vd + vq * vq + 0.5 * dw * dw * (9.0 * l * l + (k_e - l) * (k_e - l)),
                              run.voltage_square);
    TEST_ASSERT_TRUE(run.dq_voltage_is_coherent);
    for (size_t k = 0; k < N; ++k) /* a speed without sign beside voltages with one */
        column[5][k] *= k % 2 ? 1.0 : -1.0, column[6][k] *= k % 2 ? 1.0 : -1.0;
    hci_check_run_means(&s, &run);
    TEST_ASSERT_FALSE(run.dq_voltage_is_coherent);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_angle_too_coarse_to_unwrap);
    RUN_TEST(test_rates_of_an_angle);
    RUN_TEST(test_rates_beside_a_gap);
    RUN_TEST(test_rates_that_are_not_known);
    RUN_TEST(test_ratio_of_two_angles);
    RUN_TEST(test_speed);
    RUN_TEST(test_torque);
    RUN_TEST(test_what_turns_steadily);
    RUN_TEST(test_dq_currents);
    RUN_TEST(test_no_d_current);
    RUN_TEST(test_phase_currents);
    RUN_TEST(test_power_and_frequency_of_phases);
    RUN_TEST(test_voltages_weighted_by_speed);
    return UNITY_END();
}
