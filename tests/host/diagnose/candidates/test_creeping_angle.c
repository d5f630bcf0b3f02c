/* An angle that falls behind the motor: declared cogging torque comes no whole number of times in its turn.
 */
#include "host/diagnose/candidates/creeping_angle.h"

#include <string.h>

#include "unity.h"

enum { RUNS = 3, P = 4 };

static const hci_harmonic COGGING[] = {{6.0, 0.18, 0.24}};
static hci_run_statistics statistics[RUNS];

void setUp(void)
{
    memset(statistics, 0, sizeof statistics);
}

void tearDown(void)
{
}

/* One swing in each of so many runs, of so many periods in a turn. */
static const char *words_of(size_t runs, double per_turn, double error, double amplitude_Nm)
{
    const hci_machine machine = {.pole_pairs = P, .cogging = COGGING, .cogging_count = 1};
    for (size_t r = 0; r < runs; ++r) {
        const double turn_Hz = 2.0 + 1.3 * (double)r;
        statistics[r].swing[0] = (hci_swing){.frequency_Hz = per_turn * turn_Hz,
                                             .error_Hz = error * turn_Hz,
                                             .turn_Hz = turn_Hz,
                                             .cosine_Nm = amplitude_Nm};
        statistics[r].swings = 1;
    }
    return hci_creeping_angle(&machine, statistics, RUNS);
}

static void test_counts_that_are_lost(void)
{
    TEST_ASSERT_NOT_NULL(words_of(RUNS, 24.0 / 0.996, 1e-3, 0.3));
    setUp();
    TEST_ASSERT_NOT_NULL(words_of(2, 24.0 * 0.995, 1e-3, 0.25));
}

/* What comes as often as declared, has another size, is far from every order, or in one run, is none. */
static void test_what_is_no_creeping(void)
{
    TEST_ASSERT_NULL(words_of(RUNS, 24.001, 1e-3, 0.3));
    setUp();
    TEST_ASSERT_NULL(words_of(RUNS, 24.0 / 0.996, 1e-3, 0.05));
    setUp();
    TEST_ASSERT_NULL(words_of(RUNS, 26.3, 1e-3, 0.3));
    setUp();
    TEST_ASSERT_NULL(words_of(1, 24.0 / 0.996, 1e-3, 0.3));
    setUp();
    TEST_ASSERT_NULL(words_of(0, 24.0, 1e-3, 0.3));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_counts_that_are_lost);
    RUN_TEST(test_what_is_no_creeping);
    return UNITY_END();
}
