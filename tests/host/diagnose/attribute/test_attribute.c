/* A search that goes on from what another one has found ends at the same model, by less work. */
#include "host/diagnose/attribute/attribute.h"

#include "support/searching.h"

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    search_end();
    dataset_end();
}

static void record_all(void)
{
    for (size_t k = 0; k < 6; ++k) {
        const double sign = k % 2 ? -1.0 : 1.0;
        record(900, &(point){sign * (60.0 + 15.0 * (double)k), 2.0 + 3.0 * (double)(k % 3), 0.0, sign * 0.05,
                             0.0});
        for (size_t j = 0; j < 900; ++j)
            run[k].torque_Nm[j] += 0.05 * sin(6.0 * P * run[k].theta_m_rad[j]);
    }
}

/* The work of a search. */
static double search_from(const hci_candidates *start, hci_attribution *a)
{
    search_end();
    search_start();
    how.start = start;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_attribute(&dataset.regression, &how, a, &note));
    return dataset.work;
}

static void test_from_where_another_has_ended(void)
{
    hci_attribution whole, rest;
    record_all();
    const double all = search_from(NULL, &whole);
    const double more = search_from(&whole.model.candidates, &rest);
    TEST_ASSERT_TRUE(more < 0.7 * all);
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_types_in(&whole.model.candidates));
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_types_in(&rest.model.candidates));
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, term_in(&whole.model.candidates, "friction", "coulomb", 0.0)->value,
                              term_in(&rest.model.candidates, "friction", "coulomb", 0.0)->value);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, term_in(&whole.model.candidates, "cogging", "sine", 6.0)->value,
                              term_in(&rest.model.candidates, "cogging", "sine", 6.0)->value);
    hci_attribution_release(&whole);
    hci_attribution_release(&rest);
}

/* What is not there leaves. */
static void test_from_what_is_not_there(void)
{
    hci_attribution a;
    record_all();
    model_add("cogging", "sine", "cosine", 4.0);
    const hci_candidates start = model.candidates;
    model.candidates = (hci_candidates){0};
    search_from(&start, &a);
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_types_in(&a.model.candidates));
    TEST_ASSERT_DOUBLE_WITHIN(0.002, 0.05, term_in(&a.model.candidates, "cogging", "sine", 6.0)->value);
    for (size_t k = 0; k < a.model.candidates.count; ++k)
        TEST_ASSERT_FALSE(a.model.candidates.candidate[k].in &&
                          fabs(a.model.candidates.candidate[k].term[0].order - 4.0) < 1e-6);
    hci_attribution_release(&a);
    hci_candidates_release(&(hci_candidates){start.candidate, start.count, start.reference_current_A});
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_from_where_another_has_ended);
    RUN_TEST(test_from_what_is_not_there);
    return UNITY_END();
}
