/* The tables and the summary of a fleet whose figures are made up, letter by letter. */
#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/report/fleet/write.h"
#include "hci/host/report/summary.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

enum { MOTORS = 4, PARAMETERS = 2 };

static hci_line_motor motor[MOTORS];
static hci_line_parameter parameter[PARAMETERS];
static double value[MOTORS * PARAMETERS] = {0.5, 0.25, 1.5, 0.75, 0.0, 0.0, 1.0, 0.5},
                             std_error[MOTORS * PARAMETERS] = {0.125, 0.0, 0.125, 0.0,
                                                               0.125, 0.0, 0.125, 0.0};
static hci_line line;
static hci_note note;

static void name(hci_fleet_parameter *x, const char *effect, const char *of, const char *unit)
{
    snprintf(x->effect, sizeof x->effect, "%s", effect);
    snprintf(x->parameter, sizeof x->parameter, "%s", of);
    snprintf(x->unit, sizeof x->unit, "%s", unit);
}

/* Motors of which the second stands out by the first parameter, the third by what stays; b in common 0.5
 * about 0.25, of variance 1/64 as its errors, so that half of a departure is drawn. */
void setUp(void)
{
    static const char *const NAMES[MOTORS] = {"m1", "m,2", "m3", "m4"};
    files_begin();
    memset(motor, 0, sizeof motor);
    memset(parameter, 0, sizeof parameter);
    for (size_t k = 0; k < MOTORS; ++k) {
        snprintf(motor[k].name, sizeof motor[k].name, "%s", NAMES[k]);
        motor[k].row = k % 2 ? "odd,row" : "even,row";
        motor[k].state = k == 3 ? HCI_FLEET_OPEN : HCI_FLEET_DONE;
        motor[k].worst = k == 2 ? 1 : 0;
        motor[k].deviation = 1.5 * (double)k - 1.0;
        motor[k].stands_out = k == 1 || k == 2;
    }
    name(&parameter[0].name, "cogging", "sine_6", "Nm");
    name(&parameter[1].name, "left", "rms", "1");
    parameter[0].motors = 4;
    parameter[0].median = 0.5, parameter[0].scale = 0.25, parameter[0].low = -1.0, parameter[0].high = 2.0;
    parameter[0].outside = 1, parameter[0].mean = 0.25, parameter[0].mean_std_error = 0.0625;
    parameter[0].between = 0.125, parameter[0].noise = 0.03125, parameter[0].per_day = 3.0;
    parameter[0].per_day_std_error = 1.5, parameter[0].batch_deviation = 7.0,
    parameter[0].batch_criterion = 9.0;
    parameter[1] = parameter[0];
    name(&parameter[1].name, "left", "rms", "1");
    parameter[1].per_day = parameter[1].per_day_std_error = parameter[1].batch_deviation = (double)NAN;
    parameter[1].batch_criterion = (double)NAN;
    parameter[1].between = 0.0;
    line = (hci_line){.command = HCI_FLEET_DIAGNOSE,
                      .false_alarms = 0.01,
                      .limit = 4.0,
                      .motor = motor,
                      .motors = MOTORS,
                      .parameter = parameter,
                      .parameters = PARAMETERS,
                      .dates_unread = 3,
                      .value = value,
                      .std_error = std_error};
}

void tearDown(void)
{
    files_end();
}

static const char *written(const char *file)
{
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_line_write(&line, files_root, &note), note.text);
    return files_read(files_path(file));
}

static void test_rows_of_all_motors(void)
{
    const char *text = written("fleet.csv");
    TEST_ASSERT_EQUAL_STRING_LEN("motor,", text, 6);
    TEST_ASSERT_EQUAL_STRING("\neven,row\nodd,row\neven,row\nodd,row\n", strchr(text, '\n'));
}

/* What is not known is an empty cell. */
static void test_parameters(void)
{
    TEST_ASSERT_EQUAL_STRING(
        "effect,parameter,unit,motors,median,standard_deviation,low,high,outside,mean,mean_std_error,between,"
        "noise,per_day,per_day_std_error,batch_deviation,batch_criterion\n"
        "cogging,sine_6,Nm,4,0.5,0.25,-1,2,1,0.25,0.0625,0.125,0.03125,3,1.5,7,9\n"
        "left,rms,1,4,0.5,0.25,-1,2,1,0.25,0.0625,0,0.03125,,,,\n",
        written("line.csv"));
}

/* Of one that stands out what was fitted; of the others what all motors make of it: half of what is beside
 * the mean, and nothing where motors do not differ. */
static void test_deviations(void)
{
    TEST_ASSERT_EQUAL_STRING("motor,state,stands_out,described,effect,parameter,deviation,"
                             "cogging_sine_6_Nm,left_rms\n"
                             "m1,done,no,,cogging,sine_6,-1,0.125,0\n"
                             "\"m,2\",done,yes,yes,cogging,sine_6,0.5,1.25,0.5\n"
                             "m3,done,yes,no,left,rms,2,-0.25,-0.25\n"
                             "m4,open,no,,cogging,sine_6,3.5,0.375,0\n",
                             written("deviations.csv"));
    motor[1].leaves_more = true;
    text_has("\"m,2\",done,yes,part,cogging,sine_6,", written("deviations.csv"));
}

static void test_motors_without_parameters(void)
{
    line.parameters = 0;
    for (size_t k = 0; k < MOTORS; ++k) {
        motor[k].worst = HCI_LINE_NONE;
        motor[k].stands_out = false;
        motor[k].deviation = (double)NAN;
    }
    TEST_ASSERT_EQUAL_STRING("motor,state,stands_out,described,effect,parameter,deviation\n"
                             "m1,done,no,,,,\n\"m,2\",done,no,,,,\nm3,done,no,,,,\nm4,open,no,,,,\n",
                             written("deviations.csv"));
}

static double number(const cJSON *of, const char *of_name)
{
    const cJSON *x = cJSON_GetObjectItem(of, of_name);
    TEST_ASSERT_NOT_NULL_MESSAGE(x, of_name);
    return x->valuedouble;
}

static void test_summary(void)
{
    char *text = hci_line_json(&line);
    cJSON *json = cJSON_Parse(text);
    hci_text_free(text);
    TEST_ASSERT_NOT_NULL(json);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, number(json, "motors"));
    TEST_ASSERT_EQUAL_DOUBLE(3.0, number(json, "dates_unread"));
    TEST_ASSERT_EQUAL_DOUBLE(2.0, number(json, "stand_out"));
    TEST_ASSERT_EQUAL_DOUBLE(0.01, number(json, "false_alarms"));
    TEST_ASSERT_EQUAL_DOUBLE(4.0, number(json, "limit"));
    const cJSON *outside = cJSON_GetObjectItem(json, "outside");
    TEST_ASSERT_EQUAL_INT(2, cJSON_GetArraySize(outside));
    for (int k = 0; k < 2; ++k) {
        const cJSON *x = cJSON_GetArrayItem(outside, k);
        TEST_ASSERT_EQUAL_STRING(k ? "m3" : "m,2", cJSON_GetObjectItem(x, "motor")->valuestring);
        TEST_ASSERT_EQUAL_STRING(k ? "left" : "cogging", cJSON_GetObjectItem(x, "effect")->valuestring);
        TEST_ASSERT_EQUAL_STRING(k ? "rms" : "sine_6", cJSON_GetObjectItem(x, "parameter")->valuestring);
        TEST_ASSERT_EQUAL_DOUBLE(k ? 2.0 : 0.5, number(x, "deviation"));
    }
    cJSON_Delete(json);
}

/* A set is whole: with a page, and the checksums of all others in the summary. */
static void test_the_whole_set(void)
{
    static const char *const FILES[] = {"fleet.csv", "line.csv", "deviations.csv", "report.html"};
    const char *text = written("summary.json");
    for (size_t k = 0; k < sizeof FILES / sizeof *FILES; ++k)
        text_has(FILES[k], text);
    TEST_ASSERT_EQUAL_INT(5, files_count(files_root));
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_OUTPUT, hci_line_write(&line, "/proc/none", &note));
    TEST_ASSERT_TRUE(note.text[0] != '\0');
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rows_of_all_motors);
    RUN_TEST(test_parameters);
    RUN_TEST(test_deviations);
    RUN_TEST(test_motors_without_parameters);
    RUN_TEST(test_summary);
    RUN_TEST(test_the_whole_set);
    return UNITY_END();
}
