/* What is said of limits, and the largest mean torque of the same currents within a limit of them. */
#include <math.h>
#include <string.h>

#include "host/solution/limits.h"
#include "support/draws.h"
#include "unity.h"

static hci_machine_data m;
static hci_bounds bounds;
static hci_solution s;

void setUp(void)
{
    memset(&m, 0, sizeof m);
    memset(&s, 0, sizeof s);
    bounds = (hci_bounds){.current_A = {HUGE_VAL, HUGE_VAL, HUGE_VAL},
                          .rms_A = {HUGE_VAL, HUGE_VAL, HUGE_VAL},
                          .line_V = HUGE_VAL,
                          .line_V_per_V = 0.9,
                          .mean_square_A2 = HUGE_VAL};
    s.period_turns = 1;
}

void tearDown(void)
{
}

/* ---- names ---- */

static void test_names(void)
{
    static const hci_limit_kind KIND[] = {HCI_LIMIT_CURRENT, HCI_LIMIT_RMS, HCI_LIMIT_VOLTAGE,
                                          HCI_LIMIT_COPPER};
    static const char *const KIND_NAME[] = {"current", "rms", "voltage", "copper"};
    static const hci_limit_cost COST[] = {HCI_COST_NONE, HCI_COST_COPPER, HCI_COST_RIPPLE, HCI_COST_TORQUE,
                                          HCI_COST_LIMITS};
    static const char *const COST_NAME[] = {"none", "copper", "ripple", "torque", "limits"};
    for (int k = 0; k < 4; ++k)
        TEST_ASSERT_EQUAL_STRING(KIND_NAME[k], hci_limit_kind_name(KIND[k]));
    for (int k = 0; k < 5; ++k)
        TEST_ASSERT_EQUAL_STRING(COST_NAME[k], hci_limit_cost_name(COST[k]));
}

/* Currents are those of a phase; voltages of a pair, of a phase or of all. */
static void test_names_of_places(void)
{
    static const char *const PHASE[] = {"a", "b", "c"}, *const PAIR[] = {"ab", "bc", "ca"};
    const hci_limit current = {.kind = HCI_LIMIT_CURRENT, .modulation = HCI_MODULATION_CIRCLE},
                    lines = {.kind = HCI_LIMIT_VOLTAGE, .modulation = HCI_MODULATION_SPACE_VECTOR},
                    phases = {.kind = HCI_LIMIT_VOLTAGE, .modulation = HCI_MODULATION_SINUSOIDAL},
                    vector = {.kind = HCI_LIMIT_VOLTAGE, .modulation = HCI_MODULATION_CIRCLE};
    for (int p = 0; p < 3; ++p) {
        TEST_ASSERT_EQUAL_STRING(PHASE[p], hci_limit_place_name(&current, p));
        TEST_ASSERT_EQUAL_STRING(PAIR[p], hci_limit_place_name(&lines, p));
        TEST_ASSERT_EQUAL_STRING(PHASE[p], hci_limit_place_name(&phases, p));
        TEST_ASSERT_EQUAL_STRING("vector", hci_limit_place_name(&vector, p));
    }
}

/* ---- the list ---- */

/* What is not limited has no entry; of phases that differ each that is limited has one. */
static void test_what_is_not_limited_is_not_listed(void)
{
    bounds.resistance_ohm = 0.7;
    hci_limits_list(&bounds, &s);
    TEST_ASSERT_EQUAL_UINT64(0, s.limit_count);
    TEST_ASSERT_EQUAL_DOUBLE(0.7, s.resistance_ohm);
    bounds.current_A[1] = 8.0;
    bounds.current_is_declared[1] = true;
    bounds.rms_A[0] = bounds.rms_A[1] = 5.0;
    bounds.line_V = 43.0;
    bounds.voltage_is_declared = true;
    bounds.modulation = HCI_MODULATION_SINUSOIDAL;
    hci_limits_list(&bounds, &s);
    TEST_ASSERT_EQUAL_UINT64(4, s.limit_count);
    static const hci_limit_kind KIND[] = {HCI_LIMIT_CURRENT, HCI_LIMIT_RMS, HCI_LIMIT_RMS, HCI_LIMIT_VOLTAGE};
    static const int PHASE[] = {1, 0, 1, -1};
    static const double LIMIT[] = {8.0, 5.0, 5.0, 43.0};
    for (int k = 0; k < 4; ++k) {
        TEST_ASSERT_EQUAL_INT(KIND[k], s.limit[k].kind);
        TEST_ASSERT_EQUAL_INT(PHASE[k], s.limit[k].phase);
        TEST_ASSERT_EQUAL_DOUBLE(LIMIT[k], s.limit[k].limit);
        TEST_ASSERT_EQUAL(k == 0 || k == 3, s.limit[k].is_declared);
    }
    TEST_ASSERT_EQUAL_INT(HCI_MODULATION_SINUSOIDAL, s.limit[3].modulation);
}

/* ---- remarks ---- */

static void expect_remark(const char *text)
{
    TEST_ASSERT_EQUAL_STRING(text, s.remark.text);
    s.remark.text[0] = '\0';
}

/* Ten amperes are the peak of a sine: a thousandth more of heat and a tenth more of the peak are spoken of.
 */
static void test_currents_beyond_rated_current(void)
{
    const double heat_A = 10.0 / sqrt(2.0);
    m.rated_current_A = 10.0;
    s.rms_phase_current_A = 1.0009 * heat_A;
    s.peak_phase_current_A = 10.99;
    hci_limits_remark_rated(&m, &s);
    expect_remark("");
    s.rms_phase_current_A = 1.0011 * heat_A;
    hci_limits_remark_rated(&m, &s);
    expect_remark("the rms current of a phase, 7.079 A, is that of a sine of 10.01 A: more heat than that of "
                  "rated_current, 10 A; --limit-rms 7.071 holds the heat");
    s.rms_phase_current_A = heat_A;
    s.peak_phase_current_A = 11.01;
    hci_limits_remark_rated(&m, &s);
    expect_remark(
        "the peak, 11.01 A, is above rated_current, 10 A, which is the peak of a sine and no limit; "
        "where the drive gives no more, --limit-current 10 or `max_current` in machine.csv");
}

/* Who gave a limit of that kind knows it. */
static void test_a_limit_that_was_given_is_not_spoken_of(void)
{
    m.rated_current_A = 10.0;
    s.rms_phase_current_A = 20.0;
    s.peak_phase_current_A = 30.0;
    bounds.line_V = 40.0;
    bounds.current_A[2] = 30.0;
    hci_limits_list(&bounds, &s);
    hci_limits_remark_rated(&m, &s);
    TEST_ASSERT_EQUAL_INT(0, strncmp(s.remark.text, "the rms current", 15));
    TEST_ASSERT_NULL(strstr(s.remark.text, "the peak"));
    s.remark.text[0] = '\0';
    bounds.rms_A[0] = 20.0;
    hci_limits_list(&bounds, &s);
    hci_limits_remark_rated(&m, &s);
    expect_remark("");
}

static void test_limits_beyond_those_of_the_machine(void)
{
    m.max_current_A = 12.0;
    m.dc_link_voltage_V = 50.0;
    hci_limits_remark_declared(&m, &bounds, &s);
    expect_remark("");
    bounds.current_A[0] = 12.0;
    bounds.current_A[1] = 3.0;
    bounds.line_V = 45.0;
    hci_limits_remark_declared(&m, &bounds, &s);
    expect_remark("");
    bounds.current_A[2] = 12.5;
    hci_limits_remark_declared(&m, &bounds, &s);
    expect_remark("a limit of 12.5 A was given, above max_current of machine.csv, 12 A");
    bounds.current_A[2] = 2.0;
    bounds.line_V = 45.9;
    hci_limits_remark_declared(&m, &bounds, &s);
    expect_remark("a limit of 51 V was given, above dc_link_voltage of machine.csv, 50 V");
    m.max_current_A = m.dc_link_voltage_V = NAN;
    hci_limits_remark_declared(&m, &bounds, &s);
    expect_remark("");
    m.max_current_A = m.dc_link_voltage_V = 0.0;
    hci_limits_remark_declared(&m, &bounds, &s);
    expect_remark("");
}

static void test_an_open_phase_that_shows_more_than_the_link(void)
{
    bounds.line_V = 45.0;
    s.peak_open_voltage_V = 49.9;
    hci_limits_remark_open(&bounds, &s);
    expect_remark("");
    s.peak_open_voltage_V = 50.1;
    hci_limits_remark_open(&bounds, &s);
    expect_remark(
        "the open phase shows up to 50.1 V against the others, more than the dc link of 50 V: it has to "
        "be disconnected, since of a leg that is only switched off the diodes would conduct");
}

/* ---- the same currents for less torque ---- */

/* Sine of 0.8 A/(N·m) and a third order that is always there: the mean between −wanted and wanted at which
 * the phase that is limited most has its limit, by bisection over the angles that are looked at. */
static hci_wave per_Nm[] = {{1.0, 1, 0.8, 0.0}, {3.0, 1, 0.0, 0.0}},
                constant[] = {{1.0, 1, 0.0, 0.0}, {3.0, 1, 0.5, 0.3}};

static bool fits(double mean_Nm)
{
    for (int k = 0; k < 192; ++k)
        for (int p = 0; p < 3; ++p) {
            const double x = 2.0 * REF_PI * k / 192.0, shift = 2.0 * REF_PI * p / 3.0;
            const double i =
                mean_Nm * 0.8 * sin(x - shift) + 0.5 * sin(3.0 * x - shift) + 0.3 * cos(3.0 * x - shift);
            if (fabs(i) > bounds.current_A[p]) return false;
        }
    return true;
}

static double scaled(double wanted_Nm)
{
    s.per_Nm = per_Nm;
    s.constant = constant;
    s.current.wave = per_Nm;
    s.current.count = 2;
    hci_limits_list(&bounds, &s);
    for (size_t k = 0; k < s.limit_count; ++k)
        s.limit[k].value = 100.0;
    hci_limits_scale(&bounds, wanted_Nm, &s);
    return s.torque_at_limit_Nm;
}

static void test_the_largest_torque_within_the_limits(void)
{
    bounds.current_A[0] = 4.0;
    bounds.current_A[1] = 5.0;
    bounds.current_A[2] = 3.0;
    for (int sign = -1; sign < 2; sign += 2) {
        double low = 0.0, high = 30.0;
        for (int k = 0; k < 60; ++k)
            *(fits(sign * 0.5 * (low + high)) ? &low : &high) = 0.5 * (low + high);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, sign * low, scaled(sign * 30.0));
        TEST_ASSERT_EQUAL_DOUBLE(sign * 0.5 * low, scaled(sign * 0.5 * low));
    }
}

/* The third order alone is 0.58 A. */
static void test_no_torque_where_what_is_always_there_is_too_much(void)
{
    for (int p = 0; p < 3; ++p) {
        for (int k = 0; k < 3; ++k)
            bounds.current_A[k] = k == p ? 0.55 : 5.0;
        TEST_ASSERT_TRUE(isnan(scaled(30.0)));
        bounds.current_A[p] = 0.6;
        TEST_ASSERT_TRUE(scaled(30.0) > 0.0);
    }
}

static void test_no_torque_is_told_of_currents_within_the_limit(void)
{
    bounds.current_A[0] = bounds.current_A[1] = bounds.current_A[2] = 4.0;
    bounds.line_V = 50.0;
    TEST_ASSERT_FALSE(isnan(scaled(30.0)));
    s.limit[0].value = 4.0; /* of the current; the voltage exceeds its own */
    hci_limits_scale(&bounds, 30.0, &s);
    TEST_ASSERT_TRUE(isnan(s.torque_at_limit_Nm));
    s.limit[0].value = 5.0;
    s.per_Nm = NULL;
    hci_limits_scale(&bounds, 30.0, &s);
    TEST_ASSERT_TRUE(isnan(s.torque_at_limit_Nm));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_names);
    RUN_TEST(test_names_of_places);
    RUN_TEST(test_what_is_not_limited_is_not_listed);
    RUN_TEST(test_currents_beyond_rated_current);
    RUN_TEST(test_a_limit_that_was_given_is_not_spoken_of);
    RUN_TEST(test_limits_beyond_those_of_the_machine);
    RUN_TEST(test_an_open_phase_that_shows_more_than_the_link);
    RUN_TEST(test_the_largest_torque_within_the_limits);
    RUN_TEST(test_no_torque_where_what_is_always_there_is_too_much);
    RUN_TEST(test_no_torque_is_told_of_currents_within_the_limit);
    return UNITY_END();
}
