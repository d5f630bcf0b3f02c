/* Rows of currents and voltages at points of the turn, against the sine formula of phases: linear in the
 * coordinates, with a current that is held, and components of all sequences. */
#include "host/limit/points.h"

#include <math.h>
#include <string.h>

#include "support/effect_list.h"
#include "support/reference.h"
#include "unity.h"

enum { COUNT = 4 };

static const double R_ohm = 0.5, L_H = 1.2e-3, W = 700.0; /* mechanical speed, of two pole pairs */

static hci_wave emf[] = {{1.0, 1, 0.2, 0.0}, {5.0, -1, 0.02, 0.01}};
static hci_component component[COUNT] = {{1.0, 1}, {5.0, -1}, {3.0, 0}, {7.0, 1}};
static hci_set name[COUNT] = {HCI_SET_POS, HCI_SET_NEG, HCI_SET_ZERO, HCI_SET_POS};
static const hci_wave HELD = {11.0, -1, 0.3, -0.2};
static const double X[2 * COUNT] = {8.0, 1.3, 0.9, 0.4, 0.6, -0.7, -0.5, 0.8};

static hci_machine_data machine;
static hci_solve_options options;
static hci_voltage_model model;
static hci_component_set set;
static hci_limit_field field;

static void make_model(void)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_voltage_model_make(&machine, &options, &model, &note), note.text);
}

void setUp(void)
{
    memset(&machine, 0, sizeof machine);
    memset(&options, 0, sizeof options);
    memset(&field, 0, sizeof field);
    machine.pole_pairs = machine.model.pole_pairs = 2;
    machine.model.back_emf = emf;
    machine.model.back_emf_count = 2;
    machine.resistance_ohm = R_ohm;
    machine.inductance_d_H = machine.inductance_q_H = L_H;
    options.speed_rad_per_s = W;
    make_model();
    set = (hci_component_set){component, name, COUNT, {{0}}};
    field.set = &set;
    field.held = &HELD;
    field.voltage = &model;
    field.turns = 1;
}

void tearDown(void)
{
}

/* A sine of phase s, and its derivative by the angle. */
static double sine_of(hci_wave w, int s, double theta)
{
    const double x = w.order * theta - w.sequence * 2.0 * REF_PI * s / 3.0;
    return w.sine * sin(x) + w.cosine * cos(x);
}

static double slope_of(hci_wave w, int s, double theta)
{
    const double x = w.order * theta - w.sequence * 2.0 * REF_PI * s / 3.0;
    return w.order * (w.sine * cos(x) - w.cosine * sin(x));
}

static hci_wave wave_of(int k)
{
    return (hci_wave){component[k].order, component[k].sequence, X[2 * k], X[2 * k + 1]};
}

static double current_of(int s, double theta)
{
    double sum = sine_of(HELD, s, theta);
    for (int k = 0; k < COUNT; ++k)
        sum += sine_of(wave_of(k), s, theta);
    return sum;
}

/* R i + p ω L di/dθ + ω e, without what a zero sequence has: it makes no voltage between lines. */
static double voltage_of(int s, double theta)
{
    double i = sine_of(HELD, s, theta), slope = slope_of(HELD, s, theta), e = 0.0;
    for (int k = 0; k < COUNT; ++k) {
        if (component[k].sequence == 0) continue;
        i += sine_of(wave_of(k), s, theta);
        slope += slope_of(wave_of(k), s, theta);
    }
    for (int k = 0; k < 2; ++k)
        e += sine_of(emf[k], s, theta);
    return R_ohm * i + 2.0 * W * L_H * slope + W * e;
}

static double value_at(hci_point_kind kind, int phase, double theta)
{
    double g[8 * COUNT];
    const hci_limit_point point = {kind, phase, theta, 0.0};
    TEST_ASSERT_TRUE(hci_limit_row_room(&field) <= 8 * COUNT);
    for (int k = 0; k < 8 * COUNT; ++k)
        g[k] = 1e3; /* what is not written is seen */
    hci_limit_rows(&field, &point, g);
    return hci_limit_value(kind, 2 * COUNT, g, X);
}

static void test_currents_of_phases(void)
{
    for (int k = 0; k < 24; ++k)
        for (int s = 0; s < 3; ++s) {
            const double theta = 0.27 * k;
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, current_of(s, theta), value_at(HCI_POINT_CURRENT, s, theta));
        }
}

static void test_voltages_of_lines(void)
{
    for (int k = 0; k < 24; ++k)
        for (int s = 0; s < 3; ++s) {
            const double theta = 0.27 * k, line = voltage_of(s, theta) - voltage_of((s + 1) % 3, theta);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, line, value_at(HCI_POINT_VOLTAGE, s, theta));
        }
}

/* √3 times the amplitude of the vector: of phases that sum to zero √(2/3 Σ v²). */
static void test_sizes_of_vectors(void)
{
    for (int k = 0; k < 24; ++k) {
        const double theta = 0.27 * k;
        double square = 0.0;
        for (int s = 0; s < 3; ++s)
            square += voltage_of(s, theta) * voltage_of(s, theta);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, sqrt(3.0) * sqrt(2.0 / 3.0 * square),
                                  value_at(HCI_POINT_VECTOR, 0, theta));
    }
}

/* ---- inductances over the angle, and effects ---- */

/* L of two phases at an angle: of L_d and L_q, or with a table besides of any matrix of two orders. */
static double inductance_H(int row, int column, double theta)
{
    double l = 0.0;
    for (int axis = 0; axis < 2;
         ++axis) { /* d is −cos θ, q as the sine of the back-EMF: e_d, e_q of phases */
        const double in_row =
            axis ? sin(theta - row * 2.0 * REF_PI / 3.0) : cos(theta - row * 2.0 * REF_PI / 3.0);
        const double in_column =
            axis ? sin(theta - column * 2.0 * REF_PI / 3.0) : cos(theta - column * 2.0 * REF_PI / 3.0);
        l += 2.0 / 3.0 * (axis ? machine.inductance_q_H : machine.inductance_d_H) * in_row * in_column;
    }
    return l;
}

static double table_H(int row, int column, double theta)
{
    static const int PLACE[3][3] = {
        {HCI_AA, HCI_AB, HCI_CA}, {HCI_AB, HCI_BB, HCI_BC}, {HCI_CA, HCI_BC, HCI_CC}};
    double l = 0.0;
    for (size_t k = 0; k < machine.inductance_count; ++k) {
        const hci_inductance *h = &machine.inductance[k];
        l += h->sine[PLACE[row][column]] * sin(h->order * theta) +
             h->cosine[PLACE[row][column]] * cos(h->order * theta);
    }
    return l;
}

static double plane_current(int s, double theta)
{
    double sum = sine_of(HELD, s, theta);
    for (int k = 0; k < COUNT; ++k)
        if (component[k].sequence != 0) sum += sine_of(wave_of(k), s, theta);
    return sum;
}

/* Flux of a phase; a sum of the phases makes no line voltage. */
static double flux_Vs(double (*matrix)(int, int, double), int s, double theta)
{
    double sum = 0.0;
    for (int c = 0; c < 3; ++c)
        sum += matrix(s, c, theta) * plane_current(c, theta);
    return sum;
}

/* v = R i + dψ/dt + ω e, the flux's slope by a difference of fourth order, without what the phases have in
 * common. */
static void phase_voltages(double (*matrix)(int, int, double), double theta, double v[3])
{
    const double h = 1e-3;
    double common = 0.0;
    for (int s = 0; s < 3; ++s) {
        const double near = flux_Vs(matrix, s, theta + h) - flux_Vs(matrix, s, theta - h),
                     far = flux_Vs(matrix, s, theta + 2.0 * h) - flux_Vs(matrix, s, theta - 2.0 * h);
        v[s] = R_ohm * plane_current(s, theta) + 2.0 * W * (8.0 * near - far) / (12.0 * h);
        for (int w = 0; w < 2; ++w)
            v[s] += W * sine_of(emf[w], s, theta);
        common += v[s] / 3.0;
    }
    for (int s = 0; s < 3; ++s)
        v[s] -= common;
}

/* Rows, and the voltage of the currents as waves: of lines, of phases twice where no zero sequence is added,
 * and √3 times the amplitude. */
static void check_voltages(double (*matrix)(int, int, double))
{
    hci_wave wave[COUNT + 1];
    const hci_wave_list all = {wave, COUNT + 1};
    for (int k = 0; k < COUNT; ++k)
        wave[k] = wave_of(k);
    wave[COUNT] = HELD;
    for (int k = 0; k < 48; ++k) {
        const double theta = 0.27 * k;
        double v[3], square = 0.0;
        model.modulation = k % 2 ? HCI_MODULATION_SINUSOIDAL : HCI_MODULATION_SPACE_VECTOR;
        phase_voltages(matrix, theta, v);
        for (int s = 0; s < 3; ++s) {
            const double link = k % 2 ? 2.0 * v[s] : v[s] - v[(s + 1) % 3];
            const hci_limit_point point = {HCI_POINT_VOLTAGE, s, theta, 0.0};
            square += v[s] * v[s];
            TEST_ASSERT_DOUBLE_WITHIN(1e-7, link, value_at(HCI_POINT_VOLTAGE, s, theta));
            TEST_ASSERT_DOUBLE_WITHIN(1e-7, link, hci_limit_link_V(&field, &point, &all));
        }
        const hci_limit_point circle = {HCI_POINT_VECTOR, 0, theta, 0.0};
        TEST_ASSERT_DOUBLE_WITHIN(1e-7, sqrt(2.0 * square), hci_limit_link_V(&field, &circle, &all));
        TEST_ASSERT_DOUBLE_WITHIN(1e-7, sqrt(2.0 * square), value_at(HCI_POINT_VECTOR, 0, theta));
    }
}

static void test_voltages_of_a_salient_rotor(void)
{
    machine.inductance_d_H = 0.8e-3;
    machine.inductance_q_H = 1.7e-3;
    make_model();
    check_voltages(inductance_H);
}

static void test_voltages_of_a_table_of_inductances(void)
{
    static hci_inductance table[] = {
        {0.0, {0.0}, {1.1e-3, 1.3e-3, 0.9e-3, -2e-4, -4e-4, -3e-4}},
        {2.0, {2e-4, -1e-4, 5e-5, 1e-4, -7e-5, 3e-5}, {-6e-5, 2e-4, 1e-4, 4e-5, 5e-5, -9e-5}},
        {4.0, {3e-5, 4e-5, -2e-5, 1e-5, 2e-5, -3e-5}, {2e-5, -1e-5, 4e-5, 3e-5, -2e-5, 1e-5}}};
    static hci_inductance_slope slope[2];
    for (int k = 0; k < 2; ++k) {
        slope[k].order = table[k + 1].order;
        for (int q = 0; q < HCI_PHASE_MATRIX; ++q) { /* L' = p dL/dθ */
            slope[k].sine[q] = -2.0 * slope[k].order * table[k + 1].cosine[q];
            slope[k].cosine[q] = 2.0 * slope[k].order * table[k + 1].sine[q];
        }
    }
    machine.inductance = table;
    machine.inductance_count = 3;
    machine.model.slope = slope;
    machine.model.slope_count = 2;
    make_model();
    check_voltages(table_H);
}

/* What effects add is a polynomial of the currents: at those where it was made linear a row has their true
 * voltage, and its slope is that of the true one. */
static void test_voltages_of_effects_are_made_linear(void)
{
    static el_list list;
    hci_wave wave[COUNT + 1];
    const hci_wave_list at = {wave, COUNT + 1};
    double g[8 * COUNT];
    memset(&list, 0, sizeof list);
    el_add(&list, "reluctance", "dd_cosine", 0.0, 3e-4);
    el_add(&list, "reluctance", "dq_cosine", 0.0, -2e-4);
    el_add(&list, "reluctance", "qq_cosine", 6.0, 1e-4);
    el_add(&list, "back_emf", "sine", 5.0, 0.03);
    el_add(&list, "saturation", "d1q2_cosine", 0.0, 0.4);
    el_add(&list, "saturation", "d0q3_sine", 6.0, 0.2);
    el_add(&list, "saturation", "reference_current", 0.0, 8.0);
    options.effects = &list.list;
    make_model();
    field.at = &at;
    TEST_ASSERT_TRUE(hci_limit_is_bent(&field));
    for (int k = 0; k < COUNT; ++k)
        wave[k] = wave_of(k);
    wave[COUNT] = HELD;
    for (int k = 0; k < 18; ++k) {
        const hci_limit_point point = {HCI_POINT_VOLTAGE, k % 3, 0.37 * k, 0.0};
        const double there_V = hci_limit_link_V(&field, &point, &at);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * fabs(there_V) + 1e-9, there_V,
                                  value_at(HCI_POINT_VOLTAGE, k % 3, 0.37 * k));
        hci_limit_rows(&field, &point, g);
        for (int c = 0; c < COUNT; ++c)
            for (int part = 0; part < 2; ++part) {
                double *x = part ? &wave[c].cosine : &wave[c].sine, end_V[2];
                const double was = *x;
                for (int side = 0; side < 2; ++side) {
                    *x = was + (side ? 1e-3 : -1e-3);
                    end_V[side] = hci_limit_link_V(&field, &point, &at);
                }
                *x = was;
                TEST_ASSERT_DOUBLE_WITHIN(1e-4, (end_V[1] - end_V[0]) / 2e-3, g[2 * c + part]);
            }
    }
}

/* Without its values a machine tells no voltage; at standstill no inductance is asked for. */
static void test_values_that_a_voltage_needs(void)
{
    for (int k = 0; k < 8; ++k) {
        hci_note missing = {{0}};
        machine.resistance_ohm = k & 1 ? (double)NAN : R_ohm;
        machine.inductance_q_H = k & 2 ? (double)NAN : L_H;
        options.speed_rad_per_s = k & 4 ? 0.0 : W;
        const bool enough = !(k & 1) && (!(k & 2) || (k & 4));
        TEST_ASSERT_EQUAL(enough ? HCI_OK : HCI_ERROR_INPUT,
                          hci_voltage_model_make(&machine, &options, &model, &missing));
        TEST_ASSERT_EQUAL(!enough, strstr(missing.text, "resistance") != NULL);
    }
}

static void test_limits_of_points(void)
{
    const hci_bounds bounds = {.current_A = {7.0, 8.0, 9.0}, .line_V = 300.0};
    for (int s = 0; s < 3; ++s)
        TEST_ASSERT_EQUAL_DOUBLE(7.0 + s, hci_limit_of_point(&bounds, HCI_POINT_CURRENT, s));
    TEST_ASSERT_EQUAL_DOUBLE(300.0, hci_limit_of_point(&bounds, HCI_POINT_VOLTAGE, 1));
    TEST_ASSERT_EQUAL_DOUBLE(300.0, hci_limit_of_point(&bounds, HCI_POINT_VECTOR, 0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_currents_of_phases);
    RUN_TEST(test_voltages_of_lines);
    RUN_TEST(test_sizes_of_vectors);
    RUN_TEST(test_voltages_of_a_salient_rotor);
    RUN_TEST(test_voltages_of_a_table_of_inductances);
    RUN_TEST(test_voltages_of_effects_are_made_linear);
    RUN_TEST(test_values_that_a_voltage_needs);
    RUN_TEST(test_limits_of_points);
    return UNITY_END();
}
