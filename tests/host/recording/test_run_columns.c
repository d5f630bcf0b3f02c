/* The columns of a recording: what is found under which name, in which unit, and what is said of it. */
#include "host/recording/run_columns.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/recording/run.h"
#include "host/base/memory.h"
#include "support/draws.h"
#include "support/files.h"
#include "unity.h"

static hci_csv *csv;
static hci_run_columns columns;
static hci_note remark, note;

void setUp(void)
{
    memset(&columns, 0, sizeof columns);
    memset(&remark, 0, sizeof remark);
    memset(&note, 0, sizeof note);
    csv = NULL;
    files_begin();
}

void tearDown(void)
{
    hci_run_columns_release(&columns);
    hci_csv_free(csv);
    files_end();
}

static hci_status find(const char *text)
{
    const char *path = files_path("run.csv");
    files_write(path, text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(path, &csv, &note), note.text);
    return hci_run_columns_find(csv, &columns, &remark, &note);
}

static double first_value(hci_run_column which)
{
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_column_read(&columns, which), note.text);
    TEST_ASSERT_NOT_NULL(columns.value[which]);
    return columns.value[which][0];
}

/* ---- names and units */

/* Angles without a unit are in rad, unless they turn over at 360 or go to it in whole numbers. */
static void test_angles_that_look_like_degrees_are_told(void)
{
    static const struct {
        const char *text;
        bool told;
    } cases[] = {{"theta_m\n0\n120.3\n240.1\n359.9\n0.2\n", true},
                 {"theta_m\n0\n90\n180\n270\n359.5\n", true},
                 {"theta_m\n0\n90.3\n180\n270\n359.5\n", false}, /* 57 turns, slowly */
                 {"theta_m_rad\n0\n120.3\n240.1\n359.9\n0.2\n", false},
                 {"theta_m\n0\n2\n4\n6\n0.2\n", false}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        TEST_ASSERT_EQUAL(HCI_OK, find(cases[k].text));
        first_value(HCI_RUN_THETA_M);
        TEST_ASSERT_EQUAL_MESSAGE(cases[k].told,
                                  strstr(remark.text, "looks like degrees: name it theta_m_deg") != NULL,
                                  cases[k].text);
        memset(&remark, 0, sizeof remark);
        hci_run_columns_release(&columns);
        hci_csv_free(csv);
        csv = NULL;
    }
}

/* What a column that nobody read may be is told with the words that make it so: of several torques and speeds
 * the first, of currents all. */
static void test_what_may_be_a_torque_a_current_a_speed(void)
{
    char torque[HCI_RUN_NAME] = "", force[HCI_RUN_NAME] = "", current[HCI_RUN_NAME] = "";
    TEST_ASSERT_EQUAL(HCI_OK, find("theta_m_rad,lamp,Messwelle roh,torque raw 2,i along d raw,Messung roh_A,"
                                   "Drehzahl roh,speed raw\n0,1,2,3,4,5,6,7\n"));
    hci_run_columns_torque_like(&columns, torque, force);
    TEST_ASSERT_EQUAL_STRING("torque_Nm=Messwelle roh", torque);
    TEST_ASSERT_EQUAL_STRING(
        "`Messwelle roh` may be the torque: if it is, add --column 'torque_Nm=Messwelle roh'", remark.text);
    memset(&remark, 0, sizeof remark);
    hci_run_columns_current_like(&columns, current);
    TEST_ASSERT_EQUAL_STRING("iq=Messung roh_A", current);
    TEST_ASSERT_NOT_NULL_MESSAGE(
        strstr(remark.text, "`Messung roh_A` is a current that was not read: if it is i_q, add --column "
                            "'iq=Messung roh_A'"),
        remark.text);
    memset(&remark, 0, sizeof remark);
    hci_run_columns_speed_like(&columns);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(remark.text,
                                        "`Drehzahl roh` may be the speed: if it is, add --column "
                                        "'speed_rpm=Drehzahl roh' (speed_rad_per_s in rad/s, "
                                        "speed_rev_per_s in turn/s)"),
                                 remark.text);
    TEST_ASSERT_NULL_MESSAGE(strstr(remark.text, "speed raw"), remark.text);
}

/* Of a load cell on a lever, by its words or by its unit; not beside what may be a torque. */
static void test_what_may_be_a_force(void)
{
    static const struct {
        const char *text, *force;
    } CASES[] = {{"theta_m_rad,Kraft [N]\n0,1\n", "Kraft [N]"},
                 {"theta_m_rad,force_N\n0,1\n", "force_N"},
                 {"theta_m_rad,F [N]\n0,1\n", "F [N]"},
                 {"theta_m_rad,cell_g,load_g\n0,1,2\n", "load_g"},
                 {"theta_m_rad,N,PIN\n0,1,2\n", ""},
                 {"theta_m_rad,force_N,torque raw\n0,1,2\n", ""}};
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        char torque[HCI_RUN_NAME] = "", force[HCI_RUN_NAME] = "";
        TEST_ASSERT_EQUAL(HCI_OK, find(CASES[k].text));
        hci_run_columns_torque_like(&columns, torque, force);
        TEST_ASSERT_EQUAL_STRING(CASES[k].force, force);
        hci_run_columns_release(&columns);
        hci_csv_free(csv);
        csv = NULL;
    }
}

/* A torque in per cent of something cannot be read. */
static void test_a_torque_in_per_cent_is_told(void)
{
    char torque[HCI_RUN_NAME] = "", force[HCI_RUN_NAME] = "";
    TEST_ASSERT_EQUAL(HCI_OK, find("theta_m_rad,torque raw %\n0,1\n"));
    hci_run_columns_torque_like(&columns, torque, force);
    TEST_ASSERT_EQUAL_STRING("", torque);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(remark.text, "may be the torque in per cent of another one"),
                                 remark.text);
}

/* A column that could be the angle is not passed over for a map of means. */
static void test_a_column_that_may_be_the_angle_is_asked_for(void)
{
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, find("Winkel_roh,iq_A,torque_Nm\n0,1,1\n"));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "if `Winkel_roh` is the angle of the rotor, say --column"),
                                 note.text);
}

static void test_values_come_in_si_units(void)
{
    TEST_ASSERT_EQUAL(HCI_OK, find("Log of a bench\nmade by hand\n"
                                   "time,theta_e (deg),speed_rpm,ia,torque\nms,,,mA,\n"
                                   "2,90,60,500,1.5\n3,91,60,600,1.5\n"));
    TEST_ASSERT_EQUAL(2, columns.count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 2e-3, first_value(HCI_RUN_TIME));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 * REF_PI, first_value(HCI_RUN_THETA_E));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * REF_PI, first_value(HCI_RUN_SPEED));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5, first_value(HCI_RUN_IA));
    TEST_ASSERT_FALSE(columns.has[HCI_RUN_THETA_M] || columns.has[HCI_RUN_IB]);
    TEST_ASSERT_NOT_NULL(strstr(remark.text, "line 3 is the header"));
}

static void test_the_header_says_where_a_column_stands(void)
{
    size_t line = 0;
    find("made by hand\nLog of a bench\ntime,theta_e (deg),torque\n0,0,0\n1,1,0\n2,2,0\n");
    TEST_ASSERT_EQUAL_STRING("theta_e (deg)", hci_run_column_header(&columns, HCI_RUN_THETA_E, &line));
    TEST_ASSERT_EQUAL(3, (int)line);
    TEST_ASSERT_NULL(hci_run_column_header(&columns, HCI_RUN_IQ, &line));
}

/* What is supposed of another tool's name is said when the column is read, and not before. */
static void test_names_of_other_tools(void)
{
    find("time_s,theta_m_rad,erpm,q_axis_current\n0,0.1,60,7\n");
    TEST_ASSERT_EQUAL_STRING("", remark.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * REF_PI, first_value(HCI_RUN_SPEED_E));
    TEST_ASSERT_NOT_NULL(strstr(remark.text, "`erpm` is read as the electrical speed"));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 7.0, first_value(HCI_RUN_IQ));
    remark.text[0] = '\0';
    first_value(HCI_RUN_SPEED_E);
    TEST_ASSERT_EQUAL_STRING("", remark.text);
}

static void test_a_cell_that_is_no_number_is_refused(void)
{
    find("theta_m_rad,torque_Nm\n0,1\n0.1,x\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_run_column_read(&columns, HCI_RUN_TORQUE));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, ":3: column 2 `torque_Nm`: found `x`"), note.text);
}

static void test_what_nobody_read_is_told(void)
{
    find("time_s,theta_m_rad,iq_A,id_A,lamp\n0,0,1,2,3\n");
    first_value(HCI_RUN_THETA_M);
    first_value(HCI_RUN_IQ);
    hci_run_column_leave(&columns, HCI_RUN_ID);
    hci_run_columns_tell_unused(&columns);
    TEST_ASSERT_EQUAL_STRING("columns not used: `time_s`, `lamp`", remark.text);
}

static void test_taken_values_are_the_callers(void)
{
    find("theta_m_rad,iq_A\n0.5,1\n");
    first_value(HCI_RUN_THETA_M);
    double *theta = hci_run_column_take(&columns, HCI_RUN_THETA_M);
    TEST_ASSERT_NULL(columns.value[HCI_RUN_THETA_M]);
    hci_run_columns_release(&columns);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.5, theta[0]);
    hci_memory_free(theta);
}

/* ---- files that are no recording */

static void expect_refused(const char *text, const char *words)
{
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, find(text));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, words), note.text);
    tearDown();
    setUp();
}

static void test_without_angle_or_voltages_it_is_refused(void)
{
    expect_refused("time_s,torque_Nm\n0,1\n", "no angle of the rotor");
    expect_refused("time_s,theta,va_V,vb_V,vc_V\n0,1,1,1,1\n", "may be mechanical or electrical");
    expect_refused("theta_m_rad,torque_Nm\n", "a header and no samples");
    TEST_ASSERT_EQUAL(HCI_OK, find("time_s,va_V,vb_V,vc_V\n0,1,1,1\n"));
}

/* Voltages tell the angle of a shaft that turns, whatever a column beside them is. */
static void test_an_angle_beside_voltages_is_not_asked_for(void)
{
    expect_refused("id_A,iq_A,torque_Nm,encoder_x\n0,1,1,7\n", "encoder_x");
    TEST_ASSERT_EQUAL(HCI_OK, find("time_s,va_V,vb_V,vc_V,encoder_x\n0,1,1,1,7\n"));
}

/* ---- three phases */

/* Of a star without neutral: the third current makes the sum 0. */
static void test_the_third_phase_makes_the_sum_zero(void)
{
    double x[3];
    find("theta_m_rad,ia_A,ic_A\n0,1,2\n0,5,-1\n");
    TEST_ASSERT_EQUAL(2, hci_run_phase_count(&columns, HCI_RUN_IA));
    TEST_ASSERT_EQUAL(HCI_OK, hci_run_phases_read(&columns, HCI_RUN_IA));
    hci_run_phases_at(&columns, HCI_RUN_IA, 1, x);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 5.0, x[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, -4.0, x[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, -1.0, x[2]);
}

/* v = (3, −1, −2) V has v_ab = 4, v_bc = 1, v_ca = −5 V. */
static void test_phases_of_line_voltages(void)
{
    static const char *const FILES[] = {"theta_m_rad,vab_V,vbc_V,vca_V\n0,4,1,-5\n",
                                        "theta_m_rad,vab_V,vbc_V\n0,4,1\n"};
    for (size_t k = 0; k < 2; ++k) {
        hci_run_column first;
        double v[3];
        find(FILES[k]);
        TEST_ASSERT_TRUE(hci_run_voltages(&columns, &first));
        TEST_ASSERT_EQUAL(HCI_RUN_VAB, first);
        hci_run_phases_read(&columns, first);
        hci_run_phases_at(&columns, first, 0, v);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0, v[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, -1.0, v[1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, -2.0, v[2]);
        tearDown();
        setUp();
    }
}

/* Of two phases to the star point the third makes the sum 0; line voltages come before that. */
static void test_which_voltages_are_taken(void)
{
    static const struct {
        const char *header;
        bool found;
        hci_run_column first;
    } CASES[] = {{"va_V,vb_V,vc_V", true, HCI_RUN_VA},     {"va_V,vb_V,time_s", true, HCI_RUN_VA},
                 {"va_V,lamp,time_s", false, HCI_RUN_VAB}, {"vab_V,time_s,torque", false, HCI_RUN_VAB},
                 {"va_V,vab_V,vca_V", true, HCI_RUN_VAB},  {"vb_V,vab_V,vca_V", true, HCI_RUN_VAB}};
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        hci_run_column first;
        char text[100];
        snprintf(text, sizeof text, "theta_m_rad,%s\n0,1,2,3\n", CASES[k].header);
        find(text);
        TEST_ASSERT_EQUAL_MESSAGE(CASES[k].found, hci_run_voltages(&columns, &first), CASES[k].header);
        if (CASES[k].found) TEST_ASSERT_EQUAL_MESSAGE(CASES[k].first, first, CASES[k].header);
        tearDown();
        setUp();
    }
}

/* ---- the readers above it */

/* Phase currents of i_d = −2 A, i_q = 10 A are those columns turned by the angle: i_a = i_q sin θ − i_d cos θ
 * (theory.md), here at 90 degrees. */
static void test_a_run_is_made_of_these_columns(void)
{
    hci_run run;
    find("theta_e (deg),Id_measured,Iq_measured\n90,-2,10\n90,-2,10\n");
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK, hci_run_of_csv(csv, &(hci_run_options){.pole_pairs = 1, .inertia_kgm2 = NAN}, &run, &note),
        note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 10.0, run.i_A[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 * REF_PI, run.theta_m_rad[0]);
    hci_run_release(&run);
}

static void test_out_of_memory(void)
{
    hci_status status = HCI_ERROR_MEMORY;
    find("theta_m_rad,iq_A\n0,1\n");
    for (long count = 0; status == HCI_ERROR_MEMORY && count < 20; ++count) {
        hci_run_columns_release(&columns);
        memset(&note, 0, sizeof note);
        hci_memory_fail_after(count);
        status = hci_run_columns_find(csv, &columns, &remark, &note);
        if (!status) status = hci_run_column_read(&columns, HCI_RUN_IQ);
    }
    hci_memory_fail_after(-1);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, status, note.text);
}

/* A word for the quantity before the name, a unit after "in", capitals with accents. */
static void test_names_in_other_languages_are_read(void)
{
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK,
                              find("Zeit in ms,mechanischer Winkel in \xC2\xB0,Drehzahl [1/min],Strom "
                                   "Iq,Strom d,Spannung L1,Spannung "
                                   "L2,Drehmoment (mNm)\n1000,180,60,2,3,4,5,6\n"),
                              note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, first_value(HCI_RUN_TIME));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, acos(-1.0), first_value(HCI_RUN_THETA_M));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * acos(-1.0), first_value(HCI_RUN_SPEED));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, first_value(HCI_RUN_IQ));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0, first_value(HCI_RUN_ID));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0, first_value(HCI_RUN_VA));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.0, first_value(HCI_RUN_VB));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.006, first_value(HCI_RUN_TORQUE));
}

/* Two or three voltages do without an angle. */
static void test_a_voltage_of_another_name_is_asked_for(void)
{
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, find("time_s,probe (V),gate (V)\n0,1,1\n"));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "say --column \"va=probe (V)\""), note.text);
    remark.text[0] = note.text[0] = '\0';
    hci_run_columns_release(&columns);
    hci_csv_free(csv);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, find("Zeit in s,Spannung U12 in V,Spannung U23 in V\n0,1,2\n"),
                              note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, first_value(HCI_RUN_VBC));
}

static void test_more_languages_are_read(void)
{
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK,
        find("temps,\xC3\x81NGULO MEC\xC3\x81NICO,velocit\xC3\xA0,courant phase a,corriente "
             "b,corrente Ic,couple\n1,2,60,3,4,5,6\n"),
        note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, first_value(HCI_RUN_THETA_M));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0, first_value(HCI_RUN_IA));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0, first_value(HCI_RUN_IB));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.0, first_value(HCI_RUN_IC));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 6.0, first_value(HCI_RUN_TORQUE));
}

/* At 60 rpm, for 0.5 s, wrapped after a turn of it. */
static void read_bare(const char *angle, double turns_per_s, double full)
{
    char text[4096];
    size_t used = (size_t)snprintf(text, sizeof text, "t,rpm,%s,torque_Nm\n", angle);
    for (int k = 0; k < 50; ++k)
        used += (size_t)snprintf(text + used, sizeof text - used, "%.2f,60,%.4f,1\n", 0.01 * k,
                                 full * fmod(0.01 * k * turns_per_s, 1.0));
    const char *path = files_path("run.csv");
    const hci_run_options options = {.pole_pairs = 4};
    files_write(path, text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_csv(path, &options, &csv, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_columns_find(csv, &columns, &remark, &note), note.text);
}

static void test_a_bare_angle_is_what_turns_as_fast_as_the_speed(void)
{
    static const struct {
        const char *name;
        double turns_per_s, full;
        hci_run_column which;
    } CASES[] = {{"Angle (deg)", 1.0, 360.0, HCI_RUN_THETA_M},
                 {"Angle", 4.0, 6.283185307, HCI_RUN_THETA_E},
                 {"Winkel", 1.0, 360.0, HCI_RUN_THETA_M},
                 {"angle", -4.0, 360.0, HCI_RUN_THETA_E}};
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        read_bare(CASES[k].name, CASES[k].turns_per_s, CASES[k].full);
        TEST_ASSERT_TRUE_MESSAGE(columns.has[CASES[k].which], CASES[k].name);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_column_read(&columns, CASES[k].which), note.text);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.02 * acos(-1.0) * CASES[k].turns_per_s,
                                  columns.value[CASES[k].which][1]);
        const char *told = CASES[k].which == HCI_RUN_THETA_M ? "it turns as fast as the speed says"
                                                             : "by the pole pairs faster than the speed says";
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(remark.text, told), remark.text);
        hci_run_columns_release(&columns);
        hci_csv_free(csv);
        csv = NULL;
        memset(&remark, 0, sizeof remark);
    }
}

/* ---- phase currents in amperes rms ---- */

static void expect_phases(double a_A, double b_A)
{
    for (int times = 0; times < 2; ++times) /* read again they are the same */
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_phases_read(&columns, HCI_RUN_IA), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, a_A, columns.value[HCI_RUN_IA][0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, b_A, columns.value[HCI_RUN_IB][0]);
}

/* What swings to both sides is no rms value, however the header has it. */
static void test_currents_that_swing_are_no_rms_values(void)
{
    find("theta_m_rad,ia_Arms,ib [Aeff]\n0,2,-1\n1,-1.5,2\n2,1,0.5\n");
    expect_phases(2.0, -1.0);
    TEST_ASSERT_NOT_NULL(strstr(remark.text, "`ia_Arms` swings to both sides of 0"));
    TEST_ASSERT_NULL(strstr(remark.text, "`ib [Aeff]` swings"));
}

/* One that keeps its sign, but for noise, may be one. */
static void test_currents_of_one_sign_may_be_rms_values(void)
{
    find("theta_m_rad,ia_Arms,ib_A\n0,2,-1\n1,1.5,2\n2,-0.5,0.5\n");
    expect_phases(2.0 * sqrt(2.0), -1.0);
    TEST_ASSERT_NULL(strstr(remark.text, "swings"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_names_in_other_languages_are_read);
    RUN_TEST(test_a_voltage_of_another_name_is_asked_for);
    RUN_TEST(test_more_languages_are_read);
    RUN_TEST(test_a_bare_angle_is_what_turns_as_fast_as_the_speed);
    RUN_TEST(test_angles_that_look_like_degrees_are_told);
    RUN_TEST(test_what_may_be_a_torque_a_current_a_speed);
    RUN_TEST(test_what_may_be_a_force);
    RUN_TEST(test_a_torque_in_per_cent_is_told);
    RUN_TEST(test_a_column_that_may_be_the_angle_is_asked_for);
    RUN_TEST(test_values_come_in_si_units);
    RUN_TEST(test_the_header_says_where_a_column_stands);
    RUN_TEST(test_names_of_other_tools);
    RUN_TEST(test_a_cell_that_is_no_number_is_refused);
    RUN_TEST(test_what_nobody_read_is_told);
    RUN_TEST(test_taken_values_are_the_callers);
    RUN_TEST(test_without_angle_or_voltages_it_is_refused);
    RUN_TEST(test_an_angle_beside_voltages_is_not_asked_for);
    RUN_TEST(test_the_third_phase_makes_the_sum_zero);
    RUN_TEST(test_phases_of_line_voltages);
    RUN_TEST(test_which_voltages_are_taken);
    RUN_TEST(test_a_run_is_made_of_these_columns);
    RUN_TEST(test_out_of_memory);
    RUN_TEST(test_currents_that_swing_are_no_rms_values);
    RUN_TEST(test_currents_of_one_sign_may_be_rms_values);
    return UNITY_END();
}
