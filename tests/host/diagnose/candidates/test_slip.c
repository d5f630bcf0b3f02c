/* Cogging torque that a slip makes: what is declared, read another way, or nothing of it. */
#include "host/diagnose/candidates/slip.h"

#include <math.h>
#include <string.h>

#include "unity.h"

static const hci_harmonic DECLARED[] = {{6.0, 0.5, 0.2}, {12.0, -0.1, 0.15}};
static const hci_machine MACHINE = {.cogging = DECLARED, .cogging_count = 2};

static hci_candidate candidate[4];
static hci_candidates model;

void setUp(void)
{
    model = (hci_candidates){.candidate = candidate};
}

void tearDown(void)
{
}

/* The model makes this of an order. */
static void show(double order, double sine, double cosine)
{
    hci_candidate *x = &candidate[model.count++];
    const hci_harmonic *a = order == 6.0 ? &DECLARED[0] : order == 12.0 ? &DECLARED[1] : NULL;
    *x = (hci_candidate){.type = hci_effect_type_find("cogging"), .count = 2, .in = true};
    x->term[0] = (hci_effect_term){0, order, sine - (a ? a->sine : 0.0), NAN};
    x->term[1] = (hci_effect_term){1, order, cosine - (a ? a->cosine : 0.0), NAN};
}

/* Both declared orders at θ + δ. */
static void show_ahead(double ahead_rad, double sign, double way)
{
    for (size_t k = 0; k < 2; ++k) {
        const hci_harmonic *a = &DECLARED[k];
        const double amplitude = hypot(a->sine, a->cosine);
        const double phase = atan2(a->cosine, a->sine) + a->order * ahead_rad;
        show(a->order, sign * way * amplitude * cos(phase), sign * amplitude * sin(phase));
    }
}

static const char *slip(void)
{
    return hci_slip_of_cogging(&MACHINE, &model, false);
}

static void is_slip(const char *part)
{
    TEST_ASSERT_NOT_NULL(slip());
    TEST_ASSERT_NOT_NULL(strstr(slip(), part));
}

static void test_another_sign(void)
{
    show_ahead(0.0, -1.0, 1.0);
    is_slip("sign");
}

static void test_the_other_direction(void)
{
    show_ahead(0.0, 1.0, -1.0);
    is_slip("direction");
}

static void test_the_other_direction_from_another_zero(void)
{
    show_ahead(0.9, -1.0, -1.0);
    is_slip("direction");
}

static void test_another_zero(void)
{
    show_ahead(0.4, 1.0, 1.0);
    is_slip("zero");
}

/* That is an effect of the angle, which is looked for. */
static void test_a_little_ahead_is_none(void)
{
    show_ahead(0.05, 1.0, 1.0);
    TEST_ASSERT_NULL(slip());
}

static void test_orders_turned_by_themselves_are_none(void)
{
    show(6.0, -0.5, -0.2);
    show(12.0, 0.3, 0.3);
    TEST_ASSERT_NULL(slip());
}

static void test_nothing_at_its_orders(void)
{
    show(6.0, 0.01, -0.01);
    show(4.0, 0.5, 0.2);
    is_slip("pole pairs");
}

/* Half the pole pairs that are declared: 6 stands at 3, and 12 at 6. */
static void test_half_the_orders(void)
{
    show(3.0, 0.5, 0.2);
    show(6.0, -0.1, 0.15);
    show(12.0, 0.0, 0.0);
    is_slip("in one ratio");
    TEST_ASSERT_NOT_NULL(strstr(hci_slip_of_cogging(&MACHINE, &model, true), "The holding tests"));
}

/* 7 for 6, from another zero. */
static void test_other_orders_from_another_zero(void)
{
    show(7.0, -0.2, 0.5);
    show(14.0, 0.18, 0.0);
    show(6.0, 0.0, 0.0);
    show(12.0, 0.0, 0.0);
    is_slip("in one ratio");
}

/* The declared one stays, and another one of its size comes. */
static void test_beside_the_declared_orders_is_none(void)
{
    show(3.0, 0.5, 0.2);
    TEST_ASSERT_NULL(slip());
}

/* Half of it moves. */
static void test_a_part_of_it_at_another_order_is_none(void)
{
    show(3.0, 0.25, 0.1);
    show(6.0, 0.25, 0.1);
    TEST_ASSERT_NULL(slip());
}

static void test_a_cogging_torque_of_its_own_is_none(void)
{
    show(4.0, 0.5, 0.2);
    show(18.0, 0.1, 0.2);
    TEST_ASSERT_NULL(slip());
}

static void test_another_share_is_none(void)
{
    show(6.0, 1.0, 0.4);
    show(12.0, -0.2, 0.3);
    TEST_ASSERT_NULL(slip());
}

/* A small order says nothing of the others. */
static void test_the_largest_order_decides(void)
{
    show(12.0, 0.0, 0.0);
    TEST_ASSERT_NULL(slip());
}

/* The same of a cogging torque of a thousandth. */
static void test_small_cogging_torques(void)
{
    static const hci_harmonic SMALL[] = {{6.0, 0.5e-3, 0.2e-3}, {12.0, -0.1e-3, 0.15e-3}};
    static const hci_machine TINY = {.cogging = SMALL, .cogging_count = 2};
    show(3.0, 0.5, 0.2);
    show(6.0, -0.1, 0.15);
    show(12.0, 0.0, 0.0);
    for (size_t k = 0; k < model.count; ++k)
        for (int j = 0; j < 2; ++j)
            candidate[k].term[j].value *= 1e-3;
    const char *words = hci_slip_of_cogging(&TINY, &model, false);
    TEST_ASSERT_NOT_NULL(words);
    TEST_ASSERT_NOT_NULL(strstr(words, "in one ratio"));
    model.count = 0;
    show(6.0, 0.0, 0.0);
    show(12.0, 0.0, 0.0);
    show(4.0, 0.5, 0.2);
    for (size_t k = 0; k < model.count; ++k)
        for (int j = 0; j < 2; ++j)
            candidate[k].term[j].value *= 1e-3;
    words = hci_slip_of_cogging(&TINY, &model, true);
    TEST_ASSERT_NOT_NULL(words);
    TEST_ASSERT_NOT_NULL(strstr(words, "The holding tests show nothing at the orders"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_another_sign);
    RUN_TEST(test_the_other_direction);
    RUN_TEST(test_the_other_direction_from_another_zero);
    RUN_TEST(test_another_zero);
    RUN_TEST(test_a_little_ahead_is_none);
    RUN_TEST(test_orders_turned_by_themselves_are_none);
    RUN_TEST(test_nothing_at_its_orders);
    RUN_TEST(test_half_the_orders);
    RUN_TEST(test_other_orders_from_another_zero);
    RUN_TEST(test_beside_the_declared_orders_is_none);
    RUN_TEST(test_a_part_of_it_at_another_order_is_none);
    RUN_TEST(test_a_cogging_torque_of_its_own_is_none);
    RUN_TEST(test_another_share_is_none);
    RUN_TEST(test_the_largest_order_decides);
    RUN_TEST(test_small_cogging_torques);
    return UNITY_END();
}
