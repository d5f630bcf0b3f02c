/* Which orders of averaged turns are kept: waves that are written down here; and which turns have the orders
 * that are given. */
#include "host/waveform/cogging.c"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/waveform/task.h"
#include "support/draws.h"
#include "unity.h"

enum { PASSES = 9, CHANNELS = 2, HIGHEST = 40, CHANNEL = 1 };

static hci_average_pass pass[PASSES];
static hci_average_harmonic wave[PASSES * CHANNELS * (HIGHEST + 1)];
static hci_average average;
static hci_waveform_options options;
static hci_waveform result;
static hci_waveform_task task;

/* Noise in each pass; six passes forward and three backward, of two turns each. */
void setUp(void)
{
    uint64_t seed = 6;
    for (size_t k = 0; k < PASSES; ++k)
        pass[k] = (hci_average_pass){10 * k, 10, k < 6 ? 1 : -1};
    for (size_t k = 0; k < PASSES * CHANNELS * (HIGHEST + 1); ++k)
        wave[k] = (hci_average_harmonic){0.01 * ref_normal(&seed), 0.01 * ref_normal(&seed)};
    average = (hci_average){HIGHEST, CHANNELS, PASSES, 2, pass, wave};
    options = (hci_waveform_options){.pole_pairs = 2, .max_order = NAN, .torque_constant_Nm_per_A = NAN};
    memset(&result, 0, sizeof result);
    task = (hci_waveform_task){.options = &options, .result = &result};
}

void tearDown(void)
{
    hci_memory_free(result.order);
    memset(&result, 0, sizeof result);
}

static void order_add(size_t order, double sine, double cosine)
{
    for (size_t k = 0; k < PASSES; ++k) {
        hci_average_at(&average, k, CHANNEL, order)->sine += sine;
        hci_average_at(&average, k, CHANNEL, order)->cosine += cosine;
    }
}

static void take(double step)
{
    tearDown();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_waveform_take_orders(&task, &average, CHANNEL, step));
}

/* ---- all orders ---- */

/* Each has the estimate of its channel; those of a wave stand out, and no others. */
static void test_all_orders(void)
{
    order_add(6, 0.3, -0.4);
    order_add(17, -0.05, 0.12);
    take(0.5);
    TEST_ASSERT_EQUAL_UINT64(HIGHEST, result.count);
    TEST_ASSERT_EQUAL_UINT64(2, result.kept);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, result.step);
    TEST_ASSERT_TRUE(result.between_turns);
    TEST_ASSERT_EQUAL_UINT64(12, result.turns_forward);
    TEST_ASSERT_EQUAL_UINT64(6, result.turns_backward);
    double largest = 0.0, at = 0.0;
    for (size_t k = 0; k < HIGHEST; ++k) {
        const hci_waveform_order *o = &result.order[k];
        const hci_order_estimate e = hci_average_estimate(&average, CHANNEL, k + 1);
        const double amplitude = hypot(e.mean.sine, e.mean.cosine);
        TEST_ASSERT_EQUAL_DOUBLE(0.5 * (double)(k + 1), o->order);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, amplitude, o->amplitude);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, sin(o->phase_rad - atan2(e.mean.cosine, e.mean.sine)));
        TEST_ASSERT_EQUAL_DOUBLE(e.std_error, o->std_error);
        TEST_ASSERT_EQUAL_DOUBLE(hci_average_chance(&average, CHANNEL, k + 1), o->chance);
        TEST_ASSERT_EQUAL(k + 1 == 6 || k + 1 == 17, o->kept);
        if (o->kept || !(amplitude > largest)) continue;
        largest = amplitude;
        at = o->order;
    }
    TEST_ASSERT_EQUAL_DOUBLE(at, result.largest_left);
}

/* Orders that were fitted to samples in no order count as forward. */
static void test_passes_in_no_order(void)
{
    pass[2].direction = pass[3].direction = 0;
    take(1.0);
    TEST_ASSERT_EQUAL_UINT64(12, result.turns_forward);
    TEST_ASSERT_EQUAL_UINT64(6, result.turns_backward);
    TEST_ASSERT_EQUAL_UINT64(0, result.kept);
}

/* An amplitude that comes and goes is none, three standard errors or not. */
static void test_an_amplitude_that_comes_and_goes(void)
{
    for (size_t k = 0; k < PASSES; ++k)
        hci_average_at(&average, k, CHANNEL, 9)->sine = k % 2 ? 1.0 : 0.1;
    take(0.5);
    const hci_waveform_order *o = &result.order[8];
    TEST_ASSERT_EQUAL(o->chance * HIGHEST < 0.01 && o->amplitude > 3.0 * o->std_error, o->kept);
}

/* A millionth of the largest order is rounding. */
static void test_rounding_is_no_order(void)
{
    memset(wave, 0, sizeof wave);
    order_add(3, 1.0, 0.0);
    order_add(5, 0.0, 0.9e-6);
    order_add(7, 1.1e-6, 0.0);
    take(0.5);
    TEST_ASSERT_TRUE(result.order[2].kept);
    TEST_ASSERT_FALSE(result.order[4].kept);
    TEST_ASSERT_TRUE(result.order[6].kept);
    TEST_ASSERT_EQUAL_DOUBLE(2.5, result.largest_left);
}

/* ---- given orders ---- */

/* Each of them is a multiple of the step, to the tolerance of an order. */
static void test_orders_that_turns_have(void)
{
    static const double FIT[] = {0.5, 2.0, 7.5};
    double orders[3];
    options.orders = orders;
    options.order_count = 3;
    memcpy(orders, FIT, sizeof orders);
    TEST_ASSERT_TRUE(orders_fit(&options, 0.5));
    TEST_ASSERT_FALSE(orders_fit(&options, 1.0));
    for (int k = 0; k < 3; ++k)
        for (int sign = -1; sign <= 1; sign += 2) {
            memcpy(orders, FIT, sizeof orders);
            orders[k] += sign * 0.9 * HCI_ORDER_TOLERANCE;
            TEST_ASSERT_TRUE(orders_fit(&options, 0.5));
            orders[k] += sign * 0.2 * HCI_ORDER_TOLERANCE;
            TEST_ASSERT_FALSE(orders_fit(&options, 0.5));
        }
    options.order_count = 0;
    TEST_ASSERT_TRUE(orders_fit(&options, 0.5));
}

static void test_given_orders(void)
{
    static const double ORDERS[3] = {1.5, 4.0, 19.5};
    options.orders = ORDERS;
    options.order_count = 3;
    take(0.5);
    TEST_ASSERT_EQUAL_UINT64(3, result.count);
    TEST_ASSERT_EQUAL_UINT64(3, result.kept);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, result.largest_left);
    for (size_t k = 0; k < 3; ++k) {
        const size_t at = (size_t)(2.0 * ORDERS[k] + 0.5);
        const hci_order_estimate e = hci_average_estimate(&average, CHANNEL, at);
        TEST_ASSERT_EQUAL_DOUBLE(ORDERS[k], result.order[k].order);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, hypot(e.mean.sine, e.mean.cosine), result.order[k].amplitude);
        TEST_ASSERT_EQUAL_DOUBLE(hci_average_chance(&average, CHANNEL, at), result.order[k].chance);
        TEST_ASSERT_TRUE(result.order[k].kept);
    }
    TEST_ASSERT_EQUAL_STRING("", result.remark.text);
}

/* ---- how far ---- */

/* Sixty are looked at where nothing is asked for; the remark comes where the next order would have been one
 * of them. */
static void test_orders_that_the_samples_do_not_bear(void)
{
    take(1.5);
    TEST_ASSERT_EQUAL_STRING("", result.remark.text);
    take(1.45);
    TEST_ASSERT_EQUAL_STRING(
        "orders above 58 are not looked at: in places of a turn the samples lie too far apart; "
        "--max-order N puts turns together",
        result.remark.text);
    average.count = 3;
    take(1.45);
    TEST_ASSERT_EQUAL_STRING(
        "orders above 58 are not looked at: in places of a turn the samples lie too far apart",
        result.remark.text);
    average.count = PASSES;
    options.max_order = 20.4;
    take(0.5);
    TEST_ASSERT_EQUAL_STRING("", result.remark.text);
    options.max_order = 20.6;
    take(0.5);
    TEST_ASSERT_EQUAL_STRING(
        "orders above 20 are not looked at: in places of a turn the samples lie too far apart",
        result.remark.text);
}

static void test_memory_that_is_out(void)
{
    hci_run run = {.name = NULL};
    hci_note note = {{0}};
    static char name[] = "a.csv";
    static const double ORDERS[1] = {3.0};
    run.name = name;
    task.run = &run;
    task.note = &note;
    for (int given = 0; given < 2; ++given) {
        options.orders = given ? ORDERS : NULL;
        options.order_count = 1;
        hci_memory_fail_after(0);
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, hci_waveform_take_orders(&task, &average, CHANNEL, 0.5));
        hci_memory_fail_after(-1);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_all_orders);
    RUN_TEST(test_passes_in_no_order);
    RUN_TEST(test_an_amplitude_that_comes_and_goes);
    RUN_TEST(test_rounding_is_no_order);
    RUN_TEST(test_orders_that_turns_have);
    RUN_TEST(test_given_orders);
    RUN_TEST(test_orders_that_the_samples_do_not_bear);
    RUN_TEST(test_memory_that_is_out);
    return UNITY_END();
}
