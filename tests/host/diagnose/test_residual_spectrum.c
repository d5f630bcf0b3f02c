/* The residual by order of waves whose amplitudes are known, in whole turns, weighted by the samples in a
 * mean. */
#include "host/diagnose/residual_spectrum.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "support/reference.h"
#include "unity.h"

enum { RUNS = 2, OF_TURN = 64, TURNS = 3, N = OF_TURN * TURNS, POLE_PAIRS = 4 };

static hci_machine machine;
static hci_run run[RUNS];
static bool use[RUNS];
static hci_run_statistics statistics[RUNS];
static hci_segment segment[RUNS];
static hci_binned_sample sample[RUNS * N];
static double before_Nm[RUNS * N], after_Nm[RUNS * N], noise_Nm[RUNS];
static hci_binned_samples samples;
static hci_regression regression;
static hci_residual_line *line;
static size_t lines;

/* Three turns of each run, before 0.5 + 0.3 sin(8θ + 1) and after 0.2 cos 5θ in all; `weight` samples in
 * each. */
void setUp(void)
{
    machine = (hci_machine){.pole_pairs = POLE_PAIRS};
    samples = (hci_binned_samples){sample, RUNS * N, segment, RUNS, statistics, RUNS};
    regression = (hci_regression){.machine = &machine, .samples = &samples, .runs = run, .use = use};
    memset(run, 0, sizeof run);
    for (size_t r = 0; r < RUNS; ++r) {
        run[r].turn_known = true;
        statistics[r].turns = TURNS;
        segment[r] = (hci_segment){.run = r, .first = r * N, .count = N};
        noise_Nm[r] = 1e-3;
    }
    for (size_t k = 0; k < RUNS * N; ++k) {
        const double theta = 2.0 * REF_PI * (double)(k % N) / OF_TURN;
        sample[k].raw.theta_m_rad = theta;
        sample[k].count = 7.0;
        before_Nm[k] = 0.5 + 0.3 * sin(8.0 * theta + 1.0);
        after_Nm[k] = 0.2 * cos(5.0 * theta);
    }
    line = NULL;
}

void tearDown(void)
{
    hci_memory_free(line);
    hci_memory_fail_after(-1);
}

static void make(void)
{
    hci_note note = {{0}};
    const hci_residuals residuals = {before_Nm, after_Nm, noise_Nm};
    hci_memory_free(line);
    TEST_ASSERT_EQUAL(HCI_OK, hci_residual_spectrum_make(&regression, &residuals, &line, &lines, &note));
}

static void check(size_t k, size_t of_run, double order, double before, double after)
{
    TEST_ASSERT_TRUE(k < lines);
    TEST_ASSERT_EQUAL(of_run, line[k].run);
    TEST_ASSERT_EQUAL_DOUBLE(order, line[k].order);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, before, line[k].before_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, after, line[k].after_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 2e-3 * sqrt(log(20.0) / (7.0 * N)), line[k].noise_Nm);
}

/* Orders are electrical: those of the turn over four. The mean is not doubled. */
static void test_amplitudes(void)
{
    make();
    TEST_ASSERT_EQUAL(6, lines);
    for (size_t r = 0; r < RUNS; ++r) {
        check(3 * r, r, 0.0, 0.5, 0.0);
        check(3 * r + 1, r, 1.25, 0.0, 0.2);
        check(3 * r + 2, r, 2.0, 0.3, 0.0);
    }
}

/* One sample that counts for many more than others is most of the sums. */
static void test_samples_count(void)
{
    sample[5].count = 1e12;
    make();
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, fabs(before_Nm[5]), line[0].before_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 2.0 * fabs(after_Nm[5]), line[1].after_Nm);
}

/* Where the turn is not known the orders are those of an electrical period, and 5 of the turn is none. */
static void test_without_the_turn(void)
{
    run[1].turn_known = false;
    make();
    TEST_ASSERT_EQUAL(5, lines);
    check(3, 1, 0.0, 0.5, 0.0);
    check(4, 1, 2.0, 0.3, 0.0);
}

static void test_what_has_no_angle_has_no_spectrum(void)
{
    run[0].only_mean = true;
    make();
    TEST_ASSERT_EQUAL(3, lines);
    check(0, 1, 0.0, 0.5, 0.0);
}

/* What noise makes once in twenty times, 2σ√(ln 20/n), is no line. */
static void test_lines_stand_out_of_the_noise(void)
{
    for (int more = 0; more < 2; ++more) {
        noise_Nm[0] = (more ? 1.01 : 0.99) * 0.5 * 0.3 / sqrt(log(20.0) / (7.0 * N));
        make();
        TEST_ASSERT_EQUAL(more ? 1 + 3 : 2 + 3, lines);
    }
}

/* 0.45 orders for each sample of a turn: 28.8 with 64 of them. Of a mean over turns those of its segment
 * count. */
static void test_orders_that_are_resolved(void)
{
    for (int more = 0; more < 2; ++more) {
        for (size_t k = 0; k < N; ++k)
            before_Nm[k] = cos((more ? 29.0 : 28.0) * sample[k].raw.theta_m_rad);
        make();
        TEST_ASSERT_EQUAL(more ? 1 + 3 : 2 + 3, lines);
    }
    segment[0].turns = 9; /* 192 samples of one turn: 86.4 */
    make();
    TEST_ASSERT_TRUE(lines > 4);
    check(1, 0, 7.25, 1.0, 0.0);
}

static void test_many_lines(void)
{
    for (size_t k = 0; k < RUNS * N; ++k) /* a pulse has all 29 orders */
        before_Nm[k] = k % OF_TURN == 0 ? 1.0 : 0.0;
    for (size_t r = 0; r < RUNS; ++r)
        statistics[r].turns = 1.0; /* 0.45 · 192 */
    make();
    TEST_ASSERT_EQUAL(2 * 87, lines);
    check(86, 0, 21.5, 2.0 / OF_TURN, 0.0);
    check(87, 1, 0.0, 1.0 / OF_TURN, 0.0);
    check(88, 1, 0.25, 2.0 / OF_TURN, 0.0);
}

static void test_memory_that_is_short(void)
{
    hci_note note = {{0}};
    const hci_residuals residuals = {before_Nm, after_Nm, noise_Nm};
    for (int k = 0; k < 2; ++k) {
        hci_memory_fail_after(k);
        TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY,
                          hci_residual_spectrum_make(&regression, &residuals, &line, &lines, &note));
        TEST_ASSERT_NULL(line);
        TEST_ASSERT_EQUAL(0, lines);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_amplitudes);
    RUN_TEST(test_samples_count);
    RUN_TEST(test_without_the_turn);
    RUN_TEST(test_what_has_no_angle_has_no_spectrum);
    RUN_TEST(test_lines_stand_out_of_the_noise);
    RUN_TEST(test_orders_that_are_resolved);
    RUN_TEST(test_many_lines);
    RUN_TEST(test_memory_that_is_short);
    return UNITY_END();
}
