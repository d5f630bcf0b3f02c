/* What tune says of a zero by the currents beside a back-EMF that is found turned: one angle, said once. */
#include "cli/tune/words/tune_table_caveats.c"

#include "unity.h"

static cli_tuning tune;
static cli_arguments arguments;

void setUp(void)
{
    memset(&tune, 0, sizeof tune);
    memset(&arguments, 0, sizeof arguments);
    tune.arguments = &arguments;
    tune.is_solved = true;
    tune.open_turn_deg = -4.9;
    tune.open_turn_error_deg = 0.1;
}

void tearDown(void)
{
}

static const char *said(void)
{
    append_of_zero(&tune);
    return tune.tuning.part[HCI_TUNING_CAVEATS];
}

static void test_a_turned_emf_by_itself(void)
{
    TEST_ASSERT_NOT_NULL(strstr(said(), "The back-EMF is found turned by -4.9 ± 0.1 degrees"));
}

/* Two numbers of one angle are no two corrections. */
static void test_a_turned_emf_beside_a_zero_by_the_currents(void)
{
    tune.drive_zero_deg = 10.0;
    tune.drive_zero_reach_deg = 25.0;
    const char *text = said();
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, "lie 10.0 degrees beside the i_q"), text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text,
                                        "That is the same angle once more and no second correction: the "
                                        "back-EMF is found turned by -4.9 ± 0.1 degrees"),
                                 text);
}

/* A zero that was taken is no question any more. */
static void test_a_turned_emf_behind_a_zero_that_was_taken(void)
{
    tune.drive_zero_deg = 10.0;
    tune.took_drive_zero = true;
    TEST_ASSERT_NULL(strstr(said(), "the same angle once more"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_turned_emf_by_itself);
    RUN_TEST(test_a_turned_emf_beside_a_zero_by_the_currents);
    RUN_TEST(test_a_turned_emf_behind_a_zero_that_was_taken);
    return UNITY_END();
}
