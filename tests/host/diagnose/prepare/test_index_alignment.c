/* By how much the angle of a run is ahead of that of the others: maps that were turned by a known angle. */
#include "host/diagnose/prepare/index_alignment.h"

#include <string.h>

#include "host/base/memory.h"
#include "support/recording.h"
#include "unity.h"

enum { P = 3, RUNS = 4, SAMPLES = 360 };

static uint64_t seed;
static hci_binned_sample sample[RUNS * SAMPLES];
static hci_segment segment[RUNS];
static hci_run_statistics statistics[RUNS];
static hci_run run[RUNS];
static double residual_Nm[RUNS * SAMPLES], offset_rad[RUNS];
static hci_binned_samples samples;

/* A turn without current in each run. */
void setUp(void)
{
    seed = 5;
    memset(sample, 0, sizeof sample);
    memset(residual_Nm, 0, sizeof residual_Nm);
    for (size_t r = 0; r < RUNS; ++r) {
        segment[r] = (hci_segment){.run = r, .first = r * SAMPLES, .count = SAMPLES};
        statistics[r] = (hci_run_statistics){.turns = 1.0};
        run[r] = (hci_run){.turn_known = true, .torque_source = HCI_TORQUE_MEASURED};
        for (size_t k = 0; k < SAMPLES; ++k)
            sample[r * SAMPLES + k].reading.theta_m_rad = 2.0 * REF_PI * (double)k / SAMPLES;
    }
    samples = (hci_binned_samples){sample, RUNS * SAMPLES, segment, RUNS, statistics, RUNS};
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
}

/* The map of the machine: `orders` orders of about the same size. */
static double map_at(double theta_m, int orders)
{
    double sum = 0.0;
    for (int n = 0; n < orders; ++n)
        sum += sin((5 + 4 * n) * theta_m + 1.3 * n);
    return 0.02 * sum;
}

/* A run reads its angle ahead by an angle, and has noise. */
static void fill(size_t r, double ahead_rad, int orders, double noise_Nm)
{
    for (size_t k = 0; k < SAMPLES; ++k) {
        const double theta_m = sample[r * SAMPLES + k].reading.theta_m_rad;
        residual_Nm[r * SAMPLES + k] = map_at(theta_m - ahead_rad, orders) + noise_Nm * ref_normal(&seed);
    }
}

static hci_status find(void)
{
    hci_note note = {{0}};
    return hci_index_alignment_find(&samples, run, residual_Nm, offset_rad, &note);
}

/* ---- what is found ---- */

static void test_a_turned_map_is_found(void)
{
    static const double AHEAD_rad[] = {0.7123, -2.5, 3.0, 0.0051};
    for (size_t k = 0; k < 4; ++k) {
        for (size_t r = 0; r < RUNS; ++r)
            fill(r, r == 2 ? AHEAD_rad[k] : 0.0, 5, 0.0);
        TEST_ASSERT_EQUAL_INT(HCI_OK, find());
        for (size_t r = 0; r < RUNS; ++r) /* a hundredth of a radian is no index that was lost */
            TEST_ASSERT_DOUBLE_WITHIN(2e-6, r == 2 && k < 3 ? AHEAD_rad[k] : 0.0, offset_rad[r]);
    }
}

/* By least squares the angle of orders n of amplitude a under noise σ is known to σ √(2/(N a² Σ n²)); two
 * maps are compared. */
static void test_noise_moves_the_angle_by_what_it_must(void)
{
    enum { DRAWS = 40 };
    double square = 0.0, orders = 0.0;
    for (int n = 0; n < 5; ++n)
        orders += (5 + 4 * n) * (5 + 4 * n);
    for (int draw = 0; draw < DRAWS; ++draw) {
        for (size_t r = 0; r < RUNS; ++r)
            fill(r, r == 1 ? 1.0 : 0.0, 5, 0.01);
        TEST_ASSERT_EQUAL_INT(HCI_OK, find());
        square += pow(offset_rad[1] - 1.0, 2.0) / DRAWS;
        TEST_ASSERT_EQUAL_DOUBLE(0.0, offset_rad[0]);
    }
    const double expected = 0.01 * sqrt(2.0 * 2.0 / (SAMPLES * 0.02 * 0.02 * orders));
    TEST_ASSERT_DOUBLE_WITHIN(0.35 * expected, expected, sqrt(square)); /* of 40 draws: ± 11 % */
}

/* ---- what is not ---- */

/* One order fits itself at many angles; maps that do not resemble each other fit nowhere. */
static void test_what_does_not_tell(void)
{
    for (size_t r = 0; r < RUNS; ++r)
        fill(r, r == 2 ? 0.7 : 0.0, 1, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, find());
    TEST_ASSERT_EQUAL_DOUBLE(0.0, offset_rad[2]);
    for (size_t k = 0; k < RUNS * SAMPLES; ++k)
        residual_Nm[k] = 0.02 * ref_normal(&seed);
    TEST_ASSERT_EQUAL_INT(HCI_OK, find());
    for (size_t r = 0; r < RUNS; ++r)
        TEST_ASSERT_EQUAL_DOUBLE(0.0, offset_rad[r]);
}

/* One and a half turns there and back: friction has a part in all orders, and another one each way. */
static void test_friction_is_no_map(void)
{
    for (size_t r = 0; r < RUNS; ++r) {
        statistics[r].turns = 1.5;
        for (size_t k = 0; k < SAMPLES; ++k) {
            sample[r * SAMPLES + k].reading.theta_m_rad = 3.0 * REF_PI * (double)k / SAMPLES;
            sample[r * SAMPLES + k].reading.speed_rad_per_s = r == 2 ? -1.0 : 1.0;
        }
        for (size_t k = 0; k < SAMPLES; ++k)
            residual_Nm[r * SAMPLES + k] =
                0.006 * sin(12.0 * sample[r * SAMPLES + k].reading.theta_m_rad + 0.6) +
                (r == 2 ? 0.02 : -0.02);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, find());
    for (size_t r = 0; r < RUNS; ++r)
        TEST_ASSERT_EQUAL_DOUBLE(0.0, offset_rad[r]);
}

/* A run with current, of half a turn, or whose turn is not known, is not compared; a holding test is. */
static void test_which_runs_are_compared(void)
{
    for (int what = 0; what < 4; ++what) {
        setUp();
        for (size_t r = 0; r < RUNS; ++r)
            fill(r, r == 2 ? 0.7 : 0.0, 5, 0.0);
        if (what == 0 || what == 3) statistics[2].current_A = 5.0;
        if (what == 1) statistics[2].turns = 0.5;
        if (what == 2) run[2].turn_known = false;
        if (what == 3) run[2].torque_source = HCI_TORQUE_HOLDING;
        TEST_ASSERT_EQUAL_INT(HCI_OK, find());
        TEST_ASSERT_DOUBLE_WITHIN(2e-6, what == 3 ? 0.7 : 0.0, offset_rad[2]);
    }
}

/* ---- turning back ---- */

/* The phase currents were made of i_d and i_q with the angle that was ahead: those are right, the phases not.
 */
static void test_angle_and_currents_are_turned_back(void)
{
    for (size_t k = 0; k < RUNS * SAMPLES; ++k) {
        rec_phases(-1.0, 3.0, P * sample[k].reading.theta_m_rad, sample[k].reading.i_abc);
        sample[k].raw = sample[k].reading;
    }
    const double before = sample[SAMPLES + 7].reading.theta_m_rad;
    hci_index_alignment_apply(&samples, 1, P, 0.7);
    for (size_t k = 0; k < RUNS * SAMPLES; ++k) {
        double d, q;
        rec_rotor(sample[k].reading.i_abc, P * sample[k].reading.theta_m_rad, &d, &q);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, -1.0, d);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0, q);
        TEST_ASSERT_EQUAL_DOUBLE(sample[k].raw.i_abc[1], sample[k].reading.i_abc[1]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, before - 0.7, sample[SAMPLES + 7].reading.theta_m_rad);
    TEST_ASSERT_EQUAL_DOUBLE(before, sample[7].reading.theta_m_rad);
}

static void test_memory_is_out(void)
{
    hci_memory_fail_after(0);
    const hci_status status = find();
    hci_memory_fail_after(-1);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, status);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_turned_map_is_found);
    RUN_TEST(test_noise_moves_the_angle_by_what_it_must);
    RUN_TEST(test_what_does_not_tell);
    RUN_TEST(test_friction_is_no_map);
    RUN_TEST(test_which_runs_are_compared);
    RUN_TEST(test_angle_and_currents_are_turned_back);
    RUN_TEST(test_memory_is_out);
    return UNITY_END();
}
