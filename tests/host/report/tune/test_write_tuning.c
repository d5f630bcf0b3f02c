/* The inputs that `tune` writes for its steps, the names of its recordings in messages, and its summary. */
#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/report/summary.h"
#include "hci/host/report/tune/tuning.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

static hci_tuning tuning;
static hci_solution solution;
static hci_solved_order order[2];
static hci_note note;
static char out[512];

void setUp(void)
{
    files_begin();
    memset(&tuning, 0, sizeof tuning);
    memset(&solution, 0, sizeof solution);
    memset(&note, 0, sizeof note);
    snprintf(out, sizeof out, "%s", files_path("out"));
}

void tearDown(void)
{
    files_end();
}

static const char *file_of(const char *name)
{
    char path[64];
    snprintf(path, sizeof path, "out/%s", name);
    return files_read(files_path(path));
}

/* Recordings as they are found from the folder of the list. */
static void test_a_list(void)
{
    char first[512], second[512];
    snprintf(first, sizeof first, "%s", files_path("a.csv"));
    snprintf(second, sizeof second, "%s", files_path("x,y/b.csv"));
    mkdir(files_path("x,y"), 0700);
    files_write(first, "1\n");
    files_write(second, "2\n");
    const char *const log[] = {first, second};
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_tuning_write_list(out, log, 2, "turning", &note), note.text);
    TEST_ASSERT_EQUAL_STRING("file,role,test\n../a.csv,fit,turning\n\"../x,y/b.csv\",fit,turning\n",
                             file_of("runs.csv"));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_tuning_write_list(out, log, 1, "holding", &note));
    TEST_ASSERT_EQUAL_STRING("file,role,test\n../a.csv,fit,holding\n", file_of("runs.csv"));
}

/* A message of a file as the list has it is one of the file as it was given, whole names only. */
static void test_names_of_recordings(void)
{
    char given[512];
    const char *const log[] = {files_path("b.csv"), given};
    snprintf(given, sizeof given, "%s", files_path("a.csv"));
    files_write(given, "1\n");
    files_write(log[0], "2\n");
    mkdir(out, 0700);
    for (int slash = 0; slash < 2; ++slash) {
        char folder[520], words[600];
        snprintf(folder, sizeof folder, "%s%s", out, slash ? "/" : "");
        hci_note_set(&note, HCI_OK, "in %s/../a.csv:3: found `x`", out);
        hci_tuning_name_log(folder, log, 2, &note);
        snprintf(words, sizeof words, "in %s:3: found `x`", given);
        TEST_ASSERT_EQUAL_STRING(words, note.text);
        snprintf(words, sizeof words, "%s/../a.csvx: found `x`", out);
        memset(&note, 0, sizeof note);
        hci_note_set(&note, HCI_OK, "%s", words);
        hci_tuning_name_log(folder, log, 2, &note);
        TEST_ASSERT_EQUAL_STRING(words, note.text);
        memset(&note, 0, sizeof note);
    }
}

static void test_a_zero_and_a_target(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_tuning_write_sensor_zero(out, -0.0125, &note));
    TEST_ASSERT_EQUAL_STRING("effect,parameter,value,unit\ntorque_sensor,offset,-0.0125,Nm\n",
                             file_of("effects.csv"));
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_tuning_write_target(out, 2.5, &note));
    TEST_ASSERT_EQUAL_STRING("order,amplitude_Nm,phase_rad\n0,2.5,0\n", file_of("target.csv"));
}

/* ---- the summary ---- */

static cJSON *summary(void)
{
    char *text = hci_tuning_json(&tuning);
    TEST_ASSERT_NOT_NULL(text);
    cJSON *json = cJSON_Parse(text);
    hci_text_free(text);
    TEST_ASSERT_NOT_NULL(json);
    return json;
}

static void is_list(const cJSON *json, const char *list, const char *const *lines, int count)
{
    const cJSON *const x = cJSON_GetObjectItem(json, list);
    TEST_ASSERT_EQUAL_INT_MESSAGE(count, cJSON_GetArraySize(x), list);
    for (int k = 0; k < count; ++k)
        TEST_ASSERT_EQUAL_STRING(lines[k], cJSON_GetArrayItem(x, k)->valuestring);
}

/* Each line of a part is an entry, the last one with or without its end. */
static void test_parts_are_lists_of_lines(void)
{
    static const char *const KEYS[] = {"caveats", "read",         "found", "wanted",
                                       "unknown", "measure_next", "load",  "load_else"};
    tuning.good = true;
    strcpy(tuning.verdict, "good");
    strcpy(tuning.heading, "a sentence");
    for (int k = 0; k < HCI_TUNING_PARTS; ++k)
        snprintf(tuning.part[k], HCI_TUNING_TEXT, k % 2 ? "p%d\n\nlast %d" : "p%d\n", k, k);
    strcpy(tuning.commands, "one\ntwo\n");
    cJSON *json = summary();
    for (int k = 0; k < HCI_TUNING_PARTS; ++k) {
        char first[24], last[24];
        snprintf(first, sizeof first, "p%d", k);
        snprintf(last, sizeof last, "last %d", k);
        is_list(json, KEYS[k], (const char *const[]){first, "", last}, k % 2 ? 3 : 1);
    }
    is_list(json, "commands", (const char *const[]){"one", "two"}, 2);
    TEST_ASSERT_TRUE(cJSON_IsTrue(cJSON_GetObjectItem(json, "good")));
    TEST_ASSERT_EQUAL_STRING("good", cJSON_GetObjectItem(json, "verdict")->valuestring);
    TEST_ASSERT_EQUAL_STRING("a sentence", cJSON_GetObjectItem(json, "words")->valuestring);
    TEST_ASSERT_NULL(cJSON_GetObjectItem(json, "after"));
    cJSON_Delete(json);
}

/* A line of any length is there; of one that is too long its beginning. */
static void test_long_lines(void)
{
    for (int length = 2046; length <= 2049; ++length) {
        memset(tuning.commands, 'c', (size_t)length);
        strcpy(tuning.commands + length, "\nnext\n");
        cJSON *json = summary();
        const cJSON *x = cJSON_GetObjectItem(json, "commands");
        TEST_ASSERT_EQUAL_INT(2, cJSON_GetArraySize(x));
        TEST_ASSERT_EQUAL_UINT64(length < 2047 ? length : 2047,
                                 strlen(cJSON_GetArrayItem(x, 0)->valuestring));
        TEST_ASSERT_EQUAL_STRING("next", cJSON_GetArrayItem(x, 1)->valuestring);
        cJSON_Delete(json);
    }
}

static double figure(const cJSON *json, const char *object, const char *name)
{
    const cJSON *x = cJSON_GetObjectItem(cJSON_GetObjectItem(json, object), name);
    return x && cJSON_IsNumber(x) ? x->valuedouble : (double)NAN;
}

static void test_figures_of_the_currents(void)
{
    order[0].torque_Nm = (hci_harmonic){0.0, 0.0, 2.5};
    solution.order = order;
    solution.order_count = 1;
    solution.plain_amplitude_A = 9.0;
    solution.peak_phase_current_A = 11.0;
    solution.loss_to_plain = 1.25;
    tuning.solution = &solution;
    for (int table = 0; table < 2; ++table) {
        tuning.table_Nm = table ? 0.125 : 0.0;
        cJSON *json = summary();
        TEST_ASSERT_EQUAL_DOUBLE(9.0, figure(json, "before", "peak_phase_A"));
        TEST_ASSERT_EQUAL_DOUBLE(2.5, figure(json, "after", "mean_Nm"));
        TEST_ASSERT_EQUAL_DOUBLE(11.0, figure(json, "after", "peak_phase_A"));
        TEST_ASSERT_EQUAL_DOUBLE(1.25, figure(json, "after", "loss_ratio_to_plain"));
        TEST_ASSERT_EQUAL(table, figure(json, "after", "table_peak_to_peak_Nm") == 0.125);
        cJSON_Delete(json);
    }
    solution.order_count = 0;
    cJSON *json = summary();
    TEST_ASSERT_TRUE(isnan(figure(json, "after", "mean_Nm")));
    cJSON_Delete(json);
}

static void test_the_files(void)
{
    strcpy(tuning.commands, "one\ntwo\n");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_tuning_write(&tuning, out, &note), note.text);
    TEST_ASSERT_EQUAL_STRING("one\ntwo\n", file_of("commands.sh"));
    TEST_ASSERT_EQUAL_INT(3, files_count(out));
    text_has("\"commands\"", file_of("summary.json"));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_OUTPUT, hci_tuning_write(&tuning, "/proc/none", &note));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_list);
    RUN_TEST(test_names_of_recordings);
    RUN_TEST(test_a_zero_and_a_target);
    RUN_TEST(test_parts_are_lists_of_lines);
    RUN_TEST(test_long_lines);
    RUN_TEST(test_figures_of_the_currents);
    RUN_TEST(test_the_files);
    return UNITY_END();
}
