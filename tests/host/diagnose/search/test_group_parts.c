/* The small problem that is cut out of a larger one: how many candidates and columns it holds, and which. */
#include "host/diagnose/search/group_selection.c"

#include "unity.h"

enum { CANDIDATES = 30, WHOLE = 2 * CANDIDATES };

static hci_candidate candidate[CANDIDATES];
static hci_candidates list;
static size_t column[CANDIDATES];
static double number[WHOLE * WHOLE + 2 * WHOLE];
static bool in[WHOLE];
static hci_sweep base;
static hci_selection choice;
static selecting g;
static part p;

/* Candidates of so many terms each; an element of the whole says where it stands. */
static void fill(size_t terms)
{
    memset(candidate, 0, sizeof candidate);
    memset(&p, 0, sizeof p);
    list = (hci_candidates){.candidate = candidate, .count = CANDIDATES};
    for (size_t k = 0; k < CANDIDATES; ++k) {
        candidate[k].count = terms;
        candidate[k].price = (double)k;
        column[k] = terms * k;
    }
    base = sweep_at(number, in, terms * CANDIDATES);
    for (size_t i = 0; i < base.n; ++i) {
        for (size_t j = 0; j < base.n; ++j)
            base.a[i * base.n + j] = 100.0 * (double)i + (double)j;
        base.b[i] = 0.5 + (double)i;
    }
    base.square = 77.0;
    choice = (hci_selection){.list = &list, .column = column, .base = &base, .rows = 1.0};
    g = (selecting){.choice = &choice};
}

void setUp(void)
{
}

void tearDown(void)
{
}

/* Twenty-four candidates, of one or of two terms. */
static void test_as_many_as_there_is_room_for(void)
{
    for (size_t terms = 1; terms <= 2; ++terms) {
        fill(terms);
        for (size_t k = 0; k < CANDIDATES; ++k) {
            part_add(&p, &g, k);
            const size_t count = k + 1 < MOST_ALIKE ? k + 1 : MOST_ALIKE;
            TEST_ASSERT_EQUAL_UINT64(count, p.list.count);
            TEST_ASSERT_EQUAL_UINT64(terms * count, p.columns);
        }
        for (size_t k = 0; k < MOST_ALIKE; ++k) {
            TEST_ASSERT_EQUAL_UINT64(k, p.from[k]);
            TEST_ASSERT_EQUAL_UINT64(terms * k, p.column[k]);
            TEST_ASSERT_EQUAL_DOUBLE((double)k, p.item[k].price);
        }
    }
}

/* Of candidates 4, 7 and 1 the columns 8, 9, 14, 15, 2 and 3. */
static void test_what_is_cut_out(void)
{
    static const size_t FROM[] = {4, 7, 1}, COLUMN[] = {8, 9, 14, 15, 2, 3};
    fill(2);
    for (size_t k = 0; k < 3; ++k)
        part_add(&p, &g, FROM[k]);
    part_fill(&p, &g);
    TEST_ASSERT_EQUAL_UINT64(6, p.columns);
    TEST_ASSERT_EQUAL_UINT64(6, p.base.n);
    TEST_ASSERT_EQUAL_DOUBLE(77.0, p.base.square);
    for (size_t i = 0; i < 6; ++i) {
        TEST_ASSERT_EQUAL_UINT64(COLUMN[i], column_of(&p, &g, i));
        TEST_ASSERT_EQUAL_DOUBLE(0.5 + (double)COLUMN[i], p.base.b[i]);
        for (size_t j = 0; j < 6; ++j)
            TEST_ASSERT_EQUAL_DOUBLE(100.0 * (double)COLUMN[i] + (double)COLUMN[j], p.base.a[i * 6 + j]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_as_many_as_there_is_room_for);
    RUN_TEST(test_what_is_cut_out);
    return UNITY_END();
}
