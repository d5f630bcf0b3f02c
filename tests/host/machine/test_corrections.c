/* What a drive has to do to its readings: the inverse of what each effect does to them, and nothing of a
 * torque sensor. */
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
    words_of("current_gain,b,-0.02,1,\ncurrent_offset,a,0.05,A,\ncurrent_offset,c,-0.04,A,\n");
    TEST_ASSERT_EQUAL_STRING("divide i_b by 0.98, subtract 0.05 A from i_a, add 0.04 A to i_c", text);
}

static void test_angles(void)
{
    words_of("position_eccentricity,mech_cosine_1,0.003,rad,\nposition_offset,angle,0.02,rad,\n");
    TEST_ASSERT_NOT_NULL(strstr(text, "subtract 0.02 rad from the electrical angle"));
    TEST_ASSERT_NOT_NULL(strstr(text, "subtract from the mechanical angle 0.003 rad cos(1 theta_m)"));
}

/* What is below 0 is added, and no digits are said that recordings do not carry. */
static void test_signs_and_digits(void)
{
    words_of("position_eccentricity,mech_sine_1,-0.00312345,rad,\nposition_offset,angle,-0.0212345,rad,\n");
    TEST_ASSERT_NOT_NULL(strstr(text, "add 0.0212 rad to the electrical angle"));
    TEST_ASSERT_NOT_NULL(strstr(text, "add to the mechanical angle 0.00312 rad sin(1 theta_m)"));
}

static void test_digits_of_a_gain(void)
{
    words_of("current_gain,b,-0.0123456,1,\n");
    TEST_ASSERT_EQUAL_STRING("divide i_b by 0.98765", text);
}

static void test_an_angle_is_late(void)
{
    words_of("channel_delay,current,-2e-4,s,\nchannel_delay,angle,3e-4,s,\n");
    TEST_ASSERT_EQUAL_STRING(
        "take for the currents, for their delay, the angle of -0.0002 s before, add to the "
        "angle, for its delay, the speed times 0.0003 s",
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

static void test_what_has_no_room_is_cut_off(void)
{
    char small[12];
    words_of("current_offset,a,0.05,A,\n");
    hci_corrections_words(&effects.list, small, sizeof small);
    TEST_ASSERT_EQUAL_STRING("subtract 0.", small);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_currents);
    RUN_TEST(test_angles);
    RUN_TEST(test_signs_and_digits);
    RUN_TEST(test_digits_of_a_gain);
    RUN_TEST(test_an_angle_is_late);
    RUN_TEST(test_an_angle_is_not_early);
    RUN_TEST(test_torque_sensors_are_none_of_a_drive);
    RUN_TEST(test_what_has_no_room_is_cut_off);
    return UNITY_END();
}
