/* The simulated drive from files: what `solve` promised against what the plant does, the second paper's
 * experiment, figures recomputed from the trajectory, energy, sensors, wrong scenarios. */
#define _XOPEN_SOURCE 700

#include <cjson/cJSON.h>
#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hci/host/csv/csv.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"
#include "host/base/memory.h"
#include "unity.h"

static char root[64];
static hci_machine_data machine_a, machine_c;

/* ---- tools ---- */

static const char *in_root(const char *name)
{
    static char text[4][160];
    static unsigned next;
    char *out = text[next++ % 4];
    snprintf(out, sizeof text[0], "%s/%s", root, name);
    return out;
}

static void remove_files(const char *folder)
{
    DIR *list = opendir(folder);
    for (const struct dirent *entry; list != NULL && (entry = readdir(list)) != NULL;) {
        char name[512];
        snprintf(name, sizeof name, "%s/%s", folder, entry->d_name);
        if (entry->d_name[0] == '.') continue;
        if (remove(name) != 0) remove_files(name);
    }
    if (list != NULL) closedir(list);
    rmdir(folder);
}

static int entries(const char *folder)
{
    int count = -2;
    DIR *list = opendir(folder);
    if (list == NULL) return -1;
    while (readdir(list) != NULL)
        ++count;
    closedir(list);
    return count;
}

void setUp(void)
{
    hci_note note = {{0}};
    snprintf(root, sizeof root, "/tmp/hci-test-simulate-XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(root));
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read("data/machine_a", &machine_a, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read("data/machine_c", &machine_c, &note), note.text);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_machine_release(&machine_a);
    hci_machine_release(&machine_c);
    remove_files(root);
}

static void write_text(const char *name, const char *text)
{
    FILE *file = fopen(in_root(name), "w");
    TEST_ASSERT_NOT_NULL(file);
    fputs(text, file);
    fclose(file);
}

/* A scenario of rows under the header. */
static hci_scenario scenario_of(const char *rows)
{
    hci_scenario s;
    hci_note note = {{0}};
    char text[2048];
    snprintf(text, sizeof text, "name,value,unit\n%s", rows);
    write_text("scenario.csv", text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_scenario_read(in_root("scenario.csv"), &s, &note), note.text);
    return s;
}

static hci_simulation simulate_into(const hci_machine_data *machine, const hci_scenario *scenario,
                                    const char *folder)
{
    const hci_simulate_options options = {0};
    const hci_simulate_output where = {folder, NULL};
    hci_simulation s;
    hci_note note = {{0}};
    const hci_status status = folder ? hci_simulate_to_folder(machine, scenario, &options, &where, &s, &note)
                                     : hci_simulate(machine, scenario, &options, &s, &note);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, status, note.text);
    return s;
}

static hci_simulation simulate(const hci_machine_data *machine, const char *rows)
{
    const hci_scenario scenario = scenario_of(rows);
    return simulate_into(machine, &scenario, NULL);
}

/* A whole column of a file in the temporary folder; to be freed. */
static double *column(const char *file, const char *name, size_t *rows)
{
    hci_csv *csv;
    hci_note note = {{0}};
    double *values;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(in_root(file), &csv, &note), note.text);
    *rows = hci_csv_rows(csv);
    values = malloc((*rows + 1) * sizeof *values);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_numbers(csv, name, values, &note), note.text);
    hci_csv_free(csv);
    return values;
}

static char *bytes_of(const char *file)
{
    char *text = NULL;
    size_t length = 0;
    FILE *in = fopen(in_root(file), "rb");
    TEST_ASSERT_NOT_NULL_MESSAGE(in, file);
    for (size_t got = 1; got > 0; length += got) {
        text = realloc(text, length + 65537);
        got = fread(text + length, 1, 65536, in);
    }
    text[length] = '\0';
    fclose(in);
    return text;
}

/* ---- promised and simulated torque ---- */

static hci_solution solve(const hci_machine_data *machine, const char *target_file, hci_method method,
                          hci_strategy strategy)
{
    hci_target target;
    hci_solution solution;
    hci_note note = {{0}};
    hci_solve_options options;
    hci_status status;
    memset(&options, 0, sizeof options);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_target_read(target_file, &target, &note), note.text);
    options.target = &target;
    options.method = method;
    options.strategy = strategy;
    status = hci_solve(machine, &options, &solution, &note);
    TEST_ASSERT_TRUE_MESSAGE(status <= HCI_NOT_REACHED, note.text);
    hci_target_release(&target);
    TEST_ASSERT_EQUAL(HCI_OK, hci_solution_write(machine, &solution, status, in_root("solution"), &note));
    return solution;
}

static double difference(hci_harmonic a, hci_harmonic b)
{
    return hypot(a.sine - b.sine, a.cosine - b.cosine);
}

/* The promise at an order; an order that is not in it is promised zero. */
static hci_harmonic promised(const hci_solution *solution, double order)
{
    for (size_t k = 0; k < solution->order_count; ++k)
        if (fabs(solution->order[k].torque_Nm.order - order) < 1e-9) return solution->order[k].torque_Nm;
    return (hci_harmonic){order, 0.0, 0.0};
}

/* 1e-6 of the mean: the promise is exact, the table's cubic is off by (2π 60/4096)⁴/384 = 2e-7 of an order
 * 60, and periods that end between steps by 1e-7. */
static void assert_promise_is_kept(const hci_machine_data *machine, const char *rows, hci_solution *solution)
{
    hci_simulation s = simulate(machine, rows);
    double worst = 0.0;
    TEST_ASSERT_TRUE(s.periods >= 2 && s.spectrum_count > 60);
    for (size_t k = 0; k < s.spectrum_count; ++k)
        worst = fmax(worst, difference(s.spectrum_Nm[k], promised(solution, s.spectrum_Nm[k].order)));
    printf("worst order off by %.2g of the mean\n", worst / s.torque_Nm.mean);
    TEST_ASSERT_TRUE(worst < 1e-6 * s.torque_Nm.mean);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * s.torque_Nm.mean, solution->order[0].torque_Nm.cosine, s.torque_Nm.mean);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * solution->mean_square_A2, solution->mean_square_A2,
                              1.5 * s.current_A.rms * s.current_A.rms);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * solution->peak_phase_current_A, solution->peak_phase_current_A,
                              s.peak_phase_A);
    hci_simulation_release(&s);
    hci_solution_release(solution);
}

/* A step that fits into no period, and an angle to start from, so that nothing falls on rows of the table. */
#define TURNED "initial_angle,0.1,rad\ncurrents,solution,\nhighest_order,80,\n"

static void test_imposed_currents_keep_the_promise_of_machine_a(void)
{
    static const char *const TARGET[] = {"data/scenarios/02/target.csv", "data/scenarios/12/target.csv"};
    for (size_t k = 0; k < 2; ++k) {
        hci_solution solution = solve(&machine_a, TARGET[k], HCI_METHOD_AUTO, HCI_STRATEGY_MTPA);
        assert_promise_is_kept(&machine_a, "duration,0.05,s\nprescribed_speed,1500,rpm\nstep,7.3,us\n" TURNED,
                               &solution);
    }
}

static void test_imposed_currents_keep_the_promise_of_machine_c(void)
{
    static const struct {
        hci_method method;
        hci_strategy strategy;
    } WAY[] = {{HCI_METHOD_AUTO, HCI_STRATEGY_MTPA},
               {HCI_METHOD_POINTWISE, HCI_STRATEGY_MTPA},
               {HCI_METHOD_POINTWISE, HCI_STRATEGY_CANCEL},
               {HCI_METHOD_POINTWISE, HCI_STRATEGY_ID0}};
    write_text("target.csv", "order,amplitude_Nm,phase_rad\n0,8,0\n");
    for (size_t k = 0; k < 4; ++k) {
        hci_solution solution = solve(&machine_c, in_root("target.csv"), WAY[k].method, WAY[k].strategy);
        assert_promise_is_kept(&machine_c, "duration,0.8,s\nprescribed_speed,80,rpm\nstep,71.3,us\n" TURNED,
                               &solution);
    }
}

/* The torque in proportion: currents_per_Nm.csv and currents_constant.csv at another torque than the one
 * solved for. */
static void test_a_solution_is_scaled_by_the_torque(void)
{
    hci_solution solution =
        solve(&machine_a, "data/scenarios/02/target.csv", HCI_METHOD_AUTO, HCI_STRATEGY_MTPA);
    hci_simulation s =
        simulate(&machine_a, "duration,0.05,s\nprescribed_speed,1500,rpm\ntorque_reference,1.3,Nm\n" TURNED);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.3, s.torque_Nm.mean);
    TEST_ASSERT_TRUE(s.T_ripple_percent < 1e-3);
    hci_simulation_release(&s);
    hci_solution_release(&solution);
}

/* A rotor that its own torque shakes: at equal steps of time the angles are uneven, the spectrum over the
 * angle is the same. */
static void test_spectrum_is_over_the_angle(void)
{
    const hci_wave sine = hci_wave_polar(1.0, 1, 6.0, 0.0);
    double orders[4096];
    hci_harmonic predicted[4096];
    size_t count;
    hci_simulation s;
    write_text("sine.csv", "order,set,amplitude_A,phase_rad\n1,pos,6,0\n");
    TEST_ASSERT_EQUAL(HCI_OK, hci_torque_orders(&machine_c.model, &sine, 1, orders, 4096, &count));
    hci_torque_spectrum(&machine_c.model, &sine, 1, orders, count, predicted);
    s = simulate(
        &machine_c,
        "duration,1.2,s\ncurrents,sine.csv,\ninitial_speed,80,rpm\nload_torque,8.02,Nm\ninertia,0.002,kgm2\n"
        "settle,0.1,s\n");
    TEST_ASSERT_TRUE(s.periods >= 2);
    TEST_ASSERT_TRUE(s.speed_rad_per_s.most > 1.05 * s.speed_rad_per_s.least); /* it does shake */
    for (size_t k = 0; k < s.spectrum_count; ++k) {
        hci_harmonic wanted = {s.spectrum_Nm[k].order, 0.0, 0.0};
        for (size_t j = 0; j < count; ++j)
            if (fabs(orders[j] - wanted.order) < 1e-9) wanted = predicted[j];
        TEST_ASSERT_TRUE(difference(wanted, s.spectrum_Nm[k]) < 1e-6 * 8.0);
    }
    TEST_ASSERT_TRUE(fabs(s.torque_Nm.mean - s.spectrum_Nm[0].cosine) >
                     1e-4); /* the mean over time is another one */
    hci_simulation_release(&s);
}

static void test_turning_backwards_gives_the_same_spectrum(void)
{
    hci_simulation forward, backward;
    write_text("sine.csv", "order,set,amplitude_A,phase_rad\n1,pos,6,0.3\n");
    forward = simulate(&machine_c, "duration,0.8,s\ncurrents,sine.csv,\nprescribed_speed,80,rpm\n");
    backward = simulate(&machine_c, "duration,0.8,s\ncurrents,sine.csv,\nprescribed_speed,-80,rpm\n");
    TEST_ASSERT_EQUAL_UINT64(forward.periods, backward.periods);
    for (size_t k = 0; k < forward.spectrum_count; ++k)
        TEST_ASSERT_TRUE(difference(forward.spectrum_Nm[k], backward.spectrum_Nm[k]) < 1e-9);
    hci_simulation_release(&forward);
    hci_simulation_release(&backward);
}

static void test_a_rotor_at_rest_has_no_spectrum(void)
{
    hci_simulation s =
        simulate(&machine_c, "duration,0.01,s\ntorque_reference,3,Nm\ncoulomb_friction,20,Nm\n");
    TEST_ASSERT_EQUAL_UINT64(0, s.periods);
    TEST_ASSERT_NULL(s.spectrum_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3.0, s.torque_Nm.mean);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, s.speed_rad_per_s.most);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.01, s.to_s);
    hci_simulation_release(&s);
}

/* ---- the second paper's experiment ---- */

/* The shipped scenario with shorter times and twice the step, for a quick test. */
static hci_simulation run_experiment(int strategy)
{
    char path[64];
    hci_scenario s;
    hci_note note = {{0}};
    snprintf(path, sizeof path, "data/drive/filho_strategy_%d.csv", strategy);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_scenario_read(path, &s, &note), note.text);
    s.step_s = 2e-6;
    s.load_torque_2_from_s = 0.2;
    if (strategy > 1) s.strategy_2_from_s = 0.25;
    s.settle_s = strategy > 1 ? 0.55 : 0.75;
    s.duration_s = s.settle_s + 0.38;
    return simulate_into(&machine_c, &s, NULL);
}

/* Tables 2 and 3: mean, maximum, minimum, F_ripple, T_ripple of the torque; mean, rms, maximum, minimum of
 * i_s. */
static const double PAPER[2][9] = {{8.00, 9.32, 6.54, 5.96, 34.79, 6.55, 6.56, 7.29, 5.74},
                                   {8.00, 8.70, 7.36, 2.52, 16.64, 6.70, 6.70, 7.78, 6.13}};

static void print_row(int strategy, const hci_simulation *s)
{
    const double row[9] = {s->torque_Nm.mean,    s->torque_Nm.most,     s->torque_Nm.least,
                           s->F_ripple_percent,  s->T_ripple_percent,   s->current_dqx_A.mean,
                           s->current_dqx_A.rms, s->current_dqx_A.most, s->current_dqx_A.least};
    if (strategy == 1)
        printf("strategy            mean    max    min  F_rip  T_rip | i_s mean    rms    max    min\n");
    for (int paper = 0; paper < (strategy < 3 ? 2 : 1); ++paper) {
        printf("%d %s ", strategy, paper ? "paper    " : "simulated");
        for (int k = 0; k < 9; ++k)
            printf(" %6.2f", paper ? PAPER[strategy - 1][k] : row[k]);
        printf("\n");
    }
}

static hci_simulation experiment(int strategy)
{
    hci_simulation s = run_experiment(strategy);
    print_row(strategy, &s);
    TEST_ASSERT_TRUE(s.periods >= 1);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 8.0, s.torque_Nm.mean); /* the load, in the steady state */
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 80.0, s.speed_rad_per_s.mean * 30.0 / 3.14159265358979);
    TEST_ASSERT_EQUAL_UINT64(0, s.without_current);
    TEST_ASSERT_TRUE(s.switching_frequency_Hz > 1000.0 && s.switching_frequency_Hz <= 20000.0);
    return s;
}

/* Strategy 1 leaves the machine's own ripple, of which the speed loop takes some, so that the current moves
 * as well. The inertia, which the paper does not give, sets how much and is fitted to T_ripple and i_s: that
 * these are near the paper's (37.0 %, 6.58 A) guards the scenario and confirms nothing. F_ripple, 8.2 %, is
 * not near: this machine's ripple has less of a crest. */
static void test_strategy_1_of_the_paper(void)
{
    hci_simulation s = experiment(1);
    TEST_ASSERT_DOUBLE_WITHIN(2.0, 37.0, s.T_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(0.4, 8.2, s.F_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * PAPER[0][5], PAPER[0][5], s.current_dqx_A.mean);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * PAPER[0][6], PAPER[0][6], s.current_dqx_A.rms);
    TEST_ASSERT_TRUE(s.current_dqx_A.most > 7.3 && s.current_dqx_A.most < 7.8);
    hci_simulation_release(&s);
}

/* Strategies 2 and 3 leave what the band of the current control lets through: e times its error, twice half
 * the band at most in a phase, so that 1.25 N·m/A · 0.1 A · 2 = 0.25 N·m or 3 % peak to peak, somewhat more
 * with L'i in the gain. The paper reports 16.64 % for strategy 2, and does not say what is left there;
 * nothing in this plant makes so much. */
static void test_strategies_2_and_3(void)
{
    hci_simulation two = experiment(2), three = experiment(3);
    TEST_ASSERT_DOUBLE_WITHIN(0.7, 3.5, two.T_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(0.07, 0.60, two.F_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 6.635, two.current_dqx_A.mean); /* paper 6.70 */
    TEST_ASSERT_DOUBLE_WITHIN(0.7, 4.0, three.T_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(0.07, 0.70, three.F_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 6.023, three.current_dqx_A.mean);
    TEST_ASSERT_TRUE(three.current_dqx_A.mean < two.current_dqx_A.mean);
    TEST_ASSERT_TRUE(three.copper_W < 0.85 * two.copper_W);
    TEST_ASSERT_TRUE(three.F_ripple_percent < 2.0);
    hci_simulation_release(&two);
    hci_simulation_release(&three);
}

/* Strategy 3 at constant speed and torque: nothing but the current control is left to make ripple, and it
 * goes with the band. */
static double rest_of_strategy_3(const char *rows)
{
    char text[512];
    hci_simulation s;
    double ripple;
    snprintf(text, sizeof text,
             "duration,0.4,s\nsettle,0.02,s\nprescribed_speed,80,rpm\ntorque_reference,8,Nm\n%s", rows);
    s = simulate(&machine_c, text);
    ripple = s.T_ripple_percent;
    printf("strategy 3: T_ripple %.4f %%, F_ripple %.4f %%, %.0f Hz\n", ripple, s.F_ripple_percent,
           isnan(s.switching_frequency_Hz) ? 0.0 : s.switching_frequency_Hz);
    TEST_ASSERT_TRUE(s.periods >= 1);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 8.0, s.torque_Nm.mean);
    hci_simulation_release(&s);
    return ripple;
}

#define FREE "current_control,hysteresis,\nswitching_frequency_max,1000,kHz\nstep,2,us\n"

static void test_the_rest_of_strategy_3_is_the_band(void)
{
    const double wide = rest_of_strategy_3("current_control,hysteresis,\nhysteresis_band,0.1,A\nstep,2,us\n");
    const double free = rest_of_strategy_3(FREE "hysteresis_band,0.1,A\n");
    const double half = rest_of_strategy_3(FREE "hysteresis_band,0.05,A\n");
    const double narrow = rest_of_strategy_3(FREE "hysteresis_band,0.02,A\n");
    const double ideal = rest_of_strategy_3("current_control,ideal,\nstep,20,us\n");
    TEST_ASSERT_TRUE(wide > 3.0 && wide < 5.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.2, wide, free); /* 20 kHz is no restriction at 0.1 A */
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 0.5,
                              half / free); /* in proportion to the band, but for what a step moves */
    TEST_ASSERT_TRUE(half < 2.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 0.25, narrow / free);
    TEST_ASSERT_TRUE(ideal < 1e-9);
}

/* ---- figures from the trajectory ---- */

/* Formulas (27), (28) of the paper by the trapezoidal rule, from every row of the evaluated time. */
static void test_figures_are_those_of_the_trajectory(void)
{
    const hci_scenario scenario = scenario_of("duration,0.45,s\nprescribed_speed,80,rpm\ntorque_reference,5,"
                                              "Nm\nstrategy,id0,\ncurrent_control,pi,\n"
                                              "trajectory_every,1,\nsettle,0.06,s\n");
    hci_simulation s = simulate_into(&machine_c, &scenario, in_root("out"));
    size_t rows;
    double *t = column("out/trajectory.csv", "time_s", &rows),
           *torque = column("out/trajectory.csv", "torque_Nm", &rows);
    double *a = column("out/trajectory.csv", "ia_A", &rows), *b = column("out/trajectory.csv", "ib_A", &rows);
    double *va = column("out/trajectory.csv", "va_V", &rows),
           *vb = column("out/trajectory.csv", "vb_V", &rows);
    double most = -1e9, least = 1e9, sum = 0.0, square = 0.0, mean, length = 0.0, input = 0.0,
           last_s = s.to_s;
    for (size_t k = 0; k + 1 < rows; ++k) {
        const double h = t[k + 1] - t[k];
        if (t[k] < s.from_s - 1e-9 || t[k] > last_s - 0.5 * h) continue;
        most = fmax(most, torque[k]);
        least = fmin(least, torque[k]);
        sum += 0.5 * h * (torque[k] + torque[k + 1]);
        length += 0.5 * h *
                  (sqrt((a[k] * a[k] + b[k] * b[k] + a[k] * b[k]) * 4.0 / 3.0) +
                   sqrt((a[k + 1] * a[k + 1] + b[k + 1] * b[k + 1] + a[k + 1] * b[k + 1]) * 4.0 / 3.0));
        /* v·i with i_c = −i_a − i_b, v_c = −v_a − v_b, current straight over a step */
        input +=
            0.5 * h * ((2.0 * va[k] + vb[k]) * (a[k] + a[k + 1]) + (va[k] + 2.0 * vb[k]) * (b[k] + b[k + 1]));
    }
    mean = sum / (s.to_s - s.from_s);
    for (size_t k = 0; k + 1 < rows; ++k)
        if (t[k] >= s.from_s - 1e-9 && t[k] <= last_s - 0.5 * (t[k + 1] - t[k]))
            square += 0.5 * (t[k + 1] - t[k]) * (pow(torque[k] - mean, 2.0) + pow(torque[k + 1] - mean, 2.0));
    /* The period ends inside a step: one step of 37 500. */
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, mean, s.torque_Nm.mean);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4 * s.T_ripple_percent, 100.0 * (most - least) / mean, s.T_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3 * s.F_ripple_percent, 100.0 * sqrt(square / (s.to_s - s.from_s)) / mean,
                              s.F_ripple_percent);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, length / (s.to_s - s.from_s), s.current_A.mean);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4 * input, input, s.energy_J.electrical);
    TEST_ASSERT_TRUE(s.T_ripple_percent > 10.0); /* there is something to compare */
    free(t);
    free(torque);
    free(a);
    free(b);
    free(va);
    free(vb);
    hci_simulation_release(&s);
}

/* A run over whole periods with friction and a free shaft: what goes in comes out. RK4 and the trapezoidal
 * rule leave 1e-6. */
static void test_energy_balances(void)
{
    static const char *const CONTROL[] = {"current_control,pi,\n", "current_control,hysteresis,\n"};
    for (size_t k = 0; k < 2; ++k) {
        char rows[512];
        hci_simulation s;
        snprintf(rows, sizeof rows,
                 "duration,0.3,s\nstep,2,us\nspeed_reference,300,rpm\ninitial_speed,250,rpm\nload_torque,4,"
                 "Nm\nviscous_friction,0.01,\n"
                 "coulomb_friction,0.3,Nm\nsettle,0.05,s\nspeed_kp,0.5,\nspeed_ki,5,\n%s",
                 CONTROL[k]);
        s = simulate(&machine_c, rows);
        TEST_ASSERT_TRUE(s.periods >= 2);
        TEST_ASSERT_TRUE(s.energy_J.mechanical > 20.0 && s.energy_J.friction > 2.0 &&
                         fabs(s.energy_J.kinetic) > 0.1);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5 * s.energy_J.electrical, 0.0, s.energy_J.residual);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5 * s.energy_J.mechanical, s.energy_J.mechanical,
                                  s.energy_J.load + s.energy_J.friction + s.energy_J.kinetic);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, s.copper_W,
                                  1.5 * machine_c.resistance_ohm * s.current_A.rms * s.current_A.rms);
        hci_simulation_release(&s);
    }
}

/* Less than one period, so that the magnets' energy does not come back: about 0.05 J of cogging is in it. */
static void test_energy_balances_within_a_period(void)
{
    hci_simulation s =
        simulate(&machine_c, "duration,0.09,s\nprescribed_speed,80,rpm\ntorque_reference,5,Nm\n"
                             "current_control,pi,\nsettle,0.0873,s\n");
    TEST_ASSERT_EQUAL_UINT64(0, s.periods);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5 * s.energy_J.electrical, 0.0, s.energy_J.residual);
    TEST_ASSERT_TRUE(fabs(s.energy_J.stored) > 1e-3 * s.energy_J.electrical);
    hci_simulation_release(&s);
}

/* By default the evaluation begins where ideal currents change. */
static void test_strategy_2_takes_over_at_its_time(void)
{
    const hci_scenario scenario =
        scenario_of("duration,0.6,s\nprescribed_speed,80,rpm\ntorque_reference,8,Nm\nstrategy,"
                    "id0,\nstrategy_2,cancel,\nstrategy_2_from,0.2,s\n");
    hci_simulation s = simulate_into(&machine_c, &scenario, in_root("out"));
    size_t rows;
    double *t = column("out/trajectory.csv", "time_s", &rows),
           *torque = column("out/trajectory.csv", "torque_Nm", &rows), before = 0.0;
    for (size_t k = 0; k < rows; ++k) {
        if (t[k] < 0.2)
            before = fmax(before, fabs(torque[k] - 8.0));
        else
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, 8.0, torque[k]);
    }
    TEST_ASSERT_TRUE(before > 0.5);
    TEST_ASSERT_DOUBLE_WITHIN(s.step_s, 0.2, s.from_s);
    TEST_ASSERT_EQUAL_UINT64(1, s.periods);
    free(t);
    free(torque);
    hci_simulation_release(&s);
}

static void test_pi_control_holds_the_torque(void)
{
    hci_simulation s = simulate(
        &machine_c, "duration,0.45,s\nprescribed_speed,80,rpm\ntorque_reference,8,Nm\ncurrent_control,pi,\n"
                    "settle,0.05,s\n");
    /* A bandwidth of 2000 rad/s follows an order 12 at 201 rad/s to a tenth: what is left is well below the
     * 36 % of i_d = 0. */
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 8.0, s.torque_Nm.mean);
    TEST_ASSERT_TRUE(s.T_ripple_percent > 0.1 && s.T_ripple_percent < 12.0);
    hci_simulation_release(&s);
}

static void test_limits_and_missing_currents_are_counted(void)
{
    /* Without reluctance torque no i_d cancels the cogging, wherever there is some. One period of 2048
     * samples. */
    hci_simulation s = simulate(
        &machine_a, "duration,0.025,s\nprescribed_speed,1500,rpm\ntorque_reference,2,Nm\nstrategy,cancel,\n");
    TEST_ASSERT_EQUAL_UINT64(2048, s.samples);
    TEST_ASSERT_TRUE(s.without_current > 2000 && s.without_current <= 2048);
    TEST_ASSERT_TRUE(s.without_current_from_start > s.without_current);
    TEST_ASSERT_EQUAL_UINT64(0, s.limited);
    hci_simulation_release(&s);
    s = simulate(
        &machine_c,
        "duration,0.4,s\nprescribed_speed,80,rpm\ntorque_reference,12,Nm\nstrategy,id0,\niq_limit,8,A\n");
    TEST_ASSERT_EQUAL_UINT64(s.samples, s.limited);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 8.0, s.current_dqx_A.mean); /* the limit is in the same normalisation */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 8.0, s.current_dqx_A.most);
    hci_simulation_release(&s);
}

/* ---- sensors ---- */

#define LOGGED "duration,0.05,s\nprescribed_speed,80,rpm\ntorque_reference,4,Nm\ntrajectory_every,1,\n"

static void compare_columns(const char *reading, const char *truth, double gain, double offset,
                            double tolerance)
{
    size_t rows;
    double *x = column("out/trajectory.csv", reading, &rows), *y = column("out/trajectory.csv", truth, &rows);
    TEST_ASSERT_TRUE(rows > 100);
    for (size_t k = 0; k < rows; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(tolerance, gain * y[k] + offset, x[k]);
    free(x);
    free(y);
}

static void test_the_trajectory_is_what_a_logger_reads(void)
{
    static const char *const CONTROL[] = {"current_control,ideal,\n", "current_control,pi,\n"};
    for (size_t k = 0; k < 2; ++k) {
        char rows[512];
        hci_scenario scenario;
        hci_simulation s;
        snprintf(rows, sizeof rows,
                 LOGGED
                 "current_offset_a,0.3,A\ncurrent_gain_b,0.05,\nangle_offset,0.2,rad\ntorque_delay,0,s\n%s",
                 CONTROL[k]);
        scenario = scenario_of(rows);
        s = simulate_into(&machine_c, &scenario, in_root("out"));
        compare_columns("ia_A", "ia_true_A", 1.0, 0.3, 1e-12);
        compare_columns("ib_A", "ib_true_A", 1.05, 0.0, 1e-12);
        compare_columns("ic_A", "ic_true_A", 1.0, 0.0, 1e-12);
        compare_columns("theta_m_rad", "theta_m_true_rad", 1.0, 0.1, 1e-12);
        compare_columns("torque_Nm", "torque_true_Nm", 1.0, 0.0, 0.0);
        hci_simulation_release(&s);
    }
}

static void test_readings_are_coarse_and_late(void)
{
    const hci_scenario scenario = scenario_of(LOGGED "step,10,us\nencoder_counts,256,\ntorque_delay,30,us\n");
    hci_simulation s = simulate_into(&machine_c, &scenario, in_root("out"));
    size_t rows;
    double *angle = column("out/trajectory.csv", "theta_m_rad", &rows),
           *late = column("out/trajectory.csv", "torque_Nm", &rows),
           *truth = column("out/trajectory.csv", "torque_true_Nm", &rows);
    for (size_t k = 3; k < rows; ++k) {
        const double counts = angle[k] * 256.0 / (2.0 * 3.14159265358979323846);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, floor(counts + 0.5), counts);
        TEST_ASSERT_EQUAL_DOUBLE(truth[k - 3], late[k]);
    }
    TEST_ASSERT_TRUE(s.F_ripple_percent > 0.01); /* the controller read the coarse angle too */
    free(angle);
    free(late);
    free(truth);
    hci_simulation_release(&s);
}

static void test_same_input_same_bytes(void)
{
    static const char *const FILES[] = {"trajectory.csv", "spectrum.csv", "summary.json"};
    char rows[512];
    char *first[3];
    for (int run = 0; run < 3; ++run) {
        hci_scenario scenario;
        hci_simulation s;
        snprintf(rows, sizeof rows,
                 "duration,0.04,s\nprescribed_speed,1600,rpm\ntorque_reference,4,Nm\ncurrent_control,"
                 "hysteresis,\nsettle,0.001,s\n"
                 "current_noise,0.02,A\nseed,%d,\n",
                 run == 2 ? 8 : 7);
        scenario = scenario_of(rows);
        s = simulate_into(&machine_c, &scenario, in_root("out"));
        TEST_ASSERT_EQUAL_INT(3, entries(in_root("out")));
        for (int k = 0; k < 3; ++k) {
            char name[64], *text;
            snprintf(name, sizeof name, "out/%s", FILES[k]);
            text = bytes_of(name);
            if (run == 0) {
                first[k] = text;
                continue;
            }
            TEST_ASSERT_EQUAL_INT_MESSAGE(run == 1, strcmp(text, first[k]) == 0, FILES[k]);
            free(text);
        }
        hci_simulation_release(&s);
    }
    for (int k = 0; k < 3; ++k)
        free(first[k]);
}

/* ---- effects ---- */

static void test_effects_are_simulated(void)
{
    const hci_scenario scenario =
        scenario_of("duration,0.8,s\nprescribed_speed,80,rpm\ntorque_reference,8,Nm\n");
    const hci_simulate_options without = {0};
    hci_effects_data effects;
    hci_simulate_options with = {0};
    hci_simulation s;
    hci_note note = {{0}};
    write_text("effects.csv", "effect,parameter,value,unit,std_error\ncogging,sine_5,0.25,Nm,\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_effects_read(in_root("effects.csv"), &effects, &note), note.text);
    with.effects = &effects.list;
    machine_c.has_effects = true;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_simulate(&machine_c, &scenario, &without, &s, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "effects.csv"));
    note.text[0] = '\0';
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_simulate(&machine_c, &scenario, &with, &s, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(2, s.period_turns);
    for (size_t k = 0; k < s.spectrum_count; ++k) { /* the controller does not know of it */
        const double wanted = fabs(s.spectrum_Nm[k].order - 5.0) < 1e-9 ? 0.25 : 0.0;
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, wanted, s.spectrum_Nm[k].sine);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, k == 0 ? 8.0 : 0.0, s.spectrum_Nm[k].cosine);
    }
    hci_simulation_release(&s);
    hci_effects_release(&effects);
}

/* ---- scenario files ---- */

static void test_units_and_relative_paths(void)
{
    const hci_scenario s =
        scenario_of("duration,250,ms\nspeed_reference,60,rpm\nspeed_ki,200,Nm/rad\ninitial_angle,90,deg\n"
                    "hysteresis_band,100,mA\ncurrents,folder/x.csv,\nseed,3,-\n");
    TEST_ASSERT_EQUAL_DOUBLE(0.25, s.duration_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * 3.14159265358979323846, s.speed_reference_rad_per_s);
    TEST_ASSERT_EQUAL_DOUBLE(200.0, s.speed_ki_Nm_per_rad);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 * 3.14159265358979323846, s.initial_angle_rad);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.1, s.hysteresis_band_A);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, s.seed);
    TEST_ASSERT_EQUAL_STRING(in_root("folder/x.csv"), s.currents);
    TEST_ASSERT_TRUE(isnan(s.step_s));
}

static void refused(const hci_machine_data *machine, const char *rows, const char *words)
{
    char text[1024];
    hci_scenario scenario;
    hci_simulation s;
    hci_note note = {{0}};
    const hci_simulate_options options = {0};
    const hci_simulate_output where = {in_root("refused"), NULL};
    hci_status status;
    snprintf(text, sizeof text, "name,value,unit\n%s", rows);
    write_text("scenario.csv", text);
    status = hci_scenario_read(in_root("scenario.csv"), &scenario, &note);
    if (!status) {
        status = hci_simulate_to_folder(machine, &scenario, &options, &where, &s, &note);
        TEST_ASSERT_NULL(s.spectrum_Nm);
    }
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_ERROR_INPUT, status, rows);
    if (!strstr(note.text, words)) printf("%s\n    lacks %s\n", note.text, words);
    TEST_ASSERT_NOT_NULL(strstr(note.text, words));
    TEST_ASSERT_EQUAL_INT(-1, entries(in_root("refused")));
}

static void test_wrong_rows_are_refused(void)
{
    refused(&machine_c, "duratoin,1,s\n", "scenario.csv:2: no name `duratoin`; known: current_control");
    refused(&machine_c, "duratoin,1,s\n", " trajectory_every"); /* the list is whole */
    refused(&machine_c, "duration,1,s\nduration,1,s\n", "each name once");
    refused(&machine_c, "strategy,id0,\nstrategy,id0,\n", "each name once");
    refused(&machine_c, "duration,1,A\n", "a unit that converts to s");
    refused(&machine_c, "duration,-1,s\n", "a number from 1e-09 to 1e+06 s");
    refused(&machine_c, "duration,nan,s\n", "found");
    refused(&machine_c, "seed,1.5,\n", "a whole number");
    refused(&machine_c, "strategy,foc,\n", "one of: mtpa, id0, cancel");
    refused(&machine_c, "current_control,pid,\n", "one of: ideal, hysteresis, pi");
    refused(&machine_c, "strategy_2,id0,\n", "`strategy_2_from` go together");
    refused(&machine_c, "strategy_2_from,1,s\n", "go together");
    refused(&machine_c, "currents,x.csv,\nstrategy,id0,\n", "both say what flows");
    refused(&machine_c, "currents,,\n", "delete the row");
}

#define RUNS "duration,0.1,s\nprescribed_speed,80,rpm\n"

static void test_contradictions_are_refused(void)
{
    refused(&machine_c, "prescribed_speed,80,rpm\n", "no `duration`");
    refused(&machine_c, RUNS, "no set point");
    refused(&machine_c, RUNS "speed_reference,80,rpm\n", "`prescribed_speed`");
    refused(&machine_c, RUNS "torque_reference,8,Nm\ninitial_speed,80,rpm\n", "`initial_speed`");
    refused(&machine_c, "duration,1,s\nspeed_reference,80,rpm\ntorque_reference,8,Nm\n", "two set points");
    refused(&machine_c, RUNS "torque_reference,8,Nm\nload_torque_2,1,Nm\n", "`load_torque_2_from`");
    refused(&machine_c, RUNS "torque_reference,8,Nm\nstep,0.2,s\n", "shorter than two steps");
    refused(&machine_c, "duration,1e6,s\nspeed_reference,80,rpm\n", "larger `step`");
    refused(&machine_c, RUNS "torque_reference,8,Nm\nsettle,0.1,s\n", "leaves nothing");
    refused(&machine_c, RUNS "torque_reference,8,Nm\nstep,10,us\ncurrent_sample_time,15,us\n",
            "`current_sample_time`: found 1.5e-05 s");
    refused(&machine_c, RUNS "torque_reference,8,Nm\nstep,10,us\nangle_delay,5,us\n", "`angle_delay`");
    refused(&machine_c, RUNS "currents,none.csv,\n", "none.csv");
    write_text("waves.csv", "order,set,amplitude_A,phase_rad\n1,pos,6,0\n");
    refused(&machine_c, RUNS "currents,waves.csv,\ntorque_reference,8,Nm\n",
            "give the folder that `solve` wrote");
    write_text("waves.csv", "order,set,amplitude_A,phase_rad\n1.25,pos,6,0\n");
    refused(&machine_c, RUNS "currents,waves.csv,\n", "no multiple of 1/2");
    write_text("waves.csv", "order,set,amplitude_A,phase_rad\n3,sym,6,0\n");
    refused(&machine_c, RUNS "currents,waves.csv,\n", "zero-sequence");
}

/* What an ideal current source at a prescribed speed does not feel need not be known; else the row to add is
 * named. */
static void test_missing_values_are_named_where_needed(void)
{
    hci_simulation s = simulate(&machine_a, RUNS "torque_reference,2,Nm\n");
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0, s.torque_Nm.mean);
    TEST_ASSERT_TRUE(isnan(s.copper_W) && isnan(s.energy_J.stored));
    hci_simulation_release(&s);
    refused(&machine_a, "duration,1,s\nspeed_reference,80,rpm\n", "no `inertia`");
    refused(&machine_a, RUNS "torque_reference,2,Nm\ncurrent_control,pi,\n",
            "add a row `inductance_d,VALUE,H,SOURCE`");
    machine_a.inductance_d_H = 2e-3;
    refused(&machine_a, RUNS "torque_reference,2,Nm\ncurrent_control,pi,\n", "`inductance_q,VALUE,H,SOURCE`");
    machine_a.inductance_q_H = 2e-3;
    refused(&machine_a, RUNS "torque_reference,2,Nm\ncurrent_control,pi,\n", "`resistance,VALUE,ohm,SOURCE`");
    machine_a.resistance_ohm = 0.1;
    refused(&machine_a, RUNS "torque_reference,2,Nm\ncurrent_control,pi,\n",
            "`dc_link_voltage,VALUE,V,SOURCE`");
    machine_a.rated_current_A = NAN;
    refused(&machine_a, RUNS "torque_reference,2,Nm\ncurrent_control,hysteresis,\ndc_link_voltage,48,V\n",
            "`hysteresis_band,VALUE,A`");
    s = simulate(&machine_a, RUNS "torque_reference,2,Nm\ncurrent_control,pi,\ndc_link_voltage,48,V\n");
    hci_simulation_release(&s);
    machine_a.inductance_d_H = 0.0;
    refused(&machine_a, RUNS "torque_reference,2,Nm\ncurrent_control,pi,\ndc_link_voltage,48,V\n",
            "not positive definite");
    machine_c.has_neutral = true;
    refused(&machine_c, RUNS "torque_reference,2,Nm\n", "star-neutral");
}

/* Slopes of the inductances are enough for ideal currents, and give the same torque as the inductances do. */
static void test_slopes_alone_do_for_ideal_currents(void)
{
    hci_simulation whole = simulate(&machine_c, RUNS "torque_reference,8,Nm\nstrategy,id0,\n"), slopes;
    hci_inductance *kept = machine_c.inductance;
    machine_c.inductance = NULL;
    machine_c.inductance_count = 0;
    slopes = simulate(&machine_c, RUNS "torque_reference,8,Nm\nstrategy,id0,\n");
    refused(&machine_c, RUNS "torque_reference,8,Nm\ncurrent_control,pi,\n", "slopes only");
    machine_c.inductance = kept;
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, whole.torque_Nm.mean, slopes.torque_Nm.mean);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, whole.T_ripple_percent, slopes.T_ripple_percent);
    TEST_ASSERT_TRUE(isnan(slopes.energy_J.stored));
    hci_simulation_release(&whole);
    hci_simulation_release(&slopes);
}

/* B h/J = 100, far outside what the method can follow. */
static void test_a_step_that_is_too_large_is_said(void)
{
    const hci_scenario scenario =
        scenario_of("duration,10,s\ntorque_reference,8,Nm\nviscous_friction,1000,\nstep,1,ms\n");
    const hci_simulate_options options = {0};
    const hci_simulate_output where = {in_root("out"), NULL};
    hci_simulation s;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_NUMERIC,
                          hci_simulate_to_folder(&machine_c, &scenario, &options, &where, &s, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "smaller `step`"));
    TEST_ASSERT_TRUE(entries(in_root("out")) <= 0);
}

/* ---- failing memory ---- */

/* Lets n allocations succeed, n = 0, 1, 2, … until the run does; every failure says so and leaves no file. */
static void test_every_allocation_may_fail(void)
{
    hci_solution solution =
        solve(&machine_a, "data/scenarios/02/target.csv", HCI_METHOD_AUTO, HCI_STRATEGY_MTPA);
    const hci_simulate_options options = {0};
    const hci_simulate_output where = {in_root("out"), NULL};
    cJSON_Hooks hooks = {hci_memory_malloc, hci_memory_free};
    hci_scenario scenario =
        scenario_of("duration,0.02,s\nprescribed_speed,1500,rpm\ncurrents,solution,\ntorque_reference,2,Nm\n"
                    "step,50,us\nangle_delay,100,us\ntrajectory_every,100,\n");
    hci_status status = HCI_ERROR_MEMORY;
    long n = 0;
    hci_solution_release(&solution);
    cJSON_InitHooks(&hooks);
    for (; status == HCI_ERROR_MEMORY; n += n < 300 ? 1 : 7) {
        hci_simulation s;
        hci_note note = {{0}};
        memset(&s, 0, sizeof s);
        hci_memory_fail_after(n);
        status = hci_scenario_read(in_root("scenario.csv"), &scenario, &note);
        if (!status) status = hci_simulate_to_folder(&machine_a, &scenario, &options, &where, &s, &note);
        hci_memory_fail_after(-1);
        hci_simulation_release(&s);
        if (status == HCI_OK) break;
        TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_ERROR_MEMORY, status, note.text);
        TEST_ASSERT_TRUE(note.text[0] != '\0');
        TEST_ASSERT_TRUE(entries(in_root("out")) <= 0);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, status);
    TEST_ASSERT_EQUAL_INT(3, entries(in_root("out")));
    TEST_ASSERT_TRUE(n > 60);
    cJSON_InitHooks(NULL);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_imposed_currents_keep_the_promise_of_machine_a);
    RUN_TEST(test_imposed_currents_keep_the_promise_of_machine_c);
    RUN_TEST(test_a_solution_is_scaled_by_the_torque);
    RUN_TEST(test_spectrum_is_over_the_angle);
    RUN_TEST(test_turning_backwards_gives_the_same_spectrum);
    RUN_TEST(test_a_rotor_at_rest_has_no_spectrum);
    RUN_TEST(test_strategy_1_of_the_paper);
    RUN_TEST(test_strategies_2_and_3);
    RUN_TEST(test_the_rest_of_strategy_3_is_the_band);
    RUN_TEST(test_figures_are_those_of_the_trajectory);
    RUN_TEST(test_energy_balances);
    RUN_TEST(test_energy_balances_within_a_period);
    RUN_TEST(test_strategy_2_takes_over_at_its_time);
    RUN_TEST(test_pi_control_holds_the_torque);
    RUN_TEST(test_limits_and_missing_currents_are_counted);
    RUN_TEST(test_the_trajectory_is_what_a_logger_reads);
    RUN_TEST(test_readings_are_coarse_and_late);
    RUN_TEST(test_same_input_same_bytes);
    RUN_TEST(test_effects_are_simulated);
    RUN_TEST(test_units_and_relative_paths);
    RUN_TEST(test_wrong_rows_are_refused);
    RUN_TEST(test_contradictions_are_refused);
    RUN_TEST(test_missing_values_are_named_where_needed);
    RUN_TEST(test_slopes_alone_do_for_ideal_currents);
    RUN_TEST(test_a_step_that_is_too_large_is_said);
    RUN_TEST(test_every_allocation_may_fail);
    return UNITY_END();
}
