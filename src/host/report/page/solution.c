/* The page of a solution. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/draw/html.h"
#include "host/plot/plot.h"
#include "host/report/page/page.h"

/* STEPS: rows of the tables over one turn, not at the same phase of each sixth of it, where the ripple
 * repeats. */
enum { MOST_ORDERS = 32, STEPS = 32 };

/* Torque below this share of the tolerance is rounding. */
#define ROUNDING 1e-3

typedef struct {
    hci_output *out;
    const hci_solution *solution;
    hci_plot_facts facts;
    hci_plot_point point[STEPS + 1]; /* over the first electrical turn */
    char origin[HCI_PAGE_ORIGIN_SIZE];
} page;

/* ---- verdict ---- */

static bool has_mean(const hci_solution *s)
{
    return s->order_count > 0 && s->order[0].torque_Nm.order < HCI_ORDER_TOLERANCE;
}

static double mean_Nm(const hci_solution *s)
{
    return has_mean(s) ? s->order[0].torque_Nm.cosine : 0.0;
}

/* "by 3.8 N·m", "by less than 1 pN·m" */
static void say_swing(char text[HCI_HTML_NUMBER_SIZE + 16], hci_range r)
{
    char swing[HCI_HTML_NUMBER_SIZE];
    hci_html_quantity_text(swing, r.high - r.low, "N·m");
    snprintf(text, HCI_HTML_NUMBER_SIZE + 16, "by %s%s", swing[0] == '<' ? "less than" : "",
             swing + (swing[0] == '<'));
}

/* What a reader wants to know who will not read on. */
static void say_verdict(const page *p, hci_status verdict)
{
    const hci_solution *s = p->solution;
    const bool is_smooth = p->facts.wanted_Nm.high - p->facts.wanted_Nm.low <= s->tolerance_Nm;
    char mean[HCI_HTML_NUMBER_SIZE], before[HCI_HTML_NUMBER_SIZE + 16], after[HCI_HTML_NUMBER_SIZE + 16],
        loss[128] = "";
    hci_html_quantity_text(mean, mean_Nm(s), "N·m");
    say_swing(before, p->facts.before_Nm);
    say_swing(after, p->facts.after_Nm);
    if (isfinite(s->loss_to_plain)) {
        char ratio[HCI_HTML_NUMBER_SIZE];
        hci_html_number_text(ratio, s->loss_to_plain);
        snprintf(loss, sizeof loss, ", for %s times the copper loss of the plain sine", ratio);
    }
    hci_html_say(
        p->out, "lead",
        "With these currents the machine makes %s on average%s. From peak to peak its torque varies %s, "
        "with a plain sine %s%s.",
        mean,
        verdict != HCI_OK ? ", but not all that was asked for"
        : is_smooth       ? " and no ripple, as was asked for"
                          : " and the ripple that was asked for",
        after, before, loss);
    hci_html_paragraph(p->out, NULL, p->facts.verdict);
}

static void show_tiles(const page *p)
{
    const hci_solution *s = p->solution;
    const hci_range before = p->facts.before_Nm, after = p->facts.after_Nm;
    char remark[96], number[HCI_HTML_NUMBER_SIZE];
    hci_html_tiles(p->out);
    hci_html_tile_number(p->out, "Mean torque", mean_Nm(s), "N·m", "electromagnetic, of the model");
    hci_html_quantity_text(number, before.high - before.low, "N·m");
    snprintf(remark, sizeof remark, "before: %s", number);
    hci_html_tile_number(p->out, "Torque, peak to peak", after.high - after.low, "N·m", remark);
    hci_html_number_text(number, s->worst_order);
    snprintf(remark, sizeof remark, "at order %s", number);
    hci_html_tile_number(p->out, "Largest error of an order", s->worst_error_Nm, "N·m", remark);
    hci_html_tile_number(p->out, "Copper loss", s->loss_to_plain, "×", "that of the plain sine");
    hci_html_tile_number(p->out, "Peak phase current", s->peak_phase_current_A, "A", "largest of the phases");
    hci_html_tiles_end(p->out);
}

/* ---- tables over one turn ---- */

static void row_of_numbers(hci_output *out, const double *value, size_t count)
{
    hci_html_row(out);
    for (size_t k = 0; k < count; ++k)
        hci_html_number(out, value[k]);
    hci_html_row_end(out);
}

static double angle_deg(size_t step)
{
    return 360.0 / STEPS * (double)step;
}

static void table_of_torque_over_turn(const page *p)
{
    static const char *const COLUMN[] = {"Angle °", "Before N·m", "Wanted N·m", "After N·m", NULL};
    hci_html_table(p->out, "Torque over the electrical angle", COLUMN);
    for (size_t k = 0; k <= STEPS; ++k) {
        const hci_plot_point *x = &p->point[k];
        row_of_numbers(p->out, (const double[]){angle_deg(k), x->before_Nm, x->wanted_Nm, x->after_Nm}, 4);
    }
    hci_html_table_end(p->out);
}

static void table_of_currents_over_turn(const page *p)
{
    static const char *const COLUMN[] = {"Angle °", "i_a before A", "i_a A", "i_b A", "i_c A", NULL};
    hci_html_table(p->out, "Phase currents over the electrical angle", COLUMN);
    for (size_t k = 0; k <= STEPS; ++k) {
        const hci_plot_point *x = &p->point[k];
        row_of_numbers(
            p->out, (const double[]){angle_deg(k), x->plain_A, x->phase_A[0], x->phase_A[1], x->phase_A[2]},
            5);
    }
    hci_html_table_end(p->out);
}

static void table_of_vector_over_turn(const page *p)
{
    static const char *const COLUMN[] = {"Angle °", "i_d A", "i_q A", "Length A", NULL};
    hci_html_table(p->out, "Current vector over the electrical angle, after", COLUMN);
    for (size_t k = 0; k <= STEPS; ++k) {
        const hci_dq i = p->point[k].dq_A;
        row_of_numbers(p->out, (const double[]){angle_deg(k), i.d, i.q, hypot(i.d, i.q)}, 4);
    }
    hci_html_table_end(p->out);
}

/* least: what is below it is rounding. */
static void row_of_range(hci_output *out, const char *name, hci_range r, double least)
{
    hci_html_row(out);
    hci_html_cell(out, name);
    hci_html_number(out, r.low);
    hci_html_number(out, r.high);
    hci_html_number_above(out, r.high - r.low, least);
    hci_html_row_end(out);
}

static void tables_of_torque(const page *p)
{
    static const char *const COLUMN[] = {"<Torque", "Least N·m", "Most N·m", "Peak to peak N·m", NULL};
    const double least_Nm = ROUNDING * p->solution->tolerance_Nm;
    hci_html_table(p->out, "Extremes over the period", COLUMN);
    row_of_range(p->out, "before", p->facts.before_Nm, least_Nm);
    row_of_range(p->out, "wanted", p->facts.wanted_Nm, least_Nm);
    row_of_range(p->out, "after", p->facts.after_Nm, least_Nm);
    hci_html_table_end(p->out);
    table_of_torque_over_turn(p);
}

static void table_of_waves(const page *p)
{
    static const char *const COLUMN[] = {"Order", "<Set", "Amplitude A", "Phase rad", NULL};
    const hci_currents *c = &p->solution->current;
    hci_html_table(p->out, "Current harmonics: A sin(nθ + γ) in phase a", COLUMN);
    for (size_t k = 0; k < c->count; ++k) {
        const hci_wave *w = &c->wave[k];
        hci_html_row(p->out);
        hci_html_number(p->out, w->order);
        hci_html_cell(p->out, hci_set_name(c->set[k]));
        hci_html_number(p->out, hci_amplitude(w->sine, w->cosine));
        hci_html_number(p->out, hci_phase_rad(w->sine, w->cosine));
        hci_html_row_end(p->out);
    }
    hci_html_table_end(p->out);
}

static void tables_of_currents(const page *p)
{
    table_of_waves(p);
    table_of_currents_over_turn(p);
}

static void tables_of_vector(const page *p)
{
    static const char *const COLUMN[] = {"<Current", "Least A", "Most A", "Swing A", NULL};
    const hci_plot_facts *f = &p->facts;
    hci_html_table(p->out, "Extremes over the period", COLUMN);
    row_of_range(p->out, "i_d before", (hci_range){f->plain_dq_A.d, f->plain_dq_A.d}, 0.0);
    row_of_range(p->out, "i_q before", (hci_range){f->plain_dq_A.q, f->plain_dq_A.q}, 0.0);
    row_of_range(p->out, "i_d after", f->d_A, 0.0);
    row_of_range(p->out, "i_q after", f->q_A, 0.0);
    hci_html_table_end(p->out);
    table_of_vector_over_turn(p);
}

/* ---- spectrum ---- */

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

static void table_of_orders(const page *p)
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
            hci_html_number_above(p->out, value[j], ROUNDING * s->tolerance_Nm);
        cell_of_verdict(p->out, o);
        hci_html_row_end(p->out);
    }
    hci_html_table_end(p->out);
}

/* ---- figures ---- */

static void show_panel(const page *p, hci_plot_panel panel, void (*tables)(const page *p),
                       const char *caption, const char *numbers)
{
    hci_html_figure(p->out);
    hci_plot_solution_panel(p->out, p->solution, panel);
    hci_html_figure_tables(p->out);
    tables(p);
    hci_html_figure_end(p->out, caption, numbers, p->origin);
}

static void show_torque(const page *p)
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
    show_panel(p, HCI_PANEL_TORQUE, tables_of_torque, p->facts.baseline, "waveform.csv");
    show_panel(p, HCI_PANEL_SPECTRUM, table_of_orders, caption, "spectrum.csv");
    hci_html_section_end(p->out);
}

static void show_currents(const page *p)
{
    hci_html_section(p->out, "Currents");
    show_panel(p, HCI_PANEL_CURRENT, tables_of_currents, p->facts.baseline, "currents.csv and waveform.csv");
    show_panel(p, HCI_PANEL_VECTOR, tables_of_vector,
               "A plain sine is one point in this plane, since it turns with the rotor. d is the magnet "
               "axis, q leads it.",
               "waveform.csv");
    hci_html_section_end(p->out);
}

/* ---- cost and method ---- */

static void show_cost(const page *p)
{
    static const char *const COLUMN[] = {"<Quantity", "Value", NULL};
    const hci_solution *s = p->solution;
    hci_output *out = p->out;
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

/* ---- the page ---- */

void hci_page_solution(hci_output *out, const hci_solution *s, hci_status verdict,
                       const hci_report_sources *sources)
{
    page p = {.out = out, .solution = s};
    hci_plot_solution_facts(s, &p.facts);
    hci_page_origin(p.origin, sources);
    for (size_t k = 0; k <= STEPS; ++k)
        hci_plot_solution_point(s, angle_deg(k) * HCI_PI / 180.0, &p.point[k]);
    hci_html_begin(out, "Currents for a wanted torque", verdict == HCI_OK ? "Reached" : "Not reached",
                   verdict == HCI_OK);
    say_verdict(&p, verdict);
    show_tiles(&p);
    show_torque(&p);
    show_currents(&p);
    hci_page_solution_system(out, s, p.origin);
    show_cost(&p);
    hci_page_show_sources(out, sources);
    hci_html_end(out);
}
