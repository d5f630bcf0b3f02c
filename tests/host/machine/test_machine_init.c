/* Machine folders from data sheets: readings against sampled waveforms and the power balance, real motors,
 * files. */
#include "hci/host/machine/init.h"
#include "hci/host/report/summary.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hci/host/machine/machine.h"
#include "hci/machine/frames.h"
#include "host/base/memory.h"
#include "support/files.h"
#include "unity.h"

#define RAD_PER_S_AT_1000_RPM 104.71975511965977

enum { SAMPLES = 720, READINGS = HCI_SHEET_FLUX + 1 };

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    static const char *const NAMES[] = {"m/machine.csv", "m/back_emf.csv",   "m/cogging.csv",
                                        "m/effects.csv", "m/inductance.csv", "m"};
    hci_memory_fail_after(-1);
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k)
        remove(files_path(NAMES[k]));
    TEST_ASSERT_EQUAL_MESSAGE(0, files_count(files_root), "something else is left in the folder");
    files_end();
}

static hci_sheet sheet_of(hci_sheet_reading reading, double strength, int pole_pairs)
{
    return (hci_sheet){"test", pole_pairs, 0,   reading, strength, NAN, false, NAN,
                       NAN,    NAN,        NAN, false,   NAN,      NAN, NAN};
}

/* ---- readings ---- */

typedef struct {
    double line_peak_V, line_rms_V, phase_peak_V, phase_rms_V;
} voltages;

/* Of phases k ω sin(θ − s 120°), sampled. */
static voltages voltages_at(double k, double speed_rad_per_s)
{
    voltages v = {0};
    for (int n = 0; n < SAMPLES; ++n) {
        const double x = 2.0 * HCI_PI * n / SAMPLES;
        const double a = k * speed_rad_per_s * sin(x);
        const double line = a - k * speed_rad_per_s * sin(x - 2.0 * HCI_PI / 3.0);
        v.phase_peak_V = fmax(v.phase_peak_V, fabs(a));
        v.line_peak_V = fmax(v.line_peak_V, fabs(line));
        v.phase_rms_V += a * a / SAMPLES;
        v.line_rms_V += line * line / SAMPLES;
    }
    v.phase_rms_V = sqrt(v.phase_rms_V);
    v.line_rms_V = sqrt(v.line_rms_V);
    return v;
}

static void test_voltages_are_those_of_sampled_waveforms(void)
{
    const double k = 0.37;
    const voltages at_1000 = voltages_at(k, RAD_PER_S_AT_1000_RPM);
    const voltages v = voltages_at(1.0, RAD_PER_S_AT_1000_RPM / 1000.0); /* k = 1, 1 rpm */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, at_1000.line_rms_V, hci_sheet_value(HCI_SHEET_VOLT_LINE_RMS, k, 3));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, at_1000.line_peak_V, hci_sheet_value(HCI_SHEET_VOLT_LINE_PEAK, k, 3));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, at_1000.phase_peak_V, hci_sheet_value(HCI_SHEET_VOLT_PHASE_PEAK, k, 3));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, at_1000.phase_rms_V, hci_sheet_value(HCI_SHEET_VOLT_PHASE_RMS, k, 3));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0 / v.line_peak_V, hci_sheet_value(HCI_SHEET_KV_LINE_PEAK, 1.0, 3));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0 / v.line_rms_V, hci_sheet_value(HCI_SHEET_KV_LINE_RMS, 1.0, 3));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0 / v.phase_peak_V, hci_sheet_value(HCI_SHEET_KV_PHASE_PEAK, 1.0, 3));
}

/* Mean of Σ e_s i_s over ω, with currents in phase with the EMF: what the shaft gets of each ampere. */
static double torque_of_sine(double k, double peak_A)
{
    double power_W = 0.0;
    const double speed_rad_per_s = 81.0;
    for (int n = 0; n < SAMPLES; ++n)
        for (int s = 0; s < 3; ++s) {
            const double shape = sin(2.0 * HCI_PI * n / SAMPLES - s * 2.0 * HCI_PI / 3.0);
            power_W += k * speed_rad_per_s * shape * peak_A * shape / SAMPLES;
        }
    return power_W / speed_rad_per_s;
}

static void test_torque_constants_keep_the_power(void)
{
    const double k = 0.37;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, torque_of_sine(k, 1.0), hci_sheet_value(HCI_SHEET_TORQUE_PEAK, k, 3));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, torque_of_sine(k, sqrt(2.0)),
                              hci_sheet_value(HCI_SHEET_TORQUE_RMS, k, 3));
    /* as in sheets of brushless motors: V/(rad/s) is N·m/A, with line-to-line volts and the ampere of the dc
     * side */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, voltages_at(k, 1.0).line_peak_V,
                              hci_sheet_value(HCI_SHEET_TORQUE_DC, k, 3));
    /* e = dψ/dt with ψ cos(pθ) */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, k / 3.0, hci_sheet_value(HCI_SHEET_FLUX, k, 3));
}

static void test_readings_lead_there_and_back(void)
{
    for (int r = 0; r < READINGS; ++r) {
        const hci_sheet_reading reading = (hci_sheet_reading)r;
        const double emf = hci_sheet_emf(reading, 12.5, 7);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-12, 12.5, hci_sheet_value(reading, emf, 7),
                                          hci_sheet_meaning(reading));
    }
}

/* ---- motors ---- */

static void test_hobby_motors(void)
{
    /* T-Motor MN4004, KV300, 12 pole pairs: 0.01857 V·s/rad were measured, 1 % from what its Kv says */
    TEST_ASSERT_DOUBLE_WITHIN(0.2, 296.9, hci_sheet_value(HCI_SHEET_KV_LINE_PEAK, 0.01857, 12));
    TEST_ASSERT_DOUBLE_WITHIN(0.011 * 0.01857, 0.01857, hci_sheet_emf(HCI_SHEET_KV_LINE_PEAK, 300.0, 12));
    /* open motor controllers: N·m per ampere peak is 8.27/Kv, and 9.549/Kv on the dc side */
    const double emf = hci_sheet_emf(HCI_SHEET_KV_LINE_PEAK, 270.0, 7);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 8.27 / 270.0, hci_sheet_value(HCI_SHEET_TORQUE_PEAK, emf, 7));
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 9.5493 / 270.0, hci_sheet_value(HCI_SHEET_TORQUE_DC, emf, 7));
}

static void test_servo_motors(void)
{
    /* 98 V/krpm line rms, 4 pole pairs: 98 √2/√3 = 80.017 V peak of a phase at 104.72 rad/s */
    const double emf = hci_sheet_emf(HCI_SHEET_VOLT_LINE_RMS, 98.0, 4);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.764105, emf);
    /* the usual rule of such sheets: N·m/A rms is sqrt(3) times V·s/rad line rms, 98 V/krpm is 1.62 N·m/A */
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 1.621, hci_sheet_value(HCI_SHEET_TORQUE_RMS, emf, 4));
    /* an example motor of motor-control software: flux 0.0052 Wb, 4 pole pairs, 3.8 V/krpm line peak */
    TEST_ASSERT_DOUBLE_WITHIN(
        0.04, 3.8, hci_sheet_value(HCI_SHEET_VOLT_LINE_PEAK, hci_sheet_emf(HCI_SHEET_FLUX, 0.0052, 4), 4));
}

/* The first multiple of 1/pole pairs with which both the slots and the poles repeat. */
static void test_cogging_orders(void)
{
    for (int slots = 3; slots <= 60; slots += 3)
        for (int p = 1; p <= 24; ++p) {
            int per_turn = 1;
            while (per_turn % slots != 0 || per_turn % (2 * p) != 0)
                per_turn++;
            TEST_ASSERT_EQUAL_INT(per_turn / p, hci_cogging_order(slots, p));
        }
    TEST_ASSERT_EQUAL_INT(12, hci_cogging_order(12, 5)); /* 12 slots, 10 poles: 60 in a turn */
    TEST_ASSERT_EQUAL_INT(6, hci_cogging_order(18, 12));
}

/* Coils of S slots have the electrical angles 2π p k/S: three phases are alike where turning these by a third
 * of a turn leaves them the same. */
static void test_three_equal_phases(void)
{
    for (int slots = 3; slots <= 60; ++slots)
        for (int p = 1; p <= 30; ++p) {
            bool has[180] = {false}, alike = true; /* in parts of 1/(3 slots) of a turn */
            for (int k = 0; k < slots; ++k)
                has[3 * p * k % (3 * slots)] = true;
            for (int k = 0; k < 3 * slots; ++k)
                alike = alike && has[k] == has[(k + slots) % (3 * slots)];
            TEST_ASSERT_EQUAL(alike, hci_has_equal_phases(slots, p));
        }
}

/* ---- do the ratings agree? ---- */

static void assert_remark(const hci_sheet *sheet, const char *words)
{
    hci_note remark;
    hci_sheet_remark(sheet, &remark);
    if (words == NULL) {
        TEST_ASSERT_EQUAL_STRING("", remark.text);
        return;
    }
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(remark.text, words), remark.text);
}

static void test_remarks(void)
{
    hci_sheet s = sheet_of(HCI_SHEET_TORQUE_RMS, 1.62, 4);
    assert_remark(&s, NULL);
    s.rated_current_A = 5.0;
    s.rated_current_is_rms = true;
    assert_remark(&s, NULL);
    s.rated_torque_Nm = 0.95 * 1.62 * 5.0;
    assert_remark(&s, NULL);
    s.rated_current_is_rms = false;
    assert_remark(&s, "about sqrt(2)");
    s.rated_current_is_rms = true;
    s.dc_link_voltage_V = 560.0;
    s.rated_speed_rpm = 3000.0;
    assert_remark(&s, NULL); /* √3 · 0.7637 · 314.16 = 415.5 V */
    s.dc_link_voltage_V = 400.0;
    assert_remark(&s, "415.5 V");
    s = sheet_of(HCI_SHEET_FLUX, 0.1, 8);
    s.rated_current_A = 10.0;
    s.rated_torque_Nm = 1.5 * 4 * 0.1 * 10.0;
    assert_remark(&s, "poles and pole pairs");
}

/* ---- files ---- */

static void write_good(const hci_sheet *sheet)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_init_write(files_path("m"), sheet, &note), note.text);
    TEST_ASSERT_EQUAL_STRING("", note.text);
}

static void read_back(hci_machine_data *m)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read(files_path("m"), m, &note), note.text);
    TEST_ASSERT_NULL_MESSAGE(strstr(m->remark.text, "not used"), m->remark.text);
    TEST_ASSERT_EQUAL_MESSAGE(m->model.cogging_count > 0,
                              strstr(m->remark.text, "cogging.csv: every amplitude is 0") != NULL,
                              m->remark.text);
}

static void test_the_least_reads_back(void)
{
    hci_machine_data m;
    const hci_sheet s = sheet_of(HCI_SHEET_KV_LINE_PEAK, 300.0, 12);
    write_good(&s);
    TEST_ASSERT_EQUAL_INT(2, files_count(files_path("m")));
    read_back(&m);
    TEST_ASSERT_EQUAL_INT(12, m.model.pole_pairs);
    TEST_ASSERT_EQUAL_INT(1, m.model.back_emf_count);
    TEST_ASSERT_EQUAL_INT(0, m.model.cogging_count);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, m.back_emf[0].order);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, hci_sheet_emf(s.reading, 300.0, 12), m.back_emf[0].sine);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, m.back_emf[0].cosine);
    TEST_ASSERT_FALSE(m.has_neutral);
    TEST_ASSERT_TRUE(isnan(m.resistance_ohm) && isnan(m.inductance_d_H) && isnan(m.rated_current_A));
    hci_machine_release(&m);
}

static void test_everything_reads_back(void)
{
    hci_machine_data m;
    hci_sheet s = sheet_of(HCI_SHEET_VOLT_LINE_RMS, 98.0, 4);
    s.slots = 12;
    s.resistance_ohm = 1.9;
    s.resistance_of_line = true;
    s.inductance_d_H = 4e-3;
    s.inductance_q_H = 6e-3;
    s.inertia_kgm2 = 2e-4;
    s.rated_current_A = 5.0;
    s.rated_current_is_rms = true;
    s.rated_torque_Nm = 7.9;
    s.rated_speed_rpm = 3000.0;
    s.dc_link_voltage_V = 560.0;
    write_good(&s);
    TEST_ASSERT_EQUAL_INT(4, files_count(files_path("m")));
    read_back(&m);
    TEST_ASSERT_EQUAL_DOUBLE(0.95, m.resistance_ohm);
    TEST_ASSERT_EQUAL_DOUBLE(4e-3, m.inductance_d_H);
    TEST_ASSERT_EQUAL_DOUBLE(6e-3, m.inductance_q_H);
    TEST_ASSERT_EQUAL_DOUBLE(2e-4, m.inertia_kgm2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 7.0710678118654755, m.rated_current_A);
    TEST_ASSERT_EQUAL_DOUBLE(7.9, m.rated_torque_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 314.1592653589793, m.rated_speed_rad_per_s);
    TEST_ASSERT_EQUAL_DOUBLE(560.0, m.dc_link_voltage_V);
    TEST_ASSERT_EQUAL_INT(3, m.model.cogging_count); /* 12 slots, 8 poles: 24 in a turn, electrical order 6 */
    char *text = files_read(files_path("m/cogging.csv"));
    TEST_ASSERT_NOT_NULL(strstr(text, "12 slots and 8 poles"));
    TEST_ASSERT_NOT_NULL(strstr(text, "= 6 periods in an electrical turn (24 in a mechanical"));
    free(text);
    for (size_t k = 0; k < 3; ++k) {
        TEST_ASSERT_EQUAL_DOUBLE(6.0 * (double)(k + 1), m.cogging[k].order);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, m.cogging[k].sine);
    }
    hci_machine_release(&m);
}

/* i_d, i_q of the frame in which the fundamental of the back-EMF is e_q. */
static double torque_of(const hci_machine_data *m, double d_A, double q_A, double theta_rad)
{
    double i[3];
    hci_clarke_inverse(hci_park_inverse((hci_dq){.d = d_A, .q = q_A}, theta_rad), i);
    return hci_torque_at(&m->model, theta_rad, i);
}

/* 3/2 p i_q (flux + (L_d - L_q) i_d) at every angle, by the tables that were written. */
static void test_inductances_that_differ_make_reluctance_torque(void)
{
    hci_machine_data m;
    hci_sheet s = sheet_of(HCI_SHEET_FLUX, 0.1, 4);
    s.inductance_d_H = 0.2e-3;
    s.inductance_q_H = 0.5e-3;
    write_good(&s);
    read_back(&m);
    for (int k = 0; k < 11; ++k) {
        const double theta_rad = 0.6 * k;
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.5 * 4 * 150.0 * (0.1 + 0.3e-3 * 200.0),
                                  torque_of(&m, -200.0, 150.0, theta_rad));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.5 * 4 * -50.0 * (0.1 - 0.3e-3 * 80.0),
                                  torque_of(&m, 80.0, -50.0, theta_rad));
    }
    hci_machine_release(&m);
}

static void test_inductances_that_are_nearly_equal_make_none(void)
{
    hci_machine_data m;
    hci_sheet s = sheet_of(HCI_SHEET_FLUX, 0.1, 4);
    s.inductance_d_H = 1.000e-3;
    s.inductance_q_H = 1.009e-3;
    write_good(&s);
    TEST_ASSERT_EQUAL_INT(2, files_count(files_path("m")));
    read_back(&m);
    hci_machine_release(&m);
}

static void test_odd_names_do_not_break_the_tables(void)
{
    hci_machine_data m;
    hci_sheet s = sheet_of(HCI_SHEET_FLUX, 0.01, 4);
    s.name = "a\nname,value\r\"\xff,\xc3\xa4";
    s.slots = 600;
    write_good(&s);
    read_back(&m);
    hci_machine_release(&m);
}

static void test_orders_stay_readable(void)
{
    hci_machine_data m;
    hci_sheet s = sheet_of(HCI_SHEET_FLUX, 0.01, 997);
    s.slots = 597; /* first order 1194, second above the highest that is read */
    write_good(&s);
    read_back(&m);
    TEST_ASSERT_EQUAL_INT(1, m.model.cogging_count);
    hci_machine_release(&m);
}

static void test_nothing_is_overwritten(void)
{
    static const char *const NAMES[] = {"m/machine.csv", "m/back_emf.csv", "m/cogging.csv",
                                        "m/inductance.csv", "m/effects.csv"};
    const hci_sheet s = sheet_of(HCI_SHEET_FLUX, 0.01, 4);
    write_good(&s);
    remove(files_path("m/machine.csv"));
    remove(files_path("m/back_emf.csv"));
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k) {
        hci_note note = {{0}};
        files_write(files_path(NAMES[k]), "mine");
        TEST_ASSERT_EQUAL(HCI_ERROR_OUTPUT, hci_init_write(files_path("m"), &s, &note));
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, NAMES[k]), note.text);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "another folder"), note.text);
        TEST_ASSERT_EQUAL_INT(1, files_count(files_path("m")));
        remove(files_path(NAMES[k]));
    }
}

static void test_wrong_values_are_refused(void)
{
    hci_sheet bad[8];
    for (int k = 0; k < 8; ++k)
        bad[k] = sheet_of(HCI_SHEET_FLUX, 0.01, 4);
    bad[0].pole_pairs = 0;
    bad[1].pole_pairs = 1001;
    bad[2].strength = 0.0;
    bad[3].strength = NAN;
    bad[4].slots = -3;
    bad[5].slots = HCI_MOST_SLOTS + 1;
    bad[6].resistance_ohm = -1.0;
    bad[7].dc_link_voltage_V = INFINITY;
    static const char *const NAMES[] = {"pole_pairs", "pole_pairs", "strength",   "strength",
                                        "slots",      "slots",      "resistance", "dc_link_voltage"};
    for (int k = 0; k < 8; ++k) {
        hci_note note = {{0}};
        TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_ARGUMENT, hci_init_write(files_path("m"), &bad[k], &note),
                                  note.text);
        TEST_ASSERT_EQUAL_STRING_LEN(NAMES[k], note.text, strlen(NAMES[k]));
        TEST_ASSERT_EQUAL_INT(-1, files_count(files_path("m")));
    }
}

static void test_memory_that_is_out_leaves_nothing(void)
{
    hci_status status = HCI_ERROR_MEMORY;
    hci_sheet s = sheet_of(HCI_SHEET_FLUX, 0.01, 4);
    s.slots = 12;
    long count = 0;
    for (; status != HCI_OK && count < 1000; ++count) {
        hci_note note = {{0}};
        hci_memory_fail_after(count);
        status = hci_init_write(files_path("m"), &s, &note);
        hci_memory_fail_after(-1);
        if (status == HCI_OK) break;
        TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_MEMORY, status, note.text);
        TEST_ASSERT_TRUE_MESSAGE(files_count(files_path("m")) <= 0, "a part of the tables is left");
    }
    TEST_ASSERT_TRUE(count > 2 && count < 1000);
}

static void test_the_summary_is_whole(void)
{
    hci_sheet s = sheet_of(HCI_SHEET_TORQUE_DC, 1.2345678901234567e-7, 1000);
    s.slots = 12;
    s.rated_current_A = 1.2345678901234567e-7;
    s.rated_torque_Nm = 1e9;
    char *text = hci_init_json(&s);
    TEST_ASSERT_NOT_NULL(text);
    TEST_ASSERT_EQUAL_STRING("\n}", text + strlen(text) - 2);
    TEST_ASSERT_NOT_NULL(strstr(text, "\"resistance_ohm\":\tnull"));
    TEST_ASSERT_NOT_NULL(strstr(text, "\"cogging.csv\""));
    TEST_ASSERT_NULL(strstr(text, "nan"));
    hci_text_free(text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_voltages_are_those_of_sampled_waveforms);
    RUN_TEST(test_torque_constants_keep_the_power);
    RUN_TEST(test_readings_lead_there_and_back);
    RUN_TEST(test_hobby_motors);
    RUN_TEST(test_servo_motors);
    RUN_TEST(test_cogging_orders);
    RUN_TEST(test_three_equal_phases);
    RUN_TEST(test_remarks);
    RUN_TEST(test_the_least_reads_back);
    RUN_TEST(test_everything_reads_back);
    RUN_TEST(test_inductances_that_differ_make_reluctance_torque);
    RUN_TEST(test_inductances_that_are_nearly_equal_make_none);
    RUN_TEST(test_odd_names_do_not_break_the_tables);
    RUN_TEST(test_orders_stay_readable);
    RUN_TEST(test_nothing_is_overwritten);
    RUN_TEST(test_wrong_values_are_refused);
    RUN_TEST(test_memory_that_is_out_leaves_nothing);
    RUN_TEST(test_the_summary_is_whole);
    return UNITY_END();
}
