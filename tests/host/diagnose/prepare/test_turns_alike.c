/* Which turns go into one mean: turns that are written down here, each threshold from both sides; and what a
 * turn is of. */
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/prepare/turns.h"
#include "support/recording.h"
#include "unity.h"

enum { P = 2, COUNT = 12 };

static hci_run run;
static hci_run_statistics statistics;
static hci_turn turn[COUNT];

/* Forward, 5 A at 50 rad/s; turns of a hundred samples without noise. */
void setUp(void)
{
    run = rec_make(100 * COUNT);
    run.temperature_C = calloc(run.count, sizeof *run.temperature_C);
    for (size_t k = 0; k < run.count; ++k)
        run.theta_m_rad[k] = 2.0 * REF_PI * ((double)k + 0.3) / 100.0;
    statistics = (hci_run_statistics){.pace_rad_per_s = 50.0, .current_A = 5.0, .repeat_Nm = 0.1};
    for (size_t k = 0; k < COUNT; ++k) {
        turn[k] =
            (hci_turn){.first = 100 * k, .count = 100, .d = -3.0, .q = 4.0, .speed = 50.0, .whole = true};
        turn[k].least_speed = turn[k].most_speed = 50.0;
        turn[k].temperature = 40.0;
        for (int j = 0; j < HCI_TURN_PARTS; ++j)
            turn[k].part[j] = (hci_turn_part){-3.0, 4.0, 12.5};
    }
}

void tearDown(void)
{
    rec_release(&run);
}

static bool alike(void)
{
    const bool there = hci_turns_alike(&run, &statistics, &turn[2], &turn[5]);
    TEST_ASSERT_EQUAL(there, hci_turns_alike(&run, &statistics, &turn[5], &turn[2]));
    return there;
}

/* ---- two turns ---- */

static void test_whole_turns_one_way(void)
{
    TEST_ASSERT_TRUE(alike());
    turn[2].whole = false;
    TEST_ASSERT_FALSE(alike());
    turn[2].whole = true;
    run.theta_m_rad[299] = run.theta_m_rad[200] - 0.1;
    TEST_ASSERT_FALSE(alike());
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, hci_turn_direction(&run, 200, 299));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_turn_direction(&run, 200, 200));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_turn_direction(&run, 200, 201));
}

/* A fiftieth of the run's current, as a vector, or four standard deviations of two means; where none flows,
 * any. */
static void test_currents_that_are_alike(void)
{
    turn[5].d = -3.0 + 0.06 * 0.99;
    turn[5].q = 4.0 - 0.08 * 0.99;
    TEST_ASSERT_TRUE(alike());
    turn[5].d = -3.0 + 0.06 * 1.01;
    turn[5].q = 4.0 - 0.08 * 1.01;
    TEST_ASSERT_FALSE(alike());
    statistics.no_current = true;
    TEST_ASSERT_TRUE(alike());
    statistics.no_current = false;
    turn[2].noise_A2 = 0.3;
    turn[5].noise_A2 = 0.5;
    turn[5].count = 50;
    const double chance_A = 4.0 * sqrt(0.3 / 100.0 + 0.5 / 50.0);
    turn[5].d = -3.0;
    turn[5].q = 4.0 + 0.99 * chance_A;
    TEST_ASSERT_TRUE(alike());
    turn[5].q = 4.0 + 1.01 * chance_A;
    TEST_ASSERT_FALSE(alike());
}

static void test_speeds_and_temperatures_that_are_alike(void)
{
    turn[5].speed = 50.99;
    TEST_ASSERT_TRUE(alike());
    turn[5].speed = 51.01;
    TEST_ASSERT_FALSE(alike());
    turn[5].speed = 49.01;
    turn[5].temperature = 40.99;
    TEST_ASSERT_TRUE(alike());
    turn[5].temperature = 41.01;
    TEST_ASSERT_FALSE(alike());
}

/* Half of the largest speed within a turn of a free shaft, either way round. */
static void test_free_shafts_that_are_even(void)
{
    for (int sign = -1; sign < 2; sign += 2) {
        for (int even = 0; even < 2; ++even) {
            const double fast = sign * 80.0, slow = sign * (even ? 40.1 : 39.9);
            turn[5].least_speed = fmin(fast, slow);
            turn[5].most_speed = fmax(fast, slow);
            run.torque_source = HCI_TORQUE_INERTIA;
            TEST_ASSERT_EQUAL(even, alike());
            run.torque_source = HCI_TORQUE_MEASURED;
            TEST_ASSERT_TRUE(alike());
        }
    }
}

/* ---- parts of turns ---- */

static bool swing(size_t count)
{
    return hci_turns_swing(&run, &statistics, turn, count);
}

/* In more than one of four turns another part has another current than in the first that is alike. */
static void test_how_often_a_current_swings(void)
{
    TEST_ASSERT_FALSE(swing(9));
    turn[3].part[6].q = turn[7].part[1].d = 4.2;
    TEST_ASSERT_FALSE(swing(9));
    turn[8].part[7].q = 4.2;
    TEST_ASSERT_TRUE(swing(9));
    statistics.no_current = true;
    TEST_ASSERT_FALSE(swing(9));
    statistics.no_current = false;
    run.torque_source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_FALSE(swing(9));
}

/* A fiftieth of the run's current, or chance of so many samples; of a single sample nothing. */
static void test_how_much_a_current_swings(void)
{
    for (size_t k = 1; k < COUNT; ++k)
        turn[k].part[0].q = 4.0 - 0.099;
    TEST_ASSERT_FALSE(swing(COUNT));
    for (size_t k = 1; k < COUNT; ++k)
        turn[k].part[0].q = 4.0 - 0.101;
    TEST_ASSERT_TRUE(swing(COUNT));
    turn[0].part[0].count = 1.0;
    TEST_ASSERT_FALSE(swing(COUNT));
    turn[0].part[0].count = 8.0;
    for (int large = 0; large < 2; ++large) {
        for (size_t k = 0; k < COUNT; ++k)
            turn[k].noise_A2 = k == 0 ? 0.4 : 0.3;
        for (size_t k = 1; k < COUNT; ++k)
            turn[k].part[0].q = 4.0 + (large ? 1.01 : 0.99) * 4.0 * sqrt(0.4 / 8.0 + 0.3 / 12.5);
        TEST_ASSERT_EQUAL(large, swing(COUNT));
    }
}

/* Turns that are not alike begin anew: what differs from a turn of another current does not swing. */
static void test_other_currents_do_not_swing(void)
{
    for (size_t k = 6; k < COUNT; ++k) {
        turn[k].q = 8.0;
        for (int j = 0; j < HCI_TURN_PARTS; ++j)
            turn[k].part[j].q = 8.0;
    }
    TEST_ASSERT_FALSE(swing(COUNT));
    for (size_t k = 7; k < COUNT; ++k)
        turn[k].part[3].q = 8.3;
    TEST_ASSERT_TRUE(swing(COUNT));
}

/* ---- a line along the turns ---- */

/* 0.02 N·m a turn and a scatter about that line: sums by hand; six standard errors, and a fifth of how single
 * samples scatter from the first to the last. */
static void test_turns_that_creep(void)
{
    static const double OFF[8] = {1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0, 1.0};
    statistics.repeat_Nm = 0.0;
    for (int creeps = 0; creeps < 2; ++creeps) {
        /* slope²·42 against 36·8 off²/6: off is at right angles to the line and sums to 0 */
        const double off = 0.02 * sqrt(42.0 * 6.0 / (36.0 * 8.0)) * (creeps ? 0.99 : 1.01);
        for (size_t k = 0; k < 8; ++k)
            turn[k].torque = 3.0 - 0.02 * (double)k + off * OFF[k];
        TEST_ASSERT_EQUAL(creeps, hci_turns_creep(&statistics, turn, 8));
    }
    statistics.repeat_Nm = 0.02 * 7.0 / 0.2 * 0.99;
    TEST_ASSERT_TRUE(hci_turns_creep(&statistics, turn, 8));
    statistics.repeat_Nm = 0.02 * 7.0 / 0.2 * 1.01;
    TEST_ASSERT_FALSE(hci_turns_creep(&statistics, turn, 8));
}

static void test_few_turns_do_not_creep(void)
{
    statistics.repeat_Nm = 0.0;
    for (size_t k = 0; k < 6; ++k)
        turn[k].torque = (double)k + (k == 2 ? 0.01 : 0.0);
    TEST_ASSERT_FALSE(hci_turns_creep(&statistics, turn, 5));
    TEST_ASSERT_TRUE(hci_turns_creep(&statistics, turn, 6));
}

/* ---- what a turn is of ---- */

/* Means of each sample of two and a half turns, by parts from the zero of the angle on; noise by neighbours.
 */
static void test_means_of_a_turn(void)
{
    hci_turn *found = NULL;
    size_t count = 0;
    run.count = 250;
    for (size_t k = 0; k < run.count; ++k) {
        run.speed_rad_per_s[k] = 50.0 + (double)(k % 7);
        run.torque_Nm[k] = 0.1 * (double)(k % 11);
        run.temperature_C[k] = 20.0 + 0.3 * (double)(k % 5);
        rec_phases(-1.0 + 0.1 * (double)(k % 4), 2.0 + 0.2 * (double)(k % 3), P * run.theta_m_rad[k],
                   run.i_A + 3 * k);
    }
    TEST_ASSERT_TRUE(hci_turns_find(&run, P, &found, &count));
    TEST_ASSERT_EQUAL_UINT64(3, count);
    for (size_t n = 0; n < 3; ++n) {
        const hci_turn *x = &found[n];
        const size_t samples = n < 2 ? 100 : 50;
        double d = 0.0, q = 0.0, noise = 0.0, speed = 0.0, torque = 0.0, temperature = 0.0,
               part[8][3] = {{0.0}};
        for (size_t k = 100 * n; k < 100 * n + samples; ++k) {
            const double id = -1.0 + 0.1 * (double)(k % 4), iq = 2.0 + 0.2 * (double)(k % 3);
            const size_t at = (size_t)(8.0 * ((double)(k % 100) + 0.3) / 100.0);
            if (k > 100 * n) {
                const double dd = id + 1.0 - 0.1 * (double)((k - 1) % 4),
                             dq = iq - 2.0 - 0.2 * (double)((k - 1) % 3);
                noise += 0.5 * (dd * dd + dq * dq);
            }
            d += id;
            q += iq;
            part[at][0] += id;
            part[at][1] += iq;
            part[at][2] += 1.0;
            speed += run.speed_rad_per_s[k];
            torque += run.torque_Nm[k];
            temperature += run.temperature_C[k];
        }
        const double each = 1.0 / (double)samples;
        TEST_ASSERT_EQUAL_UINT64(100 * n, x->first);
        TEST_ASSERT_EQUAL_UINT64(samples, x->count);
        TEST_ASSERT_EQUAL(n < 2, x->whole);
        TEST_ASSERT_FALSE(x->ends_run);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, d * each, x->d);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, q * each, x->q);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, noise * each, x->noise_A2);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, speed * each, x->speed);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, torque * each, x->torque);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, temperature * each, x->temperature);
        TEST_ASSERT_EQUAL_DOUBLE(50.0, x->least_speed);
        TEST_ASSERT_EQUAL_DOUBLE(56.0, x->most_speed);
        for (int j = 0; j < 8; ++j) {
            TEST_ASSERT_EQUAL_DOUBLE(part[j][2], x->part[j].count);
            if (!(part[j][2] > 0.0)) continue;
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, part[j][0] / part[j][2], x->part[j].d);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, part[j][1] / part[j][2], x->part[j].q);
        }
    }
    hci_memory_free(found);
}

/* A run that ends a fiftieth of a turn short of one would be whole; one that turns back by so much ends a
 * turn. */
static void test_where_a_turn_ends(void)
{
    for (int ends = 0; ends < 2; ++ends) {
        hci_turn *found = NULL;
        size_t count = 0;
        run.count = ends ? 100 : 99; /* 0.99 and 0.98 of a turn from the first to the last */
        if (!ends) run.theta_m_rad[98] -= 0.01;
        TEST_ASSERT_TRUE(hci_turns_find(&run, P, &found, &count));
        TEST_ASSERT_EQUAL_UINT64(1, count);
        TEST_ASSERT_EQUAL(ends, found[0].ends_run);
        TEST_ASSERT_FALSE(found[0].whole);
        hci_memory_free(found);
    }
    for (int back = 0; back < 2; ++back) {
        hci_turn *found = NULL;
        size_t count = 0;
        run.count = 60;
        for (size_t k = 30; k < 60; ++k)
            run.theta_m_rad[k] = run.theta_m_rad[29] - 2.0 * REF_PI * (back ? 0.0201 : 0.0199);
        TEST_ASSERT_TRUE(hci_turns_find(&run, P, &found, &count));
        TEST_ASSERT_EQUAL_UINT64(back ? 2 : 1, count);
        hci_memory_free(found);
    }
}

static void test_the_angle_of_a_turn(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * REF_PI, hci_turn_rad(&run, 7));
    run.turn_known = false;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * REF_PI / 7.0, hci_turn_rad(&run, 7));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_whole_turns_one_way);
    RUN_TEST(test_currents_that_are_alike);
    RUN_TEST(test_speeds_and_temperatures_that_are_alike);
    RUN_TEST(test_free_shafts_that_are_even);
    RUN_TEST(test_how_often_a_current_swings);
    RUN_TEST(test_how_much_a_current_swings);
    RUN_TEST(test_other_currents_do_not_swing);
    RUN_TEST(test_turns_that_creep);
    RUN_TEST(test_few_turns_do_not_creep);
    RUN_TEST(test_means_of_a_turn);
    RUN_TEST(test_where_a_turn_ends);
    RUN_TEST(test_the_angle_of_a_turn);
    return UNITY_END();
}
