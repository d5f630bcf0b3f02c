/* The steps of one wish within limits: what a grid has to keep, when it becomes precise, and which peaks stay
 * rows; numbers on both sides of each bound. */
#include "host/solution/wish.c"

#include "unity.h"

static hci_wishes l;
static hci_bounds bounds;
static hci_limit_point point[4];

/* 5, 4 and 3 A, 40 V, a torque of 2 N·m. */
void setUp(void)
{
    memset(&l, 0, sizeof l);
    bounds = (hci_bounds){.current_A = {5.0, 4.0, 3.0}, .line_V = 40.0};
    l.program.bounds = &bounds;
    l.program.scale_Nm = 2.0;
    l.program.points = (hci_limit_points){.point = point, .count = 0, .room = 4};
    for (size_t q = 0; q < 3; ++q)
        l.program.grid[q] =
            (hci_limit_grid){.kind = HCI_POINT_CURRENT, .phase = (int)q, .step_rad = 0.1 * (double)(q + 1)};
    l.program.grid[3] = (hci_limit_grid){.kind = HCI_POINT_TORQUE, .step_rad = 0.4};
    l.program.grids = 4;
}

void tearDown(void)
{
}

/* Currents and voltages always, ±(limit less 1e-9 of it), wider by as much as all are widened. */
static void test_what_a_current_keeps(void)
{
    const hci_limit_optimum o = {.highest_Nm = 7.0, .lowest_Nm = 6.0};
    const hci_limit_grid voltage = {.kind = HCI_POINT_VOLTAGE};
    double range[2];
    for (int stage = HCI_STAGE_FIT; stage <= HCI_STAGE_COPPER; ++stage) {
        TEST_ASSERT_TRUE(range_of(&l, &l.program.grid[1], (hci_limit_stage)stage, &o, range));
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, 4.0 - 4e-9, range[1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14, -4.0 + 4e-9, range[0]);
        TEST_ASSERT_TRUE(range_of(&l, &voltage, (hci_limit_stage)stage, &o, range));
        TEST_ASSERT_DOUBLE_WITHIN(1e-13, 40.0 - 4e-8, range[1]);
    }
    l.program.widened = 0.25;
    TEST_ASSERT_TRUE(range_of(&l, &l.program.grid[2], HCI_STAGE_FIT, &o, range));
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, 3.75 - 3.75e-9, range[1]);
}

/* The torque only where a ripple is made small, or copper beside a ripple that is left; 1e-7 of it more. */
static void test_what_a_torque_keeps(void)
{
    const hci_limit_optimum o = {.highest_Nm = 0.7, .lowest_Nm = -0.6};
    double range[2];
    for (int has_ripple = 0; has_ripple < 2; ++has_ripple)
        for (int stage = HCI_STAGE_FIT; stage <= HCI_STAGE_COPPER; ++stage) {
            l.program.has_ripple = has_ripple;
            TEST_ASSERT_EQUAL(stage == HCI_STAGE_RIPPLE || (stage == HCI_STAGE_COPPER && !has_ripple),
                              range_of(&l, &l.program.grid[3], (hci_limit_stage)stage, &o, range));
            TEST_ASSERT_DOUBLE_WITHIN(1e-14, 0.7 + 2e-7, range[1]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-14, -0.6 - 2e-7, range[0]);
        }
}

/* A torque that swings by 1e-4 of its size tells nothing of angles. */
static void test_a_flat_torque(void)
{
    TEST_ASSERT_FALSE(tells_angles(&l, &l.program.grid[3], (const double[]){1.0, 1.0 + 1.99e-4}));
    TEST_ASSERT_TRUE(tells_angles(&l, &l.program.grid[3], (const double[]){1.0, 1.0 + 2.01e-4}));
    TEST_ASSERT_TRUE(tells_angles(&l, &l.program.grid[0], (const double[]){1.0, 1.0}));
}

static void test_rounds_and_precision(void)
{
    static const struct {
        bool is_coarse, is_far;
        double radius_A;
        int rounds;
        bool precise;
    } CASES[] = {{false, false, 0.0, 40, false}, {false, false, 0.1, 40, false}, {true, false, 0.0, 2, true},
                 {true, false, 0.1, 1, false},   {true, true, 0.0, 2, false},    {true, true, 0.1, 1, false}};
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        l.is_coarse = CASES[k].is_coarse;
        l.is_far = CASES[k].is_far;
        l.program.radius_A = CASES[k].radius_A;
        TEST_ASSERT_EQUAL_INT(CASES[k].rounds, rounds_of(&l));
        TEST_ASSERT_EQUAL(CASES[k].precise, needs_precision(&l));
    }
}

/* A quarter of the step of its own grid is next to it. */
static void test_points_next_to_each_other(void)
{
    point[0] = (hci_limit_point){HCI_POINT_CURRENT, 1, 1.0, 0.0};
    TEST_ASSERT_EQUAL_DOUBLE(0.2, step_rad(&l.program, &point[0]));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, step_rad(&l.program, &(hci_limit_point){HCI_POINT_VECTOR, 1, 1.0, 0.0}));
    TEST_ASSERT_EQUAL_DOUBLE(0.4, step_rad(&l.program, &(hci_limit_point){HCI_POINT_TORQUE, 0, 1.0, 0.0}));
    static const struct {
        hci_limit_point other;
        bool is_repeated;
    } CASES[] = {{{HCI_POINT_CURRENT, 1, 1.049, 0.0}, true},
                 {{HCI_POINT_CURRENT, 1, 0.951, 0.0}, true},
                 {{HCI_POINT_CURRENT, 1, 1.051, 0.0}, false},
                 {{HCI_POINT_CURRENT, 2, 1.0, 0.0}, false},
                 {{HCI_POINT_VOLTAGE, 1, 1.0, 0.0}, false}};
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        point[1] = (hci_limit_point){HCI_POINT_TORQUE, 0, 1.0, 0.0};
        point[2] = CASES[k].other;
        l.program.points.count = 3;
        TEST_ASSERT_EQUAL(CASES[k].is_repeated, is_repeated(&l.program, 0));
        TEST_ASSERT_FALSE(is_repeated(&l.program, 2)); /* no later one is beside it */
    }
    l.program.points.count = 2;
    TEST_ASSERT_FALSE(is_repeated(&l.program, 0));
}

/* By 1e-5 of the torque, of what is a torque. */
static void test_what_is_still(void)
{
    for (int stage = HCI_STAGE_FIT; stage <= HCI_STAGE_COPPER; ++stage) {
        const bool is_torque = stage == HCI_STAGE_MEAN || stage == HCI_STAGE_RIPPLE;
        TEST_ASSERT_EQUAL(is_torque, is_still(&l, (hci_limit_stage)stage, 1.0, 1.0 + 1.9e-5));
        TEST_ASSERT_EQUAL(is_torque, is_still(&l, (hci_limit_stage)stage, 1.0, 1.0 - 1.9e-5));
        TEST_ASSERT_FALSE(is_still(&l, (hci_limit_stage)stage, 1.0, 1.0 + 2.1e-5));
    }
}

/* Currents of an optimum become those of the wishes. */
static void test_currents_are_taken(void)
{
    hci_limit_optimum o = {.x = hci_memory_new(2, sizeof *o.x)};
    double *x = o.x;
    l.x = hci_memory_new(2, sizeof *l.x);
    TEST_ASSERT_NOT_NULL(x);
    hci_wish_take(&l, &o);
    TEST_ASSERT_EQUAL_PTR(x, l.x);
    TEST_ASSERT_NULL(o.x);
    hci_memory_free(l.x);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_a_current_keeps);
    RUN_TEST(test_what_a_torque_keeps);
    RUN_TEST(test_a_flat_torque);
    RUN_TEST(test_rounds_and_precision);
    RUN_TEST(test_points_next_to_each_other);
    RUN_TEST(test_what_is_still);
    RUN_TEST(test_currents_are_taken);
    return UNITY_END();
}
