/* Recordings with holes: what is left out, what is said of it, and when a file is refused for it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/recording/predict.h"
#include "hci/host/recording/run.h"
#include "host/base/memory.h"
#include "support/draws.h"
#include "support/run_file.h"
#include "support/texts.h"
#include "unity.h"

static const hci_run_options PLAIN = {.pole_pairs = 2, .inertia_kgm2 = NAN},
                             STRICT = {.pole_pairs = 2, .inertia_kgm2 = NAN, .strict = true};

void setUp(void)
{
    run_file_begin();
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    run_file_end();
}

static void read_text(const char *text)
{
    hci_run_release(&run);
    files_write(path, text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &PLAIN, &run, &note), note.text);
}

static void refused(const char *text, const hci_run_options *options, const char *words)
{
    hci_note said = {{0}};
    hci_run_release(&run);
    files_write(path, text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_INPUT, hci_run_read(path, options, &run, &said), text);
    text_has(words, said.text);
}

#define HEAD "time_s,theta_m_rad,iq_A\n"

/* Six rows, the fourth (line 5) in the place of `row`. */
static const char *with_row(const char *row)
{
    static char text[400];
    snprintf(text, sizeof text, HEAD "0,0.0,1\n1,0.1,2\n2,0.2,3\n%s\n4,0.4,5\n5,0.5,6\n", row);
    return text;
}

/* ---- one hole ---- */

static void test_a_row_with_a_hole_is_left_out_and_said(void)
{
    static const struct {
        const char *row, *said;
    } CASES[] = {
        {"3,nan,4",
         "1 of 6 rows have a hole and are left out, first line 5, column 2 `theta_m_rad`: found `nan`"},
        {"3,0.3,", "first line 5, column 3 `iq_A`: found an empty cell"},
        {"3,0.3,-Inf", "first line 5, column 3 `iq_A`: found `-Inf`"},
        {"3,0.3,ERR", "column 3 `iq_A`: found `ERR`"},
        {"3,0.3", "first line 5, column 3 `iq_A`: found the end of the line"},
        {"3,0.3,4,3,0.3,4", "first line 5, column 4: found `3`"},
        {"3,0.33,0.4,5", "found `5`"},
    };
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        read_text(with_row(CASES[k].row));
        text_has(CASES[k].said, run.remark.text);
        TEST_ASSERT_EQUAL_MESSAGE(5, run.count, CASES[k].row);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.2, run.theta_m_rad[2]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.4, run.theta_m_rad[3]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 4.0, run.time_s[3]);
        refused(with_row(CASES[k].row), &STRICT, "run.csv:5: column");
    }
}

static void test_all_holes_make_one_remark(void)
{
    read_text(HEAD "0,0.0,1\n1,0.1\n2,0.2,3\n3,,4\n4,0.4,5\n5,0.5,nan\n6,0.6,7\n7,0.7,8\n");
    TEST_ASSERT_EQUAL(5, run.count);
    text_has("3 of 8 rows have a hole and are left out, first line 3, column 3 `iq_A`", run.remark.text);
    TEST_ASSERT_NULL(strstr(run.remark.text, "line 5"));
}

static void test_a_file_without_holes_says_nothing(void)
{
    read_text(with_row("3,0.3,4"));
    TEST_ASSERT_EQUAL(6, run.count);
    TEST_ASSERT_NULL(run.row);
    TEST_ASSERT_NULL_MESSAGE(strstr(run.remark.text, "left out"), run.remark.text);
}

static void test_a_file_that_was_cut_off(void)
{
    FILE *file = fopen(path, "wb");
    TEST_ASSERT_NOT_NULL(file);
    const char text[] = HEAD "0,0.0,1\n1,0.1,2\n2,0.2,3\n3,0.\0\0\0\0\0";
    fwrite(text, 1, sizeof text - 1, file);
    fclose(file);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &PLAIN, &run, &note), note.text);
    TEST_ASSERT_EQUAL(3, run.count);
    text_has("first line 5, column 3 `iq_A`: found the end of the line", run.remark.text);
    hci_run_release(&run);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_run_read(path, &STRICT, &run, &note));
    text_has("a NUL byte", note.text);
}

/* A stamp that two rows have is no second row only where both are the same in all. */
static void test_lines_that_are_there_twice(void)
{
    read_text(HEAD "0,0.0,1\n1,0.1,2\n1,0.1,2\n1,0.1,2\n2,0.2,3\n");
    TEST_ASSERT_EQUAL(3, run.count);
    text_has("2 rows are the same as those before them, time included, and are left out, first line 4",
             run.remark.text);
    read_text("theta_m_rad,iq_A\n0.1,2\n0.1,2\n");
    TEST_ASSERT_EQUAL(2, run.count);
}

/* ---- too many ---- */

static void test_more_than_half_is_an_error(void)
{
    read_text(HEAD "0,0,1\n1,,2\n2,0.2,3\n3,,4\n");
    TEST_ASSERT_EQUAL(2, run.count);
    refused(HEAD "0,0,1\n1,,2\n2,0.2,3\n3,,4\n4,nan,5\n", &PLAIN,
            "run.csv:3: column 2 `theta_m_rad`: found an empty cell");
    refused(HEAD "0,0,1\n1,,2\n2,0.2,3\n3,,4\n4,nan,5\n", &PLAIN,
            "3 of 5 rows have such holes, more than half");
    refused(HEAD "0,0\n1,0\n2,0.2,3\n", &PLAIN, "run.csv:2: column 3 `iq_A`: found the end of the line");
    refused("time_s;theta_m_rad\n0;1,5\n1;1.5\n", &PLAIN, "one decimal mark");
}

/* A decimal comma among commas makes every row too long. */
static void test_a_decimal_comma_among_commas_is_refused(void)
{
    refused("time_s,theta_m_rad\n0,0,1\n0,1,2\n", &PLAIN, "if the comma is the decimal mark");
}

/* Units that are not known must not pass as a hole. */
static void test_a_text_in_the_first_row_is_refused(void)
{
    refused(HEAD "s,parsec,furlong\n0,0.0,1\n1,0.1,2\n2,0.2,3\n", &PLAIN, "run.csv:2: column");
    read_text(HEAD "0,NA,1\n1,0.1,2\n2,0.2,3\n");
    TEST_ASSERT_EQUAL(2, run.count);
}

/* ---- whole columns ---- */

static void test_an_empty_column_that_is_not_needed_is_ignored(void)
{
    read_text("time_s,theta_m_rad,iq_A,temperature_C,torque_Nm\n0,0,1,,\n1,0.1,2,nan,\n2,0.2,3,,\n");
    TEST_ASSERT_EQUAL(3, run.count);
    TEST_ASSERT_NULL(run.temperature_C);
    TEST_ASSERT_NULL(run.torque_Nm);
    text_has("`temperature_C`: 3 of 3 cells have no number, it is not used", run.remark.text);
    text_has("`torque_Nm`: 3 of 3 cells have no number, it is not used", run.remark.text);
    TEST_ASSERT_NULL(strstr(run.remark.text, "columns not used"));
    refused("time_s,theta_m_rad,iq_A\n0,,1\n1,,2\n", &PLAIN, "no number in the column of the angle");
}

/* i_d, i_q beside phase currents are not read. */
static void test_holes_in_columns_that_are_not_read_do_not_matter(void)
{
    read_text("theta_m_rad,ia_A,ib_A,iq_A,lamp\n0,1,2,nan,\n0.1,2,3,1,\n0.2,2,3,1,\n");
    TEST_ASSERT_EQUAL(3, run.count);
    TEST_ASSERT_NULL_MESSAGE(strstr(run.remark.text, "left out"), run.remark.text);
}

/* A thermometer is logged more seldom than the rest. */
static void test_temperatures_between_are_interpolated(void)
{
    static const double EXPECTED[] = {20, 20, 22, 24, 24};
    read_text("theta_m_rad,temperature_C\n0,\n0.1,20\n0.2,\n0.3,24\n0.4,\n");
    TEST_ASSERT_EQUAL(5, run.count);
    for (size_t k = 0; k < 5; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, EXPECTED[k], run.temperature_C[k]);
    text_has("`temperature_C`: 3 of 5 cells have no number and are interpolated", run.remark.text);
}

/* ---- beside a hole ---- */

/* θ = 3t² turns a fast shaft by more than half a turn across the hole: the speed beside it is still 6t. */
static void test_no_derivative_across_a_hole(void)
{
    FILE *file = fopen(path, "w");
    TEST_ASSERT_NOT_NULL(file);
    fputs("time_s,theta_m_rad\n", file);
    for (int k = 0; k < 400; ++k) {
        const double t = 0.01 * k, angle = 3.0 * t * t;
        if (k >= 200 && k < 260)
            fprintf(file, "%.4f,\n", t);
        else
            fprintf(file, "%.4f,%.9f\n", t, angle - 2.0 * REF_PI * floor(angle / (2.0 * REF_PI)));
    }
    fclose(file);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_run_read(path, &PLAIN, &run, &note), note.text);
    TEST_ASSERT_EQUAL(340, run.count);
    for (size_t k = 0; k < run.count; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, 6.0 * run.time_s[k], run.speed_rad_per_s[k]);
}

/* ---- written again ---- */

static void test_a_prediction_leaves_the_cells_of_a_hole_empty(void)
{
    hci_prediction p;
    char out[96], line[200];
    files_write(files_path("machine.csv"), "name,value,unit\npole_pairs,2,1\n");
    files_write(files_path("back_emf.csv"), "order,amplitude_Nm_per_A,phase_rad\n1,1,0\n");
    files_write(path, HEAD "0,0.0,1\n1,0.1,2\n2,0.2,3\n3,nan,4\n4,0.4,0\n5,0.5,6\n");
    snprintf(out, sizeof out, "%s", files_path("predicted.csv"));
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_predict_file(files_root, path, &PLAIN, out, &p, &note), note.text);
    TEST_ASSERT_EQUAL(5, p.count);
    FILE *file = fopen(out, "r");
    TEST_ASSERT_NOT_NULL(file);
    for (int k = 0; k < 5; ++k)
        TEST_ASSERT_NOT_NULL(fgets(line, sizeof line, file));
    TEST_ASSERT_EQUAL_STRING("3,nan,4,\n", line);
    TEST_ASSERT_NOT_NULL(fgets(line, sizeof line, file));
    TEST_ASSERT_EQUAL_STRING("4,0.4,0,0\n", line);
    fclose(file);
}

static void test_memory_runs_out_everywhere(void)
{
    hci_status status = HCI_ERROR_MEMORY;
    long allowed = 0;
    files_write(path, with_row("3,nan,4"));
    for (; status == HCI_ERROR_MEMORY; ++allowed) {
        memset(&note, 0, sizeof note);
        hci_memory_fail_after(allowed);
        status = hci_run_read(path, &PLAIN, &run, &note);
    }
    hci_memory_fail_after(-1);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, status, note.text);
    TEST_ASSERT_TRUE(allowed > 8);
}

/* ---- readings that stand still ---- */

enum { ROWS = 1200 };

static double ripple_Nm = 0.3;

/* A turning shaft with a torque that was read anew every `each` rows, in units of `unit_Nm` (0: as it is),
 * and currents every `current_each`. */
static void read_held(int each, double unit_Nm, int current_each)
{
    char *text = malloc(ROWS * 120);
    size_t at = (size_t)sprintf(text, "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\n");
    TEST_ASSERT_NOT_NULL(text);
    for (int k = 0; k < ROWS; ++k) {
        const double torque = 1.0 + sin(0.013 * (k / each * each)) + ripple_Nm * sin(0.7 * (k / each * each));
        const double theta = 0.01 * k, of_current = 2.0 * 0.01 * (k / current_each * current_each);
        at += (size_t)sprintf(text + at, "%g,%.9g,%.12g,%.12g,%.12g,%.12g\n", 1e-3 * k, theta,
                              sin(of_current), sin(of_current - 2.0943951), sin(of_current + 2.0943951),
                              unit_Nm > 0.0 ? unit_Nm * floor(torque / unit_Nm) : torque);
    }
    read_text(text);
    free(text);
}

static void test_a_torque_that_is_read_less_often(void)
{
    read_held(8, 0.0, 1);
    TEST_ASSERT_EQUAL_UINT64(ROWS / 8, run.count);
    for (size_t k = 0; k < run.count; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 8e-3 * (double)k, run.time_s[k]);
    text_has("1050 of 1200 rows repeat the torque before", run.remark.text);
}

static void test_currents_that_are_read_less_often(void)
{
    read_held(1, 0.0, 5);
    TEST_ASSERT_EQUAL_UINT64(ROWS / 5, run.count);
    text_has("960 of 1200 rows repeat the currents before", run.remark.text);
}

/* A torque that a model made is one number but for rounding, of which two are equal here and there. */
static void test_a_torque_without_ripple_stays(void)
{
    char *text = malloc(ROWS * 120);
    size_t at = (size_t)sprintf(text, "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\n");
    TEST_ASSERT_NOT_NULL(text);
    for (int k = 0; k < ROWS; ++k) {
        const double rounding = 4e-15 * sin(2.3 * (k == 700 ? 699 : k)), theta = 0.01 * k;
        at += (size_t)sprintf(text + at, "%g,%.9g,%.12g,%.12g,%.12g,%.17g\n", 1e-3 * k, theta, sin(theta),
                              sin(theta - 2.0943951), sin(theta + 2.0943951), 2.0 + rounding);
    }
    read_text(text);
    free(text);
    TEST_ASSERT_EQUAL_UINT64(ROWS, run.count);
}

/* Of a coarse reading neighbours are equal, and that says what it is. */
static void test_a_coarse_torque_stays(void)
{
    static const double UNIT_NM[] = {0.05, 0.2, 0.5};
    for (size_t k = 0; k < sizeof UNIT_NM / sizeof *UNIT_NM; ++k) {
        read_held(1, UNIT_NM[k], 1);
        TEST_ASSERT_EQUAL_UINT64(ROWS, run.count);
    }
    ripple_Nm = 0.0; /* it goes up and down by one unit at a time, and never comes back at once */
    read_held(1, 0.01, 1);
    ripple_Nm = 0.3;
    TEST_ASSERT_EQUAL_UINT64(ROWS, run.count);
}

/* Of noise in six digits a few neighbours are equal by chance, and stay; a reading that stays for longer does
 * not, nor do pairs all along. */
static void test_a_few_pairs_are_chance(void)
{
    static const struct {
        int pairs, longer;
        size_t left;
    } CASE[] = {{2, 0, ROWS}, {2, 5, ROWS - 5}, {ROWS / 2, 0, ROWS / 2}};
    for (size_t c = 0; c < sizeof CASE / sizeof *CASE; ++c) {
        char *text = malloc(ROWS * 120);
        size_t at = (size_t)sprintf(text, "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\n");
        const int apart = ROWS / CASE[c].pairs;
        uint64_t seed = 7;
        double torque = 0.0;
        TEST_ASSERT_NOT_NULL(text);
        for (int k = 0; k < ROWS; ++k) {
            const double theta = 0.01 * k, fresh = 1.0 + 0.1 * ref_normal(&seed);
            if (k % apart != 1 && !(k > 700 && k <= 700 + CASE[c].longer)) torque = fresh;
            at += (size_t)sprintf(text + at, "%g,%.9g,%.12g,%.12g,%.12g,%.12g\n", 1e-3 * k, theta, sin(theta),
                                  sin(theta - 2.0943951), sin(theta + 2.0943951), torque);
        }
        read_text(text);
        free(text);
        TEST_ASSERT_EQUAL_UINT64(CASE[c].left, run.count);
    }
}

/* A torque that a sensor with the ends `least` and `most` measures; the angle waits `stand` rows from row
 * `from`. */
static void read_driven(double least, double most, int from, int stand)
{
    char *text = malloc(ROWS * 60);
    size_t at = (size_t)sprintf(text, "time_s,theta_m_rad,torque_Nm\n");
    uint64_t seed = 3;
    TEST_ASSERT_NOT_NULL(text);
    for (int k = 0; k < ROWS; ++k) {
        const int waited = k < from ? 0 : k - from < stand ? k - from : stand;
        const double theta = 0.02 * (k - waited), torque = 0.1 * sin(6.0 * theta) + 1e-3 * ref_normal(&seed);
        at += (size_t)sprintf(text + at, "%g,%.9g,%.6g\n", 1e-3 * k, theta, fmin(most, fmax(least, torque)));
    }
    read_text(text);
    free(text);
}

/* Its ends repeat, and nothing between: that is not a reading that is taken less often. */
static void test_a_clipped_torque_is_told(void)
{
    static const double END_NM[][2] = {{-0.05, 0.05}, {0.0, 1.0}, {-1.0, 0.09}, {-0.03, 0.0}};
    for (size_t c = 0; c < sizeof END_NM / sizeof *END_NM; ++c) {
        read_driven(END_NM[c][0], END_NM[c][1], 0, 0);
        text_has("the torque is clipped", run.remark.text);
        TEST_ASSERT_NULL(strstr(run.remark.text, "read less often"));
        TEST_ASSERT_TRUE(run.torque_is_clipped);
        for (size_t k = 0; k < run.count; ++k)
            TEST_ASSERT_TRUE(run.torque_Nm[k] > END_NM[c][0] && run.torque_Nm[k] < END_NM[c][1]);
    }
    read_driven(-1.0, 1.0, 0, 0);
    TEST_ASSERT_FALSE(run.torque_is_clipped);
    TEST_ASSERT_EQUAL_UINT64(ROWS, run.count);
    read_held(8, 0.0, 1);
    TEST_ASSERT_FALSE(run.torque_is_clipped);
}

/* Three currents of 1 A whose phases a and b end at `end`: by their sensors, or `limited` by the drive, so
 * that c takes what they do not. */
static void read_ended(double end, bool limited)
{
    char *text = malloc(ROWS * 90);
    size_t at = (size_t)sprintf(text, "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\n");
    uint64_t seed = 3;
    TEST_ASSERT_NOT_NULL(text);
    for (int k = 0; k < ROWS; ++k) {
        const double theta = 0.02 * k;
        const double a = sin(theta) + 1e-3 * ref_normal(&seed), b = sin(theta - 2.0943951);
        const double ends[] = {fmin(end, fmax(-end, a)), fmin(end, fmax(-end, b))};
        at += (size_t)sprintf(text + at, "%g,%.9g,%.6g,%.6g,%.6g,%.6g\n", 1e-3 * k, theta, ends[0], ends[1],
                              limited ? -ends[0] - ends[1] : sin(theta + 2.0943951), ref_normal(&seed));
    }
    read_text(text);
    free(text);
}

/* What the sensor of one phase does not show the two others do, where the sum says that it goes on. */
static void test_a_clipped_current_is_taken_from_the_others(void)
{
    read_ended(0.9, false);
    text_has("phase currents are clipped: in 7", run.remark.text);
    text_has("of 1200 rows one stands at -0.9 A or 0.9 A", run.remark.text);
    TEST_ASSERT_EQUAL_UINT64(ROWS, run.count);
    TEST_ASSERT_FALSE(run.is_clipped);
    for (size_t k = 0; k < run.count; ++k)
        for (size_t s = 0; s < 2; ++s)
            TEST_ASSERT_DOUBLE_WITHIN(6e-3, sin(run.theta_m_rad[k] - (double)s * 2.0943951),
                                      run.i_A[3 * k + s]);
    read_ended(0.9, true);
    TEST_ASSERT_NULL(strstr(run.remark.text, "phase currents are clipped"));
    text_has("the crests of the current are all of one value", run.remark.text);
    text_has("0.9 A of a phase in 180 of 1200 rows", run.remark.text);
    TEST_ASSERT_TRUE(run.is_clipped);
}

/* Of two at their ends neither is told. */
static void test_rows_of_two_clipped_currents_are_left_out(void)
{
    read_ended(0.6, false);
    text_has("rows in which two of them do are left out", run.remark.text);
    TEST_ASSERT_TRUE(run.count < ROWS - 100);
    for (size_t k = 0; k < run.count; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(6e-3, sin(run.theta_m_rad[k]), run.i_A[3 * k]);
}

/* At the beginning, in the middle or at the end of a turn. */
static void test_rows_of_a_shaft_that_stands_are_left_out(void)
{
    static const int FROM[] = {0, 500, 1000};
    for (size_t c = 0; c < sizeof FROM / sizeof *FROM; ++c) {
        read_driven(-1.0, 1.0, FROM[c], 200);
        TEST_ASSERT_INT_WITHIN(1, ROWS - 200, (int)run.count);
        text_has("of 1200 rows the angle stays", run.remark.text);
    }
    read_driven(-1.0, 1.0, 0, 20); /* an encoder may stay for so long */
    TEST_ASSERT_EQUAL_UINT64(ROWS, run.count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_row_with_a_hole_is_left_out_and_said);
    RUN_TEST(test_all_holes_make_one_remark);
    RUN_TEST(test_a_file_without_holes_says_nothing);
    RUN_TEST(test_a_file_that_was_cut_off);
    RUN_TEST(test_lines_that_are_there_twice);
    RUN_TEST(test_more_than_half_is_an_error);
    RUN_TEST(test_a_decimal_comma_among_commas_is_refused);
    RUN_TEST(test_a_text_in_the_first_row_is_refused);
    RUN_TEST(test_an_empty_column_that_is_not_needed_is_ignored);
    RUN_TEST(test_holes_in_columns_that_are_not_read_do_not_matter);
    RUN_TEST(test_temperatures_between_are_interpolated);
    RUN_TEST(test_no_derivative_across_a_hole);
    RUN_TEST(test_a_prediction_leaves_the_cells_of_a_hole_empty);
    RUN_TEST(test_a_torque_that_is_read_less_often);
    RUN_TEST(test_a_few_pairs_are_chance);
    RUN_TEST(test_currents_that_are_read_less_often);
    RUN_TEST(test_a_torque_without_ripple_stays);
    RUN_TEST(test_a_coarse_torque_stays);
    RUN_TEST(test_a_clipped_torque_is_told);
    RUN_TEST(test_a_clipped_current_is_taken_from_the_others);
    RUN_TEST(test_rows_of_two_clipped_currents_are_left_out);
    RUN_TEST(test_rows_of_a_shaft_that_stands_are_left_out);
    RUN_TEST(test_memory_runs_out_everywhere);
    return UNITY_END();
}
