/* What a measured response says of the drive: as it is declared, or one change that explains it; responses
 * are made of the loop itself. */
#include "host/drive/response_reading.c"

#include <string.h>

#include "unity.h"

enum { POINTS = 12 };

static const hci_loop_model LOOP = {.resistance_ohm = 0.2,
                                    .inductance_H = {1e-3, 1.5e-3},
                                    .kp_ohm = {1.2, 1.8},
                                    .ki_ohm_per_s = {240.0, 240.0},
                                    .sample_s = 1e-4,
                                    .delay_s = 1e-4};
static hci_loop_point point[POINTS];
static hci_drive_data drive;
static hci_drive_facts facts;
static char text[HCI_RESPONSE_TEXT_SIZE];

void setUp(void)
{
    memset(&drive, 0, sizeof drive);
    memset(&facts, 0, sizeof facts);
    drive.sample_s = 1e-4;
    drive.response = point;
    drive.response_count = POINTS;
    drive.response_of = HCI_RESPONSE_OF_SAMPLES;
}

void tearDown(void)
{
}

/* Points from 20 Hz to 2 kHz of a loop: of its samples, or of the current that flows. */
static void measure(const hci_loop_model *m, hci_response_of of)
{
    for (int k = 0; k < POINTS; ++k) {
        point[k].frequency_Hz = 20.0 * pow(100.0, k / (POINTS - 1.0));
        const hci_loop_answer a = hci_loop_answer_at(m, 2.0 * HCI_PI * point[k].frequency_Hz);
        for (int axis = 0; axis < 2; ++axis) {
            const double complex g =
                (of == HCI_RESPONSE_OF_SAMPLES ? &a.sampled : &a.reference)->m[axis][axis];
            point[k].gain[axis] = cabs(g);
            point[k].phase_rad[axis] = carg(g);
        }
    }
}

static void scale(double frequency, double gain, double turn_rad)
{
    for (int k = 0; k < POINTS; ++k) {
        point[k].frequency_Hz *= frequency;
        for (int axis = 0; axis < 2; ++axis) {
            point[k].gain[axis] *= gain;
            point[k].phase_rad[axis] += turn_rad;
        }
    }
}

static void is_read_as(hci_response_reading reading, double value)
{
    hci_response_compare(&drive, &LOOP, &facts);
    TEST_ASSERT_EQUAL_STRING(NAMES[reading], NAMES[facts.reading]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.0, facts.reading_off);
    TEST_ASSERT_EQUAL(isnan(value), isnan(facts.reading_value));
    if (!isnan(value)) TEST_ASSERT_DOUBLE_WITHIN(1e-9 * value, value, facts.reading_value);
    TEST_ASSERT_EQUAL_UINT64(POINTS, facts.response_count);
}

static void test_one_change_at_a_time(void)
{
    hci_loop_model other = LOOP;
    measure(&LOOP, HCI_RESPONSE_OF_CURRENT);
    is_read_as(HCI_RESPONSE_OTHER_CURRENT, (double)NAN);
    drive.response_of = HCI_RESPONSE_OF_CURRENT;
    measure(&LOOP, HCI_RESPONSE_OF_SAMPLES);
    is_read_as(HCI_RESPONSE_OTHER_CURRENT, (double)NAN);
    drive.response_of = HCI_RESPONSE_OF_SAMPLES;
    for (size_t k = 0; k < sizeof UNITS / sizeof *UNITS; ++k) {
        measure(&LOOP, HCI_RESPONSE_OF_SAMPLES);
        scale(UNITS[k].in_a_Hz, 1.0, 0.0);
        is_read_as(HCI_RESPONSE_FREQUENCY, 1.0 / UNITS[k].in_a_Hz);
    }
    measure(&LOOP, HCI_RESPONSE_OF_SAMPLES);
    scale(1.0, sqrt(2.0), 0.0);
    is_read_as(HCI_RESPONSE_SCALE, sqrt(0.5));
    scale(1.0, 100.0 * sqrt(0.5), 0.0);
    is_read_as(HCI_RESPONSE_SCALE, 0.01);
    measure(&LOOP, HCI_RESPONSE_OF_SAMPLES);
    scale(1.0, 1.0, HCI_PI);
    is_read_as(HCI_RESPONSE_HALF_TURN, (double)NAN);
    other = hci_loop_with_gains(LOOP, pow(2.0, 18.0 / 24.0));
    measure(&other, HCI_RESPONSE_OF_SAMPLES);
    is_read_as(HCI_RESPONSE_GAINS, pow(2.0, 18.0 / 24.0));
    other = hci_loop_with_gains(LOOP, 0.25);
    measure(&other, HCI_RESPONSE_OF_SAMPLES);
    is_read_as(HCI_RESPONSE_GAINS, 0.25);
    other = LOOP;
    other.delay_s = 0.0;
    measure(&other, HCI_RESPONSE_OF_SAMPLES);
    is_read_as(HCI_RESPONSE_DELAY, 0.0);
}

/* As it is declared: within a fifth, and no nearer to the other current. */
static void test_as_it_is_declared(void)
{
    for (int more = 0; more < 2; ++more) {
        measure(&LOOP, HCI_RESPONSE_OF_SAMPLES);
        point[5].gain[1] *= more ? 1.201 : 1.199;
        hci_response_compare(&drive, &LOOP, &facts);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, more ? 0.201 : 0.199, facts.response_off);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, point[5].frequency_Hz, facts.response_off_Hz);
        TEST_ASSERT_EQUAL_INT(more ? HCI_RESPONSE_UNKNOWN : HCI_RESPONSE_AS_DECLARED, facts.reading);
        TEST_ASSERT_EQUAL_DOUBLE(facts.response_off, facts.reading_off);
        TEST_ASSERT_TRUE(isnan(facts.reading_value));
    }
}

/* Frequencies that the sampling does not do for are not looked at; of those alone nothing is near. */
static void test_frequencies_beyond_the_sampling(void)
{
    measure(&LOOP, HCI_RESPONSE_OF_SAMPLES);
    point[POINTS - 1].frequency_Hz = 4001.0;
    point[POINTS - 1].gain[0] = 7.0;
    hci_response_compare(&drive, &LOOP, &facts);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, facts.response_off);
    point[POINTS - 1].frequency_Hz = 3999.0;
    hci_response_compare(&drive, &LOOP, &facts);
    TEST_ASSERT_TRUE(facts.response_off > 1.0);
    drive.response = point + POINTS - 1;
    drive.response_count = 1;
    point[POINTS - 1].frequency_Hz = 4001.0;
    hci_response_compare(&drive, &LOOP, &facts);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, facts.response_off);
    drive.response_count = 0;
    hci_response_compare(&drive, &LOOP, &facts);
    TEST_ASSERT_TRUE(isnan(facts.response_off) && isnan(facts.reading_off));
}

/* A reading that leaves no more than a tenth, or than a quarter of what it mends, is one: a point that is x
 * off is off by 2 + x half a turn on, of which x is a quarter at 2/3. */
static void test_what_leaves_too_much(void)
{
    static const struct {
        double more;
        bool is_one;
    } CASE[] = {{1.099, true}, {1.101, true}, {1.66, true}, {1.68, false}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        measure(&LOOP, HCI_RESPONSE_OF_SAMPLES);
        point[4].gain[0] *= CASE[k].more;
        scale(1.0, 1.0, HCI_PI);
        hci_response_compare(&drive, &LOOP, &facts);
        TEST_ASSERT_EQUAL_INT(CASE[k].is_one ? HCI_RESPONSE_HALF_TURN : HCI_RESPONSE_UNKNOWN, facts.reading);
    }
}

/* Gains that are √(3/2) times as large but for one point, which is x more, more than a quarter of all that is
 * off: of a tenth at most. */
static void test_a_tenth_may_be_left(void)
{
    for (int more = 0; more < 2; ++more) {
        measure(&LOOP, HCI_RESPONSE_OF_SAMPLES);
        scale(1.0, sqrt(1.5), 0.0);
        point[4].gain[0] *= more ? 1.101 : 1.099;
        hci_response_compare(&drive, &LOOP, &facts);
        TEST_ASSERT_EQUAL_INT(more ? HCI_RESPONSE_UNKNOWN : HCI_RESPONSE_SCALE, facts.reading);
    }
}

/* ---- words ---- */

static const char *words(hci_response_reading reading, double value)
{
    facts.reading = reading;
    facts.reading_value = value;
    facts.reading_off = 0.0123;
    hci_response_reading_text(&facts, text);
    return text;
}

static void ends_with(const char *end, const char *whole)
{
    TEST_ASSERT_TRUE(strlen(whole) > strlen(end));
    TEST_ASSERT_EQUAL_STRING(end, whole + strlen(whole) - strlen(end));
}

static void test_words(void)
{
    TEST_ASSERT_EQUAL_STRING("as declared", words(HCI_RESPONSE_AS_DECLARED, (double)NAN));
    TEST_ASSERT_EQUAL_STRING("no other gains, delay or units explain it",
                             words(HCI_RESPONSE_UNKNOWN, (double)NAN));
    TEST_ASSERT_EQUAL_STRING("k_p and k_i of the drive are others: 0.25 times as large; then 1.23 % are left",
                             words(HCI_RESPONSE_GAINS, 0.25));
    TEST_ASSERT_EQUAL_STRING("computing_delay is another: 37.5 us; then 1.23 % are left",
                             words(HCI_RESPONSE_DELAY, 3.75e-5));
    ends_with(" by 1.225; then 1.23 % are left", words(HCI_RESPONSE_SCALE, sqrt(1.5)));
    ends_with(" by 1000, as of kHz; then 1.23 % are left", words(HCI_RESPONSE_FREQUENCY, 1000.0));
    ends_with("; then 1.23 % are left", words(HCI_RESPONSE_HALF_TURN, (double)NAN));
    TEST_ASSERT_NULL(strstr(text, "nan"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_one_change_at_a_time);
    RUN_TEST(test_as_it_is_declared);
    RUN_TEST(test_frequencies_beyond_the_sampling);
    RUN_TEST(test_what_leaves_too_much);
    RUN_TEST(test_a_tenth_may_be_left);
    RUN_TEST(test_words);
    return UNITY_END();
}
