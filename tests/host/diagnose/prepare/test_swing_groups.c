/* Swings of several runs that are one: which go together, and with what mean, error and order. */
#include "host/diagnose/prepare/swing_groups.h"

#include <math.h>

#include "unity.h"

enum { RUNS = 5 };

static hci_run_statistics statistics[RUNS];

void setUp(void)
{
    for (int r = 0; r < RUNS; ++r)
        statistics[r] = (hci_run_statistics){.swings = 0};
}

void tearDown(void)
{
}

static void add(int r, double frequency_Hz, double error_Hz, double turn_Hz, double amplitude_Nm)
{
    hci_run_statistics *s = &statistics[r];
    s->swing[s->swings++] =
        (hci_swing){frequency_Hz, error_Hz, turn_Hz, 0.6 * amplitude_Nm, -0.8 * amplitude_Nm};
}

static hci_swing_groups find(void)
{
    return hci_swing_groups_find(statistics, RUNS);
}

static void check(const hci_swing_group *g, bool of_turn, double frequency, double error, size_t runs)
{
    TEST_ASSERT_EQUAL(of_turn, g->of_turn);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12 * frequency, frequency, g->frequency);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * error, error, g->error);
    TEST_ASSERT_EQUAL(runs, g->runs);
}

/* 50 Hz at three speeds, and 3.5 in a turn at two others: weights are 1/error². */
static void test_of_a_frequency_and_of_a_turn(void)
{
    add(0, 50.0, 0.01, 7.0, 1.0);
    add(1, 50.03, 0.02, 11.0, 2.0);
    add(2, 49.99, 0.02, 13.0, 6.0);
    add(3, 35.0, 0.02, 10.0, 1.0);
    add(4, 59.5, 0.017, 17.0, 3.0);
    const hci_swing_groups groups = find();
    TEST_ASSERT_EQUAL(2, groups.count);
    check(&groups.group[0], false, (50.0 + 0.25 * 50.03 + 0.25 * 49.99) / 1.5, 0.01 / sqrt(1.5), 3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0, groups.group[0].amplitude_Nm);
    check(&groups.group[1], true, 3.5, 1.0 / sqrt(500.0 * 500.0 + 1000.0 * 1000.0), 2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, groups.group[1].amplitude_Nm);
}

/* 3 parts in a thousand, or four standard errors of the difference. */
static void test_what_is_of_a_group(void)
{
    const hci_swing_group exact = {false, 100.0, 0.0, 1.0, 1}, rough = {false, 100.0, 0.3, 1.0, 1},
                          of_turn = {true, 5.0, 0.0, 1.0, 1};
    static const struct {
        double frequency, error;
        bool of_exact, of_rough;
    } CASE[] = {{100.29, 0.0, true, true},  {99.71, 0.0, true, true},    {100.31, 0.0, false, true},
                {101.19, 0.0, false, true}, {101.21, 0.0, false, false}, {98.01, 0.4, false, true},
                {98.45, 0.4, true, true},   {101.55, 0.4, true, true},   {102.01, 0.4, false, false}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        const hci_swing x = {CASE[k].frequency, CASE[k].error, 20.0, 0.0, 0.0};
        TEST_ASSERT_EQUAL(CASE[k].of_exact, hci_swing_is_of(&x, &exact));
        TEST_ASSERT_EQUAL(CASE[k].of_rough, hci_swing_is_of(&x, &rough));
        TEST_ASSERT_EQUAL(CASE[k].of_exact, hci_swing_is_of(&x, &of_turn));
    }
}

/* The one of more runs comes first wherever it stands; one that is alone is its own. */
static void test_their_order(void)
{
    add(0, 20.0, 0.01, 7.0, 1.0);
    add(1, 33.0, 0.01, 9.0, 1.0);
    add(2, 33.0, 0.01, 12.3, 1.0);
    const hci_swing_groups groups = find();
    TEST_ASSERT_EQUAL(2, groups.count);
    check(&groups.group[0], false, 33.0, 0.01 / sqrt(2.0), 2);
    check(&groups.group[1], false, 20.0, 0.01, 1);
}

static void test_no_more_than_four(void)
{
    TEST_ASSERT_EQUAL(0, find().count);
    for (int r = 0; r < RUNS; ++r)
        add(r, 10.0 * pow(1.7, r), 0.001, 3.0 + 0.77 * r * r, 1.0);
    TEST_ASSERT_EQUAL(HCI_MOST_SWINGS, find().count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_of_a_frequency_and_of_a_turn);
    RUN_TEST(test_what_is_of_a_group);
    RUN_TEST(test_their_order);
    RUN_TEST(test_no_more_than_four);
    return UNITY_END();
}
