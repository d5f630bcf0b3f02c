/* The page of a simulation. */
#include <math.h>
#include <stdio.h>

#include "html.h"
#include "memory.h"
#include "plot.h"
#include "report.h"

enum { MOST_ORDERS = 24 };

/* ---- verdict ---- */

static void say_verdict(hci_output *out, const hci_simulation *s)
{
    char from[HCI_HTML_NUMBER_SIZE], to[HCI_HTML_NUMBER_SIZE], speed[HCI_HTML_NUMBER_SIZE];
    hci_html_begin(out, "Simulation of the drive",
                   !s->energy_balances ? "Not to be trusted: the energy does not balance"
                   : s->remark.text[0] ? "Done, with a remark"
                                       : "Done",
                   s->energy_balances);
    hci_html_number_text(from, s->from_s);
    hci_html_number_text(to, s->to_s);
    hci_html_number_text(speed, s->speed_rad_per_s.mean * 30.0 / HCI_PI);
    if (s->periods > 0)
        hci_html_say(out, "lead", "Evaluated from %s s to %s s: %zu whole period%s at %s rpm.", from, to,
                     s->periods, s->periods == 1 ? "" : "s", speed);
    else
        hci_html_say(out, "lead",
                     "Evaluated from %s s to %s s, in which the rotor has not turned one period: there is "
                     "no spectrum.",
                     from, to);
    if (s->remark.text[0]) hci_html_paragraph(out, NULL, s->remark.text);
    hci_html_tiles(out);
    hci_html_tile_number(out, "Mean torque", s->torque_Nm.mean, "N·m", "over the evaluated time");
    hci_html_tile_number(out, "T_ripple", s->T_ripple_percent, "%", "100 (T_max − T_min) / T_mean");
    hci_html_tile_number(out, "F_ripple", s->F_ripple_percent, "%", "100 rms(T − T_mean) / T_mean");
    hci_html_tile_number(out, "Copper loss", s->copper_W, "W", "mean");
    hci_html_tile_number(out, "Peak phase current", s->peak_phase_A, "A", "largest of the phases");
    hci_html_tiles_end(out);
}

/* ---- over time ---- */

static void row_of(hci_output *out, const char *name, const hci_statistics *x, double factor)
{
    const double value[] = {x->mean, x->rms, x->least, x->most};
    hci_html_row(out);
    hci_html_cell(out, name);
    for (size_t k = 0; k < 4; ++k)
        hci_html_number(out, factor * value[k]);
    hci_html_row_end(out);
}

static const char *const STATISTICS[] = {"<Quantity", "Mean", "rms", "Least", "Most", NULL};

static void figure_of(hci_output *out, const hci_simulation *s, const hci_traces *t, hci_trace first,
                      hci_trace last, const hci_svg_picture *words)
{
    hci_html_figure(out);
    hci_plot_trace(out, t, words, first, last, s->from_s, s->to_s);
    hci_html_figure_tables(out);
    hci_html_table(out, "Over the evaluated time", STATISTICS);
    if (first == HCI_TRACE_TORQUE_NM) row_of(out, "torque N·m", &s->torque_Nm, 1.0);
    if (first == HCI_TRACE_SPEED_RPM) row_of(out, "speed rpm", &s->speed_rad_per_s, 30.0 / HCI_PI);
    if (first == HCI_TRACE_A_A) {
        row_of(out, "length of the current vector A", &s->current_A, 1.0);
        row_of(out, "√(i_dx² + i_qx²) A", &s->current_dqx_A, 1.0);
    }
    hci_html_table_end(out);
    hci_html_figure_end(out,
                        "True values over the evaluated time, not what sensors read. Where there are more "
                        "samples than can be drawn, the line runs between their extremes.",
                        "summary.json, and trajectory.csv with the course");
}

static void show_traces(hci_output *out, const hci_simulation *s, const hci_traces *t)
{
    static const hci_svg_picture
        TORQUE = {"torque",
                  "Torque in N·m",
                  "A line over time in ms. The table beside it has mean and extremes.",
                  0,
                  0,
                  480,
                  264},
        SPEED = {"speed",
                 "Speed in rpm, mechanical",
                 "A line over time in ms. The table beside it has mean and extremes.",
                 0,
                 0,
                 480,
                 264},
        CURRENT = {"current",
                   "Phase currents in A",
                   "Three lines over time in ms. The table beside it has mean and "
                   "extremes of the current vector.",
                   0,
                   0,
                   480,
                   264};
    hci_html_section(out, "Over time");
    figure_of(out, s, t, HCI_TRACE_TORQUE_NM, HCI_TRACE_TORQUE_NM, &TORQUE);
    figure_of(out, s, t, HCI_TRACE_SPEED_RPM, HCI_TRACE_SPEED_RPM, &SPEED);
    figure_of(out, s, t, HCI_TRACE_A_A, HCI_TRACE_C_A, &CURRENT);
    hci_html_section_end(out);
}

/* ---- spectrum ---- */

static double order_weight(const void *context, size_t k)
{
    const hci_harmonic *h = &((const hci_simulation *)context)->spectrum_Nm[k];
    return k == 0 ? 1e100 : hci_amplitude(h->sine, h->cosine);
}

static void table_of_orders(hci_output *out, const hci_simulation *s)
{
    static const char *const COLUMN[] = {"Order", "Torque N·m", "Phase rad", "% of the mean", NULL};
    size_t place[MOST_ORDERS];
    const size_t count = hci_plot_largest(order_weight, s, s->spectrum_count, MOST_ORDERS, place);
    char caption[120];
    snprintf(caption, sizeof caption, "The mean, order 0, and the largest of %zu orders", s->spectrum_count);
    hci_html_table(out, caption, COLUMN);
    for (size_t k = 0; k < count; ++k) {
        const hci_harmonic h = s->spectrum_Nm[place[k]];
        const bool mean = place[k] == 0;
        const double size_Nm = mean ? h.cosine : hci_amplitude(h.sine, h.cosine);
        hci_html_row(out);
        hci_html_number(out, h.order);
        hci_html_number(out, size_Nm);
        hci_html_number(out, mean ? HCI_PI / 2 : hci_phase_rad(h.sine, h.cosine));
        hci_html_number(out, isfinite(s->T_ripple_percent) ? 100.0 * size_Nm / fabs(s->spectrum_Nm[0].cosine)
                                                           : (double)NAN);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void show_spectrum(hci_output *out, const hci_simulation *s, const hci_plot_order *order)
{
    static const hci_svg_picture WORDS = {
        "spectrum",
        "Torque ripple by electrical order",
        "A stem for each order but 0, the mean: peak amplitude in N·m. The table beside it has the largest.",
        0,
        0,
        480,
        304};
    if (s->spectrum_count < 2) return;
    hci_html_section(out, "Torque ripple by order");
    hci_html_figure(out);
    hci_plot_orders(out, &WORDS, order, s->spectrum_count - 1, false);
    hci_html_figure_tables(out);
    table_of_orders(out, s);
    hci_html_figure_end(out, "Over whole periods of the angle; the picture leaves the mean out.",
                        "spectrum.csv");
    hci_html_section_end(out);
}

/* ---- the rest ---- */

static void show_drive(hci_output *out, const hci_simulation *s)
{
    static const char *const COLUMN[] = {"<Quantity", "Value", NULL};
    hci_html_section(out, "The drive");
    hci_html_table(out, "Loss, switching and energies", COLUMN);
    hci_html_quantity(out, "copper loss in W", s->copper_W);
    hci_html_quantity(out, "amplitude of a plain sine with this mean torque in A", s->plain_amplitude_A);
    hci_html_quantity(out, "copper loss to that of the plain sine", s->loss_to_plain);
    hci_html_quantity(out, "switching frequency in Hz", s->switching_frequency_Hz);
    hci_html_quantity(out, "samples without a current for the torque", (double)s->without_current);
    hci_html_quantity(out, "samples at a current limit", (double)s->limited);
    hci_html_quantity(out, "electrical energy in J", s->energy_J.electrical);
    hci_html_quantity(out, "copper in J", s->energy_J.copper);
    hci_html_quantity(out, "stored in J", s->energy_J.stored);
    hci_html_quantity(out, "to the shaft in J", s->energy_J.mechanical);
    hci_html_quantity(out, "left over by the integration in J", s->energy_J.residual);
    hci_html_quantity(out, "step in s", s->step_s);
    hci_html_table_end(out);
    hci_html_paragraph(out, "quiet", "Numbers: summary.json.");
    hci_html_section_end(out);
}

static void say_sources(hci_output *out, const hci_report_sources *sources)
{
    hci_html_section(out, "Sources");
    if (sources->machine) hci_html_say(out, NULL, "Machine: %s", sources->machine);
    if (sources->scenario) hci_html_say(out, NULL, "Scenario: %s", sources->scenario);
    if (sources->currents) hci_html_say(out, NULL, "Imposed currents: %s", sources->currents);
    hci_html_section_end(out);
}

hci_status hci_report_simulation(hci_output *out, const hci_simulation *s, const hci_traces *traces,
                                 const hci_report_sources *sources, hci_note *note)
{
    hci_plot_order *order = hci_memory_new(s->spectrum_count + 1, sizeof *order);
    if (!order) return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the report");
    for (size_t k = 1; k < s->spectrum_count; ++k) {
        const hci_harmonic h = s->spectrum_Nm[k];
        order[k - 1] = (hci_plot_order){h.order, NAN, hci_amplitude(h.sine, h.cosine), NAN, 0, 0};
    }
    say_verdict(out, s);
    show_traces(out, s, traces);
    show_spectrum(out, s, order);
    show_drive(out, s);
    say_sources(out, sources);
    hci_html_end(out);
    hci_memory_free(order);
    return HCI_OK;
}
