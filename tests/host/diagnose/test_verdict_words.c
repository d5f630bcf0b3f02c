/* What the words say of what is left: causes only where they were looked for and found. */
#include <math.h>
#include <string.h>

#include "hci/host/diagnose/diagnose.h"
#include "unity.h"

static hci_diagnosis d;
static char text[2048];

void setUp(void)
{
    memset(&d, 0, sizeof d);
    d.verdict = HCI_DIAGNOSIS_UNKNOWN;
    d.means_open = d.means_alone = true;
    d.holdout_after_Nm = NAN;
}

void tearDown(void)
{
}

static bool says(const char *words)
{
    hci_diagnosis_words(&d, text, sizeof text);
    return strstr(text, words) != NULL;
}

static void test_means_that_are_off_alone(void)
{
    TEST_ASSERT_TRUE(says("the zero of a sensor is another one each time"));
    TEST_ASSERT_TRUE(says("No known effect explains"));
}

/* A ripple is left too: what the means are off by may be the same. */
static void test_means_beside_a_ripple(void)
{
    d.means_alone = false;
    TEST_ASSERT_FALSE(says("the zero of a sensor"));
    TEST_ASSERT_TRUE(says("says nothing of a run left out"));
}

static void test_an_unfinished_search_gives_no_causes(void)
{
    d.search = HCI_WORK_LIMITED;
    d.wanders = d.contradicted = true;
    d.disbelieved = "back_emf";
    TEST_ASSERT_TRUE(says("is not known yet"));
    TEST_ASSERT_TRUE(says("it gets further with fewer runs"));
    TEST_ASSERT_FALSE(says("No known effect"));
    TEST_ASSERT_FALSE(says("The mean of each run"));
    TEST_ASSERT_FALSE(says("does not repeat"));
    TEST_ASSERT_FALSE(says("nobody would believe"));
}

static void test_what_runs_without_a_current_show(void)
{
    d.verdict = HCI_DIAGNOSIS_PARTLY;
    d.finding[0] = (hci_finding){.effect = "friction", .verdict = HCI_FINDING_ADDED};
    d.findings = 1;
    TEST_ASSERT_FALSE(says("without a current"));
    d.no_load_alone = true;
    TEST_ASSERT_TRUE(
        says("the model lacked friction, which the runs without a current show by themselves; what else"));
    TEST_ASSERT_FALSE(says("Under load"));
    d.holdout_before_Nm = 0.03;
    d.holdout_after_Nm = 0.04;
    TEST_ASSERT_TRUE(says("Under load that does not hold by itself"));
    d.holdout_after_Nm = 0.0301;
    TEST_ASSERT_FALSE(says("Under load"));
}

static void test_zeros_of_sensors(void)
{
    hci_run_errors run[7] = {{0}};
    d.run = run;
    d.runs = 7;
    TEST_ASSERT_FALSE(says("zeros of the sensors"));
    d.zeros_read = 3;
    d.zeros_read_A = 0.123;
    TEST_ASSERT_TRUE(says("In 3 of 7 runs what was read as current, up to 0.12 A, stands still"));
}

static void test_what_was_not_looked_for(void)
{
    TEST_ASSERT_FALSE(says("Direct current"));
    d.magnetic_only = true;
    TEST_ASSERT_TRUE(says("these were not looked for"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_means_that_are_off_alone);
    RUN_TEST(test_means_beside_a_ripple);
    RUN_TEST(test_an_unfinished_search_gives_no_causes);
    RUN_TEST(test_what_runs_without_a_current_show);
    RUN_TEST(test_zeros_of_sensors);
    RUN_TEST(test_what_was_not_looked_for);
    return UNITY_END();
}
