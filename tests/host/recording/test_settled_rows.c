/* Which rows of a slow turn are left out: where the shaft waits, turns round, or stands at the ends
 * (slow_turn.h); and the numbers of each rule. */
#include <math.h>
#include <string.h>

#include "host/recording/slow_turn.h"
#include "support/draws.h"
#include "support/recording.h"
#include "support/texts.h"
#include "unity.h"

enum { MOST = 6000, P = 5 };

#define STEP_S 0.01
#define TURN   (2.0 * REF_PI / P) /* mechanical angle of an electrical turn */

static hci_run run;
static size_t kept_row[MOST]; /* filled by make */

void setUp(void)
{
    memset(&run, 0, sizeof run);
}

void tearDown(void)
{
    run.row = NULL;
    run.v_V = NULL;
    rec_release(&run);
}

/* ---- a path ---- */

static double path[MOST];
static size_t n;

static void begin(double at)
{
    n = 0;
    path[n++] = at;
}

/* Goes on by some electrical turns at 0.005 of one a row. */
static void go(double turns)
{
    const double step = (turns > 0.0 ? 0.005 : -0.005) * TURN;
    for (size_t k = (size_t)(fabs(turns) / 0.005 + 0.5); k > 0; --k, ++n)
        path[n] = path[n - 1] + step;
}

static void wait(size_t rows)
{
    for (; rows > 0; --rows, ++n)
        path[n] = path[n - 1];
}

/* A run of the path; every column tells which row it was. */
static void make(void)
{
    static double v_V[3 * MOST];
    run.row = NULL;
    run.v_V = NULL;
    rec_release(&run);
    run = rec_make(n);
    run.temperature_C = calloc(n, sizeof *run.temperature_C);
    run.row = kept_row;
    run.v_V = v_V;
    for (size_t k = 0; k < n; ++k) {
        run.time_s[k] = 3.0 + STEP_S * (double)k;
        run.theta_m_rad[k] = path[k];
        run.speed_rad_per_s[k] = run.torque_Nm[k] = run.temperature_C[k] = (double)k;
        for (size_t s = 0; s < 3; ++s)
            run.i_A[3 * k + s] = run.v_V[3 * k + s] = (double)(10 * k + s);
        run.row[k] = k;
    }
}

/* Every column of what is left is that of its row. */
static void check_columns(void)
{
    for (size_t k = 0; k < run.count; ++k) {
        const size_t was = run.row[k];
        TEST_ASSERT_EQUAL_DOUBLE(3.0 + STEP_S * (double)was, run.time_s[k]);
        TEST_ASSERT_EQUAL_DOUBLE(path[was], run.theta_m_rad[k]);
        TEST_ASSERT_EQUAL_DOUBLE((double)was, run.speed_rad_per_s[k]);
        TEST_ASSERT_EQUAL_DOUBLE((double)was, run.torque_Nm[k]);
        TEST_ASSERT_EQUAL_DOUBLE((double)was, run.temperature_C[k]);
        for (size_t s = 0; s < 3; ++s) {
            TEST_ASSERT_EQUAL_DOUBLE((double)(10 * was + s), run.i_A[3 * k + s]);
            TEST_ASSERT_EQUAL_DOUBLE((double)(10 * was + s), run.v_V[3 * k + s]);
        }
    }
}

static bool is_kept(size_t row)
{
    for (size_t k = 0; k < run.count; ++k)
        if (run.row[k] == row) return true;
    return false;
}

/* The rows from … end − 1 are all left out, and the two beside them are not. */
static void is_out(size_t from, size_t end)
{
    for (size_t k = from; k < end; ++k)
        TEST_ASSERT_FALSE_MESSAGE(is_kept(k), "a row is kept");
    TEST_ASSERT_TRUE(from == 0 || is_kept(from - 1));
    TEST_ASSERT_TRUE(end == n || is_kept(end));
}

static void settle(void)
{
    make();
    TEST_ASSERT_TRUE(hci_settled_rows_keep(&run, P));
    check_columns();
}

/* ---- waits and turning points ---- */

/* Half a window is 0.025 turns, 5 rows, and one more: 12 rows from end to end. At row k before the wait it
 * moves for (606 − k) of them, which is nine tenths up to row 595; half a window earlier the rows end. */
static void test_a_wait_on_the_way(void)
{
    begin(0.7);
    go(3.0);
    wait(150);
    go(3.0);
    settle();
    is_out(590, 761);
    TEST_ASSERT_EQUAL(n - 171, run.count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 6.0 * TURN, run.swept_rad);
    text_has("171 of 1351 rows are not used: in 143 the shaft waits, and in 28 it speeds up, slows down or "
             "turns round",
             run.remark.text);
}

/* A row k beside the turning point, at 640, sees |640 − k| of 6 rows as a way. */
static void test_rests_at_the_ends_and_a_turning_point(void)
{
    for (int way = -1; way <= 1; way += 2) {
        begin(0.7 * way);
        wait(40);
        go(3.0 * way);
        go(-4.0 * way);
        wait(30);
        settle();
        is_out(0, 51);
        is_out(629, 652);
        is_out(1430, 1471);
        TEST_ASSERT_EQUAL(1471 - 51 - 23 - 41, run.count);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 4.0 * TURN, run.swept_rad);
        text_has("115 of 1471 rows are not used: in 67 the shaft waits, and in 48 it", run.remark.text);
    }
}

/* Without a wait the words are fewer. */
static void test_no_wait(void)
{
    begin(0.7);
    go(4.0);
    for (size_t k = 0; k < 30; ++k, ++n) /* on at half its pace */
        path[n] = path[n - 1] + 0.0025 * TURN;
    settle();
    text_has("rows are not used, in which the shaft speeds up, slows down or turns round", run.remark.text);
}

static size_t kept_of_part(double turns)
{
    begin(0.7);
    wait(40);
    go(turns);
    settle();
    return run.count;
}

/* Of less than two electrical turns nothing is left out. */
static void test_short_parts(void)
{
    kept_of_part(1.98);
    TEST_ASSERT_EQUAL(n, run.count);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, run.swept_rad);
    TEST_ASSERT_EQUAL_STRING("", run.remark.text);
    kept_of_part(2.02);
    TEST_ASSERT_EQUAL(n - 51, run.count);
}

/* As long as half an electrical turn takes: (1200 + W)/12 rows of 1200 + W, and 4 rows more are within a
 * fiftieth of a turn. */
static void test_how_long_a_wait_is(void)
{
    for (int longer = 0; longer < 2; ++longer) {
        begin(0.7);
        go(3.0);
        wait(longer ? 112 : 98);
        go(3.0);
        settle();
        TEST_ASSERT_EQUAL(longer, run.count < n);
    }
}

/* Three waits on a way, not four. */
static void test_a_way_in_steps(void)
{
    for (int waits = 1; waits <= 4; ++waits) {
        begin(0.7);
        go(12.0 / (waits + 1));
        for (int j = 0; j < waits; ++j) {
            wait(250);
            go(12.0 / (waits + 1));
        }
        settle();
        TEST_ASSERT_EQUAL_MESSAGE(waits < 4 ? n - (size_t)waits * 271 : n, run.count, "a number of waits");
    }
}

/* The way back of less than half an electrical turn is no turning point. */
static void test_a_small_way_back(void)
{
    for (int more = 0; more < 2; ++more) {
        begin(0.7);
        go(3.0);
        go(more ? -0.52 : -0.48);
        go(3.0);
        settle();
        TEST_ASSERT_EQUAL(more, run.count < n);
    }
}

/* Runs without time or angle, or of 15 rows, stay. */
static void test_what_has_no_way(void)
{
    kept_of_part(3.0);
    TEST_ASSERT_EQUAL(n - 51, run.count);
    for (int which = 0; which < 2; ++which) {
        make();
        double **column = which ? &run.time_s : &run.theta_m_rad;
        free(*column);
        *column = NULL;
        TEST_ASSERT_TRUE(hci_settled_rows_keep(&run, P));
        TEST_ASSERT_EQUAL(n, run.count);
    }
}

/* ---- a free shaft at rest ---- */

static size_t left_of(size_t before, double turns, size_t after)
{
    begin(0.7);
    wait(before);
    go(turns);
    wait(after);
    make();
    run.torque_window = 7;
    run.speed_window = 4;
    TEST_ASSERT_TRUE(hci_rest_at_ends_leave(&run));
    check_columns();
    return run.count;
}

/* 11 rows of those that stand are what slopes need, and more than 16 others are worth it. */
static void test_rest_at_the_ends_is_left_out(void)
{
    left_of(26, 2.0, 26);
    TEST_ASSERT_EQUAL(n, run.count);
    TEST_ASSERT_EQUAL_STRING("", run.remark.text);
    left_of(27, 2.0, 39);
    TEST_ASSERT_EQUAL(n - 17 - 29, run.count);
    is_out(0, 17);
    is_out(n - 29, n);
    text_has("46 of 467 rows, in which the shaft stands before or after it runs, are not used",
             run.remark.text);
    left_of(60, 2.0, 5);
    TEST_ASSERT_EQUAL(n - 50, run.count);
}

/* A hundred rows have to be left: 22 that slopes need and 77, or 78. */
static void test_enough_rows_are_left(void)
{
    left_of(60, 0.38, 60);
    TEST_ASSERT_EQUAL(n, run.count);
    left_of(60, 0.40, 60);
    TEST_ASSERT_EQUAL(101, run.count);
    left_of(300, 0.0, 0);
    TEST_ASSERT_EQUAL(n, run.count);
}

/* ---- slow ---- */

/* A shaft that stands, goes at a speed, goes back, and stands, with a load and something that varies. */
static void make_pace(double speed, double there_rad, double back_rad)
{
    n = 800;
    begin(0.3);
    wait(299);
    for (double gone = 0.0; gone < there_rad; gone += speed * STEP_S, ++n)
        path[n] = path[n - 1] + speed * STEP_S;
    for (double gone = 0.0; gone < back_rad; gone += speed * STEP_S, ++n)
        path[n] = path[n - 1] - speed * STEP_S;
    wait(300);
    make();
    for (size_t k = 0; k < n; ++k) {
        const double step = k + 1 < n ? path[k + 1] - path[k] : 0.0;
        run.speed_rad_per_s[k] = step / STEP_S;
        rec_phases(0.2, 1.0 + 0.4 * sin(0.05 * (double)k), P * path[k], run.i_A + 3 * k);
    }
}

/* 2.1 rad/s, of the rows in which it goes; and half an electrical turn each way. */
static void test_a_slow_shaft(void)
{
    make_pace(2.05, 8.0, 5.0);
    TEST_ASSERT_TRUE(hci_is_slow(&run, P));
    TEST_ASSERT_TRUE(hci_is_slow_turn_both_ways(&run, P));
    make_pace(2.15, 8.0, 5.0);
    TEST_ASSERT_FALSE(hci_is_slow(&run, P));
    TEST_ASSERT_FALSE(hci_is_slow_turn_both_ways(&run, P));
    for (int which = 0; which < 2; ++which) {
        make_pace(1.0, which ? 6.0 : 0.93 * 0.5 * TURN, which ? 0.93 * 0.5 * TURN : 6.0);
        TEST_ASSERT_FALSE(hci_is_slow_turn_both_ways(&run, P));
        make_pace(1.0, which ? 6.0 : 1.07 * 0.5 * TURN, which ? 1.07 * 0.5 * TURN : 6.0);
        TEST_ASSERT_TRUE(hci_is_slow_turn_both_ways(&run, P));
        TEST_ASSERT_TRUE(hci_is_slow(&run, P));
    }
}

static void test_what_a_slow_shaft_needs(void)
{
    for (int which = 0; which < 3; ++which) {
        make_pace(1.0, 8.0, 5.0);
        double **column = which == 0 ? &run.theta_m_rad : which == 1 ? &run.time_s : &run.speed_rad_per_s;
        free(*column);
        *column = NULL;
        TEST_ASSERT_FALSE(hci_is_slow(&run, P));
    }
    make_pace(1.0, 8.0, 5.0);
    memset(run.i_A, 0, 3 * n * sizeof *run.i_A);
    TEST_ASSERT_FALSE(hci_is_slow(&run, P));
}

/* Noise of sensors has nothing in common with the next sample: of n samples, 2 % and three standard errors,
 * 1/√(2n), are allowed. Rows far apart tell nothing. */
static void test_a_shaft_without_current(void)
{
    uint64_t seed = 13;
    for (int case_ = 0; case_ < 3; ++case_) {
        make_pace(1.0, 8.0, 5.0);
        const double most = 0.02 + 3.0 / sqrt(2.0 * (double)n), common = (case_ == 1 ? 1.6 : 0.5) * most;
        for (size_t k = 0; k < n; ++k) {
            rec_phases(sqrt(common) + sqrt(0.5 * (1.0 - common)) * ref_normal(&seed),
                       sqrt(0.5 * (1.0 - common)) * ref_normal(&seed), P * path[k], run.i_A + 3 * k);
            if (case_ == 2) run.theta_m_rad[k] = path[k] + 0.02 * (k % 2 ? 1.0 : -1.0);
        }
        TEST_ASSERT_EQUAL(case_ > 0, hci_is_slow(&run, P));
    }
}

/* ---- a slow turn by its inertia ---- */

/* i_q = 3 + 2 sin, whose rms about its mean is √2, over whole periods; a torque with a mean that varies by
 * `varies`, at a speed. */
static bool is_slow_turn(double varies, double speed, double inertia, double constant)
{
    const size_t rows = 400;
    run.row = NULL;
    run.v_V = NULL;
    rec_release(&run);
    run = rec_make(rows);
    for (size_t k = 0; k < rows; ++k) {
        const double x = 2.0 * REF_PI * (double)k / 100.0;
        run.theta_m_rad[k] = 0.004 * (double)k;
        run.speed_rad_per_s[k] = speed;
        run.torque_Nm[k] = 5.0 + varies * sqrt(2.0) * cos(x);
        rec_phases(0.7, 3.0 + 2.0 * sin(x), P * run.theta_m_rad[k], run.i_A + 3 * k);
    }
    return hci_is_slow_turn(&run, P, inertia, constant);
}

/* Less than a fifth of 0.1·√2 N·m accelerates, and J ω²/2 is less than a fifth of that torque (pole pairs).
 */
static void test_a_slow_turn_by_inertia(void)
{
    const double rms_Nm = 0.1 * sqrt(2.0), most_J = rms_Nm / P;
    TEST_ASSERT_TRUE(is_slow_turn(0.19 * rms_Nm, 3.0, 0.95 * most_J / 4.5, 0.1));
    TEST_ASSERT_FALSE(is_slow_turn(0.21 * rms_Nm, 3.0, 0.95 * most_J / 4.5, 0.1));
    TEST_ASSERT_FALSE(is_slow_turn(0.19 * rms_Nm, 3.0, 1.05 * most_J / 4.5, 0.1));
    TEST_ASSERT_FALSE(is_slow_turn(0.0, 0.0, 1e-3, 0.0));
    TEST_ASSERT_TRUE(is_slow_turn(0.0, 0.0, 1e-3, 0.1));
    free(run.theta_m_rad);
    run.theta_m_rad = NULL;
    TEST_ASSERT_FALSE(hci_is_slow_turn(&run, P, 1e-3, 0.1));
}

/* What accelerates is taken out of i_q; of less than a 200th of what it makes nothing is said. */
static void test_what_accelerates_is_taken_out(void)
{
    for (int more = 0; more < 2; ++more) {
        const double made_Nm = 0.1 * sqrt(2.0), share = more ? 0.0051 : 0.0049;
        is_slow_turn(0.0, 1.0, 1.0, 0.1);
        for (size_t k = 0; k < run.count; ++k)
            run.torque_Nm[k] = share * made_Nm * (k % 2 ? 1.0 : -1.0);
        hci_slow_turn_correct(&run, P, 0.1);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, share, run.inertia_share);
        for (size_t k = 0; k < run.count; ++k) {
            double d, q;
            rec_rotor(run.i_A + 3 * k, P * run.theta_m_rad[k], &d, &q);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.7, d);
            TEST_ASSERT_DOUBLE_WITHIN(
                1e-12, 3.0 + 2.0 * sin(2.0 * REF_PI * (double)k / 100.0) - run.torque_Nm[k] / 0.1, q);
        }
        if (more)
            text_has("inertia x acceleration, 0.000721 N·m rms, is taken out of the 0.141 N·m that i_q makes",
                     run.remark.text);
        else
            TEST_ASSERT_EQUAL_STRING("", run.remark.text);
    }
}

static void test_a_constant_is_taken_out(void)
{
    is_slow_turn(0.0, 1.0, 1.0, 0.1);
    hci_slow_turn_take_constant(&run, P, 0.6);
    for (size_t k = 0; k < run.count; ++k) {
        double d, q;
        rec_rotor(run.i_A + 3 * k, P * run.theta_m_rad[k], &d, &q);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.7, d);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.4 + 2.0 * sin(2.0 * REF_PI * (double)k / 100.0), q);
    }
}

/* ---- rows without time ---- */

/* So many rows that go up and down `reversals` times; the angle stays from one of them to the next. */
static bool gives_direction(size_t rows, size_t reversals)
{
    run.row = NULL;
    run.v_V = NULL;
    rec_release(&run);
    run = rec_make(rows);
    free(run.time_s);
    free(run.speed_rad_per_s);
    run.time_s = run.speed_rad_per_s = NULL;
    for (size_t k = 1; k < rows; ++k) {
        const size_t way = k * (reversals + 1) / rows;
        run.theta_m_rad[k] = run.theta_m_rad[k - 1] + (k == 3 ? 0.0 : way % 2 ? -0.01 : 0.01);
    }
    TEST_ASSERT_TRUE(hci_row_direction_set(&run));
    return run.speed_rad_per_s != NULL;
}

/* Rows of a torque sensor go forward and back, or one way with a few steps back, as a table does. */
static void test_the_way_of_rows_both_ways(void)
{
    static const struct {
        size_t back;
        bool has_way;
    } CASES[] = {{0, false}, {19, false}, {21, true}, {100, true}, {178, true}, {179, false}};
    for (size_t x = 0; x < sizeof CASES / sizeof *CASES; ++x) {
        rec_release(&run);
        run = rec_make(200);
        free(run.time_s);
        free(run.speed_rad_per_s);
        run.time_s = run.speed_rad_per_s = NULL;
        for (size_t k = 1; k < 200; ++k)
            run.theta_m_rad[k] = run.theta_m_rad[k - 1] + (k <= CASES[x].back ? -0.01 : 0.01);
        TEST_ASSERT_TRUE(hci_row_direction_of_both_set(&run));
        TEST_ASSERT_EQUAL(CASES[x].has_way, run.speed_rad_per_s != NULL);
    }
}

/* One row of twenty may turn back. */
static void test_the_way_of_rows(void)
{
    TEST_ASSERT_TRUE(gives_direction(100, 5));
    for (size_t k = 0; k < 100; ++k) { /* as the angle goes on to the next row, the last as the one before */
        const size_t next = k < 99 ? k + 1 : 99;
        TEST_ASSERT_EQUAL_DOUBLE(next * 6 / 100 % 2 ? -0.1 : 0.1, run.speed_rad_per_s[k]);
    }
    text_has("no time and no speed: the shaft turned slowly", run.remark.text);
    TEST_ASSERT_FALSE(gives_direction(100, 6));
    TEST_ASSERT_TRUE(gives_direction(16, 0));
    TEST_ASSERT_FALSE(gives_direction(15, 0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_wait_on_the_way);
    RUN_TEST(test_rests_at_the_ends_and_a_turning_point);
    RUN_TEST(test_no_wait);
    RUN_TEST(test_short_parts);
    RUN_TEST(test_how_long_a_wait_is);
    RUN_TEST(test_a_way_in_steps);
    RUN_TEST(test_a_small_way_back);
    RUN_TEST(test_what_has_no_way);
    RUN_TEST(test_rest_at_the_ends_is_left_out);
    RUN_TEST(test_enough_rows_are_left);
    RUN_TEST(test_a_slow_shaft);
    RUN_TEST(test_what_a_slow_shaft_needs);
    RUN_TEST(test_a_shaft_without_current);
    RUN_TEST(test_a_slow_turn_by_inertia);
    RUN_TEST(test_what_accelerates_is_taken_out);
    RUN_TEST(test_a_constant_is_taken_out);
    RUN_TEST(test_the_way_of_rows);
    RUN_TEST(test_the_way_of_rows_both_ways);
    return UNITY_END();
}
