/* The model's torque for a run, against the torque formula written out, and the run written again. */
#include "hci/host/recording/predict.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hci/host/csv/csv.h"
#include "hci/host/machine/effects.h"
#include "hci/host/report/summary.h"
#include "host/base/memory.h"
#include "support/draws.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

static char run_path[96], out[96], effects_path[128];
static hci_note note;
static hci_prediction prediction;

void setUp(void)
{
    files_begin();
    snprintf(run_path, sizeof run_path, "%s", files_path("run.csv"));
    snprintf(out, sizeof out, "%s", files_path("out.csv"));
    snprintf(effects_path, sizeof effects_path, "%s", files_path("effects.csv"));
    files_write(files_path("machine.csv"), "name,value,unit,source\npole_pairs,3,1,\ninertia,0.01,kgm2,\n");
    files_write(files_path("back_emf.csv"), "order,amplitude_Nm_per_A,phase_rad\n1,0.5,0\n5,0.02,0.4\n");
    files_write(files_path("cogging.csv"), "order,amplitude_Nm,phase_rad\n6,0.1,1\n");
    memset(&note, 0, sizeof note);
}

void tearDown(void)
{
    static const char *const names[] = {"machine.csv", "back_emf.csv", "cogging.csv",
                                        "effects.csv", "run.csv",      "out.csv"};
    hci_memory_fail_after(-1);
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k)
        unlink(files_path(names[k]));
    TEST_ASSERT_EQUAL_MESSAGE(0, files_count(files_root), "a file is left");
    files_end();
}

/* The machine above. */
static double torque_at(double theta_m, double id, double iq)
{
    const double theta = 3.0 * theta_m;
    double sum = 0.1 * sin(6.0 * theta + 1.0);
    for (int s = 0; s < 3; ++s) {
        const double turned = theta - 2.0 * REF_PI * s / 3.0;
        sum += (0.5 * sin(turned) + 0.02 * sin(5.0 * turned + 0.4)) * (iq * sin(turned) - id * cos(turned));
    }
    return sum;
}

static void predict(void)
{
    const hci_status status =
        hci_predict_file(files_root, run_path, &(hci_run_options){0}, out, &prediction, &note);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, status, note.text);
}

static hci_csv *read_out(void)
{
    hci_csv *csv;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(out, &csv, &note), note.text);
    return csv;
}

enum { SAMPLES = 400 };

/* At `speed` rad/s, with currents that change; torque that is read: of `late_s` before, and `more_Nm`. */
static void record(double speed, double late_s, double more_Nm)
{
    FILE *file = fopen(run_path, "w");
    fprintf(file, "time_s,theta_m_rad,speed_rad_per_s,id_A,iq_A,torque_Nm\n");
    for (int k = 0; k < SAMPLES; ++k) {
        const double t = 1e-4 * k, before = t - late_s;
        fprintf(file, "%.12g,%.12g,%.12g,%.12g,%.12g,%.12g\n", t, speed * t, speed, -1.0 + 5.0 * t,
                2.0 + 20.0 * t,
                torque_at(speed * before, -1.0 + 5.0 * before, 2.0 + 20.0 * before) + more_Nm);
    }
    fclose(file);
}

static void test_torque_and_residual(void)
{
    double model[SAMPLES], residual[SAMPLES];
    record(50.0, 0.0, 0.25);
    predict();
    hci_csv *csv = read_out();
    TEST_ASSERT_EQUAL(SAMPLES, (int)hci_csv_rows(csv));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "torque_model_Nm", model, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "residual_Nm", residual, &note));
    for (int k = 0; k < SAMPLES; ++k) {
        const double t = 1e-4 * k;
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, torque_at(50.0 * t, -1.0 + 5.0 * t, 2.0 + 20.0 * t), model[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, 0.25, residual[k]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, 0.25, prediction.rms_residual_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, 0.25, prediction.mean_torque_Nm - prediction.mean_model_Nm);
    TEST_ASSERT_EQUAL(HCI_TORQUE_MEASURED, prediction.source);
    hci_csv_free(csv);
}

/* 300 µs late at 200 rad/s: 10 degrees electrical. Currents that change need their rate. */
static void test_effects_act(void)
{
    record(200.0, 3e-4, 0.25);
    predict();
    TEST_ASSERT_TRUE(prediction.rms_residual_Nm > 0.255);
    files_write(effects_path, "effect,parameter,value,unit,std_error\nchannel_delay,torque,300,us,\n"
                              "torque_sensor,offset,0.25,Nm,\n");
    predict();
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.0, prediction.rms_residual_Nm);
}

/* A lag of 5 ms of a torque that steps at the start of the run stays behind by dT/dt·τ once it has settled.
 */
static void test_the_sensor_lags_along_time(void)
{
    FILE *file = fopen(run_path, "w");
    fprintf(file, "time_s,theta_m_rad,iq_A,torque_Nm\n");
    for (int k = 0; k < 2000; ++k)
        fprintf(file, "%.12g,0.3,%.12g,0\n", 1e-4 * k, 10.0 * 1e-4 * k);
    fclose(file);
    files_write(effects_path, "effect,parameter,value,unit,std_error\ntorque_sensor,time_constant,5,ms,\n");
    predict();
    double model[2000];
    hci_csv *csv = read_out();
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "torque_model_Nm", model, &note));
    const double slope = (torque_at(0.3, 0.0, 1.0) - torque_at(0.3, 0.0, 0.0)) * 10.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, torque_at(0.3, 0.0, 1.999) - slope * 5e-3, model[1999]);
    hci_csv_free(csv);
    TEST_ASSERT_EQUAL(HCI_TORQUE_HOLDING, prediction.source);
}

static void test_a_free_shaft(void)
{
    FILE *file = fopen(run_path, "w");
    fprintf(file, "time_s,theta_m_rad,speed_rad_per_s,iq_A\n");
    for (int k = 0; k < 1000; ++k) {
        const double t = 1e-3 * k;
        fprintf(file, "%.12g,%.12g,%.12g,1\n", t, 50.0 * t * t, 100.0 * t);
    }
    fclose(file);
    predict();
    double inertia[1000], model[1000], residual[1000];
    hci_csv *csv = read_out();
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "torque_inertia_Nm", inertia, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "torque_model_Nm", model, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "residual_Nm", residual, &note));
    for (int k = 0; k < 1000; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0, inertia[k]); /* 0.01 kg·m² · 100 rad/s² */
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, inertia[k] - model[k], residual[k]);
    }
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, prediction.source);
    hci_csv_free(csv);
}

/* One second at 20 rad/s from `start`, gaining `gain` rad/s, at this i_q. */
static void record_shaft(double gain, double iq)
{
    FILE *file = fopen(run_path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "time_s,theta_m_rad,speed_rad_per_s,iq_A\n");
    for (int k = 0; k <= 1000; ++k) {
        const double t = 1e-3 * k;
        fprintf(file, "%.12g,%.12g,%.12g,%.12g\n", t, 20.0 * t + 0.5 * gain * t * t, 20.0 + gain * t, iq);
    }
    fclose(file);
}

/* 3/2·0.5 N·m/A times 2 A against nothing: there is a load. */
static void test_a_shaft_with_a_load_has_no_torque(void)
{
    record_shaft(0.0, 2.0);
    predict();
    TEST_ASSERT_EQUAL(HCI_TORQUE_NONE, prediction.source);
    TEST_ASSERT_TRUE(isnan(prediction.rms_residual_Nm));
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 1.5, prediction.mean_model_Nm);
    text_has("the current makes 1.5 N·m on average, but inertia x acceleration is 0 N·m",
             prediction.remark.text);
    hci_csv *csv = read_out();
    TEST_ASSERT_TRUE(hci_csv_has(csv, "torque_model_Nm"));
    TEST_ASSERT_FALSE(hci_csv_has(csv, "torque_inertia_Nm"));
    TEST_ASSERT_FALSE(hci_csv_has(csv, "residual_Nm"));
    hci_csv_free(csv);
    record_shaft(20.0, -2.0); /* driven by another machine, against the current */
    predict();
    TEST_ASSERT_EQUAL(HCI_TORQUE_NONE, prediction.source);
}

/* Its own drag may take half of what the current makes, and all of it where that is little for the machine or
 * declared. */
static void test_a_drag_of_its_own_is_allowed(void)
{
    static const char *const MACHINE = "name,value,unit,source\npole_pairs,3,1,\ninertia,0.01,kgm2,\n";
    char text[160];
    record_shaft(75.0, 2.0); /* 0.75 of 1.5 N·m accelerate */
    predict();
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, prediction.source);
    record_shaft(-75.0, 0.0); /* runs down */
    predict();
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, prediction.source);
    record_shaft(0.0, 2.0);
    files_write(effects_path, "effect,parameter,value,unit,std_error\nfriction,coulomb,1.4,Nm,\n");
    predict();
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, prediction.source);
    unlink(effects_path);
    snprintf(text, sizeof text, "%srated_current,21,A,\n", MACHINE);
    files_write(files_path("machine.csv"), text);
    predict();
    TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, prediction.source);
    snprintf(text, sizeof text, "%srated_current,19,A,\n", MACHINE);
    files_write(files_path("machine.csv"), text);
    predict();
    TEST_ASSERT_EQUAL(HCI_TORQUE_NONE, prediction.source);
}

/* T-Motor MN4004: drags of 2 to 4 mN·m beside a friction of 1.5 mN·m in the holding test. */
static void test_measured_free_shafts_stay_free(void)
{
    static const char *const FILES[] = {"speed_control.csv", "acceleration.csv"};
    for (int k = 0; k < 2; ++k) {
        char path[128];
        snprintf(path, sizeof path, "../shared/measured/laas_mn4004/%s", FILES[k]);
        if (access(path, R_OK) != 0) TEST_IGNORE_MESSAGE("no recordings in ../shared/measured");
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK,
                                  hci_predict_file("tests/measured/laas_mn4004", path, &(hci_run_options){0},
                                                   NULL, &prediction, &note),
                                  note.text);
        TEST_ASSERT_EQUAL(HCI_TORQUE_INERTIA, prediction.source);
        text_has("as of a free shaft it is inertia x acceleration", prediction.remark.text);
    }
}

/* No cogging at θ = −1/6, no other torque without current. */
static void test_columns_pass_through(void)
{
    unlink(files_path("cogging.csv"));
    files_write(run_path, "\xEF\xBB\xBF# a comment\r\n"
                          "Theta_M;Torque;note;residual_Nm;x,y\r\n"
                          "deg;mNm;-;-;-\r\n"
                          "1,50;-12,5;\"say \"\"so\"\"; or, not\";9;\r\n"
                          "2,0;1e3;#2;9;a\tb\r\n");
    predict();
    TEST_ASSERT_EQUAL_STRING("Theta_M,Torque,note,\"x,y\",torque_model_Nm,residual_Nm\n"
                             "deg,mNm,-,-,Nm,Nm\n"
                             "1.50,-12.5,\"say \"\"so\"\"; or, not\",,0,-0.0125\n"
                             "2.0,1e3,#2,\"a\tb\",0,1\n",
                             files_read(out));
    hci_csv *csv = read_out();
    const char *text;
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_text(csv, "note", 0, &text, &note));
    TEST_ASSERT_EQUAL_STRING("say \"so\"; or, not", text);
    hci_csv_free(csv);
}

static void test_a_run_without_torque_has_no_residual(void)
{
    files_write(run_path, "theta_m_rad,iq_A\n0,1\n1,1\n");
    predict();
    TEST_ASSERT_TRUE(isnan(prediction.rms_residual_Nm));
    hci_csv *csv = read_out();
    TEST_ASSERT_FALSE(hci_csv_has(csv, "residual_Nm"));
    TEST_ASSERT_TRUE(hci_csv_has(csv, "torque_model_Nm"));
    hci_csv_free(csv);
    char *json = hci_prediction_json(&prediction);
    text_has("\"rms_Nm\":\tnull", json);
    text_has("\"torque_source\":\t\"none\"", json);
    hci_text_free(json);
}

static void test_what_an_effect_lacks_is_told(void)
{
    files_write(run_path, "theta_e_rad,torque_Nm\n0,1\n1,1\n");
    files_write(effects_path,
                "effect,parameter,value,unit,std_error\nfriction,coulomb,0.1,Nm,\n"
                "torque_sensor,time_constant,5,ms,\nmagnet_temperature,emf_per_kelvin,-0.001,1/K,\n"
                "mechanical_order,sine_0.333333333,0.1,Nm,\n");
    predict();
    text_has("without time", prediction.remark.text);
    text_has("without a speed", prediction.remark.text);
    text_has("without a temperature", prediction.remark.text);
    text_has("orders k/p", prediction.remark.text);
}

static void test_refused(void)
{
    files_write(run_path, "time_s,va_V,vb_V,vc_V\n0,1,1,1\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT,
                      hci_predict_file(files_root, run_path, &(hci_run_options){0}, out, &prediction, &note));
    text_has("found no angle", note.text);
    TEST_ASSERT_TRUE(access(out, F_OK) != 0);
}

static void test_memory_runs_out_everywhere(void)
{
    record(50.0, 0.0, 0.0);
    files_write(effects_path, "effect,parameter,value,unit,std_error\nchannel_delay,torque,300,us,\n");
    hci_status status = HCI_ERROR_MEMORY;
    long allowed = 0;
    for (; status == HCI_ERROR_MEMORY; ++allowed) {
        hci_note said = {{0}};
        hci_memory_fail_after(allowed);
        status = hci_predict_file(files_root, run_path, &(hci_run_options){0}, out, &prediction, &said);
        hci_memory_fail_after(-1);
        if (status == HCI_ERROR_MEMORY) {
            text_has("memory", said.text);
            TEST_ASSERT_TRUE(access(out, F_OK) != 0);
        }
    }
    TEST_ASSERT_EQUAL(HCI_OK, status);
    TEST_ASSERT_TRUE(allowed > 20);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_torque_and_residual);
    RUN_TEST(test_effects_act);
    RUN_TEST(test_the_sensor_lags_along_time);
    RUN_TEST(test_a_free_shaft);
    RUN_TEST(test_a_shaft_with_a_load_has_no_torque);
    RUN_TEST(test_a_drag_of_its_own_is_allowed);
    RUN_TEST(test_measured_free_shafts_stay_free);
    RUN_TEST(test_columns_pass_through);
    RUN_TEST(test_a_run_without_torque_has_no_residual);
    RUN_TEST(test_what_an_effect_lacks_is_told);
    RUN_TEST(test_refused);
    RUN_TEST(test_memory_runs_out_everywhere);
    return UNITY_END();
}
