/* Torques that drift along a run, beside what repeats with the turn. */
#define _XOPEN_SOURCE 700
#include "host/diagnose/prepare/drift.h"

#include "support/recording.h"
#include "unity.h"

enum { P = 4, N = 8000 };

static const double K_NM_PER_A = 0.45, NOISE_NM = 0.004, LASTS_s = 10.0;

static hci_run run;
static hci_run_statistics statistics;
static uint64_t seed = 11;

void setUp(void)
{
}

void tearDown(void)
{
    rec_release(&run);
}

/* Of a run of so many turns, way: 1 or -1; powers: of 2t/T - 1, in N·m; current_A, speed: parts that rise
 * along the run. */
typedef struct {
    double turns, way, powers[3], current_A, speed;
} point;

static double drift_at(const point *x, double tau)
{
    return tau * (x->powers[0] + tau * (x->powers[1] + tau * x->powers[2]));
}

static void record(const point *x)
{
    run = rec_make(N);
    for (size_t k = 0; k < N; ++k) {
        const double t = LASTS_s * (double)k / (N - 1), tau = 2.0 * t / LASTS_s - 1.0,
                     iq = 5.0 + x->current_A * tau;
        const double theta = x->way * 2.0 * REF_PI * x->turns * t / LASTS_s;
        run.time_s[k] = t;
        run.theta_m_rad[k] = theta;
        run.speed_rad_per_s[k] = x->way * 2.0 * REF_PI * x->turns / LASTS_s * (1.0 + x->speed * tau);
        rec_phases(0.0, iq, P * theta, run.i_A + 3 * k);
        run.torque_Nm[k] = K_NM_PER_A * iq + 0.1 * sin(6.0 * P * theta) + 0.03 * sin(theta) +
                           drift_at(x, tau) + NOISE_NM * ref_normal(&seed);
    }
    statistics = hci_run_statistics_of(&run, P);
}

static hci_drift found(void)
{
    return hci_drift_find(&run, &statistics, P, K_NM_PER_A);
}

/* The drift itself less its mean over the run, whatever its powers, the direction and the number of turns. */
static void test_drifts(void)
{
    static const point POINTS[] = {{3.6, 1.0, {0.01, 0.0, 0.0}, 0.0, 0.0},
                                   {4.0, -1.0, {-0.01, 0.0, 0.0}, 0.0, 0.0},
                                   {5.5, 1.0, {0.01, 0.02, 0.0}, 0.0, 0.0},
                                   {20.0, 1.0, {0.0, -0.02, 0.01}, 0.0, 0.0}};
    for (size_t p = 0; p < sizeof POINTS / sizeof *POINTS; ++p) {
        double mean = 0.0, sum = 0.0;
        record(&POINTS[p]);
        const hci_drift d = found();
        TEST_ASSERT_TRUE(d.degree > 0);
        for (size_t k = 0; k < N; ++k)
            mean += drift_at(&POINTS[p], 2.0 * (double)k / (N - 1) - 1.0) / N;
        for (size_t k = 0; k < N; ++k) {
            const double at = hci_drift_at_Nm(&d, run.time_s[k]);
            TEST_ASSERT_DOUBLE_WITHIN(0.001, drift_at(&POINTS[p], 2.0 * (double)k / (N - 1) - 1.0) - mean,
                                      at);
            sum += at / N;
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.0, sum);
        rec_release(&run);
    }
    record(&POINTS[0]);
    const hci_drift straight = found();
    TEST_ASSERT_DOUBLE_WITHIN(0.001, 0.02, hci_drift_peak_to_peak_Nm(&straight));
}

/* Nothing that repeats, noise alone, what the current or the speed makes, too few turns, another source. */
static void test_no_drift(void)
{
    static const point POINTS[] = {{4.0, 1.0, {0.0, 0.0, 0.0}, 0.0, 0.0},
                                   {4.0, 1.0, {0.0003, 0.0, 0.0}, 0.0, 0.0},
                                   {4.0, 1.0, {0.0, 0.0, 0.0}, 0.05, 0.0},
                                   {4.0, 1.0, {0.02, 0.0, 0.0}, 0.0, 0.02},
                                   {1.8, 1.0, {0.02, 0.0, 0.0}, 0.0, 0.0}};
    for (size_t p = 0; p < sizeof POINTS / sizeof *POINTS; ++p) {
        record(&POINTS[p]);
        TEST_ASSERT_EQUAL(0, found().degree);
        rec_release(&run);
    }
    record(&(point){4.0, 1.0, {0.02, 0.0, 0.0}, 0.0, 0.0});
    TEST_ASSERT_EQUAL(1, found().degree);
    statistics.coldest_C = 20.0, statistics.hottest_C = 30.0;
    TEST_ASSERT_EQUAL(0, found().degree);
    statistics.coldest_C = statistics.hottest_C = NAN;
    run.torque_source = HCI_TORQUE_INERTIA;
    TEST_ASSERT_EQUAL(0, found().degree);
}

static hci_run_statistics drifting(double turns, int degree, double rate)
{
    return (hci_run_statistics){
        .turns = turns,
        .drift = {.degree = degree, .half_s = LASTS_s / 2.0, .coefficient_Nm = {rate * LASTS_s / 2.0}}};
}

/* One rate in many turns is the effect's; another one, a curve, or few turns are not. */
static void test_one_rate_is_left_to_the_effect(void)
{
    hci_run_statistics runs[3] = {drifting(8.0, 1, 1e-3), drifting(9.0, 1, 1.1e-3), drifting(9.0, 0, 0.0)};
    hci_drifts_leave_to_effect(runs, 3);
    TEST_ASSERT_TRUE(runs[0].drift.degree == 0 && runs[1].drift.degree == 0);
    runs[0] = drifting(8.0, 1, 1e-3), runs[1] = drifting(9.0, 1, -1e-3);
    hci_drifts_leave_to_effect(runs, 2);
    TEST_ASSERT_TRUE(runs[0].drift.degree == 1 && runs[1].drift.degree == 1);
    runs[1] = drifting(9.0, 2, 1e-3);
    hci_drifts_leave_to_effect(runs, 2);
    TEST_ASSERT_TRUE(runs[0].drift.degree == 1 && runs[1].drift.degree == 2);
    runs[1] = drifting(4.0, 1, 1e-3);
    hci_drifts_leave_to_effect(runs, 2);
    TEST_ASSERT_TRUE(runs[0].drift.degree == 0 && runs[1].drift.degree == 1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_drifts);
    RUN_TEST(test_no_drift);
    RUN_TEST(test_one_rate_is_left_to_the_effect);
    return UNITY_END();
}
