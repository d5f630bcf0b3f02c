/* What is said of gains of q that are others than those of d, and numbers of two digits. */
#include "host/drive/fit.c"

#include "unity.h"

static hci_drive_data drive;
static char text[Q_SIZE];

void setUp(void)
{
    drive.kp_ohm = drive.kp_q_ohm = 1.5;
    drive.ki_ohm_per_s = drive.ki_q_ohm_per_s = 200.0;
}

void tearDown(void)
{
}

/* Of each of the two, larger or smaller. */
static void test_gains_of_q(void)
{
    static const double OFF[] = {0.5, 2.0};
    TEST_ASSERT_EQUAL_STRING("", also_of_q(&drive, text));
    for (int k = 0; k < 2; ++k) {
        setUp();
        drive.kp_q_ohm *= OFF[k];
        TEST_ASSERT_EQUAL_STRING(k ? " (of q 3 and 200)" : " (of q 0.75 and 200)", also_of_q(&drive, text));
        setUp();
        drive.ki_q_ohm_per_s *= OFF[k];
        TEST_ASSERT_EQUAL_STRING(k ? " (of q 1.5 and 400)" : " (of q 1.5 and 100)", also_of_q(&drive, text));
    }
}

static void test_two_digits(void)
{
    static const double VALUE[] = {1.0, 1.999, 12.34, 99.9, 0.0456, 7.0e5},
                        DIGITS[] = {1.0, 1.9, 12.0, 99.0, 0.045, 7e5};
    for (size_t k = 0; k < sizeof VALUE / sizeof *VALUE; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12 * DIGITS[k], DIGITS[k], two_digits_below(VALUE[k]));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_gains_of_q);
    RUN_TEST(test_two_digits);
    return UNITY_END();
}
