/* Sorting against counting, and against an opponent who makes up the items while they are compared, so that
 * every division is as bad as it can be (McIlroy 1999). */
#include "core/math/sort.h"

#include <math.h>
#include <string.h>

#include "support/draws.h"
#include "unity.h"

enum { MOST = 3000 };

static int item[MOST], before[MOST];
static size_t compared, swapped;

static bool comes_after(const void *items, size_t a, size_t b)
{
    const int *x = items;
    TEST_ASSERT_TRUE(a < MOST && b < MOST);
    ++compared;
    return x[a] > x[b];
}

static void swap(void *items, size_t a, size_t b)
{
    int *x = items;
    const int kept = x[a];
    ++swapped;
    x[a] = x[b];
    x[b] = kept;
}

static const hci_sorting ASCENDING = {comes_after, swap};

void setUp(void)
{
    compared = swapped = 0;
}

void tearDown(void)
{
}

static size_t times(const int *x, size_t count, int value)
{
    size_t found = 0;
    for (size_t k = 0; k < count; ++k)
        found += x[k] == value;
    return found;
}

/* In order, the same items as before, and none behind them moved. */
static void check_sorted(size_t count)
{
    memcpy(before, item, sizeof item);
    hci_sort(item, count, &ASCENDING);
    for (size_t k = 1; k < count; ++k)
        TEST_ASSERT_TRUE(item[k - 1] <= item[k]);
    for (size_t k = 0; k < count; ++k)
        if (k == 0 || item[k] != item[k - 1])
            TEST_ASSERT_EQUAL_UINT64(times(before, count, item[k]), times(item, count, item[k]));
    for (size_t k = count; k < MOST; ++k)
        TEST_ASSERT_EQUAL_INT(before[k], item[k]);
}

/* All rows of up to six items of up to six kinds. */
static void test_all_short_rows(void)
{
    for (size_t count = 0; count <= 6; ++count)
        for (int code = 0; code < (int)pow(6.0, (double)count); ++code) {
            for (int k = 0, rest = code; k < 7; ++k, rest /= 6)
                item[k] = rest % 6;
            check_sorted(count);
        }
}

/* Few and many that are the same. */
static void test_rows_of_any_length(void)
{
    uint64_t seed = 5;
    for (size_t count = 0; count < 160; ++count)
        for (int kinds = 1; kinds <= 1000; kinds *= 10)
            for (int trial = 0; trial < 5; ++trial) {
                for (size_t k = 0; k < MOST; ++k)
                    item[k] = ref_integer(&seed, 1, kinds);
                check_sorted(count);
            }
}

/* What is in order already is only looked at. */
static void test_rows_in_order(void)
{
    for (int k = 0; k < MOST; ++k)
        item[k] = k / 3;
    hci_sort(item, MOST, &ASCENDING);
    TEST_ASSERT_EQUAL_UINT64(MOST - 1, compared);
    TEST_ASSERT_EQUAL_UINT64(0, swapped);
}

static double most_comparisons(size_t count)
{
    return 6.0 * (double)count * log2((double)count);
}

/* Rows on which quicksort may do badly: descending, all the same but one, up and down. */
static void test_rows_of_a_pattern(void)
{
    for (int pattern = 0; pattern < 3; ++pattern) {
        for (int k = 0; k < MOST; ++k)
            item[k] = pattern == 0 ? MOST - k : pattern == 1 ? k == MOST - 2 : k < MOST / 2 ? k : MOST - k;
        compared = 0;
        check_sorted(MOST);
        TEST_ASSERT_TRUE((double)compared < most_comparisons(MOST));
    }
}

/* ---- the opponent: items are numbers of values, which are decided as late as can be ---- */

enum { OPEN = MOST };

static int value[MOST], decided, asked;

static int value_of(int x)
{
    return value[x];
}

static bool late(const void *items, size_t a, size_t b)
{
    const int *x = items, p = x[a], q = x[b];
    ++compared;
    if (value[p] == OPEN && value[q] == OPEN) value[p == asked ? p : q] = decided++;
    asked = value[p] == OPEN ? p : value[q] == OPEN ? q : asked;
    return value_of(p) > value_of(q);
}

static const hci_sorting BY_LATE_VALUES = {late, swap};

static void meet_opponent(size_t count, int known)
{
    decided = asked = 0;
    compared = 0;
    for (size_t k = 0; k < count; ++k) {
        item[k] = (int)k;
        value[k] = OPEN;
    }
    for (int k = 1; k <= known; ++k) /* so that it is seen at once not to be in order */
        value[k] = -k;
    hci_sort(item, count, &BY_LATE_VALUES);
    for (size_t k = 1; k < count; ++k)
        TEST_ASSERT_TRUE(value_of(item[k - 1]) <= value_of(item[k]));
}

static void test_opponent(void)
{
    for (size_t count = 13; count <= MOST; count = count * 3 / 2)
        for (int known = 1; known < 5; ++known) {
            meet_opponent(count, known);
            TEST_ASSERT_TRUE((double)compared < most_comparisons(count));
        }
}

/* The row that the opponent made once, and some items in it exchanged: heaps of many shapes. */
static void test_near_the_row_of_the_opponent(void)
{
    static int row[MOST];
    uint64_t seed = 9;
    enum { COUNT = 700 };
    meet_opponent(COUNT, 1);
    memcpy(row, value, sizeof row);
    for (int trial = 0; trial < 60; ++trial) {
        memcpy(item, row, sizeof item);
        for (int k = 0; k < trial; ++k)
            swap(item, (size_t)ref_integer(&seed, 0, COUNT - 1), (size_t)ref_integer(&seed, 0, COUNT - 1));
        compared = 0;
        check_sorted(COUNT);
        TEST_ASSERT_TRUE((double)compared < most_comparisons(COUNT));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_all_short_rows);
    RUN_TEST(test_rows_of_any_length);
    RUN_TEST(test_rows_in_order);
    RUN_TEST(test_rows_of_a_pattern);
    RUN_TEST(test_opponent);
    RUN_TEST(test_near_the_row_of_the_opponent);
    return UNITY_END();
}
