/* Currents in the rotor frame: against their definition by cosines, and back again. */
#include "host/recording/rotor_frame.h"

#include <math.h>

#include "support/recording.h"
#include "unity.h"

enum { N = 50, P = 3 };

void setUp(void)
{
}

void tearDown(void)
{
}

/* A few roundings of numbers up to 10. */
#define ROUNDING 1e-14

static void test_a_run_is_turned_by_its_electrical_angle(void)
{
    uint64_t seed = 4;
    hci_run run = rec_make(N);
    for (size_t k = 0; k < N; ++k) {
        const double d = ref_uniform(&seed, -5.0, 5.0), q = ref_uniform(&seed, -5.0, 5.0);
        run.theta_m_rad[k] = ref_uniform(&seed, -20.0, 20.0);
        rec_phases(d, q, P * run.theta_m_rad[k], run.i_A + 3 * k);
        const hci_dq i = hci_run_dq(&run, P, k);
        TEST_ASSERT_DOUBLE_WITHIN(10.0 * ROUNDING, d, i.d);
        TEST_ASSERT_DOUBLE_WITHIN(10.0 * ROUNDING, q, i.q);
        TEST_ASSERT_DOUBLE_WITHIN(10.0 * ROUNDING, 0.0, i.zero);
    }
    rec_release(&run);
}

static void test_phases_come_back(void)
{
    uint64_t seed = 5;
    for (int trial = 0; trial < N; ++trial) {
        hci_sample x = {.theta_m_rad = ref_uniform(&seed, -20.0, 20.0)};
        double back[3];
        for (int s = 0; s < 3; ++s)
            x.i_abc[s] = ref_uniform(&seed, -5.0, 5.0);
        hci_phases_of_dq(hci_sample_dq(&x, P), P * x.theta_m_rad, back);
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(10.0 * ROUNDING, x.i_abc[s], back[s]);
    }
}

/* ---- one line ---- */

/* Currents along a direction of the rotor frame, and so much across it, over whole periods of both. */
static bool lies_in_line(double direction_rad, double across, double *angle_rad)
{
    hci_run run = rec_make(200);
    run.pole_pairs = P;
    for (size_t k = 0; k < 200; ++k) {
        const double x = 2.0 * REF_PI * (double)k / 50.0, along = 3.0 * cos(x),
                     beside = 3.0 * across * sin(x);
        run.theta_m_rad[k] = 0.7 + 0.05 * (double)k;
        rec_phases(-along * sin(direction_rad) - beside * cos(direction_rad),
                   along * cos(direction_rad) - beside * sin(direction_rad), P * run.theta_m_rad[k],
                   run.i_A + 3 * k);
    }
    const bool found = hci_run_currents_in_line(&run, angle_rad);
    rec_release(&run);
    return found;
}

/* A quarter of the mean square along it. */
static void test_currents_on_a_line(void)
{
    double angle_rad;
    for (double direction = -1.4; direction < 1.5; direction += 0.35) {
        TEST_ASSERT_TRUE(lies_in_line(direction, 0.49, &angle_rad));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, direction, angle_rad);
        TEST_ASSERT_FALSE(lies_in_line(direction, 0.51, &angle_rad));
    }
    hci_run none = rec_make(10);
    none.pole_pairs = P;
    TEST_ASSERT_FALSE(hci_run_currents_in_line(&none, &angle_rad));
    rec_release(&none);
}

/* ---- how often they go round ---- */

enum { ROWS = 1000 };

/* A current that goes round so many times in a turn of the shaft, with a length that swings, over a way in
 * rad; in `jumps` rows shaft and current go on by 2.1 rad of the current. */
typedef struct {
    double turns, swing, way_rad;
    int jumps;
} rotation;

static bool goes_otherwise(rotation x, double *turns)
{
    hci_run run = rec_make(ROWS);
    double theta = 0.4;
    run.pole_pairs = P;
    run.has_sum = true;
    for (size_t k = 0; k < ROWS; ++k) {
        const double length = 2.0 * (1.0 + sqrt(2.0) * x.swing * sin(2.0 * REF_PI * (double)k / 100.0)),
                     at = x.turns * theta + 0.3;
        run.theta_m_rad[k] = theta;
        for (int s = 0; s < 3; ++s)
            run.i_A[3 * k + (size_t)s] = length * cos(at - 2.0 * REF_PI * s / 3.0);
        theta += x.way_rad / (ROWS - 1) + (k % 10 == 3 && (int)k < 10 * x.jumps ? 2.1 / fabs(x.turns) : 0.0);
    }
    const bool found = hci_run_currents_go_otherwise(&run, turns);
    rec_release(&run);
    return found;
}

static void test_currents_that_go_round_otherwise(void)
{
    static const struct {
        rotation of;
        bool is_otherwise;
    } CASES[] = {
        {{5.0, 0.0, 9.0, 0}, true},  {{-5.0, 0.0, 9.0, 0}, true},  {{5.0, 0.0, -9.0, 0}, true},
        {{3.0, 0.0, 9.0, 0}, false}, {{-3.0, 0.0, 9.0, 0}, false}, {{1.0, 0.0, 9.0, 0}, true},
        {{0.0, 0.0, 9.0, 0}, false}, {{5.13, 0.0, 9.0, 0}, true},  {{5.17, 0.0, 9.0, 0}, false},
        {{5.0, 0.19, 9.0, 0}, true}, {{5.0, 0.21, 9.0, 0}, false}, {{5.0, 0.0, 3.0, 0}, false},
        {{5.0, 0.0, 3.3, 0}, true},  {{5.0, 0.0, 9.0, 19}, true},  {{5.0, 0.0, 9.0, 21}, false},
    };
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; ++c) {
        double turns = 0.0;
        TEST_ASSERT_EQUAL_MESSAGE(CASES[c].is_otherwise, goes_otherwise(CASES[c].of, &turns), "a case");
        if (CASES[c].is_otherwise) TEST_ASSERT_DOUBLE_WITHIN(1e-6, CASES[c].of.turns, turns);
    }
}

/* What is not phase currents over a known turn tells nothing. */
static void test_currents_that_cannot_go_otherwise(void)
{
    for (int which = 0; which < 5; ++which) {
        double turns;
        hci_run run = rec_make(which == 4 ? 1 : ROWS);
        run.pole_pairs = P;
        run.has_sum = which != 1;
        run.computed_phase = which == 2 ? 1 : 0;
        run.turn_known = which != 3;
        for (size_t k = 0; k < run.count; ++k) {
            run.theta_m_rad[k] = 0.01 * (double)k;
            rec_phases(1.0, 2.0, 5.0 * run.theta_m_rad[k], run.i_A + 3 * k);
        }
        TEST_ASSERT_EQUAL(which == 0 || which == 2, hci_run_currents_go_otherwise(&run, &turns));
        run.is_electrical = true;
        TEST_ASSERT_FALSE(hci_run_currents_go_otherwise(&run, &turns));
        rec_release(&run);
    }
}

/* ---- crests ---- */

static hci_run_crests crests;

/* One phase that stands at its largest value in `at` rows, is within 5 % of it in `near`, and smaller in the
 * others. */
static bool is_clipped(size_t rows, size_t at, size_t near, int phase, double sign)
{
    hci_run run = rec_make(rows);
    uint64_t seed = 8;
    run.pole_pairs = P;
    for (size_t k = 0; k < rows; ++k) {
        run.theta_m_rad[k] = 0.9 * (double)k;
        for (int s = 0; s < 3; ++s)
            run.i_A[3 * k + (size_t)s] = 0.2 * ref_uniform(&seed, -1.0, 1.0);
        run.i_A[3 * k + (size_t)phase] = sign * (k < at          ? 4.0
                                                 : k < at + near ? 3.81 + 0.1 * ref_uniform(&seed, 0.0, 1.0)
                                                                 : 3.0 * ref_uniform(&seed, 0.0, 1.0));
    }
    const bool found = hci_run_is_clipped(&run, &crests);
    rec_release(&run);
    return found;
}

/* In more than a hundredth and less than half of the rows, and five times as often as near it. */
static void test_crests_that_are_cut(void)
{
    for (int phase = 0; phase < 3; ++phase)
        for (int sign = -1; sign <= 1; sign += 2) {
            TEST_ASSERT_TRUE(is_clipped(2000, 21, 4, phase, sign));
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, 4.0 * sign, crests.at_A);
            TEST_ASSERT_EQUAL_UINT64(21, crests.rows);
            TEST_ASSERT_FALSE(crests.of_iq);
            TEST_ASSERT_FALSE(is_clipped(2000, 19, 3, phase, sign));
            TEST_ASSERT_FALSE(is_clipped(2000, 21, 5, phase, sign));
            TEST_ASSERT_FALSE(is_clipped(2000, 21, 0, phase, sign));
            TEST_ASSERT_TRUE(is_clipped(2000, 990, 1, phase, sign));
            TEST_ASSERT_FALSE(is_clipped(2000, 1010, 1, phase, sign));
            TEST_ASSERT_TRUE(is_clipped(200, 21, 4, phase, sign));
            TEST_ASSERT_FALSE(is_clipped(199, 21, 4, phase, sign));
        }
}

/* i_q that a drive limits, of phases that are not cut. */
static void test_a_current_along_q_that_is_cut(void)
{
    hci_run run = rec_make(1000);
    run.pole_pairs = P;
    for (size_t k = 0; k < run.count; ++k) {
        run.theta_m_rad[k] = 0.37 * (double)k;
        rec_phases(0.0, fmin(0.5, sin(0.01 * (double)k)), P * run.theta_m_rad[k], run.i_A + 3 * k);
    }
    TEST_ASSERT_TRUE(hci_run_is_clipped(&run, &crests) && crests.of_iq);
    for (size_t k = 0; k < run.count; ++k)
        rec_phases(0.0, sin(0.01 * (double)k), P * run.theta_m_rad[k], run.i_A + 3 * k);
    TEST_ASSERT_FALSE(hci_run_is_clipped(&run, &crests));
    rec_release(&run);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_currents_on_a_line);
    RUN_TEST(test_currents_that_go_round_otherwise);
    RUN_TEST(test_currents_that_cannot_go_otherwise);
    RUN_TEST(test_crests_that_are_cut);
    RUN_TEST(test_a_current_along_q_that_is_cut);
    RUN_TEST(test_a_run_is_turned_by_its_electrical_angle);
    RUN_TEST(test_phases_come_back);
    return UNITY_END();
}
