/* What is said of an effect that was found: its values, the largest first, in words of the field. */
#include <math.h>
#include <string.h>

#include "hci/host/diagnose/diagnose.h"
#include "support/effect_list.h"
#include "unity.h"

static hci_diagnosis d;
static el_list effects;
static hci_finding finding;
static char text[2048];

void setUp(void)
{
    memset(&d, 0, sizeof d);
    memset(&effects, 0, sizeof effects);
    memset(&finding, 0, sizeof finding);
    finding.verdict = HCI_FINDING_ADDED;
}

void tearDown(void)
{
}

/* Adds a value with its error; 0: none is told. */
static void add(const char *effect, const char *parameter, double order, double value, double std_error)
{
    el_add(&effects, effect, parameter, order, value);
    for (size_t k = 0; k < effects.list.count; ++k)
        if (strcmp(effects.effect[k].type->name, effect) == 0)
            effects.term[k][effects.effect[k].count - 1].std_error = std_error;
}

static const char *words_of(const char *effect)
{
    d.effects.list = effects.list;
    finding.effect = effect;
    hci_finding_words(&d, &finding, text, sizeof text);
    return text;
}

/* Sine and cosine of an order are one amplitude, with the larger error; the largest amplitude comes first, of
 * the effect that is asked for. */
static void test_waves_are_amplitudes(void)
{
    add("friction", "coulomb", 0.0, 0.7, 0.1);
    add("cogging", "sine", 6.0, 0.003, 0.0002);
    add("cogging", "cosine", 6.0, -0.004, 0.0001);
    add("cogging", "cosine", 12.0, -0.012, 0.0003);
    add("cogging", "sine", 4.5, 0.001, 0.0004);
    TEST_ASSERT_EQUAL_STRING("order 12 = 0.012 ± 0.0003 N·m; order 6 = 0.005 ± 0.0002 N·m; "
                             "order 4.5 = 0.001 ± 0.0004 N·m",
                             words_of("cogging"));
}

/* Four are said. */
static void test_more_than_four(void)
{
    for (int k = 1; k <= 7; ++k)
        add("cogging", "sine", 6.0 * k, 0.01 * k, 0.001);
    TEST_ASSERT_EQUAL_STRING(
        "order 42 = 0.07 ± 0.001 N·m; order 36 = 0.06 ± 0.001 N·m; order 30 = 0.05 ± 0.001 "
        "N·m; order 24 = 0.04 ± 0.001 N·m; and 3 more in effects.csv",
        words_of("cogging"));
}

/* An inductance of order n makes n times the torque; dd, dq and qq stand by themselves; a mean keeps its
 * sign. */
static void test_inductances_by_their_torque(void)
{
    add("reluctance", "dd_cosine", 0.0, -0.002, 1e-5);
    add("reluctance", "qq_sine", 6.0, 0.0003, 2e-5);
    add("reluctance", "dq_sine", 6.0, 0.0004, 3e-5);
    add("reluctance", "qq_cosine", 6.0, 0.0004, 4e-5);
    TEST_ASSERT_EQUAL_STRING("order 6, L_qq = 0.0005 ± 4e-05 H; order 6, L_dq = 0.0004 ± 3e-05 H; "
                             "mean, L_dd = -0.002 ± 1e-05 H",
                             words_of("reluctance"));
}

/* Values of other units stay where they are; what is 0 and has no error is nothing. */
static void test_plain_values(void)
{
    add("torque_sensor", "time_constant", 0.0, 0.0012, 1e-4);
    add("torque_sensor", "natural_frequency", 0.0, 0.0, NAN);
    add("torque_sensor", "damping", 0.0, 0.2, 0.0);
    add("torque_sensor", "offset", 0.0, -0.03, 0.002);
    TEST_ASSERT_EQUAL_STRING("time constant = 0.0012 ± 0.0001 s; damping = 0.2, not told by itself; "
                             "offset = -0.03 ± 0.002 N·m",
                             words_of("torque_sensor"));
}

static void test_phases(void)
{
    add("current_gain", "a", 0.0, 0.01, 0.001);
    add("current_gain", "b", 0.0, -0.02, 0.001);
    add("current_gain", "c", 0.0, 0.0, 0.001);
    TEST_ASSERT_EQUAL_STRING("phase b = -0.02 ± 0.001; phase a = 0.01 ± 0.001; phase c = 0 ± 0.001",
                             words_of("current_gain"));
}

static void test_units(void)
{
    add("friction", "viscous", 0.0, 0.002, 1e-4);
    add("friction", "quadratic", 0.0, 3e-6, 1e-7);
    TEST_ASSERT_EQUAL_STRING("viscous = 0.002 ± 0.0001 N·m·s/rad; quadratic = 3e-06 ± 1e-07 N·m·s²/rad²",
                             words_of("friction"));
    add("back_emf", "sine", 5.0, 0.004, 1e-4);
    add("back_emf", "pos_cosine", 5.0, 0.003, 1e-4);
    TEST_ASSERT_EQUAL_STRING("order 5 = 0.004 ± 0.0001 N·m/A; "
                             "order 5, positive sequence = 0.003 ± 0.0001 N·m/A",
                             words_of("back_emf"));
}

/* What stands behind the values of a friction is said behind them. */
static void test_conditions_of_a_friction(void)
{
    add("friction", "coulomb", 0.0, 0.05, 0.001);
    strcpy(finding.detail, "coulomb = 0.05 +- 0.001 Nm; only their sum is known");
    TEST_ASSERT_EQUAL_STRING("coulomb = 0.05 ± 0.001 N·m; only their sum is known", words_of("friction"));
    strcpy(finding.detail, "coulomb = 0.05, times the torque constant");
    TEST_ASSERT_EQUAL_STRING("coulomb = 0.05 ± 0.001 N·m, times the torque constant", words_of("friction"));
    strcpy(finding.detail, "coulomb = 0.05 +- 0.001 Nm");
    TEST_ASSERT_EQUAL_STRING("coulomb = 0.05 ± 0.001 N·m", words_of("friction"));
}

/* Of what is not in the machine the detail is said, with titles in place of names. */
static void test_details(void)
{
    add("cogging", "sine", 6.0, 0.003, 0.0002);
    strcpy(finding.detail, "in place of back_emf: sine_5 = 0.01");
    TEST_ASSERT_EQUAL_STRING("in place of back-EMF; values in effects.csv", words_of("cogging"));
    strcpy(finding.detail, "looks the same as a part of current_gain: both turn with the load");
    TEST_ASSERT_EQUAL_STRING(
        "looks the same as a part of gains of the current sensors: both turn with the load",
        words_of("cogging"));
    strcpy(finding.detail, "no better than noise");
    TEST_ASSERT_EQUAL_STRING("no better than noise", words_of("reluctance"));
    finding.verdict = HCI_FINDING_REJECTED;
    TEST_ASSERT_EQUAL_STRING("no better than noise", words_of("cogging"));
    finding.verdict = HCI_FINDING_AMBIGUOUS;
    TEST_ASSERT_EQUAL_STRING("order 6 = 0.003 ± 0.0002 N·m", words_of("cogging"));
}

static void test_titles(void)
{
    TEST_ASSERT_EQUAL_STRING("gains of the current sensors", hci_finding_title("current_gain"));
    TEST_ASSERT_EQUAL_STRING("what is not known", hci_finding_title("unknown"));
    TEST_ASSERT_EQUAL_STRING("another", hci_finding_title("another"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_waves_are_amplitudes);
    RUN_TEST(test_more_than_four);
    RUN_TEST(test_inductances_by_their_torque);
    RUN_TEST(test_plain_values);
    RUN_TEST(test_phases);
    RUN_TEST(test_units);
    RUN_TEST(test_conditions_of_a_friction);
    RUN_TEST(test_details);
    RUN_TEST(test_titles);
    return UNITY_END();
}
