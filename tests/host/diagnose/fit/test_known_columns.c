/* Normal equations in which derivatives are known are those in which all are predicted. */
#define _XOPEN_SOURCE 700

#include "host/diagnose/fit/known_columns.h"

#include "host/diagnose/fit/linearise.h"
#include "support/searching.h"

enum { N = 600 };

static hci_normal_equations fresh, derived;

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_normal_equations_release(&fresh);
    hci_normal_equations_release(&derived);
    search_end();
    dataset_end();
}

/* Two runs, and candidates of all kinds, of which friction and a cogging order are in the model. */
static void begin(bool holding)
{
    for (size_t r = 0; r < 2; ++r)
        record(N, &(point){r == 0 ? 60.0 : -150.0, r == 0 ? 3.0 : 9.0, 0.2, 0.03, 0.0});
    if (holding) run[0].torque_source = HCI_TORQUE_HOLDING;
    search_start();
    hci_search_noise(&search, &model.candidates, &note);
    dataset.regression.known = NULL;
    model_add("cogging", "sine", "cosine", 6.0);
    model_add("cogging", "sine", "cosine", 12.0);
    model_add("back_emf", "sine", "cosine", 5.0);
    model_add("saturation", "d1q2_cosine", NULL, 0.0);
    model_add("friction", "coulomb", NULL, 0.0);
    model_add("channel_delay", "angle", NULL, 0.0);
    model_add("current_gain", "a", NULL, 0.0);
    model.candidates.reference_current_A = 10.0;
}

static hci_effect_term *term_of(const char *effect, double order)
{
    for (size_t k = 0; k < model.candidates.count; ++k) {
        hci_candidate *x = &model.candidates.candidate[k];
        if (strcmp(x->type->name, effect) == 0 && x->term[0].order == order) return x->term;
    }
    TEST_FAIL_MESSAGE(effect);
    return NULL;
}

/* How many derivatives are known now. */
static size_t known(void)
{
    hci_model list;
    hci_column_plan plan;
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_model_make(dataset.regression.declared, &model.candidates, true, &list, &note));
    TEST_ASSERT_TRUE(hci_column_plan_make(&dataset.regression, &list, true, &plan));
    const size_t count = plan.known_count;
    TEST_ASSERT_EQUAL_UINT64(list.columns, plan.known_count + plan.predicted_count);
    hci_column_plan_release(&plan);
    hci_model_release(&list);
    return count;
}

static void equations(hci_known_columns *columns, hci_normal_equations *to)
{
    dataset.regression.columns = columns;
    hci_normal_equations_release(to);
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_regression_normal(&dataset.regression, &model.candidates, true, to, &note));
    dataset.regression.columns = &dataset.columns;
}

/* The equations with what is known, and with everything predicted. */
static void compare(void)
{
    equations(&dataset.columns, &derived);
    equations(NULL, &fresh);
    TEST_ASSERT_EQUAL_UINT64(fresh.n, derived.n);
    TEST_ASSERT_EQUAL_DOUBLE(fresh.rows, derived.rows);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12 * fresh.square, fresh.square, derived.square);
    for (size_t i = 0; i < fresh.n; ++i) {
        const double scale = sqrt(fresh.gram[i * fresh.n + i] * fresh.square);
        TEST_ASSERT_DOUBLE_WITHIN(1e-11 * scale, fresh.moment[i], derived.moment[i]);
        for (size_t j = 0; j < fresh.n; ++j)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12 * sqrt(fresh.gram[i * fresh.n + i] * fresh.gram[j * fresh.n + j]),
                                      fresh.gram[i * fresh.n + j], derived.gram[i * fresh.n + j]);
    }
}

/* Cogging, back-EMF, saturation and friction: eight derivatives that only a delay or a gain changes. */
static void test_what_was_predicted_is_known(void)
{
    begin(false);
    compare();
    TEST_ASSERT_EQUAL_UINT64(8, known());
    compare();
}

static void test_values_that_are_linear_change_no_derivative(void)
{
    begin(false);
    compare();
    term_of("cogging", 6.0)[1].value = 0.02;
    term_of("saturation", 0.0)[0].value = 0.01;
    term_of("friction", 0.0)[0].value = 0.05;
    TEST_ASSERT_EQUAL_UINT64(8, known());
    compare();
    term_of("saturation", 0.0)[0].value = 0.0;
    compare();
}

static void test_a_delay_or_a_gain_changes_all(void)
{
    begin(false);
    compare();
    term_of("channel_delay", 0.0)[0].value = 1e-4;
    TEST_ASSERT_EQUAL_UINT64(0, known());
    compare();
    term_of("current_gain", 0.0)[0].value = 0.01;
    TEST_ASSERT_EQUAL_UINT64(0, known());
    compare();
}

/* Where none is in, and then the one of before again. */
static void test_another_run_is_left_out(void)
{
    begin(false);
    compare();
    dataset.fit[0] = false;
    TEST_ASSERT_EQUAL_UINT64(0, known());
    compare();
    dataset.fit[0] = true;
    compare();
}

static void test_another_reference_current_is_another_series(void)
{
    begin(false);
    compare();
    model.candidates.reference_current_A = 8.0;
    TEST_ASSERT_EQUAL_UINT64(7, known());
    compare();
}

/* A holding test is in units of the modelled torque per ampere, which a back-EMF changes. */
static void test_holding_tests(void)
{
    begin(true);
    model_add("back_emf", "sine", NULL, 1.0);
    compare();
    term_of("back_emf", 1.0)[0].value = 0.01;
    TEST_ASSERT_EQUAL_UINT64(9, known());
    compare();
    compare();
}

static void test_more_candidates_than_there_is_room_for(void)
{
    begin(false);
    compare();
    for (int k = 3; k < 12; ++k)
        model_add("cogging", "sine", "cosine", 6.0 * k);
    compare();
    compare();
    TEST_ASSERT_EQUAL_UINT64(26, known());
}

/* Of a shaft that hardly accelerates what the current makes is in units of the modelled torque per ampere, of
 * which each derivative has a part. */
static void test_shafts_that_hardly_accelerate(void)
{
    begin(false);
    run[0].hardly_accelerates = true;
    model_add("back_emf", "sine", NULL, 1.0);
    compare();
    TEST_ASSERT_EQUAL_UINT64(9, known());
    term_of("cogging", 6.0)[1].value = 0.02;
    compare();
    term_of("back_emf", 1.0)[0].value = 0.01;
    term_of("saturation", 0.0)[0].value = 0.01;
    TEST_ASSERT_EQUAL_UINT64(9, known());
    compare();
    run[0].hardly_accelerates = false;
}

static void test_memory(void)
{
    begin(false);
    equations(NULL, &fresh);
    for (long k = 0;; ++k) {
        hci_normal_equations_release(&derived);
        hci_known_columns_release(&dataset.columns);
        hci_memory_fail_after(k);
        const hci_status status =
            hci_regression_normal(&dataset.regression, &model.candidates, true, &derived, &note);
        hci_memory_fail_after(-1);
        if (status == HCI_OK) break;
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, status);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-12 * fresh.square, fresh.square, derived.square);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_was_predicted_is_known);
    RUN_TEST(test_values_that_are_linear_change_no_derivative);
    RUN_TEST(test_a_delay_or_a_gain_changes_all);
    RUN_TEST(test_another_run_is_left_out);
    RUN_TEST(test_another_reference_current_is_another_series);
    RUN_TEST(test_holding_tests);
    RUN_TEST(test_more_candidates_than_there_is_room_for);
    RUN_TEST(test_shafts_that_hardly_accelerate);
    RUN_TEST(test_memory);
    return UNITY_END();
}
