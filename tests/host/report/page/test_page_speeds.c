/* The page of torque ripple over the speed, and its picture: every number of the results is in the tables,
 * and the marks stand where the numbers are. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "host/plot/plot.h"
#include "host/report/page/page.h"
#include "support/texts.h"
#include "support/written.h"
#include "unity.h"

enum { SPEEDS = 3 };

static const double RPM[SPEEDS] = {10.0, 100.0, 1000.0};

static hci_speed_row row[SPEEDS];
static hci_speeds speeds;

/* Numbers that are all different: ripple 1, 2, 4 … % times the speed's decade, voltages beside them. */
void setUp(void)
{
    files_begin();
    for (int k = 0; k < SPEEDS; ++k) {
        row[k] = (hci_speed_row){
            .speed_rad_per_s = RPM[k] * HCI_PI / 30.0, .needed_V = 11.5 + k, .orders_short = (size_t)(7 * k)};
        for (int r = 0; r < HCI_REMEDIES; ++r) {
            row[k].remedy[r].T_ripple_percent = (k + 1.0) * (16 >> r);
            row[k].remedy[r].worst_T_ripple_percent = 100.0 + 10.0 * k + r;
            row[k].remedy[r].line_V = 20.0 * k + r + 1.0;
            row[k].remedy[r].limited_share = 0.01 * (k + 1) * (r + 1);
        }
    }
    speeds = (hci_speeds){.row = row,
                          .count = SPEEDS,
                          .torque_Nm = 1.25,
                          .dc_link_V = 80.0,
                          .voltage_rad_per_s = 700.0 * HCI_PI / 30.0,
                          .sampled_rad_per_s = HUGE_VAL};
}

void tearDown(void)
{
    files_end();
}

static char *page(void)
{
    const hci_report_sources sources = {.machine = "motors/hub", .drive = "drive.csv"};
    hci_output *out = written_begin("report.html");
    hci_page_speeds(out, &speeds, &sources);
    char *text = written_end(out, "report.html");
    text_is_xml(strstr(text, "<html"));
    text_tables_are_whole(text);
    return text;
}

static char *picture(void)
{
    hci_output *out = written_begin("speeds.svg");
    hci_plot_speeds(out, &speeds);
    char *text = written_end(out, "speeds.svg");
    text_is_xml(text);
    return text;
}

/* The n-th number of the table of a caption. */
static double cell(const char *text, const char *caption, int n)
{
    static const char CELL[] = "<td><data value=\"";
    char key[64];
    snprintf(key, sizeof key, "%s</caption>", caption);
    const char *at = strstr(text, key);
    TEST_ASSERT_NOT_NULL_MESSAGE(at, caption);
    for (int k = 0; k <= n; ++k) {
        at = strstr(at + 1, CELL);
        TEST_ASSERT_NOT_NULL_MESSAGE(at, caption);
    }
    return atof(at + sizeof CELL - 1);
}

static void test_tables(void)
{
    speeds.model_error = 0.1;
    const char *text = page();
    for (int k = 0; k < SPEEDS; ++k) {
        const int first = k * (1 + HCI_REMEDIES);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * RPM[k], RPM[k], cell(text, "T_ripple in %", first));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * RPM[k], RPM[k], cell(text, "R, L and flux are 10 % off", first));
        for (int r = 0; r < HCI_REMEDIES; ++r) {
            TEST_ASSERT_EQUAL_DOUBLE((k + 1.0) * (16 >> r), cell(text, "T_ripple in %", first + 1 + r));
            TEST_ASSERT_EQUAL_DOUBLE(100.0 + 10.0 * k + r,
                                     cell(text, "R, L and flux are 10 % off", first + 1 + r));
        }
        const hci_speed_result *x = &row[k].remedy[HCI_REMEDY_FEEDFORWARD];
        const double expected[] = {RPM[k], row[k].needed_V, 7.0 * k, x->line_V, x->limited_share};
        for (int j = 0; j < 5; ++j)
            TEST_ASSERT_DOUBLE_WITHIN(1e-9 * expected[j], expected[j], cell(text, "Voltage", 5 * k + j));
    }
}

/* The least at the highest speed, which is feedforward here, and compensation where that is less. */
static void test_words(void)
{
    text_has("At 1000 rpm feedforward leaves the least ripple, 3 %, where a plain sine has 48 %", page());
    text_has("1.25 N·m at 3 speeds with a dc link of 80 V.", page());
    text_has("The dc link does for all orders up to 700 rpm", page());
    text_lacks("The sampling does", page());
    text_lacks("R, L and flux are", page());
    text_has("motors/hub", page());
    row[SPEEDS - 1].remedy[HCI_REMEDY_COMPENSATION].T_ripple_percent = 2.5;
    speeds.voltage_rad_per_s = HUGE_VAL;
    speeds.sampled_rad_per_s = 800.0 * HCI_PI / 30.0;
    text_has("At 1000 rpm compensation leaves the least ripple, 2.5 %", page());
    text_lacks("The dc link does", page());
    text_has("The sampling does for all orders up to 800 rpm", page());
}

/* ---- the picture ---- */

/* Points of the n-th line of a style. */
static void points(const char *text, const char *style, int n, double x[SPEEDS], double y[SPEEDS])
{
    char key[64];
    snprintf(key, sizeof key, "<polyline class=\"%s\" points=\"", style);
    const char *at = text;
    for (int k = 0; k <= n; ++k) {
        at = strstr(k ? at + 1 : at, key);
        TEST_ASSERT_NOT_NULL_MESSAGE(at, key);
    }
    char *end = NULL;
    at += strlen(key);
    for (int k = 0; k < SPEEDS; ++k) {
        x[k] = strtod(at, &end);
        y[k] = strtod(end + 1, &end);
        at = end;
    }
}

/* A decade of speed is as far as the next one, and twice the ripple as far up as twice that; on the second
 * panel a volt is a volt, and the dc link stands among the lines. */
static void test_marks(void)
{
    static const char *const STYLE[HCI_REMEDIES] = {"before", "noise", "wanted", "c", "a"};
    const char *text = picture();
    double x[SPEEDS], y[SPEEDS], first[SPEEDS], octave = 0.0, volt = 0.0;
    points(text, STYLE[0], 0, x, first);
    points(text, STYLE[1], 0, x, y);
    octave = y[0] - first[0];
    TEST_ASSERT_TRUE(octave > 10.0);
    for (int r = 0; r < HCI_REMEDIES; ++r) {
        points(text, STYLE[r], 0, x, y);
        TEST_ASSERT_DOUBLE_WITHIN(0.03, x[1] - x[0], x[2] - x[1]);
        TEST_ASSERT_TRUE(x[1] - x[0] > 50.0);
        for (int k = 0; k < SPEEDS; ++k)
            TEST_ASSERT_DOUBLE_WITHIN(0.08, first[0] + octave * (r - log2(k + 1.0)), y[k]);
    }
    points(text, STYLE[0], 1, x, first);
    volt = (first[0] - first[2]) / 40.0;
    TEST_ASSERT_TRUE(volt > 0.3);
    for (int r = 0; r < HCI_REMEDIES; ++r) {
        points(text, STYLE[r], 1, x, y);
        for (int k = 0; k < SPEEDS; ++k)
            TEST_ASSERT_DOUBLE_WITHIN(0.03, first[0] - volt * (20.0 * k + r), y[k]);
    }
    bool is_there = false; /* beside the sample of the legend */
    for (const char *at = text; (at = strstr(at, "<path class=\"limit\" d=\"M")) != NULL; ++at) {
        double x1, y1, x2, y2;
        TEST_ASSERT_EQUAL_INT(4,
                              sscanf(at, "<path class=\"limit\" d=\"M%lf %lfL%lf %lf", &x1, &y1, &x2, &y2));
        is_there = is_there || (x2 - x1 >= x[2] - x[0] && fabs(y1 - (first[0] - 79.0 * volt)) < 0.05);
    }
    TEST_ASSERT_TRUE(is_there);
}

/* What is not known is left out; speeds in the other direction are told by their size. */
static void test_numbers_that_are_not_known(void)
{
    double x[SPEEDS], y[SPEEDS], whole[SPEEDS];
    points(picture(), "noise", 0, x, whole);
    row[1].remedy[HCI_REMEDY_TABLE].T_ripple_percent = NAN;
    for (int k = 0; k < SPEEDS; ++k)
        row[k].speed_rad_per_s *= -1.0;
    const char *text = picture();
    text_lacks("nan", text);
    text_has("speed in rpm, in the negative direction", text);
    points(text, "noise", 0, x, y);
    TEST_ASSERT_EQUAL_DOUBLE(whole[0], y[0]);
    TEST_ASSERT_EQUAL_DOUBLE(whole[2], y[1]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_tables);
    RUN_TEST(test_words);
    RUN_TEST(test_marks);
    RUN_TEST(test_numbers_that_are_not_known);
    return UNITY_END();
}
