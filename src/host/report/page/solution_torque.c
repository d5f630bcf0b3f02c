/* The sections of a solution about its torque: over the angle and by order. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/report/page/solution_sections.h"

enum { MOST_ORDERS = 32 }; /* that the table lists */

/* ---- over the angle ---- */

static void row_of_range(hci_output *out, const char *name, hci_range r, double least)
{
    hci_html_row(out);
    hci_html_cell(out, name);
    hci_html_number(out, r.low);
    hci_html_number(out, r.high);
    hci_html_number_above(out, r.high - r.low, least);
    hci_html_row_end(out);
}

static void table_of_extremes(const hci_solution_page *p)
{
    static const char *const COLUMN[] = {"<Torque", "Least N·m", "Most N·m", "Peak to peak N·m", NULL};
    const double least_Nm = HCI_PAGE_ROUNDING * p->solution->tolerance_Nm;
    hci_html_table(p->out, "Extremes over the period", COLUMN);
    row_of_range(p->out, "before", p->facts.before_Nm, least_Nm);
    row_of_range(p->out, "wanted", p->facts.wanted_Nm, least_Nm);
    row_of_range(p->out, "after", p->facts.after_Nm, least_Nm);
    hci_html_table_end(p->out);
}

void hci_page_torque_caption(const hci_solution *s, char text[256])
{
    const double bound_Nm = hci_plot_expected_Nm(s);
    char bound[HCI_HTML_NUMBER_SIZE];
    hci_html_quantity_text(bound, bound_Nm, "N·m");
    snprintf(text, 256, "The torque that the model makes of currents that flow exactly.");
    if (bound_Nm > 0.0)
        snprintf(text + strlen(text), 256 - strlen(text),
                 " The band is %s high: from peak to peak 19 of 20 machines that the recordings allow are no "
                 "further from it.",
                 bound);
}

void hci_page_torque(const hci_solution_page *p)
{
    char heading[256], caption[256], before[HCI_PAGE_SWING_SIZE], after[HCI_PAGE_SWING_SIZE];
    hci_page_torque_caption(p->solution, caption);
    const hci_html_drawing drawing = {
        .id = "torque",
        .title = "Torque over the electrical angle: before, wanted, after",
        .description = "Lines in N·m over the electrical angle in degrees. The table has the extremes.",
        .caption = caption,
        .wide = 262,
        .narrow = 280,
        .draw = hci_plot_solution_torque,
        .context = p->solution};
    hci_page_swing(before, p->facts.before_Nm, p->solution->tolerance_Nm);
    hci_page_swing(after, p->facts.after_Nm, p->solution->tolerance_Nm);
    const bool is_smooth = strncmp(after, "less than", 9) == 0; /* than the tolerance of the model */
    snprintf(heading, sizeof heading,
             is_smooth ? "In the model nothing is left of a ripple of %.0s%s"
                       : "Over the angle the torque varies by %s, before by %s",
             after, before);
    hci_html_section(p->out, heading);
    hci_html_drawing_begin(p->out, &drawing);
    table_of_extremes(p);
    hci_html_drawing_end(p->out, "waveform.csv", p->origin);
    hci_html_section_end(p->out);
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

static size_t count_missed(const hci_solution *s)
{
    size_t count = 0;
    for (size_t k = 0; k < s->order_count; ++k)
        count += s->order[k].verdict > HCI_ORDER_FREE;
    return count;
}

static void heading_of_orders(const hci_solution *s, char text[256])
{
    char error[HCI_HTML_NUMBER_SIZE], order[HCI_HTML_NUMBER_SIZE], tolerance[HCI_HTML_NUMBER_SIZE];
    const size_t missed = count_missed(s);
    hci_html_quantity_text(error, s->worst_error_Nm, "N·m");
    hci_html_quantity_text(tolerance, s->tolerance_Nm, "N·m");
    hci_html_number_text(order, s->worst_order);
    if (missed == 0)
        snprintf(text, 256, "Every order of the torque is within %s of what is wanted", tolerance);
    else
        snprintf(text, 256,
                 "%zu of %zu orders of the torque %s not as wanted; the furthest, %s, is off by %s", missed,
                 s->order_count, missed == 1 ? "is" : "are", order, error);
}

void hci_page_torque_orders(const hci_solution_page *p)
{
    char caption[400], heading[256], tolerance[HCI_HTML_NUMBER_SIZE];
    hci_html_quantity_text(tolerance, p->solution->tolerance_Nm, "N·m");
    snprintf(caption, sizeof caption,
             "Peak amplitudes without the mean, order 0. An order counts as reached within %s of what is "
             "wanted; a dashed line shows this where it is high enough to be seen.",
             tolerance);
    const hci_html_drawing drawing = {
        .id = "spectrum",
        .title = "Torque ripple by electrical order: before, wanted, after",
        .description = "Bars in N·m, peak amplitude, three for each order. The table has the numbers.",
        .caption = caption,
        .wide = 240,
        .narrow = 290,
        .draw = hci_plot_solution_spectrum,
        .context = p->solution};
    heading_of_orders(p->solution, heading);
    hci_html_section(p->out, heading);
    hci_html_drawing_begin(p->out, &drawing);
    table_of_orders(p);
    hci_html_drawing_end(p->out, "spectrum.csv", p->origin);
    hci_html_section_end(p->out);
}
