/* What a regression looks at: runs in use, one at a time, and the work that is counted. */
#include "host/diagnose/reading/regression.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/fit/noise_estimate.h"
#include "support/draws.h"
#include "unity.h"

enum { RUNS = 4, SEGMENTS = 5, EACH = 20 };

/* Run 1 has two segments. */
static const size_t RUN[SEGMENTS] = {0, 1, 1, 2, 3};

static const hci_machine MACHINE = {.pole_pairs = 2};
static hci_binned_sample sample[SEGMENTS * EACH];
static hci_segment segment[SEGMENTS];
static hci_noise noise[SEGMENTS];
static hci_run run[RUNS];
static bool use[RUNS];
static hci_run_statistics statistics[RUNS];
static hci_binned_samples samples;
static hci_regression regression;
static hci_note note;
static double residual_Nm[SEGMENTS * EACH];

void setUp(void)
{
    uint64_t seed = 2;
    memset(sample, 0, sizeof sample);
    memset(run, 0, sizeof run);
    memset(noise, 0, sizeof noise);
    memset(statistics, 0, sizeof statistics);
    for (size_t n = 0; n < SEGMENTS; ++n)
        segment[n] = (hci_segment){.run = RUN[n], .first = EACH * n, .count = EACH};
    for (size_t k = 0; k < SEGMENTS * EACH; ++k) {
        sample[k].count = 1.0;
        residual_Nm[k] = ref_normal(&seed);
    }
    for (size_t r = 0; r < RUNS; ++r) {
        use[r] = r % 2 == 1;
        run[r].torque_source = HCI_TORQUE_MEASURED;
    }
    samples = (hci_binned_samples){sample, SEGMENTS * EACH, segment, SEGMENTS, statistics, RUNS};
    regression =
        (hci_regression){.machine = &MACHINE, .samples = &samples, .runs = run, .use = use, .noise = noise};
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
}

/* ---- runs in use ---- */

static void test_segments_of_runs_in_use(void)
{
    static const size_t EXPECTED[] = {1, 2, 4};
    const hci_segment *s = NULL;
    for (int k = 0; k < 3; ++k) {
        s = hci_regression_next(&regression, s);
        TEST_ASSERT_EQUAL_PTR(&segment[EXPECTED[k]], s);
        TEST_ASSERT_EQUAL_PTR(&noise[EXPECTED[k]], hci_regression_noise(&regression, s));
    }
    TEST_ASSERT_NULL(hci_regression_next(&regression, s));
    TEST_ASSERT_EQUAL_UINT64(2, hci_regression_runs_in_use(&regression));
    use[0] = true;
    use[3] = false;
    TEST_ASSERT_EQUAL_PTR(&segment[0], hci_regression_next(&regression, NULL));
    TEST_ASSERT_NULL(hci_regression_next(&regression, &segment[2]));
}

static void test_slopes_of_runs_in_use(void)
{
    TEST_ASSERT_FALSE(hci_regression_has_slopes(&regression));
    run[2].torque_source = HCI_TORQUE_INERTIA;
    TEST_ASSERT_FALSE(hci_regression_has_slopes(&regression));
    run[1].torque_source = HCI_TORQUE_INERTIA;
    TEST_ASSERT_TRUE(hci_regression_has_slopes(&regression));
}

static double unknown_Nm(size_t k)
{
    return hci_regression_mean_unknown_Nm(&regression, &segment[k]);
}

/* A mean says nothing where it is not known, and where all are free, but of a run that has nothing else. */
static void test_means_that_are_not_known(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0.0, unknown_Nm(1));
    run[1].mean_is_unknown = true;
    TEST_ASSERT_TRUE(isinf(unknown_Nm(1)));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, unknown_Nm(4));
    regression.free_means = true;
    TEST_ASSERT_TRUE(isinf(unknown_Nm(4)));
    run[3].only_mean = true;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, unknown_Nm(4));
}

/* Of a run that drifts along a line it is known within 1/sqrt(12) of what the torque creeps by, as if it were
 * even. */
static void test_means_of_a_drift(void)
{
    statistics[1].drift = (hci_drift){.degree = 1, .half_s = 2.0, .coefficient_Nm = {0.3}};
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.6 / sqrt(12.0), unknown_Nm(1));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, unknown_Nm(4));
}

/* ---- one at a time ---- */

typedef struct {
    size_t visited[RUNS], count, stop_at;
} visits;

static hci_status visit(void *context, size_t of, hci_note *unused)
{
    visits *v = context;
    (void)unused;
    for (size_t r = 0; r < RUNS; ++r)
        TEST_ASSERT_EQUAL(r == of, regression.use[r]);
    v->visited[v->count++] = of;
    return v->count == v->stop_at ? HCI_ERROR_NUMERIC : HCI_OK;
}

static void test_each_run_by_itself(void)
{
    visits v = {.stop_at = 0};
    use[0] = true;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_regression_each_run(&regression, visit, &v, &note));
    TEST_ASSERT_EQUAL_UINT64(3, v.count);
    TEST_ASSERT_TRUE(v.visited[0] == 0 && v.visited[1] == 1 && v.visited[2] == 3);
    TEST_ASSERT_EQUAL_PTR(use, regression.use);
    v = (visits){.stop_at = 2};
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_NUMERIC, hci_regression_each_run(&regression, visit, &v, &note));
    TEST_ASSERT_EQUAL_UINT64(2, v.count);
    TEST_ASSERT_EQUAL_PTR(use, regression.use);
    v = (visits){.stop_at = 0};
    hci_memory_fail_after(0);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, hci_regression_each_run(&regression, visit, &v, &note));
    TEST_ASSERT_EQUAL_UINT64(0, v.count);
}

/* ---- work ---- */

/* Of a prediction 4000 products a sample and 250 a term; of a stage of a sensor 60 a column and its torque,
 * and 6000 where its own parameters are asked for. */
static void test_work_that_is_counted(void)
{
    double work = 5.0;
    hci_regression_count(&regression, 7, 3); /* nobody counts */
    regression.work = &work;
    hci_regression_count(&regression, 7, 3);
    TEST_ASSERT_EQUAL_DOUBLE(5.0 + 7.0 * 4750.0, work);
    hci_regression_count_filtered(&regression, 7, 0);
    TEST_ASSERT_EQUAL_DOUBLE(5.0 + 7.0 * 4810.0, work);
    hci_regression_count_filtered(&regression, 2, 4);
    TEST_ASSERT_EQUAL_DOUBLE(5.0 + 7.0 * 4810.0 + 2.0 * 6300.0, work);
    hci_regression_count_products(&regression, 11.0);
    TEST_ASSERT_EQUAL_DOUBLE(16.0 + 7.0 * 4810.0 + 2.0 * 6300.0, work);
    regression.work_times = 4.0; /* as much may be taken */
    hci_regression_count_products(&regression, 12.0);
    TEST_ASSERT_EQUAL_DOUBLE(19.0 + 7.0 * 4810.0 + 2.0 * 6300.0, work);
    regression.work_times = 0.0;
}

/* ---- noise of short segments ---- */

static double square_of_use(void)
{
    double square = 0.0;
    for (size_t n = 0; n < SEGMENTS; ++n)
        for (size_t k = EACH * n; use[RUN[n]] && k < EACH * (n + 1); ++k)
            square += residual_Nm[k] * residual_Nm[k];
    return square;
}

/* They share one white noise: squares over rows that tell less parameters, a quarter of the rows at least,
 * and a floor. */
static void expect_noise(size_t parameters, double freedom)
{
    const double floor_Nm = 0.3, rms = hypot(sqrt(square_of_use() / freedom), floor_Nm);
    memset(noise, 0, sizeof noise);
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_regression_noise_estimate(&regression, residual_Nm, parameters, floor_Nm, &note));
    for (size_t n = 0; n < SEGMENTS; ++n) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, use[RUN[n]] ? rms : 0.0, noise[n].rms);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, use[RUN[n]] ? rms : 0.0, noise[n].innovation);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, noise[n].prediction[0]);
    }
}

static void test_noise_of_short_segments(void)
{
    expect_noise(0, 60.0);
    expect_noise(13, 47.0);
    expect_noise(44, 16.0);
    expect_noise(46, 15.0);
    expect_noise(300, 15.0);
    sample[EACH + 3].count = sample[EACH + 9].count = 0.0;
    expect_noise(13, 45.0);
}

/* Never none, so that a residual of 0 can be weighted. */
static void test_noise_of_no_residual(void)
{
    memset(residual_Nm, 0, sizeof residual_Nm);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_regression_noise_estimate(&regression, residual_Nm, 2, 0.0, &note));
    TEST_ASSERT_EQUAL_DOUBLE(1e-9, noise[1].rms);
    hci_memory_fail_after(0);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY,
                          hci_regression_noise_estimate(&regression, residual_Nm, 2, 0.0, &note));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_segments_of_runs_in_use);
    RUN_TEST(test_slopes_of_runs_in_use);
    RUN_TEST(test_means_that_are_not_known);
    RUN_TEST(test_means_of_a_drift);
    RUN_TEST(test_each_run_by_itself);
    RUN_TEST(test_work_that_is_counted);
    RUN_TEST(test_noise_of_short_segments);
    RUN_TEST(test_noise_of_no_residual);
    return UNITY_END();
}
