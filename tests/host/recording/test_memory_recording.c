/* Recordings in memory, against the same numbers in a file: to the last digit the same runs, predictions and
 * messages. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "hci/host/csv/csv.h"
#include "hci/host/recording/predict.h"
#include "hci/host/recording/run.h"
#include "host/base/memory.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

enum { ROWS = 300, COLUMNS = 5 };

static const char *const NAMES[COLUMNS] = {"time_ms", "theta_e (deg)", "iq_A", "torque_mNm", "erpm"};
static double number[COLUMNS][ROWS];
static const double *const VALUES[COLUMNS] = {number[0], number[1], number[2], number[3], number[4]};
static hci_csv_memory memory;
static char file[96];
static hci_note note;

void setUp(void)
{
    files_begin();
    snprintf(file, sizeof file, "%s", files_path("run.csv"));
    memset(&note, 0, sizeof note);
    memory = (hci_csv_memory){"log of monday", NAMES, VALUES, COLUMNS, ROWS};
    for (int k = 0; k < ROWS; ++k) {
        number[0][k] = 0.5 * k;
        number[1][k] = fmod(3.0 * k, 360.0);
        number[2][k] = 2.0 + 0.01 * k;
        number[3][k] = 2600.0 + 7.0 * k + 20.0 * sin(0.3 * k);
        number[4][k] = 1000.0;
    }
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    files_end();
}

/* What is in memory as a file; what is no number as an empty cell. */
static void write_file(void)
{
    FILE *stream = fopen(file, "w");
    TEST_ASSERT_NOT_NULL(stream);
    for (size_t c = 0; c < memory.columns; ++c)
        fprintf(stream, "%s%c", memory.column[c], c + 1 < memory.columns ? ',' : '\n');
    for (size_t k = 0; k < memory.rows; ++k)
        for (size_t c = 0; c < memory.columns; ++c) {
            if (!isnan(memory.value[c][k])) fprintf(stream, "%.17g", memory.value[c][k]);
            fputc(c + 1 < memory.columns ? ',' : '\n', stream);
        }
    fclose(stream);
}

static hci_run_options reading(void)
{
    return (hci_run_options){.pole_pairs = 4, .inertia_kgm2 = NAN, .memory = &memory, .memory_count = 1};
}

static void same(const double *a, const double *b, size_t count)
{
    TEST_ASSERT_TRUE((a == NULL) == (b == NULL));
    if (a) TEST_ASSERT_EQUAL_MEMORY(a, b, count * sizeof *a);
}

static void same_runs(const hci_run *a, const hci_run *b)
{
    TEST_ASSERT_EQUAL(b->count, a->count);
    same(a->time_s, b->time_s, a->count);
    same(a->theta_m_rad, b->theta_m_rad, a->count);
    same(a->speed_rad_per_s, b->speed_rad_per_s, a->count);
    same(a->i_A, b->i_A, 3 * a->count);
    same(a->torque_Nm, b->torque_Nm, a->count);
    TEST_ASSERT_EQUAL_STRING(b->remark.text, a->remark.text);
}

static void compare(void)
{
    const hci_run_options options = reading();
    hci_run of_file = {0}, of_memory = {0};
    write_file();
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(file, &options, &of_file, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(memory.name, &options, &of_memory, &note), note.text);
    same_runs(&of_memory, &of_file);
    TEST_ASSERT_EQUAL_STRING(memory.name, of_memory.name);
    hci_run_release(&of_file);
    hci_run_release(&of_memory);
}

static void test_the_run_of_a_file(void)
{
    compare();
}

/* Row 17 has no torque, row 40 is there twice, and the last has neither current nor speed. */
static void test_holes_and_rows_that_are_there_twice(void)
{
    number[3][17] = NAN;
    for (int c = 0; c < COLUMNS; ++c)
        number[c][41] = number[c][40];
    number[2][ROWS - 1] = number[4][ROWS - 1] = NAN;
    compare();
}

/* The line is that of a file with its header in line 1. */
static void test_a_hole_is_named_by_its_line(void)
{
    hci_run run = {0};
    hci_run_options options = reading();
    number[3][17] = NAN;
    options.strict = true;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_run_read(memory.name, &options, &run, &note));
    text_has("log of monday:19: column 4 `torque_mNm`: found an empty cell", note.text);
    memset(&note, 0, sizeof note);
    number[3][17] = INFINITY;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_run_read(memory.name, &options, &run, &note));
    text_has("log of monday:19: column 4 `torque_mNm`: found `inf`", note.text);
    TEST_ASSERT_NULL(run.name);
}

static void test_names_that_no_header_may_have(void)
{
    static const char *const TWICE[COLUMNS] = {"iq_A", "theta_e_rad", "iq_A", "torque_Nm", "x"};
    hci_csv *csv;
    memory.column = TWICE;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_of_memory(&memory, &csv, &note));
    TEST_ASSERT_NULL(csv);
    text_has("log of monday:1: column 3 `iq_A`: found the name of column 1 again", note.text);
    memset(&note, 0, sizeof note);
    memory.columns = 0;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_of_memory(&memory, &csv, &note));
    text_has("log of monday: found no column", note.text);
}

static void test_columns_by_name(void)
{
    hci_column_names names = {0};
    hci_run_options options = reading();
    hci_run run = {0};
    static const char *const OTHERS[COLUMNS] = {"time_ms", "theta_e (deg)", "channel 3", "torque_mNm",
                                                "erpm"};
    memory.column = OTHERS;
    TEST_ASSERT_EQUAL(HCI_OK, hci_column_names_add(&names, "iq_A=channel 3", &note));
    options.columns = &names;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(memory.name, &options, &run, &note), note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -2.0 * sqrt(0.75), run.i_A[1]); /* i_b = i_q sin(−120°) at angle 0 */
    hci_run_release(&run);
    hci_column_names_release(&names);
}

static void test_a_list_of_both_kinds(void)
{
    const hci_run_options options = reading();
    hci_runs runs = {0};
    write_file();
    TEST_ASSERT_EQUAL(HCI_OK, hci_runs_add(&runs, file, HCI_ROLE_FIT, &options, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_runs_add(&runs, memory.name, HCI_ROLE_HOLDOUT, &options, &note));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_runs_add(&runs, file, HCI_ROLE_FIT, &options, &note));
    text_has("found it a second time", note.text);
    TEST_ASSERT_EQUAL(2, runs.count);
    TEST_ASSERT_EQUAL(HCI_ROLE_FIT, runs.role[0]);
    TEST_ASSERT_EQUAL(HCI_ROLE_HOLDOUT, runs.role[1]);
    TEST_ASSERT_NULL(runs.origin);
    same_runs(&runs.run[1], &runs.run[0]);
    hci_runs_release(&runs);
}

static void test_the_samples_of_a_prediction(void)
{
    const hci_run_options options = reading();
    const char *const out = files_path("out.csv");
    char path[96];
    hci_prediction of_file, of_memory;
    hci_predicted_run predicted;
    double *column = NULL;
    hci_csv *csv;
    snprintf(path, sizeof path, "%s", out);
    write_file();
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK, hci_predict_file("data/machine_a", file, &options, path, &of_file, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK, hci_predict_samples("data/machine_a", memory.name, &options, &predicted, &of_memory, &note),
        note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(path, &csv, &note), note.text);
    column = hci_memory_new(ROWS, sizeof *column);
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "torque_model_Nm", column, &note));
    same(predicted.model_Nm, column, ROWS);
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_numbers(csv, "residual_Nm", column, &note));
    same(predicted.residual_Nm, column, ROWS);
    same(&of_memory.rms_residual_Nm, &of_file.rms_residual_Nm, 1);
    TEST_ASSERT_TRUE(of_memory.rms_residual_Nm > 0.0);
    hci_memory_free(column);
    hci_csv_free(csv);
    hci_predicted_run_release(&predicted);
}

static void test_memory_runs_out_everywhere(void)
{
    const hci_run_options options = reading();
    hci_status status = HCI_ERROR_MEMORY;
    long allowed = 0;
    for (; status == HCI_ERROR_MEMORY; ++allowed) {
        hci_note said = {{0}};
        hci_predicted_run predicted;
        hci_prediction sum;
        hci_memory_fail_after(allowed);
        status = hci_predict_samples("data/machine_a", memory.name, &options, &predicted, &sum, &said);
        hci_memory_fail_after(-1);
        if (status == HCI_ERROR_MEMORY) text_has("memory", said.text);
        hci_predicted_run_release(&predicted);
    }
    TEST_ASSERT_EQUAL(HCI_OK, status);
    TEST_ASSERT_TRUE(allowed > 20);
}

/* A shaft that stands, then turns: what is read so far is released whichever allocation fails. */
static void test_one_allocation_fails(void)
{
    const hci_run_options options = reading();
    for (int k = 0; k < ROWS / 3; ++k)
        number[1][k] = 0.0;
    for (long at = 0; at < 200; ++at) {
        hci_note said = {{0}};
        hci_run run = {0};
        hci_memory_fail_once_after(at);
        const hci_status status = hci_run_read(memory.name, &options, &run, &said);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK || status == HCI_ERROR_MEMORY);
        if (status == HCI_ERROR_MEMORY) text_has("memory", said.text);
        hci_run_release(&run);
    }
    (void)hci_memory_was_short();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_run_of_a_file);
    RUN_TEST(test_holes_and_rows_that_are_there_twice);
    RUN_TEST(test_a_hole_is_named_by_its_line);
    RUN_TEST(test_names_that_no_header_may_have);
    RUN_TEST(test_columns_by_name);
    RUN_TEST(test_a_list_of_both_kinds);
    RUN_TEST(test_the_samples_of_a_prediction);
    RUN_TEST(test_memory_runs_out_everywhere);
    RUN_TEST(test_one_allocation_fails);
    return UNITY_END();
}
