/* Which of several places that fit as well is taken, after how many turns a table repeats, and the lowest
 * point between places, of tables whose currents stand here. */
#include "host/currents/table_rotation.c"

#include "unity.h"

enum { MOST = 3 * GRID };

static double theta[MOST], measured[3 * MOST];
static hci_wave wave[2];
static hci_currents table;
static hci_run run;
static hci_note note;
static comparison c;

void setUp(void)
{
    memset(&run, 0, sizeof run);
    memset(&c, 0, sizeof c);
    run.theta_m_rad = theta;
    table = (hci_currents){.wave = wave, .count = 1};
}

void tearDown(void)
{
    hci_memory_free(c.grid);
}

/* The table so many places on, in the frame of the rotor, at each angle of the grid. */
static void play(double places)
{
    hci_memory_free(c.grid);
    c = (comparison){&table, &run, 1.0, 1, NULL, true, measured};
    TEST_ASSERT_EQUAL_INT(HCI_OK, make_grid(&c, &note));
    run.count = GRID * c.turns;
    for (size_t k = 0; k < run.count; ++k) {
        theta[k] = 2.0 * HCI_PI * (double)k / GRID;
        value_at(&c, theta[k] + 2.0 * HCI_PI * places / GRID, measured + 3 * k);
    }
}

/* A wave of order 2 goes round once in the frame: each place is the only one. */
static void test_the_only_place(void)
{
    static const size_t PLACE[] = {0, 1, 100, 254, 255, 256, 257, 258, 400, 510, 511};
    wave[0] = hci_wave_polar(2.0, 1, 3.0, 0.4);
    for (size_t k = 0; k < sizeof PLACE / sizeof *PLACE; ++k) {
        play((double)PLACE[k]);
        TEST_ASSERT_EQUAL_UINT64(PLACE[k], nearest_place(&c, PLACE[k]));
    }
}

/* One of order 9 goes round eight times, every 64 places: the nearest to none, ahead where both are. */
static void test_of_several_places_the_nearest_to_none(void)
{
    wave[0] = hci_wave_polar(9.0, 1, 3.0, 0.4);
    for (size_t at = 0; at < 64; at += 4)
        for (size_t turn = 0; turn < 8; turn += 3) {
            play((double)(at + 64 * turn));
            const size_t nearest = at <= 32 ? at : GRID + at - 64;
            TEST_ASSERT_EQUAL_UINT64(nearest, nearest_place(&c, at + 64 * turn));
        }
}

/* In a table of three turns what is behind none is behind all of them. */
static void test_places_of_several_turns(void)
{
    wave[0] = hci_wave_polar(4.0 / 3.0, 1, 3.0, 0.4);
    play(3 * GRID - 7);
    TEST_ASSERT_EQUAL_UINT64(3, c.turns);
    TEST_ASSERT_EQUAL_UINT64(3 * GRID - 7, nearest_place(&c, 3 * GRID - 7));
    play(GRID + 90); /* farther than half an electrical turn: it stays where it is */
    TEST_ASSERT_EQUAL_UINT64(GRID + 90, nearest_place(&c, GRID + 90));
}

/* What is left between two places is that of a parabola; what is no lowest is 2. */
static void test_the_lowest_point(void)
{
    wave[0] = hci_wave_polar(2.0, 1, 3.0, 0.4);
    play(40.3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, 0.0, lowest_at(&c, 40));
    TEST_ASSERT_TRUE(try_shift(&c, 40, false) > 1e-6);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, lowest_at(&c, 39));
    TEST_ASSERT_EQUAL_DOUBLE(2.0, lowest_at(&c, 41));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, lowest_at(&c, GRID / 2 + 41)); /* nothing is explained around it */
    play(0.3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, 0.0, lowest_at(&c, 0));
    play(GRID - 0.7);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, 0.0, lowest_at(&c, GRID - 1));
}

/* Of no gain above 0 all is left: of a table that is turned by half a turn, and of none. */
static void test_what_no_gain_explains(void)
{
    const sums opposite = {4.0, 9.0, -6.0}, none = {4.0, 0.0, 0.0}, half = {4.0, 9.0, 3.0},
               all = {4.0, 9.0, 6.0};
    TEST_ASSERT_EQUAL_DOUBLE(1.0, left_of(&opposite));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, left_of(&none));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.75, left_of(&half));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.0, left_of(&all));
}

/* The least number of turns of which all orders are whole, up to 64. */
static void test_turns_after_which_all_repeat(void)
{
    static const struct {
        double order[2];
        size_t turns;
    } CASE[] = {{{1.0, 5.0}, 1},          {{1.5, 1.0}, 2},          {{0.5, 1.0 / 3.0}, 6},
                {{1.0, 65.0 / 64.0}, 64}, {{1.0, 64.0 / 63.0}, 63}, {{1.0, 1.0 / 65.0}, 64}};
    table.count = 2;
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        for (int j = 0; j < 2; ++j)
            wave[j] = hci_wave_polar(CASE[k].order[j], 1, 1.0, 0.0);
        TEST_ASSERT_EQUAL_UINT64(CASE[k].turns, period_of(&table));
    }
}

/* An angle that stands still at a fifth of the samples or more is coarse: one of 20 less is not. */
static void test_how_often_an_angle_stands_still(void)
{
    for (size_t still = 3; still <= 5; ++still) {
        run.count = 20;
        c = (comparison){&table, &run, 3.0, 1, NULL, true, measured};
        theta[0] = 0.0;
        for (size_t k = 1; k < run.count; ++k)
            theta[k] = theta[k - 1] - (k <= still ? 0.0 : 0.01);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, still < 4 ? 0.0 : 0.03, step_of(&c));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_only_place);
    RUN_TEST(test_of_several_places_the_nearest_to_none);
    RUN_TEST(test_places_of_several_turns);
    RUN_TEST(test_the_lowest_point);
    RUN_TEST(test_what_no_gain_explains);
    RUN_TEST(test_turns_after_which_all_repeat);
    RUN_TEST(test_how_often_an_angle_stands_still);
    return UNITY_END();
}
