/* What a sensor should have read, part by part: samples that are written down here, and torques by hand. */
#include <math.h>
#include <string.h>

#include "host/diagnose/reading/predicted_reading.h"
#include "host/numeric/slope_average.h"
#include "support/effect_list.h"
#include "support/recording.h"

enum { P = 3, N = 40, RUNS = 2 };

static const double K_NM_PER_A = 0.2, ID_A = -1.5, IQ_A = 4.0;

static hci_wave emf[] = {{1.0, 1, 0.2, 0.0}};
static const hci_machine MACHINE = {.pole_pairs = P, .back_emf = emf, .back_emf_count = 1};

static el_list effects;
static hci_binned_sample sample[N];
static hci_segment segment[RUNS];
static hci_run run[RUNS];
static bool use[RUNS];
static hci_run_statistics statistics[RUNS];
static hci_binned_samples samples;
static hci_regression regression;
static hci_predicted_reading reading;
static hci_note note;
static double residual_Nm[N];

/* Steps of angle that differ, currents that stand still in the rotor frame; the second half is of another
 * run. */
void setUp(void)
{
    static const hci_effects none = {NULL, 0};
    memset(&effects, 0, sizeof effects);
    memset(sample, 0, sizeof sample);
    memset(run, 0, sizeof run);
    for (size_t k = 0; k < N; ++k) {
        const double theta_m = 0.1 + 0.12 * (double)k + 0.03 * sin(2.0 * (double)k);
        sample[k].reading.theta_m_rad = theta_m;
        sample[k].reading.speed_rad_per_s = 50.0;
        rec_phases(ID_A, IQ_A, P * theta_m, sample[k].reading.i_abc);
        sample[k].time_s = 0.01 * (double)k;
        sample[k].count = 1.0;
        sample[k].torque_Nm = 0.5 + 0.01 * (double)(k * k % 7);
        sample[k].raw = sample[k].reading;
    }
    for (size_t r = 0; r < RUNS; ++r) {
        segment[r] = (hci_segment){.run = r, .first = N / RUNS * r, .count = N / RUNS};
        run[r].torque_source = HCI_TORQUE_MEASURED;
        run[r].turn_known = true;
        use[r] = true;
    }
    samples = (hci_binned_samples){sample, N, segment, RUNS, statistics, RUNS};
    regression = (hci_regression){.machine = &MACHINE,
                                  .declared = &none,
                                  .declared_constant = 1.5 * K_NM_PER_A,
                                  .samples = &samples,
                                  .runs = run,
                                  .use = use};
}

void tearDown(void)
{
    hci_predicted_reading_release(&reading);
}

static void fill(size_t of, bool derivatives)
{
    hci_predicted_reading_release(&reading);
    TEST_ASSERT_TRUE(hci_predicted_reading_make(&regression, &effects.list, derivatives, &reading));
    hci_predicted_reading_fill(&regression, &effects.list, &segment[of], &reading);
}

/* ---- how long a sensor takes ---- */

static double settling_s(double tau_s, double frequency_Hz, double damping)
{
    memset(&effects, 0, sizeof effects);
    el_add(&effects, "cogging", "sine", 6.0, 0.03);
    el_add(&effects, "torque_sensor", "time_constant", 0.0, tau_s);
    el_add(&effects, "torque_sensor", "natural_frequency", 0.0, frequency_Hz);
    el_add(&effects, "torque_sensor", "damping", 0.0, damping);
    return hci_settling_s(&effects.list);
}

/* Sixteen time constants; of two poles that do not swing the slow one's. */
static void test_how_long_a_sensor_settles(void)
{
    const double w = 2.0 * REF_PI * 30.0;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_settling_s(&effects.list));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.032, settling_s(0.002, 0.0, 0.4));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 16.0 / (0.4 * w), settling_s(0.0, 30.0, 0.4));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.032 + 16.0 / (0.4 * w), settling_s(0.002, 30.0, 0.4));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 16.0 / ((1.6 - sqrt(1.56)) * w), settling_s(0.0, 30.0, 1.6));
    TEST_ASSERT_TRUE(isinf(settling_s(0.002, 30.0, 0.0)));
}

/* Those of the turns before that are not older, and four to tell inputs from; three turns at most. */
static void test_how_many_samples_that_is(void)
{
    const hci_segment turn = {.first = 0, .count = N, .turns = 5, .period_s = 0.405};
    static const double SETTLING_S[] = {0.0, 0.011, 0.1, 0.405, 0.43, 0.9, 1.1, 1.2149, 1.3, 9.0};
    for (size_t j = 0; j < sizeof SETTLING_S / sizeof *SETTLING_S; ++j) {
        size_t count = 4;
        for (int m = 1; m < 4; ++m)
            for (size_t k = 0; k < N; ++k)
                count += sample[k].time_s - m * turn.period_s >= sample[0].time_s - SETTLING_S[j];
        TEST_ASSERT_EQUAL_UINT64(count < 3 * N ? count : 3 * N,
                                 hci_settling_samples(sample, &turn, SETTLING_S[j]));
    }
    TEST_ASSERT_EQUAL_UINT64(3 * N, hci_settling_samples(sample, &turn, INFINITY));
}

/* ---- where it shows ---- */

static void test_where_a_sensor_shows(void)
{
    el_list declared = {.list = {NULL, 0}};
    el_add(&declared, "torque_sensor", "offset", 0.0, 0.1);
    TEST_ASSERT_FALSE(hci_predicted_reading_is_dynamic(&regression, &segment[0]));
    segment[0].timed = true;
    regression.declared = &declared.list;
    TEST_ASSERT_FALSE(hci_predicted_reading_is_dynamic(&regression, &segment[0]));
    segment[0].smooth = true;
    TEST_ASSERT_TRUE(hci_predicted_reading_is_dynamic(&regression, &segment[0]));
    segment[0].smooth = false;
    el_add(&declared, "torque_sensor", "time_constant", 0.0, 0.002);
    TEST_ASSERT_TRUE(hci_predicted_reading_is_dynamic(&regression, &segment[0]));
    declared.term[0][1].value = 0.0;
    TEST_ASSERT_FALSE(hci_predicted_reading_is_dynamic(&regression, &segment[0]));
    segment[0].smooth = true;
    run[0].torque_source = HCI_TORQUE_INERTIA;
    TEST_ASSERT_FALSE(hci_predicted_reading_is_dynamic(&regression, &segment[0]));
}

/* ---- means over a turn ---- */

/* Of a run that tells means alone: back-EMFs of other orders and cogging torque have none, not even rounding.
 */
static void test_a_run_of_means(void)
{
    el_add(&effects, "back_emf", "sine", 1.0, 0.03);
    el_add(&effects, "back_emf", "sine", 5.0, 0.04);
    el_add(&effects, "cogging", "cosine", 6.0, 0.05);
    el_add(&effects, "friction", "coulomb", 0.0, 0.06);
    run[1].only_mean = true;
    for (size_t k = 0; k < N; ++k) { /* at angle 0, i_q turns with the sample */
        sample[k].reading.theta_m_rad = 0.0;
        rec_phases(ID_A, IQ_A + 0.1 * (double)k, 0.0, sample[k].reading.i_abc);
    }
    fill(1, true);
    for (size_t k = 0; k < N / 2; ++k) {
        const double iq_A = IQ_A + 0.1 * (double)(k + N / 2), *by = reading.by_value + 4 * k;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5 * (K_NM_PER_A + 0.03) * iq_A - 0.06, reading.torque_Nm[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5 * iq_A, by[0]);
        TEST_ASSERT_TRUE(by[1] == 0.0 && by[2] == 0.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, -1.0, by[3]);
    }
    fill(1, false);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5 * (K_NM_PER_A + 0.03) * (IQ_A + 0.1 * (N / 2 + 1)) - 0.06,
                              reading.torque_Nm[1]);
}

/* ---- torques that stand for a current ---- */

/* In units of the declared torque per ampere, of magnets that are weaker by a share; of magnets that have
 * vanished a thousand times, and of what differs by rounding not at all. */
static void test_a_shaft_that_is_held(void)
{
    static const double LESS[4] = {0.5, 1.0, 0.9995, 1e-7}, SCALE[4] = {2.0, 1e3, 1e3, 1.0};
    run[0].torque_source = HCI_TORQUE_HOLDING;
    el_add(&effects, "back_emf", "sine", 1.0, 0.0);
    el_add(&effects, "friction", "coulomb", 0.0, 0.06);
    for (int j = 0; j < 4; ++j) {
        effects.term[0][0].value = -LESS[j] * K_NM_PER_A;
        fill(0, true);
        const double torque_Nm = 1.5 * K_NM_PER_A * (1.0 - LESS[j]) * IQ_A - 0.06;
        for (size_t k = 0; k < N / 2; ++k) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-9 * SCALE[j], SCALE[j] * torque_Nm, reading.torque_Nm[k]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9 * SCALE[j], SCALE[j] * 1.5 * IQ_A, reading.by_value[2 * k]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9 * SCALE[j], -SCALE[j], reading.by_value[2 * k + 1]);
        }
    }
}

/* The other run, and runs that are not in use, are as they are. */
static void test_runs_beside_one_that_is_held(void)
{
    el_add(&effects, "back_emf", "sine", 1.0, -0.1);
    run[0].torque_source = HCI_TORQUE_HOLDING;
    fill(1, true);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5 * 0.1 * IQ_A, reading.torque_Nm[2]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5 * IQ_A, reading.by_value[2]);
    use[0] = false;
    fill(0, true);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, reading.holding_scale);
    use[0] = true;
    regression.declared_constant = 0.0;
    fill(0, true);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, reading.holding_scale);
    run[0].torque_source = HCI_TORQUE_MEASURED;
    TEST_ASSERT_FALSE(hci_run_reads_current(&run[0]));
    run[0].hardly_accelerates = true;
    TEST_ASSERT_TRUE(hci_run_reads_current(&run[0]));
}

/* What friction makes is found times the torque per ampere, of a free shaft that hardly accelerates: its
 * derivative is less by the share of what the current makes, unless that is wanted apart. */
static void test_a_free_shaft_that_hardly_accelerates(void)
{
    run[0].torque_source = HCI_TORQUE_INERTIA;
    run[0].hardly_accelerates = true;
    el_add(&effects, "back_emf", "sine", 1.0, -0.05);
    el_add(&effects, "friction", "coulomb", 0.0, 0.06);
    fill(0, true);
    const double scale = 0.2 / 0.15, made_Nm = scale * 1.5 * 0.15 * IQ_A;
    for (size_t k = 0; k < N / 2; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, made_Nm - scale * 0.06, reading.torque_Nm[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, made_Nm, reading.current_Nm[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, scale * 1.5 * IQ_A - made_Nm / (1.5 * 0.15) * 1.5,
                                  reading.by_value[2 * k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, -scale, reading.by_value[2 * k + 1]);
    }
    reading.apart = true;
    hci_predicted_reading_fill(&regression, &effects.list, &segment[0], &reading);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, scale * 1.5 * IQ_A, reading.by_value[2 * 7]);
}

/* ---- means over bins ---- */

/* T at the mean angle and half the variance of the angles times the curvature of a parabola through three. */
static double widened(const double *torque_Nm, const double *theta, size_t before, size_t k, size_t after,
                      double turn_rad)
{
    const double behind = fabs(theta[k] - theta[before] + (before > k ? turn_rad : 0.0)),
                 ahead = fabs(theta[after] - theta[k] + (after < k ? turn_rad : 0.0));
    const double curvature =
        2.0 * ((torque_Nm[after] - torque_Nm[k]) / ahead - (torque_Nm[k] - torque_Nm[before]) / behind) /
        (behind + ahead);
    return torque_Nm[k] + 0.5 * sample[k].spread_rad2 * curvature;
}

/* Over a whole turn the last is followed by the first; without turns the ends stay as they are. A neighbour
 * that is nearer than a quarter of the mean step tells no curvature. */
static void check_wide_bins(bool is_turn)
{
    const size_t n = N / 2;
    double torque_Nm[N], theta[N];
    el_add(&effects, "cogging", "sine", 2.0, 0.04);
    el_add(&effects, "cogging", "cosine", 4.0, 0.02);
    segment[0].turns = is_turn ? 3 : 0;
    for (size_t k = 0; k < n; ++k) {
        theta[k] = 2.0 * REF_PI * (double)k / (double)n + 0.05 * sin(1.3 * (double)k);
        if (k == 9) theta[k] = theta[k - 1] + 0.23 * 2.0 * REF_PI / (double)n;
        sample[k].reading.theta_m_rad = theta[k];
        memset(sample[k].reading.i_abc, 0, sizeof sample[k].reading.i_abc);
        sample[k].spread_rad2 = k == 5 ? 0.0 : 0.002 + 0.0001 * (double)k;
        torque_Nm[k] = 0.04 * sin(2.0 * P * theta[k]) + 0.02 * cos(4.0 * P * theta[k]);
    }
    fill(0, true);
    for (size_t k = 0; k < n; ++k) {
        const bool is_end = !is_turn && (k == 0 || k + 1 == n);
        const double expected =
            is_end || k == 8 || k == 9 || k == 5
                ? torque_Nm[k]
                : widened(torque_Nm, theta, (k + n - 1) % n, k, (k + 1) % n, 2.0 * REF_PI);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected, reading.torque_Nm[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected,
                                  0.04 * reading.by_value[2 * k] + 0.02 * reading.by_value[2 * k + 1]);
    }
}

static void test_wide_bins_of_a_turn(void)
{
    check_wide_bins(true);
}

static void test_wide_bins_of_a_part_of_a_turn(void)
{
    check_wide_bins(false);
}

/* ---- along time ---- */

enum { FIRST = 50, TURN = 400, MANY = FIRST + 2 * TURN, ORDER = 2 };

static const double SPEED = 60.0, TAU_S = 0.004, SINE_NM = 0.5;

static hci_binned_sample many[MANY];

/* Two turns at a steady speed, of the second run, with a cogging torque alone. */
static void turn_steadily(size_t count, size_t turns)
{
    memset(many, 0, sizeof many);
    for (size_t k = FIRST; k < MANY; ++k) {
        hci_binned_sample *x = &many[k];
        x->reading.theta_m_rad = 0.3 + 2.0 * REF_PI * (double)(k - FIRST) / TURN;
        x->reading.speed_rad_per_s = SPEED;
        x->time_s = 2.0 * REF_PI / SPEED * (double)(k - FIRST) / TURN;
        x->count = 1.0;
        x->raw = x->reading;
    }
    segment[1] = (hci_segment){
        .run = 1, .first = FIRST, .count = count, .turns = turns, .timed = true, .smooth = true};
    segment[1].period_s = 2.0 * REF_PI / SPEED;
    samples.sample = many;
    samples.count = MANY;
    el_add(&effects, "cogging", "cosine", ORDER, 0.0);
    el_add(&effects, "cogging", "sine", ORDER, SINE_NM);
}

/* What a lag makes of sin x, at an angle: the imaginary part of e^jx/(1 + jwτ); and of its derivative by τ,
 * −jw e^jx/(1 + jwτ)². Between samples the torque runs straight, which is 1e-3 of it off. */
static void check_behind_a_lag(void)
{
    const double w = ORDER * P * SPEED, re = 1.0, im = w * TAU_S, square = re * re + im * im;
    el_add(&effects, "torque_sensor", "time_constant", 0.0, TAU_S);
    fill(1, true);
    for (size_t k = 0; k < segment[1].count; ++k) {
        const double x = ORDER * P * many[FIRST + k].reading.theta_m_rad;
        const double s = (sin(x) - im * cos(x)) / square, c = (cos(x) + im * sin(x)) / square;
        const double *by = reading.by_value + 3 * k;
        TEST_ASSERT_DOUBLE_WITHIN(2e-3, SINE_NM * s, reading.torque_Nm[k]);
        TEST_ASSERT_DOUBLE_WITHIN(2e-3, c, by[0]);
        TEST_ASSERT_DOUBLE_WITHIN(2e-3, s, by[1]);
        TEST_ASSERT_DOUBLE_WITHIN(2e-3 * w, -w * SINE_NM * (c + im * s) / square, by[2]);
    }
}

static void test_the_mean_of_a_turn_behind_a_lag(void)
{
    turn_steadily(TURN, 7);
    check_behind_a_lag();
    const size_t lead = hci_settling_samples(many + FIRST, &segment[1], 16.0 * TAU_S);
    TEST_ASSERT_EQUAL_UINT64(lead + TURN, reading.filtered);
}

/* A sensor has been there before a recording began: its first turn is run through before, or of less than one
 * its first electrical period. */
static void test_a_recording_behind_a_lag(void)
{
    turn_steadily(2 * TURN, 0);
    check_behind_a_lag();
    TEST_ASSERT_EQUAL_UINT64(TURN + 2 * TURN, reading.filtered);
    memset(&effects, 0, sizeof effects);
    turn_steadily(TURN - 40, 0);
    check_behind_a_lag();
    TEST_ASSERT_EQUAL_UINT64(TURN / P + 1 + TURN - 40, reading.filtered);
}

/* Of a shaft that accelerates the mean over the window of its slope, whose samples are those of the run: 9 of
 * 1 ms are 8/104.7 of a turn, 31 of its 400 samples and one. */
static void test_the_mean_of_a_turn_of_a_free_shaft(void)
{
    double time_s[4 * TURN], torque_Nm[4 * TURN], by[4 * TURN], work[8 * TURN], clock_s[101];
    for (size_t k = 0; k < 101; ++k)
        clock_s[k] = 5.0 + 0.001 * (double)k;
    run[1].time_s = clock_s;
    run[1].count = 101;
    run[1].torque_source = HCI_TORQUE_INERTIA;
    run[1].torque_window = 9;
    turn_steadily(TURN, 7);
    fill(1, true);
    for (size_t k = 0; k < 4 * TURN; ++k) {
        time_s[k] = many[FIRST + k % TURN].time_s + (double)(k / TURN) * segment[1].period_s;
        by[k] = sin(ORDER * P * many[FIRST + k % TURN].reading.theta_m_rad);
        torque_Nm[k] = SINE_NM * by[k];
    }
    hci_slope_average(time_s, 4 * TURN, 32, torque_Nm, 1, work);
    hci_slope_average(time_s, 4 * TURN, 32, by, 1, work);
    for (size_t k = 0; k < TURN; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, torque_Nm[2 * TURN + k], reading.torque_Nm[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, by[2 * TURN + k], reading.by_value[2 * k + 1]);
    }
    reading.instant = true; /* as it is at each sample */
    hci_predicted_reading_fill(&regression, &effects.list, &segment[1], &reading);
    for (size_t k = 0; k < TURN; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, SINE_NM * sin(ORDER * P * many[FIRST + k].reading.theta_m_rad),
                                  reading.torque_Nm[k]);
    run[1].time_s = NULL;
}

/* ---- residuals ---- */

/* Measured less modelled, of smoothed readings or of raw ones; 0 of runs that are not in use, and where a
 * sample tells nothing. */
static void test_residuals(void)
{
    el_add(&effects, "friction", "coulomb", 0.0, 0.06);
    for (size_t k = 0; k < N; ++k)
        rec_phases(ID_A, IQ_A + 1.0, P * sample[k].raw.theta_m_rad, sample[k].raw.i_abc);
    sample[3].count = 0.0;
    use[1] = false;
    for (int raw = 0; raw < 2; ++raw) {
        regression.raw = raw;
        TEST_ASSERT_EQUAL_INT(HCI_OK,
                              hci_regression_residual(&regression, &effects.list, residual_Nm, &note));
        for (size_t k = 0; k < N; ++k)
            TEST_ASSERT_DOUBLE_WITHIN(
                1e-12,
                k == 3 || k >= N / 2 ? 0.0 : sample[k].torque_Nm - 1.5 * K_NM_PER_A * (IQ_A + raw) + 0.06,
                residual_Nm[k]);
    }
}

/* Without its mean over the samples that tell, where that of a run is not known. */
static void test_residuals_of_an_unknown_mean(void)
{
    double mean = 0.0;
    sample[3].count = sample[4].count = 0.0;
    run[0].mean_is_unknown = true;
    for (size_t k = 0; k < N / 2; ++k)
        if (k != 3 && k != 4) mean += sample[k].torque_Nm / (N / 2 - 2);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_regression_residual(&regression, &effects.list, residual_Nm, &note));
    for (size_t k = 0; k < N; ++k) {
        const double made_Nm = k < N / 2 ? mean : 1.5 * K_NM_PER_A * IQ_A;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, k == 3 || k == 4 ? 0.0 : sample[k].torque_Nm - made_Nm,
                                  residual_Nm[k]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_how_long_a_sensor_settles);
    RUN_TEST(test_how_many_samples_that_is);
    RUN_TEST(test_where_a_sensor_shows);
    RUN_TEST(test_a_run_of_means);
    RUN_TEST(test_a_shaft_that_is_held);
    RUN_TEST(test_runs_beside_one_that_is_held);
    RUN_TEST(test_a_free_shaft_that_hardly_accelerates);
    RUN_TEST(test_wide_bins_of_a_turn);
    RUN_TEST(test_wide_bins_of_a_part_of_a_turn);
    RUN_TEST(test_the_mean_of_a_turn_behind_a_lag);
    RUN_TEST(test_a_recording_behind_a_lag);
    RUN_TEST(test_the_mean_of_a_turn_of_a_free_shaft);
    RUN_TEST(test_residuals);
    RUN_TEST(test_residuals_of_an_unknown_mean);
    return UNITY_END();
}
