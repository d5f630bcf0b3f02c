/* Drives that are simulated in a test: machines A and C, scenarios from rows of text, what `solve` promised
 * against what the plant does. Include once in a test. */
#ifndef SIMULATING_H
#define SIMULATING_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "hci/host/report/write.h"
#include "host/base/memory.h"
#include "support/draws.h"
#include "support/files.h"
#include "unity.h"

static hci_machine_data machine_a, machine_c;

static inline void drives_start(void)
{
    hci_note note = {{0}};
    files_begin();
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read("data/machine_a", &machine_a, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read("data/machine_c", &machine_c, &note), note.text);
}

static inline void drives_end(void)
{
    hci_memory_fail_after(-1);
    hci_machine_release(&machine_a);
    hci_machine_release(&machine_c);
    files_end();
}

/* A scenario of rows under the header. */
static inline hci_scenario scenario_of(const char *rows)
{
    hci_scenario s;
    hci_note note = {{0}};
    char text[2048];
    snprintf(text, sizeof text, "name,value,unit\n%s", rows);
    files_write(files_path("scenario.csv"), text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_scenario_read(files_path("scenario.csv"), &s, &note), note.text);
    return s;
}

static inline hci_simulation simulate_into(const hci_machine_data *machine, const hci_scenario *scenario,
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

static inline hci_simulation simulate(const hci_machine_data *machine, const char *rows)
{
    const hci_scenario scenario = scenario_of(rows);
    return simulate_into(machine, &scenario, NULL);
}

/* A whole column of a file in the temporary folder; to be freed. */
static inline double *column(const char *file, const char *name, size_t *rows)
{
    hci_csv *csv;
    hci_note note = {{0}};
    double *values;
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(files_path(file), &csv, &note), note.text);
    *rows = hci_csv_rows(csv);
    values = malloc((*rows + 1) * sizeof *values);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_numbers(csv, name, values, &note), note.text);
    hci_csv_free(csv);
    return values;
}

/* ---- promised and simulated torque ---- */

static inline hci_solution solve(const hci_machine_data *machine, const char *target_file, hci_method method,
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
    TEST_ASSERT_EQUAL(HCI_OK, hci_solution_write(machine, &solution, status, files_path("solution"), &note));
    return solution;
}

static inline double difference(hci_harmonic a, hci_harmonic b)
{
    return hypot(a.sine - b.sine, a.cosine - b.cosine);
}

/* The promise at an order; an order that is not in it is promised zero. */
static inline hci_harmonic promised(const hci_solution *solution, double order)
{
    for (size_t k = 0; k < solution->order_count; ++k)
        if (fabs(solution->order[k].torque_Nm.order - order) < 1e-9) return solution->order[k].torque_Nm;
    return (hci_harmonic){order, 0.0, 0.0};
}

/* 1e-6 of the mean: the promise is exact, the table's cubic is off by (2π 60/4096)⁴/384 = 2e-7 of an order
 * 60, and periods that end between steps by 1e-7. */
static inline void assert_promise_is_kept(const hci_machine_data *machine, const char *rows,
                                          hci_solution *solution)
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

/* ---- scenarios that cannot be simulated ---- */

static inline void refused(const hci_machine_data *machine, const char *rows, const char *words)
{
    char text[1024];
    hci_scenario scenario;
    hci_simulation s;
    hci_note note = {{0}};
    const hci_simulate_options options = {0};
    const hci_simulate_output where = {files_path("refused"), NULL};
    hci_status status;
    snprintf(text, sizeof text, "name,value,unit\n%s", rows);
    files_write(files_path("scenario.csv"), text);
    status = hci_scenario_read(files_path("scenario.csv"), &scenario, &note);
    if (!status) {
        status = hci_simulate_to_folder(machine, &scenario, &options, &where, &s, &note);
        TEST_ASSERT_NULL(s.spectrum_Nm);
    }
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_ERROR_INPUT, status, rows);
    if (!strstr(note.text, words)) printf("%s\n    lacks %s\n", note.text, words);
    TEST_ASSERT_NOT_NULL(strstr(note.text, words));
    TEST_ASSERT_EQUAL_INT(-1, files_count(files_path("refused")));
}

#endif
