/* Where a shaft turns round, or its current: which samples belong to which part, and what each part has. */
#include "host/check/data/run_parts.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "unity.h"

enum { N = 200 };

static double theta[N], speed[N], q[N];
static check_samples s;
static signed char part[N];

void setUp(void)
{
    s = (check_samples){.count = N};
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
}

/* All samples from `from` on, before `until`, belong to a part. */
static void check_part(int which, size_t from, size_t until)
{
    for (size_t k = from; k < until; ++k)
        TEST_ASSERT_EQUAL_INT8(which, part[k]);
}

static int find(void)
{
    return hci_check_parts_find(&s, false, part);
}

/* Up by 0.1 a sample to `turn`, and down again; wrapped at `range`, if any. */
static void there_and_back(size_t turn, double range)
{
    for (size_t k = 0; k < N; ++k) {
        theta[k] = 50.0 + 0.1 * (k < turn ? (double)k : 2.0 * (double)turn - (double)k);
        if (range > 0.0) theta[k] = fmod(theta[k], range);
    }
    s.theta = theta;
}

/* ---- angles */

static void test_one_direction_is_one_part(void)
{
    there_and_back(N, 0.0);
    TEST_ASSERT_EQUAL(1, find());
    check_part(0, 0, N);
    there_and_back(0, 5.0); /* backward only: the parts are numbered without gaps */
    TEST_ASSERT_EQUAL(1, find());
    check_part(0, 0, N);
}

/* At the top of the path, which is sample 120, wrapped or not; the ways of the wraps are both seen. */
static void test_a_shaft_that_turns_round(void)
{
    for (int wrapped = 0; wrapped < 2; ++wrapped) {
        there_and_back(120, wrapped ? 5.0 : 0.0);
        TEST_ASSERT_EQUAL(2, find());
        check_part(0, 0, 120);
        check_part(1, 120, N);
        for (size_t k = 0; k < N; ++k)
            theta[k] = -theta[k];
        TEST_ASSERT_EQUAL(2, find());
        check_part(1, 0, 120);
        check_part(0, 120, N);
    }
}

/* A way back of less than a tenth of the whole is none; one of more is. */
static void test_a_short_way_back_is_none(void)
{
    for (int longer = 0; longer < 2; ++longer) {
        const size_t back = longer ? 17 : 16; /* of 165 and 167 steps */
        double at = 0.0;
        for (size_t k = 0; k < N; ++k)
            theta[k] = at += k > 100 && k <= 100 + back ? -0.1 : 0.1;
        s.theta = theta;
        TEST_ASSERT_EQUAL(longer ? 2 : 1, find());
        check_part(0, 0, 100);
        check_part(longer, 100, 100 + back);
        check_part(0, 100 + back, N);
    }
}

/* Fewer than a twentieth of the samples are no part, though they are another way. */
static void test_a_short_part_is_none(void)
{
    for (int longer = 0; longer < 2; ++longer) {
        const size_t turn = longer ? N - 10 : N - 9;
        for (size_t k = 0; k < N; ++k)
            theta[k] = k < turn ? 0.1 * (double)k : 0.1 * (double)turn - 1.0 * (double)(k - turn);
        s.theta = theta;
        TEST_ASSERT_EQUAL(longer ? 2 : 1, find());
        check_part(0, 0, turn);
        check_part(longer ? 1 : -1, turn, N);
    }
}

/* Eight samples at least, unless there is nothing else. */
static void test_few_samples(void)
{
    s.speed = speed;
    for (size_t k = 0; k < N; ++k)
        speed[k] = k < 12 ? 3.0 : -3.0;
    s.count = 20;
    TEST_ASSERT_EQUAL(2, find());
    check_part(1, 12, 20);
    s.count = 19;
    TEST_ASSERT_EQUAL(1, find());
    check_part(-1, 12, 19);
    s.count = 7;
    TEST_ASSERT_EQUAL(1, find());
    check_part(0, 0, 7);
}

/* Steps from 0.3 to 0.7 of the range, more than one in ten of them. */
static void test_a_torn_angle(void)
{
    for (int k = 0; k < N; ++k)
        theta[k] = k % 2 ? 1.0 : 0.0; /* all are wraps */
    TEST_ASSERT_FALSE(hci_check_angle_is_torn(theta, N));
    static const struct {
        double jump;
        int count;
        bool is_torn;
    } CASE[] = {{0.5, 21, true},  {0.5, 20, false}, {0.29, 100, false},
                {0.31, 21, true}, {0.69, 21, true}, {0.71, 100, false}};
    for (size_t c = 0; c < sizeof CASE / sizeof *CASE; ++c) {
        theta[0] = 0.0;
        theta[1] = 1.0;
        for (int k = 2; k < N; ++k) /* each change of the level is one step */
            theta[k] = k < CASE[c].count + 2 ? (k % 2 ? 1.0 : 1.0 - CASE[c].jump) : theta[k - 1];
        TEST_ASSERT_EQUAL(CASE[c].is_torn, hci_check_angle_is_torn(theta, N));
    }
}

/* ---- speeds and currents */

/* Where it stands it belongs to what was before. */
static void test_a_speed_without_an_angle(void)
{
    s.speed = speed;
    for (size_t k = 0; k < N; ++k)
        speed[k] = k < 80 ? -4.0 : k < 100 ? 0.0 : 5.0;
    TEST_ASSERT_EQUAL(2, find());
    check_part(1, 0, 100);
    check_part(0, 100, N);
    TEST_ASSERT_EQUAL(1, hci_check_parts_find(&s, true, part)); /* held: friction there and back */
    check_part(0, 0, N);
}

/* The parts are: forward, backward, and with currents below 0. */
static void test_currents_of_two_signs(void)
{
    s.speed = speed;
    s.q = q;
    for (size_t k = 0; k < N; ++k) {
        speed[k] = k < 100 ? 4.0 : -4.0;
        q[k] = k / 50 % 2 ? -2.0 : 3.0;
    }
    TEST_ASSERT_EQUAL(4, find());
    check_part(0, 0, 50);
    check_part(2, 50, 100);
    check_part(1, 100, 150);
    check_part(3, 150, N);
    for (size_t k = 0; k < N; ++k)
        speed[k] = 4.0;
    TEST_ASSERT_EQUAL(2, find());
    check_part(1, 50, 100);
}

/* Where there is no angle, fewer than a fifth of the samples within a tenth of the largest; else fewer than a
 * tenth within 0.3 of it; and each sign has a twentieth of the whole. */
static void test_what_is_no_change_of_sign(void)
{
    static const struct {
        int low;    /* samples in between */
        double of;  /* their size */
        double neg; /* that of the other sign */
        bool has_angle, are_two;
    } CASE[] = {{39, 0.09, -1.0, false, true}, {40, 0.09, -1.0, false, false}, {60, 0.11, -1.0, false, true},
                {19, 0.29, -1.0, true, true},  {20, 0.29, -1.0, true, false},  {60, 0.31, -1.0, true, true},
                {0, 0.0, -0.2, false, true},   {0, 0.0, -0.15, false, false}};
    for (size_t c = 0; c < sizeof CASE / sizeof *CASE; ++c) {
        there_and_back(N, 0.0);
        if (!CASE[c].has_angle) s.theta = NULL;
        s.q = q;
        for (int k = 0; k < N; ++k) /* a quarter of the other sign */
            q[k] = k < CASE[c].low ? CASE[c].of : k % 4 ? 1.0 : CASE[c].neg;
        TEST_ASSERT_EQUAL(CASE[c].are_two ? 2 : 1, find());
    }
}

/* ---- what a part has */

static void test_a_part_is_gathered(void)
{
    static double column[9][N], of_phase[6][N];
    static check_vector current[N], voltage[N];
    const double *phase[] = {of_phase[0], of_phase[1], NULL},
                 *volt[] = {of_phase[3], of_phase[4], of_phase[5]};
    check_samples p;
    for (size_t k = 0; k < N; ++k) {
        part[k] = (signed char)(k % 7 < 3 ? 0 : k % 7 < 6 ? 1 : -1);
        for (int c = 0; c < 9; ++c)
            column[c][k] = 1000.0 * c + (double)k;
        for (int c = 0; c < 6; ++c)
            of_phase[c][k] = -1000.0 * c - (double)k;
        current[k] = (check_vector){(double)k, 1.0};
        voltage[k] = (check_vector){2.0, -(double)k};
    }
    s = (check_samples){.count = N,
                        .time = column[0],
                        .theta = column[1],
                        .other = column[2],
                        .speed = column[3],
                        .d = column[4],
                        .q = column[5],
                        .vd = column[6],
                        .vq = column[7],
                        .torque = column[8],
                        .phase = phase,
                        .volt = volt,
                        .current = current,
                        .voltage = voltage};
    TEST_ASSERT_TRUE(hci_check_part_take(&s, part, 1, &p));
    const double *const got[] = {p.time, p.theta, p.other, p.speed, p.d, p.q, p.vd, p.vq, p.torque};
    size_t used = 0;
    for (size_t k = 0; k < N; ++k) {
        if (part[k] != 1) continue;
        for (int c = 0; c < 9; ++c)
            TEST_ASSERT_EQUAL_DOUBLE(column[c][k], got[c][used]);
        for (int c = 0; c < 3; ++c) {
            if (c < 2) TEST_ASSERT_EQUAL_DOUBLE(of_phase[c][k], p.phase[c][used]);
            TEST_ASSERT_EQUAL_DOUBLE(of_phase[3 + c][k], p.volt[c][used]);
        }
        TEST_ASSERT_EQUAL_DOUBLE((double)k, p.current[used].re);
        TEST_ASSERT_EQUAL_DOUBLE(-(double)k, p.voltage[used].im);
        TEST_ASSERT_EQUAL(k % 7 != 3, p.follows[used]);
        ++used;
    }
    TEST_ASSERT_EQUAL(used, p.count);
    TEST_ASSERT_NULL(p.phase[2]);
    hci_check_part_release(&p);
}

static void test_what_is_not_there_is_not_in_a_part(void)
{
    check_samples p;
    memset(part, 0, sizeof part);
    s.q = q;
    TEST_ASSERT_TRUE(hci_check_part_take(&s, part, 0, &p));
    TEST_ASSERT_EQUAL(N, p.count);
    TEST_ASSERT_FALSE(p.follows[0]);
    TEST_ASSERT_TRUE(p.follows[1]);
    TEST_ASSERT_TRUE(!p.time && !p.theta && !p.speed && !p.torque && !p.phase && !p.volt && !p.current);
    TEST_ASSERT_EQUAL_MEMORY(q, p.q, sizeof q);
    hci_check_part_release(&p);
}

static void test_memory_that_is_short(void)
{
    static check_vector current[N], voltage[N];
    check_samples p;
    there_and_back(N, 0.0);
    s.current = current;
    s.voltage = voltage;
    hci_memory_fail_after(0);
    TEST_ASSERT_EQUAL(0, find());
    for (int k = 0; k < 4; ++k) {
        hci_memory_fail_after(-1);
        memset(part, 0, sizeof part);
        hci_memory_fail_after(k);
        TEST_ASSERT_FALSE(hci_check_part_take(&s, part, 0, &p));
        hci_check_part_release(&p);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_one_direction_is_one_part);
    RUN_TEST(test_a_shaft_that_turns_round);
    RUN_TEST(test_a_short_way_back_is_none);
    RUN_TEST(test_a_short_part_is_none);
    RUN_TEST(test_few_samples);
    RUN_TEST(test_a_torn_angle);
    RUN_TEST(test_a_speed_without_an_angle);
    RUN_TEST(test_currents_of_two_signs);
    RUN_TEST(test_what_is_no_change_of_sign);
    RUN_TEST(test_a_part_is_gathered);
    RUN_TEST(test_what_is_not_there_is_not_in_a_part);
    RUN_TEST(test_memory_that_is_short);
    return UNITY_END();
}
