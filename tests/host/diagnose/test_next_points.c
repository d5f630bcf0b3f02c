/* labels: slow */
/* What is to be recorded next lies within reach, and recorded, it tells what was open. Each case diagnoses
 * twice, before and after that recording: a second each, which sanitizers make ten. */
#include <math.h>
#include <string.h>

#include "host/base/memory.h"

#include "support/diagnosing.h"

static double brake_Nm;    /* that turns its sign with the direction */
static double offset_Nm;   /* that does not */
static double invented_Nm; /* order 6, as the root of the current */

void setUp(void)
{
    dataset_start();
    brake_Nm = offset_Nm = invented_Nm = 0.0;
}

void tearDown(void)
{
    dataset_end();
}

/* ---- the truth ---- */

static void play(double id_A, double iq_A, double speed_rad_per_s, size_t samples)
{
    const double direction = speed_rad_per_s < 0.0 ? -1.0 : 1.0, current_A = hypot(id_A, iq_A);
    record(samples, &(point){speed_rad_per_s, iq_A, 0.0, direction * brake_Nm - offset_Nm, 0.0});
    hci_run *r = &run[runs.count - 1];
    for (size_t k = 0; k < r->count; ++k) {
        const double theta_e = P * r->theta_m_rad[k];
        rec_phases(id_A, iq_A, theta_e, r->i_A + 3 * k); /* i_d makes no torque here */
        r->torque_Nm[k] += invented_Nm * sqrt(current_A) * sin(6.0 * theta_e);
    }
}

/* Records all that was asked for, as long as asked for. */
static void follow(void)
{
    const size_t count = diagnosis.next_points;
    for (size_t k = 0; k < count; ++k) {
        const hci_next_point p = diagnosis.next[k];
        TEST_ASSERT_EQUAL_INT(HCI_TORQUE_MEASURED, p.source);
        play(p.id_A, p.iq_A, p.speed_rad_per_s, (size_t)(300.0 * p.turns));
    }
}

/* ---- within reach ---- */

static void are_within(double most_A, double least_rad_per_s, double most_rad_per_s)
{
    TEST_ASSERT_GREATER_THAN_UINT64(0, diagnosis.next_points);
    for (size_t k = 0; k < diagnosis.next_points; ++k) {
        const hci_next_point *p = &diagnosis.next[k];
        const double current_A = hypot(p->id_A, isnan(p->iq_A) ? 0.0 : p->iq_A);
        TEST_ASSERT_TRUE(current_A <= most_A * (1.0 + 1e-9));
        TEST_ASSERT_TRUE(fabs(p->speed_rad_per_s) >= least_rad_per_s * 0.99); /* three digits */
        TEST_ASSERT_TRUE(fabs(p->speed_rad_per_s) <= most_rad_per_s * (1.0 + 1e-9));
        TEST_ASSERT_TRUE(p->turns >= 10.0 && p->turns <= 50.0);
        TEST_ASSERT_TRUE(p->why[0] != '\0');
    }
}

static void record_one_way(void)
{
    for (int k = 0; k < 3; ++k)
        play(0.0, 3.0 * k, 60.0, 450);
}

static void test_points_lie_within_what_was_recorded(void)
{
    brake_Nm = 0.05;
    record_one_way();
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    are_within(6.0, 15.0, 60.0);
}

static void test_points_lie_within_the_ratings(void)
{
    brake_Nm = 0.05;
    record_one_way();
    machine.rated_current_A = 4.0;
    machine.rated_speed_rad_per_s = 30.0;
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    are_within(4.0, 7.5, 30.0);
}

static void test_nothing_is_asked_for_where_nothing_is_open(void)
{
    record_map(0.3, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.next_points);
    TEST_ASSERT_EQUAL_STRING("", diagnosis.advice);
}

/* A map there and back has a mean speed of nothing but rounding, and its current cannot be chosen. */
static void test_holding_tests_ask_for_holding_tests(void)
{
    record_holding(1200, 0.08, 0.1, 0.3);
    record_holding(1200, 0.08, 0.1, 0.3);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    const double speed = fabs(run[0].speed_rad_per_s[0]);
    are_within(2.0, fmin(speed, fmax(0.1, 0.25 * speed)), speed);
    for (size_t k = 0; k < diagnosis.next_points; ++k) {
        TEST_ASSERT_EQUAL_INT(HCI_TORQUE_HOLDING, diagnosis.next[k].source);
        TEST_ASSERT_TRUE(isnan(diagnosis.next[k].iq_A));
    }
}

/* ---- what is asked for tells ---- */

static void is_told(const char *truth, const char *other)
{
    record_one_way();
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_AMBIGUOUS, found(truth)->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_AMBIGUOUS, found(other)->verdict);
    follow();
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found(truth)->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_REJECTED, found(other)->verdict);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.next_points);
}

static void test_friction_is_told_from_the_zero_of_the_sensor(void)
{
    brake_Nm = 0.05;
    is_told("friction", "torque_sensor");
}

/* At 0.1 rad/s no slower one is asked for. */
static void test_a_point_says_each_reason_once(void)
{
    brake_Nm = 0.05;
    for (int k = 0; k < 3; ++k)
        play(0.0, 3.0 * k, 0.1, 450);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_GREATER_THAN_UINT64(1, diagnosis.next_points); /* no answer is to hang on one run */
    for (size_t k = 0; k < diagnosis.next_points; ++k) {
        const char *why = diagnosis.next[k].why;
        int reasons = 0;
        for (const char *at = why; (at = strstr(at, "tells friction from torque_sensor")) != NULL; ++at)
            ++reasons;
        TEST_ASSERT_EQUAL_INT(1, reasons);
        for (const char *end = why; (end = strchr(end, ')')) != NULL; ++end)
            TEST_ASSERT_TRUE(end[1] == '\0' || (end[1] == ';' && end[2] == ' '));
    }
}

static void test_the_zero_of_the_sensor_is_told_from_friction(void)
{
    offset_Nm = -0.05;
    is_told("torque_sensor", "friction");
}

/* At one speed in one direction no law of growth with the speed is excluded. */
static void growth_is_told(double unit_A, double speed_rad_per_s)
{
    static const double CURRENT[] = {0.0, 0.25, 1.0, 4.0, 9.0};
    invented_Nm = 0.05 / sqrt(unit_A);
    for (int k = 0; k < 5; ++k)
        play(0.0, unit_A * CURRENT[k], speed_rad_per_s, 900);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
    are_within(9.0 * unit_A, 0.25 * speed_rad_per_s, speed_rad_per_s);
    TEST_ASSERT_NOT_NULL(strstr(diagnosis.next[0].why, "laws of growth that describe order 6"));
    TEST_ASSERT_TRUE(diagnosis.next[0].speed_rad_per_s < speed_rad_per_s / 3.0);
    follow();
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_UINT64(1, diagnosis.unexplained_count);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, diagnosis.unexplained[0].current_exponent);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, diagnosis.unexplained[0].speed_exponent);
    TEST_ASSERT_FALSE(diagnosis.unexplained[0].turns_sign);
    are_within(9.0 * unit_A, 0.25 * speed_rad_per_s,
               speed_rad_per_s); /* no law is open: where nothing has been recorded */
    TEST_ASSERT_EQUAL_STRING("furthest from all recordings so far", diagnosis.next[0].why);
}

static void test_how_what_is_unknown_grows_is_told(void)
{
    growth_is_told(1.0, 60.0);
}

/* A small motor: 0.18 A are a current as well. */
static void test_how_what_is_unknown_grows_is_told_with_small_currents(void)
{
    growth_is_told(0.02, 60.0);
}

/* At a slow speed: four and one turns a minute go in the same direction. */
static void test_how_what_is_unknown_grows_is_told_at_a_slow_speed(void)
{
    growth_is_told(1.0, 0.4);
}

/* What nobody has seen yet comes first. */
static void test_the_other_direction_is_asked_for(void)
{
    for (int k = 0; k < 4; ++k)
        record(900, &(point){60.0, 2.0 + 2.0 * k, 0.0, 0.0, 0.08});
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_UNKNOWN, diagnosis.verdict);
    are_within(8.0, 15.0, 60.0);
    TEST_ASSERT_TRUE(diagnosis.next[0].speed_rad_per_s < 0.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_points_lie_within_what_was_recorded);
    RUN_TEST(test_points_lie_within_the_ratings);
    RUN_TEST(test_nothing_is_asked_for_where_nothing_is_open);
    RUN_TEST(test_holding_tests_ask_for_holding_tests);
    RUN_TEST(test_friction_is_told_from_the_zero_of_the_sensor);
    RUN_TEST(test_a_point_says_each_reason_once);
    RUN_TEST(test_the_zero_of_the_sensor_is_told_from_friction);
    RUN_TEST(test_how_what_is_unknown_grows_is_told);
    RUN_TEST(test_how_what_is_unknown_grows_is_told_at_a_slow_speed);
    RUN_TEST(test_the_other_direction_is_asked_for);
    RUN_TEST(test_how_what_is_unknown_grows_is_told_with_small_currents);
    return UNITY_END();
}
