/* The files that a simulation is written to: trajectory.csv, spectrum.csv, summary.json and report.html. */
#include <math.h>

#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"
#include "hci/machine/frames.h"
#include "host/base/memory.h"
#include "host/report/page/page.h"
#include "host/report/summary.h"
#include "host/samples/trajectory.h"

/* ---- what is kept of the steps ---- */

typedef struct {
    const hci_simulate_output *where;
    const hci_simulation_observer *next; /* of the caller, or NULL */
    hci_output *out;
    hci_trajectory trajectory;
    hci_traces *traces; /* for the report, or NULL */
} writer;

/* The report draws what is evaluated. */
static hci_status begin_traces(writer *w, const hci_simulation_plan *plan, hci_note *note)
{
    if (!w->where->sources) return HCI_OK;
    w->traces = hci_memory_new(1, sizeof *w->traces);
    if (!w->traces) return hci_note_memory(note, NULL, "the report");
    hci_traces_begin(w->traces, plan->settle_s, (double)plan->steps * plan->step_s);
    return HCI_OK;
}

/* Files are opened before the first step, so that a folder that cannot be written to costs no time. */
static hci_status begin(void *context, const hci_simulation_plan *plan, hci_note *note)
{
    writer *w = context;
    hci_status status = hci_output_open(w->where->folder, &w->out, note);
    if (!status) status = hci_trajectory_begin_file(&w->trajectory, w->out, plan, note);
    if (!status) status = begin_traces(w, plan, note);
    if (!status && w->next && w->next->begin) status = w->next->begin(w->next->context, plan, note);
    return status;
}

static void add_to_traces(hci_traces *traces, const hci_simulation_step *step)
{
    double value[HCI_TRACES];
    value[HCI_TRACE_TORQUE_NM] = step->torque_Nm;
    value[HCI_TRACE_SPEED_RPM] = step->speed_rad_per_s * 30.0 / HCI_PI;
    hci_plane_to_abc(step->i_A, &value[HCI_TRACE_A_A]);
    hci_traces_add(traces, step->time_s, step->theta_e_rad, value);
}

static void see_step(void *context, const hci_simulation_step *step)
{
    writer *w = context;
    if (w->traces) add_to_traces(w->traces, step);
    hci_trajectory_add(&w->trajectory, step);
    if (w->next) w->next->step(w->next->context, step);
}

/* ---- the other files ---- */

/* At order 0 the amplitude is the signed mean and the phase π/2, so that A sin(nθ + γ) holds for every row.
 */
static hci_status write_spectrum(hci_output *out, const hci_simulation *s, hci_note *note)
{
    const hci_status status = hci_output_file(out, "spectrum.csv", note);
    if (status) return status;
    hci_output_text(out, "order,torque_Nm,torque_phase_rad\n");
    for (size_t k = 0; k < s->spectrum_count; ++k) {
        const hci_harmonic h = s->spectrum_Nm[k];
        hci_output_number(out, h.order, ',');
        hci_output_number(out, k == 0 ? h.cosine : hci_amplitude(h.sine, h.cosine), ',');
        hci_output_number(out, k == 0 ? HCI_PI / 2 : hci_phase_rad(h.sine, h.cosine), '\n');
    }
    return HCI_OK;
}

static hci_status write_report(const writer *w, const hci_simulation *s, hci_note *note)
{
    const hci_report_sources *sources = w->where->sources;
    if (!sources) return hci_output_without(w->out, "report.html", note);
    const hci_status status = hci_output_file(w->out, "report.html", note);
    return status ? status : hci_page_simulation(w->out, s, w->traces, sources, note);
}

static hci_status write_rest(writer *w, const hci_simulation *s, hci_note *note)
{
    hci_status status;
    hci_trajectory_end(&w->trajectory);
    status = write_spectrum(w->out, s, note);
    if (!status) status = write_report(w, s, note);
    return status ? status : hci_summary_write(w->out, hci_simulation_json(s), note);
}

hci_status hci_simulate_to_folder(const hci_machine_data *machine, const hci_scenario *scenario,
                                  const hci_simulate_options *options, const hci_simulate_output *where,
                                  hci_simulation *simulation, hci_note *note)
{
    writer w = {.where = where, .next = options->observer};
    const hci_simulation_observer observer = {begin, see_step, &w};
    hci_simulate_options watched = *options;
    hci_status status;
    watched.observer = &observer;
    status = hci_simulate(machine, scenario, &watched, simulation, note);
    if (!status) status = write_rest(&w, simulation, note);
    if (status)
        hci_output_discard(w.out);
    else
        status = hci_output_commit(w.out, note);
    if (status) hci_simulation_release(simulation);
    hci_memory_free(w.traces);
    return status;
}
