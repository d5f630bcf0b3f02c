/* Whether a recording holds the currents of a solution and the ripple that was promised of them, from
 * recordings that are made of them: turned, resized, without their harmonics; torques of known ripple. */
#include "hci/host/currents/played.h"

#include <math.h>
#include <string.h>

#include "support/reference.h"
#include "unity.h"

enum { COUNT = 6000, PAIRS = 4 };

static double theta[COUNT], current[3 * COUNT], torque[COUNT];
static hci_wave wave[3];
static hci_solved_currents solved;
static hci_run run;
static const hci_effects *effects;

void setUp(void)
{
    wave[0] = hci_wave_polar(1.0, 1, 8.0, 0.1);
    wave[1] = hci_wave_polar(5.0, -1, 0.4, 0.7);
    wave[2] = hci_wave_polar(7.0, 1, 0.3, -2.0);
    memset(&solved, 0, sizeof solved);
    memset(&run, 0, sizeof run);
    strcpy(solved.folder, "currents");
    strcpy(solved.machine, "machine");
    solved.table = (hci_currents){.wave = wave, .count = 3};
    solved.promised_Nm = 0.05;
    effects = NULL;
    run = (hci_run){.name = "log",
                    .count = COUNT,
                    .theta_m_rad = theta,
                    .i_A = current,
                    .torque_Nm = torque,
                    .torque_source = HCI_TORQUE_MEASURED,
                    .turn_known = true};
}
void tearDown(void)
{
}

/* Six turns in as many samples as the run has; a ripple of 2·amplitude at the sixth electrical order. */
static void record(double ahead_rad, double gain, size_t waves, double amplitude_Nm, double noise_Nm)
{
    uint64_t seed = 5;
    for (size_t k = 0; k < run.count; ++k) {
        theta[k] = 12.0 * REF_PI * (double)k / (double)run.count;
        hci_waves_at(wave, waves, PAIRS * theta[k] + ahead_rad, current + 3 * k);
        for (int s = 0; s < 3; ++s)
            current[3 * k + (size_t)s] = gain * current[3 * k + (size_t)s] + 0.02 * ref_normal(&seed);
        torque[k] = 1.5 + amplitude_Nm * sin(6.0 * PAIRS * theta[k] + 0.3) + noise_Nm * ref_normal(&seed);
    }
}

static hci_played judge(void)
{
    hci_played p;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_played_judge(&solved, &run, PAIRS, effects, &p, &note), note.text);
    return p;
}

static void says(const hci_played *p, const char *expected, bool wanted)
{
    char words[1024];
    hci_played_words(&solved, p, "log.csv", words, sizeof words);
    TEST_ASSERT_MESSAGE((strstr(words, expected) != NULL) == wanted, words);
}

static void test_ripples(void)
{
    static const struct {
        double amplitude_Nm, noise_Nm;
        hci_promise promise;
    } CASE[] = {{0.01, 0.002, HCI_PROMISE_KEPT},
                {0.04, 0.002, HCI_PROMISE_NOT_KEPT},
                {0.01, 0.2, HCI_PROMISE_NOT_TOLD},
                {0.0, 0.002, HCI_PROMISE_KEPT}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        record(0.0, 1.0, 3, CASE[k].amplitude_Nm, CASE[k].noise_Nm);
        const hci_played p = judge();
        TEST_ASSERT_EQUAL_INT(HCI_PLAYED_AS_SOLVED, p.currents);
        TEST_ASSERT_EQUAL_INT(CASE[k].promise, p.promise);
        TEST_ASSERT_DOUBLE_WITHIN(3.0 * p.ripple_error_Nm, 2.0 * CASE[k].amplitude_Nm, p.ripple_Nm);
        TEST_ASSERT_EQUAL_DOUBLE(60.0, p.ripple_order);
        TEST_ASSERT_EQUAL_INT(CASE[k].promise == HCI_PROMISE_NOT_KEPT, hci_played_is_bad(&p));
        says(&p, "the promise was kept", CASE[k].promise == HCI_PROMISE_KEPT);
    }
}

/* Whatever folder it is; of no folder nothing is judged. */
static void test_names_of_the_folder(void)
{
    record(0.0, 1.0, 3, 0.01, 0.002);
    strcpy(solved.folder, "x");
    hci_played p = judge();
    TEST_ASSERT_EQUAL_INT(HCI_PLAYED_AS_SOLVED, p.currents);
    TEST_ASSERT_EQUAL_INT(HCI_PROMISE_KEPT, p.promise);
    strcpy(solved.folder, "");
    p = judge();
    TEST_ASSERT_EQUAL_INT(HCI_PROMISE_NOT_JUDGED, p.promise);
    TEST_ASSERT_TRUE(isnan(p.ripple_Nm));
}

/* However smooth the torque is: the promise is of other currents. */
static void test_other_currents(void)
{
    static const struct {
        double ahead_rad, gain;
        size_t waves;
        hci_played_currents currents;
    } CASE[] = {{0.3, 1.0, 3, HCI_PLAYED_TURNED},    {-0.05, 1.0, 3, HCI_PLAYED_TURNED},
                {REF_PI, 1.0, 3, HCI_PLAYED_TURNED}, {0.0, 0.8, 3, HCI_PLAYED_RESIZED},
                {0.0, 1.2, 3, HCI_PLAYED_RESIZED},   {0.0, 1.0, 1, HCI_PLAYED_OTHERS},
                {0.3, 1.0, 1, HCI_PLAYED_OTHERS},    {0.0, 0.0, 3, HCI_PLAYED_OTHERS},
                {0.0, 1.0, 2, HCI_PLAYED_OTHERS}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        record(CASE[k].ahead_rad, CASE[k].gain, CASE[k].waves, 0.01, 0.002);
        const hci_played p = judge();
        TEST_ASSERT_EQUAL_INT(CASE[k].currents, p.currents);
        TEST_ASSERT_EQUAL_INT(HCI_PROMISE_NOT_JUDGED, p.promise);
        TEST_ASSERT_EQUAL_INT(CASE[k].currents == HCI_PLAYED_TURNED, hci_played_is_bad(&p));
        TEST_ASSERT_DOUBLE_WITHIN(3.0 * p.ripple_error_Nm, 0.02, p.ripple_Nm);
        says(&p, "kept", false);
        says(&p, "hci-solve check machine log.csv --table currents", true);
    }
}

static void test_not_known(void)
{
    record(0.0, 1.0, 3, 0.01, 0.002);
    solved.promised_Nm = (double)NAN;
    hci_played p = judge();
    TEST_ASSERT_EQUAL_INT(HCI_PROMISE_NOT_JUDGED, p.promise);
    says(&p, "no bound on it was promised", true);
    solved.promised_Nm = 0.05;
    run.torque_source = HCI_TORQUE_HOLDING; /* the current is the reading */
    p = judge();
    TEST_ASSERT_TRUE(isnan(p.ripple_Nm));
    TEST_ASSERT_EQUAL_INT(HCI_PROMISE_NOT_JUDGED, p.promise);
    run.zero_is_unknown = true;
    p = judge();
    TEST_ASSERT_EQUAL_INT(HCI_PLAYED_UNKNOWN, p.currents);
    says(&p, "for want of an angle with a known zero", true);
    solved.folder[0] = '\0';
    p = judge();
    TEST_ASSERT_EQUAL_INT(HCI_PLAYED_UNKNOWN, p.currents);
}

/* Of less than half a turn no ripple is told; of electrical turns alone it is. */
static void test_turns(void)
{
    record(0.0, 1.0, 3, 0.01, 0.002);
    run.turn_known = false;
    TEST_ASSERT_EQUAL_INT(HCI_PROMISE_KEPT, judge().promise);
    run.turn_known = true;
    run.count = COUNT / 15;
    TEST_ASSERT_EQUAL_INT(HCI_PROMISE_NOT_JUDGED, judge().promise);
}

/* Of few samples in a turn, up to eight tenths of half of them, the twelfth electrical order has to be told.
 */
static void test_the_least_order(void)
{
    run.count = 6 * 122;
    record(0.0, 1.0, 3, 0.01, 0.002);
    const hci_played p = judge();
    TEST_ASSERT_EQUAL_DOUBLE(12.0, p.ripple_order);
    TEST_ASSERT_EQUAL_INT(HCI_PROMISE_KEPT, p.promise);
    run.count = 6 * 118;
    record(0.0, 1.0, 3, 0.01, 0.002);
    TEST_ASSERT_EQUAL_INT(HCI_PROMISE_NOT_JUDGED, judge().promise);
}

/* A sine beside the table that is another one in each direction: three turns there and three back. */
static void add_load(double forward_A, double back_A)
{
    static double speed[COUNT];
    run.speed_rad_per_s = speed;
    for (size_t k = 0; k < run.count; ++k) {
        const bool back = k >= run.count / 2;
        double load[3];
        const hci_wave sine = hci_wave_polar(1.0, 1, back ? back_A : forward_A, 0.4);
        speed[k] = back ? -3.0 : 3.0;
        hci_waves_at(&sine, 1, PAIRS * theta[k], load);
        for (size_t s = 0; s < 3; ++s)
            current[3 * k + s] += load[s];
    }
}

static void test_a_load_beside_the_table(void)
{
    static const double LOAD_A[][2] = {{2.0, -2.0}, {3.0, 3.0}, {6.0, 1.0}, {-5.0, -6.0}};
    for (size_t k = 0; k < sizeof LOAD_A / sizeof *LOAD_A; ++k) {
        record(0.0, 1.0, 3, 0.01, 0.002);
        add_load(LOAD_A[k][0], LOAD_A[k][1]);
        const hci_played p = judge();
        TEST_ASSERT_EQUAL_INT(HCI_PLAYED_BESIDE, p.currents);
        TEST_ASSERT_EQUAL_INT(HCI_PROMISE_NOT_JUDGED, p.promise);
        TEST_ASSERT_FALSE(hci_played_is_bad(&p));
        TEST_ASSERT_DOUBLE_WITHIN(3.0 * p.beside.harmonics_error, 1.0, p.beside.harmonics);
        TEST_ASSERT_DOUBLE_WITHIN(0.01, sqrt(0.5 * (pow(LOAD_A[k][0], 2.0) + pow(LOAD_A[k][1], 2.0))),
                                  p.beside.beside_A);
        says(&p, "the table, and what a control adds", true);
        run.torque_source = HCI_TORQUE_HOLDING;
        const hci_played held = judge();
        run.torque_source = HCI_TORQUE_MEASURED;
        says(&held, "which of both, the run does not tell", true);
    }
}

/* A load beside a sine, or beside a table that is turned, is no table. */
static void test_a_load_beside_others(void)
{
    record(0.0, 1.0, 1, 0.01, 0.002);
    add_load(2.0, -2.0);
    TEST_ASSERT_EQUAL_INT(HCI_PLAYED_OTHERS, judge().currents);
    record(0.3, 1.0, 3, 0.01, 0.002);
    add_load(0.2, 0.2);
    TEST_ASSERT_EQUAL_INT(HCI_PLAYED_TURNED, judge().currents);
}

/* A sensor that reads 4 % too much in phase b: the drive divides by that, or does not. */
static void test_sensors_that_were_not_corrected(void)
{
    const hci_effect_type *gain = hci_effect_type_find("current_gain");
    const hci_effect_term term = {1, 0.0, 0.04, 1e-4};
    const hci_effect effect = {gain, &term, 1};
    const hci_effects list = {&effect, 1};
    effects = &list;
    run.has_sum = true;
    record(0.0, 1.0, 3, 0.04, 0.002);
    hci_played p = judge();
    TEST_ASSERT_EQUAL_INT(HCI_PLAYED_AS_SOLVED, p.currents);
    TEST_ASSERT_EQUAL_INT(HCI_PROMISE_UNCORRECTED, p.promise);
    TEST_ASSERT_TRUE(hci_played_is_bad(&p));
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * p.beside.corrected_error + 0.01, 0.0, p.beside.corrected);
    says(&p, "correct them and record again", true);
    for (size_t k = 0; k < run.count; ++k)
        current[3 * k + 1] *= 1.04;
    p = judge();
    TEST_ASSERT_EQUAL_INT(HCI_PROMISE_NOT_KEPT, p.promise);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * p.beside.corrected_error + 0.01, 1.0, p.beside.corrected);
    record(0.0, 1.0, 3, 0.01, 0.002);
    TEST_ASSERT_EQUAL_INT(HCI_PROMISE_KEPT, judge().promise); /* smooth all the same */
}

/* An angle that seems to be read before it is true is none that a drive is asked to correct: currents of a
 * drive that has made what it was asked for are not called uncorrected for that. */
static void test_an_angle_that_is_left_as_it_is(void)
{
    static double speed[COUNT];
    const hci_effect_term delay = {1, 0.0, -0.015, 1e-4}, offset = {0, 0.0, 0.05, 1e-4};
    const hci_effect effect[] = {{hci_effect_type_find("channel_delay"), &delay, 1},
                                 {hci_effect_type_find("current_offset"), &offset, 1}};
    const hci_effects list = {effect, 2};
    TEST_ASSERT_EQUAL_STRING("angle", effect[0].type->parameter[delay.parameter].name);
    effects = &list;
    run.has_sum = true;
    run.speed_rad_per_s = speed;
    record(0.0, 1.0, 3, 0.04, 0.002);
    for (size_t k = 0; k < run.count; ++k) {
        speed[k] = 0.6;
        current[3 * k] += 0.05;
    }
    const hci_played p = judge();
    TEST_ASSERT_EQUAL_INT(HCI_PROMISE_NOT_KEPT, p.promise);
    TEST_ASSERT_DOUBLE_WITHIN(4.0 * p.beside.corrected_error + 0.01, 1.0, p.beside.corrected);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_angle_that_is_left_as_it_is);
    RUN_TEST(test_a_load_beside_the_table);
    RUN_TEST(test_a_load_beside_others);
    RUN_TEST(test_sensors_that_were_not_corrected);
    RUN_TEST(test_ripples);
    RUN_TEST(test_names_of_the_folder);
    RUN_TEST(test_other_currents);
    RUN_TEST(test_not_known);
    RUN_TEST(test_turns);
    RUN_TEST(test_the_least_order);
    return UNITY_END();
}
