/* summary.json of `solve`, of a solution that is made up, read back by the parser of cJSON: every entry. */
#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

#include "hci/host/report/summary.h"
#include "unity.h"

static hci_solution s;
static hci_solved_order order[6];
static hci_limit *const limit = s.limit;
static cJSON *json;

static void read_back(hci_status verdict)
{
    char *text = hci_solution_json(&s, verdict);
    TEST_ASSERT_NOT_NULL(text);
    cJSON_Delete(json);
    json = cJSON_Parse(text);
    hci_text_free(text);
    TEST_ASSERT_NOT_NULL(json);
}

/* Orders 0, 6, 12 … of the verdicts in their order; limits of two phases that are open, and others. */
void setUp(void)
{
    static const hci_order_verdict VERDICT[6] = {HCI_ORDER_REACHED,     HCI_ORDER_FREE,
                                                 HCI_ORDER_MISSED,      HCI_ORDER_PARASITIC,
                                                 HCI_ORDER_UNREACHABLE, HCI_ORDER_REACHED};
    memset(&s, 0, sizeof s);
    memset(order, 0, sizeof order);
    for (int k = 0; k < 6; ++k) {
        order[k].torque_Nm.order = 6.0 * k;
        order[k].error_Nm = 0.25 * k;
        order[k].verdict = VERDICT[k];
    }
    order[0].torque_Nm.cosine = 2.5;
    order[4].remedy = (hci_component){23.0, -1};
    s.order = order;
    s.order_count = 6;
    strcpy(s.machine.name, "hub");
    strcpy(s.machine.digest, "abc");
}

void tearDown(void)
{
    cJSON_Delete(json);
    json = NULL;
}

static const cJSON *entry(const char *object, const char *name)
{
    const cJSON *of = object ? cJSON_GetObjectItem(json, object) : json;
    const cJSON *x = cJSON_GetObjectItem(of, name);
    TEST_ASSERT_NOT_NULL_MESSAGE(x, name);
    return x;
}

/* NAN: null. */
static void is(const char *object, const char *name, double expected)
{
    const cJSON *x = entry(object, name);
    TEST_ASSERT_EQUAL_MESSAGE(isnan(expected), cJSON_IsNull(x), name);
    if (!isnan(expected)) TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(expected, x->valuedouble, name);
}

static void is_text(const char *object, const char *name, const char *expected)
{
    TEST_ASSERT_EQUAL_STRING_MESSAGE(expected, entry(object, name)->valuestring, name);
}

static void is_true(const char *object, const char *name, bool expected)
{
    TEST_ASSERT_EQUAL_MESSAGE(expected, cJSON_IsTrue(entry(object, name)), name);
}

static void test_what_it_is_of(void)
{
    for (int reached = 0; reached < 2; ++reached) {
        read_back(reached ? HCI_OK : HCI_NOT_REACHED);
        is_text(NULL, "command", "solve");
        is_true(NULL, "reached", reached);
        is_text("machine", "name", "hub");
        is_text("machine", "digest", "abc");
    }
}

static void test_the_system(void)
{
    s.rows = 7, s.unknowns = 8, s.rank = 5, s.condition = 12.5, s.newton_change = 1e-9;
    for (int k = 0; k < 3; ++k) {
        s.newton_steps = k > 0 ? 4 : 0;
        s.newton_converged = k == 2;
        read_back(HCI_OK);
        is_text("system", "method", hci_method_name(s.method));
        is("system", "rows", 7.0);
        is("system", "unknowns", 8.0);
        is("system", "rank", 5.0);
        is("system", "condition", 12.5);
        is("system", "newton_steps", k > 0 ? 4.0 : 0.0);
        is("system", "newton_change", 1e-9);
        is_true("system", "newton_converged", k != 1);
    }
}

/* Ranges as many as are kept, and how many there are. */
static void test_angles_without_a_current(void)
{
    s.least_iq_A = 0.125;
    for (size_t k = 0; k < HCI_MOST_GAPS; ++k)
        s.gap[k] = (hci_angle_gap){(double)k, (double)k + 0.5};
    for (size_t count = HCI_MOST_GAPS - 1; count <= HCI_MOST_GAPS + 1; ++count) {
        s.gap_count = count;
        read_back(HCI_OK);
        const cJSON *ranges = entry("angles_without_current", "ranges_rad");
        const int kept = count < HCI_MOST_GAPS ? (int)count : HCI_MOST_GAPS;
        TEST_ASSERT_EQUAL_INT(kept, cJSON_GetArraySize(ranges));
        for (int k = 0; k < kept; ++k)
            for (int end = 0; end < 2; ++end)
                TEST_ASSERT_EQUAL_DOUBLE(k + 0.5 * end,
                                         cJSON_GetArrayItem(cJSON_GetArrayItem(ranges, k), end)->valuedouble);
        is("angles_without_current", "count", (double)count);
        is("angles_without_current", "least_iq_A", 0.125);
    }
}

static void has_orders(const char *name, const double *expected, int count, bool is_good)
{
    const cJSON *x = entry("torque", name);
    TEST_ASSERT_EQUAL_INT_MESSAGE(count, cJSON_GetArraySize(x), name);
    for (int k = 0; k < count; ++k) {
        const cJSON *one = cJSON_GetArrayItem(x, k);
        if (!is_good) {
            TEST_ASSERT_EQUAL_DOUBLE(expected[k] / 24.0, cJSON_GetObjectItem(one, "error_Nm")->valuedouble);
            TEST_ASSERT_NOT_NULL(cJSON_GetObjectItem(one, "verdict"));
            one = cJSON_GetObjectItem(one, "order");
        }
        TEST_ASSERT_EQUAL_DOUBLE(expected[k], one->valuedouble);
    }
}

static void test_the_torque(void)
{
    s.T_ripple_percent = 1.5, s.T_ripple_before_percent = 9.0, s.worst_error_Nm = 0.75, s.worst_order = 18.0;
    s.tolerance_Nm = 1e-6, s.period_turns = 3;
    read_back(HCI_OK);
    is("torque", "mean_Nm", 2.5);
    is("torque", "T_ripple_percent", 1.5);
    is("torque", "T_ripple_before_percent", 9.0);
    is("torque", "worst_error_Nm", 0.75);
    is("torque", "worst_order", 18.0);
    is("torque", "tolerance_Nm", 1e-6);
    is("torque", "period_electrical_turns", 3.0);
    has_orders("reached_orders", (const double[]){0.0, 30.0}, 2, true);
    has_orders("free_orders", (const double[]){6.0}, 1, true);
    has_orders("missed_orders", (const double[]){12.0}, 1, false);
    has_orders("parasitic_orders", (const double[]){18.0}, 1, false);
    has_orders("unreachable_orders", (const double[]){24.0}, 1, false);
    s.order = order + 1; /* without a mean */
    s.order_count = 5;
    read_back(HCI_OK);
    is("torque", "mean_Nm", 0.0);
    s.order_count = 0;
    read_back(HCI_OK);
    is("torque", "mean_Nm", 0.0);
}

/* What would reach an order, by its set. */
static void test_remedies(void)
{
    static const char *const SETS[] = {"neg", "zero", "pos"};
    for (int sequence = -1; sequence <= 1; ++sequence) {
        order[4].remedy = (hci_component){23.0, sequence};
        read_back(HCI_OK);
        const cJSON *remedy =
            cJSON_GetObjectItem(cJSON_GetArrayItem(entry("torque", "unreachable_orders"), 0), "remedy");
        TEST_ASSERT_EQUAL_DOUBLE(23.0, cJSON_GetObjectItem(remedy, "order")->valuedouble);
        TEST_ASSERT_EQUAL_STRING(SETS[sequence + 1], cJSON_GetObjectItem(remedy, "set")->valuestring);
    }
    TEST_ASSERT_NULL(cJSON_GetObjectItem(cJSON_GetArrayItem(entry("torque", "missed_orders"), 0), "remedy"));
}

static void test_the_current(void)
{
    s.current.count = 4, s.peak_phase_current_A = 11.0, s.rms_phase_current_A = 7.0,
    s.peak_line_voltage_V = 30.0;
    s.within_limits = true, s.torque_at_limit_Nm = 3.5, s.mean_square_A2 = 147.0, s.plain_amplitude_A = 9.0;
    s.loss_to_plain = 1.25, s.limit_mean_square_A2 = 140.0, s.loss_to_limit = 1.05;
    s.rms_neutral_A = (double)NAN;
    read_back(HCI_OK);
    TEST_ASSERT_NULL(cJSON_GetObjectItem(cJSON_GetObjectItem(json, "current"), "peak_neutral_A"));
    is("current", "components", 4.0);
    is("current", "peak_phase_A", 11.0);
    is("current", "rms_phase_A", 7.0);
    is("current", "peak_line_voltage_V", 30.0);
    is_true("current", "within_limits", true);
    is("current", "torque_at_limit_Nm", 3.5);
    is("current", "mean_square_A2", 147.0);
    is("current", "plain_amplitude_A", 9.0);
    is("current", "loss_ratio_to_plain", 1.25);
    is("current", "limit_mean_square_A2", 140.0);
    is("current", "loss_ratio_to_limit", 1.05);
    s.rms_neutral_A = 0.5, s.peak_neutral_A = 0.75;
    read_back(HCI_OK);
    is("current", "rms_neutral_A", 0.5);
    is("current", "peak_neutral_A", 0.75);
}

/* ---- limits ---- */

static void set_limits(void)
{
    limit[0] = (hci_limit){.kind = HCI_LIMIT_CURRENT, .phase = 1, .limit = 0.0};
    limit[1] = (hci_limit){.kind = HCI_LIMIT_CURRENT, .phase = 2, .limit = 0.0, .value = 1.0};
    limit[2] = (hci_limit){
        .kind = HCI_LIMIT_CURRENT, .phase = 0, .limit = 9.0, .value = 8.0, .binds = true, .gain = 0.5};
    limit[3] = (hci_limit){.kind = HCI_LIMIT_COPPER, .phase = 0, .limit = 20.0, .is_declared = true};
    limit[3].touch_count = 2;
    limit[3].touch[0].theta_rad = 1.25;
    limit[3].touch[1].theta_rad = 2.5;
    s.limit_count = 4;
}

static void test_phases_that_are_open(void)
{
    read_back(HCI_OK);
    is_text("limits", "open_phases", "");
    is("limits", "phase_current_A", (double)NAN);
    set_limits();
    read_back(HCI_OK);
    is_text("limits", "open_phases", "bc");
    is("limits", "phase_current_A", 9.0);
    s.limit_count = 1;
    read_back(HCI_OK);
    is_text("limits", "open_phases", "b");
    is("limits", "phase_current_A", 0.0);
    set_limits();
    limit[2].limit = 0.0;
    limit[4] = limit[2];
    s.limit_count = 5;
    read_back(HCI_OK);
    is_text("limits", "open_phases", "bca"); /* of a fourth there is no room, and none can be */
}

static void test_each_limit(void)
{
    set_limits();
    read_back(HCI_OK);
    const cJSON *list = entry("limits", "limit");
    TEST_ASSERT_EQUAL_INT(4, cJSON_GetArraySize(list));
    for (int k = 0; k < 4; ++k) {
        const cJSON *x = cJSON_GetArrayItem(list, k);
        TEST_ASSERT_EQUAL_STRING(hci_limit_kind_name(limit[k].kind),
                                 cJSON_GetObjectItem(x, "kind")->valuestring);
        TEST_ASSERT_EQUAL_STRING(k < 3 ? hci_limit_place_name(&limit[k], limit[k].phase) : "all",
                                 cJSON_GetObjectItem(x, "phase")->valuestring);
        TEST_ASSERT_EQUAL_DOUBLE(limit[k].limit, cJSON_GetObjectItem(x, "limit")->valuedouble);
        TEST_ASSERT_EQUAL_DOUBLE(limit[k].value, cJSON_GetObjectItem(x, "value")->valuedouble);
        TEST_ASSERT_EQUAL_DOUBLE(limit[k].gain, cJSON_GetObjectItem(x, "gain")->valuedouble);
        TEST_ASSERT_EQUAL(k == 3, cJSON_IsTrue(cJSON_GetObjectItem(x, "declared")));
        TEST_ASSERT_EQUAL(k == 2, cJSON_IsTrue(cJSON_GetObjectItem(x, "binds")));
        TEST_ASSERT_EQUAL_DOUBLE(k == 3 ? 2.0 : 0.0, cJSON_GetObjectItem(x, "touches")->valuedouble);
        TEST_ASSERT_EQUAL_INT(k == 3 ? 2 : 0, cJSON_GetArraySize(cJSON_GetObjectItem(x, "touched_at")));
    }
    const cJSON *at = cJSON_GetObjectItem(cJSON_GetArrayItem(list, 3), "touched_at");
    for (int k = 0; k < 2; ++k) {
        const cJSON *x = cJSON_GetArrayItem(at, k);
        TEST_ASSERT_EQUAL_DOUBLE(k ? 2.5 : 1.25, cJSON_GetObjectItem(x, "theta_e_rad")->valuedouble);
        TEST_ASSERT_EQUAL_STRING("all", cJSON_GetObjectItem(x, "phase")->valuestring);
    }
    limit[0].phase = -1;
    read_back(HCI_OK);
    TEST_ASSERT_EQUAL_STRING(
        "all", cJSON_GetObjectItem(cJSON_GetArrayItem(entry("limits", "limit"), 0), "phase")->valuestring);
}

/* Touches as many as are kept, and how many there are. */
static void test_many_touches(void)
{
    for (size_t count = HCI_MOST_TOUCHES; count <= HCI_MOST_TOUCHES + 1; ++count) {
        set_limits();
        limit[0].touch_count = count;
        read_back(HCI_OK);
        const cJSON *x = cJSON_GetArrayItem(entry("limits", "limit"), 0);
        TEST_ASSERT_EQUAL_INT(HCI_MOST_TOUCHES, cJSON_GetArraySize(cJSON_GetObjectItem(x, "touched_at")));
        TEST_ASSERT_EQUAL_DOUBLE((double)count, cJSON_GetObjectItem(x, "touches")->valuedouble);
    }
}

static void test_what_the_limits_cost(void)
{
    static const char *const MINIMISED[] = {"", "worst", "peak-to-peak", "rms"};
    s.wanted_mean_Nm = 4.0, s.minimised_Nm = 0.25, s.exceeded_share = 0.125;
    for (int k = 0; k < 4; ++k) {
        s.minimised = (hci_minimise)k;
        s.within_limits = k % 2 == 0;
        s.limit_cost = HCI_COST_NONE;
        read_back(HCI_OK);
        is_text("limits", "minimised", MINIMISED[k]);
        is_text("limits", "cost", k % 2 ? "not kept" : hci_limit_cost_name(HCI_COST_NONE));
        is("limits", "wanted_mean_Nm", 4.0);
        is("limits", "minimised_Nm", 0.25);
        is("limits", "exceeded_share", 0.125);
    }
    s.within_limits = false;
    s.limit_cost = HCI_COST_LIMITS;
    read_back(HCI_OK);
    is_text("limits", "cost", hci_limit_cost_name(HCI_COST_LIMITS));
}

/* ---- the loop ---- */

static void test_the_current_loop(void)
{
    s.loop = (hci_loop_reach){.allowed_Nm = 0.5,
                              .rpm_per_Hz = 2.0,
                              .lead_rpm_per_Hz = 6.0,
                              .bandwidth_Hz = 300.0,
                              .speed_rpm = 900.0,
                              .added_Nm = 0.25,
                              .lead_added_Nm = 0.125,
                              .leaves_out_back_emf = true};
    read_back(HCI_OK);
    is("current_loop", "adds_Nm", 0.5);
    is("current_loop", "rpm_per_Hz", 2.0);
    is("current_loop", "read_ahead_rpm_per_Hz", 6.0);
    is("current_loop", "bandwidth_Hz", 300.0);
    is("current_loop", "speed_rpm", 900.0);
    is("current_loop", "adds_at_speed_Nm", 0.25);
    is("current_loop", "read_ahead_adds_at_speed_Nm", 0.125);
    is_true("current_loop", "leaves_out_back_emf", true);
    is_true("current_loop", "at_any_speed", false);
    s.loop.added_Nm = (double)NAN;
    s.loop.bandwidth_Hz = 0.0;
    s.loop.rpm_per_Hz = HUGE_VAL;
    read_back(HCI_OK);
    is("current_loop", "speed_rpm", (double)NAN);
    is("current_loop", "bandwidth_Hz", (double)NAN);
    is_true("current_loop", "at_any_speed", true);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_it_is_of);
    RUN_TEST(test_the_system);
    RUN_TEST(test_angles_without_a_current);
    RUN_TEST(test_the_torque);
    RUN_TEST(test_remedies);
    RUN_TEST(test_the_current);
    RUN_TEST(test_phases_that_are_open);
    RUN_TEST(test_each_limit);
    RUN_TEST(test_many_touches);
    RUN_TEST(test_what_the_limits_cost);
    RUN_TEST(test_the_current_loop);
    return UNITY_END();
}
