/* Every relation on a made-up motor, against a closed form: what it is where the files are right, and by
 * which factor a convention error moves it. The error is supposed in correct files here, so that a number
 * that is too small by √2 in a file becomes too large by √2 in the interpretation. */
#include "hci/host/check/check.h"
#include "host/check/relations/relations.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/check/convention_errors.h"
#include "host/check/relations/pole_pairs.h"
#include "support/made_up_motor.h"
#include "unity.h"

#define SQRT2 1.4142135623730951
#define SQRT3 1.7320508075688772
#define RPM   (2.0 * REF_PI / 60.0)

static check_data data;

void setUp(void)
{
    data = motor_data();
}

void tearDown(void)
{
}

/* ---- what is asked */

static const check_relation *relation_of(const char *name)
{
    for (size_t k = 0; k < hci_check_relation_count(); ++k)
        if (strcmp(hci_check_relation(k)->name, name) == 0) return hci_check_relation(k);
    TEST_FAIL_MESSAGE(name);
    return NULL;
}

/* The interpretation with an error ("": none) in its first form. */
static check_interpretation supposing(const char *error)
{
    check_interpretation as = hci_check_as_declared();
    if (*error == '\0') return as;
    for (size_t k = 0; k < HCI_CHECK_ERROR_COUNT; ++k)
        if (strcmp(HCI_CHECK_ERRORS[k].name, error) == 0) {
            hci_check_error_apply(&as, &HCI_CHECK_ERRORS[k]);
            return as;
        }
    TEST_FAIL_MESSAGE(error);
    return as;
}

static double value_of(const char *relation, const char *error)
{
    const check_interpretation as = supposing(error);
    return hci_check_relation_value(&data, relation_of(relation), &as).found;
}

typedef struct {
    const char *relation, *error;
    double value;
} expectation;

static void expect(const expectation *list, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        char message[100];
        snprintf(message, sizeof message, "%s with %s", list[k].relation, list[k].error);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-9 * fmax(1.0, fabs(list[k].value)), list[k].value,
                                          value_of(list[k].relation, list[k].error), message);
    }
}

#define EXPECT(...)                                                                                          \
    do {                                                                                                     \
        static const expectation LIST[] = {__VA_ARGS__};                                                     \
        expect(LIST, sizeof LIST / sizeof *LIST);                                                            \
    } while (0)

static void record_load(void)
{
    motor_record(&data, MOTOR_i_d, MOTOR_i_q, true);
}

static void record_idle(void)
{
    motor_record(&data, 0.0, 0.0, true);
}

/* ---- the tables */

static void test_orders_and_phases_of_the_tables(void)
{
    EXPECT({"emf_order", "", 1.0}, {"emf_order", "emf_orders_mechanical", 0.25}, {"emf_phase", "", 0.0},
           {"emf_phase", "angle_zero_q_axis", -0.5 * REF_PI}, {"emf_phase_range", "", 0.0},
           {"cogging_phase_range", "", 0.7},
           {"cogging_phase_range", "phases_in_degrees", 0.7 * REF_PI / 180.0});
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, REF_PI, fabs(value_of("emf_phase", "emf_sign")));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, REF_PI, fabs(value_of("emf_phase", "angle_zero_d_axis")));
    data.emf.most_phase_rad = 180.0;
    EXPECT({"emf_phase_range", "", 180.0}, {"emf_phase_range", "phases_in_degrees", REF_PI});
}

/* lcm(24, 8)/4 = 6; with 2 pole pairs lcm(24, 4)/2 = 12; order 6 of 4 pole pairs needs a stator with 3 slots.
 */
static void test_orders_of_the_cogging_torque(void)
{
    EXPECT({"cogging_sixes", "", 1.0}, {"cogging_sixes", "cogging_orders_mechanical", 0.0},
           {"cogging_first", "", 1.0}, {"cogging_first", "cogging_orders_mechanical", 0.25},
           {"cogging_first", "poles_for_pole_pairs", 0.5});
    TEST_ASSERT_TRUE(isnan(value_of("cogging_slots", "")));
    data.value[CHECK_slots] = NAN;
    EXPECT({"cogging_slots", "", 3.0 / 8.0}, {"cogging_slots", "cogging_orders_mechanical", 100.0});
    TEST_ASSERT_TRUE(isnan(value_of("cogging_first", "")));
}

/* Three lines of a free motor of 12 slots, at orders 10, 12 and 60: the likelihood of pole pairs is a product
 * over the lines of what lcm(12, 2p), 12, 2p and p put there: 6/(πh)² of their share at the h-th multiple, up
 * to the twelfth, and a tenth of the orders anywhere. 8 less where no three equal phases can be wound. */
static double likelihood(int pairs)
{
    static const int LINE[] = {10, 12, 60}, SLOTS = 12;
    static const double SHARE[] = {0.4, 0.2, 0.2, 0.1};
    int common = SLOTS, a = SLOTS, b = pairs;
    while (common % (2 * pairs) != 0)
        common += SLOTS;
    while (b != 0) {
        const int rest = a % b;
        a = b;
        b = rest;
    }
    double sum = SLOTS % (3 * a) == 0 ? 0.0 : -8.0;
    for (int k = 0; k < 3; ++k) {
        const int base[] = {common, SLOTS, 2 * pairs, pairs};
        double x = 0.1 / CHECK_MOST_ORDER;
        for (int j = 0; j < 4; ++j) {
            const int h = LINE[k] / base[j];
            if (LINE[k] % base[j] == 0 && h <= 12) x += SHARE[j] * 6.0 / (REF_PI * REF_PI * h * h);
        }
        sum += log(x);
    }
    return sum;
}

static void test_pole_pairs_of_a_ripple(void)
{
    static const int LINE[] = {10, 12, 60};
    int best = 1;
    record_idle();
    data.value[CHECK_slots] = 12.0;
    data.run[0].turns_steadily = true;
    data.run[0].lines = 3;
    for (int k = 0; k < 3; ++k)
        data.run[0].line[k] = LINE[k];
    for (int pairs = 2; pairs <= CHECK_MOST_PAIRS; ++pairs)
        if (likelihood(pairs) > likelihood(best)) best = pairs;
    TEST_ASSERT_EQUAL_INT(5, best); /* 12 slots, 10 poles */
    data.pole_pairs_of_ripple = best;
    for (int pairs = 1; pairs <= 12; ++pairs) {
        data.value[CHECK_pole_pairs] = pairs;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, sqrt(2.0 * (likelihood(best) - likelihood(pairs))),
                                  value_of("ripple_orders", ""));
    }
}

static void test_slopes_of_the_inductance(void)
{
    EXPECT({"inductance_difference", "", 1.0},
           {"inductance_difference", "inductance_per_electrical_radian", 4.0});
    data.value[CHECK_inductance_q_H] = MOTOR_L_d;
    TEST_ASSERT_TRUE(isnan(value_of("inductance_difference", "")));
}

/* ---- ratings */

/* At i_d = 0 10 A make 1.5 N·m; reluctance adds to it: A cos β + ½ K I² sin 2β at its best β, 1.5896 N·m by a
 * search in steps of a degree. Between the two everything is right. */
static void test_rated_torque(void)
{
    double most_Nm = 0.0;
    for (int degree = -90; degree <= 90; ++degree)
        most_Nm = fmax(most_Nm, motor_torque_Nm(10.0 * sin(degree * REF_PI / 180.0),
                                                10.0 * cos(degree * REF_PI / 180.0)));
    EXPECT({"rated_torque", "", 1.0}, {"rated_torque", "emf_rms", 1.0 / SQRT2},
           {"rated_torque", "rated_current_rms", 1.0 / SQRT2});
    data.value[CHECK_rated_torque_Nm] = 0.5 * (1.5 + most_Nm);
    EXPECT({"rated_torque", "", 1.0});
    data.value[CHECK_rated_torque_Nm] = 2.0 * most_Nm;
    EXPECT({"rated_torque", "", 2.0});
    TEST_ASSERT_TRUE(most_Nm > 1.55);
}

/* ψ = 25 mWb is 1.2 times below 30; ψ/(L_d I) = 2.5 is twice below 5. */
static void test_sizes(void)
{
    EXPECT({"rated_voltage", "", SQRT3 * 5.0 / 15.0}, {"rated_voltage", "emf_line", 5.0 / 15.0},
           {"flux_size", "", 1.2}, {"flux_size", "emf_flux_linkage", 0.1 / 0.03},
           {"flux_per_current", "", 2.0}, {"flux_per_current", "rated_current_rms", 2.0 * SQRT2});
}

/* What k_e is for each kind of number, by the definitions: V at 1000 rpm, rpm per V, V per Hz, Wb. */
static void test_every_kind_of_back_emf(void)
{
    static const struct {
        const char *error;
        double k_e;
    } CASES[] = {{"emf_rms", 0.1 * SQRT2},
                 {"emf_line", 0.1 / SQRT3},
                 {"emf_line_rms", 0.1 * SQRT2 / SQRT3},
                 {"emf_volt_per_krpm", 0.1 / (1000.0 * RPM)},
                 {"emf_volt_per_krpm_line", 0.1 / (1000.0 * RPM) / SQRT3},
                 {"emf_volt_per_krpm_line_rms", 0.1 / (1000.0 * RPM) / SQRT3 * SQRT2},
                 {"emf_taken_per_krpm", 0.1 * (1000.0 * RPM)},
                 {"emf_taken_per_krpm_line", 0.1 * (1000.0 * RPM) * SQRT3},
                 {"emf_taken_per_krpm_line_rms", 0.1 * (1000.0 * RPM) * SQRT3 / SQRT2},
                 {"emf_kv", 1.0 / (0.1 * RPM) / SQRT3},
                 {"emf_volt_per_hz", 0.1 * 4.0 / (2.0 * REF_PI)},
                 {"emf_flux_linkage", 0.1 * 4.0}};
    record_idle();
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        const double ratio = MOTOR_k_e / CASES[k].k_e;
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-9 * ratio, ratio, value_of("emf_size", CASES[k].error),
                                          CASES[k].error);
    }
}

/* ---- recordings */

static void test_orders_of_the_recordings(void)
{
    record_load();
    EXPECT({"current_order", "", 1.0}, {"current_order", "theta_electrical_for_mechanical", 4.0},
           {"current_order", "theta_degrees_for_radians", 180.0 / REF_PI},
           {"current_order", "direction_reversed", -1.0}, {"current_order", "phases_swapped", -1.0},
           {"current_order", "poles_for_pole_pairs", 2.0}, {"voltage_order", "", 1.0},
           {"voltage_order", "phases_swapped", -1.0});
}

/* An order that another unit of the angle makes is of no gear; another one that is not whole is. */
static void test_a_unit_of_the_angle_is_no_gear(void)
{
    static const double UNIT[] = {REF_PI / 180.0, 180.0 / REF_PI, 2.0 * REF_PI, 1.3};
    record_load();
    data.value[CHECK_pole_pairs] = 2.0;
    for (int k = 0; k < 4; ++k) {
        data.run[0].current_order = 2.0 * UNIT[k];
        TEST_ASSERT_TRUE(hci_check_pole_pairs_count(&data));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, k == 3 ? 1.3 : 0.0, data.run[0].gear);
    }
}

static void test_speeds_of_the_recordings(void)
{
    record_load();
    EXPECT({"angle_speed", "", 1.0}, {"angle_speed", "theta_degrees_for_radians", REF_PI / 180.0},
           {"angle_speed", "theta_electrical_for_mechanical", 0.25},
           {"angle_speed", "direction_reversed", -1.0}, {"angle_speed", "speed_electrical", 4.0},
           {"angle_speed", "speed_rpm_for_rad_per_s", 1.0 / RPM},
           {"angle_speed", "speed_turn_per_s_for_rad_per_s", 0.5 / REF_PI},
           {"angle_speed", "time_milliseconds", 1000.0});
    data.run[0].angle_ratio = 4.0;
    EXPECT({"angle_ratio", "", 1.0}, {"angle_ratio", "poles_for_pole_pairs", 2.0});
}

static void test_without_an_angle_the_frequency_tells(void)
{
    motor_record(&data, 0.0, 0.0, false);
    EXPECT({"frequency_speed", "", 1.0}, {"frequency_speed", "poles_for_pole_pairs", 2.0},
           {"frequency_speed", "speed_rpm_for_rad_per_s", 1.0 / RPM},
           {"frequency_speed", "speed_electrical", 4.0}, {"frequency_speed", "time_milliseconds", 1000.0},
           {"emf_per_frequency", "", 1.0}, {"emf_per_frequency", "emf_rms", 1.0 / SQRT2},
           {"emf_per_frequency", "voltage_line", 1.0 / SQRT3},
           {"emf_per_frequency", "time_milliseconds", 1e-3});
}

/* Line voltages are √3 times as large, and 30 degrees ahead. */
static void test_back_emf_of_the_recordings(void)
{
    record_idle();
    EXPECT({"emf_size", "", 1.0}, {"emf_size", "voltage_line", 1.0 / SQRT3},
           {"emf_size", "speed_electrical", 4.0}, {"emf_size", "speed_rpm_for_rad_per_s", 1.0 / RPM},
           {"emf_angle", "", 0.0}, {"emf_angle", "voltage_line", -REF_PI / 6.0},
           {"emf_angle", "run_angle_zero_q_axis", -0.5 * REF_PI});
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, REF_PI, fabs(value_of("emf_angle", "voltage_sign")));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, REF_PI, fabs(value_of("emf_angle", "run_angle_zero_d_axis")));
    record_load();
    EXPECT({"emf_size", "", 1.0}, {"emf_angle", "", 0.0});
}

/* What is left of the voltage along the current is R i; between terminals it would be twice that. */
static void test_resistance(void)
{
    record_load();
    EXPECT({"resistance_size", "", 1.0}, {"resistance_size", "resistance_line", 2.0});
    data.value[CHECK_resistance_ohm] = NAN;
    TEST_ASSERT_TRUE(isnan(value_of("resistance_size", "")));
}

/* P = T ω + 3/2 R i²: 1.62·50 W + 3/2·0.2·104 W = 81 W + 31.2 W. */
static void test_power(void)
{
    record_load();
    EXPECT({"power_balance", "", 1.0}, {"power_balance", "torque_sign", (31.2 - 81.0) / 112.2},
           {"power_balance", "voltage_sign", -1.0}, {"power_balance", "current_sign", -1.0},
           {"power_balance", "current_rms", (81.0 + 2.0 * 31.2) / (SQRT2 * 112.2)},
           {"power_balance", "resistance_line", (81.0 + 15.6) / 112.2},
           {"power_balance", "torque_millinewton", (0.081 + 31.2) / 112.2},
           {"power_balance", "speed_electrical", (81.0 / 4.0 + 31.2) / 112.2});
    data.value[CHECK_resistance_ohm] = NAN; /* is what the power misses */
    EXPECT({"power_balance", "", 1.0});
}

/* 3/2 (k_e i_q + p (L_d − L_q) i_d i_q) = 1.5 + 0.12 N·m. */
static void test_torque(void)
{
    record_load();
    EXPECT(
        {"torque_size", "", 1.0}, {"torque_size", "torque_sign", -1.0},
        {"torque_size", "torque_millinewton", 1e-3}, {"torque_size", "emf_rms", 1.62 / (1.5 * SQRT2 + 0.12)},
        {"torque_size", "current_sign", 1.62 / (-1.5 + 0.12)},
        {"torque_size", "current_rms", 1.62 / (1.5 * SQRT2 + 0.24)}, {"current_size", "", 1.019803902718557},
        {"current_size", "current_milliampere", 1.019803902718557e-3},
        {"torque_size", "inductance_per_electrical_radian", 1.62 / (1.5 + 0.48)});
}

static void test_cogging_torque_of_the_recordings(void)
{
    record_idle();
    EXPECT({"cogging_share", "", 1.0}, {"cogging_share", "cogging_orders_mechanical", 0.0},
           {"cogging_size", "", 1.0}, {"cogging_size", "torque_millinewton", 1e-3},
           {"cogging_angle", "", 0.0});
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, REF_PI,
                              fabs(value_of("cogging_angle", "run_angle_zero_q_axis"))); /* 6·π/2 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, REF_PI, fabs(value_of("cogging_angle", "torque_sign")));
}

static void test_phases(void)
{
    record_load();
    EXPECT({"current_sum", "", 0.0}, {"current_balance", "", 1.0}, {"voltage_balance", "", 1.0});
    data.has_neutral = true;
    TEST_ASSERT_TRUE(isnan(value_of("current_sum", "")));
}

/* Phase currents beside i_d and i_q, which may be rms; the sign of both is another matter. */
static void test_phase_currents_beside_i_d_and_i_q(void)
{
    check_interpretation as = hci_check_as_declared();
    record_load();
    TEST_ASSERT_TRUE(isnan(value_of("phase_ratio", "")));
    data.run[0].has_dq = true;
    data.run[0].phase_ratio = 1.1;
    EXPECT({"phase_ratio", "", 1.1}, {"phase_ratio", "current_dq_rms", 1.1 / SQRT2},
           {"phase_ratio", "current_sign", 1.1});
    as.dq = SQRT2;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.1 / SQRT2,
                              hci_check_relation_value(&data, relation_of("phase_ratio"), &as).found);
}

/* A mechanical turn with cogging torque, lcm(24, 8) = 24, and with magnets and teeth that are not alike, 8
 * and 24; under load it is not the machine's alone. */
static int pole_pairs_of_ripple(double i_q)
{
    static double torque[MOTOR_SAMPLES], theta[MOTOR_SAMPLES];
    data = motor_data();
    motor_record(&data, 0.0, i_q, true);
    for (int k = 0; k < MOTOR_SAMPLES; ++k) {
        theta[k] = 2.0 * REF_PI * k / MOTOR_SAMPLES;
        torque[k] = 0.05 * sin(24.0 * theta[k]) + 0.02 * sin(8.0 * theta[k]);
    }
    data.run[0].theta = theta;
    data.run[0].torque = torque;
    data.run[0].has_torque = true;
    TEST_ASSERT_TRUE(hci_check_pole_pairs_of_ripple(&data));
    return data.pole_pairs_of_ripple;
}

static void test_pole_pairs_by_the_ripple_without_load(void)
{
    TEST_ASSERT_EQUAL_INT(4, pole_pairs_of_ripple(0.0));
    TEST_ASSERT_EQUAL_INT(0, pole_pairs_of_ripple(10.0));
}

/* ---- all of them */

static void test_a_correct_motor_meets_every_relation(void)
{
    const check_interpretation declared = hci_check_as_declared();
    record_load();
    record_idle();
    for (size_t k = 0; k < hci_check_relation_count(); ++k) {
        const check_relation *r = hci_check_relation(k);
        const check_value x = hci_check_relation_value(&data, r, &declared);
        TEST_ASSERT_TRUE_MESSAGE(isnan(x.found) || hci_check_deviation(r, x) < 0.1, r->name);
    }
    TEST_ASSERT_TRUE(hci_check_relation_count() <= HCI_CHECK_MOST_EVIDENCE);
}

/* A relation may not be missing or there by the interpretation: one could escape from it. */
static void test_what_can_be_checked_does_not_depend_on_the_interpretation(void)
{
    record_load();
    record_idle();
    for (size_t k = 0; k < hci_check_relation_count(); ++k)
        for (size_t e = 0; e < HCI_CHECK_ERROR_COUNT; ++e) {
            const char *name = hci_check_relation(k)->name;
            TEST_ASSERT_EQUAL_MESSAGE(isnan(value_of(name, "")),
                                      isnan(value_of(name, HCI_CHECK_ERRORS[e].name)), name);
        }
}

/* ---- deviation and loss */

static void test_deviations(void)
{
    check_relation r = {.kind = CHECK_RATIO, .expected = 1.0, .tolerance = 0.1, .cap = 9.0};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, hci_check_deviation(&r, hci_check_found(exp(0.2))));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, hci_check_deviation(&r, hci_check_found(exp(-0.2))));
    r.kind = CHECK_LOW;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 / 1.5, hci_check_deviation(&r, hci_check_found(exp(-0.2))));
    r.kind = CHECK_HIGH;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0, hci_check_deviation(&r, hci_check_found(exp(-0.2))));
    r.kind = CHECK_MOST;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, hci_check_deviation(&r, hci_check_found(0.2)));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, hci_check_deviation(&r, hci_check_found(exp(0.2))));
    r.kind = CHECK_ANGLE;
    r.expected = 0.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0, hci_check_deviation(&r, hci_check_found(2.0 * REF_PI - 0.2)));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0, hci_check_deviation(&r, (check_value){0.2, 2.0, 0.0}));
}

/* z²/2 near the expected value, and the cap far from it. */
static void test_losses_have_a_cap(void)
{
    const check_relation r = {.kind = CHECK_SHARE, .expected = 1.0, .tolerance = 0.1, .cap = 9.0};
    TEST_ASSERT_DOUBLE_WITHIN(
        1e-3, 0.5, hci_check_loss(&r, hci_check_found(1.1)) - hci_check_loss(&r, hci_check_found(1.0)));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 9.0, hci_check_loss(&r, hci_check_found(100.0)));
}

/* Σ xy/Σ x² through the origin; a recording that is known half as well counts half. */
static void test_the_fit_over_recordings(void)
{
    check_fit x = {0};
    TEST_ASSERT_TRUE(isnan(hci_check_fit_value(&x).found));
    hci_check_fit_add(&x, 2.0, 1.0, 0.0);
    hci_check_fit_add(&x, 9.0, 3.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, (2.0 + 27.0) / 10.0, hci_check_fit_value(&x).found);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, hci_check_fit_value(&x).spread);
    hci_check_fit_add(&x, 4.0, 2.0, 1.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, (29.0 + 0.5 * 8.0) / 12.0, hci_check_fit_value(&x).found);
    TEST_ASSERT_TRUE(hci_check_fit_value(&x).spread > 1.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_orders_and_phases_of_the_tables);
    RUN_TEST(test_orders_of_the_cogging_torque);
    RUN_TEST(test_pole_pairs_of_a_ripple);
    RUN_TEST(test_slopes_of_the_inductance);
    RUN_TEST(test_rated_torque);
    RUN_TEST(test_sizes);
    RUN_TEST(test_every_kind_of_back_emf);
    RUN_TEST(test_orders_of_the_recordings);
    RUN_TEST(test_a_unit_of_the_angle_is_no_gear);
    RUN_TEST(test_speeds_of_the_recordings);
    RUN_TEST(test_without_an_angle_the_frequency_tells);
    RUN_TEST(test_back_emf_of_the_recordings);
    RUN_TEST(test_resistance);
    RUN_TEST(test_power);
    RUN_TEST(test_torque);
    RUN_TEST(test_cogging_torque_of_the_recordings);
    RUN_TEST(test_phases);
    RUN_TEST(test_phase_currents_beside_i_d_and_i_q);
    RUN_TEST(test_pole_pairs_by_the_ripple_without_load);
    RUN_TEST(test_a_correct_motor_meets_every_relation);
    RUN_TEST(test_what_can_be_checked_does_not_depend_on_the_interpretation);
    RUN_TEST(test_deviations);
    RUN_TEST(test_losses_have_a_cap);
    RUN_TEST(test_the_fit_over_recordings);
    return UNITY_END();
}
