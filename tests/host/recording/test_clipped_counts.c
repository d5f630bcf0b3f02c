/* Rows in which none, one or more of three currents stand at an end of their sensors. */
#include "host/recording/holes.c"

#include "unity.h"

enum { ROWS = 7 };

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_rows_are_counted_by_their_ends(void)
{
    double a[ROWS] = {5.0, 1.0, 5.0, -5.0, 2.0, 5.0, 2.0}, b[ROWS] = {-2.0, 1.0, -5.0, 1.0, 0.0, 0.0, 1.0},
           c[ROWS] = {-2.0, -2.0, 0.0, 3.0, -2.0, 0.0, -2.0};
    bool is_left[ROWS] = {true, true, true, true, true, false, true};
    const rows_task task = {.rows = ROWS, .is_left = is_left};
    clipped_currents x = {.phase = {a, b, c}, .rail = {{-5.0, 5.0}, {-5.0, 5.0}, {-5.0, 5.0}}};
    ends_count(&task, &x);
    TEST_ASSERT_EQUAL_UINT64(2, x.one);
    TEST_ASSERT_EQUAL_UINT64(1, x.several);
    TEST_ASSERT_EQUAL_UINT64(3, x.elsewhere);
    TEST_ASSERT_EQUAL_DOUBLE(1.0 + 1.0, x.sum_one); /* rows 0 and 3 */
    TEST_ASSERT_EQUAL_DOUBLE(1.0, x.sum_other);     /* row 6 */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rows_are_counted_by_their_ends);
    return UNITY_END();
}
