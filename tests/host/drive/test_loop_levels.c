/* Levels of torque of a loop's table: one, two, or an odd number, that ascend by equal steps. */
#include "host/drive/loop_set.c"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static hci_status levels(size_t count, const double *torque_Nm)
{
    hci_loop_level level[5];
    hci_note note = {{0}};
    memset(level, 0, sizeof level);
    for (size_t k = 0; k < count; ++k)
        level[k].torque_Nm = torque_Nm[k];
    const hci_loop_task task = {.levels = level, .level_count = count};
    const maker m = {.task = &task, .note = &note};
    const hci_status status = check_levels(&m);
    TEST_ASSERT_EQUAL_INT(status != HCI_OK, note.text[0] != '\0');
    return status;
}

static void test_which_levels_there_may_be(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, levels(1, (const double[]){-3.0}));
    TEST_ASSERT_EQUAL_INT(HCI_OK, levels(2, (const double[]){-3.0, 4.0}));
    TEST_ASSERT_EQUAL_INT(HCI_OK, levels(3, (const double[]){-3.0, 0.0, 3.0}));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT, levels(4, (const double[]){-3.0, -1.0, 1.0, 3.0}));
}

static void test_they_ascend_evenly(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT, levels(2, (const double[]){4.0, 4.0}));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT, levels(2, (const double[]){4.0, -3.0}));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT, levels(3, (const double[]){3.0, 0.0, -3.0}));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_ARGUMENT, levels(3, (const double[]){-3.0, 0.1, 3.0}));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_which_levels_there_may_be);
    RUN_TEST(test_they_ascend_evenly);
    return UNITY_END();
}
