/* The page of a solution. */
#include <math.h>
#include <stdio.h>

#include "html.h"
#include "plot.h"
#include "report.h"

enum { MOST_ORDERS = 32 };

/* ---- verdict ---- */

static double mean_Nm(const hci_solution *s)
{
    return s->order_count > 0 && s->order[0].torque_Nm.order < HCI_ORDER_TOLERANCE
               ? s->order[0].torque_Nm.cosine
               : 0.0;
}

static void show_tiles(hci_output *out, const hci_solution *s, const hci_plot_facts *f)
{
    char remark[96], number[HCI_HTML_NUMBER_SIZE];
    hci_html_tiles(out);
    hci_html_tile_number(out, "Mean torque", mean_Nm(s), "N·m", "electromagnetic, of the model");
    hci_html_quantity_text(number, f->before_Nm.high - f->before_Nm.low, "N·m");
    snprintf(remark, sizeof remark, "before: %s", number);
    hci_html_tile_number(out, "Torque, peak to peak", f->after_Nm.high - f->after_Nm.low, "N·m", remark);
    hci_html_number_text(number, s->worst_order);
    snprintf(remark, sizeof remark, "at order %s", number);
    hci_html_tile_number(out, "Largest error of an order", s->worst_error_Nm, "N·m", remark);
    hci_html_tile_number(out, "Copper loss", s->loss_to_plain, "×", "that of the plain sine");
    hci_html_tile_number(out, "Peak phase current", s->peak_phase_current_A, "A", "largest of the phases");
    hci_html_tiles_end(out);
}

/* ---- tables ---- */

static double amplitude(hci_harmonic h)
{
    return h.order < HCI_ORDER_TOLERANCE ? h.cosine : hci_amplitude(h.sine, h.cosine);
}

static double order_weight(const void *context, size_t k)
{
    const hci_solution *s = context;
    const hci_solved_order *o = &s->order[k];
    const double size_Nm = fmax(fmax(fabs(amplitude(o->target_Nm)), fabs(amplitude(o->torque_Nm))),
                                fabs(amplitude(o->before_Nm)));
    if (o->verdict > HCI_ORDER_FREE) return 1e100 * (1.0 + o->error_Nm);
    return size_Nm > s->tolerance_Nm ? size_Nm : 0.0;
}

static void table_of_orders(hci_output *out, const hci_solution *s)
{
    static const char *const COLUMN[] = {"Order",     "Before N·m", "Wanted N·m", "After N·m",
                                         "Error N·m", "<Verdict",   NULL};
    size_t place[MOST_ORDERS];
    const size_t count = hci_plot_largest(order_weight, s, s->order_count, MOST_ORDERS, place);
    char caption[160];
    snprintf(caption, sizeof caption,
             "Peak amplitudes; order 0 is the mean. %zu of %zu orders, those missed and the largest", count,
             s->order_count);
    hci_html_table(out, caption, COLUMN);
    for (size_t k = 0; k < count; ++k) {
        const hci_solved_order *o = &s->order[place[k]];
        hci_html_row(out);
        hci_html_number(out, o->torque_Nm.order);
        hci_html_number(out, amplitude(o->before_Nm));
        hci_html_number(out, amplitude(o->target_Nm));
        hci_html_number(out, amplitude(o->torque_Nm));
        hci_html_number(out, o->error_Nm);
        hci_html_cell(out, hci_order_verdict_name(o->verdict));
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void row_of_range(hci_output *out, const char *name, hci_svg_range r)
{
    hci_html_row(out);
    hci_html_cell(out, name);
    hci_html_number(out, r.low);
    hci_html_number(out, r.high);
    hci_html_number(out, r.high - r.low);
    hci_html_row_end(out);
}

static void table_of_torque(hci_output *out, const hci_plot_facts *f)
{
    static const char *const COLUMN[] = {"<Torque", "Least N·m", "Most N·m", "Peak to peak N·m", NULL};
    hci_html_table(out, "Extremes over the period", COLUMN);
    row_of_range(out, "before", f->before_Nm);
    row_of_range(out, "wanted", f->wanted_Nm);
    row_of_range(out, "after", f->after_Nm);
    hci_html_table_end(out);
}

static void table_of_waves(hci_output *out, const hci_solution *s)
{
    static const char *const COLUMN[] = {"Order", "<Set", "Amplitude A", "Phase rad", NULL};
    hci_html_table(out, "Current harmonics: A sin(nθ + γ) in phase a", COLUMN);
    for (size_t k = 0; k < s->current.count; ++k) {
        const hci_wave *w = &s->current.wave[k];
        hci_html_row(out);
        hci_html_number(out, w->order);
        hci_html_cell(out, hci_set_name(s->current.set[k]));
        hci_html_number(out, hci_amplitude(w->sine, w->cosine));
        hci_html_number(out, hci_phase_rad(w->sine, w->cosine));
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void table_of_vector(hci_output *out, const hci_plot_facts *f)
{
    static const char *const COLUMN[] = {"<Current", "Least A", "Most A", "Swing A", NULL};
    hci_html_table(out, "Extremes over the period", COLUMN);
    row_of_range(out, "i_d before", (hci_svg_range){f->plain_dq_A.d, f->plain_dq_A.d});
    row_of_range(out, "i_q before", (hci_svg_range){f->plain_dq_A.q, f->plain_dq_A.q});
    row_of_range(out, "i_d after", f->d_A);
    row_of_range(out, "i_q after", f->q_A);
    hci_html_table_end(out);
}

/* ---- figures ---- */

static void show_torque(hci_output *out, const hci_machine_data *machine, const hci_solution *s,
                        const hci_plot_facts *f)
{
    hci_html_section(out, "Torque");
    hci_html_figure(out);
    hci_plot_solution_panel(out, machine, s, HCI_PANEL_TORQUE);
    hci_html_figure_tables(out);
    table_of_torque(out, f);
    hci_html_figure_end(out, f->baseline, "waveform.csv");
    hci_html_figure(out);
    hci_plot_solution_panel(out, machine, s, HCI_PANEL_SPECTRUM);
    hci_html_figure_tables(out);
    table_of_orders(out, s);
    hci_html_figure_end(out, "The picture leaves the mean, order 0, out.", "spectrum.csv");
    hci_html_section_end(out);
}

static void show_currents(hci_output *out, const hci_machine_data *machine, const hci_solution *s,
                          const hci_plot_facts *f)
{
    hci_html_section(out, "Currents");
    hci_html_figure(out);
    hci_plot_solution_panel(out, machine, s, HCI_PANEL_CURRENT);
    hci_html_figure_tables(out);
    table_of_waves(out, s);
    hci_html_figure_end(out, f->baseline, "currents.csv");
    hci_html_figure(out);
    hci_plot_solution_panel(out, machine, s, HCI_PANEL_VECTOR);
    hci_html_figure_tables(out);
    table_of_vector(out, f);
    hci_html_figure_end(out, "A plain sine is one point in this plane, since it turns with the rotor.",
                        "waveform.csv");
    hci_html_section_end(out);
}

/* ---- cost and method ---- */

static void show_cost(hci_output *out, const hci_solution *s)
{
    static const char *const COLUMN[] = {"<Quantity", "Value", NULL};
    hci_html_section(out, "What it costs, and how it was found");
    hci_html_table(out, "Cost and limits", COLUMN);
    hci_html_quantity(out, "mean of i_a² + i_b² + i_c² in A²", s->mean_square_A2);
    hci_html_quantity(out, "amplitude of the plain sine in A", s->plain_amplitude_A);
    hci_html_quantity(out, "copper loss to that of the plain sine", s->loss_to_plain);
    hci_html_quantity(out, "copper loss to the least possible", s->loss_to_limit);
    hci_html_quantity(out, "peak phase current in A", s->peak_phase_current_A);
    hci_html_quantity(out, "peak line voltage in V", s->peak_line_voltage_V);
    hci_html_quantity(out, "largest mean torque within the current limit in N·m", s->torque_at_limit_Nm);
    hci_html_table_end(out);
    hci_html_say(out, NULL, "Method: %s; %zu equations for %zu unknowns, rank %zu%s.",
                 hci_method_name(s->method), s->rows, s->unknowns, s->rank,
                 s->newton_steps == 0  ? ""
                 : s->newton_converged ? "; Newton's method converged"
                                       : "; Newton's method did not converge, this is the nearest answer");
    if (s->with_effects) hci_html_paragraph(out, NULL, "The machine is taken with its effects.");
    if (s->remark.text[0]) hci_html_paragraph(out, NULL, s->remark.text);
    hci_html_paragraph(out, "quiet", "Numbers: summary.json.");
    hci_html_section_end(out);
}

static void say_sources(hci_output *out, const hci_report_sources *sources)
{
    hci_html_section(out, "Sources");
    if (sources->machine) hci_html_say(out, NULL, "Machine: %s", sources->machine);
    if (sources->target) hci_html_say(out, NULL, "Wanted torque: %s", sources->target);
    if (sources->harmonics) hci_html_say(out, NULL, "Harmonics to use: %s", sources->harmonics);
    hci_html_section_end(out);
}

void hci_report_solution(hci_output *out, const hci_machine_data *machine, const hci_solution *s,
                         hci_status verdict, const hci_report_sources *sources)
{
    hci_plot_facts f;
    hci_plot_solution_facts(machine, s, &f);
    hci_html_begin(out, "Currents for a wanted torque", verdict == HCI_OK ? "Reached" : "Not reached",
                   verdict == HCI_OK);
    hci_html_paragraph(out, "lead", f.verdict);
    show_tiles(out, s, &f);
    show_torque(out, machine, s, &f);
    show_currents(out, machine, s, &f);
    show_cost(out, s);
    say_sources(out, sources);
    hci_html_end(out);
}
