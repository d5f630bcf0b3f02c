/* U of a solution against sampled torque; the residual by run and order; amplitudes by order; a log over the
 * time; mean and extremes over one turn of a simulated drive. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/plot/plot.h"
#include "host/plot/plot_drive.h"
#include "host/plot/rows.h"
#include "support/reference.h"
#include "support/texts.h"
#include "support/written.h"
#include "unity.h"

enum { MOST_BYTES = 400000 };

static const char *picture;
static hci_machine_data machine;
static hci_target target;
static hci_solution solution;
static hci_note note;

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    files_end();
}

/* ---- solutions ---- */

static void solve_begin(const char *folder_name, const char *target_name)
{
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read(folder_name, &machine, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_target_read(target_name, &target, &note), note.text);
}

static void solve_end(void)
{
    hci_solution_release(&solution);
    hci_target_release(&target);
    hci_machine_release(&machine);
}

static void solve(const char *target_name, const hci_component_set *set, hci_status expected)
{
    solve_begin("data/machine_a", target_name);
    const hci_solve_options options = {.target = &target, .set = set};
    TEST_ASSERT_EQUAL_MESSAGE(expected, hci_solve(&machine, &options, &solution, &note), note.text);
}

/* A set that reaches neither order 5 of scenario 7 nor 24, 30, 36, and has two components that nothing is
 * asked of. */
static hci_component component[] = {{5.0, -1}, {7.0, 1}, {4.0, 1}, {2.0, -1}};
static hci_set set_name[] = {HCI_SET_NEG, HCI_SET_POS, HCI_SET_POS, HCI_SET_NEG};

static void solve_poor_set(void)
{
    const hci_component_set set = {.component = component, .set = set_name, .count = 4};
    solve("data/scenarios/07/target.csv", &set, HCI_NOT_REACHED);
}

/* ---- the picture ---- */

static void draw(void (*put)(hci_output *out))
{
    hci_output *out = written_begin("p.svg");
    hci_memory_fail_after(0);
    put(out);
    hci_memory_fail_after(-1);
    picture = written_end(out, "p.svg");
    TEST_ASSERT_TRUE(strlen(picture) < MOST_BYTES);
}

static double number_after(const char *at, const char *key)
{
    at = strstr(at, key);
    TEST_ASSERT_NOT_NULL(at);
    return strtod(at + strlen(key), NULL);
}

/* The square whose middle is there, as its side; 0 where there is none. Those of the legend lie above `top`.
 */
static double side_at(const char *style, double x, double y)
{
    char key[48];
    snprintf(key, sizeof key, "<rect class=\"%s\"", style);
    for (const char *at = picture; (at = strstr(at, key)); ++at) {
        const double side = number_after(at, " width=\"");
        if (fabs(number_after(at, " x=\"") + 0.5 * side - x) < 0.02 &&
            fabs(number_after(at, " y=\"") + 0.5 * side - y) < 0.02)
            return side;
    }
    return 0.0;
}

/* ---- U against sampled torque ---- */

/* Torque of 1 A of one coordinate of a component: Σ e_s i_s, by its sine formula. */
static void sampled_column(hci_component c, bool is_cosine, ref_spectrum *spectrum)
{
    double torque[REF_SAMPLES];
    for (size_t j = 0; j < REF_SAMPLES; ++j) {
        torque[j] = 0.0;
        for (int s = 0; s < 3; ++s) {
            const ref_wave current = {c.order, c.sequence, 1.0, is_cosine ? REF_PI / 2.0 : 0.0};
            double emf = 0.0;
            for (size_t k = 0; k < machine.model.back_emf_count; ++k) {
                const hci_wave *e = &machine.model.back_emf[k];
                const ref_wave wave = {e->order, e->sequence, hypot(e->sine, e->cosine),
                                       atan2(e->cosine, e->sine)};
                emf += ref_wave_at(&wave, s, ref_theta(j, 1));
            }
            torque[j] += emf * ref_wave_at(&current, s, ref_theta(j, 1));
        }
    }
    ref_transform(torque, spectrum);
}

static double entry(size_t row, size_t column)
{
    const hci_solved_system *u = &solution.system;
    for (int64_t k = u->column_start[column]; k < u->column_start[column + 1]; ++k)
        if ((size_t)u->row[k] == row) return u->value[k];
    return 0.0;
}

static void check_system(void)
{
    for (size_t j = 0; j < 2 * solution.system.set.count; ++j) {
        ref_spectrum expected;
        size_t row = 0;
        sampled_column(solution.system.set.component[j / 2], j % 2 == 1, &expected);
        for (size_t k = 0; k < solution.order_count; ++k) {
            const size_t bin = (size_t)lround(solution.order[k].torque_Nm.order);
            if (bin > 0) TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected.sine[bin], entry(row++, j));
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected.cosine[bin], entry(row++, j));
        }
    }
}

static void test_system_is_that_of_the_torque(void)
{
    solve("data/scenarios/02/target.csv", NULL, HCI_OK);
    TEST_ASSERT_EQUAL_UINT64(solution.unknowns, 2 * solution.system.set.count);
    check_system();
    solve_end();
    solve_poor_set();
    TEST_ASSERT_EQUAL_UINT64(4 + 1, solution.system.set.count); /* and the fundamental */
    check_system();
    solve_end();
}

/* A method without U has none, and what is left of it can be released. */
static void test_no_system_angle_by_angle(void)
{
    solve_begin("data/machine_a", "data/scenarios/02/target.csv");
    const hci_solve_options options = {.target = &target, .method = HCI_METHOD_POINTWISE};
    hci_solve(&machine, &options, &solution, &note);
    TEST_ASSERT_EQUAL_UINT64(0, solution.system.set.count);
    TEST_ASSERT_NULL(solution.system.value);
    solve_end();
}

/* ---- residual by run and order ---- */

static hci_plot_map map;

static void put_map(hci_output *out)
{
    hci_plot_residuals(out, &(hci_svg_box){42.0, 66.0, 524.0, 66.0 + 2 * HCI_ROWS_HEIGHT}, &map);
}

/* Sides grow by a quarter for each decade; what is not shown is left out. */
static void test_map(void)
{
    static hci_run run[3] = {{.name = "a.csv"}, {.name = "b<.csv"}, {.name = "c.csv"}};
    static hci_role role[3] = {HCI_ROLE_FIT, HCI_ROLE_FIT, HCI_ROLE_HOLDOUT};
    static hci_residual_line line[] = {
        {.run = 0, .order = 6.0, .before_Nm = 1.0, .after_Nm = 0.01, .noise_Nm = 0.001},
        {.run = 2, .order = 12.0, .before_Nm = 0.1, .after_Nm = 0.0005, .noise_Nm = 0.001},
        {.run = 1, .order = 6.0, .before_Nm = 1.0, .after_Nm = 0.5, .noise_Nm = 0.001},
        {.run = 0, .order = 7.0, .before_Nm = 1.0, .after_Nm = 0.5, .noise_Nm = 0.001}};
    static const size_t shown[] = {0, 2};
    static const double order[] = {6.0, 12.0};
    static hci_runs runs = {.run = run, .role = role, .count = 3};
    static hci_diagnosis diagnosis = {.line = line, .lines = 4};
    map = (hci_plot_map){&diagnosis, &runs, shown, order, 2, 2};
    draw(put_map);
    const double left = 42.0 + 130.0, width = (524.0 - left) / 2.0, high = HCI_ROWS_HEIGHT,
                 y = 66.0 + 0.5 * high;
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.9 * high, side_at("before", left + 0.5 * width, y));
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.9 * high * 0.5, side_at("plus", left + 0.5 * width, y));
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.9 * high * 0.75, side_at("before", left + 1.5 * width, y + high));
    TEST_ASSERT_DOUBLE_WITHIN(0.02, fmax(0.9 * high * (1.0 + log10(0.0005) / 4.0), 2.6),
                              side_at("within", left + 1.5 * width, y + high));
    TEST_ASSERT_NOT_NULL(
        strstr(picture, "<title>a.csv, order 6: before 1 N·m, after 0.01 N·m, noise 0.001 N·m</title>"));
    TEST_ASSERT_EQUAL_UINT64(2 + 1, text_count("<rect class=\"before\"", picture));
    TEST_ASSERT_NOT_NULL(strstr(picture, ">c.csv</text>"));
    TEST_ASSERT_NULL(strstr(picture, "b&#60;.csv"));
}

/* ---- amplitudes by order ---- */

static const hci_plot_orders_data *orders;

static void put_orders(hci_output *out)
{
    hci_plot_orders(out, &(hci_svg_box){58.0, 40.0, 462.0, 240.0}, orders);
}

/* The legend says before and after where there is something to compare, of a single order as well. */
static void test_orders_that_are_compared(void)
{
    const hci_plot_order one[] = {{6.0, 0.4, 0.1, NAN, 0, 0}}, alone[] = {{6.0, NAN, 0.1, 0.05, 0, 0}};
    orders = &(hci_plot_orders_data){one, 1, "Orders", "noise", false};
    draw(put_orders);
    TEST_ASSERT_NOT_NULL(strstr(picture, ">before</text>"));
    TEST_ASSERT_NOT_NULL(strstr(picture, ">after</text>"));
    TEST_ASSERT_NULL(strstr(picture, ">noise</text>"));
    orders = &(hci_plot_orders_data){alone, 1, "Orders", "noise", false};
    draw(put_orders);
    TEST_ASSERT_NULL(strstr(picture, ">before</text>"));
    TEST_ASSERT_NOT_NULL(strstr(picture, ">torque</text>"));
    TEST_ASSERT_NOT_NULL(strstr(picture, ">noise</text>"));
}

/* ---- a log ---- */

static hci_run run;

static void put_log(hci_output *out)
{
    hci_plot_log(out, &(hci_svg_box){58.0, 40.0, 462.0, 440.0}, &run);
}

/* A tenth of a second is as wide as the picture: its samples are in the first, the middle and the last of
 * 480 columns. */
static void test_a_short_log(void)
{
    static double time_s[] = {5.0, 5.0501, 5.1}, torque_Nm[] = {1.0, 2.0, 3.0}, current_A[9],
                  speed_rad_per_s[] = {10.0, 20.0, 30.0};
    static const double COLUMN[] = {0.5, 240.5, 479.5}, TOP[] = {40.0, 278.0};
    run = (hci_run){.count = 3, .time_s = time_s, .speed_rad_per_s = speed_rad_per_s, .i_A = current_A};
    run.torque_Nm = torque_Nm;
    run.torque_source = HCI_TORQUE_MEASURED;
    draw(put_log);
    const char *at = picture;
    for (int panel = 0; panel < 2; ++panel) {
        double x, y[3];
        int length;
        at = strstr(at, "<polyline class=\"after\" points=\"");
        TEST_ASSERT_NOT_NULL(at);
        at = strstr(at, "points=\"") + strlen("points=\"");
        for (int k = 0; k < 3; ++k, at += length) {
            TEST_ASSERT_EQUAL_INT(2, sscanf(at, "%lf,%lf %n", &x, &y[k], &length));
            TEST_ASSERT_DOUBLE_WITHIN(0.01, 58.0 + COLUMN[k] * (462.0 - 58.0) / 480.0, x);
        }
        TEST_ASSERT_EQUAL('"', *at);
        TEST_ASSERT_TRUE(y[0] > TOP[panel] + 0.5 * 162.0 && y[2] >= TOP[panel] && y[2] < y[0] - 0.5 * 162.0);
        TEST_ASSERT_TRUE(y[0] <= TOP[panel] + 162.0);
        TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.5 * (y[0] + y[2]), y[1]);
    }
    TEST_ASSERT_NULL(strstr(at, "<polyline class=\"after\" points=\""));
}

/* ---- one turn ---- */

static hci_turn_means turn;

static void put_turn(hci_output *out)
{
    const hci_svg_box box = {58.0, 40.0, 462.0, 240.0};
    const hci_plot_turn drawn = {.turn = &turn, .plain_q_A = 3.0};
    hci_plot_turn_torque(out, &box, &drawn);
    hci_plot_turn_dq(out, &box, &drawn);
}

/* Points of the lines of i_d and i_q. */
static size_t points_of(const char *style)
{
    char begin[64];
    snprintf(begin, sizeof begin, "<polyline class=\"%s\" points=\"", style);
    const char *at = strstr(picture, begin);
    TEST_ASSERT_NOT_NULL(at);
    size_t points = 0;
    for (at += strlen(begin); *at != '"'; ++at)
        points += *at == ',';
    return points;
}

/* Torque 5 + sin 6θ with a peak in a single sample, current (cos θ, 2): means by the integral over 10
 * degrees. */
static void test_turn(void)
{
    enum { SAMPLES = 32400 }; /* 90 a step */
    hci_turn_means_begin(&turn);
    for (int k = 0; k < SAMPLES; ++k) {
        const double theta_rad =
            2.0 * REF_PI * 3.0 * ((double)k + 0.5) / SAMPLES - 13.0 * REF_PI; /* three turns, from anywhere */
        hci_turn_means_add(&turn, theta_rad, 5.0 + sin(6.0 * theta_rad),
                           (hci_dq){.d = cos(theta_rad), .q = 2.0});
    }
    hci_turn_means_add(&turn, 0.5 * REF_PI / 180.0, 99.0, (hci_dq){.d = 1.0, .q = 2.0});
    const hci_turn_mean m = hci_turn_mean_of(&turn, 20, 10);
    const double a = 20.0 * REF_PI / 180.0, b = 30.0 * REF_PI / 180.0;
    TEST_ASSERT_EQUAL_UINT64(SAMPLES / 36, m.samples);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 5.0 + (cos(6.0 * a) - cos(6.0 * b)) / (6.0 * (b - a)), m.torque_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, (sin(b) - sin(a)) / (b - a), m.current_A.d);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, m.current_A.q);
    TEST_ASSERT_EQUAL_DOUBLE(99.0, hci_turn_mean_of(&turn, 0, HCI_TURN_STEPS).torque_range_Nm.high);
    TEST_ASSERT_EQUAL_DOUBLE(99.0, hci_turn_mean_of(&turn, 0, 1).torque_range_Nm.high);
    TEST_ASSERT_TRUE(hci_turn_mean_of(&turn, 1, HCI_TURN_STEPS - 1).torque_range_Nm.high < 6.01);
    draw(put_turn);
    TEST_ASSERT_NULL(strstr(picture, "nan"));
    TEST_ASSERT_EQUAL_UINT64(HCI_TURN_STEPS, points_of("b"));
    TEST_ASSERT_EQUAL_UINT64(HCI_TURN_STEPS, points_of("a"));
    hci_turn_means_begin(&turn);
    TEST_ASSERT_EQUAL_UINT64(0, hci_turn_mean_of(&turn, 0, HCI_TURN_STEPS).samples);
    draw(put_turn);
    TEST_ASSERT_NULL(strstr(picture, "nan"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_system_is_that_of_the_torque);
    RUN_TEST(test_no_system_angle_by_angle);
    RUN_TEST(test_map);
    RUN_TEST(test_orders_that_are_compared);
    RUN_TEST(test_a_short_log);
    RUN_TEST(test_turn);
    return UNITY_END();
}
