/* Reading runs: what each column becomes, against the motion that the files were written from. */
#include "hci/host/recording/run.h"
#include "hci/math/harmonic.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host/base/memory.h"
#include "support/draws.h"
#include "support/run_file.h"
#include "support/texts.h"
#include "unity.h"

#define MEASURED "../shared/measured/"

/* Files are written with 9 decimals. */
#define TEXT 1e-8

enum { MOST = 20000 };

void setUp(void)
{
    run_file_begin();
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    unlink(path);
    TEST_ASSERT_EQUAL_MESSAGE(0, files_count(files_root), "a file is left");
    run_file_end();
}

/* ---- files ---- */

static FILE *begin(const char *header)
{
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "%s\n", header);
    return file;
}

static void row(FILE *file, int count, ...)
{
    va_list values;
    va_start(values, count);
    for (int k = 0; k < count; ++k)
        fprintf(file, "%s%.9f", k > 0 ? "," : "", va_arg(values, double));
    fprintf(file, "\n");
    va_end(values);
}

static void read_run(int pole_pairs, double inertia_kgm2)
{
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK,
        hci_run_read(path, &(hci_run_options){.pole_pairs = pole_pairs, .inertia_kgm2 = inertia_kgm2}, &run,
                     &note),
        note.text);
}

static void read_text(const char *content, int pole_pairs)
{
    files_write(path, content);
    read_run(pole_pairs, NAN);
}

static void refused(const char *content, const char *why)
{
    hci_note said = {{0}};
    files_write(path, content);
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_ERROR_INPUT,
        hci_run_read(path, &(hci_run_options){.pole_pairs = 4, .inertia_kgm2 = NAN}, &run, &said), content);
    text_has(why, said.text);
    text_has("run.csv", said.text);
    TEST_ASSERT_EQUAL(0, run.count);
    TEST_ASSERT_NULL(run.name);
}

/* Every current 0, or no column of them; one step of a converter is a sensor that reads. */
static void test_a_drive_that_is_switched_off(void)
{
    read_text("time_s,theta_m_rad,id_A,iq_A,torque_Nm\n0,0,0,0,1\n0.1,0.1,0,0,2\n0.2,0.2,0,0,1\n", 4);
    TEST_ASSERT_TRUE(run.switched_off);
    hci_run_release(&run);
    read_text("time_s,theta_m_rad,torque_Nm\n0,0,1\n0.1,0.1,2\n0.2,0.2,1\n", 4);
    TEST_ASSERT_TRUE(run.switched_off);
    hci_run_release(&run);
    read_text("time_s,theta_m_rad,id_A,iq_A,torque_Nm\n0,0,0,0,1\n0.1,0.1,0.1,0,2\n0.2,0.2,0,0,1\n", 4);
    TEST_ASSERT_FALSE(run.switched_off);
}

/* ---- a motion ---- */

static double angle_at(double t)
{
    return 0.4 + 30.0 * t + 1.5 * sin(9.0 * t);
}

static double speed_at(double t)
{
    return 30.0 + 13.5 * cos(9.0 * t);
}

static double acceleration_at(double t)
{
    return -121.5 * sin(9.0 * t);
}

/* Uneven, but ascending. */
static double time_at(int k)
{
    return 1e-3 * (k + 0.4 * sin(1.7 * k));
}

static double wrapped(double angle, double from)
{
    return angle - 2.0 * REF_PI * floor((angle - from) / (2.0 * REF_PI));
}

/* Angles of the run less those of the motion, which may differ by one constant, a multiple of `turn`. */
static void assert_motion(int n, double turn)
{
    const double ahead = run.theta_m_rad[0] - angle_at(time_at(0));
    TEST_ASSERT_EQUAL(n, (int)run.count);
    TEST_ASSERT_DOUBLE_WITHIN(TEXT, 0.0, remainder(ahead, turn));
    for (int k = 0; k < n; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(TEXT, angle_at(time_at(k)) + ahead, run.theta_m_rad[k]);
}

/* ---- angles ---- */

static void write_angle(const char *header, int n, double factor, double unit, double wrap_from, bool wrap)
{
    FILE *file = begin(header);
    for (int k = 0; k < n; ++k) {
        const double angle = factor * angle_at(time_at(k));
        row(file, 2, time_at(k), (wrap ? wrapped(angle, wrap_from) : angle) / unit);
    }
    fclose(file);
}

static void test_wraps_of_every_kind_are_taken_out(void)
{
    const double from[] = {0.0, -REF_PI, -REF_PI / 2.0};
    for (int k = 0; k < 3; ++k) {
        write_angle("time_s,theta_m_rad", 2000, 1.0, 1.0, from[k], true);
        read_run(4, NAN);
        TEST_ASSERT_TRUE(run.turn_known);
        assert_motion(2000, 2.0 * REF_PI);
        hci_run_release(&run);
        write_angle("time_s,theta_e_deg", 2000, 4.0, REF_PI / 180.0, from[k], true);
        read_run(4, NAN);
        TEST_ASSERT_FALSE(run.turn_known);
        assert_motion(2000, 2.0 * REF_PI / 4.0);
        hci_run_release(&run);
    }
}

static void test_unwrapped_angles_stay(void)
{
    write_angle("time_s,theta_m_rad", 2000, 1.0, 1.0, 0.0, false);
    read_run(4, NAN);
    TEST_ASSERT_TRUE(run.turn_known);
    TEST_ASSERT_DOUBLE_WITHIN(TEXT, angle_at(time_at(0)), run.theta_m_rad[0]);
    assert_motion(2000, 2.0 * REF_PI);
    hci_run_release(&run);
    write_angle("time_s,theta_e_rad", 2000, 4.0, 1.0, 0.0, false);
    read_run(4, NAN);
    TEST_ASSERT_TRUE(run.turn_known);
    assert_motion(2000, 1e9);
}

static void test_an_electrical_angle_within_a_turn_knows_no_turn(void)
{
    read_text("theta_e_rad,torque_Nm\n0,1\n1,2\n3,3\n", 4);
    TEST_ASSERT_FALSE(run.turn_known);
    hci_run_release(&run);
    read_text("theta_e_rad,torque_Nm\n0,1\n1,2\n3,3\n", 1);
    TEST_ASSERT_TRUE(run.turn_known);
}

/* p times a mechanical angle that is wrapped. */
static void test_wrap_at_several_turns(void)
{
    FILE *file = begin("time_s,theta_e_rad");
    for (int k = 0; k < 2000; ++k)
        row(file, 2, time_at(k), 4.0 * wrapped(angle_at(time_at(k)), 0.0));
    fclose(file);
    read_run(4, NAN);
    TEST_ASSERT_TRUE(run.turn_known);
    assert_motion(2000, 2.0 * REF_PI);
}

static void test_unwrapped_coarse_samples_keep_their_turns(void)
{
    FILE *file = begin("time_s,theta_e_rad");
    for (int k = 0; k < 200; ++k)
        row(file, 2, 1e-3 * k, 4.1 * k);
    fclose(file);
    read_run(4, NAN);
    for (int k = 0; k < 200; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(TEXT, 4.1 * k / 4.0, run.theta_m_rad[k]);
}

/* A logger that lost two turns, and a few samples. */
static void test_a_gap_forward_is_no_wrap(void)
{
    FILE *file = begin("theta_e_rad,torque_Nm");
    for (int k = 0; k < 1000; ++k)
        row(file, 2, 0.02 * k + (k < 500 ? 0.0 : 4.0 * REF_PI), 1.0);
    fclose(file);
    read_run(4, NAN);
    TEST_ASSERT_DOUBLE_WITHIN(TEXT, (0.02 * 999 + 4.0 * REF_PI) / 4.0, run.theta_m_rad[999]);
}

/* 0.8 turns from sample to sample look like −0.2. */
static void test_speed_tells_the_turns_of_coarse_samples(void)
{
    FILE *file = begin("time_s,theta_e_rad,speed_rad_per_s");
    for (int k = 0; k < 500; ++k)
        row(file, 3, 1e-3 * k, wrapped(1.6 * REF_PI * k, 0.0),
            1.6 * REF_PI / 4.0 * 1e3 * (1.0 + 0.05 * sin(k)));
    fclose(file);
    read_run(4, NAN);
    for (int k = 0; k < 500; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-7, 1.6 * REF_PI * k / 4.0, run.theta_m_rad[k] - run.theta_m_rad[0]);
    text_has("499 steps are taken from the speed", run.remark.text);
}

static void test_coarse_samples_without_a_speed_have_no_order(void)
{
    char content[4000];
    size_t used = (size_t)sprintf(content, "time_s,theta_e_rad\n");
    for (int k = 0; k < 100; ++k)
        used += (size_t)sprintf(content + used, "%d,%.6f\n", k, wrapped(0.9 * REF_PI * k, 0.0));
    read_text(content, 4);
    text_has("sample faster, add a speed column", run.remark.text);
    text_has("samples without order, the time is not used", run.remark.text);
    TEST_ASSERT_NULL(run.time_s);
    for (int k = 0; k < 100; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, wrapped(0.9 * REF_PI * k, 0.0) / 4.0, run.theta_m_rad[k]);
}

/* Tables of locked-rotor points: nothing is a path there. */
static void test_scattered_points_get_no_turns(void)
{
    unsigned seed = 7;
    double angle[300];
    FILE *file = begin("theta_e_rad,torque_Nm");
    for (int k = 0; k < 300; ++k) {
        seed = seed * 1664525u + 1013904223u;
        angle[k] = 2.0 * REF_PI * (seed >> 8) / 16777216.0;
        row(file, 2, angle[k], 1.0);
    }
    fclose(file);
    read_run(3, NAN);
    for (int k = 0; k < 300; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(TEXT, angle[k] / 3.0, run.theta_m_rad[k]);
    text_has("without order", run.remark.text);
    TEST_ASSERT_NULL(run.speed_rad_per_s);
}

/* There and back with a wrap, without time: a holding map. */
static void test_a_path_without_time_is_unwrapped(void)
{
    FILE *file = begin("theta_m_rad,iq_A,torque_Nm");
    for (int k = 0; k < 800; ++k) {
        const double angle = 3.0 + 0.01 * (k < 400 ? k : 800 - k);
        row(file, 3, wrapped(angle, 0.0), 0.1, 0.0);
    }
    fclose(file);
    read_run(3, NAN);
    for (int k = 0; k < 800; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(TEXT, 3.0 + 0.01 * (k < 400 ? k : 800 - k), run.theta_m_rad[k]);
    TEST_ASSERT_EQUAL(HCI_TORQUE_HOLDING, run.torque_source);
    TEST_ASSERT_NULL(run.time_s);
    TEST_ASSERT_TRUE(run.speed_rad_per_s[100] > 0.0 && run.speed_rad_per_s[700] < 0.0);
}

static void test_both_angles_give_phase_and_turns(void)
{
    FILE *file = begin("time_s,theta_m_rad,theta_e_rad");
    for (int k = 0; k < 2000; ++k) {
        const double angle = angle_at(time_at(k));
        row(file, 3, time_at(k), wrapped(angle + 0.001 * sin(k), 0.0), wrapped(4.0 * angle + 1.0, 0.0));
    }
    fclose(file);
    read_run(4, NAN);
    TEST_ASSERT_TRUE(run.turn_known);
    for (int k = 0; k < 2000; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(TEXT, angle_at(time_at(k)) + 0.25, run.theta_m_rad[k]);
    text_has("theta_e is ahead of pole pairs x theta_m by 1 rad", run.remark.text);
    hci_run_release(&run);
    read_run(8, NAN);
    TEST_ASSERT_FALSE(run.turn_known);
    text_has("does not follow theta_e with 8 pole pairs", run.remark.text);
    for (int k = 0; k < 2000; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(TEXT, (angle_at(time_at(k)) - angle_at(time_at(0))) * 4.0 / 8.0,
                                  run.theta_m_rad[k] - run.theta_m_rad[0]);
}

/* ---- speed ---- */

static void test_recorded_speed_is_kept_and_converted(void)
{
    read_text("time_s,theta_m_rad,speed_rpm\n0,0,60\n1,6.2,60\n2,12.4,90\n", 2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0 * REF_PI, run.speed_rad_per_s[2]);
}

static void test_speed_is_the_slope_of_the_angle(void)
{
    write_angle("time_s,theta_e_rad", 3000, 4.0, 1.0, 0.0, true);
    read_run(4, NAN);
    for (int k = 0; k < 3000; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(2e-3, speed_at(time_at(k)), run.speed_rad_per_s[k]);
}

/* An encoder of 512 counts: one count a sample is 12 rad/s, so that the noise of a difference of two samples
 * would hide the speed. */
static void test_slope_survives_an_encoder(void)
{
    const double count = 2.0 * REF_PI / 512.0;
    FILE *file = begin("time_s,theta_m_rad");
    for (int k = 0; k < 5000; ++k)
        row(file, 2, 1e-3 * k, count * floor((2.0 * 1e-3 * k + 0.3 * sin(2e-3 * k)) / count));
    fclose(file);
    read_run(4, NAN);
    for (int k = 0; k < 5000; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(0.1, 2.0 + 0.6 * cos(2e-3 * k), run.speed_rad_per_s[k]);
}

static void test_a_speed_of_0_while_the_angle_moves_is_replaced(void)
{
    FILE *file = begin("time_s,theta_m_rad,speed_rad_per_s,iq_A,torque_Nm");
    for (int k = 0; k < 400; ++k)
        row(file, 5, 0.1 * k, 0.01 * (k < 200 ? k : 400 - k), 0.0, 0.1, 0.0);
    fclose(file);
    read_run(4, NAN);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.1, run.speed_rad_per_s[100]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, -0.1, run.speed_rad_per_s[300]);
    text_has("the speed is 0 but the angle moves", run.remark.text);
    hci_run_release(&run);
    read_text("time_s,theta_m_rad,speed_rad_per_s\n0,0.001,0\n1,0.002,0\n2,0.001,0\n", 2);
    TEST_ASSERT_TRUE(run.speed_rad_per_s[0] == 0.0 && run.speed_rad_per_s[1] == 0.0);
}

/* ---- currents and voltages ---- */

static void test_phase_currents(void)
{
    read_text("theta_m_rad,ia_A,ib_mA,ic_A\n0,1,2000,4\n0.1,5,6000,8\n", 2);
    const double expected[] = {1.0, 2.0, 4.0, 5.0, 6.0, 8.0};
    for (int k = 0; k < 6; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected[k], run.i_A[k]);
    TEST_ASSERT_TRUE(run.has_sum);
}

static void test_two_of_three_currents(void)
{
    const char *const header[] = {"ib_A,ic_A", "ia_A,ic_A", "ia_A,ib_A"};
    for (int s = 0; s < 3; ++s) {
        char content[100];
        snprintf(content, sizeof content, "theta_m_rad,%s\n0,1,2\n", header[s]);
        read_text(content, 2);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, -3.0, run.i_A[s]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, run.i_A[0] + run.i_A[1] + run.i_A[2]);
        TEST_ASSERT_FALSE(run.has_sum);
        hci_run_release(&run);
    }
}

static void test_dq_currents_turn_with_the_angle(void)
{
    FILE *file = begin("theta_m_rad,id_A,iq_A");
    for (int k = 0; k < 100; ++k)
        row(file, 3, 0.1 * k, -1.0 + 0.1 * k, 2.0);
    fclose(file);
    read_run(3, NAN);
    for (int k = 0; k < 100; ++k)
        for (int s = 0; s < 3; ++s) {
            const double theta = 3.0 * 0.1 * k - 2.0 * REF_PI * s / 3.0;
            TEST_ASSERT_DOUBLE_WITHIN(TEXT, 2.0 * sin(theta) - (-1.0 + 0.1 * k) * cos(theta),
                                      run.i_A[3 * k + s]);
        }
    TEST_ASSERT_FALSE(run.has_sum);
}

/* e leads the magnets' flux: v_q lies along sin, v_d along −cos. A drive's log of v_q alone has v_d = 0, and
 * without an angle both are left. */
static void test_dq_voltages_turn_with_the_angle(void)
{
    read_text("theta_e_rad,ud_V,uq_V,iq_A\n0.5,-1,2,1\n", 3);
    for (int s = 0; s < 3; ++s) {
        const double theta = 0.5 - 2.0 * REF_PI * s / 3.0;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * sin(theta) + cos(theta), run.v_V[s]);
    }
    hci_run_release(&run);
    read_text("theta_e_rad,q_axis_voltage,iq_A\n0.5,2000,1\n", 3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2000.0 * sin(0.5), run.v_V[0]);
    hci_run_release(&run);
    read_text("theta_e_rad,va_V,vb_V,vc_V,vq_V\n0.5,1,2,3,4\n", 3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0, run.v_V[2]);
}

static void test_iq_alone_and_no_current(void)
{
    read_text("theta_e_rad,iq_A\n0.5,2\n", 3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * sin(0.5), run.i_A[0]);
    hci_run_release(&run);
    read_text("theta_e_rad,torque_Nm\n0.5,2\n", 3);
    TEST_ASSERT_TRUE(run.i_A[0] == 0.0 && run.i_A[1] == 0.0 && run.i_A[2] == 0.0);
    text_has("no currents: taken as 0", run.remark.text);
}

static void test_voltages(void)
{
    read_text("time_s,va_V,vb_V,vc_V\n0,1,2,3\n1,4,5,6\n", 3);
    TEST_ASSERT_NULL(run.theta_m_rad);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 6.0, run.v_V[5]);
    hci_run_release(&run);
    /* phases 3, −1, −2 */
    read_text("time_s,vab_V,vbc_V,vca_V\n0,4,1,-5\n", 3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 3.0, run.v_V[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -1.0, run.v_V[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -2.0, run.v_V[2]);
    text_has("divisible by three", run.remark.text);
    hci_run_release(&run);
    read_text("time_s,va_V,vc_V\n0,3,-2\n", 3);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -1.0, run.v_V[1]);
    text_has("two phase voltages: the third makes the sum 0", run.remark.text);
}

/* ---- without an angle ---- */

/* A torque over time at a known speed: the angle is speed × time. */
static void test_a_speed_over_time_is_an_angle(void)
{
    FILE *file = begin("time_s,speed_rad_per_s,torque_Nm,iq_A");
    for (int k = 0; k < 2000; ++k)
        row(file, 4, time_at(k), speed_at(time_at(k)), 0.1, 2.0);
    fclose(file);
    read_run(4, NAN);
    TEST_ASSERT_TRUE(run.zero_is_unknown && run.turn_known);
    for (int k = 0; k < 2000; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(2e-4, angle_at(time_at(k)) - angle_at(time_at(0)), run.theta_m_rad[k]);
    text_has("no angle: it is speed x time, and its zero is not known", run.remark.text);
}

static void test_a_torque_map_knows_the_mean_only(void)
{
    read_text("speed_rpm;id_A;iq_A;torque_Nm\n600;0;1;0,1\n600;-1;2;0,2\n", 3);
    TEST_ASSERT_TRUE(run.only_mean);
    TEST_ASSERT_NULL(run.theta_m_rad);
    TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, run.torque_source);
    /* i_a = −i_d at angle 0, i_b = i_q sin(−120°) − i_d cos(−120°) */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, run.i_A[3]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -sqrt(3.0) - 0.5, run.i_A[4]);
    text_has("torques over i_d and i_q, taken as means over a turn", run.remark.text);
}

/* ---- torque ---- */

static void test_torque_sources(void)
{
    read_text("theta_m_rad,torque_Nm,temperature_C\n0,0,40\n1,0.5,41\n", 2);
    TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, run.torque_source);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 41.0, run.temperature_C[1]);
    hci_run_release(&run);
    read_text("theta_m_rad,torque_Nm\n0,0\n1,-0\n", 2);
    TEST_ASSERT_EQUAL(HCI_TORQUE_HOLDING, run.torque_source);
    TEST_ASSERT_NOT_NULL(run.torque_Nm);
    hci_run_release(&run);
    read_text("theta_m_rad,iq_A\n0,0\n1,-0\n", 2);
    TEST_ASSERT_EQUAL(HCI_TORQUE_NONE, run.torque_source);
    TEST_ASSERT_NULL(run.torque_Nm);
}

/* Open terminals: ten samples of a turn, ia and ib noise of 1 mA whose vectors point anywhere. */
static void test_a_torque_of_0_at_open_terminals_is_typed(void)
{
    char content[1024] = "time_s,theta_m_rad,ia_A,ib_A,va_V,vb_V,vc_V,torque_Nm\n";
    uint64_t seed = 5;
    for (int k = 0; k < 10; ++k) {
        const double theta_rad = 0.6 * k;
        snprintf(content + strlen(content), sizeof content - strlen(content),
                 "%g,%g,%.6f,%.6f,%.4f,%.4f,%.4f,0\n", 0.01 * k, theta_rad, 1e-3 * ref_normal(&seed),
                 1e-3 * ref_normal(&seed), 5.0 * sin(2.0 * theta_rad),
                 5.0 * sin(2.0 * theta_rad - 2.0 * REF_PI / 3.0),
                 5.0 * sin(2.0 * theta_rad + 2.0 * REF_PI / 3.0));
    }
    read_text(content, 2);
    TEST_ASSERT_TRUE(run.torque_is_typed);
    TEST_ASSERT_NULL(run.torque_Nm);
}

static void test_torque_of_inertia(void)
{
    FILE *file = begin("time_s,theta_m_rad,speed_rad_per_s");
    for (int k = 0; k < 3000; ++k)
        row(file, 3, time_at(k), angle_at(time_at(k)), speed_at(time_at(k)));
    fclose(file);
    read_run(4, 0.02);
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, run.torque_source);
    text_has("as of a free shaft it is inertia x acceleration", run.remark.text);
    for (int k = 0; k < 3000; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(0.02 * 0.05, 0.02 * acceleration_at(time_at(k)), run.torque_Nm[k]);
}

/* Nothing would be left of what holds the shaft, and no cogging torque found. */
static void test_holding_takes_a_current(void)
{
    files_write(path, "time_s,theta_m_rad,u [Arms]\n0,0,1\n1,0.5,1\n2,1,1\n3,1.5,1\n");
    const hci_run_options options = {.pole_pairs = 4, .holding = true};
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_run_read(path, &options, &run, &note));
    text_has("--column iq_A=COLUMN", note.text);
}

static void test_a_current_that_was_not_read_is_named(void)
{
    files_write(path, "time_s,theta_m_rad,torque_Nm,Actual current [Arms]\n0,0,1,1\n1,0.5,1,1\n2,1,1,1\n");
    read_run(4, 0.0);
    text_has("if it is i_q, add --column 'iq=Actual current [Arms]'", run.remark.text);
}

/* Of a speed that swings, and whose noise makes its slopes long, the share of J dω/dt that torque_Nm has. */
static double swing(double order)
{
    enum { ROWS = 4000 };
    const double speed = 8.0, size = 1.0, step_s = 1e-3;
    double sine = 0.0, cosine = 0.0;
    uint64_t state = 1;
    FILE *file = begin("time_s,theta_m_rad,speed_rad_per_s");
    for (int k = 0; k < ROWS; ++k) {
        const double t = k * step_s, x = order * 4.0 * speed * t;
        const double noise = 0.1 * ref_normal(&state);
        row(file, 3, t, speed * t, speed + size / (order * 4.0 * speed) * sin(x) + noise);
    }
    fclose(file);
    hci_run_release(&run);
    read_run(4, 1.0);
    for (int k = ROWS / 4; k < 3 * ROWS / 4; ++k) {
        const double x = order * 4.0 * speed * k * step_s;
        cosine += 4.0 / ROWS * run.torque_Nm[k] * cos(x);
        sine += 4.0 / ROWS * run.torque_Nm[k] * sin(x);
    }
    return hypot(cosine, sine) / size;
}

/* A slope over all samples of W s shows 3(sin x − x cos x)/x³ of what swings with f, x = πfW; with the order
 * of which W is a period, x = π at that order. Beside that the noise has a part of that frequency: 0.035 of
 * the swing at most with these draws. */
static void test_orders_that_slopes_show(void)
{
    static const double ORDERS[] = {0.5, 1.0, 2.0};
    for (size_t k = 0; k < 3; ++k) {
        const double share = swing(ORDERS[k]), x = HCI_PI * ORDERS[k] / run.torque_reach;
        text_has("next to nothing of a torque of an electrical order above", run.remark.text);
        TEST_ASSERT_DOUBLE_WITHIN(0.05, 3.0 * fabs(sin(x) - x * cos(x)) / (x * x * x), share);
    }
}

/* With voltages and without a current something turns the shaft. */
static void test_a_driven_shaft_is_not_free(void)
{
    FILE *file = begin("time_s,theta_m_rad,speed_rad_per_s,va_V,vb_V,vc_V");
    for (int k = 0; k < 300; ++k)
        row(file, 6, time_at(k), angle_at(time_at(k)), speed_at(time_at(k)), 1.0, 2.0, -3.0);
    fclose(file);
    read_run(4, 0.02);
    TEST_ASSERT_NULL(run.torque_Nm);
}

/* ---- what is refused ---- */

static void test_refused_runs(void)
{
    refused("theta_m_rad,ia_A\n0,1\n", "two or three of ia_A, ib_A, ic_A");
    refused("theta_m_rad,id_A\n0,1\n", "add the column iq_A");
    refused("time_s,speed_rad_per_s,ia_A,ib_A,torque_Nm\n0,1,1,1,1\n", "no angle beside phase currents");
    refused("time_s,va_V,vb_V,vc_V,iq_A\n0,1,1,1,1\n", "theta_e_rad or theta_m_rad");
    refused("time_s,torque_Nm\n0,1\n", "found no angle of the rotor but `time_s`, `torque_Nm`");
    refused("time_s,torque_Nm\n0,1\n", "expected a column theta_m or theta_e");
    refused("time_s,theta,torque_Nm\n0,1,1\n",
            "column 2 `theta`: found an angle that may be mechanical or electrical");
    refused("time_s,theta,va_V,vb_V,vc_V\n0,1,1,1,1\n",
            "column 2 `theta`: found an angle that may be mechanical or electrical");
    refused("time_s,theta,vab_V,vbc_V\n0,1,1,1\n", "run.csv:1: column 2");
    refused("theta_m_rad,torque_Nm\n", "a header and no samples");
    refused("theta_m_rad,torque_Nm\n1,x\n", "found `x`");
    TEST_ASSERT_EQUAL(
        HCI_ERROR_INPUT,
        hci_run_read("no/such/file", &(hci_run_options){.pole_pairs = 4, .inertia_kgm2 = NAN}, &run, NULL));
    files_write(path, "theta_m_rad,torque_Nm\n1,1\n");
    TEST_ASSERT_EQUAL(
        HCI_ERROR_ARGUMENT,
        hci_run_read(path, &(hci_run_options){.pole_pairs = 0, .inertia_kgm2 = NAN}, &run, NULL));
}

static void test_unused_columns_are_named(void)
{
    read_text("theta_m_rad,torqe_Nm,iq_A,va_V\n0,1,1,1\n", 2);
    text_has("columns not used: `torqe_Nm`, `va_V`", run.remark.text);
}

static void test_memory_runs_out_everywhere(void)
{
    FILE *file = begin("time_s,theta_m_rad,theta_e_rad,id_A,iq_A,va_V,vb_V,vc_V,temperature_C");
    for (int k = 0; k < 20; ++k)
        row(file, 9, 1.0 * k, 0.1 * k, 0.2 * k, 0.0, 1.0, 0.0, 0.0, 0.0, 20.0);
    fclose(file);
    hci_status status = HCI_ERROR_MEMORY;
    long allowed = 0;
    for (; status == HCI_ERROR_MEMORY; ++allowed) {
        memset(&note, 0, sizeof note);
        hci_memory_fail_after(allowed);
        status = hci_run_read(path, &(hci_run_options){.pole_pairs = 2, .inertia_kgm2 = 0.1}, &run, &note);
        if (status == HCI_ERROR_MEMORY) {
            text_has("memory", note.text);
            TEST_ASSERT_EQUAL(0, run.count);
        }
    }
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, status, note.text);
    TEST_ASSERT_TRUE(allowed > 15);
}

/* ---- lists ---- */

static char list_path[96], sub[96];

static void count_progress(void *context, const char *what, double share)
{
    TEST_ASSERT_NOT_NULL(what);
    TEST_ASSERT_TRUE(share >= 0.0 && share < 1.0);
    ++*(int *)context;
}

static void refused_list(const char *content, const char *why)
{
    hci_runs runs;
    hci_note said = {{0}};
    const hci_runs_options reading = {{.pole_pairs = 2, .inertia_kgm2 = NAN}, NULL, NULL};
    files_write(list_path, content);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_runs_read(list_path, &reading, &runs, &said));
    text_has(why, said.text);
    TEST_ASSERT_NULL(runs.run);
}

static void test_lists_are_relative_to_themselves(void)
{
    hci_runs runs;
    int calls = 0;
    const hci_runs_options reading = {{.pole_pairs = 2, .inertia_kgm2 = NAN}, count_progress, &calls};
    snprintf(sub, sizeof sub, "%s", files_path("sub"));
    snprintf(list_path, sizeof list_path, "%s", files_path("sub/list.csv"));
    TEST_ASSERT_EQUAL(0, mkdir(sub, 0700));
    files_write(path, "theta_m_rad,torque_Nm\n0,1\n");
    char again[200];
    snprintf(again, sizeof again, "file,role,note\n../run.csv,Fit,x\n%s,holdout,\n", path);
    files_write(list_path, again);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_runs_read(list_path, &reading, &runs, &note), note.text);
    TEST_ASSERT_EQUAL(2, (int)runs.count);
    TEST_ASSERT_EQUAL(2, calls);
    TEST_ASSERT_EQUAL(HCI_ROLE_FIT, runs.role[0]);
    TEST_ASSERT_EQUAL(HCI_ROLE_HOLDOUT, runs.role[1]);
    TEST_ASSERT_EQUAL_STRING("../run.csv", runs.run[0].name);
    hci_runs_release(&runs);
    refused_list("file,role\n../run.csv,train\n", "`fit` or `holdout`");
    refused_list("file,role\n../run.csv,fit\n../run.csv,holdout\n", "each file once");
    refused_list("file,role\n../none.csv,fit\n",
                 "found `../none.csv`, expected a recording that can be read");
    refused_list("file,role\n", "found no run");
    refused_list("file\n../run.csv\n", "`role`");
    unlink(list_path);
    rmdir(sub);
}

/* ---- measured ---- */

static bool measured(const char *file)
{
    struct stat info;
    snprintf(sub, sizeof sub, MEASURED "%s", file);
    return stat(sub, &info) == 0;
}

static void read_measured(const char *file, int pole_pairs, double inertia_kgm2)
{
    if (!measured(file)) TEST_IGNORE_MESSAGE("no " MEASURED);
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK,
        hci_run_read(sub, &(hci_run_options){.pole_pairs = pole_pairs, .inertia_kgm2 = inertia_kgm2}, &run,
                     &note),
        note.text);
}

/* One turn forward, then back: the recorded speed is 0. */
static void test_measured_holding_run(void)
{
    read_measured("laas_mn4004/hold.csv", 12, NAN);
    TEST_ASSERT_EQUAL(HCI_TORQUE_HOLDING, run.torque_source);
    TEST_ASSERT_TRUE(run.turn_known);
    size_t forward = 0, backward = 0;
    for (size_t k = 0; k < run.count; ++k) {
        const bool first_half = k < run.count / 2;
        forward += first_half && run.speed_rad_per_s[k] > 0.0;
        backward += !first_half && run.speed_rad_per_s[k] < 0.0;
    }
    TEST_ASSERT_TRUE(forward > run.count * 45 / 100 && backward > run.count * 45 / 100);
}

/* J about 5.3e-6 kg·m², K_t 0.0279 N·m/A: the torque of the current, less friction, moves the rotor. */
static void test_measured_free_shaft(void)
{
    read_measured("laas_mn4004/acceleration.csv", 12, 5.3e-6);
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, run.torque_source);
    double largest = 0.0;
    for (size_t k = 0; k < run.count; ++k)
        largest = fmax(largest, fabs(run.torque_Nm[k]));
    TEST_ASSERT_TRUE(largest > 0.002 && largest < 0.05);
}

static void test_measured_tables_without_time(void)
{
    read_measured("prius2004_locked_rotor/locked_250A.csv", 4, NAN);
    TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, run.torque_source);
    TEST_ASSERT_FALSE(run.turn_known);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3.071081 / 4.0, run.theta_m_rad[run.count - 1]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_drive_that_is_switched_off);
    RUN_TEST(test_wraps_of_every_kind_are_taken_out);
    RUN_TEST(test_unwrapped_angles_stay);
    RUN_TEST(test_an_electrical_angle_within_a_turn_knows_no_turn);
    RUN_TEST(test_wrap_at_several_turns);
    RUN_TEST(test_unwrapped_coarse_samples_keep_their_turns);
    RUN_TEST(test_a_gap_forward_is_no_wrap);
    RUN_TEST(test_speed_tells_the_turns_of_coarse_samples);
    RUN_TEST(test_coarse_samples_without_a_speed_have_no_order);
    RUN_TEST(test_scattered_points_get_no_turns);
    RUN_TEST(test_a_path_without_time_is_unwrapped);
    RUN_TEST(test_both_angles_give_phase_and_turns);
    RUN_TEST(test_recorded_speed_is_kept_and_converted);
    RUN_TEST(test_speed_is_the_slope_of_the_angle);
    RUN_TEST(test_slope_survives_an_encoder);
    RUN_TEST(test_a_speed_of_0_while_the_angle_moves_is_replaced);
    RUN_TEST(test_phase_currents);
    RUN_TEST(test_two_of_three_currents);
    RUN_TEST(test_dq_currents_turn_with_the_angle);
    RUN_TEST(test_dq_voltages_turn_with_the_angle);
    RUN_TEST(test_iq_alone_and_no_current);
    RUN_TEST(test_voltages);
    RUN_TEST(test_a_speed_over_time_is_an_angle);
    RUN_TEST(test_a_torque_map_knows_the_mean_only);
    RUN_TEST(test_torque_sources);
    RUN_TEST(test_a_torque_of_0_at_open_terminals_is_typed);
    RUN_TEST(test_torque_of_inertia);
    RUN_TEST(test_holding_takes_a_current);
    RUN_TEST(test_a_current_that_was_not_read_is_named);
    RUN_TEST(test_orders_that_slopes_show);
    RUN_TEST(test_a_driven_shaft_is_not_free);
    RUN_TEST(test_refused_runs);
    RUN_TEST(test_unused_columns_are_named);
    RUN_TEST(test_memory_runs_out_everywhere);
    RUN_TEST(test_lists_are_relative_to_themselves);
    RUN_TEST(test_measured_holding_run);
    RUN_TEST(test_measured_free_shaft);
    RUN_TEST(test_measured_tables_without_time);
    return UNITY_END();
}
