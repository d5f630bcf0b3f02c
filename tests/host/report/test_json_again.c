/* What new recordings say of the last diagnosis, read back from the JSON by the parser of cJSON: each number
 * under its name, every run and every effect. */
#include "host/report/json_again.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

#include "unity.h"

enum { RUNS = 2, EFFECTS = 3 };

static cJSON *whole, *again;

void setUp(void)
{
    static char file[RUNS][8] = {"a.csv", "b.csv"};
    static hci_again_run run[RUNS];
    static hci_again a;
    hci_json json;
    memset(&a, 0, sizeof a);
    for (size_t k = 0; k < RUNS; ++k) {
        const double x = 10.0 * (double)(k + 1);
        run[k] = (hci_again_run){.file = file[k],
                                 .role = k ? HCI_ROLE_HOLDOUT : HCI_ROLE_FIT,
                                 .declared_Nm = x + 1.0,
                                 .last_Nm = x + 2.0,
                                 .last_mean_Nm = -x - 3.0,
                                 .last_ripple_Nm = x + 4.0,
                                 .now_Nm = x + 5.0,
                                 .noise_Nm = x + 6.0,
                                 .bound_Nm = k ? (double)NAN : x + 7.0,
                                 .kept = k == 0};
    }
    a.run = run;
    a.runs = RUNS;
    a.bounded = 4;
    a.kept = 3;
    a.declared_Nm = 0.1;
    a.last_Nm = 0.2;
    a.now_Nm = 0.3;
    a.noise_Nm = 0.4;
    a.bound_Nm = 0.5;
    a.recordings_before = 7;
    a.effects = EFFECTS;
    a.effect[0] =
        (hci_again_effect){"cogging", HCI_AGAIN_STAYS, HCI_AGAIN_SILENT, false, false, 0.5, "1 then 2"};
    a.effect[1] = (hci_again_effect){"friction", HCI_AGAIN_LEFT, HCI_AGAIN_AGAINST, true, false, NAN, ""};
    a.effect[2] =
        (hci_again_effect){"current_offset", HCI_AGAIN_CAME, HCI_AGAIN_SILENT, false, true, 4.0, "x"};
    hci_json_begin(&json);
    hci_again_put(&json, &a);
    char *text = hci_json_end(&json);
    TEST_ASSERT_NOT_NULL(text);
    whole = cJSON_Parse(text);
    again = cJSON_GetObjectItem(whole, "again");
    hci_json_free(text);
    TEST_ASSERT_NOT_NULL(again);
}

void tearDown(void)
{
    cJSON_Delete(whole);
}

static void check_number(const cJSON *of, const char *name, double value)
{
    const cJSON *item = cJSON_GetObjectItem(of, name);
    TEST_ASSERT_NOT_NULL_MESSAGE(item, name);
    TEST_ASSERT_EQUAL_MESSAGE(isnan(value), cJSON_IsNull(item), name);
    if (!isnan(value)) TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(value, item->valuedouble, name);
}

static void check_text(const cJSON *of, const char *name, const char *value)
{
    TEST_ASSERT_EQUAL_STRING_MESSAGE(value, cJSON_GetStringValue(cJSON_GetObjectItem(of, name)), name);
}

static void test_figures_of_all(void)
{
    check_number(again, "recordings_before", 7.0);
    check_number(again, "with_bound", 4.0);
    check_number(again, "within_bound", 3.0);
    check_number(again, "rms_declared_Nm", 0.1);
    check_number(again, "rms_last_Nm", 0.2);
    check_number(again, "rms_now_Nm", 0.3);
    check_number(again, "noise_Nm", 0.4);
    check_number(again, "bound_Nm_95", 0.5);
    TEST_ASSERT_TRUE(strlen(cJSON_GetStringValue(cJSON_GetObjectItem(again, "words"))) > 20);
}

static void test_each_run(void)
{
    const cJSON *runs = cJSON_GetObjectItem(again, "new_runs");
    TEST_ASSERT_EQUAL(RUNS, cJSON_GetArraySize(runs));
    for (int k = 0; k < RUNS; ++k) {
        const cJSON *r = cJSON_GetArrayItem(runs, k);
        const double x = 10.0 * (k + 1);
        check_text(r, "file", k ? "b.csv" : "a.csv");
        check_text(r, "role", k ? "holdout" : "fit");
        check_number(r, "rms_declared_Nm", x + 1.0);
        check_number(r, "rms_last_Nm", x + 2.0);
        check_number(r, "error_mean_last_Nm", -x - 3.0);
        check_number(r, "ripple_last_Nm", x + 4.0);
        check_number(r, "rms_now_Nm", x + 5.0);
        check_number(r, "noise_Nm", x + 6.0);
        check_number(r, "bound_Nm_95", k ? (double)NAN : x + 7.0);
        TEST_ASSERT_EQUAL(k == 0, cJSON_IsTrue(cJSON_GetObjectItem(r, "kept")));
    }
}

static void test_each_effect(void)
{
    static const char *const EFFECT[] = {"cogging", "friction", "current_offset"},
                             *const CHANGE[] = {"stays", "left", "came"},
                             *const VALUE[] = {"1 then 2", "", "x"};
    const double deviations[] = {0.5, (double)NAN, 4.0};
    const cJSON *changes = cJSON_GetObjectItem(again, "changes");
    TEST_ASSERT_EQUAL(EFFECTS, cJSON_GetArraySize(changes));
    for (int k = 0; k < EFFECTS; ++k) {
        const cJSON *e = cJSON_GetArrayItem(changes, k);
        check_text(e, "effect", EFFECT[k]);
        check_text(e, "change", CHANGE[k]);
        check_text(e, "value", VALUE[k]);
        const cJSON *speaks = cJSON_GetObjectItem(e, "new_recordings_speak");
        if (k == 1)
            TEST_ASSERT_EQUAL_STRING("against", cJSON_GetStringValue(speaks));
        else
            TEST_ASSERT_NULL(speaks);
        check_number(e, "standard_errors", deviations[k]);
        TEST_ASSERT_EQUAL(k == 1, cJSON_IsTrue(cJSON_GetObjectItem(e, "was_ambiguous")));
        TEST_ASSERT_EQUAL(k == 2, cJSON_IsTrue(cJSON_GetObjectItem(e, "is_ambiguous")));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_figures_of_all);
    RUN_TEST(test_each_run);
    RUN_TEST(test_each_effect);
    return UNITY_END();
}
