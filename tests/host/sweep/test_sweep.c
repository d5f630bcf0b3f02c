/* Sweeps against closed forms: the envelope of a sinusoidal machine without resistance is the circle of the
 * current and the ellipse of the voltage; torque and ripple are monotone in the limits; a point of a map is
 * what hci_solve finds; and what is kept in a folder is what was solved. */
#include "hci/host/sweep/sweep.h"

#include <math.h>
#include <string.h>

#include "hci/host/sweep/progress_file.h"
#include "support/files.h"
#include "unity.h"

#define K_E   0.2 /* V·s/rad */
#define L_H   4e-3
#define I_A   10.0
#define U_V   60.0
#define PAIRS 3

static hci_machine_data machine;
static hci_wave emf[3];
static hci_harmonic cogging[1];
static hci_component component[] = {{1.0, 1}, {5.0, -1}, {7.0, 1}};
static hci_set name[] = {HCI_SET_POS, HCI_SET_NEG, HCI_SET_POS};
static hci_component_set set;
static hci_solve_options options;
static hci_grid_request request;
static double value[8];

void setUp(void)
{
    files_begin();
    memset(&machine, 0, sizeof machine);
    memset(&options, 0, sizeof options);
    emf[0] = (hci_wave){1.0, 1, K_E, 0.0};
    emf[1] = (hci_wave){5.0, -1, 0.1 * K_E, 0.0};
    emf[2] = (hci_wave){7.0, 1, -0.05 * K_E, 0.02 * K_E};
    machine.model =
        (hci_machine){.pole_pairs = PAIRS, .back_emf = emf, .back_emf_count = 1, .cogging = cogging};
    machine.pole_pairs = PAIRS;
    machine.resistance_ohm = 0.0;
    machine.inductance_d_H = machine.inductance_q_H = L_H;
    machine.dc_link_voltage_V = machine.max_current_A = machine.rated_current_A = NAN;
    set = (hci_component_set){component, name, 1, {{0}}};
    options.set = &set;
    options.limit_current_A = I_A;
    options.limit_voltage_V = U_V;
    request = (hci_grid_request){.kind = HCI_GRID_ENVELOPE, .machine = &machine, .options = &options};
}

void tearDown(void)
{
    files_end();
}

/* Back-EMF with harmonics, and currents of the same orders. */
static void use_harmonics(void)
{
    machine.model.back_emf_count = 3;
    set.count = 3;
}

static hci_grid_point point_at(double torque_Nm, double speed_rad_per_s)
{
    return (hci_grid_point){torque_Nm, speed_rad_per_s, NAN, NAN, NAN};
}

static hci_grid_row solve(hci_grid_point point)
{
    hci_grid_row row;
    hci_grid_solve(&request, &point, &row);
    TEST_ASSERT_EQUAL_STRING("", row.reason);
    return row;
}

/* ---- what is said of limits ---- */

static void test_limits_are_said_phase_by_phase(void)
{
    char text[HCI_GRID_WORDS_SIZE];
    options.limits.rms_A[0] = 3.0;
    options.limits.rms_A[2] = 5.0;
    hci_grid_limits_words(&request, text);
    TEST_ASSERT_EQUAL_STRING(
        "phase current at most 10 A; rms current a at most 3 A; rms current c at most 5 A; "
        "line voltage at most 60 V",
        text);
    options.limits.rms_A[2] = options.limits.rms_A[1] = 3.0;
    options.limit_current_A = 0.0;
    hci_grid_limits_words(&request, text);
    TEST_ASSERT_EQUAL_STRING("rms current at most 3 A; line voltage at most 60 V", text);
    options.limits.rms_A[0] = options.limits.rms_A[2] = 0.0;
    hci_grid_limits_words(&request, text);
    TEST_ASSERT_EQUAL_STRING("rms current b at most 3 A; line voltage at most 60 V", text);
}

/* ---- the envelope ---- */

/* Below: at the corner of circle and ellipse (ω ψ + ω L i_d)² + (ω L i_q)² = U²/3; beyond i_d = −ψ/L, which
 * the current does for with L = 12 mH: i_q = U/(√3 ω L). */
static double closed_form_Nm(double speed_rad_per_s, double inductance_H)
{
    const double w = PAIRS * speed_rad_per_s, psi = K_E / PAIRS, v = U_V / sqrt(3.0) / w;
    double d = (v * v - psi * psi - inductance_H * inductance_H * I_A * I_A) / (2.0 * psi * inductance_H);
    if (d > 0.0) return 1.5 * K_E * I_A;
    if (d >= -psi / inductance_H) return 1.5 * K_E * sqrt(I_A * I_A - d * d);
    return 1.5 * K_E * v / inductance_H;
}

static void check_envelope(double inductance_H)
{
    static const double SPEED[] = {20.0, 100.0, 150.0, 165.0, 200.0, 260.0, 320.0, 400.0};
    machine.inductance_d_H = machine.inductance_q_H = inductance_H;
    for (size_t k = 0; k < sizeof SPEED / sizeof SPEED[0]; ++k) {
        const hci_grid_row row = solve(point_at(NAN, SPEED[k]));
        const double expected = closed_form_Nm(SPEED[k], inductance_H);
        TEST_ASSERT_EQUAL(HCI_GRID_REACHED, row.verdict);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5 * expected, expected, row.most.mean_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5 * expected, expected, row.sine.mean_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5 * expected, expected, row.best.mean_Nm);
        TEST_ASSERT_TRUE(row.sine.T_ripple_percent < 1e-3);
    }
}

static void test_envelope_of_circle_and_ellipse(void)
{
    check_envelope(L_H);
}

static void test_envelope_of_the_voltage_alone(void)
{
    check_envelope(12e-3);
}

/* 12 A² of all phases in place of the peak: √8 A of a sine. */
static void test_envelope_of_the_copper(void)
{
    options.limit_current_A = 0.0;
    machine.resistance_ohm = 0.5;
    options.limits.copper_W = 6.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 1.5 * K_E * sqrt(8.0), solve(point_at(NAN, 10.0)).most.mean_Nm);
}

/* Order 5 is what the currents make torque of; a sine makes none, and beside it nothing can be said. */
static void test_without_a_fundamental(void)
{
    hci_note note = {{0}};
    hci_grid_span span;
    emf[0] = (hci_wave){5.0, -1, K_E, 0.0};
    component[0] = (hci_component){5.0, -1};
    name[0] = HCI_SET_NEG;
    const hci_grid_row row = solve(point_at(NAN, 5.0));
    request.kind = HCI_GRID_TRADE_OFF;
    request.torque_Nm = (hci_grid_axis){value, 1};
    value[0] = 1.0;
    const hci_status status = hci_grid_span_find(&request, &span, &note);
    component[0] = (hci_component){1.0, 1};
    name[0] = HCI_SET_POS;
    TEST_ASSERT_EQUAL(HCI_GRID_REACHED, row.verdict);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5 * K_E * I_A, 1.5 * K_E * I_A, row.most.mean_Nm);
    TEST_ASSERT_FALSE(row.sine.mean_Nm > 0.0);
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, status);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "a sine makes no torque"), note.text);
}

static void test_an_envelope_needs_a_limit_of_the_current(void)
{
    const hci_grid_point point = point_at(NAN, 10.0);
    hci_grid_row row;
    options.limit_current_A = 0.0;
    hci_grid_solve(&request, &point, &row);
    TEST_ASSERT_EQUAL(HCI_GRID_FAILED, row.verdict);
    TEST_ASSERT_NOT_NULL(strstr(row.reason, "current"));
}

/* At L i_d = −ψ the ellipse is still not reached with 2 A. */
static void test_a_speed_that_no_current_reaches(void)
{
    options.limit_current_A = 2.0;
    TEST_ASSERT_EQUAL(HCI_GRID_LIMITS, solve(point_at(NAN, 400.0)).verdict);
}

/* With 1 % of ripple less than with any; the torque found has it, 1 % more torque has more. */
static void test_the_largest_torque_with_little_ripple(void)
{
    hci_grid_row row, beyond;
    use_harmonics();
    row = solve(point_at(NAN, 160.0));
    TEST_ASSERT_EQUAL(HCI_GRID_REACHED, row.verdict);
    TEST_ASSERT_TRUE(row.best.T_ripple_percent <= 1.0 && row.most.T_ripple_percent > 1.0);
    TEST_ASSERT_TRUE(row.best.mean_Nm < row.most.mean_Nm && row.sine.mean_Nm <= row.most.mean_Nm);
    request.kind = HCI_GRID_MAP;
    beyond = solve(point_at(1.01 * row.best.mean_Nm, 160.0));
    TEST_ASSERT_TRUE(beyond.best.T_ripple_percent > 1.0);
}

static void test_wider_limits_give_no_less_torque(void)
{
    double before_Nm = 0.0, before_best_Nm = 0.0;
    use_harmonics();
    for (int k = 0; k < 5; ++k) {
        options.limit_current_A = 7.0 + k;
        options.limit_voltage_V = 54.0 + 4.0 * k;
        const hci_grid_row row = solve(point_at(NAN, 180.0));
        TEST_ASSERT_TRUE(row.most.mean_Nm >= before_Nm && row.best.mean_Nm >= 0.998 * before_best_Nm);
        before_Nm = row.most.mean_Nm;
        before_best_Nm = row.best.mean_Nm;
    }
}

/* ---- the trade-off ---- */

static hci_grid_plan plan_trade_off(void)
{
    hci_grid_plan plan;
    hci_grid_span span;
    hci_note note = {{0}};
    value[0] = 2.0;
    request.kind = HCI_GRID_TRADE_OFF;
    request.torque_Nm = (hci_grid_axis){value, 1};
    options.limit_current_A = options.limit_voltage_V = 0.0;
    options.minimise = HCI_MINIMISE_PEAK_TO_PEAK;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_grid_span_find(&request, &span, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_grid_plan_make(&request, &span, &plan, &note), note.text);
    return plan;
}

/* Ripple falls from the first limit at which the torque is reached to none; every limit is kept. */
static void check_curve(const hci_grid_plan *plan, size_t from, size_t to)
{
    double before_percent = HUGE_VAL;
    size_t reached = 0;
    for (size_t k = from; k < to; ++k) {
        hci_grid_row row;
        hci_grid_solve(&request, &plan->point[k], &row);
        TEST_ASSERT_TRUE_MESSAGE(row.verdict != HCI_GRID_FAILED, row.reason);
        TEST_ASSERT_FALSE(row.best.peak_A > row.point.limit_current_A);
        TEST_ASSERT_FALSE(row.best.loss_to_plain > row.point.limit_copper * (1.0 + 1e-9));
        if (row.verdict > HCI_GRID_RIPPLE) {
            TEST_ASSERT_EQUAL(0, reached);
            continue;
        }
        ++reached;
        TEST_ASSERT_TRUE(row.best.T_ripple_percent <= before_percent + 1e-3);
        before_percent = row.best.T_ripple_percent;
    }
    TEST_ASSERT_TRUE(reached >= 5);
    TEST_ASSERT_TRUE(before_percent < 1e-6);
}

static void test_ripple_falls_as_the_limits_widen(void)
{
    hci_grid_plan plan;
    use_harmonics();
    plan = plan_trade_off();
    TEST_ASSERT_TRUE(plan.by_current > 10 && plan.count > plan.by_current + 3);
    check_curve(&plan, 0, plan.by_current);
    check_curve(&plan, plan.by_current, plan.count);
    hci_grid_plan_release(&plan);
}

static void test_the_plain_sine_is_beside_it(void)
{
    hci_grid_plan plan;
    use_harmonics();
    plan = plan_trade_off();
    const hci_grid_row row = solve(plan.point[plan.by_current - 1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0 / (1.5 * K_E), row.sine.peak_A);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0, row.sine.mean_Nm);
    TEST_ASSERT_TRUE(row.sine.T_ripple_percent > 10.0);
    hci_grid_plan_release(&plan);
}

/* ---- the map ---- */

static void test_a_point_of_a_map_is_what_solve_finds(void)
{
    static const double TORQUE_NM[] = {0.5, 2.0, 2.8, 3.5};
    hci_note note = {{0}};
    request.kind = HCI_GRID_MAP;
    use_harmonics();
    for (size_t k = 0; k < sizeof TORQUE_NM / sizeof TORQUE_NM[0]; ++k) {
        const hci_grid_row row = solve(point_at(TORQUE_NM[k], 160.0));
        hci_target_order mean = {{0.0, 0.0, TORQUE_NM[k]}, 1.0};
        const hci_target target = {&mean, 1};
        hci_solve_options o = options;
        hci_solution s;
        o.target = &target;
        o.speed_rad_per_s = 160.0;
        TEST_ASSERT_TRUE(hci_solve(&machine, &o, &s, &note) <= HCI_NOT_REACHED);
        TEST_ASSERT_EQUAL_DOUBLE(s.order[0].torque_Nm.cosine, row.best.mean_Nm);
        TEST_ASSERT_EQUAL_DOUBLE(s.worst_error_Nm, row.best.worst_Nm);
        TEST_ASSERT_EQUAL_DOUBLE(s.peak_phase_current_A, row.best.peak_A);
        TEST_ASSERT_EQUAL_DOUBLE(s.peak_line_voltage_V, row.best.line_V);
        TEST_ASSERT_EQUAL_DOUBLE(s.mean_square_A2, row.best.mean_square_A2);
        hci_solution_release(&s);
    }
}

static void test_the_order_of_a_map(void)
{
    static const double TORQUE_NM[] = {1.0, 2.0}, SPEED[] = {10.0, 20.0, 30.0}, LINK_V[] = {50.0, 60.0};
    hci_grid_plan plan;
    hci_note note = {{0}};
    request.kind = HCI_GRID_MAP;
    request.torque_Nm = (hci_grid_axis){TORQUE_NM, 2};
    request.speed_rad_per_s = (hci_grid_axis){SPEED, 3};
    request.link_V = (hci_grid_axis){LINK_V, 2};
    TEST_ASSERT_EQUAL(HCI_OK, hci_grid_plan_make(&request, NULL, &plan, &note));
    TEST_ASSERT_EQUAL(12, plan.count);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, plan.point[9].torque_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(20.0, plan.point[9].speed_rad_per_s);
    TEST_ASSERT_EQUAL_DOUBLE(60.0, plan.point[9].link_V);
    hci_grid_plan_release(&plan);
    request.torque_Nm.count = 0;
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, hci_grid_plan_make(&request, NULL, &plan, &note));
}

/* ---- what is kept ---- */

static void begin(hci_grid *sweep)
{
    static const double SPEED[] = {10.0, 20.0, 30.0};
    hci_grid_plan plan;
    hci_note note = {{0}};
    request.speed_rad_per_s = (hci_grid_axis){SPEED, 3};
    TEST_ASSERT_EQUAL(HCI_OK, hci_grid_plan_make(&request, NULL, &plan, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_grid_begin(&request, &plan, sweep, &note));
}

static void test_points_are_read_as_they_were_written(void)
{
    hci_grid one, two;
    hci_grid_inputs inputs = {.count = 0};
    hci_note note = {{0}};
    use_harmonics();
    begin(&one);
    begin(&two);
    hci_grid_inputs_add(&inputs, "ripple", "1");
    hci_grid_inputs_add(&inputs, "speeds", "1,2,\"3\"");
    hci_grid_solve(&request, &one.plan.point[2], &one.row[2]);
    hci_grid_fail(&one.plan.point[0], "a, \"b\"\nand c", &one.row[0]);
    one.done[0] = one.done[2] = true;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_grid_keep_points(&one, &inputs, files_path("kept"), &note),
                              note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_grid_take_points(&two, &inputs, files_path("kept"), true, &note),
                              note.text);
    TEST_ASSERT_EQUAL(2, hci_grid_done(&two));
    TEST_ASSERT_FALSE(two.done[1]);
    TEST_ASSERT_EQUAL_STRING("a, \"b\" and c", two.row[0].reason);
    TEST_ASSERT_EQUAL(one.row[2].verdict, two.row[2].verdict);
    TEST_ASSERT_EQUAL_DOUBLE(one.row[2].best.mean_Nm, two.row[2].best.mean_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(one.row[2].sine.mean_Nm, two.row[2].sine.mean_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(one.row[2].most.mean_Nm, two.row[2].most.mean_Nm);
    TEST_ASSERT_TRUE(one.row[2].sine.mean_Nm < one.row[2].most.mean_Nm);
    TEST_ASSERT_EQUAL(one.row[2].most.binds[HCI_LIMIT_CURRENT], two.row[2].most.binds[HCI_LIMIT_CURRENT]);
    TEST_ASSERT_TRUE(isnan(two.row[0].best.mean_Nm));
    hci_grid_release(&one);
    hci_grid_release(&two);
}

/* A reason that is too long ends before the character that it would be cut in, whichever byte of it comes
 * last. */
static void test_long_reasons_end_between_characters(void)
{
    static const char *const MARK[] = {"\xE2\x80\x99", "\xC3\xA9", "\xF0\x9F\x98\x80", "\xE2\x88\x9A"};
    hci_grid one;
    begin(&one);
    for (size_t j = 0; j < sizeof MARK / sizeof *MARK; ++j)
        for (size_t before = HCI_GRID_REASON_SIZE - 6; before < HCI_GRID_REASON_SIZE + 2; ++before) {
            char reason[HCI_GRID_REASON_SIZE + 16] = "";
            memset(reason, 'x', before);
            strcpy(reason + before, MARK[j]);
            hci_grid_fail(&one.plan.point[0], reason, &one.row[0]);
            const size_t all = strlen(reason), kept = strlen(one.row[0].reason);
            const bool fits = all < HCI_GRID_REASON_SIZE;
            TEST_ASSERT_EQUAL_UINT64(fits                            ? all
                                     : before < HCI_GRID_REASON_SIZE ? before
                                                                     : HCI_GRID_REASON_SIZE - 1,
                                     kept);
            TEST_ASSERT_EQUAL_MEMORY(reason, one.row[0].reason, kept);
        }
    hci_grid_release(&one);
}

/* In place of the number of the first row. */
static void renumber(const char *number)
{
    char *text = files_read(files_path("kept/points.csv")), *row = text ? strstr(text, "\n1,") : NULL;
    FILE *file = fopen(files_path("kept/points.csv"), "w");
    TEST_ASSERT_TRUE(row != NULL && file != NULL);
    *row = '\0';
    fprintf(file, "%s\n%s,%s", text, number, row + 3);
    fclose(file);
}

/* The number of the first point in points.csv becomes another one, of which the grid of three has none or
 * another point. */
static void test_points_of_other_numbers_are_refused(void)
{
    static const char *const NUMBER[] = {"0", "-1", "2", "4", "999999999", "1e300"};
    hci_grid one, two;
    hci_grid_inputs inputs = {.count = 0};
    hci_note note = {{0}};
    begin(&one);
    hci_grid_fail(&one.plan.point[0], "why", &one.row[0]);
    one.done[0] = true;
    for (size_t k = 0; k < sizeof NUMBER / sizeof *NUMBER; ++k) {
        TEST_ASSERT_EQUAL(HCI_OK, hci_grid_keep_points(&one, &inputs, files_path("kept"), &note));
        renumber(NUMBER[k]);
        begin(&two);
        TEST_ASSERT_EQUAL_MESSAGE(
            HCI_ERROR_INPUT, hci_grid_take_points(&two, &inputs, files_path("kept"), true, &note), NUMBER[k]);
        TEST_ASSERT_EQUAL(0, hci_grid_done(&two));
        hci_grid_release(&two);
    }
    hci_grid_release(&one);
}

/* Each number of a point counts: one with another torque, speed, link or limit is of another grid. */
static void test_points_of_another_grid_are_refused(void)
{
    hci_grid one;
    hci_grid_inputs inputs = {.count = 0};
    hci_note note = {{0}};
    begin(&one);
    one.done[0] = one.done[2] = true;
    for (size_t k = 0; k < one.plan.count; ++k)
        one.row[k].point = one.plan.point[k];
    TEST_ASSERT_EQUAL(HCI_OK, hci_grid_keep_points(&one, &inputs, files_path("kept"), &note));
    for (int field = 0; field < 6; ++field) {
        hci_grid two;
        begin(&two);
        hci_grid_point *p = &two.plan.point[2];
        double *const at[] = {&p->torque_Nm, &p->speed_rad_per_s, &p->link_V, &p->limit_current_A,
                              &p->limit_copper};
        if (field < 5) *at[field] = 7.25;
        TEST_ASSERT_EQUAL(field < 5 ? HCI_ERROR_INPUT : HCI_OK,
                          hci_grid_take_points(&two, &inputs, files_path("kept"), true, &note));
        hci_grid_release(&two);
    }
    hci_grid_release(&one);
}

static void test_points_of_other_inputs_are_refused(void)
{
    hci_grid one, two;
    hci_grid_inputs inputs = {.count = 0}, other = {.count = 0};
    hci_note note = {{0}};
    begin(&one);
    begin(&two);
    hci_grid_inputs_add(&inputs, "ripple", "1");
    hci_grid_inputs_add(&other, "ripple", "2");
    TEST_ASSERT_EQUAL(HCI_OK, hci_grid_keep_points(&one, &inputs, files_path("kept"), &note));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_grid_take_points(&two, &other, files_path("kept"), true, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "`ripple` was 1, and is 2"));
    TEST_ASSERT_EQUAL(HCI_OK, hci_grid_take_points(&two, &other, files_path("none"), false, &note));
    note.text[0] = '\0';
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_grid_take_points(&two, &other, files_path("none"), true, &note));
    hci_grid_release(&one);
    hci_grid_release(&two);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_envelope_of_circle_and_ellipse);
    RUN_TEST(test_envelope_of_the_voltage_alone);
    RUN_TEST(test_envelope_of_the_copper);
    RUN_TEST(test_without_a_fundamental);
    RUN_TEST(test_an_envelope_needs_a_limit_of_the_current);
    RUN_TEST(test_a_speed_that_no_current_reaches);
    RUN_TEST(test_the_largest_torque_with_little_ripple);
    RUN_TEST(test_wider_limits_give_no_less_torque);
    RUN_TEST(test_ripple_falls_as_the_limits_widen);
    RUN_TEST(test_the_plain_sine_is_beside_it);
    RUN_TEST(test_a_point_of_a_map_is_what_solve_finds);
    RUN_TEST(test_the_order_of_a_map);
    RUN_TEST(test_points_are_read_as_they_were_written);
    RUN_TEST(test_long_reasons_end_between_characters);
    RUN_TEST(test_points_of_other_numbers_are_refused);
    RUN_TEST(test_limits_are_said_phase_by_phase);
    RUN_TEST(test_points_of_another_grid_are_refused);
    RUN_TEST(test_points_of_other_inputs_are_refused);
    return UNITY_END();
}
