/* Turns of a run: where they begin, what their means are, which are alike, and which creep or swing; of runs
 * whose equations stand here. */
#include "host/diagnose/prepare/turns.h"

#include <math.h>

#include "host/base/memory.h"
#include "support/recording.h"
#include "unity.h"

enum { OF_TURN = 80, MOST = 20 };

static hci_run run;
static hci_run_statistics statistics;
static hci_turn *turns;
static size_t count;

void setUp(void)
{
    statistics = (hci_run_statistics){.current_A = 10.0, .pace_rad_per_s = 50.0};
    turns = NULL;
}

void tearDown(void)
{
    hci_memory_free(turns);
    rec_release(&run);
    hci_memory_fail_after(-1);
}

/* Eighty samples a turn, forward, of two pole pairs: i_d = −1, i_q = 3 + 0.1 of the turn, speed and torque go
 * up by the turn. The first turn ends with sample 80. */
static void record(size_t n)
{
    run = rec_make(n);
    run.temperature_C = calloc(n, sizeof *run.temperature_C);
    for (size_t k = 0; k < n; ++k) {
        const double turn = floor((double)k / OF_TURN);
        run.theta_m_rad[k] = 2.0 * REF_PI * ((double)k * (1.0 + 1e-9) + 1e-6) / OF_TURN; /* for rounding */
        run.speed_rad_per_s[k] = 50.0 + turn + (k % OF_TURN == 3 ? 0.5 : 0.0);
        run.torque_Nm[k] = 2.0 + 0.25 * turn;
        run.temperature_C[k] = 20.0 + 0.5 * turn;
        rec_phases(-1.0, 3.0 + 0.1 * turn, 2.0 * run.theta_m_rad[k], run.i_A + 3 * k);
    }
}

static void find(int pole_pairs)
{
    hci_memory_free(turns);
    TEST_ASSERT_TRUE(hci_turns_find(&run, pole_pairs, &turns, &count));
}

/* ---- where they are ---- */

static void test_turns_follow_each_other(void)
{
    record(3 * OF_TURN + 20);
    find(2);
    TEST_ASSERT_EQUAL(4, count);
    for (size_t k = 0; k < count; ++k) {
        TEST_ASSERT_EQUAL(OF_TURN * k, turns[k].first);
        TEST_ASSERT_EQUAL(k < 3 ? OF_TURN : 20, turns[k].count);
        TEST_ASSERT_EQUAL(k < 3, turns[k].whole);
    }
    run.turn_known = false; /* then an electrical period is one */
    find(2);
    TEST_ASSERT_EQUAL(7, count);
    TEST_ASSERT_EQUAL(OF_TURN / 2, turns[0].count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, REF_PI, hci_turn_rad(&run, 2));
}

/* The last one may end with the run, or fall short by less than a fiftieth, that is 1.6 samples. */
static void test_a_run_ends_with_a_turn(void)
{
    for (size_t less = 0; less <= 2; ++less) {
        record(3 * OF_TURN - less);
        find(2);
        TEST_ASSERT_EQUAL(3, count);
        TEST_ASSERT_EQUAL(less == 0, turns[2].ends_run);
        TEST_ASSERT_FALSE(turns[2].whole || turns[1].ends_run);
        hci_memory_free(turns);
        turns = NULL;
        rec_release(&run);
    }
}

static void test_means_of_a_turn(void)
{
    record(3 * OF_TURN + 1);
    find(2);
    for (size_t k = 0; k < 3; ++k) {
        const hci_turn *x = &turns[k];
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, -1.0, x->d);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0 + 0.1 * (double)k, x->q);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 50.0 + (double)k + 0.5 / OF_TURN, x->speed);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 50.0 + (double)k, x->least_speed);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 50.5 + (double)k, x->most_speed);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 20.0 + 0.5 * (double)k, x->temperature);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 + 0.25 * (double)k, x->torque);
        TEST_ASSERT_DOUBLE_WITHIN(1e-20, 0.0, x->noise_A2);
        for (size_t part = 0; part < HCI_TURN_PARTS; ++part) {
            TEST_ASSERT_EQUAL_DOUBLE(OF_TURN / HCI_TURN_PARTS, x->part[part].count);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, -1.0, x->part[part].d);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, x->q, x->part[part].q);
        }
    }
}

/* i_d and i_q that go up and down by a and b have neighbours 2a and 2b apart: half their square, at all but
 * the first sample. Parts are counted from the zero of the angle. */
static void test_noise_and_parts_of_a_turn(void)
{
    record(OF_TURN + 1);
    for (size_t k = 0; k < run.count; ++k) {
        const double sign = k % 2 ? 1.0 : -1.0;
        const double q = k >= 10 && k < 20 ? 7.0 : 3.0;
        rec_phases(-1.0 + 0.2 * sign, q + 0.1 * sign, 2.0 * run.theta_m_rad[k], run.i_A + 3 * k);
    }
    find(2);
    /* 79 pairs, of which two step by 4 ± 0.2 in i_q */
    const double square = 77.0 * (0.16 + 0.04) + 0.16 + 3.8 * 3.8 + 0.16 + 4.2 * 4.2;
    TEST_ASSERT_DOUBLE_WITHIN(0.021, 0.5 * square / OF_TURN, turns[0].noise_A2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 7.0, turns[0].part[1].q);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0, turns[0].part[0].q);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0, turns[0].part[2].q);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -1.0, turns[0].part[1].d);
}

/* A way back of a fiftieth of a turn (1.6 samples) ends a turn, which is then not whole. */
static void test_turning_back_ends_a_turn(void)
{
    for (size_t back = 1; back <= 2; ++back) {
        record(2 * OF_TURN);
        for (size_t k = 41; k < run.count; ++k)
            run.theta_m_rad[k] = 2.0 * REF_PI *
                                 ((double)k + 1e-6 - (double)(k < 41 + back ? 2 * (k - 40) : 2 * back)) /
                                 OF_TURN;
        find(2);
        TEST_ASSERT_EQUAL(back == 1 ? OF_TURN + 2 : 42, turns[0].count);
        TEST_ASSERT_EQUAL(back == 1, turns[0].whole);
        hci_memory_free(turns);
        turns = NULL;
        rec_release(&run);
    }
}

static void test_directions(void)
{
    record(OF_TURN);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_turn_direction(&run, 0, 5));
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, hci_turn_direction(&run, 5, 0));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_turn_direction(&run, 5, 5));
}

/* More than there is room for at first, 64, and 128. */
static void test_many_turns(void)
{
    record(200 * OF_TURN);
    find(2);
    TEST_ASSERT_EQUAL(200, count);
    TEST_ASSERT_EQUAL(199 * OF_TURN, turns[199].first);
    hci_memory_free(turns);
    hci_memory_fail_after(0);
    TEST_ASSERT_FALSE(hci_turns_find(&run, 2, &turns, &count));
    hci_memory_fail_after(1);
    TEST_ASSERT_FALSE(hci_turns_find(&run, 2, &turns, &count));
}

/* ---- which are alike ---- */

static bool alike(const hci_turn *b)
{
    return hci_turns_alike(&run, &statistics, &turns[0], b) &&
           hci_turns_alike(&run, &statistics, b, &turns[0]);
}

/* 2 % of 10 A and of 50 rad/s, and 1 K. */
static void test_what_is_alike(void)
{
    static const struct {
        double d, q, speed, temperature;
        bool is_alike;
    } CASE[] = {{0.19, 0.0, 0.0, 0.0, true},   {0.21, 0.0, 0.0, 0.0, false},  {0.0, -0.19, 0.0, 0.0, true},
                {0.0, 0.21, 0.0, 0.0, false},  {0.15, 0.15, 0.0, 0.0, false}, {0.0, 0.0, 0.99, 0.0, true},
                {0.0, 0.0, -1.01, 0.0, false}, {0.0, 0.0, 0.0, 0.99, true},   {0.0, 0.0, 0.0, -1.0, false}};
    record(3 * OF_TURN + 1);
    find(2);
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        hci_turn b = turns[0];
        b.d += CASE[k].d;
        b.q += CASE[k].q;
        b.speed += CASE[k].speed;
        b.temperature += CASE[k].temperature;
        TEST_ASSERT_EQUAL(CASE[k].is_alike, alike(&b));
    }
    hci_turn b = turns[0];
    b.whole = false;
    TEST_ASSERT_FALSE(hci_turns_alike(&run, &statistics, &turns[0], &b));
    TEST_ASSERT_FALSE(hci_turns_alike(&run, &statistics, &b, &turns[0]));
    b = turns[0];
    b.q += 5.0;
    statistics.no_current = true;
    TEST_ASSERT_TRUE(alike(&b));
}

/* Four standard deviations of the difference of two means of 80 samples. */
static void test_currents_alike_by_chance(void)
{
    record(2 * OF_TURN + 1);
    find(2);
    turns[0].noise_A2 = 4.0;
    hci_turn b = turns[0];
    b.noise_A2 = 12.0;
    const double by_chance = 4.0 * sqrt((4.0 + 12.0) / OF_TURN);
    b.q += 0.99 * by_chance;
    TEST_ASSERT_TRUE(alike(&b));
    b.q += 0.02 * by_chance;
    TEST_ASSERT_FALSE(alike(&b));
}

/* Speeds within a turn of a free shaft differ by no more than half of the largest. */
static void test_turns_of_a_free_shaft_are_even(void)
{
    record(2 * OF_TURN + 1);
    find(2);
    run.torque_source = HCI_TORQUE_INERTIA;
    hci_turn b = turns[0];
    b.least_speed = -60.0;
    b.most_speed = -31.0;
    TEST_ASSERT_TRUE(alike(&b));
    b.most_speed = -29.0;
    TEST_ASSERT_FALSE(hci_turns_alike(&run, &statistics, &b, &turns[0]));
    TEST_ASSERT_FALSE(hci_turns_alike(&run, &statistics, &turns[0], &b));
    run.torque_source = HCI_TORQUE_MEASURED;
    TEST_ASSERT_TRUE(alike(&b));
}

static void test_the_same_way_round(void)
{
    record(3 * OF_TURN);
    for (size_t k = OF_TURN; k < run.count; ++k)
        run.theta_m_rad[k] = 2.0 * REF_PI * (2.0 * OF_TURN - (double)k) / OF_TURN;
    find(2);
    hci_turn b = turns[0];
    TEST_ASSERT_TRUE(alike(&b));
    b.first = OF_TURN;
    TEST_ASSERT_FALSE(alike(&b));
}

/* ---- swings and creeping ---- */

/* Of eight turns that are alike, parts of `other` of the last seven have 0.3 A more. */
static bool swings(size_t other)
{
    hci_turn list[8];
    for (size_t k = 0; k < 8; ++k) {
        list[k] = turns[0];
        list[k].part[5].q += k > 0 && k <= other ? 0.21 : 0.19;
    }
    for (size_t part = 0; part < HCI_TURN_PARTS; ++part)
        list[0].part[part].q = turns[0].part[part].q;
    return hci_turns_swing(&run, &statistics, list, 8);
}

/* More than one in four. */
static void test_currents_that_swing(void)
{
    record(2 * OF_TURN + 1);
    find(2);
    TEST_ASSERT_FALSE(swings(0));
    TEST_ASSERT_FALSE(swings(1));
    TEST_ASSERT_TRUE(swings(2));
    statistics.no_current = true;
    TEST_ASSERT_FALSE(swings(7));
    statistics.no_current = false;
    run.torque_source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_FALSE(swings(7));
    run.torque_source = HCI_TORQUE_MEASURED;
    turns[0].part[5].count = 1.0; /* says nothing */
    TEST_ASSERT_FALSE(swings(7));
    turns[0].part[5].count = 2.0;
    TEST_ASSERT_TRUE(swings(7));
    turns[0].noise_A2 = 0.01; /* 4 √(2·0.01/2) = 0.4 A by chance */
    TEST_ASSERT_FALSE(swings(7));
    turns[0].whole = false; /* none is alike */
    turns[0].noise_A2 = 0.0;
    TEST_ASSERT_FALSE(swings(7));
}

/* A line of slope s through n points, and ±e about it by turns: Σ(k − mean)² = n(n² − 1)/12. */
static bool creeps(size_t n, double slope, double error)
{
    hci_turn list[MOST] = {{0}};
    for (size_t k = 0; k < n; ++k)
        list[k].torque = 5.0 + slope * (double)k + (k % 4 == 1 || k % 4 == 2 ? error : -error);
    return hci_turns_creep(&statistics, list, n);
}

/* Errors in the order −++− −++− have no slope and no mean: the line's standard error is that of 8 points with
 * the variance 8 e²/6, and Σ is 42. */
static void test_what_creeps(void)
{
    const double error = 0.01, of_slope = error * sqrt(8.0 / 6.0 / 42.0);
    TEST_ASSERT_TRUE(creeps(8, 6.1 * of_slope, error));
    TEST_ASSERT_TRUE(creeps(8, -6.1 * of_slope, error));
    TEST_ASSERT_FALSE(creeps(8, 5.9 * of_slope, error));
    statistics.repeat_Nm = 1.0; /* 7 slopes are 0.2 of it */
    TEST_ASSERT_TRUE(creeps(8, 0.0287, 1e-4));
    TEST_ASSERT_FALSE(creeps(8, 0.0284, 1e-4));
    TEST_ASSERT_TRUE(creeps(6, 0.1, 0.0));
    TEST_ASSERT_FALSE(creeps(5, 0.1, 0.0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_turns_follow_each_other);
    RUN_TEST(test_a_run_ends_with_a_turn);
    RUN_TEST(test_means_of_a_turn);
    RUN_TEST(test_noise_and_parts_of_a_turn);
    RUN_TEST(test_turning_back_ends_a_turn);
    RUN_TEST(test_directions);
    RUN_TEST(test_many_turns);
    RUN_TEST(test_what_is_alike);
    RUN_TEST(test_currents_alike_by_chance);
    RUN_TEST(test_turns_of_a_free_shaft_are_even);
    RUN_TEST(test_the_same_way_round);
    RUN_TEST(test_currents_that_swing);
    RUN_TEST(test_what_creeps);
    return UNITY_END();
}
