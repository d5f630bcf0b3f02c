#include "hci/host/samples/samples.h"

#include <stdio.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/plot/plot.h"
#include "host/samples/trajectory.h"
#include "host/samples/waveform_rows.h"

static hci_status reserve(hci_samples *samples, size_t rows, size_t width, hci_note *note)
{
    samples->value = hci_memory_new(rows * width, sizeof *samples->value);
    if (!samples->value) return hci_note_memory(note, NULL, "%zu rows", rows);
    samples->width = width;
    return HCI_OK;
}

void hci_samples_release(hci_samples *samples)
{
    hci_memory_free(samples->value);
    memset(samples, 0, sizeof *samples);
}

/* ---- a solution ---- */

enum { COMPARED_COLUMNS = 3, SOLUTION_COLUMNS = HCI_WAVEFORM_COLUMNS + COMPARED_COLUMNS };

static void fill_compared(const hci_solution *solution, double theta_rad, double row[COMPARED_COLUMNS])
{
    hci_plot_point point;
    hci_plot_solution_point(solution, theta_rad, &point);
    row[0] = point.before_Nm;
    row[1] = point.wanted_Nm;
    row[2] = point.plain_A;
}

hci_status hci_solution_samples(const hci_machine_data *machine, const hci_solution *solution,
                                hci_samples *samples, hci_note *note)
{
    const size_t per_turn = hci_waveform_points_per_turn(solution), rows = per_turn * solution->period_turns;
    memset(samples, 0, sizeof *samples);
    const hci_status status = reserve(samples, rows, SOLUTION_COLUMNS, note);
    if (status) return status;
    samples->rows = rows;
    snprintf(samples->columns, sizeof samples->columns, "%s,torque_before_Nm,torque_wanted_Nm,ia_plain_A",
             HCI_WAVEFORM_NAMES);
    for (size_t k = 0; k < rows; ++k) {
        const double theta_rad = 2.0 * HCI_PI * (double)k / (double)per_turn;
        double *row = samples->value + k * SOLUTION_COLUMNS;
        hci_waveform_row(machine, solution, theta_rad, row);
        fill_compared(solution, theta_rad, row + HCI_WAVEFORM_COLUMNS);
    }
    return HCI_OK;
}

void hci_solution_words(const hci_solution *solution, char *text, size_t size)
{
    hci_plot_facts facts;
    hci_plot_solution_facts(solution, &facts);
    snprintf(text, size, "%s\n%s\n%s", facts.verdict, facts.facts, facts.baseline);
}

/* ---- a simulation ---- */

typedef struct {
    const hci_simulation_observer *next; /* of the caller, or NULL */
    hci_trajectory trajectory;
    hci_samples *samples;
} keeper;

static void keep_row(void *context, const double *row, size_t columns)
{
    hci_samples *samples = context;
    memcpy(samples->value + samples->rows * samples->width, row, columns * sizeof *row);
    ++samples->rows;
}

static size_t columns_of(const char *names)
{
    size_t count = 1;
    for (const char *comma = strchr(names, ','); comma; comma = strchr(comma + 1, ','))
        ++count;
    return count;
}

static hci_status begin(void *context, const hci_simulation_plan *plan, hci_note *note)
{
    keeper *k = context;
    hci_samples *samples = k->samples;
    hci_trajectory_begin(&k->trajectory, plan, keep_row, samples);
    hci_trajectory_names(plan, samples->columns, sizeof samples->columns);
    const hci_status status =
        reserve(samples, plan->steps / plan->steps_per_row + 2, columns_of(samples->columns), note);
    if (status || !k->next || !k->next->begin) return status;
    return k->next->begin(k->next->context, plan, note);
}

static void see_step(void *context, const hci_simulation_step *step)
{
    keeper *k = context;
    hci_trajectory_add(&k->trajectory, step);
    if (k->next) k->next->step(k->next->context, step);
}

hci_status hci_simulate_samples(const hci_machine_data *machine, const hci_scenario *scenario,
                                const hci_simulate_options *options, hci_samples *trajectory,
                                hci_simulation *simulation, hci_note *note)
{
    keeper k = {.next = options->observer, .samples = trajectory};
    const hci_simulation_observer observer = {begin, see_step, &k};
    hci_simulate_options watched = *options;
    memset(trajectory, 0, sizeof *trajectory);
    watched.observer = &observer;
    const hci_status status = hci_simulate(machine, scenario, &watched, simulation, note);
    if (status)
        hci_samples_release(trajectory);
    else
        hci_trajectory_end(&k.trajectory);
    return status;
}
