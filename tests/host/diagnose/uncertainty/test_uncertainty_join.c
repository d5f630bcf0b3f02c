/* Which recordings are left out together: one that another repeats stays with it, as long as three remain. */
#include "host/diagnose/uncertainty/uncertainty.c"

#include "support/reference.h"
#include "unity.h"

enum { TERMS = 2, ROWS = 20, MOST = 6 };

static finding f;
static double unit[TERMS] = {1.0, 1.0};
static size_t of[MOST], group[MOST];

void setUp(void)
{
    memset(&f, 0, sizeof f);
    f.run = of, f.group = group;
    f.terms.unit = unit;
    TEST_ASSERT_TRUE(hci_condensed_start(&f.parts, TERMS, MOST));
}

void tearDown(void)
{
    hci_condensed_release(&f.parts);
    hci_condensed_release(&f.runs);
}

/* A recording that tells a direction at so many degrees. */
static void add(double degrees)
{
    const double c = cos(degrees * REF_PI / 180.0), s = sin(degrees * REF_PI / 180.0);
    double gram[TERMS * TERMS] = {ROWS * c * c, ROWS * c * s, ROWS * c * s, ROWS * s * s};
    double moment[TERMS] = {ROWS * c, ROWS * s};
    const hci_normal_equations normal = {TERMS, gram, moment, 2.0 * ROWS, ROWS};
    TEST_ASSERT_TRUE(hci_condensed_add(&f.parts, &normal, unit));
}

static size_t joined(void)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT(HCI_OK, runs_join(&f, &note));
    return f.runs.count;
}

static void test_repeated_ones_stay_together(void)
{
    for (int k = 0; k < 5; ++k)
        add(30.0 * k);
    add(30.0);
    TEST_ASSERT_EQUAL_UINT64(5, joined());
    TEST_ASSERT_EQUAL_UINT64(group[1], group[5]);
}

/* Three are just enough. */
static void test_three_remain(void)
{
    for (int k = 0; k < 3; ++k)
        add(60.0 * k);
    add(0.0);
    TEST_ASSERT_EQUAL_UINT64(3, joined());
    TEST_ASSERT_EQUAL_UINT64(group[0], group[3]);
}

/* Where two would remain nothing could be left out, and each stands by itself. */
static void test_two_would_remain(void)
{
    for (int k = 0; k < 4; ++k)
        add(k % 2 ? 90.0 : 0.0);
    TEST_ASSERT_EQUAL_UINT64(4, joined());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_repeated_ones_stay_together);
    RUN_TEST(test_three_remain);
    RUN_TEST(test_two_would_remain);
    return UNITY_END();
}
