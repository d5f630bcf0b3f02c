/* A search that ends before all has been compared: whenever that is, what has been found until then is a
 * whole result that says so. */
#include <string.h>

#include "host/diagnose/search/search.h"
#include "support/diagnosing.h"

enum { N = 600 };

static long asked, until, open_since; /* when what is left open was told of first */

void setUp(void)
{
    dataset_start();
    asked = 0;
    until = open_since = -1;
}

void tearDown(void)
{
    dataset_end();
}

static bool stop(void *context)
{
    TEST_ASSERT_EQUAL_PTR(&asked, context);
    return asked++ >= until && until >= 0;
}

/* Once the search is over. */
static bool stop_judging(void *context)
{
    (void)context;
    return diagnosis.resolution_Nm > 0.0;
}

static void tell(void *context, const char *what, double share)
{
    TEST_ASSERT_EQUAL_PTR(&asked, context);
    TEST_ASSERT_TRUE(share >= 0.0 && share <= 1.0);
    if (strcmp(what, "looking at what is left open") == 0 && open_since < 0) open_since = asked;
}

/* Friction and cogging torque that the machine does not declare. */
static void record_all(void)
{
    for (size_t r = 0; r < 4; ++r) {
        const bool back = r % 2 == 1;
        record(N, &(point){back ? -150.0 : 60.0, 3.0 * (double)r, 0.0, back ? -0.04 : 0.04, 0.0});
        for (size_t k = 0; k < N; ++k)
            run[r].torque_Nm[k] += 0.05 * sin(6.0 * P * run[r].theta_m_rad[k]);
    }
    options.stop = stop;
    options.stop_context = &asked;
    options.progress = tell;
    options.progress_context = &asked;
}

static bool says(const char *text)
{
    char words[2048];
    hci_diagnosis_words(&diagnosis, words, sizeof words);
    return strstr(words, text) != NULL;
}

static void test_until_the_end(void)
{
    record_all();
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    TEST_ASSERT_TRUE(asked > 10);
    TEST_ASSERT_EQUAL_INT(HCI_WORK_COMPLETE, diagnosis.search);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("cogging")->verdict);
    TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("friction")->verdict);
    TEST_ASSERT_FALSE(says("interrupted"));
    TEST_ASSERT_TRUE(diagnosis.uncertainty.machines > 0);
}

static void test_at_any_time(void)
{
    double last_Nm = INFINITY;
    record_all();
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    const long all = asked;
    const double end_Nm = diagnosis.rms_after_Nm;
    for (long k = 0; k < all; k = 2 * k + 1) {
        asked = 0;
        until = k;
        TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
        TEST_ASSERT_EQUAL_INT64(k + 1, asked); /* once it is over nothing more is asked */
        TEST_ASSERT_EQUAL_INT(HCI_WORK_INTERRUPTED, diagnosis.search);
        TEST_ASSERT_EQUAL_UINT64(4, diagnosis.runs);
        TEST_ASSERT_TRUE(diagnosis.rms_after_Nm <= 1.001 * last_Nm);
        TEST_ASSERT_TRUE(says("interrupted"));
        TEST_ASSERT_EQUAL_UINT64(0, diagnosis.uncertainty.machines); /* nothing is promised */
        last_Nm = diagnosis.rms_after_Nm;
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * end_Nm, end_Nm, last_Nm);
}

/* The effects are all known then: they stay, nothing is promised of what is left open. */
static void test_while_looking_at_what_is_left_open(void)
{
    record_all();
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(NULL));
    const long first = open_since, all = asked;
    const double end_Nm = diagnosis.rms_after_Nm;
    TEST_ASSERT_TRUE(first > 0 && all > first + 10);
    for (until = first - 1; until < all; until += (all - first) / 4) { /* asked before it is told */
        asked = 0;
        TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
        TEST_ASSERT_EQUAL_INT64(until + 1, asked);
        TEST_ASSERT_EQUAL_INT(HCI_WORK_INTERRUPTED, diagnosis.search);
        TEST_ASSERT_EQUAL_UINT64(0, diagnosis.uncertainty.machines);
        TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("cogging")->verdict);
        TEST_ASSERT_EQUAL_INT(HCI_FINDING_ADDED, found("friction")->verdict);
        TEST_ASSERT_EQUAL_DOUBLE(end_Nm, diagnosis.rms_after_Nm);
    }
}

/* After the search, where something is unknown and so nothing is left open: fits of what stays may have been
 * cut short. */
static void test_while_it_is_judged(void)
{
    for (size_t r = 0; r < 2; ++r)
        record(N / 2, &(point){60.0, 0.0, 0.0, 0.0, 0.1});
    options.stop = stop_judging;
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, diagnose(NULL));
    TEST_ASSERT_EQUAL_INT(HCI_WORK_INTERRUPTED, diagnosis.search);
    TEST_ASSERT_TRUE(says("interrupted"));
}

static void test_a_limit_of_work(void)
{
    double work = 0.0;
    hci_regression regression = {.work = &work};
    const hci_attribute_options how = {.runs = run};
    hci_search search = {.regression = &regression, .options = &how};
    TEST_ASSERT_FALSE(hci_search_is_over(&search));
    hci_regression_count(&regression, 1000000000, 100);
    TEST_ASSERT_TRUE(work > 1e9 * 100.0);
    TEST_ASSERT_TRUE(hci_search_is_over(&search));
    TEST_ASSERT_EQUAL_INT(HCI_WORK_LIMITED, search.ended);
    work = 0.0;
    TEST_ASSERT_TRUE(hci_search_is_over(&search));
    diagnosis.search = search.ended;
    TEST_ASSERT_TRUE(says("limit"));
    TEST_ASSERT_EQUAL_STRING("limited", hci_diagnosis_search_name(diagnosis.search));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_until_the_end);
    RUN_TEST(test_at_any_time);
    RUN_TEST(test_while_looking_at_what_is_left_open);
    RUN_TEST(test_while_it_is_judged);
    RUN_TEST(test_a_limit_of_work);
    return UNITY_END();
}
