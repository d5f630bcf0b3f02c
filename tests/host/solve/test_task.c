/* The period after which everything repeats: each order counts, wherever it stands; and the orders of
 * currents that are found at each angle of it. */
#include "host/solve/pointwise.h"
#include "host/solve/task.h"

#include <math.h>
#include <string.h>

#include "unity.h"

enum { PLACES = 6 };

static hci_machine machine;
static hci_wave emf[3], wave[3];
static hci_harmonic cogging[3];
static hci_inductance_slope slope[3];
static hci_target_order wanted[3];
static hci_component component[3];
static hci_component_set set;
static hci_target target;
static hci_task task;

/* Three of everything, all of whole orders. */
void setUp(void)
{
    for (int k = 0; k < 3; ++k) {
        emf[k] = (hci_wave){1.0 + 2.0 * k, 1, 0.1, 0.0};
        wave[k] = (hci_wave){1.0 + 4.0 * k, 1, 0.1, 0.0};
        cogging[k] = (hci_harmonic){.order = 6.0 * k + 6.0};
        memset(&slope[k], 0, sizeof slope[k]);
        slope[k].order = 2.0 * k;
        wanted[k].torque_Nm.order = 6.0 * k;
        component[k] = (hci_component){.order = 5.0 + 2.0 * k, .sequence = 1};
    }
    machine = (hci_machine){.pole_pairs = 4,
                            .back_emf = emf,
                            .back_emf_count = 3,
                            .cogging = cogging,
                            .cogging_count = 3,
                            .slope = slope,
                            .slope_count = 3};
    target = (hci_target){.order = wanted, .count = 3};
    set = (hci_component_set){.component = component, .count = 3};
    memset(&task, 0, sizeof task);
    task.machine = &machine;
    task.target = &target;
}

void tearDown(void)
{
}

static size_t period(void)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_task_find_period(&task, &set, wave, 3, &note), note.text);
    return task.period_turns;
}

static double *order_at(int place, size_t k)
{
    double *const order[PLACES] = {&emf[k].order,  &cogging[k].order,          &slope[k].order,
                                   &wave[k].order, &wanted[k].torque_Nm.order, &component[k].order};
    return order[place];
}

static void test_whole_orders_repeat_after_a_turn(void)
{
    TEST_ASSERT_EQUAL_UINT64(1, period());
    TEST_ASSERT_EQUAL(HCI_OK, hci_task_find_period(&task, NULL, NULL, 0, NULL));
    TEST_ASSERT_EQUAL_UINT64(1, task.period_turns);
}

/* A half in any of eighteen places, first, in between and last. */
static void test_one_half_makes_two_turns(void)
{
    for (int place = 0; place < PLACES; ++place)
        for (size_t k = 0; k < 3; ++k) {
            *order_at(place, k) += 0.5;
            TEST_ASSERT_EQUAL_UINT64(2, period());
            *order_at(place, k) -= 0.5;
        }
}

/* A half here and a third there; a quarter that is written to seven digits. */
static void test_the_least_common_period(void)
{
    for (int place = 0; place + 1 < PLACES; ++place) {
        *order_at(place, 0) += 0.5;
        *order_at(place + 1, 2) += 0.3333333;
        TEST_ASSERT_EQUAL_UINT64(6, period());
        *order_at(place, 0) -= 0.5;
        *order_at(place + 1, 2) -= 0.3333333;
    }
}

static void test_orders_without_a_common_period(void)
{
    hci_note note = {{0}};
    for (size_t k = 0; k < 3; ++k) { /* one alone is nearly whole after some hundred turns */
        wave[k].order = sqrt(2.0 + (double)k);
        cogging[k].order = sqrt(17.0 + (double)k);
    }
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_task_find_period(&task, &set, wave, 3, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "the orders have no common period"));
}

/* 1/n is as good as whole after the fewest turns above 1/(1/n + the tolerance): 4095.2 and 4096.2. */
static void test_how_many_turns_at_most(void)
{
    wave[0].order = 1.0 + 1.0 / 4112.0;
    TEST_ASSERT_EQUAL_UINT64(4096, period());
    wave[0].order = 1.0 + 1.0 / 4113.0;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_task_find_period(&task, &set, wave, 3, NULL));
}

/* How far from whole an order may be after some turns goes by these. */
static void test_how_exact_an_order_is(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        wave[1].order = 5.0 + sign * 0.9 * HCI_ORDER_TOLERANCE;
        TEST_ASSERT_EQUAL_UINT64(1, period());
        wave[1].order = 5.0 + 1.0 / 3.0 + sign * 0.9 * HCI_ORDER_TOLERANCE;
        TEST_ASSERT_EQUAL_UINT64(3, period());
        wave[1].order = 5.0 + sign * 1.1 * HCI_ORDER_TOLERANCE;
        const bool has = hci_task_find_period(&task, &set, wave, 3, NULL) == HCI_OK;
        TEST_ASSERT_TRUE(!has || task.period_turns > 1);
        wave[1].order = 5.0;
    }
}

/* ---- what a task is made of ---- */

static void test_a_task_of_a_model(void)
{
    hci_quadratic_model model;
    hci_effects effects = {NULL, 0};
    memset(&model, 0, sizeof model);
    memset(&task, 7, sizeof task);
    model.machine = machine;
    hci_task_begin(&model, &target, &task);
    TEST_ASSERT_EQUAL_PTR(&model.machine, task.machine);
    TEST_ASSERT_EQUAL_PTR(&target, task.target);
    TEST_ASSERT_EQUAL_PTR(emf, task.gradient);
    TEST_ASSERT_EQUAL_UINT64(3, task.gradient_count);
    TEST_ASSERT_NULL(task.higher);
    TEST_ASSERT_TRUE(!task.stop && !task.progress && !task.held && !task.has_neutral);
    TEST_ASSERT_FALSE(hci_task_is_linear(&task)); /* inductances vary along the angle */
    model.machine.slope_count = 0;
    TEST_ASSERT_TRUE(hci_task_is_linear(&task));
    model.higher.effects = &effects;
    hci_task_begin(&model, &target, &task);
    TEST_ASSERT_EQUAL_PTR(&model.higher, task.higher);
    TEST_ASSERT_FALSE(hci_task_is_linear(&task));
}

static bool stop_when(void *context)
{
    return *(const bool *)context;
}

static void test_a_task_that_is_stopped(void)
{
    hci_note note = {{0}};
    bool stopped = false;
    TEST_ASSERT_EQUAL(HCI_OK, hci_task_goes_on(&task, &note));
    task.stop = stop_when;
    task.stop_context = &stopped;
    TEST_ASSERT_EQUAL(HCI_OK, hci_task_goes_on(&task, &note));
    TEST_ASSERT_EQUAL_STRING("", note.text);
    stopped = true;
    TEST_ASSERT_EQUAL(HCI_ERROR_STOPPED, hci_task_goes_on(&task, &note));
    TEST_ASSERT_EQUAL_STRING("solving was stopped before there was a result", note.text);
}

static void test_the_temperature_of_magnets(void)
{
    hci_solve_options options = {.at_temperature = true, .temperature_C = 63.5};
    TEST_ASSERT_EQUAL_DOUBLE(63.5, hci_magnet_temperature_C(&options));
    options.at_temperature = false;
    TEST_ASSERT_TRUE(isnan(hci_magnet_temperature_C(&options)));
}

/* A sinusoidal back-EMF of 0.1 V·s/rad makes cos 511θ of i = T e/(e·e): 0.2/0.15 (sin 512θ − sin 510θ)/2 A
 * per 0.2 N·m. Orders up to 512 are taken, of as many turns as there are. */
static void test_orders_found_at_each_angle(void)
{
    const double half_A = 0.5 * 0.2 / 0.15;
    machine = (hci_machine){.pole_pairs = 4, .back_emf = emf, .back_emf_count = 1};
    wanted[0] = (hci_target_order){{0.0, 0.0, 3.0}, 1.0};
    wanted[1] = (hci_target_order){{511.0, 0.0, 0.2}, 1.0};
    target.count = 2;
    for (task.period_turns = 1; task.period_turns <= 3; ++task.period_turns) {
        const size_t top = 512 * task.period_turns, below = 510 * task.period_turns;
        hci_answer answer = {0};
        hci_solution solution = {0};
        TEST_ASSERT_EQUAL(HCI_OK, hci_pointwise_answer(&task, &answer, &solution, NULL));
        TEST_ASSERT_EQUAL_UINT64(3 * (top + 1), answer.set.count);
        TEST_ASSERT_EQUAL_DOUBLE(512.0, answer.set.component[answer.set.count - 1].order);
        const double *rest = answer.x + 2 * answer.set.count; /* sine and cosine of each component */
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, half_A, rest[2 * (3 * top)]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, -half_A, rest[2 * (3 * below + 1)]);
        hci_answer_release(&answer);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_whole_orders_repeat_after_a_turn);
    RUN_TEST(test_one_half_makes_two_turns);
    RUN_TEST(test_the_least_common_period);
    RUN_TEST(test_orders_without_a_common_period);
    RUN_TEST(test_how_many_turns_at_most);
    RUN_TEST(test_how_exact_an_order_is);
    RUN_TEST(test_a_task_of_a_model);
    RUN_TEST(test_a_task_that_is_stopped);
    RUN_TEST(test_the_temperature_of_magnets);
    RUN_TEST(test_orders_found_at_each_angle);
    return UNITY_END();
}
