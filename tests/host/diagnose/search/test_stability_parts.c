/* Runs left out, from normal equations by hand: what is held, what a type is worth, what others tell. */
#include "host/diagnose/search/stability.c"

#include "support/reference.h"
#include "unity.h"

enum { RUNS = 4, COLUMNS = 3, ROWS = 12 };

static uint64_t seed;
static hci_candidate list[3];
static hci_candidates model;
static hci_search search;
static leaving l;
static double x[RUNS][ROWS][COLUMNS], y[RUNS][ROWS];
static double gram[RUNS][COLUMNS * COLUMNS], moment[RUNS][COLUMNS], precision[COLUMNS], held[COLUMNS];
static hci_normal_equations run[RUNS];
static double with[RUNS], without[RUNS];

static bool beyond[RUNS]; /* none is */

static const hci_effect_type *type(const char *name)
{
    return hci_effect_type_find(name);
}

/* Friction of one term, a cogging order of two, and one candidate that is not in. */
void setUp(void)
{
    seed = 8;
    memset(list, 0, sizeof list);
    memset(beyond, 0, sizeof beyond);
    list[0] = (hci_candidate){.type = type("friction"), .count = 1, .in = true, .price = 3.0};
    list[1] = (hci_candidate){.type = type("reluctance"), .count = 2};
    list[2] = (hci_candidate){.type = type("cogging"), .count = 2, .in = true, .price = 5.0};
    list[0].term[0].value = 0.3, list[2].term[0].value = -0.2, list[2].term[1].value = 0.5;
    model = (hci_candidates){.candidate = list, .count = 3};
    search = (hci_search){.whole_coenergy = false};
    for (int r = 0; r < RUNS; ++r) {
        memset(gram[r], 0, sizeof gram[r]);
        memset(moment[r], 0, sizeof moment[r]);
        run[r] = (hci_normal_equations){COLUMNS, gram[r], moment[r], 0.0, ROWS};
        for (int k = 0; k < ROWS; ++k) {
            y[r][k] = ref_normal(&seed);
            run[r].square += y[r][k] * y[r][k];
            for (int c = 0; c < COLUMNS; ++c)
                x[r][k][c] = ref_normal(&seed);
            for (int c = 0; c < COLUMNS; ++c) {
                moment[r][c] += x[r][k][c] * y[r][k];
                for (int d = 0; d < COLUMNS; ++d)
                    gram[r][c * COLUMNS + d] += x[r][k][c] * x[r][k][d];
            }
        }
    }
    precision[0] = 0.5, precision[1] = 0.25, precision[2] = 0.125;
    l = (leaving){.search = &search, .model = &model, .precision = held, .with = with, .without = without};
    l.equations =
        (hci_run_equations){.groups = {run, RUNS}, .run = run, .beyond = beyond, .precision = precision};
}

void tearDown(void)
{
}

static void test_what_is_held(void)
{
    hold(&l, type("cogging"));
    TEST_ASSERT_EQUAL_DOUBLE(0.5, held[0]);
    TEST_ASSERT_FALSE(isfinite(held[1]) || isfinite(held[2]));
    hold(&l, type("friction"));
    TEST_ASSERT_FALSE(isfinite(held[0]));
    TEST_ASSERT_EQUAL_DOUBLE(0.25, held[1]);
    TEST_ASSERT_EQUAL_DOUBLE(0.125, held[2]);
}

static void test_what_a_type_costs(void)
{
    const double one = hci_candidate_cost(&list[0], 100.0), two = hci_candidate_cost(&list[2], 100.0);
    TEST_ASSERT_EQUAL_DOUBLE(one, price_of(&l, type("friction"), 100.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, price_of(&l, type("reluctance"), 100.0));
    list[1].type = type("cogging"), list[1].in = true;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, two + hci_candidate_cost(&list[1], 100.0),
                              price_of(&l, type("cogging"), 100.0));
}

/* The rows less the torque of a type with its values. */
static void test_values_that_are_taken(void)
{
    double square = 0.0, left[COLUMNS] = {0.0};
    for (int k = 0; k < ROWS; ++k) {
        const double rest = y[1][k] + 0.2 * x[1][k][1] - 0.5 * x[1][k][2];
        square += rest * rest;
        for (int c = 0; c < COLUMNS; ++c)
            left[c] += x[1][k][c] * rest;
    }
    values_take(&model, type("cogging"), &run[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, square, run[1].square);
    for (int c = 0; c < COLUMNS; ++c)
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, left[c], moment[1][c]);
    hci_normal_equations copy[RUNS];
    double of_copy[RUNS * COLUMNS], before = run[2].square;
    known_fill(&l, type("friction"), copy, of_copy);
    TEST_ASSERT_EQUAL_DOUBLE(before, run[2].square);
    square = 0.0;
    for (int k = 0; k < ROWS; ++k)
        square += pow(y[2][k] - 0.3 * x[2][k][0], 2.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, square, copy[2].square);
    TEST_ASSERT_EQUAL_PTR(of_copy + 2 * COLUMNS, copy[2].moment);
}

/* As a whole, or as logarithms of the mean squares and a floor of 0.05; the larger of both. */
static void test_what_a_type_is_worth(void)
{
    const bool untold[RUNS] = {false, true, false, false};
    for (int r = 0; r < RUNS; ++r)
        with[r] = 10.0 + r, without[r] = 12.0 + 3.0 * r;
    double sum = 0.0, logs = 0.0;
    for (int r = 0; r < RUNS; ++r) {
        if (r == 1) continue;
        sum += without[r] - with[r];
        logs += ROWS * log((without[r] / ROWS + 0.05) / (with[r] / ROWS + 0.05));
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, fmax(sum, logs), worth_in(&l, untold));
    TEST_ASSERT_TRUE(worth_in(&l, NULL) > worth_in(&l, untold));
    beyond[1] = true; /* a load that the others do not reach is not asked */
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, fmax(sum, logs), worth_in(&l, NULL));
    beyond[1] = false;
    for (int r = 0; r < RUNS; ++r)
        with[r] *= 100.0, without[r] *= 100.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, 100.0 * sum, worth_in(&l, untold));
    with[0] = without[0] = 0.0; /* as good as can be is no better than nearly so */
    without[2] = with[2] = 1.0, without[3] = 2.0, with[3] = 1.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, fmax(1.0, ROWS * log((2.0 / ROWS + 0.05) / (1.0 / ROWS + 0.05))),
                              worth_in(&l, untold));
}

/* Ten times is the border of what others hardly tell. */
static void test_what_others_tell(void)
{
    TEST_ASSERT_TRUE(is_told(1.0, 9.9) && !is_told(1.0, 10.1));
    TEST_ASSERT_TRUE(!tells_alone(3.0, 11.9, 2.0) && tells_alone(3.0, 12.1, 2.0));
    TEST_ASSERT_TRUE(tells_alone(1.0, 2.1, 2.0)); /* the others lose nothing without it */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 7.0, missed_of(3.0, 9.0, 2.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 10.0, missed_of(3.0, 90.0, 2.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, missed_of(1.0, 90.0, 2.0));
}

static void test_promises_are_summed(void)
{
    promises p = {1.0, 2.0, 3};
    with[2] = 9.0, without[2] = 2.0;
    promises_add(&l, 2, 0.8, &p); /* not told */
    TEST_ASSERT_TRUE(p.taken == 1.0 && p.missed == 2.0 && p.told == 3);
    promises_add(&l, 2, 3.0, &p);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0 + run[2].square - 2.0, p.taken);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 + 7.0, p.missed);
    TEST_ASSERT_EQUAL_UINT64(4, p.told);
}

/* Of each run as the others alone fit it, by the sums of all runs. */
static void test_promises_of_all_runs(void)
{
    promises p;
    hci_note note = {{0}};
    double taken = 0.0, missed = 0.0, out[RUNS], in[RUNS];
    TEST_ASSERT_EQUAL_INT(HCI_OK, promises_sum(&l, true, &p, &note));
    TEST_ASSERT_TRUE(hci_left_out_squares(&l.equations.groups, precision, out));
    TEST_ASSERT_TRUE(hci_all_in_squares(&l.equations.groups, precision, in));
    for (int r = 0; r < RUNS; ++r)
        taken += run[r].square - in[r], missed += fmin(out[r] - in[r], 10.0 * fmax(0.0, out[r] - in[r]));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, taken, p.taken);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, missed, p.missed);
    TEST_ASSERT_EQUAL_UINT64(RUNS, p.told);
}

/* Without each run in turn: the fall of the squares with a type against what it costs, in so many rows less.
 */
static void test_what_stays_without_a_run(void)
{
    hci_note note = {{0}};
    hold(&l, type("friction"));
    for (double larger = 0.0; larger < 3.0; larger += 0.5) {
        setUp();
        for (int r = 0; r < RUNS; ++r) /* a friction that grows */
            for (int c = 0; c < COLUMNS; ++c)
                moment[r][c] += larger * gram[r][c];
        for (int r = 0; r < RUNS; ++r)
            run[r].square +=
                2.0 * larger * (moment[r][0] - larger * gram[r][0]) + larger * larger * gram[r][0];
        hold(&l, type("friction"));
        for (size_t out = 0; out < RUNS; ++out) {
            hci_normal_equations left[RUNS - 1];
            double in = 0.0, no = 0.0;
            bool stays = false;
            for (size_t r = 0, k = 0; r < RUNS; ++r)
                if (r != out) left[k++] = run[r];
            const hci_groups others = {left, RUNS - 1};
            TEST_ASSERT_TRUE(hci_all_in_square(&others, precision, &in) &&
                             hci_all_in_square(&others, held, &no));
            TEST_ASSERT_EQUAL_INT(HCI_OK, stays_without(&l, type("friction"), out, &stays, &note));
            TEST_ASSERT_EQUAL(no - in > hci_candidate_cost(&list[0], 3.0 * ROWS), stays);
        }
    }
}

static void test_which_types_are_asked(void)
{
    list[0].type = type("saturation");
    TEST_ASSERT_TRUE(is_asked(&search, &model, type("cogging")) &&
                     is_asked(&search, &model, type("saturation")));
    TEST_ASSERT_FALSE(is_asked(&search, &model, type("reluctance")));
    search.whole_coenergy = true;
    TEST_ASSERT_FALSE(is_asked(&search, &model, type("cogging")));
    list[0].type = type("friction");
    TEST_ASSERT_TRUE(is_asked(&search, &model, type("friction")));
    list[0].type = &hci_empirical_type;
    TEST_ASSERT_FALSE(is_asked(&search, &model, &hci_empirical_type));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_held);
    RUN_TEST(test_what_a_type_costs);
    RUN_TEST(test_values_that_are_taken);
    RUN_TEST(test_what_a_type_is_worth);
    RUN_TEST(test_what_others_tell);
    RUN_TEST(test_promises_are_summed);
    RUN_TEST(test_promises_of_all_runs);
    RUN_TEST(test_what_stays_without_a_run);
    RUN_TEST(test_which_types_are_asked);
    return UNITY_END();
}
