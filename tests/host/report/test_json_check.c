/* What a check has found, read back from the JSON by the parser of cJSON: every entry of its lists. */
#include <cjson/cJSON.h>
#include <string.h>

#include "hci/host/check/check.h"
#include "hci/host/report/summary.h"
#include "unity.h"

static hci_check check;
static cJSON *json;

void setUp(void)
{
    static const char *const RUN[] = {"a.csv", "b.csv", "c.csv"};
    memset(&check, 0, sizeof check);
    check.machine = "motor";
    check.run = RUN;
    check.runs = 3;
    check.findings = 2;
    for (size_t k = 0; k < 2; ++k) {
        check.finding[k].slip = k ? "second" : "first";
        check.finding[k].line = 3 + k;
        check.finding[k].told_by = "a run";
    }
    check.finding[0].alternatives = 2;
    check.finding[0].alternative[0] = "poles";
    check.finding[0].alternative[1] = "sign";
    check.evidences = 2;
    check.gaps = 2;
    for (size_t k = 0; k < 2; ++k) {
        check.evidence[k].name = k ? "torque" : "voltage";
        check.gap[k].name = k ? "speed" : "inertia";
        check.evidence[k].words = check.gap[k].words = check.gap[k].needs = "words";
    }
    check.untolds = 2;
    check.untold[0] = "offset";
    check.untold[1] = "unit";
    strcpy(check.machine_remark.text, "of the machine");
    strcpy(check.remark[1].text, "of b");
    strcpy(check.remark[2].text, "of c");
    char *text = hci_check_json(&check);
    TEST_ASSERT_NOT_NULL(text);
    json = cJSON_Parse(text);
    hci_text_free(text);
    TEST_ASSERT_NOT_NULL(json);
}

void tearDown(void)
{
    cJSON_Delete(json);
}

/* Entries of a list: texts, or what stands under a name in each. */
static void lists(const cJSON *of, const char *list, const char *name, const char *const *expected, int count)
{
    const cJSON *const entries = cJSON_GetObjectItem(of, list);
    TEST_ASSERT_EQUAL_MESSAGE(count, cJSON_GetArraySize(entries), list);
    for (int k = 0; k < count; ++k) {
        const cJSON *entry = cJSON_GetArrayItem(entries, k);
        if (name) entry = cJSON_GetObjectItem(entry, name);
        TEST_ASSERT_EQUAL_STRING_MESSAGE(expected[k], cJSON_GetStringValue(entry), list);
    }
}

static void test_every_entry_is_there(void)
{
    static const char *const RUN[] = {"a.csv", "b.csv", "c.csv"}, *const SLIP[] = {"first", "second"},
                             *const OTHER[] = {"poles", "sign"}, *const EVIDENCE[] = {"voltage", "torque"},
                             *const GAP[] = {"inertia", "speed"}, *const UNTOLD[] = {"offset", "unit"},
                             *const OF[] = {"motor", "b.csv", "c.csv"};
    lists(json, "runs", NULL, RUN, 3);
    lists(json, "findings", "slip", SLIP, 2);
    lists(json, "evidence", "name", EVIDENCE, 2);
    lists(json, "unchecked", "name", GAP, 2);
    lists(json, "untold", NULL, UNTOLD, 2);
    lists(json, "remarks", "run", OF, 3);
    const cJSON *const findings = cJSON_GetObjectItem(json, "findings");
    lists(cJSON_GetArrayItem(findings, 0), "alternatives", NULL, OTHER, 2);
    lists(cJSON_GetArrayItem(findings, 1), "alternatives", NULL, NULL, 0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_entry_is_there);
    return UNITY_END();
}
