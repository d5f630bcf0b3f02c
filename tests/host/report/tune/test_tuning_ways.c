/* How a current is said to move, beside the largest of the picture. */
#include "host/report/tune/tuning_pictures.c"

#include "unity.h"

static char text[3 * HCI_HTML_NUMBER_SIZE];

void setUp(void)
{
}

void tearDown(void)
{
}

static void says(const char *expected, double low_A, double high_A, double most_A)
{
    words_of_way(text, (hci_range){low_A, high_A}, most_A);
    TEST_ASSERT_EQUAL_STRING(expected, text);
}

/* What moves by less than a hundredth of the largest stays where its middle is; less than that beside 0 is at
 * 0. */
static void test_currents_that_stay(void)
{
    says("goes from 0 to 1.5 A", 0.0, 1.5, 10.0);
    says("goes from 3 to 3.11 A", 3.0, 3.11, 10.0);
    says("stays at 3.05 A", 3.0, 3.09, 10.0);
    says("stays at 0 A", 0.05, 0.14, 10.0);
    says("stays at 0.11 A", 0.07, 0.15, 10.0);
    says("stays at 0 A", -0.14, -0.05, 10.0);
    says("stays at 0 A", -0.04, 0.05, 10.0);
}

static void test_the_heading(void)
{
    static hci_solution_page p;
    char heading[512];
    p.facts.d_A = (hci_range){-4.0, -1.0};
    p.facts.q_A = (hci_range){5.0, 5.03};
    p.facts.plain_dq_A.q = 4.5;
    heading_of_currents(&p, true, heading);
    TEST_ASSERT_EQUAL_STRING("With the table i_q stays at 5.02 A, where a plain sine has 4.5 A, and i_d goes "
                             "from −4 to −1 A",
                             heading);
    p.facts.d_A = (hci_range){-2.5, -2.4}; /* of the largest, 5.03 */
    heading_of_currents(&p, true, heading);
    TEST_ASSERT_NOT_NULL(strstr(heading, "i_d goes from"));
    p.facts.d_A = (hci_range){-20.0, -19.9}; /* now of 20 */
    p.facts.q_A = (hci_range){5.0, 5.19};
    heading_of_currents(&p, true, heading);
    TEST_ASSERT_NOT_NULL(strstr(heading, "i_d stays at"));
    TEST_ASSERT_NOT_NULL(strstr(heading, "i_q stays at"));
    heading_of_currents(&p, false, heading); /* no table was written */
    TEST_ASSERT_NOT_NULL(strstr(heading, "In the model alone i_q stays at"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_currents_that_stay);
    RUN_TEST(test_the_heading);
    return UNITY_END();
}
