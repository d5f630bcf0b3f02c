/* The section of a simulation over the time. */
#include "host/draw/html.h"
#include "host/plot/plot_drive.h"
#include "host/report/page/simulation_sections.h"

enum { SLICES = 20 }; /* of the evaluated time: rows of a table */

static void row_of(hci_output *out, const char *name, const hci_statistics *x, double factor)
{
    const double value[] = {x->mean, x->rms, x->least, x->most};
    hci_html_row(out);
    hci_html_cell(out, name);
    for (size_t k = 0; k < 4; ++k)
        hci_html_number_in(out, factor * value[k], factor * (x->most - x->least));
    hci_html_row_end(out);
}

/* The extremes of slices of the window, which are what the picture draws. */
static void table_of_slices(hci_output *out, const hci_traces *t, const hci_plot_window *w)
{
    static const char *const ONE[] = {"From ms", "to ms", "Least", "Most", NULL};
    static const char *const THREE[] = {"From ms",  "to ms",     "Least i_a", "Most i_a", "Least i_b",
                                        "Most i_b", "Least i_c", "Most i_c",  NULL};
    const double slice_s = (w->to_s - w->from_s) / SLICES;
    const hci_range all = hci_traces_range(t, w->first, w->from_s, w->to_s);
    const double span = all.high - all.low;
    hci_html_table(out, "Extremes over the time", w->first == w->last ? ONE : THREE);
    for (size_t k = 0; k < SLICES; ++k) {
        const double from_s = w->from_s + slice_s * (double)k, to_s = from_s + slice_s;
        hci_html_row(out);
        hci_html_number(out, 1e3 * from_s);
        hci_html_number(out, 1e3 * to_s);
        for (size_t j = w->first; j <= (size_t)w->last; ++j) {
            const hci_range r = hci_traces_range(t, (hci_trace)j, from_s, to_s);
            hci_html_number_in(out, r.low, span);
            hci_html_number_in(out, r.high, span);
        }
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void table_of_statistics(hci_output *out, const hci_simulation *s, hci_trace first)
{
    static const char *const COLUMN[] = {"<Quantity", "Mean", "rms", "Least", "Most", NULL};
    hci_html_table(out, "Over the evaluated time", COLUMN);
    if (first == HCI_TRACE_TORQUE_NM) row_of(out, "torque N·m", &s->torque_Nm, 1.0);
    if (first == HCI_TRACE_SPEED_RPM) row_of(out, "speed rpm", &s->speed_rad_per_s, 30.0 / HCI_PI);
    if (first == HCI_TRACE_A_A) {
        row_of(out, "length of the current vector A", &s->current_A, 1.0);
        row_of(out, "√(i_dx² + i_qx²) A", &s->current_dqx_A, 1.0);
    }
    hci_html_table_end(out);
}

static void show_window(hci_output *out, const hci_simulation *s, const hci_traces *t,
                        const hci_plot_window *w, const char *origin)
{
    hci_html_figure(out);
    hci_plot_traces(out, t, w);
    hci_html_figure_tables(out);
    table_of_statistics(out, s, w->first);
    table_of_slices(out, t, w);
    hci_html_figure_end(
        out,
        "True values, not what sensors read; between extremes where samples are denser than the picture.",
        "summary.json, and trajectory.csv with the course", origin);
}

void hci_page_traces(hci_output *out, const hci_simulation *s, const hci_traces *t, const char *origin)
{
    static const char LINE[] = "A line over time in ms. The table beside it has mean and extremes.";
    static const char LINES[] = "Three lines over time in ms. The tables beside it have the extremes over "
                                "the time, and mean and extremes of the current vector.";
    static const hci_svg_picture TORQUE = {"torque", "Torque in N·m", LINE, 0, 0, 480, 264},
                                 SPEED = {"speed", "Speed in rpm, mechanical", LINE, 0, 0, 480, 264},
                                 CURRENT = {"current", "Phase currents in A", LINES, 0, 0, 480, 264};
    const hci_plot_window window[] = {{&TORQUE, HCI_TRACE_TORQUE_NM, HCI_TRACE_TORQUE_NM, s->from_s, s->to_s},
                                      {&SPEED, HCI_TRACE_SPEED_RPM, HCI_TRACE_SPEED_RPM, s->from_s, s->to_s},
                                      {&CURRENT, HCI_TRACE_A_A, HCI_TRACE_C_A, s->from_s, s->to_s}};
    hci_html_section(out, "Over time");
    for (size_t k = 0; k < sizeof window / sizeof *window; ++k)
        show_window(out, s, t, &window[k], origin);
    hci_html_section_end(out);
}
