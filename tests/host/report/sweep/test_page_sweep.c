/* The page and the summary of a sweep, of figures that are made up: sentences, tables and numbers. */
#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/report/summary.h"
#include "hci/host/report/sweep/write.h"
#include "host/report/sweep/page_sweep.h"
#include "support/grid_by_hand.h"
#include "support/texts.h"
#include "support/written.h"
#include "unity.h"

static const char *page;

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    files_end();
}

static void write_page(const hci_grid *s)
{
    const hci_report_sources sources = {.machine = "motor <7>"};
    hci_output *out = written_begin("report.html");
    hci_page_sweep(out, s, &sources);
    page = written_end(out, "report.html");
    text_is_xml(strstr(page, "<html"));
    text_tables_are_whole(page);
    text_lacks("nan", page);
    text_has("· motor &#60;7&#62;", page);
}

/* ---- pages ---- */

static void test_page_of_a_trade_off(void)
{
    static const char TABLE[] = "<caption>By the limit of the phase current</caption>",
                      COPPER[] = "<caption>By the limit of the copper loss</caption>";
    hci_grid s = grid_trade_off();
    write_page(&s);
    text_has("<h1>2 N·m without ripple takes 19.5 A at the peak</h1>", page);
    text_has("7 points; no limits.", page);
    text_has(
        "The least that makes the torque: a limit of the phase current of 12 A, with 5 % of ripple and 1.16 "
        "times the copper loss of the plain sine.",
        page);
    text_has("The least with at most 1 % of ripple: a limit of the phase current of 15 A, with 0.8 % of "
             "ripple and "
             "1.1 times",
             page);
    text_has("The least without ripple: a limit of the phase current of 20 A, with no ripple and 1 times",
             page);
    TEST_ASSERT_EQUAL_STRING("10 – 1.2 9.5 torque ", text_row(page, TABLE, 0));
    TEST_ASSERT_EQUAL_STRING("20 0 1 19.5 reached ", text_row(page, TABLE, 3));
    TEST_ASSERT_EQUAL_INT(4, text_rows(page, TABLE));
    TEST_ASSERT_EQUAL_STRING("1.05 6 1.05 32 ripple ", text_row(page, COPPER, 0));
    TEST_ASSERT_EQUAL_STRING("1.5 0.005 1.5 40 ripple ", text_row(page, COPPER, 2));
    TEST_ASSERT_EQUAL_INT(3, text_rows(page, COPPER));
    TEST_ASSERT_TRUE(strstr(page, TABLE) < strstr(page, COPPER)); /* as the pictures that they belong to */
    TEST_ASSERT_EQUAL_INT(2 * 4, text_count("<svg ", page));      /* for a screen and for a telephone */
    text_has("Numbers: trade_off.csv", page);
    text_has("badge good\">Done<", page);
    text_lacks("Points without a result", page);
    grid_row[3].best.T_ripple_percent = 0.7;
    write_page(&s);
    text_has("<h1>2 N·m takes 11.5 A at the peak, with 5 % of ripple</h1>", page);
    for (int k = 0; k < 4; ++k)
        grid_row[k].verdict = HCI_GRID_TORQUE;
    write_page(&s);
    text_has("<h1>No limit that was tried lets 2 N·m be made</h1>", page);
}

static void test_page_of_an_envelope(void)
{
    static const char TABLE[] = "<caption>Largest mean torque</caption>";
    const hci_grid s = grid_envelope(2);
    write_page(&s);
    text_has("<h1>3 N·m at 1000 rpm with at most 2.5 % of ripple</h1>", page);
    text_has(
        "At 1000 rpm: 3 N·m with at most 2.5 % of ripple, 4 N·m with 8 %, and 2.5 N·m with 5 % by the plain "
        "sine.",
        page);
    TEST_ASSERT_EQUAL_INT(6, text_rows(page, TABLE));
    TEST_ASSERT_EQUAL_STRING("2000 24 2 1 3 6 1.5 3 voltage reached ", text_row(page, TABLE, 1));
    TEST_ASSERT_EQUAL_STRING("3000 48 – – 3 6 0.75 1.5  ripple ", text_row(page, TABLE, 5));
    TEST_ASSERT_EQUAL_INT(2 * 2, text_count("<svg ", page));
    text_has("Numbers: envelope.csv", page);
    grid_row[0].best = grid_no_figures();
    write_page(&s);
    text_has("<h1>No torque at 1000 rpm with at most 2.5 % of ripple</h1>", page);
    text_lacks("At 1000 rpm:", page);
}

static void test_page_of_a_map(void)
{
    static const char TABLE[] = "<caption>Points</caption>";
    hci_grid s = grid_map();
    write_page(&s);
    text_has("<h1>At 2 of 6 points the torque is made without ripple</h1>", page);
    text_has("6 points: 2 without ripple, 2 with the smallest ripple there is, 1 with less torque than is "
             "wanted, 1 "
             "without a result.",
             page);
    TEST_ASSERT_EQUAL_INT(6, text_rows(page, TABLE));
    TEST_ASSERT_EQUAL_STRING("400 1 6 90 21 33 voltage ripple ", text_row(page, TABLE, 2));
    TEST_ASSERT_EQUAL_STRING("400 3 – – – –  failed ", text_row(page, TABLE, 5));
    text_has("badge bad\">Points without a result<", page);
    text_has("Point 6: no step was found", page);
    text_lacks("Point 5:", page);
    text_has("Numbers: map.csv", page);
    s.plan.count = 4;
    write_page(&s);
    text_has("badge good\">Done<", page);
    text_has("4 points: 2 without ripple, 2 with the smallest ripple there is.", page);
}

/* ---- the summary ---- */

static cJSON *json_of(const hci_grid *s)
{
    char *text = hci_grid_json(s);
    TEST_ASSERT_NOT_NULL(text);
    cJSON *json = cJSON_Parse(text);
    hci_text_free(text);
    TEST_ASSERT_NOT_NULL(json);
    return json;
}

/* By names with dots between; NAN where there is none. */
static double number_of(const cJSON *json, const char *path)
{
    char name[40];
    const cJSON *at = json;
    while (at && *path) {
        const size_t length = strcspn(path, ".");
        snprintf(name, sizeof name, "%.*s", (int)length, path);
        at = cJSON_IsArray(at) ? cJSON_GetArrayItem(at, name[0] - '0')
                               : cJSON_GetObjectItemCaseSensitive(at, name);
        path += length + (path[length] == '.');
    }
    return cJSON_IsNumber(at) ? at->valuedouble : (double)NAN;
}

static void check_numbers(const cJSON *json, const char *const *path, const double *value)
{
    for (int k = 0; path[k]; ++k) {
        const double found = number_of(json, path[k]);
        TEST_ASSERT_TRUE_MESSAGE(fabs(found - value[k]) <= 1e-9 * fabs(value[k]), path[k]);
    }
}

static void test_summary_of_a_trade_off(void)
{
    static const char *const PATH[] = {"points",
                                       "verdicts.reached",
                                       "verdicts.ripple",
                                       "verdicts.torque",
                                       "verdicts.failed",
                                       "torque_Nm",
                                       "speed_rpm",
                                       "by_current.any_ripple.limit_phase_A",
                                       "by_current.one_percent.limit_phase_A",
                                       "by_current.no_ripple.limit_phase_A",
                                       "by_copper.any_ripple.limit_loss_to_plain",
                                       "by_copper.one_percent.limit_loss_to_plain",
                                       "by_copper.no_ripple.limit_loss_to_plain",
                                       "by_copper.any_ripple.T_ripple_percent",
                                       "sine.T_ripple_percent",
                                       NULL};
    static const double VALUE[] = {7.0,  1.0,  5.0,  1.0, 0.0, 2.0, 600.0, 12.0,
                                   15.0, 20.0, 1.05, 1.5, 1.5, 6.0, 8.0};
    const hci_grid s = grid_trade_off();
    cJSON *json = json_of(&s);
    check_numbers(json, PATH, VALUE);
    TEST_ASSERT_EQUAL_STRING("trade-off", cJSON_GetObjectItem(json, "kind")->valuestring);
    cJSON_Delete(json);
}

static void test_summary_of_an_envelope(void)
{
    static const char *const PATH[] = {"ripple_percent",
                                       "speeds.0.speed_rpm",
                                       "speeds.1.dc_link_V",
                                       "speeds.1.best.mean_Nm",
                                       "speeds.4.most.T_ripple_percent",
                                       "speeds.5.sine.mean_Nm",
                                       "speeds.0.best.copper_W",
                                       NULL};
    static const double VALUE[] = {2.5, 1000.0, 24.0, 2.0, 9.0, 0.75, 45.0};
    const hci_grid s = grid_envelope(2);
    cJSON *json = json_of(&s);
    check_numbers(json, PATH, VALUE);
    TEST_ASSERT_EQUAL_INT(6, cJSON_GetArraySize(cJSON_GetObjectItem(json, "speeds")));
    cJSON_Delete(json);
}

/* Of the points whose mean is reached, the first four. */
static void test_summary_of_a_map(void)
{
    static const char *const PATH[] = {"worst_T_ripple_percent", "largest_peak_phase_A",
                                       "largest_mean_square_A2", "largest_peak_line_V",
                                       "failed.0.point",         NULL};
    static const double VALUE[] = {8.0, 28.0, 120.0, 44.0, 6.0};
    const hci_grid s = grid_map();
    cJSON *json = json_of(&s);
    check_numbers(json, PATH, VALUE);
    TEST_ASSERT_EQUAL_INT(1, cJSON_GetArraySize(cJSON_GetObjectItem(json, "failed")));
    cJSON_Delete(json);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_page_of_a_trade_off);
    RUN_TEST(test_page_of_an_envelope);
    RUN_TEST(test_page_of_a_map);
    RUN_TEST(test_summary_of_a_trade_off);
    RUN_TEST(test_summary_of_an_envelope);
    RUN_TEST(test_summary_of_a_map);
    return UNITY_END();
}
