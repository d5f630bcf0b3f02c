/* Residuals that are known are, to the last bit, those that are computed, and are counted like them. */
#define _XOPEN_SOURCE 700

#include "host/diagnose/fit/known_residuals.h"

#include "host/diagnose/fit/model.h"
#include "host/diagnose/reading/predicted_reading.h"
#include "support/searching.h"

enum { N = 600 };

static hci_known_residuals residuals;
static double *asked_Nm, *computed_Nm;

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    free(asked_Nm);
    free(computed_Nm);
    hci_known_residuals_release(&residuals);
    search_end();
    dataset_end();
}

static void begin(void)
{
    for (size_t r = 0; r < 2; ++r)
        record(N, &(point){r == 0 ? 60.0 : -150.0, r == 0 ? 3.0 : 9.0, 0.2, 0.03, 0.0});
    search_start();
    model_add("cogging", "sine", "cosine", 6.0);
    model_add("friction", "coulomb", NULL, 0.0);
    asked_Nm = calloc(dataset.samples.count, sizeof *asked_Nm);
    computed_Nm = calloc(dataset.samples.count, sizeof *computed_Nm);
}

/* Asks for the residual of the model as it is now. Returns whether it was known: that takes no memory. */
static bool ask(void)
{
    hci_model list;
    TEST_ASSERT_EQUAL_INT(
        HCI_OK, hci_model_make(dataset.regression.declared, &model.candidates, false, &list, &note));
    dataset.work = 0.0;
    TEST_ASSERT_EQUAL_INT(HCI_OK,
                          hci_regression_residual(&dataset.regression, &list.list, computed_Nm, &note));
    const double work = dataset.work;
    dataset.work = 0.0;
    hci_memory_fail_after(0);
    const bool was_known =
        hci_known_residuals_find(&residuals, &dataset.regression, &list.list, asked_Nm, &note) == HCI_OK;
    hci_memory_fail_after(-1);
    if (!was_known)
        TEST_ASSERT_EQUAL_INT(
            HCI_OK, hci_known_residuals_find(&residuals, &dataset.regression, &list.list, asked_Nm, &note));
    hci_model_release(&list);
    TEST_ASSERT_TRUE(work > 0.0);
    TEST_ASSERT_EQUAL_DOUBLE(work, dataset.work);
    TEST_ASSERT_EQUAL_MEMORY(computed_Nm, asked_Nm, dataset.samples.count * sizeof *asked_Nm);
    return was_known;
}

static void test_the_same_model(void)
{
    begin();
    TEST_ASSERT_FALSE(ask());
    TEST_ASSERT_TRUE(ask());
}

static void test_another_value_order_or_term(void)
{
    begin();
    TEST_ASSERT_FALSE(ask());
    model.candidates.candidate[0].term[1].value = 0.02;
    TEST_ASSERT_FALSE(ask());
    model.candidates.candidate[0].term[1].order = 12.0;
    TEST_ASSERT_FALSE(ask());
    model.candidates.candidate[1].in = false;
    TEST_ASSERT_FALSE(ask());
}

static void test_other_runs_readings_or_means(void)
{
    begin();
    TEST_ASSERT_FALSE(ask());
    dataset.fit[1] = false;
    TEST_ASSERT_FALSE(ask());
    dataset.regression.raw = true;
    TEST_ASSERT_FALSE(ask());
    dataset.regression.free_means = true;
    TEST_ASSERT_FALSE(ask());
    dataset.regression.free_means = dataset.regression.raw = false;
    dataset.fit[1] = true;
    TEST_ASSERT_TRUE(ask());
}

/* The one that was asked for longest ago makes room. */
static void test_many_models(void)
{
    begin();
    ask();
    for (int k = 1; k < HCI_KNOWN_RESIDUALS; ++k) {
        model.candidates.candidate[0].term[0].value = 0.01 * k;
        TEST_ASSERT_FALSE(ask());
    }
    model.candidates.candidate[0].term[0].value = 0.0;
    TEST_ASSERT_TRUE(ask());
    model.candidates.candidate[0].term[0].value = 0.5;
    TEST_ASSERT_FALSE(ask());
    model.candidates.candidate[0].term[0].value = 0.01;
    TEST_ASSERT_FALSE(ask());
}

static void test_without_memory_nothing_is_kept(void)
{
    begin();
    ask();
    hci_model list;
    model.candidates.candidate[0].term[0].value = 0.03;
    hci_model_make(dataset.regression.declared, &model.candidates, false, &list, &note);
    for (long k = 0;; ++k) {
        hci_memory_fail_after(k);
        const hci_status status =
            hci_known_residuals_find(&residuals, &dataset.regression, &list.list, asked_Nm, &note);
        hci_memory_fail_after(-1);
        if (status == HCI_OK) break;
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, status);
    }
    hci_model_release(&list);
    ask();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_same_model);
    RUN_TEST(test_another_value_order_or_term);
    RUN_TEST(test_other_runs_readings_or_means);
    RUN_TEST(test_many_models);
    RUN_TEST(test_without_memory_nothing_is_kept);
    return UNITY_END();
}
