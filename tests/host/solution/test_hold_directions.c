/* The circle of a voltage vector as a polygon of 24 sides: its directions are all around, evenly. */
#include "host/solution/hold_least.c"

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* A row limits a direction and its opposite: twelve of them, each 15 degrees. */
static void test_directions_of_the_circle(void)
{
    const hci_bounds bounds = {.modulation = HCI_MODULATION_CIRCLE};
    hci_task task = {.period_turns = 1};
    const hci_limited of = {.bounds = &bounds, .task = &task};
    const hci_hold_question question = {.of = &of};
    const least l = {.q = &question, .angles = 8};
    int met[12] = {0};
    for (int place = 0; place < 3 * DIRECTIONS; ++place) {
        const hci_limit_point at = place_of(&l, place, 5);
        const double steps = at.direction_rad / (HCI_PI / 12.0), whole = floor(steps + 0.5);
        TEST_ASSERT_EQUAL_INT(HCI_POINT_VECTOR, at.kind);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, whole, steps);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * HCI_PI * 5.31 / 8.0, at.theta_rad);
        ++met[((int)whole % 12 + 12) % 12];
    }
    for (int k = 0; k < 12; ++k)
        TEST_ASSERT_EQUAL_INT(1, met[k]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_directions_of_the_circle);
    return UNITY_END();
}
