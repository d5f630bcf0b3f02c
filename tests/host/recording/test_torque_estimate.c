/* Where each rule of computed_torque.c begins, and its low pass and fits by closed forms. */
#define hci_torque_is_typed         torque_is_typed
#define hci_torques_typed_leave     torques_typed_leave
#define hci_torques_at_one_end_tell torques_at_one_end_tell
#define hci_torque_is_of_current    torque_is_of_current
#define hci_torque_estimate_of      torque_estimate_of
#define hci_estimated_torques_leave estimated_torques_leave
#include "host/recording/computed_torque.c"

#include <stdlib.h>

#include "support/draws.h"
#include "support/recording.h"
#include "support/texts.h"
#include "unity.h"

enum { N = 600, P = 3 };

static double torque_Nm[N], iq_A[N], time_s[N], filtered_A[N];
static uint64_t seed;

void setUp(void)
{
    seed = 4;
}

void tearDown(void)
{
}

/* ---- one constant times i_q ---- */

/* The rounding of both, twice: of steps of 0.001 N·m and 0.01 A at 0.05 N·m/A that is 0.003 N·m; a torque is
 * rounded by half a step itself. */
static void test_how_far_a_torque_may_be_off(void)
{
    double constant;
    for (int more = 0; more < 2; ++more)
        for (int sign = -1; sign <= 1; sign += 2) {
            for (int k = 0; k < N; ++k) {
                iq_A[k] = 0.01 * round(300.0 + 100.0 * sin(0.3 * k));
                torque_Nm[k] = sign * 1e-3 * round(51.3 * iq_A[k]);
            }
            torque_Nm[100] += more ? 3.8e-3 : 1.9e-3;
            TEST_ASSERT_EQUAL(!more, torque_is_of_current(torque_Nm, iq_A, N, &constant));
            TEST_ASSERT_DOUBLE_WITHIN(2e-5, sign * 0.0513, constant);
        }
}

/* i_q has to vary by a hundredth of the torque. */
static void test_how_much_a_current_has_to_vary(void)
{
    double constant;
    for (int more = 0; more < 2; ++more) {
        for (int k = 0; k < N; ++k) {
            iq_A[k] = 3.0 + (more ? 0.0155 : 0.0145) * sin(0.3 * k);
            torque_Nm[k] = 0.05 * iq_A[k];
        }
        TEST_ASSERT_EQUAL(more, torque_is_of_current(torque_Nm, iq_A, N, &constant));
    }
    for (int k = 0; k < N; ++k)
        iq_A[k] = 0.0;
    TEST_ASSERT_FALSE(torque_is_of_current(torque_Nm, iq_A, N, &constant));
}

/* ---- one number ---- */

/* So many rows of one torque, with i_q about a mean. */
static hci_run steady(size_t rows, double one_Nm, double mean_A, double swing_A)
{
    hci_run run = rec_make(rows);
    run.pole_pairs = P;
    run.torque_source = HCI_TORQUE_MEASURED;
    for (size_t k = 0; k < rows; ++k) {
        run.theta_m_rad[k] = 0.02 * (double)k;
        run.time_s[k] = 1e-3 * (double)k;
        run.torque_Nm[k] = one_Nm;
        rec_phases(0.6, mean_A + swing_A * (k % 2 ? 1.0 : -1.0), P * run.theta_m_rad[k], run.i_A + 3 * k);
    }
    return run;
}

static bool is_typed(size_t rows, double one_Nm, double swing_A)
{
    hci_run run = steady(rows, one_Nm, 0.8, swing_A);
    const bool typed = torque_is_typed(&run);
    rec_release(&run);
    return typed;
}

/* A thousandth of the size of the currents, √(0.6² + 0.8²) A. */
static void test_one_torque_of_a_current_that_varies(void)
{
    TEST_ASSERT_TRUE(is_typed(16, 0.3, 1.02e-3));
    TEST_ASSERT_FALSE(is_typed(16, 0.3, 0.98e-3));
    TEST_ASSERT_FALSE(is_typed(15, 0.3, 0.1));
    TEST_ASSERT_FALSE(is_typed(16, 0.0, 0.1));
    hci_run run = steady(16, 0.3, 0.8, 0.1);
    run.torque_Nm[15] = 0.3001;
    TEST_ASSERT_FALSE(torque_is_typed(&run));
    run.torque_Nm[15] = 0.2999;
    TEST_ASSERT_FALSE(torque_is_typed(&run));
    rec_release(&run);
}

/* Three runs, the first two of one torque. */
static void leave_typed(double second_A, double second_Nm, bool typed[3])
{
    hci_run run[3] = {steady(20, 0.3, 2.0, 0.0), steady(20, second_Nm, second_A, 0.0),
                      steady(20, 0.9, -4.0, 0.0)};
    torques_typed_leave(run, 3);
    for (int k = 0; k < 3; ++k) {
        typed[k] = run[k].torque_is_typed;
        TEST_ASSERT_EQUAL(typed[k], run[k].torque_Nm == NULL);
        TEST_ASSERT_EQUAL(typed[k] ? HCI_TORQUE_NONE : HCI_TORQUE_MEASURED, run[k].torque_source);
        if (typed[k]) {
            TEST_ASSERT_EQUAL_DOUBLE(k == 0 ? 0.3 : second_Nm, run[k].torque_typed_Nm);
            text_has("the torque is 0.3 N·m in every row, as in other recordings: typed", run[k].remark.text);
        }
        rec_release(&run[k]);
    }
}

/* At currents that differ by a tenth of the largest of the list, 4 A. */
static void test_one_torque_of_two_currents(void)
{
    bool typed[3];
    leave_typed(2.39, 0.3, typed);
    TEST_ASSERT_FALSE(typed[0] || typed[1] || typed[2]);
    leave_typed(2.41, 0.3, typed);
    TEST_ASSERT_TRUE(typed[0] && typed[1] && !typed[2]);
    leave_typed(3.0, 0.3 * (1.0 + 2e-9), typed);
    TEST_ASSERT_FALSE(typed[0] || typed[1] || typed[2]);
}

/* The end of a sensor: the same number, or the other sign of it, at another current. */
static void test_two_runs_at_one_end(void)
{
    static const struct {
        double second_A, second_Nm;
        bool at_end;
    } CASES[] = {{3.0, 0.3, true}, {2.39, 0.3, false}, {2.41, -0.3, true}, {3.0, 0.31, false}};
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; ++c) {
        hci_run run[3] = {steady(20, 0.3, 2.0, 0.0), steady(20, 0.3, CASES[c].second_A, 0.0),
                          steady(20, 0.9, -4.0, 0.0)};
        for (int k = 0; k < 2; ++k)
            run[k].torque_is_typed = true, run[k].torque_typed_Nm = k ? CASES[c].second_Nm : 0.3;
        strcpy(run[1].name, "b/second.csv");
        torques_at_one_end_tell(run, 3);
        TEST_ASSERT_EQUAL(CASES[c].at_end, run[0].torque_is_clipped);
        TEST_ASSERT_EQUAL(CASES[c].at_end, run[1].torque_is_clipped);
        TEST_ASSERT_FALSE(run[2].torque_is_clipped);
        if (CASES[c].at_end) text_has("second.csv has the torque ", run[0].remark.text);
        text_lacks("b/second", run[0].remark.text);
        for (int k = 0; k < 3; ++k)
            rec_release(&run[k]);
    }
}

/* ---- the low pass ---- */

static series of_arrays(size_t count)
{
    return (series){.time_s = time_s,
                    .torque_Nm = torque_Nm,
                    .iq_A = iq_A,
                    .filtered_A = filtered_A,
                    .count = count,
                    .first = SETTLED,
                    .step_s = 1e-3,
                    .best = INFINITY};
}

/* A ramp from t = 0.2 s on: behind it y = a(t − τ + τ exp(−t/τ)), at uneven samples as well. */
static void test_a_ramp_behind_the_low_pass(void)
{
    for (double tau_s = 3e-4; tau_s < 0.3; tau_s *= 7.0) {
        series s = of_arrays(N);
        for (int k = 0; k < N; ++k) {
            time_s[k] = 1e-3 * (k + 0.4 * (k % 3));
            const double t = time_s[k] - 1e-3 * (200 + 0.4 * (200 % 3));
            iq_A[k] = 0.5 + (t > 0.0 ? 12.0 * t : 0.0);
        }
        filter(&s, tau_s);
        for (int k = 0; k < N; ++k) {
            const double t = fmax(0.0, time_s[k] - time_s[200]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 + 12.0 * (t - tau_s + tau_s * exp(-t / tau_s)),
                                      filtered_A[k]);
        }
    }
    series s = of_arrays(N);
    filter(&s, 0.0);
    TEST_ASSERT_EQUAL_MEMORY(iq_A, filtered_A, sizeof iq_A);
}

/* Torques that a low pass of known time and constant makes, with noise: what is left is that, and its share
 * least squares over the settled samples. */
static void test_the_low_pass_is_found(void)
{
    for (double tau_s = 2e-4; tau_s < 0.1; tau_s *= 5.0) {
        series s = of_arrays(N);
        for (int k = 0; k < N; ++k) {
            time_s[k] = 1e-3 * k;
            iq_A[k] = 2.0 + ref_normal(&seed);
        }
        filter(&s, tau_s);
        for (int k = 0; k < N; ++k)
            torque_Nm[k] = 0.07 * filtered_A[k] + 1e-5 * ref_normal(&seed) + (k < SETTLED ? 5.0 : 0.0);
        fit(&s);
        TEST_ASSERT_DOUBLE_WITHIN(5e-3 * tau_s, tau_s, s.time_constant_s);
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, 0.07, s.constant);
        TEST_ASSERT_DOUBLE_WITHIN(0.3e-5, 1e-5, sqrt(s.best));
        filter(&s, s.time_constant_s);
        double constant, square = 0.0, product = 0.0, left = 0.0;
        const double found = left_behind(&s, &constant);
        for (size_t k = SETTLED; k < N; ++k)
            square += filtered_A[k] * filtered_A[k], product += filtered_A[k] * torque_Nm[k];
        for (size_t k = SETTLED; k < N; ++k)
            left += pow(torque_Nm[k] - product / square * filtered_A[k], 2.0) / (N - SETTLED);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, product / square, constant);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12 * left, left, found);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12 * left, left, s.best);
    }
}

/* A torque without a filter is that of i_q. */
static void test_no_low_pass(void)
{
    series s = of_arrays(N);
    for (int k = 0; k < N; ++k) {
        time_s[k] = 1e-3 * k;
        iq_A[k] = 2.0 + ref_normal(&seed);
        torque_Nm[k] = -0.07 * iq_A[k];
    }
    fit(&s);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, s.time_constant_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.07, s.constant);
}

/* ---- by how much ---- */

static void test_a_constant_near_the_declared_one(void)
{
    TEST_ASSERT_TRUE(is_near(0.071, 0.1) && is_near(0.139, 0.1));
    TEST_ASSERT_FALSE(is_near(0.069, 0.1) || is_near(0.141, 0.1));
    TEST_ASSERT_TRUE(is_near(17.0, 0.0) && is_near(1e-6, NAN));
    TEST_ASSERT_FALSE(is_near(-0.1, 0.1) || is_near(-0.1, 0.0) || is_near(0.0, 0.0));
}

/* Neighbours that have a fifth in common, and a mean of a fifth of the rms. x_k = e_k + b e_(k−1): b/(1 +
 * b²). */
static void test_what_noise_is(void)
{
    static double x[20000];
    for (int way = -1; way <= 1; way += 2)
        for (int more = 0; more < 2; ++more) {
            double before = ref_normal(&seed);
            for (int k = 0; k < 20000; ++k) {
                const double e = ref_normal(&seed);
                x[k] = e + way * (more ? 0.24 : 0.18) * before;
                before = e;
            }
            TEST_ASSERT_EQUAL(!more, is_noise(x, 20000, 0.0));
        }
    for (int k = 0; k < 20000; ++k)
        x[k] = ref_normal(&seed);
    TEST_ASSERT_TRUE(is_noise(x, 20000, 0.19));
    TEST_ASSERT_TRUE(is_noise(x, 20000, -0.19));
    TEST_ASSERT_FALSE(is_noise(x, 20000, 0.21));
    TEST_ASSERT_FALSE(is_noise((double[]){0.0, 0.0, 0.0}, 3, 0.0));
}

/* Of an order of the electrical angle cosine and sine, over whole turns; of order 0 the mean. */
static void test_an_order_is_taken_out(void)
{
    hci_run run = rec_make(N);
    run.pole_pairs = P;
    for (size_t k = 0; k < N; ++k)
        run.theta_m_rad[k] = 2.0 * REF_PI * (double)k / 200.0;
    for (int order = 0; order <= 2; ++order) {
        for (size_t k = 0; k < N; ++k) {
            const double theta = P * run.theta_m_rad[k];
            iq_A[k] =
                0.7 + 1.3 * cos(theta) - 0.4 * sin(theta) + 0.9 * cos(2.0 * theta) + 0.2 * sin(2.0 * theta);
        }
        order_leave(&run, order, iq_A, N);
        for (size_t k = 0; k < N; ++k) {
            const double theta = P * run.theta_m_rad[k], first = 1.3 * cos(theta) - 0.4 * sin(theta),
                         second = 0.9 * cos(2.0 * theta) + 0.2 * sin(2.0 * theta);
            TEST_ASSERT_DOUBLE_WITHIN(
                1e-12, (order == 0 ? 0.0 : 0.7) + (order == 1 ? 0.0 : first) + (order == 2 ? 0.0 : second),
                iq_A[k]);
        }
    }
    rec_release(&run);
}

/* ---- a run ---- */

/* i_q about a mean, rounded to step_A, and a torque of it behind a filter, rounded to step_Nm, with noise. */
static hci_torque_estimate estimate(double swing_A, double step_Nm, double noise_Nm, double declared,
                                    size_t rows)
{
    hci_torque_estimate e;
    hci_note note = {{0}};
    hci_run run = steady(rows, 0.0, 0.0, 0.0);
    double y = 0.0, before = 0.0;
    for (size_t k = 0; k < rows; ++k) {
        const double i_A = 2.0 + swing_A * sin(0.37 * (double)k + sin(0.011 * (double)k)),
                     keeps = exp(-1.0 / 3.0), slope = k > 0 ? i_A - before : 0.0;
        y = k > 0 ? i_A - 3.0 * slope + (y - before + 3.0 * slope) * keeps : i_A;
        before = i_A;
        run.torque_Nm[k] = step_Nm * round((0.05 * y + noise_Nm * ref_normal(&seed)) / step_Nm);
        rec_phases(0.1, i_A, P * run.theta_m_rad[k], run.i_A + 3 * k);
    }
    TEST_ASSERT_EQUAL(HCI_OK, torque_estimate_of(&run, declared, &e, &note));
    rec_release(&run);
    return e;
}

static void test_what_rounding_leaves(void)
{
    hci_torque_estimate e = estimate(0.5, 1e-4, 0.0, 0.05, 1000);
    TEST_ASSERT_TRUE(e.tells && e.within_rounding && !e.is_of_noise);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.05, e.constant_Nm_per_A);
    TEST_ASSERT_DOUBLE_WITHIN(2e-5, 3e-3, e.time_constant_s);
    TEST_ASSERT_FALSE(
        estimate(0.5, 1e-4, 1e-4, 0.05, 1000).within_rounding); /* 3.5 times what rounding leaves */
    TEST_ASSERT_TRUE(estimate(0.5, 1e-4, 1e-4, 0.05, 1000).tells);
    TEST_ASSERT_FALSE(estimate(0.5, 1e-4, 0.0, 0.08, 1000).within_rounding);
    TEST_ASSERT_TRUE(estimate(0.5, 1e-4, 0.0, 0.0, 1000).within_rounding);
    TEST_ASSERT_FALSE(estimate(0.5, 1e-4, 0.0, 0.05, 255).tells);
    TEST_ASSERT_TRUE(estimate(0.5, 1e-4, 0.0, 0.05, 256).tells);
}

/* Without a current: a torque that is 0.05 N·m/A times the noise of the current sensors, and some noise. */
static void test_what_the_noise_of_the_sensors_tells(void)
{
    hci_torque_estimate e;
    hci_note note = {{0}};
    for (int follows = 0; follows < 2; ++follows) {
        hci_run run = steady(2000, 0.0, 0.0, 0.0);
        for (size_t k = 0; k < 2000; ++k) {
            const double i_A = ref_normal(&seed);
            rec_phases(0.0, i_A, P * run.theta_m_rad[k], run.i_A + 3 * k);
            run.torque_Nm[k] = (follows ? 0.05 * i_A : 0.05 * ref_normal(&seed)) + 0.01 * ref_normal(&seed);
        }
        TEST_ASSERT_EQUAL(HCI_OK, torque_estimate_of(&run, 0.05, &e, &note));
        TEST_ASSERT_TRUE(e.tells && !e.within_rounding);
        TEST_ASSERT_EQUAL(follows, e.is_of_noise);
        if (follows) TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.05, e.constant_Nm_per_A);
        if (follows) TEST_ASSERT_DOUBLE_WITHIN(1e-4, 0.0, e.time_constant_s);
        rec_release(&run);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_how_far_a_torque_may_be_off);
    RUN_TEST(test_how_much_a_current_has_to_vary);
    RUN_TEST(test_one_torque_of_a_current_that_varies);
    RUN_TEST(test_one_torque_of_two_currents);
    RUN_TEST(test_two_runs_at_one_end);
    RUN_TEST(test_a_ramp_behind_the_low_pass);
    RUN_TEST(test_the_low_pass_is_found);
    RUN_TEST(test_no_low_pass);
    RUN_TEST(test_a_constant_near_the_declared_one);
    RUN_TEST(test_what_noise_is);
    RUN_TEST(test_an_order_is_taken_out);
    RUN_TEST(test_what_rounding_leaves);
    RUN_TEST(test_what_the_noise_of_the_sensors_tells);
    return UNITY_END();
}
