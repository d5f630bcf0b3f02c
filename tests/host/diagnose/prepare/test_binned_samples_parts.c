/* Means over bins, joined bins and pieces of a run by themselves, beside plain sums over all samples. */
#include "host/diagnose/prepare/binned_samples.c"

#include "support/recording.h"
#include "unity.h"

enum { P = 3, N = 400 };

static uint64_t seed;
static hci_run run;
static hci_run_statistics statistics;
static double acceleration[20000];
static bool at_rest[20000];
static hci_binned_samples samples;
static size_t capacity;
static reduction x;
static hci_binned_sample bin[BINS_PER_TURN];

static void make(size_t n)
{
    rec_release(&run);
    run = rec_make(n);
    for (size_t k = 0; k < n; ++k) {
        run.time_s[k] = 7.0 + 1e-3 * (double)k;
        run.theta_m_rad[k] = 0.01 * (double)k;
        run.speed_rad_per_s[k] = 10.0 + ref_normal(&seed);
        run.torque_Nm[k] = 1.0 + ref_normal(&seed);
        rec_phases(0.2 * ref_normal(&seed), 2.0 + 0.2 * ref_normal(&seed), P * run.theta_m_rad[k],
                   run.i_A + 3 * k);
        acceleration[k] = ref_normal(&seed);
        at_rest[k] = false;
    }
}

void setUp(void)
{
    seed = 14;
    make(N);
    statistics = (hci_run_statistics){.turns = 1.0};
    samples = (hci_binned_samples){.run_count = 1};
    capacity = 0;
    x = (reduction){.run = &run,
                    .pole_pairs = P,
                    .statistics = &statistics,
                    .acceleration = acceleration,
                    .at_rest = at_rest,
                    .samples = &samples,
                    .capacity = &capacity};
}

void tearDown(void)
{
    hci_memory_free(samples.sample);
    hci_memory_free(samples.segment);
    free(run.temperature_C);
    run.temperature_C = NULL;
    rec_release(&run);
}

/* ---- samples ---- */

static void test_a_sample_is_what_was_read(void)
{
    hci_binned_sample c;
    run.has_sum = true;
    run.i_A[3 * 5] += 0.5;
    run.computed_phase = 2;
    sample_of(&x, 5, &c);
    TEST_ASSERT_EQUAL_DOUBLE(run.theta_m_rad[5], c.reading.theta_m_rad);
    TEST_ASSERT_EQUAL_DOUBLE(run.speed_rad_per_s[5], c.reading.speed_rad_per_s);
    TEST_ASSERT_EQUAL_DOUBLE(acceleration[5], c.reading.acceleration_rad_per_s2);
    TEST_ASSERT_EQUAL_MEMORY(run.i_A + 15, c.reading.i_abc, 3 * sizeof(double));
    TEST_ASSERT_EQUAL_INT(2, c.reading.computed_phase);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, c.sum_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.005, c.reading.elapsed_s);
    TEST_ASSERT_EQUAL_DOUBLE(run.time_s[5], c.time_s);
    TEST_ASSERT_TRUE(c.count == 1.0 && isnan(c.reading.temperature_C));
    statistics.swings = 1, statistics.swing[0] = (hci_swing){3.0, 0.0, 0.0, 0.2, -0.1};
    statistics.drift = (hci_drift){.degree = 1, .middle_s = 7.0, .half_s = 0.01, .coefficient_Nm = {0.4}};
    at_rest[5] = true, run.has_sum = false;
    sample_of(&x, 5, &c);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, run.torque_Nm[5] - hci_swings_at_Nm(&statistics, run.time_s[5]) - 0.2,
                              c.torque_Nm);
    TEST_ASSERT_TRUE(c.count == 0.0 && isnan(c.sum_A));
}

static void test_what_was_measured(void)
{
    hci_binned_sample c;
    double d, q;
    sample_of(&x, 9, &c);
    rec_rotor(c.reading.i_abc, P * c.reading.theta_m_rad, &d, &q);
    TEST_ASSERT_EQUAL_DOUBLE(c.torque_Nm, measured_Nm(&x, &c));
    x.follows_Nm_per_A = 0.3;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, c.torque_Nm - 0.3 * q, measured_Nm(&x, &c));
    x.holding_Nm_per_A = 0.5;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.5 * q, measured_Nm(&x, &c));
}

/* ---- means ---- */

/* Sums over samples from one to another: means, and departures from them. */
typedef struct {
    double theta, speed, torque, elapsed, acceleration, i_abc[3], scatter, moment, spread, count;
} plain;

static plain plain_of(size_t from, size_t until)
{
    plain m = {.theta = 0.0};
    m.count = (double)(until - from);
    for (size_t k = from; k < until; ++k) {
        const double w = 1.0 / m.count;
        m.theta += w * run.theta_m_rad[k], m.speed += w * run.speed_rad_per_s[k],
            m.torque += w * run.torque_Nm[k];
        m.elapsed += w * (run.time_s[k] - run.time_s[0]), m.acceleration += w * acceleration[k];
        for (int s = 0; s < 3; ++s)
            m.i_abc[s] += w * run.i_A[3 * k + (size_t)s];
    }
    for (size_t k = from; k < until; ++k) {
        const double t = run.torque_Nm[k] - m.torque, a = run.theta_m_rad[k] - m.theta;
        m.scatter += t * t, m.moment += t * a, m.spread += a * a / m.count;
    }
    return m;
}

static hci_binned_sample mean_over(size_t from, size_t until)
{
    hci_binned_sample c = {.count = 0.0}, one;
    for (size_t k = from; k < until; ++k) {
        sample_of(&x, k, &one);
        mean_add(&x, &c, &one);
    }
    return c;
}

static void is_plain(const plain *m, const hci_binned_sample *c, bool currents)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, m->count, c->count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, m->theta, c->reading.theta_m_rad);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, m->speed, c->reading.speed_rad_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, m->acceleration, c->reading.acceleration_rad_per_s2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, m->torque, c->torque_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, m->elapsed, c->reading.elapsed_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, m->scatter, c->scatter_N2m2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, m->moment, c->moment_Nmrad);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, m->spread, c->spread_rad2);
    for (int s = 0; s < 3 && currents; ++s)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, m->i_abc[s], c->reading.i_abc[s]);
}

static void test_a_mean_by_plain_sums(void)
{
    const plain all = plain_of(10, 47);
    const hci_binned_sample c = mean_over(10, 47);
    is_plain(&all, &c, true);
    const plain one = plain_of(3, 4);
    const hci_binned_sample single = mean_over(3, 4);
    is_plain(&one, &single, true);
}

/* Two means joined are the mean of all, however many each has. */
static void test_joined_means_are_that_of_all(void)
{
    for (size_t part = 11; part < 46; part += 11) {
        hci_binned_sample c = mean_over(10, part);
        const hci_binned_sample other = mean_over(part, 47);
        const plain all = plain_of(10, 47);
        double d[3], q[3];
        rec_rotor(c.reading.i_abc, P * c.reading.theta_m_rad, &d[0], &q[0]);
        rec_rotor(other.reading.i_abc, P * other.reading.theta_m_rad, &d[1], &q[1]);
        const double share = (double)(part - 10) / 37.0;
        mean_join(&x, &c, &other);
        is_plain(&all, &c, false);
        rec_rotor(c.reading.i_abc, P * c.reading.theta_m_rad, &d[2], &q[2]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, share * d[0] + (1.0 - share) * d[1], d[2]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, share * q[0] + (1.0 - share) * q[1], q[2]);
    }
}

static void test_bins_of_a_turn(void)
{
    size_t filled = 0, kept = 0;
    at_rest[7] = true;
    means_take(&x, 2, 399, bin);
    double count = 0.0;
    for (size_t k = 0; k < BINS_PER_TURN; ++k) {
        count += bin[k].count;
        filled += bin[k].count > 0.0;
        if (bin[k].count > 0.0)
            TEST_ASSERT_EQUAL_UINT64(k,
                                     (size_t)(bin[k].reading.theta_m_rad / (2.0 * REF_PI) * BINS_PER_TURN));
    }
    TEST_ASSERT_EQUAL_DOUBLE(397.0, count);
    TEST_ASSERT_EQUAL_UINT64(filled, bins_join(&x, bin, 16));
    for (size_t k = 0; k < BINS_PER_TURN; ++k) {
        if (k % 16 != 0) TEST_ASSERT_EQUAL_DOUBLE(0.0, bin[k].count);
        kept += bin[k].count > 0.0;
        count -= bin[k].count;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, count);
    const double first = bin[0].reading.theta_m_rad;
    TEST_ASSERT_EQUAL_UINT64(kept, bins_close(bin, -1.0, 2.0 * REF_PI, 0.5));
    TEST_ASSERT_EQUAL_DOUBLE(first, bin[kept - 1].reading.theta_m_rad);
    for (size_t k = 0; k < kept; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(
            1e-12, (bin[0].reading.theta_m_rad - bin[k].reading.theta_m_rad) / (2.0 * REF_PI) * 0.5,
            bin[k].time_s);
}

/* A turn in 180 bins for each electrical period at least, of 4096; four are joined, of many samples five. */
static void test_how_many_bins_are_joined(void)
{
    TEST_ASSERT_EQUAL_UINT64(4, joined_to_one(&x));
    x.many = true;
    TEST_ASSERT_EQUAL_UINT64(5, joined_to_one(&x));
    x.pole_pairs = 7;
    TEST_ASSERT_EQUAL_UINT64(3, joined_to_one(&x));
    x.pole_pairs = 11;
    TEST_ASSERT_EQUAL_UINT64(2, joined_to_one(&x));
    x.pole_pairs = 40;
    TEST_ASSERT_EQUAL_UINT64(1, joined_to_one(&x));
    run.turn_known = false;
    TEST_ASSERT_EQUAL_UINT64(5, joined_to_one(&x));
    x.follows_Nm_per_A = 0.1;
    TEST_ASSERT_EQUAL_UINT64(1, joined_to_one(&x));
}

/* Of a straight line nothing is left; what rises otherwise than its neighbours keeps what it has. */
static void test_slopes_leave_the_scatter(void)
{
    hci_binned_sample c[4] = {{.count = 5.0}, {.count = 5.0}, {.count = 5.0}, {.count = 5.0}};
    for (int k = 0; k < 4; ++k) {
        c[k].reading.theta_m_rad = 0.1 * k, c[k].torque_Nm = 0.3 * k; /* 3 N·m/rad */
        c[k].spread_rad2 = 0.02, c[k].moment_Nmrad = 3.0 * 5.0 * 0.02,
        c[k].scatter_N2m2 = 9.0 * 5.0 * 0.02 + 0.25;
    }
    c[2].moment_Nmrad = -0.1;
    slopes_leave(&x, c, 4);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.15, c[0].scatter_N2m2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.25, c[1].scatter_N2m2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.15, c[2].scatter_N2m2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.15, c[3].scatter_N2m2);
}

static void test_the_time_of_a_turn(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.1 * 2.0 * REF_PI, period_of(&x, 20, 380)); /* 10 rad/s */
    for (size_t k = 0; k < N; ++k)
        run.theta_m_rad[k] *= -2.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.1 * REF_PI, period_of(&x, 20, 380));
}

/* ---- pieces ---- */

/* As many pieces of 4096 samples as there are, at most so many, evenly over the run. */
static void test_parts_of_a_long_run(void)
{
    make(20000);
    TEST_ASSERT_TRUE(spread_segments(&x, 100, 4096, 8));
    TEST_ASSERT_EQUAL_UINT64(1, samples.segment_count);
    TEST_ASSERT_EQUAL_UINT64(4096, samples.segment[0].count);
    TEST_ASSERT_TRUE(spread_segments(&x, 100, 4097, 8));
    TEST_ASSERT_EQUAL_UINT64(3, samples.segment_count);
    TEST_ASSERT_EQUAL_UINT64(2048, samples.segment[1].count);
    TEST_ASSERT_EQUAL_DOUBLE(run.torque_Nm[2148], samples.sample[samples.segment[2].first].torque_Nm);
    TEST_ASSERT_TRUE(spread_segments(&x, 0, 20000, 2));
    TEST_ASSERT_EQUAL_UINT64(5, samples.segment_count);
    TEST_ASSERT_EQUAL_UINT64(4000, samples.segment[4].count);
    TEST_ASSERT_EQUAL_DOUBLE(run.torque_Nm[0], samples.sample[samples.segment[3].first].torque_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(run.torque_Nm[8000], samples.sample[samples.segment[4].first].torque_Nm);
    TEST_ASSERT_EQUAL_UINT64(4096 + 4096 + 8000, samples.count);
}

/* Of slow noise, in pieces of 4000 samples, as many as runs have room for in 49152 samples, to the nearest
 * whole number, and one at least. */
static void test_parts_of_slow_noise(void)
{
    static const size_t RUNS[] = {1, 4, 5, 8, 9, 30}, PIECES[] = {5, 3, 2, 2, 1, 1};
    make(20000);
    for (size_t k = 0; k < 6; ++k) {
        const size_t before = samples.segment_count;
        samples.run_count = RUNS[k];
        TEST_ASSERT_TRUE(slow_segments(&x));
        TEST_ASSERT_EQUAL_UINT64(PIECES[k], samples.segment_count - before);
    }
}

/* A quarter of an electrical turn back, either way. */
static void test_the_end_of_a_way(void)
{
    for (int way = -1; way <= 1; way += 2) {
        const double back = 0.25 * 2.0 * REF_PI / P;
        for (size_t k = 0; k < N; ++k)
            run.theta_m_rad[k] = way * (k <= 100 ? 0.05 * (double)k : 5.0 - 0.01 * (double)(k - 100));
        TEST_ASSERT_EQUAL_UINT64(101, way_end(&x, 0, N));
        const size_t until = 100 + (size_t)(back / 0.01); /* it has gone back by no more */
        TEST_ASSERT_EQUAL_UINT64(until, way_end(&x, 0, until));
        TEST_ASSERT_EQUAL_UINT64(101, way_end(&x, 0, until + 3));
        TEST_ASSERT_EQUAL_UINT64(N, way_end(&x, 101, N));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_sample_is_what_was_read);
    RUN_TEST(test_what_was_measured);
    RUN_TEST(test_a_mean_by_plain_sums);
    RUN_TEST(test_joined_means_are_that_of_all);
    RUN_TEST(test_bins_of_a_turn);
    RUN_TEST(test_how_many_bins_are_joined);
    RUN_TEST(test_slopes_leave_the_scatter);
    RUN_TEST(test_the_time_of_a_turn);
    RUN_TEST(test_parts_of_a_long_run);
    RUN_TEST(test_parts_of_slow_noise);
    RUN_TEST(test_the_end_of_a_way);
    return UNITY_END();
}
