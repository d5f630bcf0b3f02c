/* Normal equations that follow from known ones are those of the samples; where X would differ, none are
 * derived. */
#define _XOPEN_SOURCE 700

#include "host/diagnose/fit/known_equations.h"

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

/* The equations of the model as it is, and no others, are known. */
static void know_again(void)
{
    hci_known_equations_release(&dataset.known);
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_regression_normal(&dataset.regression, &model.candidates, false, &fresh, &note));
    hci_normal_equations_release(&fresh);
}

/* Two runs, and a model with effects of all kinds whose equations are known. */
static void know(bool holding)
{
    for (size_t r = 0; r < 2; ++r)
        record(N, &(point){r == 0 ? 60.0 : -150.0, r == 0 ? 3.0 : 9.0, 0.2, 0.03, 0.0});
    if (holding) run[0].torque_source = HCI_TORQUE_HOLDING;
    search_start();
    hci_search_noise(&search, &model.candidates, &note);
    model_add("cogging", "sine", "cosine", 6.0);
    model_add("cogging", "sine", "cosine", 12.0);
    model_add("back_emf", "sine", "cosine", 5.0);
    model_add("saturation", "d1q2_cosine", NULL, 0.0);
    model_add("friction", "coulomb", NULL, 0.0);
    model_add("channel_delay", "angle", NULL, 0.0);
    model.candidates.reference_current_A = 10.0;
    know_again();
}

static hci_candidate *candidate(const char *effect, double order)
{
    for (size_t k = 0; k < model.candidates.count; ++k) {
        hci_candidate *x = &model.candidates.candidate[k];
        if (strcmp(x->type->name, effect) == 0 && x->term[0].order == order) return x;
    }
    TEST_FAIL_MESSAGE(effect);
    return NULL;
}

/* Whether the equations of the model as it is now are known. */
static bool is_known(void)
{
    hci_model list;
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_model_make(dataset.regression.declared, &model.candidates, false, &list, &note));
    TEST_ASSERT_TRUE(hci_normal_equations_start(&derived, list.columns));
    const bool known = hci_known_equations_find(&dataset.known, &dataset.regression, &list, &derived);
    if (!known) TEST_ASSERT_EQUAL_DOUBLE(0.0, derived.square);
    hci_normal_equations_release(&derived);
    hci_model_release(&list);
    return known;
}

/* The equations by the known ones and by the samples. */
static void compare(void)
{
    hci_known_equations *known = dataset.regression.known;
    TEST_ASSERT_TRUE(is_known());
    hci_regression_normal(&dataset.regression, &model.candidates, false, &derived, &note);
    dataset.regression.known = NULL;
    hci_regression_normal(&dataset.regression, &model.candidates, false, &fresh, &note);
    dataset.regression.known = known;
    TEST_ASSERT_EQUAL_UINT64(fresh.n, derived.n);
    TEST_ASSERT_EQUAL_DOUBLE(fresh.rows, derived.rows);
    TEST_ASSERT_DOUBLE_WITHIN(1e-10 * fresh.square, fresh.square, derived.square);
    for (size_t i = 0; i < fresh.n; ++i) {
        const double scale = sqrt(fresh.gram[i * fresh.n + i] * fresh.square);
        TEST_ASSERT_DOUBLE_WITHIN(1e-10 * scale, fresh.moment[i], derived.moment[i]);
        for (size_t j = 0; j < fresh.n; ++j)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12 * sqrt(fresh.gram[i * fresh.n + i] * fresh.gram[j * fresh.n + j]),
                                      fresh.gram[i * fresh.n + j], derived.gram[i * fresh.n + j]);
    }
    hci_normal_equations_release(&derived);
    hci_normal_equations_release(&fresh);
}

static void test_fewer_columns(void)
{
    know(false);
    compare();
    candidate("cogging", 12.0)->in = false;
    candidate("friction", 0.0)->in = false;
    compare();
}

/* Also of terms that the model does not have any more, once the delay is not asked for. */
static void test_other_values_of_what_is_linear(void)
{
    know(false);
    candidate("channel_delay", 0.0)->in = false;
    candidate("cogging", 6.0)->term[1].value = 0.02;
    candidate("back_emf", 5.0)->term[0].value = -0.003;
    candidate("saturation", 0.0)->term[0].value = 0.01;
    compare();
    know_again();
    candidate("saturation", 0.0)->in = false;
    compare();
}

static void test_a_delay_that_has_gone_changes_the_columns(void)
{
    know(false);
    candidate("channel_delay", 0.0)->term[0].value = 1e-4;
    know_again();
    candidate("channel_delay", 0.0)->in = false;
    TEST_ASSERT_FALSE(is_known());
}

static void test_a_delay_depends_on_the_torque(void)
{
    know(false);
    candidate("cogging", 6.0)->term[1].value = 0.02;
    TEST_ASSERT_FALSE(is_known());
}

static void test_a_delay_changes_the_columns(void)
{
    know(false);
    candidate("channel_delay", 0.0)->term[0].value = 1e-4;
    TEST_ASSERT_FALSE(is_known());
}

static void test_a_column_that_is_not_there(void)
{
    know(false);
    model_add("cogging", "sine", NULL, 18.0);
    TEST_ASSERT_FALSE(is_known());
}

static void test_other_noise_or_runs(void)
{
    know(false);
    TEST_ASSERT_TRUE(is_known());
    dataset.regression.noise[1].rms *= 1.0 + 1e-15;
    TEST_ASSERT_FALSE(is_known());
    dataset.regression.noise[1].rms /= 1.0 + 1e-15;
    TEST_ASSERT_TRUE(is_known());
    dataset.fit[1] = false;
    TEST_ASSERT_FALSE(is_known());
}

/* The current of a holding test answers to the torque: the column is emptied there, and what a value does to
 * the residual is not told by it. */
static void test_a_value_that_a_run_does_not_show(void)
{
    know(true);
    candidate("channel_delay", 0.0)->in = false;
    compare();
    candidate("cogging", 6.0)->term[1].value = 0.02;
    compare();
    candidate("saturation", 0.0)->term[0].value = 0.01;
    TEST_ASSERT_FALSE(is_known());
}

/* What the current of a shaft makes that hardly accelerates is in units of the modelled torque per ampere:
 * not linear in a back-EMF. A cogging torque is. */
static void test_a_value_that_scales_the_reading(void)
{
    know(false);
    run[0].hardly_accelerates = true;
    candidate("channel_delay", 0.0)->in = false;
    model_add("back_emf", "sine", NULL, 1.0);
    know_again();
    candidate("cogging", 6.0)->term[1].value = 0.02;
    compare();
    candidate("back_emf", 1.0)->term[0].value = 0.01;
    TEST_ASSERT_FALSE(is_known());
    run[0].hardly_accelerates = false;
}

/* The one that was asked for longest ago goes. */
static void test_the_last_ones_are_kept(void)
{
    know(false);
    for (int k = 1; k <= HCI_KNOWN_EQUATIONS; ++k) {
        candidate("channel_delay", 0.0)->term[0].value = 1e-4 * k;
        hci_regression_normal(&dataset.regression, &model.candidates, false, &fresh, &note);
        hci_normal_equations_release(&fresh);
        TEST_ASSERT_TRUE(is_known());
    }
    candidate("channel_delay", 0.0)->term[0].value = 1e-4;
    TEST_ASSERT_TRUE(is_known());
    candidate("channel_delay", 0.0)->term[0].value = 0.0;
    TEST_ASSERT_FALSE(is_known());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_fewer_columns);
    RUN_TEST(test_other_values_of_what_is_linear);
    RUN_TEST(test_a_delay_depends_on_the_torque);
    RUN_TEST(test_a_delay_changes_the_columns);
    RUN_TEST(test_a_delay_that_has_gone_changes_the_columns);
    RUN_TEST(test_a_column_that_is_not_there);
    RUN_TEST(test_other_noise_or_runs);
    RUN_TEST(test_a_value_that_a_run_does_not_show);
    RUN_TEST(test_a_value_that_scales_the_reading);
    RUN_TEST(test_the_last_ones_are_kept);
    return UNITY_END();
}
