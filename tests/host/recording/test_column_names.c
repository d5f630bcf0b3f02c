/* Columns of a recording that the user names: options, a table beside the files, and what is said of names
 * that are not there. */
#include "hci/host/recording/column_names.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "hci/host/recording/run.h"
#include "host/base/memory.h"
#include "support/draws.h"
#include "support/run_file.h"
#include "support/texts.h"
#include "unity.h"

static hci_column_names names;

void setUp(void)
{
    run_file_begin();
    memset(&names, 0, sizeof names);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_column_names_release(&names);
    run_file_end();
}

static hci_status read_run(void)
{
    const hci_run_options options = {.pole_pairs = 2, .inertia_kgm2 = NAN, .columns = &names};
    hci_run_release(&run);
    memset(&note, 0, sizeof note);
    return hci_run_read(path, &options, &run, &note);
}

static void add(const char *text)
{
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_column_names_add(&names, text, &note), note.text);
}

#define CHANNELS "AI1,AI2 (mV),AI3,spare\n0,0,1,9\n0.1,1,2,9\n0.2,2,3,9\n"

/* ---- as one text */

static hci_status add_text(const char *text)
{
    hci_column_names_release(&names);
    memset(&note, 0, sizeof note);
    return hci_column_names_add_text(&names, text, "here:7", &note);
}

static void test_names_in_one_text(void)
{
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, add_text("theta_m_rad=AI1;torque_Nm=-AI3"), note.text);
    TEST_ASSERT_EQUAL_UINT64(2, names.count);
    TEST_ASSERT_EQUAL_STRING("theta_m_rad", names.item[0].name);
    TEST_ASSERT_EQUAL_STRING("AI1", names.item[0].column);
    TEST_ASSERT_EQUAL_STRING("torque_Nm", names.item[1].name);
    TEST_ASSERT_EQUAL_STRING("-AI3", names.item[1].column);
    TEST_ASSERT_EQUAL_STRING("here:7", names.item[1].from);
    const hci_column_names *const several[] = {&names, NULL, &names};
    char *text = hci_column_names_text(several, 3);
    TEST_ASSERT_EQUAL_STRING("theta_m_rad=AI1;torque_Nm=-AI3;theta_m_rad=AI1;torque_Nm=-AI3", text);
    hci_column_names_text_free(text);
    text = hci_column_names_text(several, 0);
    TEST_ASSERT_EQUAL_STRING("", text);
    hci_column_names_text_free(text);
    TEST_ASSERT_EQUAL(HCI_OK, add_text(""));
    TEST_ASSERT_EQUAL_UINT64(0, names.count);
    TEST_ASSERT_EQUAL(HCI_OK, add_text("torque_Nm=a=b;"));
    TEST_ASSERT_EQUAL_STRING("a=b", names.item[0].column);
}

/* As messages and pages write them. */
static void test_names_with_subscripts(void)
{
    static const char *const SAID[][2] = {
        {"i_d=A", "id"},          {"i_q_mA=A", "iq_mA"},  {"i_a=A", "ia"},
        {"v_ab_V=A", "vab_V"},    {"v_q=A", "vq"},        {"iq=A", "iq"},
        {"theta_m=A", "theta_m"}, {"torque=A", "torque"}, {"speed=A", "speed"}};
    for (size_t k = 0; k < sizeof SAID / sizeof *SAID; ++k) {
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, add_text(SAID[k][0]), note.text);
        TEST_ASSERT_EQUAL_STRING(SAID[k][1], names.item[0].name);
    }
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, add_text("i_dq=A"));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, add_text("i_=A"));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, add_text("i_d=A;id=B;i_d_A=A"));
}

/* A part without a name, a sign or a column; what follows a good one is told with its rest. */
static void test_texts_that_are_no_names(void)
{
    static const char *const WRONG[] = {
        "=AI3", "torque_Nm", "torque_Nm=", ";", "torque_Nm;AI3=x", "torque_Nm=;iq=a"};
    char words[200];
    for (size_t k = 0; k < sizeof WRONG / sizeof *WRONG; ++k) {
        TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_INPUT, add_text(WRONG[k]), WRONG[k]);
        snprintf(words, sizeof words,
                 "here:7: found `%s`, expected NAME=COLUMN;NAME=COLUMN such as torque_Nm=AI3", WRONG[k]);
        TEST_ASSERT_EQUAL_STRING(words, note.text);
    }
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, add_text("iq=a;=b;id=c"));
    text_has("found `=b;id=c`", note.text);
    TEST_ASSERT_EQUAL(HCI_OK, add_text("iq=a")); /* the shortest */
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, add_text("lamp=a;torque_Nm=b"));
    text_has("here:7: found `lamp`", note.text);
}

/* ---- what they do */

static void test_columns_without_a_name(void)
{
    files_write(path, "AI1,AI2,AI3,spare\n0,0,1000,9\n90,1,2000,9\n180,2,3000,9\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    add("theta_e_deg=AI1");
    add("iq=AI2");
    add("torque_mNm=ai3");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.25 * REF_PI, run.theta_m_rad[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, run.torque_Nm[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, run.i_A[3]);
    text_has("columns not used: `spare`", run.remark.text);
}

/* A column that is left out is as if it were not there: what it has no numbers for is no hole. */
static void test_a_column_that_is_left_out(void)
{
    files_write(path,
                "theta_e_deg,iq_A,torque_Nm,speed_rpm,n\n0,0,1,10,1\n90,1,2,,1\n180,2,3,,1\n270,2,3,,1\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    add("none=speed_rpm");
    add("none=n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_EQUAL(4, run.count);
    text_has("columns not used: `speed_rpm`, `n`", run.remark.text);
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, hci_column_names_add(&names, "iq=n", &note));
    hci_column_names_release(&names);
    add("none=nowhere");
    add("none=n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("found no column `nowhere`", note.text);
}

/* Two times beside each other, the second at `rate` of the first, `later` and held for `held` rows. */
static void two_clocks_write(const char *header, double rate, double later, int held)
{
    char text[6000];
    size_t used = (size_t)snprintf(text, sizeof text, "%s\n", header);
    for (int k = 0; k < 100; ++k)
        used += (size_t)snprintf(text + used, sizeof text - used, "%.4f,%d,0,%.4f,%d.5\n", 0.01 * k, 3 * k,
                                 later + rate * 0.01 * (k - k % held), 10 + k % 7);
    files_write(path, text);
}

#define TWO_CLOCKS "t [s],theta_e_deg,iq_A,t2 [s],torque_Nm"

static void test_two_clocks_in_one_table(void)
{
    static const struct {
        const char *header;
        double rate, later;
        int held;
        hci_status status;
    } CASES[] = {
        {TWO_CLOCKS, 1.0, 0.0, 1, HCI_OK},
        {TWO_CLOCKS, 1.01, 1e3, 1, HCI_OK}, /* another zero, and a drift */
        {TWO_CLOCKS, 1.0, 0.0, 10, HCI_OK}, /* held */
        {"t [s],theta_e_deg,iq_A,t2 [ms],torque_Nm", 1e3, 0.0, 1, HCI_OK},
        {"t [s],theta_e_deg,iq_A,t2 [s],pump", 1.6, 0.0, 1, HCI_OK}, /* of nothing that is read */
        {TWO_CLOCKS, 1.6, 0.0, 1, HCI_ERROR_INPUT},
        {TWO_CLOCKS, 10.0, 5.0, 1, HCI_ERROR_INPUT},
        {"Zeit 1 [s],theta_e_deg,iq_A,Zeit 2 [s],torque_Nm", 0.6, 0.0, 1, HCI_ERROR_INPUT},
    };
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        two_clocks_write(CASES[k].header, CASES[k].rate, CASES[k].later, CASES[k].held);
        TEST_ASSERT_EQUAL_MESSAGE(CASES[k].status, read_run(), CASES[k].header);
        if (CASES[k].status) text_has("is of other instants than the rest of its row", note.text);
    }
    add("none=Zeit 2 [s]");
    add("none=torque_Nm");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_NULL(run.torque_Nm);
}

/* Each file that has a column counts once for it, and for none of the others. */
static void test_files_that_have_a_column(void)
{
    size_t found[] = {0, 0, 0};
    add("theta_e_deg=AI1");
    add("iq=nowhere");
    add("torque_mNm=AI3");
    const hci_run_options options = {
        .pole_pairs = 2, .inertia_kgm2 = NAN, .columns = &names, .columns_found = found};
    for (size_t k = 1; k <= 3; ++k) {
        files_write(path, k < 3 ? "AI1,AI2,AI3\n0,0,1000\n90,1,2000\n180,2,3000\n"
                                : "AI1,torque_Nm\n0,1\n90,2\n180,3\n");
        hci_run_release(&run);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &options, &run, &note), note.text);
        TEST_ASSERT_EQUAL(k, found[0]);
        TEST_ASSERT_EQUAL(0, found[1]);
        TEST_ASSERT_EQUAL(k < 3 ? k : 2, found[2]);
    }
}

/* A turn of 4096 counts, on the command line or in columns.csv; what looks like counts is not read in rad. */
static void test_counts_of_an_encoder(void)
{
    files_write(path, "enc_count,torque_Nm\n0,1\n1024,2\n2048,3\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("if `enc_count` is an encoder, say --column \"theta_m=enc_count/COUNTS\"", note.text);
    add("theta_m=enc_count/4096");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 * REF_PI, run.theta_m_rad[1]);
    hci_column_names_release(&names);
    add("theta_e_rad=Enc_Count/8192");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.125 * REF_PI, run.theta_m_rad[1]);
    hci_column_names_release(&names);
    add("theta_m=enc_count");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has(
        "looks like the counts of an encoder, expected how many a turn has; write theta_m=enc_count/COUNTS",
        note.text);
    hci_column_names_release(&names);
    add("torque_Nm=enc_count/4096");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("found counts of a turn, expected them with an angle", note.text);
    hci_column_names_release(&names);
    add("theta_m_deg=enc_count");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    hci_column_names_release(&names);
    add("theta_m=enc_count/none");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("found no column `enc_count/none`", note.text);
}

/* A minus before the column, unless a header is written so. */
static void test_the_opposite_sign(void)
{
    files_write(path, "angle_rad,current,-current,load\n0,1,7,1\n0.25,2,8,2\n0.5,3,9,3\n");
    add("theta_m=-angle_rad/1");
    add("torque_mNm=-load");
    add("iq=-current");
    TEST_ASSERT_EQUAL(HCI_OK, read_run());
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.002, run.torque_Nm[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.25 * 2.0 * REF_PI, run.theta_m_rad[1] - run.theta_m_rad[0]);
    double square = 0.0;
    for (int s = 3; s < 6; ++s)
        square += run.i_A[s] * run.i_A[s];
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.5 * 8.0 * 8.0, square);
    hci_column_names_release(&names);
    add("theta_m=angle_rad");
    add("torque_Nm=-loud");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("found no column `-loud`", note.text);
}

/* One list serves recordings of two languages: a row whose column is not in the file yields to another of the
 * same quantity that is, in whatever unit; where none is, it is an error. */
static void test_one_list_for_two_languages(void)
{
    add("theta_m_deg=Kanal W");
    add("torque_Nm=Kanal M");
    add("theta_m_deg=Voie A");
    add("torque_mNm=Voie C");
    files_write(path, "Kanal W;Kanal M\n0;1\n90;2\n180;3\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, run.torque_Nm[1]);
    files_write(path, "Voie A;Voie C\n0;1000\n90;2000\n180;3000\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, run.torque_Nm[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 * REF_PI, run.theta_m_rad[1]);
    add("theta_m=Zaehler/3600");
    files_write(path, "Zaehler;Kanal M\n0;1\n900;2\n1800;3\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 * REF_PI, run.theta_m_rad[1]);
    files_write(path, "Voie A;Voie X\n0;1\n90;2\n180;3\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("found no column `Kanal M`", note.text);
}

/* The zero of the angle, in degrees electrical or in a unit of its own; 2 pole pairs. */
static void test_an_angle_offset(void)
{
    static const struct {
        const char *text;
        double degrees;
    } OFFSETS[] = {{"angle_offset=-31", -31.0},
                   {"angle_offset=-31.5 deg", -31.5},
                   {"angle_offset_rad=0.5", 28.64788976},
                   {"angle_offset=0.5rad", 28.64788976},
                   {"angle_offset=\xE2\x88\x92"
                    "31",
                    -31.0}};
    for (size_t k = 0; k < sizeof OFFSETS / sizeof *OFFSETS; ++k) {
        add(OFFSETS[k].text);
        files_write(path, "time_s,theta_e_deg,iq_A,torque_Nm\n0,0,1,1\n1,90,1,2\n2,180,1,3\n");
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, (90.0 + OFFSETS[k].degrees) / 2 * REF_PI / 180, run.theta_m_rad[1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, sin((90.0 + OFFSETS[k].degrees) * REF_PI / 180), run.i_A[3]);
        TEST_ASSERT_TRUE(run.zero_is_given);
        text_has("degrees electrical are added to the angle", run.remark.text);
        hci_column_names_release(&names);
    }
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, hci_column_names_add(&names, "angle_offset=3V", &note));
    text_has("expected an electrical angle to be added to that of the recording", note.text);
}

/* A table of a machine is told from a recording, and a speed under a name with "Rotor" is no angle. */
static void test_what_is_no_angle(void)
{
    files_write(path, "order,amplitude_Nm_per_A,phase_rad\n1,0.1,0\n5,0.01,0\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("found a table of orders", note.text);
    files_write(path, "timestamps,MCU_RotorSpeed_rpm,MCU_RotorAngle_el_deg\n0,1,2\n1,2,3\n2,3,4\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("`MCU_RotorAngle_el_deg` is the angle of the rotor", note.text);
    TEST_ASSERT_NULL(strstr(note.text, "RotorSpeed"));
}

static void test_a_list_of_columns_is_no_recording(void)
{
    files_write(path, "name,column\ntheta_m_deg,Winkel\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("found a list of names of columns, expected a recording; leave it out", note.text);
}

/* What is lost of time and angle is said before all else. */
static void test_a_lost_time_is_said_first(void)
{
    files_write(path, "Laufzeit X;theta_m_deg;torque_Nm;a;b\n0;0;1;1;1\n1;90;2;1;1\n2;180;1;1;1\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    static const char FIRST[] =
        "no column is read as the time: if `Laufzeit X` is it, say --column \"time_s=Laufzeit X\"";
    TEST_ASSERT_EQUAL_STRING_LEN(FIRST, run.remark.text, sizeof FIRST - 1);
    files_write(path, "time_s;Rotor X;torque_Nm\n0;0;1\n1;90;2\n2;180;1\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has(":1: found no angle of the rotor, expected a column theta_m or theta_e; if `Rotor X` is the "
             "angle of the "
             "rotor, say --column \"theta_m_deg=Rotor X\"",
             note.text);
}

/* A unit that the user says comes before that of the header or of the row of units, and is told; without one
 * that of the file holds, or the one that is usual for such a name. */
static void test_units_that_are_said(void)
{
    files_write(path, "ch a,ch b [mNm],c\ndeg,,A\n0,1000,1\n180,2000,1\n");
    add("theta_m=ch a");
    add("torque=ch b [mNm]");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, REF_PI, run.theta_m_rad[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, run.torque_Nm[1]);
    TEST_ASSERT_NULL(strstr(run.remark.text, "is read in"));
    hci_column_names_release(&names); /* in one list the same column has one unit */
    add("theta_m_rad=ch a");
    add("torque_Nm=ch b [mNm]");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 180.0, run.theta_m_rad[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2000.0, run.torque_Nm[1]);
    text_has("`ch a` is read in rad, as `theta_m_rad` says, and not in the unit that the file has for it",
             run.remark.text);
    text_has("`ch b [mNm]` is read in Nm, as `torque_Nm` says", run.remark.text);
    hci_column_names_release(&names);
    files_write(files_path("columns.csv"), "name,column\ntorque_mNm,Moment [Nm]\n");
    files_write(path, "theta_m_rad,Moment [Nm]\n0,1000\n1,2000\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, run.torque_Nm[1]);
    text_has("`Moment [Nm]` is read in mNm", run.remark.text);
    files_write(path, "time_s,pos_estimate,vel_estimate,torque_Nm\n0,0,1,1\n0.1,0.1,1,2\n0.2,0.2,1,3\n");
    remove(files_path("columns.csv"));
    add("theta_m=pos_estimate");
    add("speed=-vel_estimate");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.2 * REF_PI, run.theta_m_rad[1] - run.theta_m_rad[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -2.0 * REF_PI, run.speed_rad_per_s[1]);
}

/* Whole numbers beyond 360, or up to a power of two, are counts whatever the column is called. */
static void test_counts_by_their_numbers(void)
{
    files_write(path, "encoder,torque_Nm\n0,1\n1000,2\n2000,3\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("if `encoder` is an encoder, say --column \"theta_m=encoder/COUNTS\"", note.text);
    add("theta_m=encoder");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("looks like the counts of an encoder", note.text);
    hci_column_names_release(&names);
    add("theta_m_deg=encoder");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    hci_column_names_release(&names);
    files_write(path, "rotor,torque_Nm\n0,1\n128,2\n255,3\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("say --column \"theta_m=rotor/256\"", note.text);
    files_write(path, "rotor,torque_Nm\n0,1\n128,2\n359,3\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("say --column \"theta_m_deg=rotor\"", note.text);
    files_write(path, "rotor X [rad],torque_Nm\n0,1\n128.5,2\n359,3\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("say --column \"theta_m=rotor X [rad]\"", note.text);
}

/* Counts that end before a turn is over, and begin again; not of a counter that goes through several turns,
 * nor of a shaft that goes to and fro. */
static void test_counts_of_another_turn(void)
{
    static const char *const ROWS[] = {"10,1\n1500,2\n3000,3\n4080,4\n900,5\n",
                                       "10,1\n1500,2\n3000,3\n4080,4\n3000,5\n"};
    for (int k = 0; k < 2; ++k) {
        char text[120];
        snprintf(text, sizeof text, "encoder,torque_Nm\n%s", ROWS[k]);
        files_write(path, text);
        add("theta_m=encoder/16384");
        TEST_ASSERT_EQUAL_MESSAGE(k == 0 ? HCI_ERROR_INPUT : HCI_OK, read_run(), note.text);
        if (k == 0)
            text_has("goes from 0 to 4095 and begins again, expected no more than it has; write "
                     "theta_m=encoder/4096",
                     note.text);
        hci_column_names_release(&names);
        add("theta_m=encoder/2048");
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
        hci_column_names_release(&names);
    }
}

/* What check says of a probe on another range: the column over a number. */
static void test_a_column_over_a_number(void)
{
    files_write(path, "theta_m_rad,probe,torque_Nm\n0.5,20,1\n0.6,30,2\n");
    add("iq=probe/10");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    double square = 0.0;
    for (int s = 0; s < 3; ++s)
        square += run.i_A[s] * run.i_A[s];
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.5 * 2.0 * 2.0, square);
    hci_column_names_release(&names);
    add("torque=-probe/-0.5");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 40.0, run.torque_Nm[0]);
}

/* A voltage over a resistance is a current: of another quantity, where the unit of the quotient is said. */
static void test_a_quotient_of_another_quantity(void)
{
    files_write(path, "theta_m_rad,uq_mV,torque_Nm\n0.5,20,1\n0.6,30,2\n");
    add("iq_mA=uq_mV/10");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    double square = 0.0;
    for (int s = 0; s < 3; ++s)
        square += run.i_A[s] * run.i_A[s];
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.5 * 4e-6, square);
    text_lacks("and not in the unit that the file has", run.remark.text);
    hci_column_names_release(&names);
    add("iq=uq_mV/10");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("say the unit of the quotient, as in iq_A=COLUMN/OHM", note.text);
    hci_column_names_release(&names);
    add("iq_A=-uq_mV");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("a unit that is none of `iq_A`", note.text);
}

/* A firmware's 16 bits: a turn has 65536, an ampere nobody knows how many. */
static void test_numbers_of_16_bits(void)
{
    files_write(path, "Angle (s16degree),I_Q (s16A),torque_Nm\n0,10,1\n-16384,20,2\n3,30,3\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("say --column \"theta_m=Angle (s16degree)/65536\"", note.text);
    add("theta_m=Angle (s16degree)/65536");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_EQUAL_STRING("iq_A=I_Q (s16A)" HCI_RUN_DIGITS_PER_A, run.current_like);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.5 * REF_PI, run.theta_m_rad[1]);
    add("iq_A=I_Q (s16A)/10");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    hci_column_names_release(&names);
    add("theta_m=Angle (s16degree)/65536");
    add("iq_mA=I_Q (s16A)");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("16 bits of a firmware and in no unit", note.text);
}

/* Where no time is read, a column that goes on and speaks of it is named. */
static void test_a_time_that_was_not_read(void)
{
    static const char *const CASES[][2] = {{"unix", "time_s=unix"},
                                           {"ms", "time_ms=ms"},
                                           {"t_microsec", "time_us=t_microsec"},
                                           {"tick10ms", "time_s=tick10ms/100"},
                                           {"tick125us", "time_s=tick125us/8000"},
                                           {"ticks", "time_s=ticks/TICKS_PER_S"}};
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        char text[160];
        snprintf(text, sizeof text, "%s,theta_m_rad,torque_Nm\n5,0.1,1\n6,0.2,2\n6,0.3,3\n", CASES[k][0]);
        files_write(path, text);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
        TEST_ASSERT_EQUAL_STRING(CASES[k][1], run.time_like);
    }
    files_write(path, "unix,theta_m_rad,torque_Nm\n5,0.1,1\n6,0.2,2\n5,0.3,3\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_EQUAL_STRING("", run.time_like);
    files_write(path, "unix,theta_m_rad,torque_Nm\n5,0.1,1\n5,0.2,2\n5,0.3,3\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_EQUAL_STRING("", run.time_like);
}

/* Currents and speeds that go by names which are not known are named with what reads them. */
static void test_currents_and_speeds_that_were_not_read(void)
{
    files_write(path, "time_s,theta_m_rad,m0.current_control.Iq_meas,bus_current,vel,torque_Nm\n"
                      "0,0,1,9,1,1\n0.1,0.1,1,9,1,2\n0.2,0.2,1,9,1,1\n0.3,0.3,1,9,1,2\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    text_has("if it is i_q, add --column 'iq_A=m0.current_control.Iq_meas'", run.remark.text);
    TEST_ASSERT_EQUAL_STRING("iq_A=m0.current_control.Iq_meas", run.current_like);
    text_has("`vel` may be the speed: if it is, add --column 'speed_rpm=vel'", run.remark.text);
    TEST_ASSERT_NULL(strstr(run.remark.text, "iq_A=bus_current"));
}

/* What is said comes before all names, and a column is not two things. */
static void test_what_is_said_comes_first(void)
{
    files_write(path, "theta,theta_m_rad,torque_Nm,torque\n0.5,7,1,2\n0.6,8,1,3\n");
    add("theta_m_rad=theta");
    add("torque_Nm=torque");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.6, run.theta_m_rad[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0, run.torque_Nm[1]);
    hci_column_names_release(&names);
    add("theta_m_rad=theta");
    add("iq_A=torque_Nm");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("a unit that is none of `iq_A`", note.text);
    hci_column_names_release(&names);
    add("theta_m_rad=theta");
    add("iq_A=torque");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, run.torque_Nm[1]);
}

/* ---- tables beside the files */

static void test_a_table_beside_the_recording_and_one_beside_the_list(void)
{
    const hci_runs_options options = {.run = {.pole_pairs = 2, .inertia_kgm2 = NAN}};
    hci_runs runs;
    files_write(files_path("list.csv"), "file,role\nrun.csv,fit\n");
    files_write(files_path("columns.csv"), "name,column\ntheta_m_rad,AI1\ntorque_Nm,AI3\n");
    files_write(path, CHANNELS);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0, run.torque_Nm[2]);
    add("torque_Nm=AI1"); /* the command line counts most */
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.2, run.torque_Nm[2]);
    TEST_ASSERT_EQUAL(0, mkdir(files_path("sub"), 0777));
    files_write(files_path("sub/run.csv"), CHANNELS);
    files_write(files_path("sub/columns.csv"), "name,column\ntorque_Nm,spare\n");
    files_write(files_path("list.csv"), "file,role\nsub/run.csv,fit\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_runs_read(files_path("list.csv"), &options, &runs, &note),
                              note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.2, runs.run[0].theta_m_rad[2]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 9.0, runs.run[0].torque_Nm[2]);
    hci_runs_release(&runs);
}

/* A table is for several recordings, which may have names of their own. */
static void test_a_table_need_not_fit_where_names_do(void)
{
    files_write(files_path("columns.csv"), "name,column\ntheta_m_rad,AI1\n");
    files_write(path, "theta_m_rad,iq_A\n0.5,1\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_run(), note.text);
    files_write(path, "angle,iq_A\n0.5,1\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("columns.csv:2: found no column `AI1` in", note.text);
    text_has("it has `angle`, `iq_A`", note.text);
}

/* A recording of a list without such a column is read without it; one that none of them has is an error. */
static void test_some_recordings_of_a_list_lack_a_column(void)
{
    const hci_runs_options options = {.run = {.pole_pairs = 2, .inertia_kgm2 = NAN, .columns = &names}};
    hci_runs runs;
    files_write(files_path("list.csv"), "file,role\nidle.csv,fit\nrun.csv,fit\n");
    files_write(files_path("idle.csv"), "theta_m_rad,iq_A\n0.5,1\n");
    files_write(path, "theta_m_rad,iq_A,M1\n0.5,1,7\n");
    add("torque_Nm=M1");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_runs_read(files_path("list.csv"), &options, &runs, &note),
                              note.text);
    TEST_ASSERT_NULL(runs.run[0].torque_Nm);
    text_has("no column `M1`: read without torque_Nm", runs.run[0].remark.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 7.0, runs.run[1].torque_Nm[0]);
    hci_runs_release(&runs);
    add("speed_rad_per_s=M2");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_runs_read(files_path("list.csv"), &options, &runs, &note));
    text_has("found no column `M2` in", note.text);
}

/* ---- wrong ones */

static void wrong(const char *text, const char *words)
{
    hci_note said = {{0}};
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, hci_column_names_add(&names, text, &said));
    text_has(words, said.text);
}

static void test_wrong_names_get_a_suggestion(void)
{
    wrong("torqe_Nm=AI3", "--column torqe_Nm=AI3: found `torqe_Nm`, expected a quantity of a recording; did "
                          "you mean `torque_Nm`?");
    wrong("torque_A=AI3", "expected a quantity of a recording");
    wrong("speed_furlong=AI3", "it has units as in `speed_rad_per_s`, `speed_");
    wrong("-iq=AI3", "the opposite sign stands before the column: iq=-AI3");
    wrong("lamp=AI3", "write one of time_s, theta_m_rad");
    wrong("torque_Nm", "expected NAME=COLUMN");
    wrong("=AI3", "expected NAME=COLUMN");
    wrong("torque_Nm=", "expected NAME=COLUMN");
    files_write(path, CHANNELS);
    add("theta_m_rad=AI1");
    add("torque_Nm=sparre");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("--column torque_Nm=sparre: found no column `sparre` in", note.text);
    text_has("did you mean `spare`?", note.text);
    hci_column_names_release(&names);
    files_write(files_path("columns.csv"), "name,column\ntorqe_Nm,AI1\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, read_run());
    text_has("columns.csv:2: found `torqe_Nm`", note.text);
}

static void test_memory_runs_out_everywhere(void)
{
    hci_status status = HCI_ERROR_MEMORY;
    files_write(files_path("columns.csv"), "name,column\ntheta_m_rad,AI1\n");
    files_write(path, CHANNELS);
    for (long allowed = 0; status == HCI_ERROR_MEMORY; ++allowed) {
        hci_column_names_release(&names);
        memset(&note, 0, sizeof note);
        hci_memory_fail_after(allowed);
        status = hci_column_names_add(&names, "torque_Nm=AI3", &note);
        if (!status) status = read_run();
    }
    hci_memory_fail_after(-1);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, status, note.text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_names_in_one_text);
    RUN_TEST(test_names_with_subscripts);
    RUN_TEST(test_texts_that_are_no_names);
    RUN_TEST(test_columns_without_a_name);
    RUN_TEST(test_a_column_that_is_left_out);
    RUN_TEST(test_two_clocks_in_one_table);
    RUN_TEST(test_files_that_have_a_column);
    RUN_TEST(test_counts_of_an_encoder);
    RUN_TEST(test_the_opposite_sign);
    RUN_TEST(test_one_list_for_two_languages);
    RUN_TEST(test_an_angle_offset);
    RUN_TEST(test_what_is_no_angle);
    RUN_TEST(test_a_list_of_columns_is_no_recording);
    RUN_TEST(test_a_lost_time_is_said_first);
    RUN_TEST(test_units_that_are_said);
    RUN_TEST(test_counts_by_their_numbers);
    RUN_TEST(test_counts_of_another_turn);
    RUN_TEST(test_a_column_over_a_number);
    RUN_TEST(test_a_quotient_of_another_quantity);
    RUN_TEST(test_numbers_of_16_bits);
    RUN_TEST(test_a_time_that_was_not_read);
    RUN_TEST(test_currents_and_speeds_that_were_not_read);
    RUN_TEST(test_what_is_said_comes_first);
    RUN_TEST(test_a_table_beside_the_recording_and_one_beside_the_list);
    RUN_TEST(test_a_table_need_not_fit_where_names_do);
    RUN_TEST(test_some_recordings_of_a_list_lack_a_column);
    RUN_TEST(test_wrong_names_get_a_suggestion);
    RUN_TEST(test_memory_runs_out_everywhere);
    return UNITY_END();
}
