/* Amplitudes of the orders of an effect that was found, of phases that are alike and of sequences. */
#include "cli/tune/words/tune_effects.h"

#include <math.h>
#include <string.h>

#include "unity.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static size_t parameter_of(const hci_effect_type *type, const char *name)
{
    for (size_t k = 0; k < type->parameter_count; ++k)
        if (strcmp(type->parameter[k].name, name) == 0) return k;
    TEST_FAIL_MESSAGE(name);
    return 0;
}

static void test_a_sequence_is_an_order_of_its_own(void)
{
    const hci_effect_type *type = hci_effect_type_find("back_emf");
    hci_effect_term term[] = {{parameter_of(type, "sine"), 1.0, 0.2, 0.001},
                              {parameter_of(type, "neg_sine"), 1.0, 0.03, 0.002},
                              {parameter_of(type, "neg_cosine"), 1.0, -0.04, 0.001},
                              {parameter_of(type, "pos_cosine"), 2.0, 0.01, 0.003}};
    const hci_effect effect = {.type = type, .term = term, .count = 4};
    double std_error = NAN;
    TEST_ASSERT_EQUAL_DOUBLE(0.2, cli_tune_amplitude_of(&effect, 0, &std_error));
    TEST_ASSERT_EQUAL_DOUBLE(0.05, cli_tune_amplitude_of(&effect, 1, &std_error));
    TEST_ASSERT_EQUAL_DOUBLE(0.002, std_error);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, cli_tune_amplitude_of(&effect, 2, &std_error)); /* with its sine */
    TEST_ASSERT_EQUAL_DOUBLE(0.01, cli_tune_amplitude_of(&effect, 3, &std_error));
}

/* Terms of a series in the currents are no orders of a wave. */
static void test_a_series_has_none(void)
{
    const hci_effect_type *type = hci_effect_type_find("reluctance");
    hci_effect_term term[] = {{parameter_of(type, "dq_sine"), 6.0, 1e-4, 1e-6}};
    const hci_effect effect = {.type = type, .term = term, .count = 1};
    TEST_ASSERT_FALSE(cli_tune_has_orders(&effect));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_sequence_is_an_order_of_its_own);
    RUN_TEST(test_a_series_has_none);
    return UNITY_END();
}
