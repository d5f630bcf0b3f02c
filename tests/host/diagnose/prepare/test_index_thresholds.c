/* When the angle of a run is turned: maps of a few orders whose likeness has a closed form, each threshold
 * from both sides. */
#include <math.h>
#include <string.h>

#include "host/diagnose/prepare/index_alignment.h"
#include "support/draws.h"
#include "unity.h"

enum { N = 240, RUNS = 3 };

static hci_binned_sample sample[N * RUNS];
static hci_segment segment[RUNS];
static hci_run_statistics statistics[RUNS];
static hci_run run[RUNS];
static hci_binned_samples samples;
static double residual_Nm[N * RUNS], offset_rad[RUNS];

/* A turn each, without a current. */
void setUp(void)
{
    memset(sample, 0, sizeof sample);
    memset(statistics, 0, sizeof statistics);
    memset(run, 0, sizeof run);
    memset(residual_Nm, 0, sizeof residual_Nm);
    for (size_t r = 0; r < RUNS; ++r) {
        segment[r] = (hci_segment){.run = r, .first = N * r, .count = N};
        statistics[r].turns = 1.0;
        run[r].turn_known = true;
        run[r].torque_source = HCI_TORQUE_MEASURED;
        for (size_t k = 0; k < N; ++k) {
            sample[N * r + k].reading.theta_m_rad = 2.0 * REF_PI * (double)k / N;
            sample[N * r + k].reading.speed_rad_per_s = 10.0;
        }
    }
    samples = (hci_binned_samples){sample, N * RUNS, segment, RUNS, statistics, RUNS};
}

void tearDown(void)
{
}

/* Adds an order to a run whose angle is ahead. */
static void wave(size_t r, int order, double amplitude, double ahead_rad)
{
    for (size_t k = N * r; k < N * (r + 1); ++k)
        residual_Nm[k] += amplitude * sin(order * (sample[k].reading.theta_m_rad - ahead_rad) + 0.3 * order);
}

static const double AHEAD_RAD = 0.35;

/* Orders 3, 5 and 8; the last run is ahead. */
static void maps(void)
{
    for (size_t r = 0; r < RUNS; ++r)
        for (int j = 0; j < 3; ++j)
            wave(r, (int[]){3, 5, 8}[j], 1.0 - 0.2 * j, r == 2 ? AHEAD_RAD : 0.0);
}

static double found(void)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_index_alignment_find(&samples, run, residual_Nm, offset_rad, &note));
    return offset_rad[2];
}

static void expect(bool is_turned)
{
    TEST_ASSERT_DOUBLE_WITHIN(2e-6, is_turned ? AHEAD_RAD : 0.0, found());
    TEST_ASSERT_TRUE(fabs(offset_rad[0]) < 2e-6 && fabs(offset_rad[1]) < 2e-6);
}

/* ---- the one that is off ---- */

static void test_the_one_that_is_off(void)
{
    maps();
    expect(true);
    memset(residual_Nm, 0, sizeof residual_Nm);
    for (int j = 0; j < 3; ++j) { /* the first is off, behind */
        wave(0, (int[]){3, 5, 8}[j], 1.0 - 0.2 * j, -2.5);
        wave(1, (int[]){3, 5, 8}[j], 1.0 - 0.2 * j, 0.1);
        wave(2, (int[]){3, 5, 8}[j], 1.0 - 0.2 * j, 0.1);
    }
    TEST_ASSERT_DOUBLE_WITHIN(2e-6, 0.0, found());
    TEST_ASSERT_DOUBLE_WITHIN(2e-6, 0.0, offset_rad[1]);
    TEST_ASSERT_DOUBLE_WITHIN(2e-6, -2.6, offset_rad[0]);
}

/* ---- which runs are compared ---- */

static void test_runs_that_show_a_map(void)
{
    maps();
    statistics[2].turns = 0.94;
    expect(false);
    statistics[2].turns = 0.96;
    expect(true);
    run[2].turn_known = false;
    expect(false);
    run[2].turn_known = true;
    run[2].torque_source = HCI_TORQUE_NONE;
    expect(false);
    run[2].torque_source = HCI_TORQUE_MEASURED;
    statistics[0].current_A = statistics[1].current_A = 0.0;
    statistics[2].current_A = 1.0; /* the largest */
    expect(false);
    run[2].torque_source = HCI_TORQUE_HOLDING;
    expect(true);
}

/* A twentieth of the largest current is none. */
static void test_hardly_a_current(void)
{
    maps();
    statistics[0].current_A = 8.0;
    statistics[2].current_A = 0.401;
    run[0].torque_source = HCI_TORQUE_HOLDING;
    expect(false);
    statistics[2].current_A = 0.399;
    expect(true);
}

/* ---- how alike ---- */

/* Two orders of powers 1 and r share (1 + r)²/(1 + r²): 1.6 at a third. */
static void test_one_order_alone(void)
{
    for (int spread = 0; spread < 2; ++spread) {
        memset(residual_Nm, 0, sizeof residual_Nm);
        for (size_t r = 0; r < RUNS; ++r) {
            wave(r, 3, 1.0, r == 2 ? AHEAD_RAD : 0.0);
            wave(r, 7, sqrt(spread ? 0.345 : 0.32), r == 2 ? AHEAD_RAD : 0.0);
        }
        expect(spread);
    }
}

/* With other orders besides the turned ones are alike by c/√(c² + s²): 0.9 is the border. */
static void test_how_alike_turned_maps_are(void)
{
    for (int alike = 0; alike < 2; ++alike) {
        memset(residual_Nm, 0, sizeof residual_Nm);
        maps();
        const double share = alike ? 0.903 : 0.897, power = 1.0 + 0.64 + 0.36;
        wave(2, 11, sqrt(power * (1.0 / (share * share) - 1.0)), 0.0);
        expect(alike);
    }
}

/* Unturned ones are alike by Σ a² cos(n·ahead)/Σ a²: a quarter less than turned ones is the border. */
static void test_how_much_better_turned_maps_are(void)
{
    double low = 0.0, high = 0.3;
    for (int k = 0; k < 50; ++k) {
        const double x = 0.5 * (low + high);
        *((cos(3.0 * x) + 0.64 * cos(5.0 * x) + 0.36 * cos(8.0 * x)) / 2.0 > 0.75 ? &low : &high) = x;
    }
    for (int better = 0; better < 2; ++better) {
        const double ahead = low * (better ? 1.01 : 0.99);
        memset(residual_Nm, 0, sizeof residual_Nm);
        for (size_t r = 0; r < RUNS; ++r)
            for (int j = 0; j < 3; ++j)
                wave(r, (int[]){3, 5, 8}[j], 1.0 - 0.2 * j, r == 2 ? ahead : 0.0);
        TEST_ASSERT_DOUBLE_WITHIN(2e-6, better ? ahead : 0.0, found());
    }
}

/* ---- what repeats ---- */

/* Two turns: half of an order that has another sign in the second turn is in neither of all, and the halves
 * are alike by (1 − p)/(1 + p), p its share of the others, of which 0.7 shows a map. Of less than 1.9 turns
 * there are no halves to compare. */
static void test_halves_that_repeat(void)
{
    for (int k = 0; k < 3; ++k) {
        const double alike = k == 1 ? 0.705 : 0.695, s = sqrt(2.0 * (1.0 - alike) / (1.0 + alike));
        setUp();
        for (size_t j = 2 * N; j < 3 * N; ++j)
            sample[j].reading.theta_m_rad = 4.0 * REF_PI * (double)(j - 2 * N) / N;
        statistics[2].turns = k == 2 ? 1.89 : 2.0;
        maps();
        for (size_t j = 2 * N; j < 3 * N; ++j)
            residual_Nm[j] += (j < 2 * N + N / 2 ? s : -s) * sin(11.0 * sample[j].reading.theta_m_rad);
        expect(k > 0);
    }
}

/* Friction is another mean each way; over other than whole turns it would have a part in all orders. */
static void test_a_mean_of_each_way_leaves(void)
{
    for (size_t k = 0; k < N * RUNS; ++k) {
        const size_t at = k % N, half = at < N / 2 ? at : N - 1 - at;
        sample[k].reading.theta_m_rad = 2.0 * REF_PI * 1.03 * (double)half / (N / 2);
        sample[k].reading.speed_rad_per_s = at < N / 2 ? 10.0 : -10.0;
    }
    maps();
    TEST_ASSERT_DOUBLE_WITHIN(0.02, AHEAD_RAD, found());
    const double without = found();
    for (size_t k = 0; k < N * RUNS; ++k)
        residual_Nm[k] += sample[k].reading.speed_rad_per_s > 0.0 ? -7.0 : 4.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, without, found());
}

/* ---- turned back ---- */

/* The angle is less by so much, and the currents are those of the same i_d and i_q there. */
static void test_samples_that_are_turned_back(void)
{
    enum { P = 3 };
    for (size_t k = 0; k < N * RUNS; ++k) {
        const double theta = P * sample[k].reading.theta_m_rad;
        for (int s = 0; s < 3; ++s)
            sample[k].reading.i_abc[s] =
                4.0 * sin(theta - 2.0 * REF_PI * s / 3.0) + 1.5 * cos(theta - 2.0 * REF_PI * s / 3.0);
        sample[k].raw = sample[k].reading;
        sample[k].raw.theta_m_rad += 0.01;
    }
    hci_index_alignment_apply(&samples, 1, P, AHEAD_RAD);
    for (size_t k = 0; k < N * RUNS; ++k) {
        const double turned = k / N == 1 ? AHEAD_RAD : 0.0,
                     theta_m = 2.0 * REF_PI * (double)(k % N) / N - turned;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, theta_m, sample[k].reading.theta_m_rad);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, theta_m + 0.01, sample[k].raw.theta_m_rad);
        for (int s = 0; s < 3; ++s) {
            const double x = P * theta_m - 2.0 * REF_PI * s / 3.0;
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, 4.0 * sin(x) + 1.5 * cos(x), sample[k].reading.i_abc[s]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, 4.0 * sin(x) + 1.5 * cos(x), sample[k].raw.i_abc[s]);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_one_that_is_off);
    RUN_TEST(test_runs_that_show_a_map);
    RUN_TEST(test_hardly_a_current);
    RUN_TEST(test_one_order_alone);
    RUN_TEST(test_how_alike_turned_maps_are);
    RUN_TEST(test_how_much_better_turned_maps_are);
    RUN_TEST(test_halves_that_repeat);
    RUN_TEST(test_a_mean_of_each_way_leaves);
    RUN_TEST(test_samples_that_are_turned_back);
    return UNITY_END();
}
