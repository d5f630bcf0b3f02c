/* What a finding says of its values. */
#include <string.h>

#include "hci/effects/effect.h"
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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_friction_below_0_is_said_to_be_none);
    return UNITY_END();
}
