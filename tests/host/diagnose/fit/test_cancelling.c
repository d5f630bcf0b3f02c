/* Terms that make far less together than one by one are not believed, where the recordings do not show them
 * apart. */
#define _XOPEN_SOURCE 700
#include "host/diagnose/fit/cancelling.h"

#include "support/searching.h"

enum { N = 600 };

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

/* Four loads, and i_d as a share of i_q. */
static void record_all(double share)
{
    static const double CURRENT_A[] = {3.0, -6.0, 9.0, -4.0};
    for (size_t r = 0; r < 4; ++r) {
        record(N, &(point){60.0 + 10.0 * (double)r, CURRENT_A[r], 0.0, 0.0, 0.0});
        for (size_t k = 0; k < N; ++k)
            rec_phases(share * CURRENT_A[r], CURRENT_A[r], P * run[r].theta_m_rad[k], run[r].i_A + 3 * k);
    }
    search_start();
    model_fit();
}

static void add_term(const char *effect, const char *parameter, double order, double value)
{
    model_add(effect, parameter, NULL, order);
    for (size_t k = 0; k < model.candidates.count; ++k) {
        hci_candidate *x = &model.candidates.candidate[k];
        if (x->type == hci_effect_type_find(effect) &&
            x->term[0].parameter == parameter_of(x->type, parameter) && fabs(x->term[0].order - order) < 1e-9)
            x->term[0].value = value;
    }
}

static const char *found_to_cancel(void)
{
    const hci_effect_type *type = NULL;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_cancelling_find(&dataset.regression, &model.candidates, &type, &note));
    return type ? type->name : NULL;
}

/* With i_q alone orders 5 and 7 make a torque of order 6, each with its sign. */
static void test_orders_of_the_back_emf_that_cancel(void)
{
    record_all(0.1);
    add_term("back_emf", "sine", 5.0, 0.03);
    add_term("back_emf", "sine", 7.0, 0.029);
    add_term("cogging", "sine", 6.0, 0.02);
    TEST_ASSERT_EQUAL_STRING("back_emf", found_to_cancel());
}

static void test_orders_that_add_up_do_not(void)
{
    record_all(0.1);
    add_term("back_emf", "sine", 5.0, 0.03);
    add_term("back_emf", "sine", 7.0, -0.029);
    TEST_ASSERT_NULL(found_to_cancel());
}

static void test_one_small_one_does_not(void)
{
    record_all(0.1);
    add_term("back_emf", "sine", 5.0, 0.03);
    add_term("back_emf", "sine", 7.0, 0.012);
    TEST_ASSERT_NULL(found_to_cancel());
}

/* An i_d that was varied shows each of them. */
static void test_what_is_told_apart_does_not(void)
{
    record_all(0.6);
    add_term("back_emf", "sine", 5.0, 0.03);
    add_term("back_emf", "sine", 7.0, 0.029);
    TEST_ASSERT_NULL(found_to_cancel());
}

/* Powers of the currents do, as those of any curve. */
static void test_a_series_does_not(void)
{
    record_all(0.1);
    add_term("saturation", "d1q2_cosine", 0.0, 0.003);
    add_term("saturation", "d1q4_cosine", 0.0, -0.00006);
    TEST_ASSERT_NULL(found_to_cancel());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_orders_of_the_back_emf_that_cancel);
    RUN_TEST(test_orders_that_add_up_do_not);
    RUN_TEST(test_one_small_one_does_not);
    RUN_TEST(test_what_is_told_apart_does_not);
    RUN_TEST(test_a_series_does_not);
    return UNITY_END();
}
