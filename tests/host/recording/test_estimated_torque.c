/* A torque that a drive has estimated from its current behind a filter is never taken as measured, and a
 * measured one, even of a sensor that lags, is never taken for an estimate. */
#include "hci/host/recording/run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "support/draws.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

enum { N = 3000, POLE_PAIRS = 4, RUNS = 3 };

static const double FILTER_S = 2e-3, STEP_S = 7e-4, CONSTANT = 0.3;

/* What makes the torque column. */
typedef enum { ESTIMATED, MEASURED, LAGS, CLIPPED } made_by;

static hci_runs runs;
static hci_note note;
static uint64_t seed;
static double zero_A; /* of the current sensors as it is logged, in i_q an electrical order 1 */

void setUp(void)
{
    files_begin();
    memset(&runs, 0, sizeof runs);
    memset(&note, 0, sizeof note);
    seed = 3;
    zero_A = 0.0;
}

void tearDown(void)
{
    hci_runs_release(&runs);
    files_end();
}

/* A run at a mean i_q: its current sensors have noise, the machine has cogging torque of order 6, and what
 * is logged is rounded to 2.5 mN·m. */
static void run_write(const char *name, made_by by, double mean_A)
{
    double filtered = 0.0, before = 0.0;
    FILE *file = fopen(files_path(name), "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,id_A,iq_A,torque_Nm\n");
    for (size_t k = 0; k < N; ++k) {
        const double theta_m = 0.0137 * (double)k;
        const double ripple_A = 0.02 * mean_A * sin(6.0 * POLE_PAIRS * theta_m);
        const double noise_A = 0.03 * ref_normal(&seed), true_A = mean_A + ripple_A;
        const double off_A = zero_A * cos(POLE_PAIRS * theta_m + 0.5);
        const double cogging_Nm = by == ESTIMATED ? 0.0 : 0.05 * sin(6.0 * POLE_PAIRS * theta_m + 0.3);
        const double x = CONSTANT * (true_A + (by == ESTIMATED ? noise_A : 0.0)) + cogging_Nm;
        const double slope = k > 0 ? (x - before) / STEP_S : 0.0;
        const double keeps = exp(-STEP_S / FILTER_S);
        filtered = k > 0 ? x - slope * FILTER_S + (filtered - before + slope * FILTER_S) * keeps : x;
        before = x;
        const double torque_Nm =
            (by == MEASURED ? x : filtered) + (by == ESTIMATED ? 0.0 : 0.004 * ref_normal(&seed));
        fprintf(file, "%.6f,%.6f,%.6f,%.6f,%.6g\n", STEP_S * (double)k, theta_m, 0.01 * ref_normal(&seed),
                true_A + noise_A + off_A, 0.0025 * floor(torque_Nm / 0.0025 + 0.5));
    }
    fclose(file);
}

static void list_of_runs_read(double inertia_kgm2)
{
    const hci_runs_options options = {.run = {.pole_pairs = POLE_PAIRS,
                                              .inertia_kgm2 = inertia_kgm2,
                                              .torque_constant_Nm_per_A = CONSTANT}};
    FILE *list = fopen(files_path("list.csv"), "w");
    TEST_ASSERT_NOT_NULL(list);
    fprintf(list, "file,role\n");
    for (int k = 0; k < RUNS; ++k)
        fprintf(list, "run%d.csv,fit\n", k);
    fclose(list);
    hci_runs_release(&runs);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_runs_read(files_path("list.csv"), &options, &runs, &note),
                              note.text);
}

static const char *const NAMES[RUNS] = {"run0.csv", "run1.csv", "run2.csv"};

static void list_read(made_by by, const double mean_A[RUNS], double inertia_kgm2)
{
    for (int k = 0; k < RUNS; ++k)
        run_write(NAMES[k], by, mean_A[k]);
    list_of_runs_read(inertia_kgm2);
}

static const double LOADED[RUNS] = {0.0, 8.0, -5.0}, IDLE[RUNS] = {0.0, 0.0, 0.0};

static void test_an_estimate_behind_a_filter_is_not_used(void)
{
    list_read(ESTIMATED, LOADED, NAN);
    for (size_t k = 0; k < RUNS; ++k) {
        TEST_ASSERT_NULL(runs.run[k].torque_Nm);
        TEST_ASSERT_EQUAL(HCI_TORQUE_NONE, runs.run[k].torque_source);
        text_has("estimated from the current and not measured", runs.run[k].remark.text);
    }
    text_has("times i_q behind a filter of 2", runs.run[1].remark.text);
}

static void test_without_a_current_it_follows_the_noise(void)
{
    list_read(ESTIMATED, IDLE, NAN);
    for (size_t k = 0; k < RUNS; ++k)
        TEST_ASSERT_NULL(runs.run[k].torque_Nm);
}

/* A drive that takes the zeros of its sensors out of its estimate, and logs the currents with them. */
static void test_without_a_current_zeros_of_sensors_are_no_noise(void)
{
    zero_A = 0.1;
    list_read(ESTIMATED, IDLE, NAN);
    for (size_t k = 0; k < RUNS; ++k)
        TEST_ASSERT_NULL(runs.run[k].torque_Nm);
    list_read(LAGS, IDLE, NAN);
    for (size_t k = 0; k < RUNS; ++k)
        TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, runs.run[k].torque_source);
}

static void test_what_is_left_is_a_free_shaft(void)
{
    list_read(ESTIMATED, LOADED, 1e-3);
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, runs.run[1].torque_source);
}

/* Three phase currents of a steady i_q that varies by the noise of their sensors, and a torque that is
 * CONSTANT times it: all in steps, as loggers write them. MEASURED: with cogging of 5 mN·m. */
static void run_of_noise_write(const char *name, made_by by, double mean_A, double step_A, double step_Nm)
{
    FILE *file = fopen(files_path(name), "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\n");
    for (size_t k = 0; k < N; ++k) {
        const double theta_m = 0.0063 * (double)k;
        double i_A[3], q_A = 0.0;
        for (int phase = 0; phase < 3; ++phase) {
            const double angle = POLE_PAIRS * theta_m - phase * 2.0943951023931953;
            i_A[phase] = mean_A * sin(angle) + 0.03 * ref_normal(&seed);
            q_A += 2.0 / 3.0 * i_A[phase] * sin(angle);
            i_A[phase] = step_A * floor(i_A[phase] / step_A + 0.5);
        }
        const double cogging_Nm = by == MEASURED ? 0.005 * sin(24.0 * theta_m) : 0.0;
        const double torque_Nm = step_Nm * floor((CONSTANT * q_A + cogging_Nm) / step_Nm + 0.5);
        fprintf(file, "%.4f,%.6f,%.6f,%.6f,%.6f,%.6f\n", 2e-3 * (double)k, theta_m, i_A[0], i_A[1], i_A[2],
                by == CLIPPED ? fmax(-0.5, fmin(0.5, torque_Nm)) : torque_Nm);
    }
    fclose(file);
}

static void noisy_list_read(made_by by, double step_A, double step_Nm)
{
    static const double MEAN_A[RUNS] = {5.0, 8.0, -3.0};
    for (int k = 0; k < RUNS; ++k)
        run_of_noise_write(NAMES[k], by, MEAN_A[k], step_A, step_Nm);
    list_of_runs_read(NAN);
}

static void test_a_torque_that_follows_the_noise_of_a_steady_current_is_computed(void)
{
    static const double STEPS[][2] = {{1e-6, 1e-6}, {1e-3, 1e-4}, {1e-3, 1e-6}, {1e-6, 1e-3}, {1e-2, 2e-3}};
    for (size_t j = 0; j < sizeof STEPS / sizeof *STEPS; ++j) {
        noisy_list_read(ESTIMATED, STEPS[j][0], STEPS[j][1]);
        for (size_t k = 0; k < RUNS; ++k)
            TEST_ASSERT_NULL(runs.run[k].torque_Nm);
        text_has("0.3 N·m/A times i_q in every row: computed from the current", runs.run[1].remark.text);
    }
}

static void test_beside_a_small_cogging_it_is_not(void)
{
    static const double STEPS[][2] = {{1e-6, 1e-6}, {1e-3, 1e-4}, {1e-3, 1e-6}, {1e-6, 1e-3}};
    for (size_t j = 0; j < sizeof STEPS / sizeof *STEPS; ++j) {
        noisy_list_read(MEASURED, STEPS[j][0], STEPS[j][1]);
        for (size_t k = 0; k < RUNS; ++k)
            TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, runs.run[k].torque_source);
    }
}

static void test_one_number_at_two_currents_is_the_end_of_a_sensor(void)
{
    noisy_list_read(CLIPPED, 1e-3, 1e-4);
    for (size_t k = 0; k < RUNS; ++k) {
        TEST_ASSERT_TRUE(runs.run[k].torque_is_typed && runs.run[k].torque_is_clipped);
        text_has("N·m at another current: both are the end", runs.run[k].remark.text);
    }
}

/* One number beside three phase currents of a mean i_q that varies by a share of it. */
static void number_write(const char *name, double torque_Nm, double mean_A, double varies)
{
    FILE *file = fopen(files_path(name), "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\n");
    for (size_t k = 0; k < N; ++k) {
        const double theta_m = 0.0063 * (double)k, q_A = mean_A * (1.0 + varies * ref_normal(&seed));
        fprintf(file, "%.4f,%.6f", 2e-3 * (double)k, theta_m);
        for (int phase = 0; phase < 3; ++phase)
            fprintf(file, ",%.6f", q_A * sin(POLE_PAIRS * theta_m - phase * 2.0943951023931953));
        fprintf(file, ",%.6f\n", torque_Nm);
    }
    fclose(file);
}

/* Of currents that vary by less than a thousandth another recording tells; its own number is another one's.
 */
static void test_one_number_of_steady_currents_is_typed(void)
{
    static const double MEAN_A[][RUNS] = {{5.0, 8.0, 3.0}, {5.0, 8.0, 8.0}}, VARIES[] = {1e-4, 1e-2};
    for (size_t j = 0; j < 2; ++j) {
        for (int k = 0; k < RUNS; ++k)
            number_write(NAMES[k], 1.25, MEAN_A[j][k], k == 2 ? VARIES[j] : 1e-4);
        list_of_runs_read(NAN);
        for (size_t k = 0; k < RUNS; ++k) {
            TEST_ASSERT_TRUE(runs.run[k].torque_is_typed);
            TEST_ASSERT_EQUAL(HCI_TORQUE_NONE, runs.run[k].torque_source);
            TEST_ASSERT_NULL(runs.run[k].torque_Nm);
        }
    }
}

/* Of one current, of none, and other numbers of other currents: means, that nobody need have typed. */
static void test_means_of_steady_currents_stay(void)
{
    static const double TORQUE_Nm[][RUNS] = {{1.25, 1.25, 1.25}, {-0.02, -0.02, 1.25}, {1.25, 2.0, 0.75}},
                        MEAN_A[][RUNS] = {{5.0, 5.1, 5.0}, {0.002, 0.001, 5.0}, {5.0, 8.0, 3.0}};
    for (size_t j = 0; j < 3; ++j) {
        for (int k = 0; k < RUNS; ++k)
            number_write(NAMES[k], TORQUE_Nm[j][k], MEAN_A[j][k], 1e-4);
        list_of_runs_read(NAN);
        for (size_t k = 0; k < RUNS; ++k)
            TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, runs.run[k].torque_source);
    }
}

static void test_a_measured_torque_stays(void)
{
    static const made_by BY[] = {MEASURED, LAGS};
    for (size_t j = 0; j < 2; ++j) {
        list_read(BY[j], LOADED, NAN);
        for (size_t k = 0; k < RUNS; ++k)
            TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, runs.run[k].torque_source);
        list_read(BY[j], IDLE, NAN);
        for (size_t k = 0; k < RUNS; ++k)
            TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, runs.run[k].torque_source);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_estimate_behind_a_filter_is_not_used);
    RUN_TEST(test_without_a_current_it_follows_the_noise);
    RUN_TEST(test_without_a_current_zeros_of_sensors_are_no_noise);
    RUN_TEST(test_what_is_left_is_a_free_shaft);
    RUN_TEST(test_a_torque_that_follows_the_noise_of_a_steady_current_is_computed);
    RUN_TEST(test_beside_a_small_cogging_it_is_not);
    RUN_TEST(test_one_number_at_two_currents_is_the_end_of_a_sensor);
    RUN_TEST(test_one_number_of_steady_currents_is_typed);
    RUN_TEST(test_means_of_steady_currents_stay);
    RUN_TEST(test_a_measured_torque_stays);
    return UNITY_END();
}
