/* Runs whose values the others do not tell: one column stands in one run alone, whichever it is. */
#include "host/diagnose/search/stability.c"

#include "support/reference.h"
#include "unity.h"

enum { RUNS = 4, COLUMNS = 2, ROWS = 12 };

static hci_candidate list[2];
static hci_candidates model;
static hci_search search;
static leaving l;
static double gram[RUNS][COLUMNS * COLUMNS], moment[RUNS][COLUMNS], precision[COLUMNS], held[COLUMNS];
static hci_normal_equations run[RUNS];

static const hci_effect_type *type(const char *name)
{
    return hci_effect_type_find(name);
}

void setUp(void)
{
}

void tearDown(void)
{
}

/* Ten noises of a cogging torque in one run alone, and a friction of one in all. */
static bool beyond[RUNS]; /* none is */

static void make(int alone)
{
    uint64_t seed = 8;
    memset(list, 0, sizeof list);
    list[0] = (hci_candidate){.type = type("friction"), .count = 1, .in = true};
    list[1] = (hci_candidate){.type = type("cogging"), .count = 1, .in = true};
    list[0].term[0].value = 1.0;
    model = (hci_candidates){.candidate = list, .count = 2};
    search = (hci_search){.whole_coenergy = false};
    for (int r = 0; r < RUNS; ++r) {
        memset(gram[r], 0, sizeof gram[r]);
        memset(moment[r], 0, sizeof moment[r]);
        run[r] = (hci_normal_equations){COLUMNS, gram[r], moment[r], 0.0, ROWS};
        for (int k = 0; k < ROWS; ++k) {
            const double x[COLUMNS] = {ref_normal(&seed), r == alone ? ref_normal(&seed) : 0.0};
            const double y = x[0] + 10.0 * x[1] + ref_normal(&seed);
            run[r].square += y * y;
            for (int c = 0; c < COLUMNS; ++c) {
                moment[r][c] += x[c] * y;
                for (int d = 0; d < COLUMNS; ++d)
                    gram[r][c * COLUMNS + d] += x[c] * x[d];
            }
        }
    }
    precision[0] = precision[1] = 1e-6;
    l = (leaving){.search = &search, .model = &model, .precision = held};
    l.equations = (hci_run_equations){.groups = {run, RUNS}, .run = run, .beyond = beyond, .precision = precision};
    hold(&l, type("friction"));
}

static void test_a_run_alone_tells_what_stands_in_it(void)
{
    for (int alone = 0; alone < RUNS; ++alone) {
        bool untold[RUNS];
        size_t told = 0;
        hci_note note = {{0}};
        make(alone);
        TEST_ASSERT_EQUAL_INT(HCI_OK, untold_find(&l, type("friction"), untold, &told, &note));
        for (int r = 0; r < RUNS; ++r)
            TEST_ASSERT_EQUAL_INT(r == alone, untold[r]);
        TEST_ASSERT_EQUAL_UINT64(RUNS - 1, told);
    }
}

static void test_runs_with_the_same_columns_tell_each_other(void)
{
    bool untold[RUNS];
    size_t told = 0;
    hci_note note = {{0}};
    make(-1);
    TEST_ASSERT_EQUAL_INT(HCI_OK, untold_find(&l, type("friction"), untold, &told, &note));
    TEST_ASSERT_EQUAL_UINT64(RUNS, told);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_run_alone_tells_what_stands_in_it);
    RUN_TEST(test_runs_with_the_same_columns_tell_each_other);
    return UNITY_END();
}
