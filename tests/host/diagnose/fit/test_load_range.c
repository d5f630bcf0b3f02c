/* Which runs have loads that the others do not reach, and whether all lie along one direction. */
#include "host/diagnose/fit/load_range.h"

#include <math.h>
#include <string.h>

#include "unity.h"

enum { MOST_RUNS = 9 };

static hci_run_statistics statistics[MOST_RUNS];
static bool use[MOST_RUNS];
static hci_binned_samples samples;
static hci_regression regression;

void setUp(void)
{
    memset(statistics, 0, sizeof statistics);
    samples = (hci_binned_samples){.statistics = statistics};
    regression = (hci_regression){.samples = &samples, .use = use};
}

void tearDown(void)
{
}

/* A run of one load all along. */
static void add(double id_A, double iq_A)
{
    hci_run_statistics *x = &statistics[samples.run_count];
    x->mean_id_A = id_A;
    x->mean_iq_A = iq_A;
    x->current_A = hypot(id_A, iq_A);
    use[samples.run_count++] = true;
}

static bool beyond(size_t run)
{
    return hci_run_is_beyond(&regression, run);
}

/* Up to a tenth of the largest current beyond the next one counts as reached. */
static void test_the_largest_load_along_one_direction(void)
{
    add(0.0, 0.0);
    add(0.0, 10.0);
    add(0.0, 20.0);
    TEST_ASSERT_TRUE(beyond(2));
    TEST_ASSERT_FALSE(beyond(0));
    TEST_ASSERT_FALSE(beyond(1));
    add(0.0, 18.1);
    TEST_ASSERT_FALSE(beyond(2));
    statistics[3].mean_iq_A = statistics[3].current_A = 17.9;
    TEST_ASSERT_TRUE(beyond(2));
}

/* Between the smallest load and none there is nothing beyond; the only one of another direction is. */
static void test_the_smallest_and_the_opposite(void)
{
    add(0.0, 4.0);
    add(0.0, 10.0);
    add(0.0, 20.0);
    TEST_ASSERT_FALSE(beyond(0));
    add(0.0, -4.0);
    TEST_ASSERT_TRUE(beyond(3));
    add(0.0, -4.0);
    TEST_ASSERT_FALSE(beyond(3));
    use[4] = false;
    TEST_ASSERT_TRUE(beyond(3));
}

/* In the plane: inside of a square of loads nothing is beyond, each of its corners is. */
static void test_a_square_of_loads(void)
{
    for (int k = 0; k < 4; ++k)
        add(k < 2 ? -10.0 : 10.0, k % 2 ? -10.0 : 10.0);
    add(9.2, 9.2); /* 1.1 A behind run 2, of 14.1 */
    add(0.0, -9.0);
    for (size_t k = 0; k < 6; ++k)
        TEST_ASSERT_EQUAL(k != 2 && k < 4, beyond(k));
}

/* What varies has no place, and beside it nobody is beyond. */
static void test_loads_that_vary(void)
{
    add(0.0, 5.0);
    add(0.0, 20.0);
    TEST_ASSERT_TRUE(beyond(1));
    statistics[0].current_A = 5.0 / 0.89;
    TEST_ASSERT_FALSE(beyond(1));
    statistics[0].current_A = 5.0 / 0.91;
    TEST_ASSERT_TRUE(beyond(1));
    statistics[0].is_direct = true;
    TEST_ASSERT_FALSE(beyond(1));
}

/* i_d = -I sin, i_q = I cos of the lead. */
static void add_at(double lead_deg, double most_A)
{
    const double lead_rad = lead_deg * acos(-1.0) / 180.0;
    add(-most_A * sin(lead_rad), most_A * cos(lead_rad));
}

/* Of all loads in use; what is next to no load has no say, nor has one that varies a direction. */
static void test_the_direction_of_all_loads(void)
{
    TEST_ASSERT_TRUE(isnan(hci_load_lead_rad(&regression)));
    add(0.09, 0.0);
    add_at(25.0, 1.0);
    add_at(29.0, 0.5);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 25.0 * acos(-1.0) / 180.0, hci_load_lead_rad(&regression));
    add_at(18.0, 0.7);
    TEST_ASSERT_TRUE(isnan(hci_load_lead_rad(&regression)));
    use[3] = false;
    TEST_ASSERT_FALSE(isnan(hci_load_lead_rad(&regression)));
    add_at(25.0 + 180.0, 0.7);
    TEST_ASSERT_TRUE(isnan(hci_load_lead_rad(&regression)));
    use[4] = false;
    statistics[2].current_A = 0.6;
    TEST_ASSERT_TRUE(isnan(hci_load_lead_rad(&regression)));
}

static void test_directions_on_both_sides_of_half_a_turn(void)
{
    add_at(178.0, 1.0);
    add_at(-179.0, 1.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 178.0 * acos(-1.0) / 180.0, hci_load_lead_rad(&regression));
}

static void test_three_are_asked_at_least(void)
{
    bool marked[5] = {true, false, false, true, false};
    TEST_ASSERT_EQUAL_UINT64(3, hci_asked_count(marked, 5));
    TEST_ASSERT_TRUE(marked[0] && marked[3]);
    TEST_ASSERT_EQUAL_UINT64(4, hci_asked_count(marked, 4));
    TEST_ASSERT_FALSE(marked[0] || marked[3]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_largest_load_along_one_direction);
    RUN_TEST(test_the_smallest_and_the_opposite);
    RUN_TEST(test_a_square_of_loads);
    RUN_TEST(test_loads_that_vary);
    RUN_TEST(test_the_direction_of_all_loads);
    RUN_TEST(test_directions_on_both_sides_of_half_a_turn);
    RUN_TEST(test_three_are_asked_at_least);
    return UNITY_END();
}
