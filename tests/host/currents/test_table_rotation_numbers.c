/* Every number of table_rotation.h against least squares over all samples at once, and where each rule
 * begins. */
#include <math.h>
#include <string.h>

#include "hci/host/currents/table_rotation.h"
#include "support/draws.h"
#include "support/least_squares.h"
#include "support/texts.h"
#include "unity.h"

enum { COUNT = 1501, PAIRS = 5, COLUMNS = 3 };

static double theta[COUNT], current[3 * COUNT];
static hci_wave wave[4];
static hci_currents table;
static hci_run run;
static hci_note note;

void setUp(void)
{
    wave[0] = hci_wave_polar(1.0, 1, 8.0, 0.1);
    wave[1] = hci_wave_polar(5.0, -1, 1.5, 0.7);
    wave[2] = hci_wave_polar(7.0, 1, 0.8, -2.0);
    wave[3] = hci_wave_polar(6.0 / 5.0, 1, 2.5, 1.1); /* of the mechanical turn */
    table = (hci_currents){.wave = wave, .count = 3};
    memset(&run, 0, sizeof run);
    run.name = "log";
    run.count = COUNT;
    run.theta_m_rad = theta;
    run.i_A = current;
    run.has_sum = true;
    memset(&note, 0, sizeof note);
    for (size_t k = 0; k < COUNT; ++k)
        theta[k] = 0.3 + 6.0 * REF_PI * (double)k / COUNT + 0.02 * sin(0.1 * (double)k);
}

void tearDown(void)
{
}

static void play(double ahead_rad, double gain, double noise_A, uint64_t seed)
{
    for (size_t k = 0; k < COUNT; ++k) {
        hci_waves_at(wave, table.count, PAIRS * theta[k] + ahead_rad, current + 3 * k);
        for (size_t s = 0; s < 3; ++s)
            current[3 * k + s] = gain * current[3 * k + s] + noise_A * ref_normal(&seed);
    }
}

/* Adds what is in no table: A of order 2. */
static void disturb(double amplitude_A)
{
    const hci_wave other = hci_wave_polar(2.0, -1, amplitude_A, 0.4);
    for (size_t k = 0; k < COUNT; ++k) {
        double x[3];
        hci_waves_at(&other, 1, PAIRS * theta[k], x);
        for (size_t s = 0; s < 3; ++s)
            current[3 * k + s] += x[s];
    }
}

static hci_table_rotation compare(void)
{
    hci_table_rotation x;
    memset(&x, 0, sizeof x);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_table_rotation_of(&table, &run, PAIRS, &x, &note), note.text);
    return x;
}

/* ---- least squares ---- */

/* Columns of a fit to sample 3k + s: value() of the table there, by which the rest is described. */
typedef void columns_at(double angle, double out[COLUMNS][3]);

typedef struct {
    double value[COLUMNS], error[COLUMNS]; /* of n samples two currents are free: Σ r²/(2n) */
    double left;                           /* rms of what is left, by rms of the currents */
} solution;

static solution solve(columns_at *at, int m, double ahead_rad)
{
    double a[COLUMNS][2 * COLUMNS + 1] = {{0.0}}, all = 0.0, rest = 0.0;
    solution x = {{0.0}, {0.0}, 0.0};
    for (size_t k = 0; k < COUNT; ++k) {
        double column[COLUMNS][3];
        at(PAIRS * theta[k] + ahead_rad, column);
        for (size_t s = 0; s < 3; ++s) {
            const double y = current[3 * k + s];
            all += y * y;
            for (int i = 0; i < m; ++i) {
                a[i][2 * m] += column[i][s] * y;
                for (int j = 0; j < m; ++j)
                    a[i][j] += column[i][s] * column[j][s];
            }
        }
    }
    for (int i = 0; i < m; ++i)
        x.value[i] = a[i][2 * m], a[i][m + i] = 1.0;
    ref_reduce(&a[0][0], m, 2 * m + 1, 2 * COLUMNS + 1);
    rest = all;
    for (int i = 0; i < m; ++i)
        rest -= x.value[i] * a[i][2 * m];
    for (int i = 0; i < m; ++i) {
        x.value[i] = a[i][2 * m];
        x.error[i] = sqrt(fmax(0.0, rest) / (2.0 * COUNT) * a[i][m + i]);
    }
    x.left = sqrt(fmax(0.0, rest) / all);
    return x;
}

static void table_alone(double angle, double out[COLUMNS][3])
{
    hci_waves_at(wave, table.count, angle, out[0]);
}

/* The table and its slope. */
static void table_and_slope(double angle, double out[COLUMNS][3])
{
    double before[3], after[3];
    table_alone(angle, out);
    hci_waves_at(wave, table.count, angle - 1e-4, before);
    hci_waves_at(wave, table.count, angle + 1e-4, after);
    for (int s = 0; s < 3; ++s)
        out[1][s] = (after[s] - before[s]) / 2e-4;
}

/* The fundamental, the same a quarter on, and all else. */
static void parts(double angle, double out[COLUMNS][3])
{
    hci_waves_at(wave, 1, angle, out[0]);
    hci_waves_at(wave, 1, angle + 0.5 * REF_PI, out[1]);
    hci_waves_at(wave + 1, table.count - 1, angle, out[2]);
}

/* The rotation that leaves least, near one. */
static double best_near(double at)
{
    double low = at - 0.1, high = at + 0.1;
    while (high - low > 1e-9) {
        const double third = (high - low) / 3.0;
        if (solve(table_alone, 1, low + third).left < solve(table_alone, 1, high - third).left)
            high -= third;
        else
            low += third;
    }
    return 0.5 * (low + high);
}

/* With noise of a quarter of the currents and more. */
static void test_all_numbers_of_a_fit(void)
{
    const double ahead[] = {0.35, -1.2, 2.9};
    for (size_t n = 0; n < 3; ++n) {
        play(ahead[n], 0.6, 1.3, 3 + n);
        const hci_table_rotation x = compare();
        const double best = best_near(ahead[n]);
        const solution alone = solve(table_alone, 1, best), both = solve(table_and_slope, 2, best),
                       part = solve(parts, 3, x.rotation_rad);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, best, x.rotation_rad);
        TEST_ASSERT_DOUBLE_WITHIN(1e-7, alone.value[0], x.gain);
        TEST_ASSERT_DOUBLE_WITHIN(1e-7, alone.left, x.left);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, both.error[1] / alone.value[0], x.error_rad);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, part.value[2], x.harmonics);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, part.error[2], x.harmonics_error);
        TEST_ASSERT_EQUAL_DOUBLE(1.0, x.left_elsewhere);
        TEST_ASSERT_EQUAL_UINT64(1, x.period_turns);
        TEST_ASSERT_EQUAL_UINT64(COUNT, x.samples);
        TEST_ASSERT_TRUE(x.is_found && x.is_rotated && x.is_seen && !x.backwards && !x.of_index);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, x.step_rad);
        TEST_ASSERT_EQUAL_UINT64(0, x.pole_pairs_seen);
    }
}

/* As it is: what no gain above 0 explains. */
static void test_what_differs_as_it_is(void)
{
    play(0.35, 0.6, 1.3, 3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, solve(table_alone, 1, 0.0).left, compare().left_as_is);
    play(2.9, 0.6, 1.3, 3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, compare().left_as_is);
}

/* In another electrical turn of a table of five the wave of the mechanical turn is another: the least over
 * these turns, on a part of the samples. */
static void test_what_another_turn_leaves(void)
{
    table.count = 4;
    play(0.25 + 4.0 * REF_PI, 0.8, 0.3, 2);
    const hci_table_rotation x = compare();
    double least = 2.0;
    for (int turn = 1; turn < 5; ++turn)
        for (int step = -16; step <= 16; ++step)
            least = fmin(least,
                         solve(table_alone, 1, x.rotation_rad + 2.0 * REF_PI * (turn + step / 512.0)).left);
    TEST_ASSERT_EQUAL_UINT64(5, x.period_turns);
    TEST_ASSERT_DOUBLE_WITHIN(1e-2, 0.25 + 4.0 * REF_PI, x.rotation_rad);
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * least, least, x.left_elsewhere);
}

/* ---- where rules begin ---- */

/* More than 95 % of the rms: E/√(E² + 8²). */
static void test_where_a_table_is_found(void)
{
    table.count = 1;
    for (int more = 0; more < 2; ++more) {
        const double left = more ? 0.96 : 0.94, other_A = 8.0 * left / sqrt(1.0 - left * left);
        play(2.0, 1.0, 0.0, 1);
        disturb(other_A);
        const hci_table_rotation x = compare();
        TEST_ASSERT_DOUBLE_WITHIN(5e-3, left, x.left);
        TEST_ASSERT_EQUAL(!more, x.is_found);
        TEST_ASSERT_EQUAL_UINT64(more ? 2 * PAIRS : 0, x.pole_pairs_seen); /* what disturbs is a sine, too */
        TEST_ASSERT_EQUAL(!more, x.is_rotated);
    }
}

/* A rotation by x leaves E of √(E² + (8 sin x)²): to lessen it by a twentieth, 8 sin x is 0.3287 E. */
static void test_what_mends_too_little_is_no_rotation(void)
{
    table.count = 1;
    for (int more = 0; more < 2; ++more) {
        play(more ? 0.30 : 0.25, 1.0, 0.0, 1);
        disturb(8.0 * sin(0.275) / 0.3287);
        const hci_table_rotation x = compare();
        TEST_ASSERT_EQUAL(more, x.is_rotated);
        if (more)
            TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.30, x.rotation_rad);
        else
            TEST_ASSERT_EQUAL_DOUBLE(0.0, x.rotation_rad);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, solve(table_alone, 1, x.rotation_rad).value[0], x.gain);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, solve(table_alone, 1, x.rotation_rad).left, x.left);
    }
}

static void test_a_hundredth_of_a_radian_is_a_rotation(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        play(sign * 0.0103, 1.0, 0.0, 1);
        TEST_ASSERT_TRUE(compare().is_rotated);
        play(sign * 0.0097, 1.0, 0.0, 1);
        TEST_ASSERT_FALSE(compare().is_rotated);
    }
}

/* Harmonics of three tenths of the gain. */
static void test_where_harmonics_are_seen(void)
{
    for (int more = 0; more < 2; ++more) {
        const double share = more ? 0.33 : 0.27;
        for (size_t k = 0; k < COUNT; ++k) {
            double first[3], rest[3];
            hci_waves_at(wave, 1, PAIRS * theta[k], first);
            hci_waves_at(wave + 1, 2, PAIRS * theta[k], rest);
            for (size_t s = 0; s < 3; ++s)
                current[3 * k + s] = first[s] + share * rest[s];
        }
        const hci_table_rotation x = compare();
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, share, x.harmonics);
        TEST_ASSERT_EQUAL(more, x.is_seen);
    }
}

/* Harmonics of a thousandth of the table are none. */
static void test_a_table_without_harmonics(void)
{
    table.count = 2;
    for (int more = 0; more < 2; ++more) {
        wave[1] = hci_wave_polar(5.0, -1, 8.0 * (more ? 1.1e-3 : 0.9e-3), 0.7);
        play(0.3, 0.7, 0.5, 8);
        const hci_table_rotation x = compare();
        TEST_ASSERT_EQUAL(!more, x.is_seen);
        TEST_ASSERT_EQUAL(more, x.harmonics_error > 0.0);
    }
}

/* An angle that stands still from one sample to the next at a fifth of the samples is coarse: its mean step.
 */
static void test_how_often_a_coarse_angle_stands(void)
{
    for (size_t each = 4; each <= 6; each += 2) {
        for (size_t k = 0; k < COUNT; ++k)
            theta[k] = 0.01 * (double)(k - (k + each - 1) / each);
        play(0.0, 1.0, 0.0, 1);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, each == 4 ? 0.01 * PAIRS : 0.0, compare().step_rad);
    }
}

/* The first number of electrical turns of which all orders are whole. */
static void test_turns_of_a_table(void)
{
    static const struct {
        double order;
        size_t turns;
    } CASES[] = {{3.0, 1}, {1.5, 2}, {7.0 / 6.0, 6}};
    for (size_t c = 0; c < sizeof CASES / sizeof *CASES; ++c) {
        table.count = 2;
        wave[1] = hci_wave_polar(CASES[c].order, 1, 1.0, 0.3);
        run.count = 200;
        play(0.0, 1.0, 0.0, 1);
        TEST_ASSERT_EQUAL_UINT64(CASES[c].turns, compare().period_turns);
    }
}

static void is_refused(const char *words)
{
    hci_table_rotation x;
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_table_rotation_of(&table, &run, PAIRS, &x, &note));
    text_has(words, note.text);
}

static void test_what_cannot_be_compared(void)
{
    play(0.3, 1.0, 0.0, 1);
    run.zero_is_unknown = true;
    is_refused("log: found no angle from a known zero, expected theta_m_rad or theta_e_rad");
    run.zero_is_unknown = false;
    run.only_mean = true;
    is_refused("log: found no angle");
    run.only_mean = false;
    table.count = 0;
    is_refused("the table has no currents");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_all_numbers_of_a_fit);
    RUN_TEST(test_what_differs_as_it_is);
    RUN_TEST(test_what_another_turn_leaves);
    RUN_TEST(test_where_a_table_is_found);
    RUN_TEST(test_what_mends_too_little_is_no_rotation);
    RUN_TEST(test_a_hundredth_of_a_radian_is_a_rotation);
    RUN_TEST(test_where_harmonics_are_seen);
    RUN_TEST(test_a_table_without_harmonics);
    RUN_TEST(test_how_often_a_coarse_angle_stands);
    RUN_TEST(test_turns_of_a_table);
    RUN_TEST(test_what_cannot_be_compared);
    return UNITY_END();
}
