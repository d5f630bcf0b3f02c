/* What a drive has to do to its readings: the inverse of what each effect does to them, and nothing of a
 * torque sensor. */
#include <math.h>
#include <string.h>

#include "hci/effects/effect.h"
#include "hci/host/machine/corrections.h"
#include "hci/host/machine/effects.h"
#include "support/files.h"
#include "unity.h"

static hci_effects_data effects;
static hci_note note;
static char text[HCI_CORRECTIONS_SIZE];

void setUp(void)
{
    files_begin();
    note.text[0] = '\0';
}

void tearDown(void)
{
    hci_effects_release(&effects);
    files_end();
}

static void words_of(const char *rows)
{
    char content[1024] = "effect,parameter,value,unit,std_error\n";
    strcat(content, rows);
    files_write(files_path("effects.csv"), content);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_effects_read(files_path("effects.csv"), &effects, &note),
                              note.text);
    hci_corrections_words(&effects.list, text, sizeof text);
}

static void test_currents(void)
{
    words_of("current_gain,b,-0.02,1,\ncurrent_gain,c,0.25,1,\ncurrent_offset,a,0.05,A,\ncurrent_offset,c,-0."
             "04,A,\n");
    TEST_ASSERT_EQUAL_STRING("i_a = (i_a_read - 0.05 A)\ni_b = i_b_read * 1.0204\n"
                             "i_c = (i_c_read + 0.04 A) * 0.8",
                             text);
}

/* What acts last is undone first, in whatever order the file has it. */
static void test_angles(void)
{
    words_of("position_eccentricity,mech_cosine_1,0.003,rad,\nposition_load,per_ampere,-1e-3,rad_per_A,\n"
             "position_harmonics,sine_2,-0.01,rad,\nposition_offset,angle,0.02,rad,\n");
    TEST_ASSERT_EQUAL_STRING("theta = theta_read - 0.02 rad (electrical)\n"
                             "theta = theta + 0.01 rad * sin(2 theta) (electrical)\n"
                             "theta_m = theta_m - 0.003 rad * cos(1 theta_m) (mechanical)\n"
                             "theta = theta + 0.001 rad/A * i_q (electrical)",
                             text);
}

/* The lines are the inverse of what the core makes of a true sample. */
static void test_numbers_undo_what_sensors_do(void)
{
    hci_corrections c;
    const hci_sample truth = {.theta_m_rad = 0.7, .i_abc = {3.0, -1.0, -2.0}, .computed_phase = -1};
    words_of(
        "current_gain,a,0.1,1,\ncurrent_offset,a,0.5,A,\ncurrent_gain,b,-0.2,1,\ncurrent_offset,c,-1,A,\n"
        "position_eccentricity,mech_sine_1,1e-4,rad,\nposition_offset,angle,0.02,rad,\n");
    hci_corrections_take(&effects.list, &c);
    const hci_sample read = hci_effects_sense(&effects.list, 4, &truth);
    for (int s = 0; s < 3; ++s)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, truth.i_abc[s], (read.i_abc[s] - c.zero_A[s]) * c.gain[s]);
    double theta_m = read.theta_m_rad - c.angle_zero_rad / 4.0;
    TEST_ASSERT_EQUAL_UINT64(1, c.waves);
    TEST_ASSERT_TRUE(c.wave[0].is_mechanical && !c.wave[0].is_cosine);
    theta_m -= c.wave[0].amplitude_rad * sin(c.wave[0].order * theta_m);
    TEST_ASSERT_DOUBLE_WITHIN(2e-8, truth.theta_m_rad, theta_m);
}

static void test_an_angle_is_late(void)
{
    words_of("channel_delay,current,-2e-4,s,\nchannel_delay,angle,3e-4,s,\n");
    TEST_ASSERT_EQUAL_STRING("theta = theta_read + 0.0003 s * d theta/dt (the angle is late)\n"
                             "currents: with the angle of -0.0002 s before (they are late)",
                             text);
}

static void test_an_angle_is_not_early(void)
{
    words_of("channel_delay,angle,-3e-4,s,\n");
    TEST_ASSERT_EQUAL_STRING("", text);
}

static void test_torque_sensors_are_none_of_a_drive(void)
{
    words_of("torque_sensor,offset,0.1,Nm,\nchannel_delay,torque,1e-3,s,\ncogging,sine_6,0.1,Nm,\n");
    TEST_ASSERT_EQUAL_STRING("", text);
}

static void test_lines_without_room_are_left_out(void)
{
    char small[30];
    words_of("current_offset,a,0.05,A,\ncurrent_offset,b,0.05,A,\n");
    hci_corrections_words(&effects.list, small, sizeof small);
    TEST_ASSERT_EQUAL_STRING("i_a = (i_a_read - 0.05 A)", small);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_currents);
    RUN_TEST(test_angles);
    RUN_TEST(test_numbers_undo_what_sensors_do);
    RUN_TEST(test_an_angle_is_late);
    RUN_TEST(test_an_angle_is_not_early);
    RUN_TEST(test_torque_sensors_are_none_of_a_drive);
    RUN_TEST(test_lines_without_room_are_left_out);
    return UNITY_END();
}
