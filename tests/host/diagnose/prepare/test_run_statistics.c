/* Statistics of a run without any model, against closed forms of its waves. */
#include "host/diagnose/prepare/run_statistics.h"

#include "support/recording.h"
#include "unity.h"

enum { P = 3, PER_TURN = 600, TURNS = 40, N = TURNS * PER_TURN };

static const double NOISE_NM = 0.05, RIPPLE_NM = 0.5, NOISE_A = 0.02;

static uint64_t seed;
static hci_run run;

/* Steady currents and a ripple of order 12 of the turn, backwards. */
void setUp(void)
{
    seed = 8;
    run = rec_make(N);
    for (size_t k = 0; k < N; ++k) {
        run.theta_m_rad[k] = -2.0 * REF_PI * (double)k / PER_TURN;
        run.time_s[k] = -run.theta_m_rad[k] / 50.0;
        run.speed_rad_per_s[k] = -50.0;
        rec_phases(-1.0, 3.0, P * run.theta_m_rad[k], run.i_A + 3 * k);
        run.torque_Nm[k] = 1.0 + RIPPLE_NM * sin(12.0 * run.theta_m_rad[k]) + NOISE_NM * ref_normal(&seed);
    }
}

void tearDown(void)
{
    rec_release(&run);
}

static void test_means(void)
{
    const hci_run_statistics x = hci_run_statistics_of(&run, P);
    const double rms = sqrt(1.0 + 0.5 * RIPPLE_NM * RIPPLE_NM + NOISE_NM * NOISE_NM);
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * NOISE_NM / sqrt(N), 1.0, x.mean_torque_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(3.0 * NOISE_NM / sqrt(N), rms, x.rms_torque_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -50.0, x.mean_speed_rad_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sqrt(10.0), x.current_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -1.0, x.mean_id_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3.0, x.mean_iq_A);
    TEST_ASSERT_TRUE(isnan(x.temperature_C));
    run.temperature_C = calloc(N, sizeof *run.temperature_C);
    for (size_t k = 0; k < N; ++k)
        run.temperature_C[k] = 40.0 + (k % 2 ? 1.0 : -1.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 40.0, hci_run_statistics_of(&run, P).temperature_C);
}

/* A sample that stands still is no step; the way there and back is counted once. */
static void test_angle(void)
{
    run.theta_m_rad[5] = run.theta_m_rad[4];
    hci_run_statistics x = hci_run_statistics_of(&run, P);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0 * REF_PI / PER_TURN, x.angle_step_rad);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, TURNS - 1.0 / PER_TURN, x.turns);
    for (size_t k = N / 2; k < N; ++k)
        run.theta_m_rad[k] = run.theta_m_rad[N - 1 - k];
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5 * TURNS - 1.0 / PER_TURN, hci_run_statistics_of(&run, P).turns);
}

/* Both ways the speed is nothing on the mean, and its size is what it is; less than an electrical turn back
 * is none, and a shaft without a torque sensor is one test. */
static void test_both_ways(void)
{
    hci_run_statistics x = hci_run_statistics_of(&run, P);
    TEST_ASSERT_FALSE(x.both_ways);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 50.0, x.pace_rad_per_s);
    for (size_t k = N / 2; k < N; ++k) {
        run.theta_m_rad[k] = run.theta_m_rad[N - 1 - k];
        run.speed_rad_per_s[k] = 50.0;
    }
    x = hci_run_statistics_of(&run, P);
    TEST_ASSERT_TRUE(x.both_ways);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, x.mean_speed_rad_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 50.0, x.pace_rad_per_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 0.0, x.pace_deviation);
    run.torque_source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_FALSE(hci_run_statistics_of(&run, P).both_ways);
    run.torque_source = HCI_TORQUE_MEASURED;
    run.count = N / 2 + PER_TURN / P - 2;
    TEST_ASSERT_FALSE(hci_run_statistics_of(&run, P).both_ways);
    run.count = N / 2 + PER_TURN / P + 2;
    TEST_ASSERT_TRUE(hci_run_statistics_of(&run, P).both_ways);
    run.count = N;
}

/* How well the torque repeats is its noise, not its ripple; two turns do not tell. */
static void test_repeatability(void)
{
    const double spread = NOISE_NM / sqrt(2.0 * N); /* of a deviation that is found from N samples */
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * spread, NOISE_NM, hci_run_statistics_of(&run, P).repeat_Nm);
    for (size_t k = 0; k < N; ++k)
        run.theta_m_rad[k] *= 2.0 / TURNS;
    TEST_ASSERT_TRUE(isnan(hci_run_statistics_of(&run, P).repeat_Nm));
}

/* Zeros of sensors, and their noise, while the rotor turns. */
static void read_zeros(const double zero_A[3])
{
    for (size_t k = 0; k < 3 * N; ++k)
        run.i_A[k] = zero_A[k % 3] + NOISE_A * ref_normal(&seed);
}

/* What stands still is found, and taken for zeros of sensors beside a larger current alone: the rated one or
 * that of another run. */
static void test_zeros_of_sensors(void)
{
    static const double ZERO_A[3] = {0.3, -0.1, 0.05};
    hci_run_statistics x[2] = {{0}};
    read_zeros(ZERO_A);
    x[0] = hci_run_statistics_of(&run, P);
    TEST_ASSERT_TRUE(x[0].stands && !x[0].no_current && !x[0].zeros_read);
    for (size_t s = 0; s < 3; ++s)
        TEST_ASSERT_DOUBLE_WITHIN(4.0 * NOISE_A / sqrt(N), ZERO_A[s], x[0].standing_A[s]);
    hci_run_statistics_zeros_find(x, 1, NAN);
    TEST_ASSERT_FALSE(x[0].zeros_read);
    hci_run_statistics_zeros_find(x, 1, 0.3 / 0.06);
    TEST_ASSERT_FALSE(x[0].zeros_read);
    hci_run_statistics_zeros_find(x, 1, 0.3 / 0.04);
    TEST_ASSERT_TRUE(x[0].zeros_read);
    x[1].current_A = 0.3 / 0.04;
    hci_run_statistics_zeros_find(x, 2, NAN);
    TEST_ASSERT_TRUE(x[0].zeros_read && !x[1].zeros_read);
}

/* Zeros that are small beside their noise, and far above what as many samples make of its mean, are zeros all
 * the same; noise about nothing has none. */
static void test_small_zeros(void)
{
    const double small_A = 12.0 * NOISE_A / sqrt(N);
    const double ZERO_A[3] = {small_A, 0.0, -small_A}, NOTHING_A[3] = {0.0};
    read_zeros(ZERO_A);
    hci_run_statistics x = hci_run_statistics_of(&run, P);
    TEST_ASSERT_TRUE(x.no_current && x.stands);
    for (size_t s = 0; s < 3; ++s)
        TEST_ASSERT_DOUBLE_WITHIN(4.0 * NOISE_A / sqrt(N), ZERO_A[s], x.standing_A[s]);
    hci_run_statistics_zeros_find(&x, 1, 100.0);
    TEST_ASSERT_TRUE(x.zeros_read);
    read_zeros(NOTHING_A);
    x = hci_run_statistics_of(&run, P);
    TEST_ASSERT_TRUE(x.no_current && !x.stands);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, x.standing_A[0]);
}

/* Noise that went through a filter of `keeps` of the reading before, beside a current of `flows` at `order`
 * of the rotor frame. */
static bool is_filtered_noise(double keeps, double flows, double order)
{
    double last_A[3] = {0.0};
    for (size_t k = 0; k < N; ++k) {
        double i_A[3];
        rec_phases(0.0, flows * cos(order * P * run.theta_m_rad[k]), P * run.theta_m_rad[k], i_A);
        for (size_t s = 0; s < 3; ++s) {
            last_A[s] = keeps * last_A[s] + NOISE_A * ref_normal(&seed);
            run.i_A[3 * k + s] = i_A[s] + last_A[s];
        }
    }
    return hci_run_statistics_of(&run, P).no_current;
}

/* It is forgotten in a part of a turn, of which a current that flows is the same or turned about. */
static void test_filtered_noise(void)
{
    TEST_ASSERT_TRUE(is_filtered_noise(0.6, 0.0, 0.0));
    TEST_ASSERT_FALSE(is_filtered_noise(0.98, 0.0, 0.0));
    for (double order = 0.0; order < 33.0; order += 1.0)
        TEST_ASSERT_FALSE(is_filtered_noise(0.6, NOISE_A, order));
    TEST_ASSERT_TRUE(is_filtered_noise(0.6, 0.05 * NOISE_A, 0.0));
}

/* Rows without a clock are in order where a rotor was read at even steps of its turn, and need not be where
 * the angle goes about: there each row may have a current of its own. */
static void test_zeros_of_sensors_without_a_clock(void)
{
    static const double ZERO_A[3] = {0.3, -0.1, 0.05}, NOTHING_A[3] = {0.0};
    double *time_s = run.time_s;
    run.time_s = NULL;
    read_zeros(ZERO_A);
    TEST_ASSERT_TRUE(hci_run_statistics_of(&run, P).stands);
    read_zeros(NOTHING_A);
    TEST_ASSERT_TRUE(hci_run_statistics_of(&run, P).no_current);
    for (size_t k = 0; k < N; ++k)
        run.theta_m_rad[k] *= 1.0 + 1e-4 * ref_normal(&seed);
    TEST_ASSERT_FALSE(hci_run_statistics_of(&run, P).no_current);
    run.time_s = time_s;
    TEST_ASSERT_TRUE(hci_run_statistics_of(&run, P).no_current);
}

/* Neither in less than ten electrical turns, nor where a current flows: what turns with the rotor has a mean
 * of next to nothing, and beside it even a zero is not all that was read. */
static void test_a_current_that_flows_is_no_zero(void)
{
    static const double ZERO_A[3] = {0.3, -0.1, 0.05};
    hci_run_statistics x = hci_run_statistics_of(&run, P);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, x.standing_A[0]);
    for (size_t k = 0; k < 3 * N; ++k)
        run.i_A[k] += ZERO_A[k % 3];
    x = hci_run_statistics_of(&run, P);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.3, x.standing_A[0]);
    TEST_ASSERT_FALSE(x.stands);
    read_zeros(ZERO_A);
    for (size_t k = 0; k < N; ++k)
        run.theta_m_rad[k] *= 3.0 / TURNS;
    x = hci_run_statistics_of(&run, P);
    TEST_ASSERT_FALSE(x.stands);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, x.standing_A[0]);
}

/* Without angle or samples nothing is known. */
static void test_nothing_is_there(void)
{
    run.count = 0;
    const hci_run_statistics x = hci_run_statistics_of(&run, P);
    TEST_ASSERT_TRUE(x.turns == 0.0 && x.current_A == 0.0 && isnan(x.repeat_Nm) && isnan(x.temperature_C));
}

/* Phase currents that stay while the rotor turns are direct; those that turn with it are not, nor is one of
 * which nothing is seen but at one angle. */
static void test_direct_current(void)
{
    static const double PHASE_A[3] = {4.0, -2.0, -2.0};
    TEST_ASSERT_FALSE(hci_run_statistics_of(&run, P).is_direct);
    for (size_t k = 0; k < 3 * N; ++k)
        run.i_A[k] = PHASE_A[k % 3] + 0.01 * ref_normal(&seed);
    TEST_ASSERT_TRUE(hci_run_statistics_of(&run, P).is_direct);
    for (size_t k = 0; k < N; ++k)
        run.theta_m_rad[k] *= 0.09 / (TURNS * P);
    TEST_ASSERT_FALSE(hci_run_statistics_of(&run, P).is_direct);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_means);
    RUN_TEST(test_angle);
    RUN_TEST(test_both_ways);
    RUN_TEST(test_repeatability);
    RUN_TEST(test_zeros_of_sensors);
    RUN_TEST(test_small_zeros);
    RUN_TEST(test_filtered_noise);
    RUN_TEST(test_zeros_of_sensors_without_a_clock);
    RUN_TEST(test_a_current_that_flows_is_no_zero);
    RUN_TEST(test_nothing_is_there);
    RUN_TEST(test_direct_current);
    return UNITY_END();
}
