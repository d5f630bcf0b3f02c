/* The section of a solution about its torque: over the angle and by order. */
#include <math.h>
#include <stdio.h>

#include "host/draw/html.h"
#include "host/report/page/solution_sections.h"

enum { MOST_ORDERS = 32 }; /* that the table lists */

/* ---- over the angle ---- */

static void table_of_torque_over_turn(const hci_solution_page *p)
{
    static const char *const COLUMN[] = {"Angle °", "Before N·m", "Wanted N·m", "After N·m", NULL};
    hci_html_table(p->out, "Torque over the electrical angle", COLUMN);
    for (size_t k = 0; k <= HCI_PAGE_STEPS; ++k) {
        const hci_plot_point *x = &p->point[k];
        hci_page_row(p->out, (const double[]){hci_page_angle_deg(k), x->before_Nm, x->wanted_Nm, x->after_Nm},
                     4);
    }
    hci_html_table_end(p->out);
}

static void tables_of_torque(const hci_solution_page *p)
{
    static const char *const COLUMN[] = {"<Torque", "Least N·m", "Most N·m", "Peak to peak N·m", NULL};
    const double least_Nm = HCI_PAGE_ROUNDING * p->solution->tolerance_Nm;
    hci_html_table(p->out, "Extremes over the period", COLUMN);
    hci_page_row_of_range(p->out, "before", p->facts.before_Nm, least_Nm);
    hci_page_row_of_range(p->out, "wanted", p->facts.wanted_Nm, least_Nm);
    hci_page_row_of_range(p->out, "after", p->facts.after_Nm, least_Nm);
    hci_html_table_end(p->out);
    table_of_torque_over_turn(p);
}

/* ---- by order ---- */

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

/* Of an order that nothing reaches, also what would. */
static void cell_of_verdict(hci_output *out, const hci_solved_order *o)
{
    static const char *const SEQUENCE[] = {"neg", "zero", "pos"};
    char text[96], order[HCI_HTML_NUMBER_SIZE];
    snprintf(text, sizeof text, "%s", hci_order_verdict_name(o->verdict));
    if (hci_remedy_exists(o)) {
        hci_html_number_text(order, o->remedy.order);
        snprintf(text, sizeof text, "%s; %s %s would reach it", hci_order_verdict_name(o->verdict),
                 SEQUENCE[o->remedy.sequence + 1], order);
    }
    hci_html_cell_words(out, text);
}

static void table_of_orders(const hci_solution_page *p)
{
    static const char *const COLUMN[] = {"Order",     "Before N·m", "Wanted N·m", "After N·m",
                                         "Error N·m", "<Verdict",   NULL};
    const hci_solution *s = p->solution;
    size_t place[MOST_ORDERS];
    const size_t count = hci_plot_largest(order_weight, s, s->order_count, MOST_ORDERS, place);
    char caption[160];
    snprintf(caption, sizeof caption,
             "Peak amplitudes; order 0 is the mean. %zu of %zu orders, those missed and the largest", count,
             s->order_count);
    hci_html_table(p->out, caption, COLUMN);
    for (size_t k = 0; k < count; ++k) {
        const hci_solved_order *o = &s->order[place[k]];
        hci_html_row(p->out);
        hci_html_number(p->out, o->torque_Nm.order);
        const double value[] = {amplitude(o->before_Nm), amplitude(o->target_Nm), amplitude(o->torque_Nm),
                                o->error_Nm};
        for (size_t j = 0; j < sizeof value / sizeof *value; ++j)
            hci_html_number_above(p->out, value[j], HCI_PAGE_ROUNDING * s->tolerance_Nm);
        cell_of_verdict(p->out, o);
        hci_html_row_end(p->out);
    }
    hci_html_table_end(p->out);
}

/* ---- the section ---- */

void hci_page_torque(const hci_solution_page *p)
{
    char caption[400], tolerance[HCI_HTML_NUMBER_SIZE];
    hci_html_quantity_text(tolerance, p->solution->tolerance_Nm, "N·m");
    snprintf(
        caption, sizeof caption,
        "An order counts as reached when it is within %s of what is wanted; a dashed line shows this where "
        "it is "
        "high enough to be seen. What is left below is rounding, and less than a thousandth of it is shown "
        "as 0. "
        "The picture leaves the mean, order 0, out.",
        tolerance);
    hci_html_section(p->out, "Torque");
    hci_page_panel(p, HCI_PANEL_TORQUE, tables_of_torque, p->facts.baseline, "waveform.csv");
    hci_page_panel(p, HCI_PANEL_SPECTRUM, table_of_orders, caption, "spectrum.csv");
    hci_html_section_end(p->out);
}
