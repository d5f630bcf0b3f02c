/* What tune says means that are not explained may come from: a load that alone has an i_d goes before
 * sensors. */
#include "cli/tune/words/tune_heading.c"

#include <math.h>

#include "cli/tune/tune_options.h"
#include "hci/machine/frames.h"
#include "unity.h"

enum { SAMPLES = 200, MOST = 4, POLE_PAIRS = 3 };

static cli_tuning tune;
static cli_arguments arguments;
static hci_run run[MOST];
static double angle[MOST][SAMPLES], current[MOST][3 * SAMPLES];
static char *names[MOST] = {"a.csv", "b.csv", "c.csv", "aside.csv"};
static char cause[CLI_TUNE_CAUSE];

void setUp(void)
{
    memset(&tune, 0, sizeof tune);
    memset(run, 0, sizeof run);
    tune.runs.run = run;
}

void tearDown(void)
{
}

static void record(double id_A, double iq_A)
{
    const size_t n = tune.runs.count++;
    run[n] = (hci_run){.name = names[n],
                       .theta_m_rad = angle[n],
                       .i_A = current[n],
                       .count = SAMPLES,
                       .pole_pairs = POLE_PAIRS,
                       .torque_source = HCI_TORQUE_MEASURED};
    for (size_t k = 0; k < SAMPLES; ++k) {
        angle[n][k] = 2.0 * 3.14159265358979 * (double)k / SAMPLES;
        hci_clarke_inverse(hci_park_inverse((hci_dq){id_A, iq_A, 0.0}, POLE_PAIRS * angle[n][k]),
                           current[n] + 3 * k);
    }
}

static void test_a_load_that_alone_has_an_id(void)
{
    tune.arguments = &arguments;
    arguments.given[TUNE_RUNS] = true;
    record(0.0, 2.0);
    record(0.0, 4.0);
    record(0.0, 6.0);
    TEST_ASSERT_EQUAL_STRING("friction or the zero of the torque sensor is another one from run to run",
                             means_cause(&tune, cause));
    record(-3.0, 4.0);
    TEST_ASSERT_EQUAL_STRING(
        "aside.csv asks by its i_d for what no effect here has, or where friction or the "
        "zero of the torque sensor is another one from run to run",
        means_cause(&tune, cause));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_load_that_alone_has_an_id);
    return UNITY_END();
}
