/* An angle whose name does not say what it is, and a speed whose unit is that of its name alone: decided by
 * how far the one goes while the other says how far, in tables of numbers whose ratio is known. */
#include "host/recording/bare_angle.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/csv/table.h"
#include "support/texts.h"
#include "unity.h"

enum { N = 400 };

static const double PI = 3.14159265358979323846, STEP_S = 1e-3;

static double time_s[N], speed[N], angle[N], number[N];
static const double *const value[] = {time_s, speed, angle};
static hci_csv_memory table; /* is read for as long as csv */
static hci_csv *csv;
static hci_note note;

void setUp(void)
{
    memset(&note, 0, sizeof note);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_csv_free(csv);
    csv = NULL;
}

/* A shaft that turns at 3 to 7 rad/s, and back in the last quarter, where `back`; the angle goes `factor`
 * times as far and is wrapped at `full`, the speed is `per` of it. */
static void move(double factor, double full, double per, bool back)
{
    double x = 0.2;
    for (size_t k = 0; k < N; ++k) {
        const double w = (back && k >= N * 3 / 4 ? -1.0 : 1.0) * (5.0 + 2.0 * sin(0.02 * (double)k));
        time_s[k] = 4.0 + STEP_S * (double)k;
        speed[k] = w / per;
        angle[k] = full > 0.0 ? factor * x - full * floor(factor * x / full) : factor * x;
        x += w * STEP_S;
    }
}

static hci_status decide(const char *speed_name, const char *angle_name, size_t rows, int pole_pairs)
{
    const char *const column[] = {"time_s", speed_name, angle_name};
    table = (hci_csv_memory){"table", column, value, 3, rows};
    hci_csv_free(csv);
    csv = NULL;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_of_memory(&table, &csv, &note), note.text);
    return hci_bare_angle_decide(csv, pole_pairs, &note);
}

/* Numbers k of a column are `scale` times x. */
static void reads(const char *name, const double *x, double scale)
{
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_numbers(csv, name, number, &note), note.text);
    for (size_t k = 0; k < N; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * (1.0 + fabs(x[k] * scale)), x[k] * scale, number[k]);
}

/* ---- which angle it is ---- */

enum { NONE, MECHANICAL, ELECTRICAL };

static const char *column_of(int which)
{
    return which == MECHANICAL ? "theta_m_rad" : "theta_e_rad";
}

static void is_angle(int which, bool in_degrees)
{
    TEST_ASSERT_EQUAL(which == MECHANICAL, hci_csv_has(csv, "theta_m_rad"));
    TEST_ASSERT_EQUAL(which == ELECTRICAL, hci_csv_has(csv, "theta_e_rad"));
    TEST_ASSERT_EQUAL(which != NONE, csv->given_count);
    if (which == NONE) {
        TEST_ASSERT_EQUAL_STRING("", csv->decided.text);
        return;
    }
    reads(column_of(which), angle, in_degrees ? PI / 180.0 : 1.0);
    text_has(which == MECHANICAL ? "mechanical angle" : "electrical angle", csv->decided.text);
    text_has(which == MECHANICAL ? "as fast as the speed says"
                                 : "by the pole pairs faster than the speed says",
             csv->decided.text);
    TEST_ASSERT_EQUAL(in_degrees, strstr(csv->decided.text, "in degrees") != NULL);
}

/* To a tenth of one or of the pole pairs; those that are not known are a whole number from two on. */
static void test_by_the_ratio(void)
{
    static const struct {
        double factor;
        int pole_pairs, which;
    } CASE[] = {{1.0, 4, MECHANICAL},  {1.09, 4, MECHANICAL}, {0.91, 4, MECHANICAL}, {1.12, 4, NONE},
                {0.88, 4, NONE},       {4.0, 4, ELECTRICAL},  {4.36, 4, ELECTRICAL}, {3.64, 4, ELECTRICAL},
                {4.44, 4, NONE},       {3.56, 4, NONE},       {5.0, 4, NONE},        {5.0, 0, ELECTRICAL},
                {3.25, 0, ELECTRICAL}, {3.35, 0, NONE},       {2.72, 0, ELECTRICAL}, {2.6, 0, NONE},
                {1.85, 0, ELECTRICAL}, {1.5, 0, NONE},        {1.05, 0, MECHANICAL}, {1.0, 1, MECHANICAL},
                {0.5, 0, NONE},        {-1.0, 4, MECHANICAL}, {-4.0, 4, ELECTRICAL}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k)
        for (int back = 0; back < 2; ++back)
            for (int wrapped = 0; wrapped < 2; ++wrapped) {
                move(CASE[k].factor, wrapped ? 2.0 * PI : 0.0, 1.0, back);
                TEST_ASSERT_EQUAL(HCI_OK, decide("speed_rad_per_s", "theta", N, CASE[k].pole_pairs));
                is_angle(CASE[k].which, false);
            }
}

/* In degrees where it is in no unit; one that is in rad stays so. */
static void test_degrees(void)
{
    for (int electrical = 0; electrical < 2; ++electrical) {
        move((electrical ? 4.0 : 1.0) * 180.0 / PI, 360.0, 1.0, true);
        TEST_ASSERT_EQUAL(HCI_OK, decide("speed_rad_per_s", "theta", N, 4));
        is_angle(electrical ? ELECTRICAL : MECHANICAL, true);
        TEST_ASSERT_EQUAL(HCI_OK, decide("speed_rad_per_s", "theta [rad]", N, 4));
        is_angle(NONE, false);
    }
    move(1.0, 2.0 * PI, 1.0, true);
    TEST_ASSERT_EQUAL(HCI_OK, decide("speed_rad_per_s", "theta [rad]", N, 4));
    is_angle(MECHANICAL, false);
    move(2.0 * 180.0 / PI, 360.0, 1.0, true);
    TEST_ASSERT_EQUAL(HCI_OK, decide("speed_rad_per_s", "theta [deg]", N, 2));
    TEST_ASSERT_TRUE(hci_csv_has(csv, "theta_e_rad"));
    reads("theta_e_rad", angle, PI / 180.0);
}

/* A speed holds where it has no number; steps back in time and from no number are passed over. */
static void test_holes(void)
{
    move(4.0, 2.0 * PI, 1.0, false);
    for (size_t k = 0; k < N; ++k)
        if (k % 10 != 0) speed[k] = NAN;
    TEST_ASSERT_EQUAL(HCI_OK, decide("speed_rad_per_s", "theta", N, 4));
    TEST_ASSERT_TRUE(hci_csv_has(csv, "theta_e_rad"));
    move(4.0, 2.0 * PI, 1.0, false);
    angle[17] = angle[90] = NAN;
    time_s[45] = NAN;
    for (size_t k = N / 2; k < N; ++k)
        time_s[k] -= 0.1; /* one step back, of 99 ms: more than all of the rest were it not passed over */
    time_s[N / 2] -= 3.0;
    for (size_t k = N / 2 + 1; k < N; ++k)
        time_s[k] -= 3.0;
    TEST_ASSERT_EQUAL(HCI_OK, decide("speed_rad_per_s", "theta", N, 4));
    TEST_ASSERT_TRUE(hci_csv_has(csv, "theta_e_rad"));
}

/* A shaft that stands, a table that is too short, and what is named already. */
static void test_nothing_to_decide(void)
{
    move(1.0, 0.0, 1.0, false);
    TEST_ASSERT_EQUAL(HCI_OK, decide("speed_rad_per_s", "theta", 1, 4));
    is_angle(NONE, false);
    TEST_ASSERT_EQUAL(HCI_OK, decide("speed_rad_per_s", "theta", 2, 4));
    TEST_ASSERT_TRUE(hci_csv_has(csv, "theta_m_rad"));
    TEST_ASSERT_EQUAL(HCI_OK, decide("spare", "theta", N, 4));
    is_angle(NONE, false);
    memset(speed, 0, sizeof speed);
    TEST_ASSERT_EQUAL(HCI_OK, decide("speed_rad_per_s", "theta", N, 4));
    is_angle(NONE, false);
    move(4.0, 0.0, 1.0, false);
    TEST_ASSERT_EQUAL(HCI_OK, decide("speed_rad_per_s", "theta_m_rad", N, 4));
    TEST_ASSERT_EQUAL(0, csv->given_count);
    move(1.0, 0.0, 1.0, false);
    TEST_ASSERT_EQUAL(HCI_OK, decide("speed_rad_per_s", "theta_e_rad", N, 4));
    TEST_ASSERT_EQUAL(0, csv->given_count);
}

/* ---- why it is not told ---- */

static void is_explained(const char *speed_name, const char *angle_name, const char *words)
{
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL(HCI_OK, decide(speed_name, angle_name, N, 4));
    TEST_ASSERT_EQUAL_MESSAGE(words ? HCI_ERROR_INPUT : HCI_OK, hci_bare_angle_explain(csv, 4, &note),
                              words ? words : "");
    if (words) text_has(words, note.text);
}

/* A shaft that stands, an encoder that does beside a speed, and each of the three in another unit than it
 * says. */
static void test_why_not(void)
{
    move(180.0 / PI, 360.0, 1.0, true);
    is_explained("speed_rad_per_s", "theta [rad]", "--column 'theta_m_deg=theta [rad]'");
    move(4.0 * 180.0 / PI, 360.0, 1.0, true);
    is_explained("speed_rad_per_s", "theta [rad]", "--column 'theta_e_deg=theta [rad]'");
    move(1.0, 2.0 * PI, PI / 30.0, true);
    is_explained("speed_rad_per_s", "theta [rad]", "--column 'speed_rpm=speed_rad_per_s'");
    move(1.0, 2.0 * PI, 1.0, false);
    is_explained("speed_rpm", "theta [rad]", "--column 'speed_rad_per_s=speed_rpm'");
    move(1.0, 2.0 * PI, 1.0, true);
    for (size_t k = 0; k < N; ++k)
        time_s[k] *= 1e3;
    is_explained("speed_rad_per_s", "theta [rad]", "--column 'time_ms=time_s'");
    move(1.0, 2.0 * PI, PI / 180.0, true);
    is_explained("speed_rpm", "theta [rad]", "--column 'speed_deg_per_s=speed_rpm'");
    move(1.0, 2.0 * PI, 1.0, false);
    for (size_t k = 0; k < N; ++k)
        time_s[k] = 1e-3 * (double)((k * 37) % N);
    is_explained("speed_rad_per_s", "theta [rad]",
                 "expected rows in the order of the time; sort them by this");
    move(1.5, 2.0 * PI, 1.0, true);
    is_explained("speed_rad_per_s", "theta [rad]", NULL);
    move(1.0, 2.0 * PI, 1.0, true);
    for (size_t k = 0; k < N; ++k)
        angle[k] = 0.3 + (k % 2 ? 0.005 : 0.0); /* a count that flickers */
    is_explained("speed_rad_per_s", "theta [rad]", "while the speed says that the shaft turns");
    memset(speed, 0, sizeof speed);
    is_explained("speed_rad_per_s", "theta [rad]", "the shaft does not turn in this recording");
    angle[N / 2] += 0.01;
    is_explained("speed_rad_per_s", "theta [rad]", NULL);
    is_explained("speed_rad_per_s", "theta_m_rad", NULL);
    is_explained("spare", "theta [rad]", NULL);
}

/* ---- in which unit the speed is ---- */

/* `velocity` is in turn/s where nothing tells otherwise. per: rad/s of the unit that it is in. */
static void is_speed(double per, const char *unit)
{
    TEST_ASSERT_EQUAL(unit != NULL, strstr(csv->decided.text, "is read as the mechanical speed in") != NULL);
    if (unit) {
        char words[60];
        snprintf(words, sizeof words, "the mechanical speed in %s, since the angle", unit);
        text_has(words, csv->decided.text);
        text_has("and not in rev/s as moteus has it", csv->decided.text);
    }
    reads("speed_rad_per_s", speed, unit ? per : 2.0 * PI);
}

static void test_units_of_a_speed(void)
{
    static const struct {
        double share, per; /* of the way of the angle; rad/s */
        const char *unit;
    } CASE[] = {{1.0, 1.0, "rad/s"},
                {1.015, 1.0, "rad/s"},
                {0.985, 1.0, "rad/s"},
                {1.025, 1.0, NULL},
                {0.975, 1.0, NULL},
                {1.0, 3.14159265358979323846 / 30.0, "rpm"},
                {1.0, 3.14159265358979323846 / 180.0, "degrees/s"},
                {1.0, 6.28318530717958647693, NULL},
                {1.05, 6.28318530717958647693, NULL},
                {4.0, 1.0, NULL}};
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k)
        for (int back = 0; back < 2; ++back) {
            move(CASE[k].share, back ? 2.0 * PI : 0.0, CASE[k].per, back);
            TEST_ASSERT_EQUAL(HCI_OK, decide("velocity", "theta_m_rad", N, 4));
            is_speed(CASE[k].per, CASE[k].unit);
        }
}

/* The same by a bare angle, which is told then; not by one whose unit is that of a tool, or an electrical
 * one. */
static void test_units_by_other_angles(void)
{
    move(1.0, 2.0 * PI, 1.0, true);
    TEST_ASSERT_EQUAL(HCI_OK, decide("velocity", "theta", N, 4));
    is_speed(1.0, "rad/s");
    TEST_ASSERT_TRUE(hci_csv_has(csv, "theta_m_rad"));
    reads("theta_m_rad", angle, 1.0);
    TEST_ASSERT_EQUAL(2, csv->given_count);
    TEST_ASSERT_EQUAL(HCI_OK, decide("velocity", "shaft_angle", N, 4));
    is_speed(1.0, NULL);
    TEST_ASSERT_EQUAL(HCI_OK, decide("velocity", "theta_e_rad", N, 4));
    is_speed(1.0, NULL);
    TEST_ASSERT_EQUAL(HCI_OK, decide("velocity", "spare", N, 4));
    is_speed(1.0, NULL);
    TEST_ASSERT_EQUAL(HCI_OK, decide("speed_rpm", "theta_m_rad", N, 4)); /* a unit of its own */
    TEST_ASSERT_EQUAL(0, csv->given_count);
    move(1.0, 2.0 * PI, 1.0, true);
    for (size_t k = 0; k < N; ++k)
        if (k % 4 != 0) speed[k] = NAN;
    angle[7] = NAN;
    TEST_ASSERT_EQUAL(HCI_OK, decide("velocity", "theta_m_rad", N, 4));
    text_has("in rad/s, since", csv->decided.text);
}

static void test_without_memory(void)
{
    move(1.0, 2.0 * PI, 1.0, true);
    for (long k = 0;; ++k) {
        const char *const column[] = {"time_s", "velocity", "theta"};
        table = (hci_csv_memory){"table", column, value, 3, N};
        memset(&note, 0, sizeof note);
        hci_csv_free(csv);
        csv = NULL;
        TEST_ASSERT_EQUAL(HCI_OK, hci_csv_of_memory(&table, &csv, &note));
        hci_memory_fail_after(k);
        const hci_status status = hci_bare_angle_decide(csv, 4, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK || status == HCI_ERROR_MEMORY);
        TEST_ASSERT_EQUAL(status != HCI_OK, note.text[0] != '\0');
        TEST_ASSERT_TRUE(k > 0 || status == HCI_ERROR_MEMORY);
        if (status == HCI_OK) return;
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_by_the_ratio);
    RUN_TEST(test_degrees);
    RUN_TEST(test_holes);
    RUN_TEST(test_nothing_to_decide);
    RUN_TEST(test_why_not);
    RUN_TEST(test_units_of_a_speed);
    RUN_TEST(test_units_by_other_angles);
    RUN_TEST(test_without_memory);
    return UNITY_END();
}
