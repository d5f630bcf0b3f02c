/* Readings that were smoothed, against the motion and the currents before noise and encoder. */
#include "host/diagnose/prepare/binned_samples.h"
#include "support/recording.h"
#include "unity.h"

enum { P = 3, MOST = 4000 };

static const hci_machine MACHINE = {.pole_pairs = P};

static uint64_t seed;
static hci_run run;
static hci_binned_samples binned;
static double truth[2 * MOST]; /* mechanical angle, rad */
static double once;            /* how much of what is once a turn the currents have */

void setUp(void)
{
    seed = 12;
    once = 1.0;
}

void tearDown(void)
{
    hci_binned_samples_release(&binned);
    rec_release(&run);
}

static void reduce(void)
{
    hci_note note = {{0}};
    hci_binned_samples_release(&binned);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_binned_samples_make(&MACHINE, NAN, &run, 1, &binned, &note),
                                  note.text);
    TEST_ASSERT_EQUAL_UINT64(1, binned.segment_count);
}

/* Constant speed with a ripple of the angle, ripple_rad sin(order·ωt). */
static void turn(size_t n, double samples, double speed, double order, double ripple_rad)
{
    rec_release(&run);
    run = rec_make(n);
    for (size_t k = 0; k < n; ++k) {
        const double t = (double)k * 2.0 * REF_PI / samples / fabs(speed);
        truth[k] = speed * t + ripple_rad * sin(order * speed * t);
        run.time_s[k] = t;
        run.theta_m_rad[k] = truth[k];
        run.speed_rad_per_s[k] = speed * (1.0 + ripple_rad * order * cos(order * speed * t));
        rec_phases(0.0, 3.0, P * truth[k], run.i_A + 3 * k);
    }
}

/* ---- angle ---- */

static double angle_error(size_t from, size_t to)
{
    double square = 0.0;
    for (size_t k = from; k < to; ++k)
        square += pow(binned.sample[k].reading.theta_m_rad - truth[k], 2.0);
    return sqrt(square / (double)(to - from));
}

/* The error of a step q is q/√12, and that of the value in the middle of a parabola through 2m + 1 = 21 such
 * points smaller by √(3(3m² + 3m − 1)/((2m − 1)(2m + 1)(2m + 3))) = 0.328. */
static void test_steps_of_an_encoder(void)
{
    const double step = 2.0 * REF_PI / 1024.0;
    turn(MOST, 390.17, 80.0, 0.0, 0.0);
    for (size_t k = 0; k < MOST; ++k) { /* at uneven times, so that one error says nothing of the next */
        run.time_s[k] += ref_uniform(&seed, -0.4, 0.4) * 2.0 * REF_PI / 390.17 / 80.0;
        truth[k] = 80.0 * run.time_s[k];
        run.theta_m_rad[k] = step * (floor(truth[k] / step) + 0.5);
    }
    reduce();
    const double error = angle_error(10, MOST - 10) / (step / sqrt(12.0));
    TEST_ASSERT_DOUBLE_WITHIN(0.15 * 0.328, 0.328,
                              error); /* 190 values that do not depend on each other: ± 5 % */
    TEST_ASSERT_EQUAL_DOUBLE(run.theta_m_rad[777], binned.sample[777].raw.theta_m_rad);
    TEST_ASSERT_TRUE(angle_error(0, 10) < 0.01 && angle_error(MOST - 10, MOST) < 0.01);
}

static void test_motion_is_not_distorted(void)
{
    turn(MOST, 400.0, -80.0, 0.0, 0.0);
    reduce();
    TEST_ASSERT_TRUE(angle_error(0, MOST) < 1e-12);
    /* x⁴/24 loses 3/35 (m + 1/2)⁴ in the middle of such a parabola; of a ripple that repeats with the turn
     * that is put back. */
    turn(MOST, 480.0, 80.0, 4.0, 0.01);
    reduce();
    const double lost = 0.01 * pow(10.5 * 8.0 * REF_PI / 480.0, 4.0) * 3.0 / 35.0 / 24.0;
    TEST_ASSERT_TRUE(angle_error(10, MOST - 10) < 0.02 * lost);
}

/* An encoder of seven lines in a turn of three pole pairs, which errs twice and four times in each of them,
 * with 60 samples in a turn: what was read stays, and its noise does not. */
static void test_errors_between_lines_stay(void)
{
    const double error_rad = 0.004, noise_rad = 0.002;
    turn(1500, 60.0, 50.0, 1.0, 0.0);
    for (size_t k = 0; k < run.count; ++k) {
        truth[k] += error_rad * (sin(14.0 * truth[k] + 0.3) + 0.5 * cos(28.0 * truth[k]));
        run.theta_m_rad[k] = truth[k] + noise_rad * ref_normal(&seed);
    }
    reduce();
    TEST_ASSERT_TRUE(angle_error(20, run.count - 20) < 0.5 * noise_rad);
}

/* An error of a resolver, with twelve samples in an electrical period and white noise: it is what was read,
 * and stays; the noise does not. */
static void test_errors_that_repeat_stay(void)
{
    const double error_rad = 0.01, noise_rad = 0.002;
    turn(1500, 12.0 * P, 50.0, 1.0, 0.0);
    for (size_t k = 0; k < run.count; ++k) {
        truth[k] += error_rad * (sin(2.0 * P * truth[k] + 0.3) + 0.5 * cos(P * truth[k]));
        run.theta_m_rad[k] = truth[k] + noise_rad * ref_normal(&seed);
    }
    reduce();
    TEST_ASSERT_TRUE(angle_error(20, run.count - 20) < 0.5 * noise_rad);
}

/* Turning points, standstill and samples without time stay as they are. */
static void test_what_is_not_smoothed(void)
{
    for (int what = 0; what < 3; ++what) {
        turn(500, 400.0, 50.0, 2.0, 0.01);
        for (size_t k = 0; k < 500; ++k) {
            run.theta_m_rad[k] += 0.01 * ref_normal(&seed);
            if (what == 0 && k > 250) run.speed_rad_per_s[k] *= -1.0;
            if (what == 1) run.speed_rad_per_s[k] = 0.0;
        }
        if (what == 2) free(run.time_s);
        if (what == 2) run.time_s = NULL;
        reduce();
        for (size_t k = 0; k < 500; ++k)
            TEST_ASSERT_EQUAL_DOUBLE(run.theta_m_rad[k], binned.sample[k].reading.theta_m_rad);
    }
}

/* ---- currents ---- */

/* Fifth and seventh harmonics, which are of order 6 in the rotor frame, one of once a turn, which is order
 * 1/p, and their derivatives by the mechanical angle. */
static void current(double theta_m, int derivative, double *d, double *q)
{
    const double shift = derivative * REF_PI / 2.0, six = pow(6.0 * P, derivative);
    *d = 0.3 * six * cos(6.0 * P * theta_m + shift) + 0.1 * once * sin(theta_m + shift) +
         (derivative == 0 ? -1.0 : 0.0);
    *q = 0.2 * six * sin(6.0 * P * theta_m + 0.4 + shift) + 0.15 * once * cos(theta_m + shift) +
         (derivative == 0 ? 3.0 : 0.0);
}

static void flow(double noise_A)
{
    for (size_t k = 0; k < run.count; ++k) {
        double d, q;
        current(run.theta_m_rad[k], 0, &d, &q);
        rec_phases(d, q, P * run.theta_m_rad[k], run.i_A + 3 * k);
        for (int s = 0; s < 3; ++s)
            run.i_A[3 * k + (size_t)s] += noise_A * ref_normal(&seed);
    }
}

/* Mean square of i_d and i_q less the truth, per axis. */
static double current_error(bool raw)
{
    double square = 0.0;
    for (size_t k = 0; k < binned.count; ++k) {
        const hci_binned_sample *c = &binned.sample[k];
        double d, q, d0, q0;
        rec_rotor(raw ? c->raw.i_abc : c->reading.i_abc, P * c->raw.theta_m_rad, &d, &q);
        current(c->raw.theta_m_rad, 0, &d0, &q0);
        square += 0.5 * ((d - d0) * (d - d0) + (q - q0) * (q - q0)) / (double)binned.count;
    }
    return square;
}

/* Some torque per ampere, of a torque sensor without noise. */
static void load(void)
{
    for (size_t k = 0; k < run.count; ++k)
        run.torque_Nm[k] = 1.5;
}

/* Coefficients of MOST samples keep that share of the variance, 2/3 of that of a phase: 21 orders of the
 * turn, electrical ones to 24 and the mean are 77, 49 without a turn. Beside a torque that is measured more
 * exactly those alone stay that stand out: the mean, order 6 and once a turn. */
static void noise_stays(bool turns, bool loaded, double share, double trials)
{
    const double variance = 0.05 * 0.05 * 2.0 / 3.0;
    double before = 0.0, after = 0.0;
    once = turns;
    for (int k = 0; k < (int)trials; ++k) {
        turn(MOST, 400.0, 50.0, 0.0, 0.0);
        flow(0.05);
        if (loaded) load();
        run.turn_known = turns;
        reduce();
        before += current_error(true) / trials;
        after += current_error(false) / trials;
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.03 * variance, variance, before);
    TEST_ASSERT_DOUBLE_WITHIN((loaded ? 0.3 : 0.2) * share * variance, share * variance, after);
}

static void test_noise_of_currents(void)
{
    noise_stays(true, false, 77.0 / MOST, 5.0);
    noise_stays(false, false, 49.0 / MOST, 5.0);
    noise_stays(true, true, 5.0 / MOST, 20.0); /* of 120 coefficients: ± 13 % */
    noise_stays(false, true, 3.0 / MOST, 20.0);
}

/* 36.3 samples in a turn resolve 17 of its orders: 35 coefficients. Higher ones, which they show as lower,
 * would take more of the noise. */
static void test_orders_that_samples_do_not_resolve(void)
{
    const double variance = 0.05 * 0.05 * 2.0 / 3.0, share = 35.0 / MOST;
    double square = 0.0;
    for (int trial = 0; trial < 5; ++trial) {
        turn(MOST, 36.3, 50.0, 0.0, 0.0);
        for (size_t k = 0; k < 3 * run.count; ++k)
            run.i_A[k] += 0.05 * ref_normal(&seed);
        run.turn_known = true;
        reduce();
        for (size_t k = 0; k < binned.count; ++k) {
            double d, q;
            rec_rotor(binned.sample[k].reading.i_abc, P * binned.sample[k].raw.theta_m_rad, &d, &q);
            square += 0.5 * (d * d + (q - 3.0) * (q - 3.0)) / (double)binned.count / 5.0;
        }
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.2 * share * variance, share * variance, square); /* of 350: ± 8 % */
}

/* In samples as they are, and in the mean of turns at angles that differ. */
static void test_currents_are_not_distorted(void)
{
    for (int direction = -1; direction <= 1; direction += 2)
        for (int mean = 0; mean < 2; ++mean) {
            turn(MOST, 400.0, 50.0 * direction, 0.0, 0.0);
            if (mean) {
                rec_release(&run);
                run = rec_make(40000);
                for (size_t k = 0; k < run.count; ++k) {
                    run.time_s[k] = (double)k * 2.0 * REF_PI / 1001.618 / 50.0;
                    run.theta_m_rad[k] = 50.0 * direction * run.time_s[k];
                    run.speed_rad_per_s[k] = 50.0 * direction;
                }
            }
            flow(0.0);
            reduce();
            TEST_ASSERT_EQUAL(mean, binned.segment[0].turns > 0);
            TEST_ASSERT_TRUE(sqrt(current_error(false)) < (mean ? 1e-4 : 1e-9)); /* binned are 2π/2048 wide */
            for (size_t k = 0; k < binned.count; ++k) {
                const hci_sample *x = &binned.sample[k].reading;
                double d, q, dd, dq;
                rec_rotor(x->change_A_per_s, P * x->theta_m_rad, &d, &q);
                current(x->theta_m_rad, 1, &dd, &dq);
                TEST_ASSERT_DOUBLE_WITHIN(mean ? 0.5 : 1e-6, 50.0 * direction * dd, d); /* of 270 A/s */
                TEST_ASSERT_DOUBLE_WITHIN(mean ? 0.5 : 1e-6, 50.0 * direction * dq, q);
                rec_rotor(x->curvature_A_per_s2, P * x->theta_m_rad, &d, &q);
                current(x->theta_m_rad, 2, &dd, &dq);
                TEST_ASSERT_DOUBLE_WITHIN(mean ? 700.0 : 1e-3, 2500.0 * dd, d); /* of 243000 A/s² */
                TEST_ASSERT_DOUBLE_WITHIN(mean ? 700.0 : 1e-3, 2500.0 * dq, q);
                TEST_ASSERT_EQUAL_DOUBLE(x->change_A_per_s[1], binned.sample[k].raw.change_A_per_s[1]);
            }
        }
}

/* Noise of a constant current is no change: its slope would be as large as the highest order is, and a delay
 * of many periods of that would make many times the noise of it. What is there swings as it does. */
/* The mean of many turns has less noise than a sample, and is smoothed from fewer of them: 400 a turn. */
static void test_means_of_few_samples(void)
{
    turn(2 * MOST, 400.0, 50.0, 1.0, 0.0);
    for (size_t k = 0; k < 3 * run.count; ++k)
        run.i_A[k] += 0.05 * ref_normal(&seed);
    reduce();
    TEST_ASSERT_TRUE(binned.count < 480);
    TEST_ASSERT_TRUE(binned.segment[0].turns > 0 && binned.segment[0].smooth);
    for (size_t k = 0; k < binned.count; ++k) {
        double i_abc[3];
        rec_phases(0.0, 3.0, P * binned.sample[k].reading.theta_m_rad, i_abc);
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(0.012, i_abc[s], binned.sample[k].reading.i_abc[s]);
    }
}

static void test_rates_are_no_noise(void)
{
    turn(MOST, 400.0, 50.0, 0.0, 0.0);
    for (size_t k = 0; k < MOST; ++k) {
        rec_phases(0.0, 3.0, P * truth[k], run.i_A + 3 * k);
        for (int s = 0; s < 3; ++s)
            run.i_A[3 * k + (size_t)s] += 0.05 * ref_normal(&seed);
    }
    reduce();
    TEST_ASSERT_EQUAL_DOUBLE(0.0, binned.sample[100].reading.change_A_per_s[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, binned.sample[100].reading.swing_rad_per_s);
    once = 0.0;
    turn(MOST, 400.0, -50.0, 0.0, 0.0);
    flow(0.05);
    reduce();
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 6.0 * P * 50.0, binned.sample[100].reading.swing_rad_per_s);
    TEST_ASSERT_EQUAL_DOUBLE(binned.sample[100].reading.swing_rad_per_s,
                             binned.sample[100].raw.swing_rad_per_s);
}

/* Of few samples the electrical orders come first: what a drive's current ripples at order 12 stays, though
 * 1000 samples bear 25 orders, and there are 21 of the rotor below. */
static void test_ripple_of_few_samples(void)
{
    double most = 0.0;
    turn(1000, 401.3, 50.0, 0.0, 0.0);
    for (size_t k = 0; k < run.count; ++k) {
        const double theta = P * run.theta_m_rad[k];
        rec_phases(0.0, 3.0 + 0.3 * sin(12.0 * theta), theta, run.i_A + 3 * k);
    }
    reduce();
    for (size_t k = 0; k < binned.count; ++k) {
        double d, q;
        const double theta = P * binned.sample[k].raw.theta_m_rad;
        rec_rotor(binned.sample[k].reading.i_abc, theta, &d, &q);
        most = fmax(most, fabs(q - 3.0 - 0.3 * sin(12.0 * theta)));
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.0, most);
}

/* A current without orders is its mean, of few samples too, where its noise would make more than that of the
 * torque. */
static void test_a_short_run_of_a_steady_current(void)
{
    for (int loaded = 0; loaded < 2; ++loaded) {
        double square = 0.0;
        once = 0.0;
        turn(470, 1180.0, 50.0, 0.0, 0.0);
        for (size_t k = 0; k < 3 * run.count; ++k)
            run.i_A[k] += 0.05 * ref_normal(&seed);
        if (loaded) load();
        reduce();
        for (size_t k = 0; k < binned.count; ++k) {
            double d, q;
            rec_rotor(binned.sample[k].reading.i_abc, P * binned.sample[k].reading.theta_m_rad, &d, &q);
            square += (d * d + (q - 3.0) * (q - 3.0)) / (double)binned.count;
        }
        TEST_ASSERT_EQUAL(loaded, sqrt(square) < 0.05 * 0.2);
    }
}

/* Too few samples for a series: the slope over a fortieth of a period, which weakens order 6 by x²/10 with
 * x = 6·2π/80. */
static void test_rate_of_change_of_a_short_run(void)
{
    for (int direction = -1; direction <= 1; direction += 2) {
        turn(470, 1180.0, 50.0 * direction, 0.0, 0.0);
        flow(0.0);
        reduce();
        for (size_t k = 10; k < 460; ++k) {
            const hci_sample *x = &binned.sample[k].reading;
            double d, q, dd, dq;
            rec_rotor(x->change_A_per_s, P * x->theta_m_rad, &d, &q);
            current(x->theta_m_rad, 1, &dd, &dq);
            TEST_ASSERT_DOUBLE_WITHIN(0.03 * 275.0, 50.0 * direction * dd, d);
            TEST_ASSERT_DOUBLE_WITHIN(0.03 * 275.0, 50.0 * direction * dq, q);
        }
    }
}

/* A current that grows all along is no series over the angle. */
static void test_a_ramp_of_current_stays(void)
{
    turn(MOST, 400.0, 50.0, 0.0, 0.0);
    for (size_t k = 0; k < MOST; ++k)
        rec_phases(0.0, 1.0 + (double)k / MOST, P * truth[k], run.i_A + 3 * k);
    reduce();
    for (size_t k = 0; k < MOST; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(run.i_A[3 * k], binned.sample[k].reading.i_abc[0]);
}

/* Blocks of current behind a filter of ten samples, with orders far above those that drives ripple at: the
 * series has them, and is nearer to what flowed than the readings. */
static void test_edges_stay(void)
{
    enum { N = 4000 };
    static double flowed[3 * N];
    double reading = 0.0, smooth = 0.0, current[3] = {0.0};
    turn(N, 400.0, 80.0, 0.0, 0.0);
    for (size_t k = 0; k < N; ++k)
        for (int s = 0; s < 3; ++s) {
            for (int part = 0; part < 20; ++part) {
                const double theta = 2.0 * REF_PI * ((double)k + 0.05 * part) / 400.0;
                const double wave = sin(P * theta - 2.0 * REF_PI * s / 3.0);
                current[s] += 0.005 * (5.0 * ((wave > 0.5) - (wave < -0.5)) - current[s]);
            }
            flowed[3 * k + (size_t)s] = current[s];
            run.i_A[3 * k + (size_t)s] = current[s] + 0.05 * ref_normal(&seed);
        }
    reduce();
    TEST_ASSERT_TRUE(binned.segment[0].smooth);
    for (size_t k = 200; k < N - 20; ++k)
        for (int s = 0; s < 3; ++s) {
            const double is = flowed[3 * k + (size_t)s];
            reading += pow(binned.sample[k].raw.i_abc[s] - is, 2.0);
            smooth += pow(binned.sample[k].reading.i_abc[s] - is, 2.0);
        }
    TEST_ASSERT_TRUE(smooth < 0.6 * reading);
}

/* An eccentric encoder makes a current that is steady in the rotor swing once a turn, as it is read: also in
 * a short mean, whose few samples leave room for electrical orders alone. */
static void test_once_a_turn_stays(void)
{
    double most = 0.0;
    turn(13 * 375, 375.0, 80.0, 0.0, 0.0);
    for (size_t k = 0; k < run.count; ++k)
        run.theta_m_rad[k] += 0.01 * sin(truth[k]) + 1e-9;
    reduce();
    TEST_ASSERT_TRUE(binned.segment[0].turns > 0 && binned.segment[0].smooth);
    for (size_t k = 0; k < binned.count; ++k)
        most = fmax(most, fabs(binned.sample[k].reading.i_abc[0] - binned.sample[k].raw.i_abc[0]));
    TEST_ASSERT_TRUE(most < 0.2 * 3.0 * P * 0.01);
}

/* So does one that errs between its lines, sixteen times in an electrical period. */
static void test_currents_between_lines_stay(void)
{
    double most = 0.0;
    turn(13 * 375, 375.0, 80.0, 0.0, 0.0);
    for (size_t k = 0; k < run.count; ++k)
        run.theta_m_rad[k] += 0.01 * sin(16.0 * P * truth[k] + 0.5) + 1e-9;
    reduce();
    TEST_ASSERT_TRUE(binned.segment[0].turns > 0 && binned.segment[0].smooth);
    for (size_t k = 0; k < binned.count; ++k)
        most = fmax(most, fabs(binned.sample[k].reading.i_abc[0] - binned.sample[k].raw.i_abc[0]));
    TEST_ASSERT_TRUE(most < 0.2 * 3.0 * P * 0.01);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_steps_of_an_encoder);
    RUN_TEST(test_motion_is_not_distorted);
    RUN_TEST(test_errors_that_repeat_stay);
    RUN_TEST(test_errors_between_lines_stay);
    RUN_TEST(test_what_is_not_smoothed);
    RUN_TEST(test_noise_of_currents);
    RUN_TEST(test_orders_that_samples_do_not_resolve);
    RUN_TEST(test_currents_are_not_distorted);
    RUN_TEST(test_means_of_few_samples);
    RUN_TEST(test_rates_are_no_noise);
    RUN_TEST(test_ripple_of_few_samples);
    RUN_TEST(test_a_short_run_of_a_steady_current);
    RUN_TEST(test_rate_of_change_of_a_short_run);
    RUN_TEST(test_a_ramp_of_current_stays);
    RUN_TEST(test_edges_stay);
    RUN_TEST(test_once_a_turn_stays);
    RUN_TEST(test_currents_between_lines_stay);
    return UNITY_END();
}
