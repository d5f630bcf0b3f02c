/* A shaft whose time over the angle is known in closed form, t(θ) = θ/ω + S sin kθ + C cos kθ: its waves, and
 * its acceleration −t″/t′³, apart for each direction. */
#include "host/recording/turn_ways.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "support/recording.h"
#include "unity.h"

enum { POLE_PAIRS = 2, OF_TURN = 400, TURNS = 6, WAY = OF_TURN * TURNS };

static const double SPEED = 1.5, TIME_S = 4e-3, AHEAD = 0.7, CURRENT_A = 0.3;
static const int ORDER = 7, OF_CURRENT = 12;

static hci_run run;
static hci_turn_ways ways;
static uint64_t seed;

void setUp(void)
{
    run = rec_make(2 * WAY);
    seed = 11;
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_turn_ways_release(&ways);
    rec_release(&run);
}

/* Delay of a way at an angle: forward of order 7, backward of half the size. */
static double late_s(double theta, bool back)
{
    return (back ? 0.5 : 1.0) * TIME_S * sin(ORDER * theta + AHEAD);
}

/* Six turns forward, and six back at another speed. */
static void record(double back_speed)
{
    double end_s = 0.0;
    for (size_t k = 0; k < 2 * WAY; ++k) {
        const bool back = k >= WAY;
        const double step = 2.0 * REF_PI / OF_TURN, top = step * (WAY - 1);
        const double theta = 0.1 + (back ? top - step * (double)(k - WAY) : step * (double)k);
        const double t =
            back ? end_s + (0.1 + top - theta) / back_speed + late_s(theta, true) - late_s(0.1 + top, true)
                 : theta / SPEED + late_s(theta, false);
        if (!back) end_s = t + 1e-3;
        run.theta_m_rad[k] = theta;
        run.time_s[k] = t + 1e-7 * ref_normal(&seed);
        rec_phases(0.2, (back ? -1.0 : 1.0) + CURRENT_A * cos(OF_CURRENT * theta) + 1e-4 * ref_normal(&seed),
                   POLE_PAIRS * theta, run.i_A + 3 * k);
    }
}

static bool find(void)
{
    bool found = false;
    hci_turn_ways_release(&ways);
    TEST_ASSERT_EQUAL(HCI_OK, hci_turn_ways_find(&run, POLE_PAIRS, &ways, &found));
    return found;
}

/* What stood there before is gone, whatever a run lacks. */
static void test_nothing_is_left_where_nothing_is_found(void)
{
    bool found = true;
    double *time_s = run.time_s;
    record(SPEED);
    run.time_s = NULL;
    memset(&ways, 0x5a, sizeof ways);
    TEST_ASSERT_EQUAL(HCI_OK, hci_turn_ways_find(&run, POLE_PAIRS, &ways, &found));
    run.time_s = time_s;
    TEST_ASSERT_FALSE(found);
    for (int d = 0; d < 2; ++d)
        TEST_ASSERT_TRUE(ways.way[d].order == NULL && ways.way[d].seen == NULL && !ways.way[d].any);
}

/* −t″/t′³ where t′ = 1/ω + k A cos(kθ + a). */
static double acceleration(double theta, double speed, double size_s)
{
    const double x = ORDER * theta + AHEAD, slope = 1.0 / speed + ORDER * size_s * cos(x);
    return ORDER * ORDER * size_s * sin(x) / (slope * slope * slope);
}

static void test_waves_of_both_ways(void)
{
    record(1.8);
    TEST_ASSERT_TRUE(find());
    TEST_ASSERT_EQUAL_DOUBLE(1.0, ways.scale);
    TEST_ASSERT_EQUAL(60 * POLE_PAIRS, ways.highest);
    for (int d = 0; d < 2; ++d) {
        const hci_way *w = &ways.way[d];
        const double speed = d ? -1.8 : SPEED, size_s = d ? 0.5 * TIME_S : TIME_S;
        TEST_ASSERT_TRUE(w->any);
        TEST_ASSERT_DOUBLE_WITHIN(5e-3, speed, w->speed_rad_per_s);
        TEST_ASSERT_EQUAL(2, w->count);
        TEST_ASSERT_EQUAL(ORDER, w->seen[0]);
        TEST_ASSERT_EQUAL(OF_CURRENT, w->seen[1]);
        const hci_way_wave *t = &w->order[ORDER].time_s, *q = &w->order[OF_CURRENT].iq_A;
        /* the speed is a line's through ways that are no whole turns */
        TEST_ASSERT_DOUBLE_WITHIN(1e-3 * TIME_S, size_s * cos(AHEAD), t->sine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3 * TIME_S, size_s * sin(AHEAD), t->cosine);
        const double of_a_cell =
            CURRENT_A * OF_CURRENT * REF_PI / (64.0 * 60.0 * POLE_PAIRS); /* half of one */
        TEST_ASSERT_DOUBLE_WITHIN(of_a_cell, 0.0, q->sine);
        TEST_ASSERT_DOUBLE_WITHIN(of_a_cell, CURRENT_A, q->cosine);
        TEST_ASSERT_TRUE(t->stands_out && q->stands_out);
        TEST_ASSERT_FALSE(w->order[ORDER].iq_A.stands_out || w->order[OF_CURRENT].time_s.stands_out);
        TEST_ASSERT_FALSE(w->order[0].iq_A.stands_out);
        for (double theta = 0.0; theta < 6.0; theta += 0.37) {
            const double of = acceleration(theta, speed, size_s);
            TEST_ASSERT_DOUBLE_WITHIN(2e-3 * ORDER * ORDER * size_s * fabs(speed * speed * speed), of,
                                      hci_way_acceleration(&ways, w, theta));
        }
    }
}

/* Over a turn the acceleration has the Fourier sums of its closed form, at the orders that stand out. */
static void test_orders_of_the_acceleration(void)
{
    enum { POINTS = 5000 };
    record(1.8);
    TEST_ASSERT_TRUE(find());
    double sine = 0.0, cosine = 0.0;
    for (int k = 0; k < POINTS; ++k) {
        const double theta = 2.0 * REF_PI * k / POINTS, a = acceleration(theta, SPEED, TIME_S);
        sine += 2.0 / POINTS * a * sin(ORDER * theta);
        cosine += 2.0 / POINTS * a * cos(ORDER * theta);
    }
    const hci_way_order *o = &ways.way[0].order[ORDER];
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * hypot(sine, cosine), sine, o->alpha_sine);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * hypot(sine, cosine), cosine, o->alpha_cosine);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, ways.way[0].order[ORDER + 1].alpha_sine);
}

/* The turn that is known is the electrical one: its order 6 is 12 of the shaft, and 7 is no order of it. */
static void test_electrical_turns(void)
{
    run.turn_known = false;
    record(1.8);
    TEST_ASSERT_TRUE(find());
    TEST_ASSERT_EQUAL_DOUBLE(POLE_PAIRS, ways.scale);
    TEST_ASSERT_EQUAL(60, ways.highest);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, CURRENT_A, ways.way[0].order[OF_CURRENT / POLE_PAIRS].iq_A.cosine);
    TEST_ASSERT_TRUE(ways.way[0].order[OF_CURRENT / POLE_PAIRS].iq_A.stands_out);
}

/* One way alone has the other empty. */
static void test_one_way(void)
{
    record(1.8);
    run.count = WAY;
    TEST_ASSERT_TRUE(find());
    TEST_ASSERT_TRUE(ways.way[0].any && !ways.way[1].any);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, ways.way[1].speed_rad_per_s);
    TEST_ASSERT_EQUAL(0, ways.way[1].count);
}

/* Speeds of two parts of one direction that differ by less than a tenth are one; half an electrical turn, not
 * more, is no way back. */
static void test_parts_of_a_way(void)
{
    static const struct {
        double faster;
        bool found;
    } CASE[] = {{1.09, true}, {1.11, false}};
    for (size_t c = 0; c < 2; ++c) {
        const double step = 2.0 * REF_PI / OF_TURN;
        double t = 0.0, theta = 0.0;
        for (size_t k = 0; k < 2 * WAY; ++k) { /* on, 0.3 of a turn back, and on again */
            const bool back = k >= WAY && k < WAY + 120;
            t += step / (k < WAY ? 1.0 : CASE[c].faster);
            theta += back ? -step : step;
            run.theta_m_rad[k] = theta;
            run.time_s[k] = t;
            rec_phases(0.0, 1.0 + 1e-4 * ref_normal(&seed), POLE_PAIRS * theta, run.i_A + 3 * k);
        }
        TEST_ASSERT_EQUAL(CASE[c].found, find());
        if (CASE[c].found) TEST_ASSERT_DOUBLE_WITHIN(0.01, 1.045, ways.way[0].speed_rad_per_s);
    }
}

/* Where the time would go back, or by less than a tenth of its mean, the shaft sticks: 7 A ω from 0.9. */
static void test_a_shaft_that_sticks(void)
{
    for (int sticks = 0; sticks < 2; ++sticks) {
        const double size_s = (sticks ? 0.93 : 0.87) / ORDER / SPEED;
        for (size_t k = 0; k < WAY; ++k) {
            const double theta = 2.0 * REF_PI / OF_TURN * (double)k;
            run.theta_m_rad[k] = theta;
            run.time_s[k] = theta / SPEED + size_s * sin(ORDER * theta) + 1e-7 * ref_normal(&seed);
            rec_phases(0.0, 1.0 + 1e-4 * ref_normal(&seed), POLE_PAIRS * theta, run.i_A + 3 * k);
        }
        run.count = WAY;
        TEST_ASSERT_EQUAL(!sticks, find());
    }
}

/* Two turns on and two back, up to 64 times; what turns back more often is no matter of ways. */
static void test_many_ways(void)
{
    enum { MOST = 64, LONG = 2 * OF_TURN };
    rec_release(&run);
    run = rec_make((MOST + 1) * LONG);
    for (int parts = MOST; parts <= MOST + 1; ++parts) {
        const double step = 2.0 * REF_PI / OF_TURN;
        double theta = 0.0;
        run.count = (size_t)parts * LONG;
        for (size_t k = 0; k < run.count; ++k) {
            theta += k / LONG % 2 ? -step : step;
            run.theta_m_rad[k] = theta;
            run.time_s[k] = step * (double)k / SPEED;
            rec_phases(0.0, 1.0 + 1e-4 * ref_normal(&seed), POLE_PAIRS * theta, run.i_A + 3 * k);
        }
        TEST_ASSERT_EQUAL(parts == MOST, find());
    }
}

static void test_what_has_no_ways(void)
{
    double *const time_s = run.time_s;
    record(1.8);
    run.time_s = NULL;
    TEST_ASSERT_FALSE(find());
    run.time_s = time_s;
    run.count = OF_TURN / POLE_PAIRS / 2; /* half an electrical turn */
    TEST_ASSERT_FALSE(find());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nothing_is_left_where_nothing_is_found);
    RUN_TEST(test_waves_of_both_ways);
    RUN_TEST(test_orders_of_the_acceleration);
    RUN_TEST(test_electrical_turns);
    RUN_TEST(test_one_way);
    RUN_TEST(test_parts_of_a_way);
    RUN_TEST(test_a_shaft_that_sticks);
    RUN_TEST(test_many_ways);
    RUN_TEST(test_what_has_no_ways);
    return UNITY_END();
}
