/* When a search is over: the user wants it, at any time, or the work is as much as it may be. */
#include "host/diagnose/search/search.h"

#include "unity.h"

static bool asked;
static double work;
static hci_watch watch;
static const hci_attribute_options options;
static hci_regression regression;
static hci_search search;

static bool is_asked(void *context)
{
    return *(const bool *)context;
}

void setUp(void)
{
    asked = false, work = 0.0;
    watch = (hci_watch){.stop = is_asked, .stop_context = &asked};
    regression = (hci_regression){.work = &work, .watch = &watch};
    search = (hci_search){.regression = &regression, .options = &options};
}

void tearDown(void)
{
}

static void test_it_goes_on_while_nothing_ends_it(void)
{
    work = HCI_MOST_WORK;
    TEST_ASSERT_FALSE(hci_search_is_over(&search));
    TEST_ASSERT_FALSE(hci_search_is_interrupted(&search));
    TEST_ASSERT_EQUAL(HCI_WORK_COMPLETE, search.ended);
    regression.watch = NULL, regression.work = NULL;
    TEST_ASSERT_FALSE(hci_search_is_over(&search));
}

static void test_the_work_ends_it_and_is_no_interruption(void)
{
    work = 1.01 * HCI_MOST_WORK;
    TEST_ASSERT_TRUE(hci_search_is_over(&search));
    TEST_ASSERT_EQUAL(HCI_WORK_LIMITED, search.ended);
    TEST_ASSERT_FALSE(hci_search_is_interrupted(&search));
    work = 0.0;
    TEST_ASSERT_TRUE_MESSAGE(hci_search_is_over(&search), "once over it stays so");
}

static void test_the_user_ends_it_and_it_stays_so(void)
{
    asked = true;
    TEST_ASSERT_TRUE(hci_search_is_over(&search));
    asked = false;
    TEST_ASSERT_TRUE(hci_search_is_over(&search));
    TEST_ASSERT_TRUE(hci_search_is_interrupted(&search));
}

/* What is judged after the search takes seconds with thousands of recordings. */
static void test_the_user_is_heard_after_the_limit(void)
{
    work = 2.0 * HCI_MOST_WORK;
    TEST_ASSERT_TRUE(hci_search_is_over(&search));
    asked = true;
    TEST_ASSERT_TRUE(hci_search_is_interrupted(&search));
    TEST_ASSERT_EQUAL(HCI_WORK_INTERRUPTED, search.ended);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_it_goes_on_while_nothing_ends_it);
    RUN_TEST(test_the_work_ends_it_and_is_no_interruption);
    RUN_TEST(test_the_user_ends_it_and_it_stays_so);
    RUN_TEST(test_the_user_is_heard_after_the_limit);
    return UNITY_END();
}
