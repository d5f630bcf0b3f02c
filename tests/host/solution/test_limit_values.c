/* How given currents stand to limits, against samples so fine that no peak is missed. */
#include <math.h>
#include <string.h>

#include "host/solution/limits.h"
#include "support/draws.h"
#include "unity.h"

enum { FINE = 400000, FINE_OF_TWO = 40000 }; /* samples of one turn, and of two */

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

/* Phase currents and voltages at a fine angle: v_s = R i_s + p ω L di_s/dθ + ω e_s. */
static void phases_at(double theta, double i[3], double v[3])
{
    const hci_wave *flows = s.current.wave;
    for (int p = 0; p < 3; ++p) {
        double slope = 0.0, e = 0.0;
        i[p] = 0.0;
        for (size_t k = 0; k < s.current.count; ++k) {
            const double x = flows[k].order * theta - flows[k].sequence * p * 2.0 * REF_PI / 3.0;
            i[p] += flows[k].sine * sin(x) + flows[k].cosine * cos(x);
            slope += flows[k].order * (flows[k].sine * cos(x) - flows[k].cosine * sin(x));
        }
        for (int k = 0; k < 2; ++k) {
            const double x = emf[k].order * theta - emf[k].sequence * p * 2.0 * REF_PI / 3.0;
            e += emf[k].sine * sin(x) + emf[k].cosine * cos(x);
        }
        v[p] = R_ohm * i[p] + 2.0 * W * L_H * slope + W * e;
    }
}

/* The same with line voltages. */
static void at(double theta, double i[3], double line[3])
{
    double v[3];
    phases_at(theta, i, v);
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

/* ---- phases that differ ---- */

/* Tolerances are of the samples that the extremes are taken from: h²/8 of the curvature.
 *
 * A third order and a half one of their own sequences: no phase is as another, and two turns repeat. */
static hci_wave uneven[] = {{1.0, 1, 8.0, 1.3}, {3.0, -1, 1.1, 0.6}, {0.5, 1, 0.7, -0.4}};

/* The largest of each phase, of each pair and of the vector, and the mean squares, over two turns. */
typedef struct {
    double current_A[3], square_A2[3], phase_V[3], line_V[3], vector_V;
} extremes;

static extremes extremes_of(void)
{
    extremes x = {.vector_V = 0.0};
    for (int k = 0; k < FINE_OF_TWO; ++k) {
        double i[3], v[3], square = 0.0;
        phases_at(4.0 * REF_PI * k / FINE_OF_TWO, i, v);
        for (int p = 0; p < 3; ++p) {
            x.current_A[p] = fmax(x.current_A[p], fabs(i[p]));
            x.square_A2[p] += i[p] * i[p] / FINE_OF_TWO;
            x.phase_V[p] = fmax(x.phase_V[p], fabs(v[p]));
            x.line_V[p] = fmax(x.line_V[p], fabs(v[p] - v[(p + 1) % 3]));
            square += v[p] * v[p];
        }
        x.vector_V = fmax(x.vector_V, sqrt(2.0 * square));
    }
    return x;
}

static double largest(const double x[3])
{
    return fmax(x[0], fmax(x[1], x[2]));
}

static void check_uneven(void)
{
    s.current.wave = uneven;
    s.period_turns = 2;
    hci_limits_list(&bounds, &s);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_limits_check(&m, &o, &bounds, &s, &note), note.text);
}

/* Each phase has its own entry, with its own peak and its own rms. */
static void test_each_phase_against_its_own_limit(void)
{
    bounds.current_A[1] = 9.5;
    bounds.rms_A[2] = 6.5;
    bounds.line_V = HUGE_VAL;
    check_uneven();
    const extremes x = extremes_of();
    TEST_ASSERT_EQUAL_UINT64(7, s.limit_count);
    for (int p = 0; p < 3; ++p) {
        TEST_ASSERT_EQUAL_INT(p, s.limit[p].phase);
        TEST_ASSERT_EQUAL_DOUBLE(bounds.current_A[p], s.limit[p].limit);
        TEST_ASSERT_EQUAL_DOUBLE(bounds.rms_A[p], s.limit[3 + p].limit);
        TEST_ASSERT_DOUBLE_WITHIN(2e-6, x.current_A[p], s.limit[p].value);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, sqrt(x.square_A2[p]), s.limit[3 + p].value);
    }
    TEST_ASSERT_DOUBLE_WITHIN(2e-6, largest(x.current_A), s.peak_phase_current_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sqrt(largest(x.square_A2)), s.rms_phase_current_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, x.square_A2[0] + x.square_A2[1] + x.square_A2[2], s.limit[6].value);
}

/* What has to stay within the link is a pair, twice a phase, or the vector; the peak of the lines is told of
 * all. */
static void test_what_a_modulation_limits(void)
{
    for (int k = 0; k < 3; ++k) {
        o.limits.modulation = bounds.modulation = k == 0   ? HCI_MODULATION_SPACE_VECTOR
                                                  : k == 1 ? HCI_MODULATION_SINUSOIDAL
                                                           : HCI_MODULATION_CIRCLE;
        check_uneven();
        const extremes x = extremes_of();
        const double most_V = k == 0 ? largest(x.line_V) : k == 1 ? 2.0 * largest(x.phase_V) : x.vector_V;
        TEST_ASSERT_EQUAL_INT(bounds.modulation, s.limit[2].modulation);
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, most_V, s.limit[2].value);
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, largest(x.line_V), s.peak_line_voltage_V);
        TEST_ASSERT_TRUE(isnan(s.peak_open_voltage_V));
    }
}

/* With an open phase two terminals show what no leg makes. */
static void test_an_open_phase_shows_its_voltage(void)
{
    for (int open = 0; open < 3; ++open) {
        for (int p = 0; p < 3; ++p)
            bounds.current_A[p] = p == open ? 0.0 : 9.0;
        bounds.modulation = HCI_MODULATION_SPACE_VECTOR;
        check_uneven();
        const extremes x = extremes_of();
        const int driven = (open + 1) % 3;
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, x.line_V[driven], s.peak_line_voltage_V);
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, fmax(x.line_V[open], x.line_V[(open + 2) % 3]),
                                  s.peak_open_voltage_V);
        bounds.modulation = HCI_MODULATION_CIRCLE;
        check_uneven();
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, x.line_V[driven], s.limit[s.limit_count - 2].value);
    }
}

/* Where a limit is touched is told of each phase, from 0 to a turn. */
static void test_touches_are_of_the_phase_that_touches(void)
{
    check_uneven();
    const extremes x = extremes_of();
    for (int p = 0; p < 3; ++p)
        bounds.current_A[p] = x.current_A[p];
    check_uneven();
    for (int p = 0; p < 3; ++p) {
        double i[3], v[3];
        TEST_ASSERT_EQUAL_UINT64(1, s.limit[p].touch_count);
        TEST_ASSERT_EQUAL_INT(p, s.limit[p].touch[0].phase);
        TEST_ASSERT_TRUE(s.limit[p].touch[0].theta_rad >= 0.0);
        phases_at(s.limit[p].touch[0].theta_rad, i, v);
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, x.current_A[p], fabs(i[p]));
    }
}

/* A limit that is a thousandth off is as good as touched, and one further off has no price. */
static void test_what_is_far_off_has_no_price(void)
{
    bounds.line_V = HUGE_VAL;
    check_uneven();
    const double peak_A = s.peak_phase_current_A;
    for (int far_off = 0; far_off < 2; ++far_off) {
        for (int p = 0; p < 3; ++p)
            bounds.current_A[p] = peak_A * (far_off ? 1.0011 : 1.0009);
        hci_limits_list(&bounds, &s);
        s.limit[0].binds = true;
        s.limit[0].gain = 0.3;
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_limits_check(&m, &o, &bounds, &s, &note));
        TEST_ASSERT_EQUAL(!far_off, s.limit[0].binds);
        TEST_ASSERT_EQUAL_DOUBLE(far_off ? 0.0 : 0.3, s.limit[0].gain);
    }
}

/* One more of a limit that the phases share gives what it gives to each of them. */
static void test_gains_of_phases_add_up_where_they_are_alike(void)
{
    const hci_limit_optimum cost = {.current_gain = {0.2, 0.3, 0.4},
                                    .rms_gain = {0.5, 0.7, 0.6},
                                    .voltage_gain = 0.8,
                                    .copper_gain = 0.1};
    hci_limits_list(&bounds, &s);
    hci_limits_take_gains(&cost, &s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.9, s.limit[0].gain);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.8, s.limit[1].gain);
    TEST_ASSERT_EQUAL_DOUBLE(0.8, s.limit[2].gain);
    TEST_ASSERT_EQUAL_DOUBLE(0.1, s.limit[3].gain);
    bounds.current_A[1] = 9.5;
    bounds.rms_A[0] = 5.5;
    hci_limits_list(&bounds, &s);
    hci_limits_take_gains(&cost, &s);
    for (int p = 0; p < 3; ++p) {
        TEST_ASSERT_EQUAL_DOUBLE(cost.current_gain[p], s.limit[p].gain);
        TEST_ASSERT_EQUAL_DOUBLE(cost.rms_gain[p], s.limit[3 + p].gain);
    }
}

/* Of a bound that pulls by a twentieth of what all limits together cost. */
static void test_prices_end_where_a_bound_pulls(void)
{
    for (int pulls = 0; pulls < 2; ++pulls) {
        hci_limit_optimum cost = {.rms_gain = {0.5, 0.25, 0.25}, .voltage_gain = 0.02, .copper_gain = 0.003};
        hci_limits_list(&bounds, &s);
        cost.pull = (pulls ? 0.0501 : 0.0499) * (1.0 * 6.0 + 0.02 * 280.0 + 0.003 * 1000.0);
        hci_limits_take_gains(&cost, &s);
        for (size_t k = 0; k < 4; ++k) {
            TEST_ASSERT_EQUAL(k > 0, s.limit[k].binds);
            TEST_ASSERT_EQUAL(k > 0 && pulls, isnan(s.limit[k].gain));
        }
    }
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
    RUN_TEST(test_each_phase_against_its_own_limit);
    RUN_TEST(test_what_a_modulation_limits);
    RUN_TEST(test_an_open_phase_shows_its_voltage);
    RUN_TEST(test_touches_are_of_the_phase_that_touches);
    RUN_TEST(test_what_is_far_off_has_no_price);
    RUN_TEST(test_gains_of_phases_add_up_where_they_are_alike);
    RUN_TEST(test_prices_end_where_a_bound_pulls);
    return UNITY_END();
}
