/* What a solve takes from a drive: the dc link, less what dead time takes. */
#include <math.h>
#include <string.h>

#include "hci/host/solution/for_drive.h"
#include "unity.h"

static const hci_wave EMF = {1.0, 1, 0.12, 0.0};

static hci_machine_data m;
static hci_drive_data d;
static hci_solve_options o;
static hci_note remark, note;

void setUp(void)
{
    memset(&m, 0, sizeof m);
    memset(&o, 0, sizeof o);
    memset(&remark, 0, sizeof remark);
    memset(&note, 0, sizeof note);
    m.model.pole_pairs = 2;
    m.model.back_emf = &EMF;
    m.model.back_emf_count = 1;
    m.resistance_ohm = 0.1;
    m.inductance_d_H = m.inductance_q_H = 5e-4;
    m.dc_link_voltage_V = 100.0;
    hci_drive_init(&d);
    o.at_speed = true;
    o.speed_rad_per_s = 150.0;
}

void tearDown(void)
{
}

static void take(void)
{
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_solve_for_drive(&d, &m, &o, NULL, &remark, &note), note.text);
}

static void test_the_dc_link_is_a_limit(void)
{
    take();
    TEST_ASSERT_EQUAL_DOUBLE(100.0, o.limit_voltage_V);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, o.limits.dead_time_s);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(remark.text, "100 V between phases that the drive reaches"),
                                 remark.text);
}

/* 3 µs of each of two legs in each 100 µs: 6 %. */
static void test_dead_time_takes_of_it(void)
{
    d.dead_time_s = 3e-6;
    take();
    TEST_ASSERT_EQUAL_DOUBLE(100.0, o.limit_voltage_V);
    TEST_ASSERT_EQUAL_DOUBLE(3e-6, o.limits.dead_time_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1e4, o.limits.pwm_frequency_Hz);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(remark.text, "94 V between phases"), remark.text);
}

static void test_at_the_frequency_of_the_pwm(void)
{
    d.dead_time_s = 3e-6;
    d.pwm_frequency_Hz = 2e4;
    d.modulation = HCI_MODULATION_SINUSOIDAL;
    take();
    TEST_ASSERT_EQUAL_DOUBLE(2e4, o.limits.pwm_frequency_Hz);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(remark.text, "44 V that the drive reaches in each phase"),
                                 remark.text);
}

static void test_a_circle_is_a_vector(void)
{
    d.modulation = HCI_MODULATION_CIRCLE;
    take();
    TEST_ASSERT_EQUAL_INT(HCI_MODULATION_CIRCLE, o.limits.modulation);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(remark.text, "a vector of 57.74 V"), remark.text);
}

/* What was asked for stays, be it the voltage or the dead time. */
static void test_what_was_given_stays(void)
{
    d.dead_time_s = 3e-6;
    o.limits.dead_time_s = 1e-6;
    o.limits.pwm_frequency_Hz = 5e3;
    take();
    TEST_ASSERT_EQUAL_DOUBLE(1e-6, o.limits.dead_time_s);
    TEST_ASSERT_EQUAL_DOUBLE(5e3, o.limits.pwm_frequency_Hz);
    setUp();
    d.dead_time_s = 3e-6;
    o.limit_voltage_V = 60.0;
    take();
    TEST_ASSERT_EQUAL_DOUBLE(60.0, o.limit_voltage_V);
    TEST_ASSERT_EQUAL_DOUBLE(3e-6, o.limits.dead_time_s);
    setUp();
    d.dead_time_s = 3e-6;
    o.limits.ignore_ratings = true;
    take();
    TEST_ASSERT_EQUAL_DOUBLE(0.0, o.limit_voltage_V);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, o.limits.dead_time_s);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_dc_link_is_a_limit);
    RUN_TEST(test_dead_time_takes_of_it);
    RUN_TEST(test_at_the_frequency_of_the_pwm);
    RUN_TEST(test_a_circle_is_a_vector);
    RUN_TEST(test_what_was_given_stays);
    return UNITY_END();
}
