/* Where a torque that no effect explains would tell its growth: closed forms of one and of two recordings;
 * and points that are far from all recordings, by their distances. */
#include "host/diagnose/next/unknown_points.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/next/trial_run.h"
#include "support/reference.h"
#include "unity.h"

enum { RUNS = 3, OF_RUN = 60, POLE_PAIRS = 3, POINTS = 3 };

static const double ORDER = 6.0, RMS_NM[RUNS] = {0.1, 0.2, 0.1}, PLAYED_RMS_NM = 0.5;

static hci_machine machine;
static hci_run run[RUNS];
static bool use[RUNS];
static hci_run_statistics statistics[RUNS];
static hci_segment segment[RUNS];
static hci_noise noise[RUNS];
static hci_binned_sample sample[RUNS * OF_RUN];
static double residual_Nm[RUNS * OF_RUN];
static hci_binned_samples samples;
static hci_regression regression;
static hci_playable playable;
static hci_telling_point chosen[POINTS];

/* Turns of `current_A` at a speed, which leave S sin 6·3θ + C cos 6·3θ + a mean. */
static void record(size_t r, double current_A, double speed_rad_per_s, const double left_Nm[3])
{
    statistics[r].current_A = statistics[r].mean_iq_A = current_A;
    statistics[r].mean_speed_rad_per_s = speed_rad_per_s;
    segment[r] = (hci_segment){.run = r, .first = r * OF_RUN, .count = OF_RUN};
    noise[r].rms = RMS_NM[r];
    use[r] = true;
    for (size_t k = 0; k < OF_RUN; ++k) {
        const double theta = 2.0 * REF_PI * (double)k / OF_RUN, x = ORDER * POLE_PAIRS * theta;
        sample[r * OF_RUN + k].reading.theta_m_rad = theta;
        sample[r * OF_RUN + k].reading.speed_rad_per_s = speed_rad_per_s;
        residual_Nm[r * OF_RUN + k] = left_Nm[0] * sin(x) + left_Nm[1] * cos(x) + left_Nm[2];
    }
    samples.run_count = samples.segment_count = r + 1;
    samples.count = (r + 1) * OF_RUN;
}

void setUp(void)
{
    machine = (hci_machine){.pole_pairs = POLE_PAIRS};
    memset(run, 0, sizeof run);
    memset(statistics, 0, sizeof statistics);
    samples = (hci_binned_samples){.sample = sample, .segment = segment, .statistics = statistics};
    regression =
        (hci_regression){.machine = &machine, .samples = &samples, .runs = run, .use = use, .noise = noise};
    playable = (hci_playable){
        .most_A = 8.0, .least_rad_per_s = 10.0, .most_rad_per_s = 1000.0, .noise_Nm = PLAYED_RMS_NM};
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
}

/* ---- laws of growth ---- */

static size_t find(double order, const hci_operating_point *point, size_t count, size_t most)
{
    hci_note note = {{0}};
    size_t found = 99;
    const hci_open_orders open = {residual_Nm, &order, 1};
    const hci_point_choice choice = {point, count, most, chosen};
    TEST_ASSERT_EQUAL(HCI_OK, hci_points_of_growth(&regression, &open, &playable, &choice, &found, &note));
    return found;
}

/* By how much the laws differ at a point: Σ b (p − Σ b p)², p the law there over the law in the run. */
static double variance_at(const double belief[HCI_GROWTH_LAWS], const double unit[HCI_GROWTH_LAWS],
                          const hci_operating_point *at)
{
    double mean = 0.0, square = 0.0, sum = 0.0;
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g)
        sum += belief[g];
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g) {
        const double p = unit[g] * hci_growth_law_at(g, hypot(at->id_A, at->iq_A), at->speed_rad_per_s);
        mean += belief[g] / sum * p;
        square += belief[g] / sum * p * p;
    }
    return square - mean * mean;
}

/* One recording fits all laws equally. χ² is ten turns of samples over the noise, half of it for a wave. */
static void test_one_recording(void)
{
    const hci_operating_point point[] = {{0.0, 2.0, 40.0}, {-2.4, 3.2, 40.0}, {0.0, 2.0, 60.0}};
    const double turns = 10.0 * (double)hci_trial_run_samples(POLE_PAIRS) / (PLAYED_RMS_NM * PLAYED_RMS_NM);
    double belief[HCI_GROWTH_LAWS], unit[HCI_GROWTH_LAWS];
    record(0, 2.0, 40.0, (const double[]){0.3, -0.4, 0.2});
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g) {
        belief[g] = 1.0;
        unit[g] = 1.0 / hci_growth_law_at(g, 2.0, 40.0);
    }
    for (int mean = 0; mean < 2; ++mean) {
        const double size_Nm = mean ? 0.2 : 0.5;
        TEST_ASSERT_EQUAL(1, find(mean ? 0.0 : ORDER, point + 1, 1, 1));
        const double variance = size_Nm * size_Nm * variance_at(belief, unit, &point[1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-8 * turns * variance, turns * variance * (mean ? 1.0 : 0.5),
                                  chosen[0].chi_square);
        TEST_ASSERT_DOUBLE_WITHIN(1e-8, sqrt(variance), chosen[0].spread_Nm);
        TEST_ASSERT_EQUAL_DOUBLE(mean ? 0.0 : ORDER, chosen[0].order);
    }
    TEST_ASSERT_EQUAL(0, find(ORDER, point, 1, 1)); /* where it was recorded there is nothing open */
    TEST_ASSERT_TRUE(find(ORDER, point, 3, 1) == 1 && chosen[0].point > 0);
}

/* Σ w (A − by x)² of each law makes its belief: w is n/2 over the variance of a sample. Noise is so large
 * that several laws remain. */
static void test_two_recordings(void)
{
    const double amplitude_Nm[] = {0.02, 0.05}, current_A[] = {2.0, 4.0};
    const hci_operating_point point = {0.0, 8.0, 40.0};
    double belief[HCI_GROWTH_LAWS], unit[HCI_GROWTH_LAWS], best = INFINITY;
    for (size_t r = 0; r < 2; ++r)
        record(r, current_A[r], 40.0, (const double[]){0.6 * amplitude_Nm[r], 0.8 * amplitude_Nm[r], 0.0});
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g) {
        double ay = 0.0, yy = 0.0, aa = 0.0;
        for (size_t r = 0; r < 2; ++r) {
            const double weight = 0.5 * OF_RUN / (RMS_NM[r] * RMS_NM[r]);
            const double by = hci_growth_law_at(g, current_A[r], 40.0);
            ay += weight * by * amplitude_Nm[r];
            yy += weight * by * by;
            aa += weight * amplitude_Nm[r] * amplitude_Nm[r];
        }
        unit[g] = ay / yy;
        belief[g] = aa - ay * ay / yy; /* χ² for now */
        best = fmin(best, belief[g]);
    }
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g)
        belief[g] = exp(-0.5 * (belief[g] - best));
    playable.noise_Nm = 1e-3;
    TEST_ASSERT_EQUAL(1, find(ORDER, &point, 1, 1));
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, sqrt(variance_at(belief, unit, &point)), chosen[0].spread_Nm);
    use[1] = false; /* the first alone tells less */
    TEST_ASSERT_EQUAL(1, find(ORDER, &point, 1, 1));
    const double alone_Nm = chosen[0].spread_Nm;
    use[1] = true;
    run[1].zero_is_unknown = true; /* and so where the angle has no zero */
    TEST_ASSERT_EQUAL(1, find(ORDER, &point, 1, 1));
    TEST_ASSERT_EQUAL_DOUBLE(alone_Nm, chosen[0].spread_Nm);
}

/* √χ² of each law at a point, of the size that one recording of 2 A at 40 rad/s has left. */
static void departures(double size_Nm, const hci_operating_point *at, double x[HCI_GROWTH_LAWS])
{
    const double played = 10.0 * (double)hci_trial_run_samples(POLE_PAIRS);
    double mean = 0.0;
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g) {
        x[g] = hci_growth_law_at(g, hypot(at->id_A, at->iq_A), at->speed_rad_per_s) /
               hci_growth_law_at(g, 2.0, 40.0);
        mean += x[g] / HCI_GROWTH_LAWS;
    }
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g)
        x[g] = size_Nm / playable.noise_Nm * sqrt(0.5 * played / HCI_GROWTH_LAWS) * (x[g] - mean);
}

/* What a recording with noise of 1 leaves of another point's departures y is y − x (x·y)/(x·x + 1). */
static void test_what_one_point_leaves_of_another(void)
{
    const hci_operating_point point[] = {{0.0, 2.4, 40.0}, {0.0, 2.2, 46.0}};
    double x[HCI_GROWTH_LAWS], y[HCI_GROWTH_LAWS], xx = 0.0, xy = 0.0, left = 0.0;
    record(0, 2.0, 40.0, (const double[]){0.3, -0.4, 0.0});
    playable.noise_Nm = 1.0; /* so that it is not large beside 1 */
    departures(0.5, &point[0], x);
    departures(0.5, &point[1], y);
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g) {
        xx += x[g] * x[g];
        xy += x[g] * y[g];
    }
    for (size_t g = 0; g < HCI_GROWTH_LAWS; ++g)
        left += pow(y[g] - x[g] * xy / (xx + 1.0), 2.0);
    TEST_ASSERT_EQUAL(2, find(ORDER, point, 2, 2));
    TEST_ASSERT_EQUAL(0, chosen[0].point);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * xx, xx, chosen[0].chi_square);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * xx, left, chosen[1].chi_square);
    TEST_ASSERT_TRUE(xx < 40.0 && xy * xy > 0.01 * xx * left); /* it is neither all nor nothing */
}

/* Once a point has been recorded, the same one tells nothing more. */
static void test_what_is_chosen_is_known(void)
{
    const hci_operating_point point[] = {{0.0, 4.0, 40.0}, {0.0, 8.0, 40.0}, {0.0, 8.0, 40.0}};
    record(0, 2.0, 40.0, (const double[]){0.3, -0.4, 0.0});
    TEST_ASSERT_EQUAL(1, find(ORDER, point + 1, 2, 2));
    TEST_ASSERT_EQUAL(0, chosen[0].point);
    TEST_ASSERT_TRUE(find(ORDER, point, 2, 2) >= 1);
    TEST_ASSERT_EQUAL(1, chosen[0].point);
    playable.noise_Nm = 0.0;
    TEST_ASSERT_EQUAL(0, find(ORDER, point, 2, 2));
}

/* ---- far from what was recorded ---- */

/* Currents over 8 A, log speeds over two decades, and the direction. */
static void test_the_furthest_from_all_recordings(void)
{
    const hci_operating_point point[] = {{0.0, 8.0, 100.0}, {-6.0, 0.0, 100.0}, {0.0, 0.0, -100.0}};
    const hci_point_choice choice = {point, 3, 3, chosen};
    record(0, 2.0, 100.0, (const double[]){0.0, 0.0, 0.0});
    TEST_ASSERT_EQUAL(3, hci_points_not_recorded(&regression, &playable, &choice));
    TEST_ASSERT_EQUAL(2, chosen[0].point); /* 2 away by its direction; then √(0.75² + 0.25²) and 0.75 */
    TEST_ASSERT_EQUAL(1, chosen[1].point);
    TEST_ASSERT_EQUAL(0, chosen[2].point);
    TEST_ASSERT_TRUE(isnan(chosen[0].chi_square) && isnan(chosen[0].order));
    record(1, 0.0, -100.0, (const double[]){0.0, 0.0, 0.0}); /* the very point, backward */
    TEST_ASSERT_EQUAL(2, hci_points_not_recorded(&regression, &playable, &choice));
    TEST_ASSERT_EQUAL(1, chosen[0].point);
    segment[1].run = 0; /* without samples it is no recording */
    TEST_ASSERT_EQUAL(3, hci_points_not_recorded(&regression, &playable, &choice));
}

/* A tenth of the range of the logarithm is as far as a tenth of the current. */
static void test_speeds_by_their_logarithm(void)
{
    for (int faster = 0; faster < 2; ++faster) {
        const hci_operating_point point[] = {{0.0, 2.0, 100.0 * pow(100.0, faster ? 0.52 : 0.48)},
                                             {0.0, 6.0, 100.0}};
        const hci_point_choice choice = {point, 2, 1, chosen};
        record(0, 2.0, 100.0, (const double[]){0.0, 0.0, 0.0});
        TEST_ASSERT_EQUAL(1, hci_points_not_recorded(&regression, &playable, &choice));
        TEST_ASSERT_EQUAL(faster ? 0 : 1, chosen[0].point);
    }
}

/* A run that stands has no direction; one whose current is noise has none in q; chosen points are near to
 * each other. */
static void test_what_is_near(void)
{
    const hci_operating_point point[] = {{0.0, 0.0, 10.0}, {0.0, 0.0, -10.0}, {0.0, 0.8, 10.0}};
    const hci_point_choice choice = {point, 2, 2, chosen}, all = {point, 3, 3, chosen};
    record(0, 4.0, 4.9, (const double[]){0.0, 0.0, 0.0});
    statistics[0].no_current = true;
    TEST_ASSERT_EQUAL(0, hci_points_not_recorded(&regression, &playable, &choice));
    statistics[0].mean_speed_rad_per_s = 5.1;
    TEST_ASSERT_EQUAL(1, hci_points_not_recorded(&regression, &playable, &choice));
    TEST_ASSERT_EQUAL(1, chosen[0].point);
    TEST_ASSERT_EQUAL(2, hci_points_not_recorded(&regression, &playable, &all));
    statistics[0].no_current = false;
    TEST_ASSERT_EQUAL(3, hci_points_not_recorded(&regression, &playable, &all));
    TEST_ASSERT_EQUAL(1, chosen[0].point);
    TEST_ASSERT_EQUAL(0, chosen[1].point); /* 0.5 from the run; the other one 0.4 */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_one_recording);
    RUN_TEST(test_two_recordings);
    RUN_TEST(test_what_one_point_leaves_of_another);
    RUN_TEST(test_what_is_chosen_is_known);
    RUN_TEST(test_the_furthest_from_all_recordings);
    RUN_TEST(test_speeds_by_their_logarithm);
    RUN_TEST(test_what_is_near);
    return UNITY_END();
}
