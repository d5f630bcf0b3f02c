/* The files that a solution is written to. */
#include "host/report/write_solution.h"

#include <math.h>
#include <string.h>

#include "hci/host/currents/solution_folder.h"
#include "hci/host/report/summary.h"
#include "host/plot/plot.h"
#include "host/report/page/page.h"
#include "host/report/summary.h"
#include "host/samples/waveform_rows.h"

static void write_currents(hci_output *out, const hci_currents *currents, const hci_wave *wave,
                           const char *amplitude_column)
{
    hci_output_text(out, "order,set,%s,phase_rad\n", amplitude_column);
    for (size_t k = 0; k < currents->count; ++k) {
        hci_output_number(out, wave[k].order, ',');
        hci_output_text(out, "%s,", hci_set_name(currents->set[k]));
        hci_output_number(out, hci_amplitude(wave[k].sine, wave[k].cosine), ',');
        hci_output_number(out, hci_phase_rad(wave[k].sine, wave[k].cosine), '\n');
    }
}

/* At order 0 the amplitude is the signed mean and the phase π/2, so that A sin(nθ + γ) holds for every
 * row. */
static void write_polar(hci_output *out, hci_harmonic h)
{
    const bool mean = h.order < HCI_ORDER_TOLERANCE;
    hci_output_number(out, mean ? h.cosine : hci_amplitude(h.sine, h.cosine), ',');
    hci_output_number(out, mean ? HCI_PI / 2 : hci_phase_rad(h.sine, h.cosine), ',');
}

static void write_spectrum(hci_output *out, const hci_solution *s)
{
    hci_output_text(out, "order,target_Nm,target_phase_rad,torque_Nm,torque_phase_rad,error_Nm,before_Nm,"
                         "before_phase_rad,verdict\n");
    for (size_t k = 0; k < s->order_count; ++k) {
        const hci_solved_order *o = &s->order[k];
        hci_output_number(out, o->torque_Nm.order, ',');
        write_polar(out, o->target_Nm);
        write_polar(out, o->torque_Nm);
        hci_output_number(out, o->error_Nm, ',');
        write_polar(out, o->before_Nm);
        hci_output_text(out, "%s\n", hci_order_verdict_name(o->verdict));
    }
}

static void write_waveform(hci_output *out, const hci_machine_data *m, const hci_solution *s)
{
    const size_t per_turn = hci_waveform_points_per_turn(s);
    double row[HCI_WAVEFORM_COLUMNS];
    hci_output_text(out, "%s\n", HCI_WAVEFORM_NAMES);
    for (size_t k = 0; k < per_turn * s->period_turns; ++k) {
        hci_waveform_row(m, s, 2.0 * HCI_PI * (double)k / (double)per_turn, row);
        for (size_t column = 0; column < HCI_WAVEFORM_COLUMNS; ++column)
            hci_output_number(out, row[column], column + 1 < HCI_WAVEFORM_COLUMNS ? ',' : '\n');
    }
}

static hci_status begin_file(hci_output *out, hci_solution_file file, hci_note *note)
{
    return hci_output_file(out, hci_solution_file_name(file), note);
}

/* A file of one part of the currents, or none where they have no parts. */
static hci_status write_part(hci_output *out, hci_solution_file file, const hci_solution *s,
                             const hci_wave *wave, const char *amplitude_column, hci_note *note)
{
    const hci_status status =
        wave ? begin_file(out, file, note) : hci_output_without(out, hci_solution_file_name(file), note);
    if (!status && wave) write_currents(out, &s->current, wave, amplitude_column);
    return status;
}

static hci_status write_files(hci_output *out, const hci_machine_data *m, const hci_solution *s,
                              hci_note *note)
{
    hci_status status = write_part(out, HCI_SOLUTION_CURRENTS, s, s->current.wave, "amplitude_A", note);
    if (!status)
        status = write_part(out, HCI_SOLUTION_CURRENTS_PER_NM, s, s->per_Nm, "amplitude_A_per_Nm", note);
    if (!status)
        status = write_part(out, HCI_SOLUTION_CURRENTS_CONSTANT, s, s->constant, "amplitude_A", note);
    if (!status) status = begin_file(out, HCI_SOLUTION_SPECTRUM, note);
    if (!status) write_spectrum(out, s);
    if (!status) status = begin_file(out, HCI_SOLUTION_WAVEFORM, note);
    if (!status) write_waveform(out, m, s);
    if (!status) status = begin_file(out, HCI_SOLUTION_PICTURE, note);
    if (!status) hci_plot_solution(out, s);
    return status;
}

static hci_status write_report(hci_output *out, const hci_solution *s, hci_status verdict,
                               const hci_report_sources *sources, hci_note *note)
{
    const hci_status status =
        sources ? begin_file(out, HCI_SOLUTION_REPORT, note)
                : hci_output_without(out, hci_solution_file_name(HCI_SOLUTION_REPORT), note);
    if (!status && sources) hci_page_solution(out, s, verdict, sources);
    return status;
}

hci_status hci_solution_write_into(hci_output *out, const hci_machine_data *machine,
                                   const hci_solution *solution, hci_status verdict,
                                   const hci_report_sources *sources, hci_note *note)
{
    hci_status status = write_files(out, machine, solution, note);
    if (!status) status = write_report(out, solution, verdict, sources, note);
    return status ? status : hci_summary_write(out, hci_solution_json(solution, verdict), note);
}

hci_status hci_solution_write(const hci_machine_data *machine, const hci_solution *solution,
                              hci_status verdict, const char *folder, hci_note *note)
{
    return hci_solution_write_with_report(machine, solution, verdict, NULL, folder, note);
}

hci_status hci_solution_write_with_report(const hci_machine_data *machine, const hci_solution *solution,
                                          hci_status verdict, const hci_report_sources *sources,
                                          const char *folder, hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    status = hci_solution_write_into(out, machine, solution, verdict, sources, note);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}
