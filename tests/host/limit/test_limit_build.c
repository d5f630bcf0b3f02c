/* Rows of a program whose memory is out. */
#include "host/limit/build.h"

#include <stdint.h>
#include <string.h>

#include "host/base/memory.h"
#include "unity.h"

static hci_limit_build build;

void setUp(void)
{
    memset(&build, 0, sizeof build);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_limit_build_release(&build);
}

static void test_rows_are_zeros_and_are_kept(void)
{
    build.width = 3;
    for (size_t k = 0; k < 1000; ++k) {
        double *row = hci_limit_row_add(&build);
        TEST_ASSERT_NOT_NULL(row);
        for (size_t j = 0; j < build.width; ++j)
            TEST_ASSERT_EQUAL_DOUBLE(0.0, row[j]);
        row[1] = (double)k;
    }
    TEST_ASSERT_EQUAL_UINT64(1000, build.rows);
    for (size_t k = 0; k < 1000; ++k)
        TEST_ASSERT_EQUAL_DOUBLE((double)k, build.row[3 * k + 1]);
}

/* Rows are the largest part: they may find no room where all else does. */
static void test_rows_alone_find_no_room(void)
{
    build.width = SIZE_MAX / 128; /* 64 rows have more bytes than there are addresses */
    TEST_ASSERT_NULL(hci_limit_row_add(&build));
    TEST_ASSERT_TRUE(build.is_full);
    TEST_ASSERT_EQUAL_UINT64(0, build.rows);
}

static void test_each_part_may_find_no_room(void)
{
    for (int k = 0; k < 5; ++k) {
        build.width = 3;
        hci_memory_fail_after(k);
        TEST_ASSERT_NULL(hci_limit_row_add(&build));
        hci_memory_fail_after(-1);
        TEST_ASSERT_NULL(hci_limit_row_add(&build)); /* once out, the program is not used */
        tearDown();
        setUp();
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rows_are_zeros_and_are_kept);
    RUN_TEST(test_rows_alone_find_no_room);
    RUN_TEST(test_each_part_may_find_no_room);
    return UNITY_END();
}
