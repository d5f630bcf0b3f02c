/* What the page of a solution says of it first, on both sides of each bound. */
#include "host/report/page/solution_words.c"

#include "unity.h"

static hci_solved_order order[2];
static hci_solution solution;
static hci_solution_page page;
static char text[512];

/* 2 N·m on average, with 0.5 N·m of ripple before and 0.1 N·m after. */
void setUp(void)
{
    memset(order, 0, sizeof order);
    memset(&solution, 0, sizeof solution);
    memset(&page, 0, sizeof page);
    order[0].torque_Nm.cosine = 2.0, order[0].target_Nm.cosine = 3.0, order[0].before_Nm.cosine = 1.5;
    order[1].torque_Nm.order = 6.0;
    solution.order = order, solution.order_count = 2;
    solution.expected.state = HCI_RIPPLE_NO_RECORDINGS;
    solution.tolerance_Nm = 1e-3, solution.within_limits = true;
    page.solution = &solution;
    page.facts.after_Nm = (hci_range){1.95, 2.05};
    page.facts.before_Nm = (hci_range){1.5, 2.0};
}

void tearDown(void)
{
}

static void test_the_mean(void)
{
    TEST_ASSERT_TRUE(has_mean(&solution) && mean_Nm(&solution) == 2.0);
    order[0].torque_Nm.order = 1.0;
    TEST_ASSERT_TRUE(!has_mean(&solution) && mean_Nm(&solution) == 0.0);
    order[0].torque_Nm.order = 0.0, solution.order_count = 0;
    TEST_ASSERT_FALSE(has_mean(&solution));
}

static const char *swing(double low, double high, double tolerance)
{
    hci_page_swing(text, (hci_range){low, high}, tolerance);
    return text;
}

static void test_a_swing_below_the_tolerance(void)
{
    TEST_ASSERT_EQUAL_STRING("0.3 N·m", swing(-0.1, 0.2, 0.2));
    TEST_ASSERT_EQUAL_STRING("less than 0.4 N·m", swing(-0.1, 0.2, 0.4));
    TEST_ASSERT_EQUAL_STRING("0.4 N·m", swing(0.0, 0.4, 0.4));
    TEST_ASSERT_EQUAL_STRING("0 N·m", swing(0.3, 0.3, 0.0));
}

static const char *heading(hci_status verdict)
{
    heading_of(&page, verdict, text);
    return text;
}

static void test_headings(void)
{
    page.facts.wanted_Nm = (hci_range){2.0, 2.0009};
    TEST_ASSERT_EQUAL_STRING("2 N·m without ripple", heading(HCI_OK));
    page.facts.wanted_Nm = (hci_range){2.0, 2.0011};
    TEST_ASSERT_EQUAL_STRING("2 N·m with the ripple that was asked for", heading(HCI_OK));
    TEST_ASSERT_EQUAL_STRING("2 N·m, with 0.1 N·m of ripple from peak to peak", heading(HCI_NOT_REACHED));
    solution.within_limits = false;
    TEST_ASSERT_EQUAL_STRING("2 N·m takes more than a limit allows", heading(HCI_NOT_REACHED));
    order[0].verdict = HCI_ORDER_FREE + 1;
    TEST_ASSERT_EQUAL_STRING("2 N·m on average, where 3 N·m was asked for", heading(HCI_NOT_REACHED));
    order[0].verdict = HCI_ORDER_FREE;
    TEST_ASSERT_EQUAL_STRING("2 N·m takes more than a limit allows", heading(HCI_NOT_REACHED));
}

/* A percentage of a mean that is more than a tenth of the ripple, which is not below the tolerance. */
static void test_cells_of_ripple(void)
{
    cell_of_ripple(text, &solution, 0.5, -2.0);
    TEST_ASSERT_EQUAL_STRING("0.5 N·m|25 % of the mean", text);
    cell_of_ripple(text, &solution, 0.5, 0.051);
    TEST_ASSERT_NOT_NULL(strchr(text, '|'));
    cell_of_ripple(text, &solution, 0.5, 0.049);
    TEST_ASSERT_EQUAL_STRING("0.5 N·m", text);
    cell_of_ripple(text, &solution, 9e-4, 2.0);
    TEST_ASSERT_EQUAL_STRING("less than 0.001 N·m", text);
    cell_of_ripple(text, &solution, 1e-3, 2.0); /* it is as much as that */
    TEST_ASSERT_EQUAL_STRING("0.001 N·m|0.05 % of the mean", text);
}

static void known(double bound_Nm)
{
    solution.expected = (hci_expected_ripple){.state = HCI_RIPPLE_KNOWN,
                                              .peak_to_peak_Nm = bound_Nm,
                                              .T_ripple_percent = 50.0 * bound_Nm,
                                              .mean_Nm = 2.0,
                                              .mean_error_Nm = 0.04};
}

static void test_cells_of_a_bound(void)
{
    known(0.2);
    cell_of_bound(text, &page);
    TEST_ASSERT_EQUAL_STRING_LEN("at most 0.2", text, 11);
    TEST_ASSERT_NOT_NULL(strstr(text, " % of the mean (95 %)"));
    TEST_ASSERT_NULL(strstr(text, "in time"));
    solution.expected.if_in_time = true;
    cell_of_bound(text, &page);
    TEST_ASSERT_NOT_NULL(strstr(text, "(95 %), if the torque sensor is in time"));
    order[0].torque_Nm.cosine = 0.01;
    cell_of_bound(text, &page);
    TEST_ASSERT_EQUAL_STRING("not known|bounded by no less than the torque itself", text);
    order[0].torque_Nm.order = 1.0; /* no mean */
    cell_of_bound(text, &page);
    TEST_ASSERT_NOT_NULL(strstr(text, "|95 %"));
    order[0].torque_Nm.order = 0.0, order[0].torque_Nm.cosine = 2.0, solution.tolerance_Nm = 0.3;
    cell_of_bound(text, &page);
    TEST_ASSERT_NOT_NULL(strstr(text, "at most less than"));
    TEST_ASSERT_NOT_NULL(strstr(text, "|95 %"));
}

static void test_cells_of_the_mean(void)
{
    cell_of_mean(text, &solution);
    TEST_ASSERT_EQUAL_STRING("|not known", text);
    known(0.2);
    cell_of_mean(text, &solution);
    TEST_ASSERT_EQUAL_STRING_LEN("2 N·m|at most ", text, 15);
    TEST_ASSERT_NOT_NULL(strstr(text, " off (95 %)"));
    solution.expected.mean_error_Nm = NAN;
    cell_of_mean(text, &solution);
    TEST_ASSERT_EQUAL_STRING("|not known", text);
}

static void test_ratios_have_four_digits(void)
{
    char ratio[HCI_HTML_NUMBER_SIZE];
    hci_page_ratio(ratio, 1.00512);
    TEST_ASSERT_EQUAL_STRING("1.005", ratio);
    TEST_ASSERT_FALSE(hci_page_has_plain(&solution));
    solution.plain_amplitude_A = 0.1;
    TEST_ASSERT_TRUE(hci_page_has_plain(&solution));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_mean);
    RUN_TEST(test_a_swing_below_the_tolerance);
    RUN_TEST(test_headings);
    RUN_TEST(test_cells_of_ripple);
    RUN_TEST(test_cells_of_a_bound);
    RUN_TEST(test_cells_of_the_mean);
    RUN_TEST(test_ratios_have_four_digits);
    return UNITY_END();
}
