/* Channels out of headers that say where they come from. */
#include "host/csv/channel_name.h"

#include <string.h>

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void is_channel(const char *header, const char *name, bool is_of_place)
{
    char found[HCI_CHANNEL_SIZE];
    bool of_place;
    TEST_ASSERT_TRUE_MESSAGE(hci_channel_name(header, found, &of_place), header);
    TEST_ASSERT_EQUAL_STRING_MESSAGE(name, found, header);
    TEST_ASSERT_EQUAL_MESSAGE(is_of_place, of_place, header);
}

static void is_none(const char *header)
{
    char found[HCI_CHANNEL_SIZE];
    bool of_place = true;
    TEST_ASSERT_FALSE_MESSAGE(hci_channel_name(header, found, &of_place), header);
    TEST_ASSERT_FALSE_MESSAGE(of_place, header);
}

static void test_groups_in_quotes(void)
{
    is_channel("/'Group'/'Torque [Nm]'", "Torque [Nm]", false);
    is_channel("/'a'/'b'/'c'", "c", false);
    is_channel("/'Group'/'T'", "T", false);
    is_none("/'Group'/'Torque");
    is_none("/'Torque'");
    is_none("/'Group'/''");
    is_none("/'Reference'/'Torque'");
    is_none("'Group'/'Torque'");
    is_none("//'Group'/'Torque'");
    is_none("/''");
}

static void test_sources_behind_a_stroke(void)
{
    is_channel("Torque\\CAN: 1", "Torque", false);
    is_channel("Torque\\CAN: 1 [Nm]", "Torque [Nm]", false);
    is_channel("iq\\bus [x] [A]", "iq [A]", false);
    is_none("Torque\\Setpoints: 1");
    is_none("\\CAN: 1");
}

static void test_places_of_controllers(void)
{
    is_channel("Axis 1.ActPos (deg)", "ActPos (deg)", true);
    is_channel("MAIN.fbAxis.Channel", "Channel", true);
    is_channel("GVL.stDrive.lrTorque", "lrTorque", true);
    is_channel("Term 3 (EL3702).Value", "Value", true);
    is_channel("Axis 1.ActPos [1.x]", "ActPos [1.x]", true);
    is_none("Axis 1.5");
    is_none("Pump.Torque");
    is_none("Axis.Reference.Torque");
    is_none("Torque");
    is_none("");
    is_none(".Torque.");
    is_none("Term (El3702).Value");   /* a type has capitals alone, … */
    is_none("Term (ABCD3702).Value"); /* … and up to three of them */
}

/* As long as a name may be: 95 bytes. */
static void test_the_longest_channel(void)
{
    for (size_t length = 95; length <= 96; ++length) {
        char header[200] = "Axis.", plain[100];
        memset(plain, 'x', length);
        plain[length] = '\0';
        strcat(header, plain);
        if (length == 95)
            is_channel(header, plain, true);
        else
            is_none(header);
    }
    for (size_t length = 89; length <= 91; ++length) { /* and a blank and "[Nm]" */
        char header[200], plain[100], whole[120];
        memset(plain, 'x', length);
        plain[length] = '\0';
        strcpy(header, plain);
        strcat(header, "\\CAN [Nm]");
        strcpy(whole, plain);
        strcat(whole, " [Nm]");
        if (length <= 90)
            is_channel(header, whole, false);
        else
            is_none(header);
    }
}

static void test_words_of_what_is_wanted(void)
{
    static const char *const WANTED[] = {"Soll", "torque_ref", "TorqueReference", "Model Root/Setpoint",
                                         "cmd2", "x limits",   "SpeedControl",    "Model",
                                         "max"};
    static const char *const NOT[] = {"Torque", "Model Root/Torque", "refer", "Sollte", "maximum", "", "12"};
    for (size_t k = 0; k < sizeof WANTED / sizeof *WANTED; ++k)
        TEST_ASSERT_TRUE_MESSAGE(hci_channel_is_wanted(WANTED[k], strlen(WANTED[k])), WANTED[k]);
    for (size_t k = 0; k < sizeof NOT / sizeof *NOT; ++k)
        TEST_ASSERT_FALSE_MESSAGE(hci_channel_is_wanted(NOT[k], strlen(NOT[k])), NOT[k]);
    TEST_ASSERT_FALSE(hci_channel_is_wanted("Torque Soll", 6)); /* up to its length */
    TEST_ASSERT_TRUE(hci_channel_is_wanted("Torque Soll", 11));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_groups_in_quotes);
    RUN_TEST(test_sources_behind_a_stroke);
    RUN_TEST(test_places_of_controllers);
    RUN_TEST(test_the_longest_channel);
    RUN_TEST(test_words_of_what_is_wanted);
    return UNITY_END();
}
