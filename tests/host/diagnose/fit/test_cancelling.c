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

/* The same with a share of its own for each load. */
static void record_each(const double share[4])
{
    static const double CURRENT_A[] = {1.0, 5.0, 7.0, 9.0};
    for (size_t r = 0; r < 4; ++r) {
        record(N, &(point){60.0 + 10.0 * (double)r, CURRENT_A[r], 0.0, 0.0, 0.0});
        for (size_t k = 0; k < N; ++k)
            rec_phases(share[r] * CURRENT_A[r], CURRENT_A[r], P * run[r].theta_m_rad[k], run[r].i_A + 3 * k);
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

/* Terms that are next to nothing as well, and they say nothing where they do not. */
static void test_cancelling_has_no_size(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        record_all(0.1);
        add_term("back_emf", "sine", 5.0, 3e-7);
        add_term("back_emf", "sine", 7.0, sign * 2.9e-7);
        const char *found = found_to_cancel();
        TEST_ASSERT_EQUAL_STRING(sign > 0 ? "back_emf" : "none", found ? found : "none");
        tearDown();
        setUp();
    }
}

/* An i_d that was varied shows each of them. */
static void test_what_is_told_apart_does_not(void)
{
    record_all(0.6);
    add_term("back_emf", "sine", 5.0, 0.03);
    add_term("back_emf", "sine", 7.0, 0.029);
    TEST_ASSERT_NULL(found_to_cancel());
}

/* L_dd, L_qq and L_dq of order n at i_d = r i_q, but for a factor: sin nθ of the torque has −n/2 (r² L_dd +
 * L_qq) + (1 − r²) L_dq, and cos nθ has r (L_dd − L_qq + n L_dq). Both are 0 but for a thirtieth. */
static void add_inductances(double r, double n)
{
    const double qq = (2.0 * (1.0 - r * r) / n + n * r * r) / (1.0 + r * r);
    add_term("reluctance", "dd_cosine", n, 1e-3 * (qq - n));
    add_term("reluctance", "qq_cosine", n, 1e-3 * qq);
    add_term("reluctance", "dq_sine", n, 1.03e-3);
}

/* Along one direction, or several that go over into each other, that says nothing; beside a load in another
 * one, and with i_q alone, it does. */
static void test_inductances_along_a_curve_are_not_asked(void)
{
    static const double SHARE[][4] = {
        {-0.5, -0.5, -0.5, -0.5}, {-0.45, -0.49, -0.5, -0.51}, {0.5, -0.5, -0.5, -0.5}, {0.0, 0.0, 0.0, 0.0}};
    static const char *const FOUND[] = {NULL, NULL, "reluctance", "reluctance"};
    for (int k = 0; k < 4; ++k) {
        record_each(SHARE[k]);
        add_inductances(SHARE[k][3], 6.0);
        const char *found = found_to_cancel();
        TEST_ASSERT_EQUAL_STRING(FOUND[k] ? FOUND[k] : "none", found ? found : "none");
        tearDown();
        setUp();
    }
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
    RUN_TEST(test_cancelling_has_no_size);
    RUN_TEST(test_what_is_told_apart_does_not);
    RUN_TEST(test_inductances_along_a_curve_are_not_asked);
    RUN_TEST(test_a_series_does_not);
    return UNITY_END();
}
