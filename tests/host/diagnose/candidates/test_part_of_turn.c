/* Which recordings over time are parts of a turn, whose orders are not told one by one. */
#include "host/diagnose/candidates/make_candidates.c"

#include "unity.h"

static hci_machine machine;
static hci_run run;
static hci_run_statistics statistics;
static hci_binned_samples samples = {.statistics = &statistics, .run_count = 1};

void setUp(void)
{
}

void tearDown(void)
{
}

static bool is_part(int pole_pairs, double turns, bool timed)
{
    static double time_s[1];
    machine.pole_pairs = pole_pairs;
    statistics.turns = turns;
    run.time_s = timed ? time_s : NULL;
    const hci_candidates_source source = {.machine = &machine, .samples = &samples, .runs = &run};
    return is_part_of_turn(&source, 0);
}

/* From a fiftieth of an electrical period up to nearly a mechanical turn; a list of angles without times is
 * none. */
static void test_parts_of_a_turn(void)
{
    TEST_ASSERT_TRUE(is_part(1, 0.5, true) && is_part(1, 0.021, true) && is_part(1, 0.94, true));
    TEST_ASSERT_FALSE(is_part(1, 0.019, true) || is_part(1, 0.96, true) || is_part(1, 0.5, false));
    TEST_ASSERT_TRUE(is_part(20, 0.0011, true) && is_part(20, 0.94, true));
    TEST_ASSERT_FALSE(is_part(20, 0.0009, true) || is_part(20, 1.5, true));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_parts_of_a_turn);
    return UNITY_END();
}
