/* How given currents stand to limits, against samples so fine that no peak is missed. */
#include <math.h>
#include <string.h>

#include "host/solution/limits.h"
#include "support/draws.h"
#include "unity.h"

enum { FINE = 400000 };

static const double R_ohm = 0.5, L_H = 1.2e-3, W = 700.0;
static hci_wave emf[] = {{1.0, 1, 0.2, 0.0}, {5.0, -1, 0.02, 0.01}};

static hci_machine_data m;
static hci_solve_options o;
static hci_bounds bounds;
static hci_solution s;
static hci_wave waves[3] = {{1.0, 1, 8.0, 1.3}, {5.0, -1, 0.9, 0.4}, {7.0, 1, -0.5, 0.8}};
static hci_note note;

void setUp(void)
{
    memset(&m, 0, sizeof m);
    memset(&o, 0, sizeof o);
    memset(&s, 0, sizeof s);
    m.pole_pairs = m.model.pole_pairs = 2;
    m.model.back_emf = emf;
    m.model.back_emf_count = 2;
    m.resistance_ohm = R_ohm;
    m.inductance_d_H = m.inductance_q_H = L_H;
    o.speed_rad_per_s = W;
    bounds = (hci_bounds){
        .current_A = {9.0, 9.0, 9.0}, .rms_A = {6.0, 6.0, 6.0}, .line_V = 280.0, .mean_square_A2 = 1000.0};
    s.period_turns = 1;
    s.current.wave = waves;
    s.current.count = 3;
}

void tearDown(void)
{
}

/* Phase currents and line voltages at a fine angle: v_s = R i_s + p ω L di_s/dθ + ω e_s. */
static void at(double theta, double i[3], double line[3])
{
    double v[3];
    for (int p = 0; p < 3; ++p) {
        double slope = 0.0, e = 0.0;
        i[p] = 0.0;
        for (int k = 0; k < 3; ++k) {
            const double x = waves[k].order * theta - waves[k].sequence * p * 2.0 * REF_PI / 3.0;
            i[p] += waves[k].sine * sin(x) + waves[k].cosine * cos(x);
            slope += waves[k].order * (waves[k].sine * cos(x) - waves[k].cosine * sin(x));
        }
        for (int k = 0; k < 2; ++k) {
            const double x = emf[k].order * theta - emf[k].sequence * p * 2.0 * REF_PI / 3.0;
            e += emf[k].sine * sin(x) + emf[k].cosine * cos(x);
        }
        v[p] = R_ohm * i[p] + 2.0 * W * L_H * slope + W * e;
    }
    for (int p = 0; p < 3; ++p)
        line[p] = v[p] - v[(p + 1) % 3];
}

static void test_peaks_and_effective_values(void)
{
    double most_A = 0.0, most_V = 0.0, square = 0.0, all = 0.0;
    for (int k = 0; k < FINE; ++k) {
        double i[3], line[3];
        at(2.0 * REF_PI * k / FINE, i, line);
        for (int p = 0; p < 3; ++p) {
            most_A = fmax(most_A, fabs(i[p]));
            most_V = fmax(most_V, fabs(line[p]));
            all += i[p] * i[p] / FINE;
        }
        square += i[0] * i[0] / FINE;
    }
    hci_limits_list(&bounds, &s);
    TEST_ASSERT_EQUAL_UINT64(4, s.limit_count);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_limits_check(&m, &o, &bounds, &s, &note), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, most_A, s.peak_phase_current_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, most_V, s.peak_line_voltage_V);
    TEST_ASSERT_EQUAL_DOUBLE(s.peak_phase_current_A, s.limit[0].value);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sqrt(square), s.limit[1].value);
    TEST_ASSERT_EQUAL_DOUBLE(s.peak_line_voltage_V, s.limit[2].value);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, all, s.limit[3].value);
    TEST_ASSERT_EQUAL(most_A <= 9.0 && most_V <= 280.0, s.within_limits);
}

/* A limit at the very peak is touched twice in each phase, and kept; one a millionth below is not. */
static void test_what_touches_and_what_exceeds(void)
{
    bounds.line_V = HUGE_VAL;
    hci_limits_list(&bounds, &s);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_limits_check(&m, &o, &bounds, &s, &note));
    TEST_ASSERT_TRUE(isnan(s.peak_line_voltage_V));
    const double peak_A = s.peak_phase_current_A;
    for (int below = 0; below < 2; ++below) {
        for (int p = 0; p < 3; ++p)
            bounds.current_A[p] = peak_A * (below ? 1.0 - 1e-6 : 1.0);
        bounds.rms_A[0] = bounds.rms_A[1] = bounds.rms_A[2] = HUGE_VAL;
        hci_limits_list(&bounds, &s);
        TEST_ASSERT_EQUAL_UINT64(2, s.limit_count);
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_limits_check(&m, &o, &bounds, &s, &note));
        TEST_ASSERT_EQUAL(!below, s.within_limits);
        TEST_ASSERT_EQUAL_UINT64(6, s.limit[0].touch_count);
        for (size_t k = 0; k < 6; ++k) {
            double i[3], line[3];
            at(s.limit[0].touch[k].theta_rad, i, line);
            TEST_ASSERT_DOUBLE_WITHIN(1e-5 * peak_A, peak_A, fabs(i[s.limit[0].touch[k].phase]));
        }
    }
}

/* One phase alone: its own entry; open phases are 0. */
static void test_phases_by_themselves(void)
{
    bounds.line_V = bounds.mean_square_A2 = HUGE_VAL;
    bounds.rms_A[0] = bounds.rms_A[1] = bounds.rms_A[2] = HUGE_VAL;
    bounds.current_A[0] = HUGE_VAL;
    bounds.current_A[2] = 20.0;
    hci_limits_list(&bounds, &s);
    TEST_ASSERT_EQUAL_UINT64(2, s.limit_count);
    TEST_ASSERT_EQUAL_INT(1, s.limit[0].phase);
    TEST_ASSERT_EQUAL_INT(2, s.limit[1].phase);
    TEST_ASSERT_EQUAL_DOUBLE(20.0, s.limit[1].limit);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_limits_check(&m, &o, &bounds, &s, &note));
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, s.peak_phase_current_A, s.limit[0].value);
}

/* What the program leaves of multipliers beside the one that counts is no price. */
static void test_rounding_is_no_price(void)
{
    const hci_limit_optimum cost = {.current_gain = {1e-9, 0.0, 1e-9}, .voltage_gain = 0.5};
    hci_limits_list(&bounds, &s);
    hci_limits_take_gains(&cost, &s);
    for (size_t k = 0; k < s.limit_count; ++k) {
        const bool is_voltage = s.limit[k].kind == HCI_LIMIT_VOLTAGE;
        TEST_ASSERT_EQUAL(is_voltage, s.limit[k].binds);
        TEST_ASSERT_EQUAL_DOUBLE(is_voltage ? 0.5 : 0.0, s.limit[k].gain);
    }
}

/* Currents that a bound keeps from better ones have no price; one that hardly pulls takes nothing of it. */
static void test_no_optimum_has_no_price(void)
{
    for (int pulls = 0; pulls < 2; ++pulls) {
        hci_limits_list(&bounds, &s);
        hci_limit_optimum cost = {.voltage_gain = 0.5};
        cost.pull = (pulls ? 0.1 : 0.01) * 0.5 * bounds.line_V;
        hci_limits_take_gains(&cost, &s);
        for (size_t k = 0; k < s.limit_count; ++k) {
            const bool is_voltage = s.limit[k].kind == HCI_LIMIT_VOLTAGE;
            TEST_ASSERT_EQUAL(is_voltage, s.limit[k].binds);
            TEST_ASSERT_EQUAL(is_voltage && pulls, isnan(s.limit[k].gain));
        }
    }
}

/* Three times 2 sin 3θ + 0.5 A: a peak of 7.5 A, and 3 √(2 + 0.25) = 4.5 A. */
static void test_the_neutral_carries_three_times_the_zero_sequence(void)
{
    hci_wave zero[3] = {waves[0], {3.0, 0, 2.0, 0.0}, {0.0, 0, 0.0, 0.5}};
    s.current.wave = zero;
    hci_limits_list(&bounds, &s);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_limits_check(&m, &o, &bounds, &s, &note), note.text);
    TEST_ASSERT_TRUE(isnan(s.peak_neutral_A) && isnan(s.rms_neutral_A));
    m.has_neutral = true;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_limits_check(&m, &o, &bounds, &s, &note), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 7.5, s.peak_neutral_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.5, s.rms_neutral_A);
    s.current.wave = waves;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_limits_check(&m, &o, &bounds, &s, &note), note.text);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, s.peak_neutral_A);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_peaks_and_effective_values);
    RUN_TEST(test_what_touches_and_what_exceeds);
    RUN_TEST(test_phases_by_themselves);
    RUN_TEST(test_rounding_is_no_price);
    RUN_TEST(test_no_optimum_has_no_price);
    RUN_TEST(test_the_neutral_carries_three_times_the_zero_sequence);
    return UNITY_END();
}
