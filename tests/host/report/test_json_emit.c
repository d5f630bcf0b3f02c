/* What has been emitted, read back from the JSON by the parser of cJSON: each figure under its name, in its
 * unit. */
#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

#include "hci/host/report/summary.h"
#include "unity.h"

static cJSON *json;

void setUp(void)
{
    json = NULL;
}

void tearDown(void)
{
    cJSON_Delete(json);
}

static void parse(char *text)
{
    TEST_ASSERT_NOT_NULL(text);
    cJSON_Delete(json);
    json = cJSON_Parse(text);
    hci_text_free(text);
    TEST_ASSERT_NOT_NULL(json);
    TEST_ASSERT_EQUAL_STRING("emit", cJSON_GetObjectItem(json, "command")->valuestring);
}

typedef struct {
    const char *name;
    double value; /* NAN: null */
} figure;

static void has(const cJSON *object, const figure *f, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        const cJSON *item = cJSON_GetObjectItem(object, f[k].name);
        TEST_ASSERT_NOT_NULL_MESSAGE(item, f[k].name);
        TEST_ASSERT_TRUE_MESSAGE(isnan(f[k].value) ? cJSON_IsNull(item) : cJSON_IsNumber(item), f[k].name);
        if (!isnan(f[k].value))
            TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-12 * fabs(f[k].value), f[k].value, item->valuedouble,
                                              f[k].name);
    }
}

static void says(const cJSON *object, const char *name, const char *text)
{
    const cJSON *item = cJSON_GetObjectItem(object, name);
    TEST_ASSERT_NOT_NULL_MESSAGE(item, name);
    TEST_ASSERT_EQUAL_STRING_MESSAGE(text, item->valuestring, name);
}

static const cJSON *entry(const char *list, int at, int count)
{
    const cJSON *entries = cJSON_GetObjectItem(json, list);
    TEST_ASSERT_EQUAL_MESSAGE(count, cJSON_GetArraySize(entries), list);
    return cJSON_GetArrayItem(entries, at);
}

static void test_a_table(void)
{
    const hci_emit_request request = {.name = "smooth", .frame = HCI_TABLE_DQ};
    hci_emit_result r = {.chosen = {HCI_EMIT_Q15, HCI_EMIT_CUBIC, true, 24, 108, 0.011, 71, 142},
                         .choices = 2,
                         .columns = 2,
                         .parts = 1,
                         .period_turns = 7,
                         .sectors = 6,
                         .unit_A = 3.5e-4,
                         .peak_A = 11.5,
                         .crc32 = 0xFEDCBA98u,
                         .ripples = 2};
    r.choice[0] = (hci_emit_choice){HCI_EMIT_F32, HCI_EMIT_LINEAR, false, 96, 776, 0.013, 52, 505};
    r.choice[1] = r.chosen;
    r.ripple[0] = (hci_table_ripple){0.0, 0.5, 0.25, 0.0625};
    r.ripple[1] = (hci_table_ripple){-2.5, 0.75, 0.125, 0.03125};
    parse(hci_emit_json(&request, &r));
    static const figure ALL[] = {{"points", 24},
                                 {"bytes", 108},
                                 {"max_error_A", 0.011},
                                 {"instructions_cortex_m4f", 71},
                                 {"instructions_cortex_m0_plus", 142},
                                 {"columns", 2},
                                 {"parts", 1},
                                 {"period_electrical_turns", 7},
                                 {"sectors", 6},
                                 {"unit_A", 3.5e-4},
                                 {"peak_A", 11.5},
                                 {"crc32", 4275878552.0}},
                        FIRST[] = {{"points", 96},
                                   {"bytes", 776},
                                   {"max_error_A", 0.013},
                                   {"instructions_cortex_m4f", 52},
                                   {"instructions_cortex_m0_plus", 505}},
                        AT[2][4] = {{{"torque_Nm", 0},
                                     {"sine_peak_to_peak_Nm", 0.5},
                                     {"table_peak_to_peak_Nm", 0.25},
                                     {"table_own_peak_to_peak_Nm", 0.0625}},
                                    {{"torque_Nm", -2.5},
                                     {"sine_peak_to_peak_Nm", 0.75},
                                     {"table_peak_to_peak_Nm", 0.125},
                                     {"table_own_peak_to_peak_Nm", 0.03125}}};
    has(json, ALL, sizeof ALL / sizeof *ALL);
    says(json, "name", "smooth");
    says(json, "frame", "dq");
    says(json, "format", "q15");
    says(json, "shape", "cubic");
    has(entry("choices", 0, 2), FIRST, sizeof FIRST / sizeof *FIRST);
    says(entry("choices", 0, 2), "format", "f32");
    says(entry("choices", 0, 2), "shape", "linear");
    TEST_ASSERT_TRUE(cJSON_IsFalse(cJSON_GetObjectItem(entry("choices", 0, 2), "fits")));
    TEST_ASSERT_TRUE(cJSON_IsTrue(cJSON_GetObjectItem(entry("choices", 1, 2), "fits")));
    for (int k = 0; k < 2; ++k)
        has(entry("ripple", k, 2), AT[k], 4);
    const hci_emit_request phases = {.name = "smooth", .frame = HCI_TABLE_ABC};
    parse(hci_emit_json(&phases, &r));
    says(json, "frame", "abc");
}

/* Speeds in rpm; those beyond all are null. */
static void test_a_loop(void)
{
    const hci_emit_loop_request request = {.name = "loop"};
    const hci_emit_loop_result r = {
        .orders = 9,
        .levels = 3,
        .points = 192,
        .repeats = 12,
        .period_turns = 2,
        .highest_order = 24.5,
        .flash_bytes = 1000,
        .ram_bytes = 2000,
        .feedforward_ram_bytes = 3000,
        .max_error_A = 0.01,
        .peak_A = 12.5,
        .torque_low_Nm = -2.0,
        .torque_high_Nm = 3.0,
        .coarse_mean_Nm = 2.75,
        .dc_link_V = 48.0,
        .lead_s = 2.5e-4,
        .voltage_rad_per_s = 100.0,
        .sampled_rad_per_s = 50.0,
        .measured_rad_per_s = HUGE_VAL,
        .response_error = 0.02,
        .response_ripple_percent = 1.5,
        .response_rad_per_s = 30.0,
        .between = {.mean_off_Nm = 0.1, .mean_at_Nm = 0.2, .ripple_Nm = 0.3, .ripple_at_Nm = 0.4},
        .crc32 = 7};
    static const double RPM = 9.549296585513721; /* of 1 rad/s */
    const figure ALL[] = {{"orders", 9},
                          {"levels", 3},
                          {"points", 192},
                          {"repeats", 12},
                          {"period_electrical_turns", 2},
                          {"highest_order", 24.5},
                          {"flash_bytes", 1000},
                          {"ram_bytes", 2000},
                          {"feedforward_ram_bytes", 3000},
                          {"max_error_A", 0.01},
                          {"peak_A", 12.5},
                          {"torque_low_Nm", -2},
                          {"torque_high_Nm", 3},
                          {"coarse_angle_mean_Nm", 2.75},
                          {"dc_link_V", 48},
                          {"lead_s", 2.5e-4},
                          {"voltage_rpm", 100.0 * RPM},
                          {"sampled_rpm", 50.0 * RPM},
                          {"measured_rpm", NAN},
                          {"response_error", 0.02},
                          {"response_ripple", 1.5},
                          {"response_rpm", 30.0 * RPM},
                          {"between_mean_off_Nm", 0.1},
                          {"between_mean_at_Nm", 0.2},
                          {"between_ripple_Nm", 0.3},
                          {"between_ripple_at_Nm", 0.4},
                          {"crc32", 7}};
    parse(hci_emit_loop_json(&request, &r));
    has(json, ALL, sizeof ALL / sizeof *ALL);
    says(json, "name", "loop");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_table);
    RUN_TEST(test_a_loop);
    return UNITY_END();
}
