/* The pages of report.html: read as XML, by their numbers, by their colours, and by where the pictures put
 * their marks; with names that try to break out; the same bytes twice; without memory. */
#include "host/report/page/page.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/diagnose/again.h"
#include "host/base/memory.h"
#include "host/draw/html.h"
#include "host/plot/plot.h"
#include "support/reference.h"
#include "support/texts.h"
#include "support/written.h"
#include "unity.h"

enum { MOST_BYTES = 400000, RUNS = 4, LINES = 6, TERMS = 20 };

#define HOSTILE "a<script>alert(\"1\")</script>&'b.csv"

static char *page;

static hci_run run[RUNS];
static char name[RUNS][64], list[] = "bench/<runs>.csv";
static hci_role role[RUNS];
static hci_runs runs;
static hci_run_errors error[RUNS];
static hci_residual_line line[LINES];
static hci_effect effect;
static hci_effect_term term[TERMS];
static hci_diagnosis diagnosis;

/* ---- a diagnosis by hand ---- */

static void make_runs(void)
{
    static const double BEFORE[RUNS] = {1.0, 0.1, 0.01, 0.5};
    for (size_t k = 0; k < RUNS; ++k) {
        snprintf(name[k], sizeof name[k], "runs/%zu.csv", k);
        run[k].name = name[k];
        role[k] = k == 3 ? HCI_ROLE_HOLDOUT : HCI_ROLE_FIT;
        error[k] = (hci_run_errors){.file = name[k],
                                    .role = role[k],
                                    .mean_torque_Nm = 1.0 / 3.0 + (double)k,
                                    .rms_before_Nm = BEFORE[k],
                                    .rms_after_Nm = 0.004,
                                    .after_low_Nm = 0.0035,
                                    .after_high_Nm = 0.0045,
                                    .noise_floor_Nm = 0.003};
    }
    runs = (hci_runs){.run = run, .role = role, .count = RUNS, .list = list};
}

static void make_terms(void)
{
    const hci_effect_type *type = hci_effect_type_find("cogging");
    effect = (hci_effect){.type = type, .term = term, .count = TERMS};
    for (size_t k = 0; k < TERMS; ++k)
        term[k] = (hci_effect_term){.parameter = k % 2,
                                    .order = (double)(k / 2 + 1),
                                    .value = 0.01 * (double)(k + 1),
                                    .std_error = 0.0003};
}

void setUp(void)
{
    files_begin();
    make_runs();
    make_terms();
    for (size_t k = 0; k < LINES; ++k)
        line[k] = (hci_residual_line){.run = k / 3,
                                      .order = 6.0 * (double)(k % 3),
                                      .before_Nm = 0.2 / (double)(k + 1),
                                      .after_Nm = 0.001,
                                      .noise_Nm = 0.0005};
    diagnosis = (hci_diagnosis){0};
    diagnosis.verdict = HCI_DIAGNOSIS_EXPLAINED;
    diagnosis.finding[0] = (hci_finding){.effect = "cogging",
                                         .verdict = HCI_FINDING_ADDED,
                                         .delta_bic = 12345.678,
                                         .residual_share = 0.9,
                                         .detail = "sine_6 = 0.1 Nm"};
    diagnosis.finding[1] = (hci_finding){
        .effect = "friction", .verdict = HCI_FINDING_REJECTED, .delta_bic = -2.5, .residual_share = NAN};
    diagnosis.findings = 2;
    diagnosis.effects.list = (hci_effects){.effect = &effect, .count = 1};
    diagnosis.run = error;
    diagnosis.runs = RUNS;
    diagnosis.line = line;
    diagnosis.lines = LINES;
    diagnosis.rms_before_Nm = 0.6;
    diagnosis.rms_after_Nm = 0.004;
    diagnosis.noise_Nm = 0.003;
    diagnosis.holdout_before_Nm = 0.5;
    diagnosis.holdout_after_Nm = 0.004;
    diagnosis.holdout_noise_Nm = 0.003;
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    setlocale(LC_ALL, "C");
    files_end();
}

/* ---- writing and reading ---- */

static hci_output *open_page(void)
{
    return written_begin("report.html");
}

static void read_page(hci_output *out)
{
    page = written_end(out, "report.html");
    TEST_ASSERT_TRUE(strlen(page) < MOST_BYTES);
}

static void write_diagnosis(const hci_resolution *resolution)
{
    hci_output *out = open_page();
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK, hci_page_diagnosis(out, &diagnosis, resolution, &runs, "data/<machine>", &note), note.text);
    read_page(out);
}

/* As a program reads it: all digits. */
static void check_number(double value)
{
    char text[64], exact[32];
    hci_number_text(value, exact);
    snprintf(text, sizeof text, "<data value=\"%s\">", exact);
    text_has(text, page);
}

/* ---- XML, and what a page must have ---- */

static void check_tags(void)
{
    char open[16][TEXT_TAG];
    int depth = 0, tags = 0;
    TEST_ASSERT_EQUAL_STRING_LEN("<!DOCTYPE html>\n<html lang=\"en\">\n", page, 33);
    for (const char *at = page + 15; *at;) {
        if (*at == '<') {
            at = text_tag(at, open, 16, &depth);
            ++tags;
        } else if (*at == '&') {
            TEST_ASSERT_EQUAL_INT('#', at[1]);
            TEST_ASSERT_EQUAL_INT(';', at[2 + strspn(at + 2, "0123456789")]);
            ++at;
        } else {
            TEST_ASSERT_TRUE_MESSAGE(*at != '>', "a bare >");
            TEST_ASSERT_TRUE((unsigned char)*at >= 0x20 || *at == '\n');
            ++at;
        }
    }
    TEST_ASSERT_EQUAL_INT(0, depth);
    TEST_ASSERT_TRUE(tags > 50);
}

/* Each picture is named and described by ids that are there once. */
static void check_pictures(size_t expected)
{
    size_t pictures = 0;
    for (const char *at = page; (at = strstr(at, "<svg ")); ++at, ++pictures) {
        char id[32], key[80];
        const char *label = strstr(at, "aria-labelledby=\"");
        TEST_ASSERT_EQUAL_INT(1, sscanf(label, "aria-labelledby=\"%31[a-z0-9-]", id));
        TEST_ASSERT_TRUE(strstr(at, "role=\"img\"") < strchr(at, '>'));
        snprintf(key, sizeof key, "<title id=\"%s\">", id);
        TEST_ASSERT_EQUAL_UINT64(1, text_count(key, page));
        id[strlen(id) - strlen("title")] = '\0';
        snprintf(key, sizeof key, "<desc id=\"%sdesc\">", id);
        TEST_ASSERT_EQUAL_UINT64(1, text_count(key, page));
        TEST_ASSERT_TRUE(strstr(strstr(at, key) + strlen(key), "</desc>") >
                         strstr(at, key) + strlen(key) + 20);
    }
    TEST_ASSERT_EQUAL_UINT64(expected, pictures);
}

/* Nothing comes from elsewhere, and nothing runs. */
static void check_alone(void)
{
    static const char *const NONE[] = {"<script", "<link",      "<img",        "<iframe",
                                       "<object", "src=",       "href=\"http", "url(",
                                       "@import", "@font-face", "onload",      "javascript:"};
    for (size_t k = 0; k < sizeof NONE / sizeof *NONE; ++k)
        text_lacks(NONE[k], page);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(1, text_count("href=", page), "a link other than that within the page");
    text_has("href=\"#evidence\"", page);
    TEST_ASSERT_EQUAL_UINT64(1, text_count("id=\"evidence\"", page));
    TEST_ASSERT_EQUAL_UINT64(text_count("xmlns=\"http://www.w3.org/2000/svg\"", page),
                             text_count("://", page));
}

static void check_page(size_t pictures)
{
    check_tags();
    text_tables_are_whole(page);
    check_pictures(pictures);
    check_alone();
    text_has("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>", page);
    text_has("@media screen and (prefers-color-scheme:dark)", page);
    text_has("@media print", page);
    TEST_ASSERT_EQUAL_UINT64(text_count("<table>", page),
                             text_count("<div class=\"table\" tabindex=\"0\" role=\"region\" ", page));
    TEST_ASSERT_EQUAL_UINT64(text_count("<figure>", page),
                             text_count(" Numbers: ", page)); /* the source of each */
    TEST_ASSERT_EQUAL_UINT64(text_count("<figure>", page), text_count(". Made from: ", page));
}

/* ---- the diagnosis ---- */

static void test_diagnosis(void)
{
    char words[2048];
    write_diagnosis(NULL);
    check_page(2 * 4); /* each for a screen and for a telephone */
    hci_diagnosis_words(&diagnosis, words, sizeof words);
    text_has(strstr(words, "On the runs"), page); /* what stands before it is the heading */
    text_lacks("<p class=\"lead\">The model lacked", page);
    text_has("badge good\">Explained</span> <span class=\"topic\">Diagnosis of a machine model · "
             "data/&#60;machine&#62;</span></p>",
             page);
    text_has("<h1>The model lacked cogging torque</h1>", page);
    text_has("Looked for and not needed: friction.", page);
    text_has("<td>0.5 N·m</td><td>0.004 N·m</td><td>0.003 N·m</td>", page);
    text_has("What is left of the fitted runs, 0.004 N·m, is about their noise in sum; single orders stand "
             "out of it.",
             page);
    text_has("<h2>The largest order that is left, 0, has 0.001 N·m; before, the largest had 0.2 N·m</h2>",
             page);
    text_has("<h2>Most is left at order 0 in 0.csv</h2>", page);
    text_has("Machine: data/&#60;machine&#62;", page);
    text_has("List of runs: bench/&#60;runs&#62;.csv", page);
    text_has("Made from: data/&#60;machine&#62;, bench/&#60;runs&#62;.csv.", page);
    for (size_t k = 0; k < RUNS; ++k) {
        text_has(name[k], page);
        check_number(error[k].mean_torque_Nm);
        check_number(error[k].rms_before_Nm);
    }
    check_number(error[0].rms_after_Nm);
    check_number(error[0].noise_floor_Nm);
    check_number(error[0].after_low_Nm);
    check_number(error[0].after_high_Nm);
    check_number(diagnosis.finding[0].delta_bic);
    check_number(diagnosis.finding[1].delta_bic);
    check_number(sqrt(diagnosis.finding[0].residual_share) * diagnosis.rms_before_Nm);
    check_number(term[TERMS - 1].value);
    check_number(term[TERMS - 1].std_error);
    text_lacks("Index slips", page);
    text_lacks("What to measure next", page);
}

/* A diagnosis that goes on: the new recordings against what was promised of them, and what became of the
 * effects. */
static void test_new_recordings(void)
{
    static const char RUNS_TABLE[] =
        "<caption>New recordings: rms of measured less modelled torque</caption>",
                      EFFECTS[] = "<caption>Effects of the last machine and of this one</caption>";
    hci_again_run fresh[2] = {{.file = "runs/8.csv",
                               .declared_Nm = 0.5,
                               .last_Nm = 0.03,
                               .now_Nm = 0.01,
                               .noise_Nm = 0.005,
                               .bound_Nm = 0.02,
                               .kept = false},
                              {.file = "runs/9.csv",
                               .declared_Nm = 0.4,
                               .last_Nm = 0.015,
                               .now_Nm = 0.012,
                               .noise_Nm = 0.006,
                               .bound_Nm = 0.025,
                               .kept = true}};
    hci_again again = {.run = fresh,
                       .runs = 2,
                       .bounded = 2,
                       .kept = 1,
                       .effect = {{.effect = "cogging", .change = HCI_AGAIN_CHANGED, .deviations = 3.5},
                                  {.effect = "friction", .change = HCI_AGAIN_CAME, .deviations = NAN}},
                       .effects = 2,
                       .recordings_before = 2};
    snprintf(again.effect[0].words, sizeof again.effect[0].words, "0.1, then 0.2");
    diagnosis.again = &again;
    write_diagnosis(NULL);
    check_page(2 * 4);
    TEST_ASSERT_EQUAL_STRING("runs/8.csv 0.5 0.03 0.02 no 0.01 0.005 ", text_row(page, RUNS_TABLE, 0));
    TEST_ASSERT_EQUAL_STRING("runs/9.csv 0.4 0.015 0.025 yes 0.012 0.006 ", text_row(page, RUNS_TABLE, 1));
    TEST_ASSERT_EQUAL_INT(2, text_rows(page, RUNS_TABLE));
    TEST_ASSERT_EQUAL_STRING("cogging torque changed 3.5 0.1, then 0.2 ", text_row(page, EFFECTS, 0));
    TEST_ASSERT_EQUAL_STRING("friction came –  ", text_row(page, EFFECTS, 1));
    again.bounded = 0;
    fresh[0].bound_Nm = fresh[1].bound_Nm = NAN;
    again.effects = 0;
    write_diagnosis(NULL);
    TEST_ASSERT_EQUAL_STRING("runs/8.csv 0.5 0.03 – – 0.01 0.005 ", text_row(page, RUNS_TABLE, 0));
    text_lacks(EFFECTS, page);
    again.runs = 0;
    write_diagnosis(NULL);
    text_has("What the new recordings say of the last diagnosis", page);
    text_lacks(RUNS_TABLE, page);
}

/* What is left above the noise is told so; that nothing known explains it only of a search that was finished.
 */
static void test_what_is_left_above_the_noise(void)
{
    diagnosis.rms_after_Nm = 0.03;
    diagnosis.holdout_after_Nm = diagnosis.holdout_before_Nm;
    write_diagnosis(NULL);
    text_has(
        "What is left of the fitted runs, 0.03 N·m, is 10 times their noise, and 0.9 % of their largest mean "
        "torque: an error of the model, not chance. No effect that this program knows",
        page);
    text_has("On the runs that were held out the error stays 0.5 N·m", page);
    diagnosis.search = HCI_WORK_LIMITED;
    write_diagnosis(NULL);
    text_has("an error of the model, not chance.</p>", page);
}

/* Lines 0 … 2 are run 0's, 3 … 5 run 1's, at orders 0, 6, 12: the larger one stands. */
static void test_largest_of_each_order(void)
{
    line[4].after_Nm = 0.09;
    line[4].noise_Nm = 0.0007;
    write_diagnosis(NULL);
    text_has(
        "<tr><td><data value=\"6\">6</data></td><td><data value=\"0.1\">0.1</data></td><td class=\"text\">"
        "runs/0.csv</td><td><data value=\"0.09\">0.09</data></td><td class=\"text\">runs/1.csv</td><td>"
        "<data value=\"0.0007\">0.0007</data></td></tr>",
        page);
    char *table = strstr(page, "<caption>The largest 3 of 3 orders"), *end = strstr(table, "</table>");
    *end = '\0';
    TEST_ASSERT_NULL(strstr(table, "<data value=\"0.04\">")); /* order 6 of run 1 before, the smaller one */
}

/* Of six amplitudes that are listed, of 120, chance makes one of 1.61 times the noise once in twenty times:
 * sqrt(1 + ln 120 / ln 20). */
static void test_chance_is_no_order(void)
{
    for (size_t k = 0; k < LINES; ++k)
        line[k].after_Nm = 1.6 * line[k].noise_Nm;
    write_diagnosis(NULL);
    text_has("What is left of the fitted runs, 0.004 N·m, is about their noise.", page);
    text_has("<h2>What is left is noise at each order; before, the largest had 0.2 N·m</h2>", page);
    text_has("<h2>In no recording is more left than noise</h2>", page);
    line[2].after_Nm = 1.63 * line[2].noise_Nm;
    write_diagnosis(NULL);
    text_has("<h2>Most is left at order 12 in 0.csv</h2>", page);
}

static void test_other_verdicts(void)
{
    static const char *const SAID[] = {"Nothing is missing", "Explained", "Ambiguous", "Partly explained",
                                       "Not explained"};
    for (int k = 0; k < 5; ++k) {
        diagnosis.verdict = (hci_diagnosis_verdict)k;
        diagnosis.lines = k == 0 ? 0 : LINES;
        diagnosis.effects.list.count = k == 0 ? 0 : 1;
        write_diagnosis(NULL);
        check_page(k == 0 ? 2 * 2 : 2 * 4);
        text_has(SAID[k], page);
        text_has(k < 2 ? "badge good" : "badge bad", page);
    }
}

static void test_what_is_seldom(void)
{
    hci_resolution resolution;
    memset(&resolution, 0, sizeof resolution);
    resolution.old_currents.T_ripple_percent = 12.75;
    resolution.new_currents.T_ripple_percent = NAN;
    error[1].slip_rad = 2.0 * REF_PI / 3.0;
    snprintf(diagnosis.advice, sizeof diagnosis.advice, "a run at 3 A & 100 rpm");
    diagnosis.unexplained[0] = (hci_unexplained){.order = 7.5,
                                                 .sine_Nm = 0.01,
                                                 .cosine_Nm = 0.02,
                                                 .current_exponent = 0.5,
                                                 .speed_exponent = 1.0,
                                                 .turns_sign = true,
                                                 .amplitude_Nm = 0.0625};
    diagnosis.unexplained_count = 1;
    diagnosis.holdout_after_Nm = NAN;
    write_diagnosis(&resolution);
    check_page(2 * 4);
    text_has("a run at 3 A &#38; 100 rpm", page);
    text_has("Index slips", page);
    text_has(">120</data>", page);
    check_number(0.0625);
    check_number(12.75);
    text_lacks("held out the error", page);
}

static void test_hostile_names(void)
{
    snprintf(name[0], sizeof name[0], "%s", HOSTILE);
    snprintf(name[1], sizeof name[1],
             "\xff\x01\xed\xa0\x80Gr\xc3\xb6\xc3\x9f"
             "e\xc3");
    write_diagnosis(NULL);
    check_page(2 * 4);
    text_has("a&#60;script&#62;alert(&#34;1&#34;)&#60;/script&#62;&#38;'b.csv", page);
    text_has("Größe", page);
    text_lacks("\xff", page);
    text_lacks("\x01", page);
}

static void test_no_run_and_no_finding(void)
{
    diagnosis.runs = diagnosis.lines = diagnosis.findings = 0;
    write_diagnosis(NULL);
    check_page(2 * 1);
}

/* 0 and what is not finite have no place on a logarithmic axis. */
static void test_odd_numbers(void)
{
    error[0].rms_after_Nm = error[1].noise_floor_Nm = 0.0;
    error[2].noise_floor_Nm = NAN;
    line[0].after_Nm = 0.0;
    line[1].noise_Nm = NAN;
    term[0].std_error = NAN;
    term[1].value = 0.0;
    diagnosis.finding[0].delta_bic = 1e300;
    write_diagnosis(NULL);
    check_page(2 * 4);
    text_lacks("nan", page);
    text_lacks("inf\"", page);
}

static void test_same_bytes(void)
{
    write_diagnosis(NULL);
    const char *const first = page; /* files_read keeps it */
    setlocale(LC_ALL, "de_DE.UTF-8");
    write_diagnosis(NULL);
    const char *said = strstr(page, "<h2>"); /* words before it are the diagnosis' own */
    TEST_ASSERT_EQUAL_STRING(strstr(first, "<h2>"), said);
}

static void test_no_memory(void)
{
    for (long k = 0; k < 2; ++k) {
        hci_output *out = open_page();
        hci_note note = {{0}};
        hci_memory_fail_after(k);
        TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY,
                          hci_page_diagnosis(out, &diagnosis, NULL, &runs, "machine", &note));
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(note.text[0] != '\0');
        hci_output_discard(out);
    }
}

/* ---- where the marks are ---- */

static double number_after(const char *at, const char *key)
{
    at = strstr(at, key);
    TEST_ASSERT_NOT_NULL(at);
    return atof(at + strlen(key));
}

static const hci_svg_box BOX = {58.0, 40.0, 700.0, 300.0};

/* An effect alone explains √0.9 of an error of 0.6 N·m, between that and the 0.004 N·m that are left. */
static void test_marks_of_findings(void)
{
    hci_output *out = open_page();
    hci_plot_findings(out, &BOX, &diagnosis);
    read_page(out);
    const double own_Nm = sqrt(0.9) * 0.6;
    const char *level = strstr(page, "<title>error before: 0.6 N·m</title>");
    const double before = number_after(level, "d=\"M"),
                 after = number_after(strstr(page, "<title>error after: 0.004 N·m</title>"), "d=\"M");
    const double dot =
        number_after(strstr(page, "<title>cogging torque: by it alone 0.5692 N·m, added</title>"), "cx=\"");
    TEST_ASSERT_DOUBLE_WITHIN(0.05, (dot - after) / (before - after), log(own_Nm / 0.004) / log(0.6 / 0.004));
    text_lacks("friction", page);
    text_lacks("by it or another", page);
}

/* Errors of 1, 0.1 and 0.01 N·m lie one decade apart, in rows one below the other. */
static void test_marks_of_runs(void)
{
    double x[3], y[3];
    hci_output *out = open_page();
    hci_plot_runs(out, &BOX, &diagnosis);
    read_page(out);
    TEST_ASSERT_EQUAL_UINT64(3 + 1, text_count("<circle class=\"dot\"", page)); /* and the legend */
    TEST_ASSERT_EQUAL_UINT64(1 + 1, text_count("<circle class=\"hollow\"", page));
    const char *at = strstr(page, ">Fitted<");
    for (size_t k = 0; k < 3; ++k) {
        at = strstr(at + 1, "<circle class=\"before\"");
        x[k] = number_after(at, "cx=\"");
        y[k] = number_after(at, "cy=\"");
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.02, x[0] - x[1], x[1] - x[2]);
    TEST_ASSERT_TRUE(x[0] - x[1] > 40.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, y[1] - y[0], y[2] - y[1]);
    TEST_ASSERT_TRUE(y[1] > y[0]);
    /* 0.004 N·m by the decade */
    TEST_ASSERT_DOUBLE_WITHIN(0.05, x[2] + (x[0] - x[1]) * log10(0.004 / 0.01),
                              number_after(strstr(page, ">Fitted<"), "class=\"dot\" cx=\""));
}

static double weight_of(const void *context, size_t k)
{
    return ((const double *)context)[k];
}

static void test_largest(void)
{
    uint64_t state = 5;
    for (int trial = 0; trial < 200; ++trial) {
        double value[30];
        size_t place[8], above = 0;
        const size_t n = 1 + (size_t)ref_uniform(&state, 0.0, 29.0);
        for (size_t k = 0; k < n; ++k)
            value[k] = ref_uniform(&state, -0.5, 1.0);
        const size_t count = hci_plot_largest(weight_of, value, n, 8, place);
        double least = HUGE_VAL;
        for (size_t k = 0; k < count; ++k) {
            TEST_ASSERT_TRUE(k == 0 || place[k] > place[k - 1]);
            least = fmin(least, value[place[k]]);
        }
        for (size_t k = 0; k < n; ++k)
            above += value[k] > 0.0 && value[k] >= least;
        size_t positive = 0;
        for (size_t k = 0; k < n; ++k)
            positive += value[k] > 0.0;
        TEST_ASSERT_EQUAL_UINT64(positive < 8 ? positive : 8, count);
        TEST_ASSERT_EQUAL_UINT64(count, above);
    }
}

/* A peak of one sample among a hundred thousand is not lost. */
static void test_traces_keep_peaks(void)
{
    static hci_traces traces;
    hci_traces_begin(&traces, 1.0, 2.0);
    for (int k = 0; k <= 150000; ++k) {
        const double time_s = 0.75 + 1e-5 * k;
        double value[HCI_TRACES] = {sin(2.0 * REF_PI * time_s), time_s, 0.0, 0.0, 0.0};
        if (k == 70000) value[0] = 9.0;
        if (k == 3) value[0] = 99.0; /* before it begins */
        hci_traces_add(&traces, time_s, 0.0, value);
    }
    const hci_range torque = hci_traces_range(&traces, HCI_TRACE_TORQUE_NM, 1.0, 2.0);
    TEST_ASSERT_EQUAL_DOUBLE(9.0, torque.high);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, -1.0, torque.low);
    const hci_range half = hci_traces_range(&traces, HCI_TRACE_SPEED_RPM, 1.0, 1.5);
    TEST_ASSERT_DOUBLE_WITHIN(1.0 / 720.0, 1.0, half.low);
    TEST_ASSERT_DOUBLE_WITHIN(1.0 / 720.0, 1.5, half.high);
}

/* ---- numbers ---- */

static void test_digits(void)
{
    static const struct {
        double value;
        const char *shown;
    } CASE[] = {
        {0.0, ">0<"},
        {1.0 / 3.0, ">0.3333<"},
        {-2.34567e-9, ">−2.346e−9<"},
        {123456.0, ">123500<"},
        {0.00099996, ">0.001<"},
        {99999.0, ">100000<"},
        {7.666467083416871e-20, ">7.666e−20<"},
        {-1.23456e-300, ">−1.235e−300<"},
        {4.94e-324, ">5e−324<"},
        {9.87654321e200, ">9.877e200<"},
        {NAN, "<td>–</td>"},
        {HUGE_VAL, "<td>–</td>"},
    };
    hci_output *out = open_page();
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k)
        hci_html_number(out, CASE[k].value);
    read_page(out);
    const char *at = page;
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        at = strstr(at, CASE[k].shown);
        TEST_ASSERT_NOT_NULL_MESSAGE(at, CASE[k].shown);
        ++at;
    }
}

/* What is below the least is rounding; the number itself is there for programs. */
static void test_digits_above(void)
{
    hci_output *out = open_page();
    hci_html_number_above(out, -7.666467083416871e-20, 1e-9);
    hci_html_number_above(out, 1.00004e-9, 1e-9);
    hci_html_number_above(out, NAN, 1e-9);
    hci_html_number_above(out, 0.25, 0.0);
    read_page(out);
    text_has("<data value=\"-7.666467083416871e-20\">0</data>", page);
    text_has(">1e−9<", page);
    text_has("<td>–</td>", page);
    text_has(">0.25<", page);
}

/* A column of 80.001 … 80.004 tells its values apart; one of 0.2 … 80 has four digits. */
static void test_digits_in_a_column(void)
{
    hci_output *out = open_page();
    hci_html_number_in(out, 80.001234, 0.003);
    hci_html_number_in(out, 80.001234, 80.0);
    hci_html_number_in(out, 0.2000004, 80.0);
    hci_html_number_in(out, 5.0, 0.0);
    hci_html_number_in(out, NAN, 1.0);
    read_page(out);
    text_has(">80.001234<", page);
    text_has(">80<", page);
    text_has(">0.2<", page);
    text_has(">5<", page);
    text_has("<td>–</td>", page);
}

/* A fall of 0 of what was rejected was not looked for; a rejected one with a fall, and an added one, have it.
 */
static void test_what_was_not_computed(void)
{
    diagnosis.finding[1].delta_bic = 0.0;
    write_diagnosis(NULL);
    text_has("friction</td><td class=\"text\">rejected</td><td>–</td>", page);
    diagnosis.finding[1].verdict = HCI_FINDING_AMBIGUOUS;
    write_diagnosis(NULL);
    text_has("friction</td><td class=\"text\">ambiguous</td><td><data value=\"0\">0</data></td>", page);
}

/* Sine and cosine of an order are one amplitude, the largest four stand first, and effects have the names
 * that people use. */
static void test_values_are_in_words(void)
{
    write_diagnosis(NULL);
    text_has("<td class=\"text\">cogging torque</td><td class=\"text\">added</td>", page);
    text_has("order 9 = 0.2476 ± 0.0003 N·m; order 8 = 0.2193 ± 0.0003 N·m", page);
    text_has("and 6 more in effects.csv", page);
    text_lacks("sine_9 = ", page);
}

/* Of an inductance the mean has its sign, an order n makes n times the torque, and what is in the place of
 * another effect has its name and no value of the machine. */
static void test_inductances_in_words(void)
{
    const hci_effect_type *type = hci_effect_type_find("reluctance");
    hci_effect_term value[] = {{.parameter = 4, .order = 6.0, .value = 3e-6, .std_error = 1e-7},
                               {.parameter = 1, .order = 0.0, .value = -2e-3, .std_error = 1e-5},
                               {.parameter = 5, .order = 6.0, .value = -4e-6, .std_error = 2e-7},
                               {.parameter = 3, .order = 0.0, .value = 1e-5, .std_error = 1e-6},
                               {.parameter = 5, .order = 12.0, .value = 1e-6, .std_error = 1e-7},
                               {.parameter = 5, .order = 18.0, .value = 1e-7, .std_error = 1e-7}};
    hci_effect found = {.type = type, .term = value, .count = sizeof value / sizeof *value};
    char text[HCI_DETAIL_SIZE];
    diagnosis.effects.list = (hci_effects){.effect = &found, .count = 1};
    diagnosis.finding[0].effect = "reluctance";
    hci_finding_words(&diagnosis, &diagnosis.finding[0], text, sizeof text);
    TEST_ASSERT_EQUAL_STRING("mean, L_dd = -0.002 ± 1e-05 H; order 6, L_qq = 5e-06 ± 2e-07 H; "
                             "order 12, L_qq = 1e-06 ± 1e-07 H; mean, L_dq = 1e-05 ± 1e-06 H; "
                             "and 1 more in effects.csv",
                             text);
    diagnosis.finding[1] = (hci_finding){.effect = "saturation",
                                         .verdict = HCI_FINDING_AMBIGUOUS,
                                         .detail = "in place of back_emf: d1q2_cosine_0 = 1 ± 0.1 Nm"};
    hci_finding_words(&diagnosis, &diagnosis.finding[1], text, sizeof text);
    TEST_ASSERT_EQUAL_STRING("in place of back-EMF; values in effects.csv", text);
}

/* ---- colours ---- */

/* Relative luminance of #rrggbb or #rgb, WCAG 2. */
static double luminance(const char *hex)
{
    static const double SHARE[] = {0.2126, 0.7152, 0.0722};
    const bool is_short = strspn(hex, "0123456789abcdef") == 3;
    double sum = 0.0;
    for (size_t k = 0; k < 3; ++k) {
        const char digits[] = {is_short ? hex[k] : hex[2 * k], is_short ? hex[k] : hex[2 * k + 1], '\0'};
        const double c = (double)strtol(digits, NULL, 16) / 255.0;
        sum += SHARE[k] * (c <= 0.03928 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4));
    }
    return sum;
}

static double colour_after(const char *at, const char *key)
{
    at = strstr(at, key);
    TEST_ASSERT_NOT_NULL_MESSAGE(at, key);
    return luminance(at + strlen(key));
}

static double contrast(double a, double b)
{
    return (fmax(a, b) + 0.05) / (fmin(a, b) + 0.05);
}

static void test_contrast(void)
{
    static const char *const TEXT[] = {"--ink:#",          "--quiet:#",          "--good:#",       "--bad:#",
                                       ".hci text{fill:#", ".hci .quiet{fill:#", ".hci .no{fill:#"};
    static const char *const GROUND[] = {"--ground:#", "--panel:#", ".hci .back{fill:#"};
    write_diagnosis(NULL);
    for (int dark = 0; dark < 2; ++dark)
        for (size_t j = 0; j < sizeof TEXT / sizeof *TEXT; ++j)
            for (size_t k = 0; k < sizeof GROUND / sizeof *GROUND; ++k) {
                const char *text = page, *ground = page;
                for (int skip = 0; skip < dark; ++skip) {
                    text = strstr(text, TEXT[j]) + 1;
                    ground = strstr(ground, GROUND[k]) + 1;
                }
                const double found = contrast(colour_after(text, TEXT[j]), colour_after(ground, GROUND[k]));
                TEST_ASSERT_TRUE_MESSAGE(found >= 4.5, TEXT[j]);
            }
}

/* ---- solution and simulation ---- */

static void test_solution(void)
{
    hci_wave wave[] = {hci_wave_polar(1.0, 1, 10.0, 0.4), hci_wave_polar(5.0, -1, 2.0, 1.0)};
    hci_set set[2] = {0};
    hci_solution s;
    hci_solved_order order[2];
    const hci_report_sources sources = {.machine = "m", .target = HOSTILE};
    memset(&s, 0, sizeof s);
    memset(order, 0, sizeof order);
    order[0].target_Nm = order[0].torque_Nm = order[0].before_Nm = hci_harmonic_polar(0.0, 2.1, REF_PI / 2.0);
    order[1].target_Nm = hci_harmonic_polar(6.0, 0.0, 0.0);
    order[1].torque_Nm = hci_harmonic_polar(6.0, 0.3125, 1.0);
    order[1].before_Nm = hci_harmonic_polar(6.0, 0.5, 1.0);
    order[1].error_Nm = 0.3125;
    order[1].verdict = HCI_ORDER_MISSED;
    s.current = (hci_currents){.wave = wave, .set = set, .count = 2};
    s.order = order;
    s.order_count = 2;
    s.period_turns = 1;
    s.worst_error_Nm = 0.3125;
    s.worst_order = 6.0;
    s.plain = hci_wave_polar(1.0, 1, 10.0, 0.0);
    s.plain_amplitude_A = 10.0;
    s.peak_phase_current_A = 11.5;
    s.tolerance_Nm = 1e-6;
    s.within_limits = true;
    s.expected.state = HCI_RIPPLE_NO_RECORDINGS;
    s.loss_to_plain = s.loss_to_limit = s.peak_line_voltage_V = s.torque_at_limit_Nm = NAN;
    hci_output *out = open_page();
    hci_page_solution(out, &s, HCI_NOT_REACHED, &sources);
    read_page(out);
    check_page(2 * 4); /* each for a screen and for a telephone */
    text_has(
        "badge bad\">Not reached</span> <span class=\"topic\">Currents for a wanted torque · m</span></p>",
        page);
    text_has("<h1>2.1 N·m, with 0.625 N·m of ripple from peak to peak</h1>", page);
    text_has("<td>1 N·m<small>47.6 % of the mean</small>\n</td><td>0.625 N·m<small>29.8 % of the "
             "mean</small>\n</td>"
             "<td><small>not known</small>\n</td>",
             page);
    text_has("<td>10 A</td><td>11.5 A</td>", page);
    text_has("1 of 2 orders of the torque is not as wanted; the furthest, 6, is off by 0.3125 N·m", page);
    TEST_ASSERT_EQUAL_UINT64(2, text_count("<title>order 6: before 0.5 N·m, wanted 0 N·m, after 0.3125 N·m; "
                                           "missed</title>",
                                           page));
    text_lacks("The limits", page);
    text_has("Wanted torque: a&#60;script&#62;", page);
    text_has(hci_order_verdict_name(HCI_ORDER_MISSED), page);
    check_number(hci_amplitude(order[1].torque_Nm.sine, order[1].torque_Nm.cosine));
    check_number(hci_amplitude(wave[1].sine, wave[1].cosine));
    check_number(order[1].error_Nm);
}

/* A limit of 20 A of which 15 are used, and one that is exceeded, with the torque that is lost. */
static void test_solution_within_limits(void)
{
    hci_wave wave[] = {hci_wave_polar(1.0, 1, 15.0, 0.0)};
    hci_set set[1] = {0};
    hci_solved_order order[1];
    hci_solution s;
    memset(&s, 0, sizeof s);
    memset(order, 0, sizeof order);
    order[0].target_Nm = hci_harmonic_polar(0.0, 3.0, REF_PI / 2.0);
    order[0].torque_Nm = order[0].before_Nm = hci_harmonic_polar(0.0, 2.0, REF_PI / 2.0);
    order[0].verdict = HCI_ORDER_MISSED;
    order[0].error_Nm = s.worst_error_Nm = 1.0;
    s.current = (hci_currents){.wave = wave, .set = set, .count = 1};
    s.order = order;
    s.order_count = s.period_turns = 1;
    s.tolerance_Nm = 1e-6;
    s.plain = wave[0];
    s.plain_amplitude_A = s.peak_phase_current_A = 15.0;
    s.loss_to_plain = 1.0;
    s.loss_to_limit = s.torque_at_limit_Nm = NAN;
    s.peak_line_voltage_V = 48.0;
    s.limit[0] = (hci_limit){.kind = HCI_LIMIT_CURRENT, .phase = -1, .limit = 20.0, .value = 15.0};
    s.limit[1] =
        (hci_limit){.kind = HCI_LIMIT_VOLTAGE, .phase = -1, .limit = 40.0, .value = 48.0, .binds = true};
    s.limit_count = 2;
    s.limit_cost = HCI_COST_LIMITS;
    hci_output *out = open_page();
    hci_page_solution(out, &s, HCI_NOT_REACHED, &(hci_report_sources){.machine = "m", .target = "t"});
    read_page(out);
    check_page(2 * 5);
    text_has("<h1>2 N·m on average, where 3 N·m was asked for</h1>", page);
    text_has("<h2>No current keeps the limits: this one exceeds all of them by the same share</h2>", page);
    text_has("<td>–</td><td>48 V</td>", page);
    const char *used = strstr(page, "<title>phase current: 15 A of 20 A</title>\n<rect class=\"after\" "),
               *over = strstr(page, "<title>line voltage: 48 V of 40 V</title>\n<rect class=\"over\" ");
    TEST_ASSERT_TRUE(used && over);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.75 / 1.2,
                              number_after(used, " width=\"") / number_after(over, " width=\""));
}

static void test_simulation(void)
{
    static hci_traces traces;
    hci_harmonic spectrum[] = {{0.0, 0.0, 2.5}, {1.0, 0.25, 0.0}, {2.0, 0.0, 0.125}};
    const hci_report_sources sources = {.machine = "m", .scenario = HOSTILE};
    hci_simulation s;
    hci_note note = {{0}};
    memset(&s, 0, sizeof s);
    s.to_s = 1.0;
    s.energy_balances = true;
    s.torque_Nm = (hci_statistics){.mean = 2.5, .rms = 2.51, .most = 2.75, .least = 2.125};
    s.T_ripple_percent = 25.0;
    s.F_ripple_percent = 7.0;
    s.energy_J.electrical = NAN;
    s.spectrum_Nm = spectrum;
    hci_traces_begin(&traces, 0.0, 1.0);
    for (int periods = 0; periods < 2; ++periods) {
        s.periods = (size_t)periods;
        s.spectrum_count = periods ? 3 : 0;
        hci_output *out = open_page();
        TEST_ASSERT_EQUAL(HCI_OK, hci_page_simulation(out, &s, &traces, &sources, &note));
        read_page(out);
        check_page(periods ? 2 * 5 : 2 * 2);
        check_number(2.125);
    }
    check_number(0.25);
    check_number(100.0 * 0.125 / 2.5);
    text_has("Scenario: a&#60;script&#62;", page);
}

/* A plain sine with 2.5 + 0.75 cos 2θ + 0.125 sin(θ/2) N·m, over two turns: its mean over a step is that of
 * the two turns, since sin(θ/2) falls out; its extremes are not. */
static hci_simulation simulation_with_before(void)
{
    static hci_harmonic spectrum[] = {{0.0, 0.0, 2.5}, {0.5, 0.0, 0.0}, {1.0, 0.25, 0.0}, {2.0, 0.0, 1e-17}};
    static hci_harmonic plain[] = {{0.0, 0.0, 2.5}, {0.5, 0.125, 0.0}, {2.0, 0.0, 0.75}};
    hci_simulation s;
    memset(&s, 0, sizeof s);
    s.to_s = 1.0;
    s.periods = s.plain.period_turns = 2;
    s.energy_balances = true;
    s.torque_Nm = (hci_statistics){.mean = 2.5, .rms = 2.51, .most = 2.75, .least = 2.25};
    s.T_ripple_percent = 20.0;
    s.F_ripple_percent = 7.0;
    s.plain_amplitude_A = 3.5;
    s.spectrum_Nm = spectrum;
    s.spectrum_count = 4;
    s.plain.torque_Nm = plain;
    s.plain.order_count = 3;
    s.plain.peak_to_peak_Nm = 1.625;
    s.plain.T_ripple_percent = 65.0;
    s.plain.F_ripple_percent = 21.5;
    return s;
}

/* About 3°, from 0° to 6°: the least at the last of four samples in a degree, the most where −1.5 sin 2θ +
 * 0.0625 cos(θ/2) vanishes. */
static void check_turn_before(void)
{
    const double last_rad = 5.875 * REF_PI / 180.0, most_rad = 1.125 * REF_PI / 180.0;
    const char *told = strstr(page, "<title>3°; before from ");
    TEST_ASSERT_NOT_NULL(told);
    TEST_ASSERT_DOUBLE_WITHIN(5e-4, 2.5 + 0.75 * cos(2.0 * last_rad) - 0.125 * sin(0.5 * last_rad),
                              number_after(told, "; before from "));
    TEST_ASSERT_DOUBLE_WITHIN(5e-4, 2.5 + 0.75 * cos(2.0 * most_rad) + 0.125 * sin(0.5 * most_rad),
                              number_after(told, " N·m to "));
}

/* Order, before, after: the first is rounding. */
static void check_orders_before(void)
{
    text_has("<tr><td><data value=\"2\">2</data></td><td><data value=\"0.75\">0.75</data></td><td>"
             "<data value=\"1e-17\">0</data></td>",
             page);
    text_has("<tr><td><data value=\"1\">1</data></td><td><data value=\"0\">0</data></td><td>"
             "<data value=\"0.25\">0.25</data></td>",
             page);
}

static void test_simulation_with_before(void)
{
    static hci_traces traces;
    const hci_report_sources sources = {.machine = "m", .scenario = "s", .currents = "c"};
    hci_simulation s = simulation_with_before();
    hci_note note = {{0}};
    hci_traces_begin(&traces, 0.0, 1.0);
    for (int imposed = 0; imposed < 2; ++imposed) {
        s.imposed = imposed;
        hci_output *out = open_page();
        TEST_ASSERT_EQUAL(HCI_OK, hci_page_simulation(out, &s, &traces, &sources, &note));
        read_page(out);
        check_page(2 * 5);
        text_has("<th scope=\"row\">Torque ripple, peak to peak</th><td>1.625 N·m</td><td>0.5 N·m</td>",
                 page);
        text_has("<th scope=\"row\">T_ripple, peak to peak to mean</th><td>65 %</td><td>20 %</td>", page);
        text_has("<th scope=\"row\">F_ripple, rms to mean</th><td>21.5 %</td><td>7 %</td>", page);
        text_has("Before: the plain sine of 3.5 A in phase with the back-EMF", page);
        check_orders_before();
        TEST_ASSERT_EQUAL_INT(!imposed, strstr(page, "A strategy asks for a constant torque") != NULL);
        TEST_ASSERT_EQUAL_INT(imposed, strstr(page, "some of these orders may be wanted") != NULL);
        TEST_ASSERT_EQUAL_UINT64(4, text_count(">before</text>", page)); /* two pictures, twice */
        check_turn_before();
    }
}

/* From eight orders on their median is the floor: that of 0.1 … 0.8 N·m is 0.5; none of rounding. */
static void test_simulation_floor(void)
{
    static hci_traces traces;
    static const double SIZE[] = {0.3, 0.8, 0.1, 0.5, 0.7, 0.2, 0.6, 0.4};
    const hci_report_sources sources = {.machine = "m", .scenario = "s"};
    hci_harmonic spectrum[9] = {{0.0, 0.0, 2.5}};
    hci_note note = {{0}};
    hci_traces_begin(&traces, 0.0, 1.0);
    for (int k = 0; k < 8; ++k)
        spectrum[k + 1] = hci_harmonic_polar(k + 1.0, SIZE[k], 0.3 * k);
    for (int n = 0; n < 3; ++n) {
        hci_simulation s = simulation_with_before();
        s.plain.order_count = 0;
        s.spectrum_Nm = spectrum;
        s.spectrum_count = n == 0 ? 8 : 9;
        for (int k = 2; k < 9 && n == 2; ++k)
            spectrum[k].sine = spectrum[k].cosine = 1e-17;
        hci_output *out = open_page();
        TEST_ASSERT_EQUAL(HCI_OK, hci_page_simulation(out, &s, &traces, &sources, &note));
        read_page(out);
        if (n == 1)
            text_has("The floor is the median of all orders, 0.5 N·m: about what switching", page);
        else
            text_lacks("The floor is", page);
        text_has(n < 2 ? "The largest order, 2, has 0.8 N·m" : "The largest order, 1, has 0.3 N·m", page);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_diagnosis);
    RUN_TEST(test_new_recordings);
    RUN_TEST(test_what_is_left_above_the_noise);
    RUN_TEST(test_largest_of_each_order);
    RUN_TEST(test_chance_is_no_order);
    RUN_TEST(test_other_verdicts);
    RUN_TEST(test_what_is_seldom);
    RUN_TEST(test_hostile_names);
    RUN_TEST(test_no_run_and_no_finding);
    RUN_TEST(test_odd_numbers);
    RUN_TEST(test_same_bytes);
    RUN_TEST(test_no_memory);
    RUN_TEST(test_marks_of_runs);
    RUN_TEST(test_marks_of_findings);
    RUN_TEST(test_largest);
    RUN_TEST(test_traces_keep_peaks);
    RUN_TEST(test_digits);
    RUN_TEST(test_digits_above);
    RUN_TEST(test_digits_in_a_column);
    RUN_TEST(test_what_was_not_computed);
    RUN_TEST(test_values_are_in_words);
    RUN_TEST(test_inductances_in_words);
    RUN_TEST(test_contrast);
    RUN_TEST(test_solution);
    RUN_TEST(test_solution_within_limits);
    RUN_TEST(test_simulation);
    RUN_TEST(test_simulation_with_before);
    RUN_TEST(test_simulation_floor);
    return UNITY_END();
}
