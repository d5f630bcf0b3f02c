/* Whether a table is written of a model that does not explain the recordings. */
#include "cli/tune/tune_size.h"

#include <math.h>
#include <string.h>

#include "cli/tune/tune_options.h"
#include "hci/machine/frames.h"
#include "unity.h"

enum { SAMPLES = 60, RUNS = 3 };

static cli_tuning tune;
static cli_arguments arguments;
static hci_run run[RUNS];
static hci_run_errors error[RUNS];
static double current[RUNS][3 * SAMPLES];
static char text[1024];

static void record(size_t k, double iq_A, double mean_Nm, double missed_Nm)
{
    run[k] =
        (hci_run){.i_A = current[k], .count = SAMPLES, .pole_pairs = 1, .torque_source = HCI_TORQUE_MEASURED};
    error[k] = (hci_run_errors){
        .source = HCI_TORQUE_MEASURED, .mean_torque_Nm = mean_Nm, .error_mean_after_Nm = missed_Nm};
    for (size_t n = 0; n < SAMPLES; ++n)
        hci_clarke_inverse(hci_park_inverse((hci_dq){0.0, iq_A, 0.0}, 0.1 * (double)n), current[k] + 3 * n);
}

/* No current, and 40 and 30 N·m of which a model misses so much; as a diagnosis that does not explain them.
 */
void setUp(void)
{
    memset(&tune, 0, sizeof tune);
    memset(&arguments, 0, sizeof arguments);
    tune.runs.run = run;
    tune.runs.count = tune.diagnosis.runs = RUNS;
    tune.diagnosis.run = error;
    tune.arguments = &arguments;
    tune.mean_Nm = 35.0;
    tune.is_solved = true;
    tune.reading.run.torque_constant_Nm_per_A = 1.0;
    strcpy(tune.solution.expected.origin.verdict, "partly explained");
    tune.solution.expected.unbelievable_order = NAN;
    record(0, 0.0, 0.0, 99.0);
    record(1, 40.0, 40.0, 12.0);
    record(2, 30.0, 30.0, -9.0);
}

void tearDown(void)
{
}

static bool is_said(const char *words)
{
    return cli_tune_say_excess(&tune, text, sizeof text) && strstr(text, words) != NULL;
}

static void test_no_table_where_means_are_missed(void)
{
    TEST_ASSERT_TRUE(is_said("mean torques under load are 35.4 N·m rms, and it misses them by 11 N·m"));
    TEST_ASSERT_TRUE(is_said("--inductance-d and --inductance-q come first"));
    arguments.given[TUNE_INDUCTANCE_D] = true;
    TEST_ASSERT_FALSE(is_said("--inductance-d"));
    TEST_ASSERT_TRUE(is_said("No table was written"));
}

/* A quarter is the most. */
static void test_a_table_where_few_are_missed(void)
{
    error[1].error_mean_after_Nm = 9.6, error[2].error_mean_after_Nm = 7.6;
    TEST_ASSERT_FALSE(is_said(""));
    error[1].error_mean_after_Nm = 10.4;
    TEST_ASSERT_TRUE(is_said("misses"));
}

/* A model that explains the recordings is asked for its bound, and means that a load of its own makes are not
 * asked. */
static void test_means_of_other_recordings(void)
{
    strcpy(tune.solution.expected.origin.verdict, "explained");
    TEST_ASSERT_FALSE(is_said(""));
    strcpy(tune.solution.expected.origin.verdict, "unknown");
    TEST_ASSERT_TRUE(is_said("misses"));
    error[1].source = error[2].source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_FALSE(is_said(""));
}

static void test_it_is_the_recordings_that_are_not_explained(void)
{
    cli_tune_judge_size(&tune);
    TEST_ASSERT_EQUAL_INT(CLI_TUNE_EXCESS, tune.size);
    TEST_ASSERT_TRUE(cli_tune_is_unexplained(&tune));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_no_table_where_means_are_missed);
    RUN_TEST(test_a_table_where_few_are_missed);
    RUN_TEST(test_means_of_other_recordings);
    RUN_TEST(test_it_is_the_recordings_that_are_not_explained);
    return UNITY_END();
}
