/* Which orders are worth their voltage, by trying all ways to end them: at each speed the drive is run with
 * each number of orders, and of all sequences of numbers that never rise the one with the least sum of costs
 * is taken. */
#include "host/drive/voltage_fade.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/drive/loop_set.h"
#include "support/reference.h"
#include "unity.h"

enum { SPEEDS = 20, ORDERS = 3 };

static const double FOREVER = 1e9;

/* i_q = 2 A, and orders 6 and 12 of i_q, that take the torque of the fifth and the eleventh harmonic away. */
static const hci_wave EMF[] = {{1.0, 1, 0.12, 0.0}, {5.0, -1, 0.02, 0.0}, {11.0, -1, 0.012, 0.0}};
static const hci_wave WAVES[] = {{1.0, 1, 2.0, 0.0},
                                 {7.0, 1, -0.16, 0.0},
                                 {5.0, -1, 0.16, 0.0},
                                 {13.0, 1, -0.1, 0.0},
                                 {11.0, -1, 0.1, 0.0}};

static hci_machine_data machine, fitted;
static hci_machine_model model;
static hci_drive_data drive;
static hci_loop_set set;
static hci_sampled_drive sampled;
static hci_note note;

/* A level of 0.36 N·m forward or backward with so many waves, and a dc link that ends at some speed. */
static void make(double sign, size_t waves)
{
    hci_wave wave[5];
    for (size_t k = 0; k < waves; ++k)
        wave[k] = (hci_wave){WAVES[k].order, WAVES[k].sequence, sign * WAVES[k].sine, 0.0};
    const hci_loop_level level = {sign * 0.36, wave, waves};
    memset(&machine, 0, sizeof machine);
    memset(&note, 0, sizeof note);
    machine.model.pole_pairs = 2;
    machine.model.back_emf = EMF;
    machine.model.back_emf_count = (waves + 1) / 2;
    machine.resistance_ohm = 0.5;
    machine.inductance_d_H = machine.inductance_q_H = 1e-3;
    hci_drive_init(&drive);
    drive.dc_link_voltage_V = 24.0;
    drive.sample_s = 1e-4;
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_drive_fit(&drive, &machine, &fitted, &note), note.text);
    const hci_loop_task task = {&fitted, &drive, &level, 1, 0.0, 0.0, NULL};
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_loop_set_make(&task, &set, &note), note.text);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_model_make(&fitted, &model, &note), note.text);
    sampled =
        (hci_sampled_drive){&drive, &model, &model, &set.loop,
                            hci_memory_new(hci_loop_floats(&set.loop, HCI_LOOP_FEEDFORWARD), sizeof(float))};
    TEST_ASSERT_NOT_NULL(sampled.memory);
}

void setUp(void)
{
    memset(&set, 0, sizeof set);
    memset(&model, 0, sizeof model);
    memset(&sampled, 0, sizeof sampled);
}

void tearDown(void)
{
    hci_memory_free(sampled.memory);
    hci_machine_model_release(&model);
    hci_loop_set_release(&set);
}

/* The logarithm of ripple by mean with the lowest `kept` orders; given: of the others, as the sampling left
 * them. */
static double cost_of(double speed_rad_per_s, uint32_t kept, const hci_loop_range *given)
{
    const double wanted = (double)set.loop.torque_low_Nm;
    hci_loop_range range[ORDERS];
    hci_loop_f32 loop = set.loop;
    hci_sampled_drive part = sampled;
    for (uint32_t k = 0; k < loop.order_count; ++k)
        range[k] = k < kept ? given[k] : (hci_loop_range){0.0f, 0.0f};
    loop.ranges = range;
    part.loop = &loop;
    const hci_sampled_torque t = hci_sampled_run(&part, speed_rad_per_s);
    const double along = wanted < 0.0 ? -t.mean_Nm : t.mean_Nm;
    return log(fmax(t.ripple_Nm / fmax(along, 0.05 * fabs(wanted)), 1e-3));
}

static double costs[SPEEDS][ORDERS], speeds[SPEEDS];

/* By the number of orders less one. Where the mean alone leaves more than three times the ripple of all, what
 * is between counts as that. */
static void fill_costs(double low, double high, int direction, const hci_loop_range *given)
{
    const int orders = (int)set.loop.order_count;
    for (int j = 0; j < SPEEDS; ++j) {
        speeds[j] = low * pow(high / low, (j + 1.0) / SPEEDS);
        for (int n = 0; n < orders; ++n)
            costs[j][n] = cost_of(direction * speeds[j], (uint32_t)n + 1u, given);
        for (int n = 1; n < orders - 1; ++n)
            if (costs[j][0] - costs[j][orders - 1] > log(3.0)) costs[j][n] = costs[j][0];
    }
}

/* end[n]: at which of the speeds order n is gone; all of end[1] >= end[2] are tried. */
static void best_ends(int end[ORDERS])
{
    const int orders = (int)set.loop.order_count;
    double least = HUGE_VAL;
    for (int first = SPEEDS; first >= 0; --first)
        for (int second = orders > 2 ? first : 0; second >= 0; --second) {
            double sum = 0.0;
            for (int j = 0; j < SPEEDS; ++j)
                sum += costs[j][(j < first) + (orders > 2 && j < second)];
            if (sum < least - 1e-9) least = sum, end[1] = first, end[2] = second;
        }
}

static void check_ends(double from, double low, double high, int direction, const hci_loop_range *given)
{
    int end[ORDERS] = {SPEEDS, SPEEDS, SPEEDS};
    hci_loop_range range[ORDERS];
    memcpy(range, given, sizeof range);
    hci_voltage_fade(&sampled, from, high, direction, range);
    fill_costs(low, high, direction, given);
    best_ends(end);
    TEST_ASSERT_EQUAL_MEMORY(&given[0], &range[0], sizeof given[0]); /* the mean never ends */
    for (uint32_t n = 1; n < set.loop.order_count; ++n) {
        const double whole = end[n] == SPEEDS ? FOREVER : end[n] > 0 ? speeds[end[n] - 1] : from;
        const double none = end[n] == SPEEDS ? FOREVER : speeds[end[n]];
        TEST_ASSERT_EQUAL_FLOAT((float)fmin(whole, (double)given[n].whole_rad_per_s),
                                range[n].whole_rad_per_s);
        TEST_ASSERT_EQUAL_FLOAT((float)fmin(none, (double)given[n].none_rad_per_s), range[n].none_rad_per_s);
    }
    TEST_ASSERT_TRUE(end[1] < SPEEDS || end[2] < SPEEDS); /* there is something to end */
}

static const hci_loop_range NEVER = {1e9f, 1e9f};

/* From a little below the end of the voltage to four times it. */
static void test_orders_end_where_they_cost_more_than_they_bring(void)
{
    for (size_t waves = 3; waves <= 5; waves += 2) {
        const hci_loop_range given[ORDERS] = {NEVER, NEVER, NEVER};
        make(1.0, waves);
        TEST_ASSERT_EQUAL_UINT32(waves == 3 ? 2 : 3, set.loop.order_count);
        const double end = 2.0 * set.voltage_rad_per_s;
        check_ends(end, end, 4.0 * end, 1, given);
        tearDown();
        setUp();
    }
}

/* A torque that drives backward, at speeds that way. */
static void test_backward(void)
{
    const hci_loop_range given[ORDERS] = {NEVER, NEVER, NEVER};
    make(-1.0, 5);
    const double end = 2.0 * set.voltage_rad_per_s;
    check_ends(end, end, 4.0 * end, -1, given);
}

/* What the sampling has ended before ends no later. */
static void test_what_ends_before(void)
{
    make(1.0, 5);
    const double end = 2.0 * set.voltage_rad_per_s;
    const hci_loop_range given[ORDERS] = {NEVER, NEVER, {(float)(0.7 * end), (float)(0.8 * end)}};
    check_ends(end, end, 4.0 * end, 1, given);
}

/* Where the voltage does not do at a standstill, the speeds begin at a 64th of the highest. */
static void test_no_voltage_at_a_standstill(void)
{
    const hci_loop_range given[ORDERS] = {NEVER, NEVER, NEVER};
    make(1.0, 5);
    const double end = 2.0 * set.voltage_rad_per_s;
    check_ends(0.0, 4.0 * end / 64.0, 4.0 * end, 1, given);
}

/* A mean alone, or no speed that is left, ends nothing. */
static void test_nothing_to_end(void)
{
    hci_loop_range range[ORDERS] = {NEVER, NEVER, NEVER};
    make(1.0, 1);
    hci_voltage_fade(&sampled, 10.0, 100.0, 1, range);
    TEST_ASSERT_EQUAL_MEMORY(&NEVER, &range[0], sizeof NEVER);
    tearDown();
    setUp();
    make(1.0, 5);
    hci_voltage_fade(&sampled, 100.0, 100.0, 1, range);
    for (int k = 0; k < ORDERS; ++k)
        TEST_ASSERT_EQUAL_MEMORY(&NEVER, &range[k], sizeof NEVER);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_orders_end_where_they_cost_more_than_they_bring);
    RUN_TEST(test_backward);
    RUN_TEST(test_what_ends_before);
    RUN_TEST(test_no_voltage_at_a_standstill);
    RUN_TEST(test_nothing_to_end);
    return UNITY_END();
}
