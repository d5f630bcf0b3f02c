/* By how much a table is rotated, from recordings that are made of it: any rotation, share, noise and
 * direction; tables of several electrical turns. */
#include <math.h>
#include <string.h>

#include "hci/host/currents/table_rotation.h"
#include "hci/machine/frames.h"
#include "support/reference.h"
#include "unity.h"

enum { COUNT = 4000, PAIRS = 7 };

static double theta[COUNT], current[3 * COUNT];
static hci_wave wave[4];
static hci_currents table;
static hci_run run;
static hci_note note;

void setUp(void)
{
    wave[0] = hci_wave_polar(1.0, 1, 8.0, 0.1);
    wave[1] = hci_wave_polar(5.0, -1, 1.0, 0.7);
    wave[2] = hci_wave_polar(7.0, 1, 0.8, -2.0);
    wave[3] = hci_wave_polar(9.0 / 7.0, 1, 0.5, 1.1); /* of the mechanical turn */
    table = (hci_currents){.wave = wave, .count = 3};
    memset(&run, 0, sizeof run);
    run.name = "log";
    run.count = COUNT;
    run.theta_m_rad = theta;
    run.i_A = current;
    note.text[0] = '\0';
}
void tearDown(void)
{
}

/* Plays the table `ahead` of the log's angle, over three turns of the shaft. */
static void play(double ahead_rad, double gain, double noise_A, int direction, uint64_t seed)
{
    for (size_t k = 0; k < COUNT; ++k) {
        theta[k] = 6.0 * REF_PI * (double)k / COUNT;
        hci_waves_at(wave, table.count, direction * PAIRS * theta[k] + ahead_rad, current + 3 * k);
        for (int s = 0; s < 3; ++s)
            current[3 * k + (size_t)s] = gain * current[3 * k + (size_t)s] + noise_A * ref_normal(&seed);
    }
}

static hci_table_rotation compare(void)
{
    hci_table_rotation x;
    memset(&x, 0, sizeof x);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_table_rotation_of(&table, &run, PAIRS, &x, &note), note.text);
    return x;
}

static void test_any_rotation(void)
{
    uint64_t seed = 1;
    for (int k = 0; k < 12; ++k) {
        const double ahead = ref_uniform(&seed, -REF_PI, REF_PI), gain = ref_uniform(&seed, 0.1, 2.0);
        play(ahead, gain, 0.0, 1, 1);
        const hci_table_rotation x = compare();
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, ahead, x.rotation_rad);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, gain, x.gain);
        TEST_ASSERT_TRUE(x.is_rotated == (fabs(ahead) > 0.01) && !x.backwards);
        TEST_ASSERT_TRUE(x.left < 1e-5 && x.left <= x.left_as_is);
    }
    play(0.0, 1.0, 0.0, 1, 1);
    TEST_ASSERT_FALSE(compare().is_rotated);
}

/* Errors of the rotation by those that are stated. */
static void test_the_error_is_that_of_the_noise(void)
{
    double sum = 0.0;
    enum { TIMES = 40 };
    for (uint64_t k = 0; k < TIMES; ++k) {
        play(0.3, 1.0, 2.0, 1, 100 + k);
        const hci_table_rotation x = compare();
        sum += pow((x.rotation_rad - 0.3) / x.error_rad, 2.0);
        TEST_ASSERT_TRUE(x.is_rotated);
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.7, 1.0, sum / TIMES); /* 40 squares have a deviation of 0.22 */
    TEST_ASSERT_TRUE(sum / TIMES > 0.3);
}

static void test_backwards(void)
{
    play(0.5, 1.0, 0.1, -1, 3);
    const hci_table_rotation x = compare();
    TEST_ASSERT_TRUE(x.backwards && x.is_rotated);
    TEST_ASSERT_DOUBLE_WITHIN(1e-2, 0.5, x.rotation_rad);
}

/* A drive that commutates by itself: i_d and i_q of the table at another place, in the frame of the angle. */
static void play_index(double ahead_rad, double noise_A)
{
    uint64_t seed = 11;
    for (size_t k = 0; k < COUNT; ++k) {
        double phases[3];
        theta[k] = 6.0 * REF_PI * (double)k / COUNT;
        hci_waves_at(wave, table.count, PAIRS * theta[k] + ahead_rad, phases);
        const hci_dq in = hci_park(hci_clarke(phases), PAIRS * theta[k] + ahead_rad);
        hci_clarke_inverse(hci_park_inverse(in, PAIRS * theta[k]), current + 3 * k);
        for (int s = 0; s < 3; ++s)
            current[3 * k + (size_t)s] += noise_A * ref_normal(&seed);
    }
}

static void test_the_index_of_a_table_in_the_frame(void)
{
    for (int with_turns = 0; with_turns < 2; ++with_turns) {
        table.count = with_turns ? 4 : 3;
        for (int has_phases = 0; has_phases < 2 - with_turns; ++has_phases) {
            run.has_sum = has_phases == 1;
            play_index(0.17, 0.05);
            hci_table_rotation x = compare();
            TEST_ASSERT_TRUE(x.of_index && x.is_rotated && x.is_found && !x.backwards);
            TEST_ASSERT_DOUBLE_WITHIN(3e-3, 0.17, x.rotation_rad);
            TEST_ASSERT_TRUE(x.left < 0.02 && x.left_as_is > 0.03);
            play_index(0.0, 0.05);
            TEST_ASSERT_FALSE(compare().is_rotated);
            play(0.17, 1.0, 0.05, 1, 1); /* as a whole */
            x = compare();
            TEST_ASSERT_TRUE(x.is_rotated && !x.of_index);
        }
    }
}

/* i_d and i_q repeat six times in a turn: of places that are as good the nearest is said. */
static void test_the_nearest_of_six_places(void)
{
    for (int k = -4; k <= 4; ++k) {
        const double ahead = 0.12 * k;
        play_index(ahead, 0.05);
        const hci_table_rotation x = compare();
        TEST_ASSERT_TRUE(x.is_rotated == (k != 0));
        TEST_ASSERT_DOUBLE_WITHIN(3e-3, ahead, x.rotation_rad);
    }
}

/* A table whose currents are all 0 is in no recording, and no share of it either. */
static void test_a_table_of_nothing_is_not_found(void)
{
    hci_wave nothing = hci_wave_polar(1.0, 1, 0.0, 0.0);
    table = (hci_currents){.wave = wave, .count = 3};
    play(0.0, 1.0, 0.0, 1, 1);
    table = (hci_currents){.wave = &nothing, .count = 1};
    const hci_table_rotation x = compare();
    TEST_ASSERT_FALSE(x.is_found || x.is_rotated);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, x.gain);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, x.left);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, x.left_as_is);
}

/* A difference that no rotation lessens is none that a rotation mends. */
static void test_what_mends_nothing_is_no_rotation(void)
{
    table.count = 4;
    play(0.0, 1.0, 0.0, 1, 1);
    for (size_t k = 0; k < COUNT; ++k) /* what follows the mechanical turn is not in the currents */
        hci_waves_at(wave, 3, PAIRS * theta[k], current + 3 * k);
    const hci_table_rotation x = compare();
    TEST_ASSERT_FALSE(x.is_rotated);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, x.rotation_rad);
}

/* A half order of the shaft tells the seven turns apart. */
static void test_which_of_the_turns(void)
{
    table.count = 4;
    for (int turn = -3; turn <= 3; ++turn) {
        const double ahead = 0.2 + 2.0 * REF_PI * turn;
        play(ahead, 0.7, 0.05, 1, 5);
        const hci_table_rotation x = compare();
        TEST_ASSERT_EQUAL_UINT(7, (unsigned)x.period_turns);
        TEST_ASSERT_DOUBLE_WITHIN(1e-2, ahead, x.rotation_rad);
        TEST_ASSERT_TRUE(x.left_elsewhere > 3.0 * x.left);
    }
}

/* Of a table that is read with other pole pairs nothing is left at any rotation; what was played is named. */
/* The fundamental alone is that of any drive: nothing says that the table is read. */
static void test_a_sine_is_no_table(void)
{
    play(0.0, 0.5, 0.1, 1, 9);
    TEST_ASSERT_TRUE(compare().is_seen);
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 0.5, compare().harmonics);
    play(0.4, 0.5, 0.1, 1, 9);
    TEST_ASSERT_TRUE(compare().is_seen);
    table.count = 1; /* plays the first wave */
    play(0.0, 0.5, 0.1, 1, 9);
    TEST_ASSERT_TRUE(compare().is_seen); /* of a table that has no other */
    table.count = 3;
    const hci_table_rotation x = compare();
    TEST_ASSERT_TRUE(x.is_found && !x.is_rotated && !x.is_seen);
    TEST_ASSERT_DOUBLE_WITHIN(5.0 * x.harmonics_error, 0.0, x.harmonics);
}

static void test_other_pole_pairs(void)
{
    static const size_t pairs[] = {1, 5, 14, 21};
    for (size_t n = 0; n < sizeof pairs / sizeof *pairs; ++n) {
        for (size_t k = 0; k < COUNT; ++k) {
            theta[k] = 6.0 * REF_PI * (double)k / COUNT;
            hci_waves_at(wave, table.count, (double)pairs[n] * theta[k] + 0.4, current + 3 * k);
        }
        const hci_table_rotation x = compare();
        TEST_ASSERT_FALSE(x.is_found);
        TEST_ASSERT_FALSE(x.is_rotated);
        TEST_ASSERT_EQUAL_UINT((unsigned)pairs[n], (unsigned)x.pole_pairs_seen);
    }
}

static void test_noise_is_no_table(void)
{
    uint64_t seed = 9;
    play(0.0, 0.0, 0.0, 1, 1);
    for (size_t k = 0; k < 3 * COUNT; ++k)
        current[k] = ref_normal(&seed);
    const hci_table_rotation x = compare();
    TEST_ASSERT_FALSE(x.is_found);
    TEST_ASSERT_EQUAL_UINT(0, (unsigned)x.pole_pairs_seen);
}

/* An encoder that rounds down: half of its step is part of what is found, and not called a rotation. */
static void test_a_coarse_angle(void)
{
    const double step = 2.0 * REF_PI / (24.0 * PAIRS);
    for (int far = 0; far < 2; ++far) {
        play(far ? 0.4 : 0.0, 1.0, 0.0, 1, 1);
        for (size_t k = 0; k < COUNT; ++k)
            theta[k] = step * floor(theta[k] / step);
        const hci_table_rotation x = compare();
        TEST_ASSERT_TRUE(x.is_found && !x.backwards);
        TEST_ASSERT_TRUE(x.is_rotated == (far == 1));
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, step * PAIRS, x.step_rad);
        TEST_ASSERT_DOUBLE_WITHIN(0.55 * x.step_rad, far ? 0.4 : 0.0, x.rotation_rad);
    }
    play(0.0, 1.0, 0.0, 1, 1);
    TEST_ASSERT_TRUE(compare().step_rad == 0.0);
}

/* Currents of a small motor are no smaller for that. */
static void test_small_currents(void)
{
    play(0.3, 1e-4, 0.0, 1, 1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.3, compare().rotation_rad);
}

static void test_what_cannot_be_compared(void)
{
    hci_table_rotation x;
    play(0.0, 0.0, 0.0, 1, 1);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_table_rotation_of(&table, &run, PAIRS, &x, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "log: found no current"));
    note.text[0] = '\0';
    run.theta_m_rad = NULL;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_table_rotation_of(&table, &run, PAIRS, &x, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "log: found no angle"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_any_rotation);
    RUN_TEST(test_the_error_is_that_of_the_noise);
    RUN_TEST(test_backwards);
    RUN_TEST(test_the_index_of_a_table_in_the_frame);
    RUN_TEST(test_the_nearest_of_six_places);
    RUN_TEST(test_a_table_of_nothing_is_not_found);
    RUN_TEST(test_what_mends_nothing_is_no_rotation);
    RUN_TEST(test_which_of_the_turns);
    RUN_TEST(test_a_sine_is_no_table);
    RUN_TEST(test_other_pole_pairs);
    RUN_TEST(test_noise_is_no_table);
    RUN_TEST(test_a_coarse_angle);
    RUN_TEST(test_small_currents);
    RUN_TEST(test_what_cannot_be_compared);
    return UNITY_END();
}
