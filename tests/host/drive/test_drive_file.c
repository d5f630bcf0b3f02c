/* drive.csv and loop.csv: what they may hold, what is said of what they may not, and what a drive and a
 * machine make of each other. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/drive/drive.h"
#include "host/base/memory.h"
#include "host/drive/machine_model.h"
#include "support/files.h"
#include "unity.h"

static hci_machine_data machine_a, machine_c;

void setUp(void)
{
    hci_note note = {{0}};
    files_begin();
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_machine_read("data/machine_a", &machine_a, &note));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_machine_read("data/machine_c", &machine_c, &note));
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_machine_release(&machine_a);
    hci_machine_release(&machine_c);
    files_end();
}

static hci_status read_rows(const char *rows, hci_drive_data *drive, hci_note *note)
{
    char text[2048];
    memset(note, 0, sizeof *note);
    snprintf(text, sizeof text, "name,value,unit\n%s", rows);
    files_write(files_path("drive.csv"), text);
    return hci_drive_read(files_path("drive.csv"), drive, note);
}

/* The file is refused, and the note has these words. */
static void refuse(const char *rows, const char *words)
{
    hci_drive_data drive;
    hci_note note;
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_ERROR_INPUT, read_rows(rows, &drive, &note), rows);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, words), note.text);
    TEST_ASSERT_NULL(drive.response);
}

static void test_values_are_read_in_their_units(void)
{
    hci_drive_data d;
    hci_note note;
    TEST_ASSERT_EQUAL_INT_MESSAGE(
        HCI_OK,
        read_rows("current_control,pi,\ncurrent_sample_time,50,us\ncurrent_kp,12,ohm\n"
                  "dead_time,1.5,us\ndecoupling,constant,\nmodulation,sinusoidal,\n"
                  "encoder_counts,4096,\nresistance,200,mohm\n",
                  &d, &note),
        note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 50e-6, d.sample_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.5e-6, d.dead_time_s);
    TEST_ASSERT_EQUAL_DOUBLE(12.0, d.kp_ohm);
    TEST_ASSERT_EQUAL_DOUBLE(0.2, d.resistance_ohm);
    TEST_ASSERT_EQUAL_DOUBLE(4096.0, d.encoder_counts);
    TEST_ASSERT_EQUAL_INT(HCI_DECOUPLING_CONSTANT, d.decoupling);
    TEST_ASSERT_EQUAL_INT(HCI_MODULATION_SINUSOIDAL, d.modulation);
    TEST_ASSERT_TRUE(isnan(d.ki_ohm_per_s));
    hci_drive_release(&d);
}

static void test_a_circle_is_a_range(void)
{
    hci_drive_data d;
    hci_note note;
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_rows("modulation,circle,\n", &d, &note), note.text);
    TEST_ASSERT_EQUAL_INT(HCI_MODULATION_CIRCLE, d.modulation);
    hci_drive_release(&d);
}

/* Once released it is as one of which nothing is given, and may be released again. */
static void test_a_drive_that_is_released_is_empty(void)
{
    hci_drive_data d;
    hci_note note;
    files_write(files_path("loop.csv"), "frequency_Hz,gain_d,phase_d_rad,gain_q,phase_q_rad\n"
                                        "10,1,0,1,0\n20,1,0,1,0\n30,1,0,1,0\n40,1,0,1,0\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_rows("current_kp,12,ohm\nresponse,loop.csv,\n", &d, &note),
                                  note.text);
    for (int time = 0; time < 2; ++time) {
        hci_drive_release(&d);
        TEST_ASSERT_NULL(d.response);
        TEST_ASSERT_EQUAL_UINT64(0, d.response_count);
        TEST_ASSERT_TRUE(isnan(d.kp_ohm));
        TEST_ASSERT_EQUAL_STRING("", d.path);
    }
}

static void test_wrong_rows_are_named(void)
{
    refuse("current_kp,12,ohm\ncurrent_kp,13,ohm\n", "drive.csv:3: column");
    refuse("kp,12,ohm\n",
           "drive.csv:2: column 1 `name`: found `kp`, expected a name that is known here; docs/files.md");
    refuse("current_control,hysteresis,\n", "drive.csv:2: column");
    refuse("current_control,hysteresis,\n", "expected one of: pi");
    refuse("decoupling,some,\n", "expected one of: table, constant, none");
    refuse("decoupling,none,\ndecoupling,none,\n", "each name once");
    refuse("dead_time,-1,us\n", "a number from 0 to 0.01 s");
    refuse("encoder_counts,10.5,\n", "a whole number");
    refuse("current_sample_time,1,V\n", "a unit that converts to s");
    refuse("response,,\n", "the path of loop.csv");
    refuse("response,nowhere.csv,\n", "nowhere.csv");
}

static void refuse_response(const char *rows, const char *words)
{
    char text[2048];
    snprintf(text, sizeof text, "frequency_Hz,gain_d,phase_d_rad,gain_q,phase_q_rad\n%s", rows);
    files_write(files_path("loop.csv"), text);
    refuse("response,loop.csv,\n", words);
}

static void test_a_measured_response_is_read(void)
{
    hci_drive_data d;
    hci_note note;
    files_write(files_path("loop.csv"),
                "frequency_Hz,gain_d,phase_d_deg,gain_q,phase_q_rad\n10,1,-2,1.01,-0.03\n"
                "100,0.9,-20,0.95,-0.3\n300,0.6,-50,0.7,-0.8\n900,0.2,-90,0.3,-1.5\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_rows("response,loop.csv,\n", &d, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(4, d.response_count);
    TEST_ASSERT_EQUAL_DOUBLE(300.0, d.response[2].frequency_Hz);
    TEST_ASSERT_EQUAL_DOUBLE(0.95, d.response[1].gain[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, -3.14159265358979323846 / 9.0, d.response[1].phase_rad[0]);
    TEST_ASSERT_EQUAL_DOUBLE(-1.5, d.response[3].phase_rad[1]);
    hci_drive_release(&d);
    refuse_response("10,1,0,1,0\n20,1,0,1,0\n30,1,0,1,0\n",
                    "loop.csv: found 3 frequencies, expected at least 4");
    refuse_response("10,1,0,1,0\n20,1,0,1,0\n20,1,0,1,0\n40,1,0,1,0\n", "loop.csv:4: column");
    refuse_response("0,1,0,1,0\n20,1,0,1,0\n30,1,0,1,0\n40,1,0,1,0\n", "a frequency above 0");
    refuse_response("10,1,0,1,0\n20,1,0,-3,0\n30,1,0,1,0\n40,1,0,1,0\n", "not decibels");
    refuse_response("10,1,-2,1,-2\n20,1,-4,1,-4\n30,1,-6,1,-6\n40,1,-8,1,-8\n", "phase_d_deg");
    refuse_response("10,1,-.1,1,.1\n20,1,-.2,1,.2\n30,1,-.3,1,.3\n40,1,-.4,1,.4\n", "the current is late");
}

/* ---- with a machine ---- */

static hci_status fit(const char *rows, const hci_machine_data *machine, hci_machine_data *fitted,
                      hci_note *note)
{
    hci_drive_data d;
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_rows(rows, &d, note), note->text);
    const hci_status status = hci_drive_fit(&d, machine, fitted, note);
    hci_drive_release(&d);
    return status;
}

static void refuse_fit(const char *rows, const hci_machine_data *machine, const char *words)
{
    hci_machine_data fitted;
    hci_note note;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, fit(rows, machine, &fitted, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, words), note.text);
}

#define WINDING "resistance,0.1,ohm\ninductance_d,0.5,mH\ninductance_q,0.5,mH\n"

/* k_p = 2π f L and k_i = 2π f R, and gains that are given come first. */
static void test_gains_by_a_bandwidth(void)
{
    for (int given = 0; given < 2; ++given) {
        hci_machine_data fitted;
        hci_drive_data d;
        hci_note note;
        TEST_ASSERT_EQUAL_INT_MESSAGE(
            HCI_OK,
            read_rows(given ? WINDING "dc_link_voltage,60,V\nbandwidth,0.2,kHz\ncurrent_kp,3,ohm\n"
                            : WINDING "dc_link_voltage,60,V\nbandwidth,0.2,kHz\n",
                      &d, &note),
            note.text);
        TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_drive_fit(&d, &machine_a, &fitted, &note), note.text);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, given ? 3.0 : 2.0 * 3.14159265358979323846 * 200.0 * 0.5e-3,
                                  d.kp_ohm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0 * 3.14159265358979323846 * 200.0 * 0.1, d.ki_ohm_per_s);
        hci_drive_release(&d);
    }
}

static void test_drive_and_machine_complete_each_other(void)
{
    hci_machine_data fitted;
    hci_note note;
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, fit(WINDING "dc_link_voltage,60,V\n", &machine_a, &fitted, &note),
                                  note.text);
    TEST_ASSERT_EQUAL_DOUBLE(0.1, fitted.resistance_ohm);
    TEST_ASSERT_EQUAL_DOUBLE(60.0, fitted.dc_link_voltage_V);
    TEST_ASSERT_TRUE(isnan(machine_a.resistance_ohm));
    refuse_fit(WINDING, &machine_a, "no `dc_link_voltage`");
    refuse_fit("dc_link_voltage,60,V\n", &machine_a, "no `resistance`");
    refuse_fit("resistance,0.1,ohm\ndc_link_voltage,60,V\n", &machine_a, "no `inductance_d`");
    refuse_fit("resistance,1,ohm\n", &machine_c, "`resistance` is in machine.csv already");
    refuse_fit("inductance_d,1,mH\n", &machine_c, "beside inductance.csv");
    refuse_fit("computing_delay,150,us\n", &machine_c, "`computing_delay` is 0.00015 s, expected at most");
    refuse_fit("dead_time,60,us\n", &machine_c, "less than half");
    refuse_fit("dead_time,30,us\npwm_frequency,20,kHz\n", &machine_c, "which is 5e-05 s");
}

/* Gains just above those that are stable: the share of them that is advised is stable, and less than all. */
static void test_the_share_that_is_advised_is_stable(void)
{
    hci_machine_data fitted;
    hci_note note = {{0}};
    double stable_ohm = 800.0, unstable_ohm = 1300.0;
    char row[64];
    for (int k = 0; k < 8; ++k) { /* to 2 V/A, of which a share of 0.998 is left */
        const double middle_ohm = 0.5 * (stable_ohm + unstable_ohm);
        snprintf(row, sizeof row, "current_kp,%g,ohm\ncurrent_ki,6000,\n", middle_ohm);
        if (fit(row, &machine_c, &fitted, &note) == HCI_OK)
            stable_ohm = middle_ohm;
        else
            unstable_ohm = middle_ohm;
    }
    snprintf(row, sizeof row, "current_kp,%g,ohm\ncurrent_ki,6000,\n", unstable_ohm);
    refuse_fit(row, &machine_c, "both together at most 0.99 of that are");
}

/* Machine C's loop turns unstable at five times the default gain, which is said with the share that is not.
 */
static void test_an_unstable_loop_is_refused_before_it_runs(void)
{
    hci_machine_data fitted;
    hci_note note;
    hci_drive_data d;
    refuse_fit("current_kp,1300,ohm\ncurrent_ki,6000,\n", &machine_c,
               "is not stable at 0 rpm: largest pole 1.");
    refuse_fit("current_kp,1300,ohm\ncurrent_ki,6000,\n", &machine_c, "both together at most 0.");
    TEST_ASSERT_EQUAL_INT(HCI_OK, fit("current_kp,800,ohm\ncurrent_ki,6000,\n", &machine_c, &fitted, &note));
    TEST_ASSERT_EQUAL_INT(HCI_OK, read_rows("", &d, &note));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_drive_fit(&d, &machine_c, &fitted, &note));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_drive_check_speed(&d, &fitted, 100.0, &note));
    /* ten samples in an electrical turn of two pole pairs at 10 kHz: 30 000 rpm */
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, hci_drive_check_speed(&d, &fitted, 3300.0, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(
        strstr(note.text, "samples in an electrical turn, expected at least 10: at most 3e+04 rpm"),
        note.text);
    hci_drive_release(&d);
}

/* L_d and L_q as means over the turn: those of a machine that was made of them. */
static void test_mean_inductances(void)
{
    hci_machine_data m = machine_a;
    hci_machine_model model, constant;
    hci_note note = {{0}};
    m.resistance_ohm = 0.3;
    m.inductance_d_H = 2e-3;
    m.inductance_q_H = 5e-3;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_machine_model_make(&m, &model, &note));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_machine_model_make_constant(&m, &constant, &note));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2e-3, model.inductance_H[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5e-3, model.inductance_H[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5e-3, constant.inductance_H[1]);
    /* the fundamental alone: 21.93 V at 157.08 rad/s, in the orthonormal plane */
    const hci_plant_point p = hci_plant_table_at(&constant.table, 0.37);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, sqrt(1.5) * 21.93 / (50.0 * 3.14159265358979323846),
                              hypot(p.magnetic.e[0], p.magnetic.e[1]));
    hci_machine_model_release(&model);
    hci_machine_model_release(&constant);
}

static void test_memory_runs_out_with_a_note(void)
{
    hci_drive_data d;
    hci_machine_data fitted;
    hci_note note;
    for (long k = 0; k < 12; ++k) {
        hci_status status = read_rows("", &d, &note);
        TEST_ASSERT_EQUAL_INT(HCI_OK, status);
        hci_memory_fail_after(k);
        status = hci_drive_fit(&d, &machine_c, &fitted, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK || (status == HCI_ERROR_MEMORY && note.text[0]));
        hci_drive_release(&d);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_values_are_read_in_their_units);
    RUN_TEST(test_a_circle_is_a_range);
    RUN_TEST(test_a_drive_that_is_released_is_empty);
    RUN_TEST(test_wrong_rows_are_named);
    RUN_TEST(test_a_measured_response_is_read);
    RUN_TEST(test_gains_by_a_bandwidth);
    RUN_TEST(test_drive_and_machine_complete_each_other);
    RUN_TEST(test_the_share_that_is_advised_is_stable);
    RUN_TEST(test_an_unstable_loop_is_refused_before_it_runs);
    RUN_TEST(test_mean_inductances);
    RUN_TEST(test_memory_runs_out_with_a_note);
    return UNITY_END();
}
