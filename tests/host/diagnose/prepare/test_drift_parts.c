/* The parts of a drift by themselves: the equations of the changes over a turn by plain sums, the degree, the
 * mean and the conditions on both sides of their bounds. */
#include "host/diagnose/prepare/drift.c"

#include "support/recording.h"
#include "unity.h"

enum { P = 3, DEGREE = HCI_DRIFT_DEGREE };

static const double TURN = 2.0 * REF_PI, K_NM_PER_A = 0.45;

static hci_run run;
static hci_run_statistics statistics;

void setUp(void)
{
}

void tearDown(void)
{
    rec_release(&run);
}

static double tau_of(size_t k)
{
    return 2.0 * (double)k / (double)(run.count - 1) - 1.0;
}

/* So many samples in a turn, steadily; torque, current and speed have waves and creep. */
static void record(size_t n, double samples, double way, double torque_Nm, double current_A, double speed)
{
    rec_release(&run);
    run = rec_make(n);
    for (size_t k = 0; k < n; ++k) {
        const double x = (double)k, theta = way * TURN * x / samples, tau = tau_of(k);
        run.time_s[k] = 3.0 + 0.01 * x;
        run.theta_m_rad[k] = theta;
        run.speed_rad_per_s[k] = way * (50.0 + 0.1 * sin(0.7 * x) + speed * tau);
        rec_phases(0.0, 4.0 + 0.2 * cos(0.3 * x) + current_A * tau, P * theta, run.i_A + 3 * k);
        run.torque_Nm[k] = 0.5 + 0.02 * sin(1.1 * x) + torque_Nm * tau;
    }
}

static question asked(double way)
{
    const double from = run.time_s[0], to = run.time_s[run.count - 1];
    return (question){
        &run, TURN, way, K_NM_PER_A, 0.02, P, {.middle_s = 0.5 * (from + to), .half_s = 0.5 * (to - from)}};
}

/* ---- changes over a turn ---- */

static double channel(int of, size_t k)
{
    double d, q;
    rec_rotor(run.i_A + 3 * k, P * run.theta_m_rad[k], &d, &q);
    return of == 0 ? run.torque_Nm[k] : of == 1 ? K_NM_PER_A * q : 0.02 * run.speed_rad_per_s[k];
}

/* The value of a channel (0 … 2) or of a power of τ one turn before sample k, on the line between two
 * samples. */
static double one_turn_before(int of, size_t k, double samples)
{
    const double x = (double)k - samples;
    const size_t at = (size_t)floor(x);
    return channel(of, at) + (x - floor(x)) * (channel(of, at + 1) - channel(of, at));
}

/* The same sums by hand; a part is complete when the next one begins. */
static changes by_hand(double samples, double least)
{
    changes c = {.parts = 0.0};
    for (int part = 0;; ++part) {
        double row[DEGREE] = {0.0}, value[3] = {0.0}, count = 0.0;
        bool complete = false;
        for (size_t k = (size_t)ceil(samples); k < run.count; ++k) {
            const int in = (int)floor(((double)k - samples) / samples * 8.0);
            const double then = 2.0 * ((double)k - samples) / (double)(run.count - 1) - 1.0;
            complete = complete || in > part;
            if (in != part) continue;
            count += 1.0;
            for (int j = 0; j < DEGREE; ++j)
                row[j] += pow(tau_of(k), j + 1) - pow(then, j + 1);
            for (int of = 0; of < 3; ++of)
                value[of] += channel(of, k) - one_turn_before(of, k, samples);
        }
        if (!complete) return c;
        if (count < least) continue;
        for (int j = 0; j < DEGREE; ++j) {
            for (int i = 0; i < DEGREE; ++i)
                c.gram[j * DEGREE + i] += row[j] * row[i] / count / count;
            for (int of = 0; of < 3; ++of)
                c.moment[of][j] += row[j] * value[of] / count / count;
        }
        c.square += value[0] * value[0] / count / count;
        c.parts += 1.0;
    }
}

static void are_the_sums_by_hand(double samples, double way)
{
    const question x = asked(way);
    const changes c = changes_of(&x), hand = by_hand(samples, 4.0);
    TEST_ASSERT_EQUAL_DOUBLE(hand.parts, c.parts);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * hand.square, hand.square, c.square);
    for (int j = 0; j < DEGREE; ++j)
        for (int i = 0; i < DEGREE; ++i) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-9 * hand.gram[0], hand.gram[j * DEGREE + i], c.gram[j * DEGREE + i]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-8 * (fabs(hand.moment[i][j]) + 1e-4), hand.moment[i][j],
                                      c.moment[i][j]);
        }
}

static void test_changes_are_sums_over_parts_of_a_turn(void)
{
    record(500, 60.37, 1.0, 0.1, 0.3, 4.0);
    are_the_sums_by_hand(60.37, 1.0);
    record(500, 60.37, -1.0, 0.1, 0.3, 4.0);
    are_the_sums_by_hand(60.37, -1.0);
    record(300, 33.3, 1.0, -0.1, 0.1, 1.0); /* some parts have five samples, others four */
    are_the_sums_by_hand(33.3, 1.0);
    record(300, 27.63, 1.0, 0.1, 0.1, 1.0); /* three or four */
    are_the_sums_by_hand(27.63, 1.0);
    record(300, 22.0, 1.0, 0.1, 0.1, 1.0); /* too few everywhere */
    const question x = asked(1.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, changes_of(&x).parts);
}

/* ---- the polynomial ---- */

static changes diagonal(double first, double second, double third, double square, double parts)
{
    const double m[] = {first, second, third};
    changes c = {.square = square, .parts = parts};
    for (int j = 0; j < DEGREE; ++j) {
        c.gram[j * (DEGREE + 1)] = 2.0 + j;
        c.moment[OF_TORQUE][j] = sqrt(m[j] * (2.0 + j)); /* explains m[j] */
    }
    return c;
}

static void test_what_powers_explain(void)
{
    double x[DEGREE];
    const changes c = diagonal(4.0, 9.0, 1.0, 30.0, 20.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0, solve(&c, 1, OF_TORQUE, x));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(2.0), x[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, x[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 13.0, solve(&c, 2, OF_TORQUE, x));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 14.0, solve(&c, 3, OF_TORQUE, x));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, x[2]);
    changes twins = c; /* two powers that are the same */
    twins.gram[1] = twins.gram[DEGREE] = twins.gram[DEGREE + 1] = twins.gram[0];
    TEST_ASSERT_EQUAL_DOUBLE(0.0, solve(&twins, 2, OF_TORQUE, x));
}

/* Six standard errors for each power: of 21 parts of which all else leaves 20 n of square. */
static int degree_by(double first, double second, double third, double left)
{
    const changes c = diagonal(first, second, third, first + second + third + left, 21.0);
    return degree_of(&c);
}

static void test_the_degree_is_what_stands_out(void)
{
    TEST_ASSERT_EQUAL_INT(1, degree_by(37.0, 0.0, 0.0, 20.0));
    TEST_ASSERT_EQUAL_INT(0, degree_by(35.0, 0.0, 0.0, 20.0));
    TEST_ASSERT_EQUAL_INT(2, degree_by(0.0, 73.0, 0.0, 19.0)); /* two powers for it */
    TEST_ASSERT_EQUAL_INT(0, degree_by(0.0, 71.0, 0.0, 19.0));
    TEST_ASSERT_EQUAL_INT(2, degree_by(400.0, 37.0, 0.0, 19.0)); /* one, beside the first */
    TEST_ASSERT_EQUAL_INT(1, degree_by(400.0, 35.0, 0.0, 19.0));
    TEST_ASSERT_EQUAL_INT(3, degree_by(0.0, 0.0, 109.0, 18.0));
    TEST_ASSERT_EQUAL_INT(0, degree_by(0.0, 0.0, 107.0, 18.0));
    TEST_ASSERT_EQUAL_INT(3, degree_by(900.0, 0.0, 73.0, 18.0));
    TEST_ASSERT_EQUAL_INT(1, degree_by(900.0, 0.0, 71.0, 18.0));
}

/* Powers whose mean over the run is 0, and what lies between their ends and crests. */
static void test_values_of_a_polynomial(void)
{
    const hci_drift none = {.degree = 0, .half_s = 1.0, .at_middle_Nm = 3.0, .coefficient_Nm = {1.0}};
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_drift_at_Nm(&none, 0.5));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_drift_peak_to_peak_Nm(&none));
    hci_drift d = {
        .degree = 3, .middle_s = 5.0, .half_s = 4.0, .at_middle_Nm = 0.25, .coefficient_Nm = {1.0, 2.0, 3.0}};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.25 + 0.5 + 0.5 + 0.375, hci_drift_at_Nm(&d, 7.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.25 - 1.0 + 2.0 - 3.0, hci_drift_at_Nm(&d, 1.0));
    d = (hci_drift){.degree = 2, .middle_s = 5.0, .half_s = 4.0, .coefficient_Nm = {0.0, 2.0}};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, hci_drift_peak_to_peak_Nm(&d)); /* 0 in the middle */
    d = (hci_drift){
        .degree = 1, .middle_s = 5.0, .half_s = 4.0, .at_middle_Nm = 7.0, .coefficient_Nm = {-0.3}};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.6, hci_drift_peak_to_peak_Nm(&d));
    d = (hci_drift){
        .degree = 3, .half_s = 1.0, .coefficient_Nm = {-3.0, 0.0, 4.0}}; /* ± 1 at ± 1/2 and at the ends */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, hci_drift_peak_to_peak_Nm(&d));
    record(300, 40.0, 1.0, 0.0, 0.0, 0.0);
    const question x = asked(1.0);
    const changes c = diagonal(2.0, 27.0, 64.0, 300.0, 20.0);
    d = drift_of(&x, &c, 3, OF_TORQUE);
    TEST_ASSERT_EQUAL_INT(3, d.degree);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -1.0, d.at_middle_Nm); /* τ² has the mean 1/3 and here the factor 3 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, d.coefficient_Nm[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0, d.coefficient_Nm[2]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, x.time.middle_s, d.middle_s);
}

/* ---- the whole ---- */

static hci_drift found_beside(double mean_A, double torque_Nm, double current_A, double speed)
{
    record(700, 60.0, 1.0, torque_Nm, current_A, speed);
    for (size_t k = 0; k < run.count; ++k) {
        run.torque_Nm[k] = torque_Nm * tau_of(k) + 0.3 * sin(TURN * (double)k / 60.0);
        rec_phases(0.0, mean_A + current_A * tau_of(k), P * run.theta_m_rad[k], run.i_A + 3 * k);
    }
    statistics = hci_run_statistics_of(&run, P);
    statistics.rms_torque_Nm = 0.5; /* of which a change of the speed by all of it makes as much */
    statistics.repeat_Nm = 1e-3;
    return hci_drift_find(&run, &statistics, P, K_NM_PER_A);
}

static hci_drift found(double torque_Nm, double current_A, double speed)
{
    return found_beside(4.0, torque_Nm, current_A, speed);
}

/* A current or a speed that may make three tenths of it. */
static void test_what_a_cause_may_make(void)
{
    const hci_drift d = found(0.05, 0.0, 0.0);
    TEST_ASSERT_EQUAL_INT(1, d.degree);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.05, d.coefficient_Nm[0]);
    TEST_ASSERT_EQUAL_INT(1, found(0.05, 0.27 * 0.05 / K_NM_PER_A, 0.0).degree);
    TEST_ASSERT_EQUAL_INT(0, found(0.05, 0.33 * 0.05 / K_NM_PER_A, 0.0).degree);
    TEST_ASSERT_EQUAL_INT(1, found(0.05, 0.0, 0.27 * 0.05 / 0.5 * 50.0).degree);
    TEST_ASSERT_EQUAL_INT(0, found(0.05, 0.0, 0.33 * 0.05 / 0.5 * 50.0).degree);
}

/* Of a motor whose currents are small as well; a run without a current has readings of its sensors alone,
 * which may creep by themselves. */
static void test_a_cause_of_any_size(void)
{
    const double creeping_A = 0.33 * 0.05 / K_NM_PER_A;
    TEST_ASSERT_EQUAL_INT(0, found_beside(0.1, 0.05, creeping_A, 0.0).degree);
    TEST_ASSERT_TRUE(statistics.current_A > 0.05 && statistics.current_A < 0.2);
    found_beside(0.0, 0.05, 2.0 * creeping_A, 0.0);
    statistics.current_A = 0.0;
    TEST_ASSERT_EQUAL_INT(1, hci_drift_find(&run, &statistics, P, K_NM_PER_A).degree);
}

static int degree_where(double repeat_Nm, double coldest_C, double hottest_C, double deviation)
{
    found(0.05, 0.0, 0.0);
    statistics.repeat_Nm = repeat_Nm;
    statistics.coldest_C = coldest_C, statistics.hottest_C = hottest_C;
    statistics.speed_deviation = deviation * fabs(statistics.mean_speed_rad_per_s);
    return hci_drift_find(&run, &statistics, P, K_NM_PER_A).degree;
}

static void test_which_runs_are_asked(void)
{
    TEST_ASSERT_EQUAL_INT(1, degree_where(0.09 / 0.2, NAN, NAN, 0.049));
    TEST_ASSERT_EQUAL_INT(0, degree_where(0.11 / 0.2, NAN, NAN, 0.049)); /* a swing of 0.1 */
    TEST_ASSERT_EQUAL_INT(0, degree_where(1e-3, NAN, NAN, 0.051));
    TEST_ASSERT_EQUAL_INT(1, degree_where(1e-3, 20.0, 20.9, 0.0));
    TEST_ASSERT_EQUAL_INT(0, degree_where(1e-3, 20.0, 21.1, 0.0));
    for (int what = 0; what < 3; ++what) {
        found(0.05, 0.0, 0.0);
        if (what == 0) run.turn_known = false;
        if (what == 1) run.only_mean = true;
        if (what == 2) run.torque_source = HCI_TORQUE_HOLDING;
        TEST_ASSERT_EQUAL_INT(0, hci_drift_find(&run, &statistics, P, K_NM_PER_A).degree);
    }
}

/* Ten parts that are complete, after the first turn. */
static void test_the_least_length(void)
{
    found(0.05, 0.0, 0.0);
    for (size_t parts = 9; parts <= 11; ++parts) {
        run.count = 60 + (60 * parts + 7) / 8 + 2;
        const hci_drift d = hci_drift_find(&run, &statistics, P, K_NM_PER_A);
        TEST_ASSERT_EQUAL_INT(parts >= 10, d.degree > 0);
    }
    run.count = 700;
}

static hci_run_statistics straight(double turns, double rate)
{
    return (hci_run_statistics){.turns = turns,
                                .drift = {.degree = 1, .half_s = 5.0, .coefficient_Nm = {5.0 * rate}}};
}

/* Whether drifts of two rates, the first of so many turns, are left to the effect. */
static bool is_left(double turns, double one, double other)
{
    hci_run_statistics x[] = {straight(turns, one), straight(20.0, other), {.turns = 30.0}};
    hci_drifts_leave_to_effect(x, 3);
    return x[1].drift.degree == 0;
}

/* Of 0.81 and 1.19 the mean is 1, and a fifth of it is more than they are off. */
static void test_rates_that_are_one(void)
{
    TEST_ASSERT_TRUE(is_left(6.0, 0.81, 1.19));
    TEST_ASSERT_FALSE(is_left(6.0, 0.79, 1.21));
    TEST_ASSERT_TRUE(is_left(6.0, -0.81, -1.19));
    TEST_ASSERT_TRUE(is_left(5.9, 0.81, 1.0)); /* the mean is of runs of six turns */
    TEST_ASSERT_FALSE(is_left(5.9, 0.79, 1.0));
    TEST_ASSERT_FALSE(is_left(6.0, 0.64, 1.0));
    TEST_ASSERT_TRUE(is_left(6.0, 0.68, 1.0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_changes_are_sums_over_parts_of_a_turn);
    RUN_TEST(test_what_powers_explain);
    RUN_TEST(test_the_degree_is_what_stands_out);
    RUN_TEST(test_values_of_a_polynomial);
    RUN_TEST(test_what_a_cause_may_make);
    RUN_TEST(test_a_cause_of_any_size);
    RUN_TEST(test_which_runs_are_asked);
    RUN_TEST(test_the_least_length);
    RUN_TEST(test_rates_that_are_one);
    return UNITY_END();
}
