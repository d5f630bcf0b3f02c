/* What a run has of its columns: every field, and where the rules of run.c begin. */
#include <math.h>
#include <string.h>

#include "hci/host/recording/run.h"
#include "host/csv/table.h"
#include "support/draws.h"
#include "support/files.h"
#include "support/recording.h"
#include "support/texts.h"
#include "unity.h"

enum { P = 3, N = 200 };

static hci_run run;
static hci_csv *csv;
static hci_note note;
static FILE *file;
static hci_run_options options;

void setUp(void)
{
    files_begin();
    memset(&run, 0, sizeof run);
    csv = NULL;
    options = (hci_run_options){.pole_pairs = P, .inertia_kgm2 = NAN};
}

void tearDown(void)
{
    hci_run_release(&run);
    hci_csv_free(csv);
    files_end();
}

static void begin(const char *header)
{
    file = fopen(files_path("a.csv"), "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "%s\n", header);
}

static void open_table(void)
{
    fclose(file);
    hci_run_release(&run);
    hci_csv_free(csv);
    csv = NULL;
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read_recording(files_path("a.csv"), &csv, &note), note.text);
}

static void take(void)
{
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_of_csv(csv, &options, &run, &note), note.text);
}

static void end(void)
{
    open_table();
    take();
}

static void is_refused(const char *words)
{
    open_table();
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_run_of_csv(csv, &options, &run, &note));
    text_has(words, note.text);
    TEST_ASSERT_NULL(run.theta_m_rad);
}

/* ---- names and units ---- */

static void test_where_columns_are_from(void)
{
    begin("time_ms,theta_m_deg,speed_rpm,id_A,iq_A,torque_mNm,temperature_C");
    for (int k = 0; k < N; ++k)
        fprintf(file, "%d,%.9f,30,%.6f,%.6f,%.6f,%d\n", 10 * k, 1.8 * k, 0.1 * sin(k),
                1.0 + 0.2 * cos(0.3 * k), 70.0 + sin(0.7 * k), 20 + k);
    end();
    TEST_ASSERT_EQUAL_UINT64(N, run.count);
    TEST_ASSERT_EQUAL(P, run.pole_pairs);
    text_has("a.csv", run.name);
    TEST_ASSERT_EQUAL_STRING("time_ms", run.time_column);
    TEST_ASSERT_EQUAL_STRING("theta_m_deg", run.angle_column);
    TEST_ASSERT_EQUAL_STRING("speed_rpm", run.speed_column);
    TEST_ASSERT_EQUAL_STRING("iq_A", run.current_column);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, REF_PI / 180.0, run.angle_unit_rad);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * REF_PI / 60.0, run.speed_unit_rad_per_s);
    TEST_ASSERT_TRUE(run.turn_known && !run.is_electrical && !run.speed_is_electrical && !run.has_sum);
    TEST_ASSERT_FALSE(run.lacks_id || run.has_both_frames || run.voltage_is_dq || run.zero_is_unknown ||
                      run.zero_is_given || run.only_mean || run.angle_is_counted);
    TEST_ASSERT_EQUAL(0, run.computed_phase);
    TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, run.torque_source);
    for (int k = 0; k < N; ++k) {
        double d, q;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.01 * k, run.time_s[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.8 * k * REF_PI / 180.0, run.theta_m_rad[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, REF_PI, run.speed_rad_per_s[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-8, 0.07 + 1e-3 * sin(0.7 * k), run.torque_Nm[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 20.0 + k, run.temperature_C[k]);
        rec_rotor(run.i_A + 3 * k, P * run.theta_m_rad[k], &d, &q);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.1 * sin(k), d);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.0 + 0.2 * cos(0.3 * k), q);
    }
}

/* Electrical angle and speed, two currents of three, and i_d, i_q beside them. */
static void test_electrical_columns(void)
{
    begin("time_s,theta_e_rad,speed_e_rad_per_s,ia_A,ic_A,id_A,iq_A");
    for (int k = 0; k < N; ++k)
        fprintf(file, "%.4f,%.9f,6,%.6f,%.6f,1,2\n", 0.01 * k, fmod(0.06 * k, 2.0 * REF_PI), sin(0.3 * k),
                2.0 * cos(0.2 * k));
    end();
    TEST_ASSERT_EQUAL_STRING("theta_e_rad", run.angle_column);
    TEST_ASSERT_EQUAL_STRING("speed_e_rad_per_s", run.speed_column);
    TEST_ASSERT_TRUE(run.is_electrical && run.speed_is_electrical && run.has_both_frames && !run.has_sum);
    TEST_ASSERT_FALSE(run.turn_known);
    TEST_ASSERT_EQUAL(2, run.computed_phase);
    for (int k = 0; k < N; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-8, 0.02 * k, run.theta_m_rad[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, run.speed_rad_per_s[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, sin(0.3 * k), run.i_A[3 * k]);
        TEST_ASSERT_DOUBLE_WITHIN(2e-6, -sin(0.3 * k) - 2.0 * cos(0.2 * k), run.i_A[3 * k + 1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 2.0 * cos(0.2 * k), run.i_A[3 * k + 2]);
    }
}

/* ---- two angles ---- */

/* θ_e = 3 θ_m + ahead, off by up to `off` to both sides evenly. */
static void join(double ahead, double off)
{
    begin("time_s,theta_m_rad,theta_e_rad,iq_A");
    for (int k = 0; k < N; ++k) {
        const double theta = 0.05 * k, beside = off * (2.0 * fmod(0.618034 * k, 1.0) - 1.0);
        fprintf(file, "%.4f,%.9f,%.9f,%.4f\n", 0.01 * k, fmod(theta, 2.0 * REF_PI),
                fmod(P * theta + ahead + beside + 4.0 * REF_PI, 2.0 * REF_PI), 1.0 + 0.1 * sin(k));
    }
    end();
}

/* The electrical one gives the phase. */
static void test_two_angles(void)
{
    join(0.4, 0.1);
    TEST_ASSERT_TRUE(run.turn_known && run.is_electrical);
    text_has("theta_e is ahead of pole pairs x theta_m by 0.4 rad and gives the phase", run.remark.text);
    for (int k = 0; k < N; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-7, (0.15 * k + 0.4 + 0.1 * (2.0 * fmod(0.618034 * k, 1.0) - 1.0)) / P,
                                  run.theta_m_rad[k]);
    join(0.0085, 0.0);
    text_lacks("is ahead of", run.remark.text);
    join(-0.0115, 0.0);
    text_has("is ahead of pole pairs x theta_m by -0.0115 rad", run.remark.text);
}

/* They follow each other where sin x/x is 0.9: 0.787 rad to both sides. */
static void test_two_angles_that_do_not_follow_each_other(void)
{
    join(0.4, 0.75);
    TEST_ASSERT_TRUE(run.turn_known);
    join(0.4, 0.83);
    TEST_ASSERT_FALSE(run.turn_known);
    text_has("theta_m does not follow theta_e with 3 pole pairs and is not used", run.remark.text);
}

/* ---- zeros and speeds ---- */

static void test_a_zero_that_is_given(void)
{
    begin("theta_m_rad,iq_A");
    for (int k = 0; k < N; ++k)
        fprintf(file, "%.6f,%.4f\n", 0.02 * k, sin(k));
    open_table();
    csv->has_angle_offset = true;
    csv->angle_offset_rad = 0.6;
    take();
    TEST_ASSERT_TRUE(run.zero_is_given);
    TEST_ASSERT_EQUAL_DOUBLE(0.6, run.zero_offset_rad);
    text_has("34.38 degrees electrical are added to the angle", run.remark.text);
    for (int k = 0; k < N; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.02 * k + 0.2, run.theta_m_rad[k]);
}

/* Without an angle it is the speed over the time, by the trapezoidal rule. */
static void test_an_angle_by_the_speed(void)
{
    double theta = 0.0, before_s = 0.0, before = 0.0;
    begin("time_s,speed_rad_per_s,iq_A");
    for (int k = 0; k < N; ++k)
        fprintf(file, "%.6f,%.6f,1\n", 0.01 * k + 0.002 * (k % 2), 5.0 + 3.0 * sin(0.1 * k));
    end();
    TEST_ASSERT_TRUE(run.turn_known && run.zero_is_unknown);
    text_has("no angle: it is speed x time, and its zero is not known", run.remark.text);
    for (int k = 0; k < N; ++k) {
        const double t = run.time_s[k], speed = run.speed_rad_per_s[k];
        if (k > 0) theta += 0.5 * (speed + before) * (t - before_s);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, theta, run.theta_m_rad[k]);
        before_s = t, before = speed;
    }
}

/* A speed of 0 stays where the angle only flickers: a hundredth of a turn. */
static void test_a_speed_of_0(void)
{
    for (int moves = 0; moves < 2; ++moves) {
        begin("time_s,theta_m_rad,speed_rad_per_s,iq_A,torque_Nm");
        for (int k = 0; k < N; ++k)
            fprintf(file, "%.3f,%.9f,0,1,%.4f\n", 0.01 * k, (moves ? 0.0640 : 0.0615) * k / (N - 1.0),
                    sin(k));
        end();
        TEST_ASSERT_EQUAL(moves, run.speed_rad_per_s[N / 2] > 0.0);
        TEST_ASSERT_EQUAL(moves, run.speed_window > 0);
        TEST_ASSERT_EQUAL(moves,
                          strstr(run.remark.text, "the speed is 0 but the angle moves: the slope") != NULL);
    }
}

/* Steps of more than half a turn in more than half of the rows: each stands by itself. */
static void test_samples_far_apart(void)
{
    for (int more = 0; more < 2; ++more) {
        double theta = 0.0;
        begin("time_s,theta_m_rad,speed_rad_per_s,iq_A,torque_Nm");
        for (int k = 0; k < N; ++k) {
            const bool fast = k % 100 < (more ? 53 : 47);
            fprintf(file, "%.3f,%.9f,%.6f,1,%.4f\n", 0.1 * k, fmod(theta, 2.0 * REF_PI), fast ? 40.0 : 2.0,
                    sin(k));
            theta += 0.1 * (fast ? 40.0 : 2.0);
        }
        end();
        TEST_ASSERT_EQUAL(more, run.time_s == NULL);
    }
}

/* ---- currents ---- */

/* i_q of a torque that the drive has computed, by the torque per ampere. */
static void test_a_current_by_the_computed_torque(void)
{
    options.torque_constant_Nm_per_A = 0.05;
    begin("theta_m_rad,torque_estimate");
    for (int k = 0; k < N; ++k)
        fprintf(file, "%.6f,%.6f\n", 0.02 * k, 0.1 * sin(0.2 * k));
    end();
    text_has("no currents: i_q is that torque over 0.05 N·m/A, as back_emf.csv has it", run.remark.text);
    for (int k = 0; k < N; ++k) {
        double d, q;
        rec_rotor(run.i_A + 3 * k, P * run.theta_m_rad[k], &d, &q);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, d);
        TEST_ASSERT_DOUBLE_WITHIN(2e-5, 2.0 * sin(0.2 * k), q);
    }
}

static void test_iq_alone(void)
{
    begin("theta_m_rad,iq_A");
    for (int k = 0; k < N; ++k)
        fprintf(file, "%.6f,%.6f\n", 0.02 * k, sin(0.2 * k));
    end();
    TEST_ASSERT_TRUE(run.lacks_id);
    begin("theta_m_rad,ia_A,ib_A,ic_A,iq_A");
    for (int k = 0; k < N; ++k)
        fprintf(file, "%.6f,1,2,%.6f,5\n", 0.02 * k, sin(0.2 * k));
    end();
    TEST_ASSERT_TRUE(run.has_sum && run.computed_phase == 0 && !run.has_both_frames && !run.lacks_id);
}

static void test_currents_that_are_refused(void)
{
    begin("theta_m_rad,ib_A");
    fputs("0,1\n0.1,2\n", file);
    is_refused(
        "found one phase current, `ib_A`, expected two or three of ia_A, ib_A, ic_A; add another column");
    begin("theta_m_rad,ia_A");
    fputs("0,1\n0.1,2\n", file);
    is_refused("found one phase current, `ia_A`, expected two or three");
    begin("theta_m_rad,id_A");
    fputs("0,1\n0.1,2\n", file);
    is_refused("found id_A without iq_A, expected both, or iq_A alone; add the column iq_A");
    begin("torque_Nm,ia_A,ib_A,iq_A");
    fputs("1,0,1,2\n2,0,1,2\n", file);
    is_refused(
        "found no angle beside phase currents, expected theta_m_rad or theta_e_rad; add the angle or give");
    options.pole_pairs = 0;
    begin("theta_m_rad,iq_A");
    fputs("0,1\n0.1,2\n", file);
    open_table();
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, hci_run_of_csv(csv, &options, &run, &note));
    text_has("a.csv: found 0 pole pairs, expected 1 or more; add --pole-pairs P", note.text);
}

/* ---- voltages ---- */

static void read_voltages(const char *names, int columns)
{
    char header[96];
    snprintf(header, sizeof header, "theta_m_rad,%s", names);
    begin(header);
    for (int k = 0; k < N; ++k) {
        fprintf(file, "%.6f", 0.02 * k);
        for (int s = 0; s < columns; ++s)
            fprintf(file, ",%.6f", (s + 2.0) * sin(0.06 * k + s * s));
        fputc('\n', file);
    }
    end();
}

static void test_voltages_of_phases_and_lines(void)
{
    read_voltages("va_V,vb_V,vc_V", 3);
    TEST_ASSERT_FALSE(run.voltage_is_dq);
    for (int k = 0; k < N; ++k)
        for (int s = 0; s < 3; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(1e-6, (s + 2.0) * sin(0.06 * k + s * s), run.v_V[3 * k + s]);
    text_lacks("phase voltages", run.remark.text);
    read_voltages("va_V,vb_V", 2);
    text_has("two phase voltages: the third makes the sum 0", run.remark.text);
    for (int k = 0; k < N; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(2e-6, -2.0 * sin(0.06 * k) - 3.0 * sin(0.06 * k + 1.0), run.v_V[3 * k + 2]);
    read_voltages("vab_V,vbc_V", 2);
    text_has("phase voltages from line voltages: orders divisible by three are not in them", run.remark.text);
    for (int k = 0; k < N; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(2e-6, 2.0 * sin(0.06 * k), run.v_V[3 * k] - run.v_V[3 * k + 1]);
        TEST_ASSERT_DOUBLE_WITHIN(2e-6, 3.0 * sin(0.06 * k + 1.0), run.v_V[3 * k + 1] - run.v_V[3 * k + 2]);
    }
    read_voltages("vd_V,vq_V,iq_A", 3);
    TEST_ASSERT_TRUE(run.voltage_is_dq);
    for (int k = 0; k < N; ++k) {
        double d, q;
        rec_rotor(run.v_V + 3 * k, P * run.theta_m_rad[k], &d, &q);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2.0 * sin(0.06 * k), d);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, 3.0 * sin(0.06 * k + 1.0), q);
    }
}

/* Beside no current they are a command, and not what the open machine induces. */
static void test_commanded_voltages_without_a_current(void)
{
    read_voltages("vd_V,vq_mV", 2);
    TEST_ASSERT_NULL(run.v_V);
    TEST_ASSERT_FALSE(run.voltage_is_dq);
    TEST_ASSERT_EQUAL_STRING("vq_mV", run.commanded_voltage);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1e-3, run.commanded_unit_V);
    text_has("`vq_mV` is a voltage that a drive commands", run.remark.text);
    text_lacks("columns not used", run.remark.text);
    read_voltages("va_V,vb_V,vq_V", 3);
    TEST_ASSERT_NOT_NULL(run.v_V);
    TEST_ASSERT_EQUAL_STRING("", run.commanded_voltage);
}

/* ---- a torque of 0 ---- */

/* Five times what noise makes of a mean: of 200 samples with i_q = m ± 1 that is 200 m = 5 √(200 (m² + 1)).
 */
static void test_a_torque_of_0_at_open_terminals(void)
{
    const double limit = 5.0 / sqrt(175.0);
    for (int more = 0; more < 2; ++more) { /* along d and q */
        begin("theta_m_rad,ia_A,ib_A,ic_A,va_V,vb_V,vc_V,torque_Nm");
        for (int k = 0; k < N; ++k) {
            double i_A[3];
            const double mean_A = (more ? 1.03 : 0.97) * limit, noise_A = k % 2 ? 1.0 : -1.0;
            rec_phases(-0.6 * mean_A + 0.8 * noise_A, 0.8 * mean_A + 0.6 * noise_A, P * 0.02 * k, i_A);
            fprintf(file, "%.6f,%.9f,%.9f,%.9f,%.6f,%.6f,%.6f,0\n", 0.02 * k, i_A[0], i_A[1], i_A[2],
                    sin(0.06 * k), sin(0.06 * k - 2.0944), sin(0.06 * k + 2.0944));
        }
        end();
        TEST_ASSERT_EQUAL(!more, run.torque_is_typed);
        TEST_ASSERT_EQUAL(more, run.torque_Nm != NULL);
        if (!more)
            text_has("the torque is 0 in every row beside voltages and currents that do not turn",
                     run.remark.text);
    }
}

/* One number in every row beside a current that varies. */
static void test_a_torque_that_was_typed(void)
{
    begin("theta_m_rad,iq_A,torque_Nm");
    for (int k = 0; k < N; ++k)
        fprintf(file, "%.6f,%.6f,0.35\n", 0.02 * k, 1.0 + 0.1 * sin(0.3 * k));
    end();
    TEST_ASSERT_TRUE(run.torque_is_typed);
    TEST_ASSERT_EQUAL_DOUBLE(0.35, run.torque_typed_Nm);
    TEST_ASSERT_NULL(run.torque_Nm);
    TEST_ASSERT_EQUAL(HCI_TORQUE_NONE, run.torque_source);
    text_has("the torque is 0.35 N·m in every row while the current varies: typed", run.remark.text);
}

/* Stamps that come early and late by turns. */
static void test_a_rough_clock(void)
{
    for (int rough = 0; rough < 2; ++rough) {
        begin("time_s,theta_m_rad,speed_rad_per_s,iq_A,torque_Nm");
        for (int k = 0; k < N; ++k)
            fprintf(file, "%.6f,%.6f,2,1,%.6f\n", 0.01 * (k + (rough ? 0.2 : 0.02) * (k % 3 == 0)), 0.02 * k,
                    sin(k));
        end();
        TEST_ASSERT_EQUAL(rough, run.rough_clock);
        TEST_ASSERT_TRUE(run.gap_s > 0.15 && run.gap_s < 0.25); /* twenty steps */
    }
}

/* An electrical angle within one turn knows the turns of a machine of one pole pair alone. */
static void test_turns_of_one_pole_pair(void)
{
    for (options.pole_pairs = 1; options.pole_pairs <= 2; ++options.pole_pairs) {
        begin("time_s,theta_e_rad,iq_A");
        for (int k = 0; k < N; ++k)
            fprintf(file, "%.4f,%.9f,1\n", 0.01 * k, fmod(0.2 * k, 2.0 * REF_PI));
        end();
        TEST_ASSERT_EQUAL(options.pole_pairs == 1, run.turn_known);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_torque_that_was_typed);
    RUN_TEST(test_a_rough_clock);
    RUN_TEST(test_turns_of_one_pole_pair);
    RUN_TEST(test_where_columns_are_from);
    RUN_TEST(test_electrical_columns);
    RUN_TEST(test_two_angles);
    RUN_TEST(test_two_angles_that_do_not_follow_each_other);
    RUN_TEST(test_a_zero_that_is_given);
    RUN_TEST(test_an_angle_by_the_speed);
    RUN_TEST(test_a_speed_of_0);
    RUN_TEST(test_samples_far_apart);
    RUN_TEST(test_a_current_by_the_computed_torque);
    RUN_TEST(test_iq_alone);
    RUN_TEST(test_currents_that_are_refused);
    RUN_TEST(test_voltages_of_phases_and_lines);
    RUN_TEST(test_commanded_voltages_without_a_current);
    RUN_TEST(test_a_torque_of_0_at_open_terminals);
    return UNITY_END();
}
