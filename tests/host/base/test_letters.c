/* Words without regard to case: of the letters of ASCII alone. */
#include "hci/host/base/text.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_words_without_regard_to_case(void)
{
    TEST_ASSERT_TRUE(hci_text_is("Theta_AZ", "tHETA_az"));
    TEST_ASSERT_FALSE(hci_text_is("theta", "theta_m"));
    TEST_ASSERT_FALSE(hci_text_is("[", "{"));
    TEST_ASSERT_FALSE(hci_text_is("@", "`"));
    TEST_ASSERT_TRUE(hci_text_begins("Torque_Nm", "tORq", 4));
    TEST_ASSERT_FALSE(hci_text_begins("tor", "torque", 4));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_words_without_regard_to_case);
    return UNITY_END();
}
