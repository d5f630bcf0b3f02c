/* Which component of a set the best sine is, where the torque is not linear in the current, and when it is
 * looked for. */
#include "host/solution/limited.c"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_the_fundamental(void)
{
    TEST_ASSERT_TRUE(is_fundamental((hci_component){1.0, 1}));
    TEST_ASSERT_TRUE(is_fundamental((hci_component){1.0 + 0.5 * HCI_ORDER_TOLERANCE, 1}));
    TEST_ASSERT_TRUE(is_fundamental((hci_component){1.0 - 0.5 * HCI_ORDER_TOLERANCE, 1}));
    TEST_ASSERT_FALSE(is_fundamental((hci_component){1.0 + 2.0 * HCI_ORDER_TOLERANCE, 1}));
    TEST_ASSERT_FALSE(is_fundamental((hci_component){1.0 - 2.0 * HCI_ORDER_TOLERANCE, 1}));
    TEST_ASSERT_FALSE(is_fundamental((hci_component){1.0, -1}));
    TEST_ASSERT_FALSE(is_fundamental((hci_component){1.0, 0}));
    TEST_ASSERT_FALSE(is_fundamental((hci_component){0.0, 1}));
    TEST_ASSERT_FALSE(is_fundamental((hci_component){5.0, 1}));
}

/* ---- whether another beginning may find more ---- */

/* A salient machine whose mean falls short, with a third of the steps used: what each change of it leaves. */
static hci_component component[] = {{1.0, 1}, {5.0, -1}};
static hci_machine machine;
static hci_task task;
static hci_bounds bounds;
static hci_solution solution;
static hci_wishes wishes;
static hci_limited of;

static void begin(void)
{
    machine = (hci_machine){.slope_count = 1};
    task = (hci_task){.machine = &machine};
    bounds = (hci_bounds){.current_A = {9.0, 9.0, 9.0}, .rms_A = {7.0, 7.0, 7.0}};
    solution = (hci_solution){.limit_cost = HCI_COST_TORQUE};
    of = (hci_limited){.task = &task, .bounds = &bounds, .solution = &solution};
    component[0] = (hci_component){1.0, 1};
    component[1] = (hci_component){5.0, -1};
    wishes = (hci_wishes){.of = &of, .set = {.component = component, .count = 2}, .steps = 40};
}

static void test_when_the_sine_is_another_beginning(void)
{
    static const hci_wave held = {1.0, 1, 2.0, 0.0};
    begin();
    TEST_ASSERT_TRUE(may_find_more(&wishes));
    component[0] = (hci_component){5.0, -1}, component[1] = (hci_component){1.0, 1};
    TEST_ASSERT_TRUE(may_find_more(&wishes)); /* wherever the fundamental stands */
    component[1] = (hci_component){7.0, 1};
    TEST_ASSERT_FALSE(may_find_more(&wishes));
    begin();
    wishes.set.count = 1; /* the sine is what was found */
    TEST_ASSERT_FALSE(may_find_more(&wishes));
    begin();
    task.held = &held;
    TEST_ASSERT_FALSE(may_find_more(&wishes));
    begin();
    machine.slope_count = 0;
    TEST_ASSERT_FALSE(may_find_more(&wishes));
    begin();
    bounds.current_A[2] = 0.0; /* an open phase, which no sine has */
    TEST_ASSERT_FALSE(may_find_more(&wishes));
    begin();
    solution.limit_cost = HCI_COST_RIPPLE; /* the mean is as wanted */
    TEST_ASSERT_FALSE(may_find_more(&wishes));
}

/* 120 steps are the most of all, and a beginning takes 20. */
static void test_steps_for_another_beginning(void)
{
    begin();
    wishes.steps = 100;
    TEST_ASSERT_TRUE(may_find_more(&wishes));
    wishes.steps = 101;
    TEST_ASSERT_FALSE(may_find_more(&wishes));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_fundamental);
    RUN_TEST(test_when_the_sine_is_another_beginning);
    RUN_TEST(test_steps_for_another_beginning);
    return UNITY_END();
}
