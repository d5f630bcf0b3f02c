/* What a finding says of its values. */
#include <string.h>

#include "hci/effects/effect.h"
#include "host/diagnose/candidates/empirical_term.h"
#include "host/diagnose/findings.h"
#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

/* Friction of three terms, as three speeds tell it. */
static const char *words_of_friction(double viscous, double std_error)
{
    static hci_diagnosis d;
    static hci_attribution a;
    hci_candidate friction = {.type = hci_effect_type_find("friction"), .count = 3, .in = true};
    const double value[] = {0.1021, viscous, 2.6e-4};
    for (size_t k = 0; k < 3; ++k)
        friction.term[k] = (hci_effect_term){.parameter = k, .value = value[k], .std_error = std_error};
    memset(&d, 0, sizeof d);
    memset(&a, 0, sizeof a);
    a.types = 1;
    a.verdict[0].type = friction.type;
    a.verdict[0].in = true;
    a.model.candidates = (hci_candidates){.candidate = &friction, .count = 1};
    hci_findings_fill(&a, &d);
    TEST_ASSERT_EQUAL_UINT(1, d.findings);
    return d.finding[0].detail;
}

static void test_a_friction_below_0_is_said_to_be_none(void)
{
    TEST_ASSERT_NOT_NULL(
        strstr(words_of_friction(-0.0079, 0.0005), "only their sum at the recorded speeds is told"));
    TEST_ASSERT_NULL(strstr(words_of_friction(-0.0008, 0.0005), "their sum"));
    TEST_ASSERT_NULL(strstr(words_of_friction(4e-4, 1e-5), "their sum"));
}

/* 0.5 N·m at 1 A that grows with a power of the current; 9 A are the most that was recorded. */
static void test_what_is_not_explained(void)
{
    static hci_diagnosis d;
    static hci_attribution a;
    static hci_run run;
    static hci_run_statistics statistics;
    static hci_dataset dataset;
    size_t g = 0;
    while (hci_growth_law_of(g).current != 0.5 || hci_growth_law_of(g).speed != 0.0)
        ++g;
    hci_candidate order_6 = {.type = &hci_empirical_type, .count = 2, .in = true};
    order_6.term[0] = (hci_effect_term){.order = 6.0, .parameter = 2 * g, .value = 0.3};
    order_6.term[1] = (hci_effect_term){.order = 6.0, .parameter = 2 * g + 1, .value = -0.4};
    statistics.current_A = 9.0;
    dataset.samples.statistics = &statistics;
    dataset.samples.run_count = 1;
    dataset.regression.runs = &run;
    a.unknown = true;
    a.model.candidates = (hci_candidates){.candidate = &order_6, .count = 1};
    hci_unexplained_fill(&dataset, &a, &d);
    TEST_ASSERT_EQUAL_UINT(1, d.unexplained_count);
    TEST_ASSERT_EQUAL_DOUBLE(0.3, d.unexplained[0].sine_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(-0.4, d.unexplained[0].cosine_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 * 3.0, d.unexplained[0].amplitude_Nm);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_friction_below_0_is_said_to_be_none);
    RUN_TEST(test_what_is_not_explained);
    return UNITY_END();
}
