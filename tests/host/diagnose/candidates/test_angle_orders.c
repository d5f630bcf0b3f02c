/* At which orders an angle may be read wrong: errors that were put in, and ripple that is none. */
#include "host/diagnose/candidates/angle_orders.h"

#include <string.h>

#include "support/recording.h"
#include "unity.h"

enum { P = 3, RUNS = 4, SAMPLES = 300, COUNT = RUNS * SAMPLES };

static const double NOISE_NM = 0.002;

static hci_wave emf[] = {{.order = 1.0, .sequence = 1, .sine = 0.2},
                         {.order = 5.0, .sequence = 1, .sine = 0.01}};
static hci_harmonic cogging[] = {{.order = 6.0, .sine = 0.1}, {.order = 12.0, .cosine = 0.04}};
static const hci_machine MACHINE = {
    .pole_pairs = P, .back_emf = emf, .back_emf_count = 2, .cogging = cogging, .cogging_count = 2};

static uint64_t seed;
static hci_binned_sample sample[COUNT];
static hci_segment segment[RUNS];
static hci_run_statistics statistics[RUNS];
static hci_run run[RUNS];
static bool use[RUNS];
static double residual_Nm[COUNT], variance[COUNT];
static hci_binned_samples samples;
static hci_candidates_source source;
static hci_angle_orders found;

/* One turn each: without a current, and with i_d of both signs. */
void setUp(void)
{
    static const double ID_A[RUNS] = {0.0, 3.0, -4.0, 2.0}, IQ_A[RUNS] = {0.0, 6.0, 8.0, -5.0};
    seed = 11;
    memset(sample, 0, sizeof sample);
    for (size_t r = 0; r < RUNS; ++r) {
        segment[r] = (hci_segment){.run = r, .first = r * SAMPLES, .count = SAMPLES};
        use[r] = true;
        run[r].torque_source = HCI_TORQUE_MEASURED;
        for (size_t k = r * SAMPLES; k < (r + 1) * SAMPLES; ++k) {
            sample[k].reading.theta_m_rad = 2.0 * REF_PI * (double)(k % SAMPLES) / SAMPLES;
            rec_phases(ID_A[r], IQ_A[r], P * sample[k].reading.theta_m_rad, sample[k].reading.i_abc);
            residual_Nm[k] = NOISE_NM * ref_normal(&seed);
            variance[k] = NOISE_NM * NOISE_NM;
        }
    }
    samples = (hci_binned_samples){sample, COUNT, segment, RUNS, statistics, RUNS};
    source = (hci_candidates_source){.machine = &MACHINE,
                                     .samples = &samples,
                                     .runs = run,
                                     .use = use,
                                     .residual_Nm = residual_Nm,
                                     .variance = variance};
}

void tearDown(void)
{
}

/* Of periods in a mechanical turn, in electrical radians: what is predicted at the angle that is read, less
 * what acts. */
static void err(const double *periods, const double *error_rad, size_t count)
{
    for (size_t k = 0; k < COUNT; ++k) {
        const hci_sample *x = &sample[k].reading;
        const double theta_rad = P * x->theta_m_rad;
        double read_rad = theta_rad;
        for (size_t j = 0; j < count; ++j)
            read_rad += error_rad[j] * sin(periods[j] * x->theta_m_rad + 0.4 + 0.6 * (double)j);
        residual_Nm[k] += hci_torque_at(source.machine, theta_rad, x->i_abc) -
                          hci_torque_at(source.machine, read_rad, x->i_abc);
    }
}

static void find(void)
{
    TEST_ASSERT_TRUE(hci_angle_orders_find(&source, 1, 0.48 * SAMPLES / P, &found));
}

/* An error of one order makes torque on both sides of all cogging orders, which are no other errors: the
 * smaller one of another order comes next. */
static void test_errors_between_lines(void)
{
    static const double PERIODS[] = {20.0, 40.0}, ERROR_RAD[] = {0.02, 0.006};
    err(PERIODS, ERROR_RAD, 2);
    find();
    TEST_ASSERT_TRUE(found.count >= 2);
    TEST_ASSERT_EQUAL_DOUBLE(20.0 / P, found.order[0]);
    TEST_ASSERT_EQUAL_DOUBLE(40.0 / P, found.order[1]);
    for (size_t r = 1; r < RUNS; ++r)
        use[r] = false;
    find(); /* with cogging torque alone */
    TEST_ASSERT_TRUE(found.count >= 2);
    TEST_ASSERT_EQUAL_DOUBLE(20.0 / P, found.order[0]);
    TEST_ASSERT_EQUAL_DOUBLE(40.0 / P, found.order[1]);
}

static void test_noise_is_no_error(void)
{
    find();
    TEST_ASSERT_EQUAL_UINT64(0, found.count);
}

/* The mean of each run is left out with what it weighs, also of a large machine, of whose samples a few make
 * the weight 1: noise of 10 N·m beside an offset of 1000 N·m. */
static void test_an_offset_is_no_error_whatever_the_noise(void)
{
    for (size_t k = 0; k < COUNT; ++k) {
        residual_Nm[k] = 1000.0 + 10.0 / NOISE_NM * residual_Nm[k];
        variance[k] = 100.0;
    }
    find();
    TEST_ASSERT_EQUAL_UINT64(0, found.count);
    for (size_t r = 1; r < RUNS; ++r)
        use[r] = false;
    find(); /* with cogging torque alone */
    TEST_ASSERT_EQUAL_UINT64(0, found.count);
}

/* A ripple of i_d alone asks for an error that the cogging torque does not have. */
static void test_what_load_alone_shows(void)
{
    for (size_t k = 0; k < COUNT; ++k) {
        static const double ID_A[RUNS] = {0.0, 3.0, -4.0, 2.0};
        residual_Nm[k] += 0.004 * ID_A[k / SAMPLES] * sin(6.0 * P * sample[k].reading.theta_m_rad);
    }
    find();
    for (size_t k = 0; k < found.count; ++k)
        TEST_ASSERT_TRUE(fabs(found.order[k] - 6.0) > 0.1);
}

/* A ripple that is the same with any current asks for an error that the torque of the current does not have.
 */
static void test_what_the_teeth_alone_show(void)
{
    for (int order = 1; order < 12; ++order) {
        setUp();
        for (size_t k = 0; k < COUNT; ++k)
            residual_Nm[k] += 0.01 * sin(order * P * sample[k].reading.theta_m_rad + 0.2 * order);
        find();
        TEST_ASSERT_EQUAL_UINT64(0, found.count);
    }
}

/* Iron that saturates asks each run for another error, where no cogging torque asks for any. */
static void test_what_runs_do_not_share(void)
{
    static const double PERIODS[] = {18.0}, ERROR_RAD[] = {0.02}, OF_RUN[RUNS] = {0.0, 1.0, -0.5, 0.7};
    hci_machine smooth = MACHINE;
    smooth.cogging_count = 0;
    source.machine = &smooth;
    err(PERIODS, ERROR_RAD, 1);
    find();
    TEST_ASSERT_EQUAL_DOUBLE(18.0 / P, found.order[0]);
    for (size_t k = 0; k < COUNT; ++k)
        residual_Nm[k] *= OF_RUN[k / SAMPLES];
    find();
    for (size_t k = 0; k < found.count; ++k)
        TEST_ASSERT_TRUE(fabs(found.order[k] - 6.0) > 0.1);
}

/* Each run is asked what it would have by itself: a large torque at which the error does not show stands
 * against a small one at which it does. */
static void test_a_large_torque_that_shows_no_error(void)
{
    static const double PERIODS[] = {18.0}, ERROR_RAD[] = {0.05};
    hci_machine smooth = MACHINE;
    smooth.cogging_count = 0;
    source.machine = &smooth;
    for (size_t k = 0; k < COUNT; ++k)
        rec_phases(k < SAMPLES ? 60.0 : 6.0, 0.0, P * sample[k].reading.theta_m_rad, sample[k].reading.i_abc);
    err(PERIODS, ERROR_RAD, 1);
    find();
    TEST_ASSERT_EQUAL_DOUBLE(18.0 / P, found.order[0]);
    for (size_t k = 0; k < SAMPLES; ++k)
        residual_Nm[k] = NOISE_NM * ref_normal(&seed);
    find();
    TEST_ASSERT_EQUAL_UINT64(0, found.count);
}

/* So many runs of a turn, the first ones with i_d; a wave of torque in each, of which an error of the angle
 * would explain `strength` (a fall of χ²), with the sign of the run. */
enum { MANY = 48, SHORT = COUNT / MANY };

static bool any_in_many(size_t loaded, double strength, const double sign[4])
{
    static hci_segment segments[MANY];
    static hci_run runs[MANY];
    static bool used[MANY];
    hci_machine smooth = MACHINE;
    smooth.cogging_count = 0, smooth.back_emf_count = 1;
    setUp();
    source.machine = &smooth, source.runs = runs, source.use = used;
    samples.segment = segments, samples.segment_count = MANY;
    for (size_t r = 0; r < MANY; ++r) {
        segments[r] = (hci_segment){.run = r, .first = r * SHORT, .count = SHORT};
        runs[r].torque_source = HCI_TORQUE_MEASURED;
        used[r] = true;
    }
    for (size_t k = 0; k < COUNT; ++k) {
        const double theta_m_rad = 2.0 * REF_PI * (double)(k % SHORT) / SHORT;
        const bool is_loaded = k < loaded * SHORT;
        sample[k].reading.theta_m_rad = theta_m_rad;
        rec_phases(is_loaded ? 6.0 : 0.0, 0.0, P * theta_m_rad, sample[k].reading.i_abc);
        if (is_loaded)
            residual_Nm[k] +=
                sign[k / SHORT % 4] * NOISE_NM * sqrt(2.0 * strength / SHORT) * sin(6.0 * theta_m_rad);
    }
    TEST_ASSERT_TRUE(hci_angle_orders_find(&source, 1, 0.48 * SHORT / P, &found));
    return found.count > 0;
}

/* Noise alone explains 2 of each of 48 runs, 96 together, beside 60 of what they share. A run without a
 * torque explains nothing: four runs with 35 each, one of them against the others, do not share it. */
static void test_what_chance_makes_of_many_runs(void)
{
    static const double SHARED[4] = {1.0, 1.0, 1.0, 1.0}, ONE_AGAINST[4] = {1.0, 1.0, 1.0, -1.0};
    TEST_ASSERT_TRUE(any_in_many(MANY, 60.0 / MANY, SHARED));
    TEST_ASSERT_EQUAL_DOUBLE(6.0 / P, found.order[0]);
    TEST_ASSERT_TRUE(any_in_many(4, 35.0, SHARED));
    TEST_ASSERT_FALSE(any_in_many(4, 35.0, ONE_AGAINST));
}

/* Runs that are held tell no torque, and those that are not in use nothing. */
static void test_runs_that_tell_nothing(void)
{
    static const double PERIODS[] = {20.0}, ERROR_RAD[] = {0.02};
    err(PERIODS, ERROR_RAD, 1);
    for (size_t r = 0; r < RUNS; ++r) {
        use[r] = r > 1;
        run[r].torque_source = HCI_TORQUE_HOLDING;
    }
    find();
    TEST_ASSERT_EQUAL_UINT64(0, found.count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_errors_between_lines);
    RUN_TEST(test_noise_is_no_error);
    RUN_TEST(test_an_offset_is_no_error_whatever_the_noise);
    RUN_TEST(test_what_load_alone_shows);
    RUN_TEST(test_what_the_teeth_alone_show);
    RUN_TEST(test_what_runs_do_not_share);
    RUN_TEST(test_a_large_torque_that_shows_no_error);
    RUN_TEST(test_what_chance_makes_of_many_runs);
    RUN_TEST(test_runs_that_tell_nothing);
    return UNITY_END();
}
