/* Rows of currents and voltages at points of the turn, against the sine formula of phases: linear in the
 * coordinates, with a current that is held, and components of all sequences. */
#include "host/limit/points.h"

#include <math.h>
#include <string.h>

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

void setUp(void)
{
    hci_note note = {{0}};
    memset(&machine, 0, sizeof machine);
    memset(&options, 0, sizeof options);
    memset(&field, 0, sizeof field);
    machine.pole_pairs = machine.model.pole_pairs = 2;
    machine.model.back_emf = emf;
    machine.model.back_emf_count = 2;
    machine.resistance_ohm = R_ohm;
    machine.inductance_d_H = machine.inductance_q_H = L_H;
    options.speed_rad_per_s = W;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_voltage_model_make(&machine, &options, &model, &note), note.text);
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
    RUN_TEST(test_limits_of_points);
    return UNITY_END();
}
