/* The sections of a solution about its currents: of the phases, and their vector. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/report/page/solution_sections.h"

static void row_of_range(hci_output *out, const char *name, hci_range r)
{
    const double value[] = {r.low, r.high, r.high - r.low};
    hci_html_row(out);
    hci_html_cell(out, name);
    for (size_t k = 0; k < 3; ++k)
        hci_html_number(out, value[k]);
    hci_html_row_end(out);
}

static void table_of_waves(const hci_solution_page *p)
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

static void heading_of_currents(const hci_solution *s, char text[256])
{
    char before[HCI_HTML_NUMBER_SIZE], after[HCI_HTML_NUMBER_SIZE], ratio[HCI_HTML_NUMBER_SIZE];
    hci_html_quantity_text(before, s->plain_amplitude_A, "A");
    hci_html_quantity_text(after, s->peak_phase_current_A, "A");
    hci_page_ratio(ratio, s->loss_to_plain);
    if (!hci_page_has_plain(s))
        snprintf(text, 256, "It takes a current of %s at the peak", after);
    else
        snprintf(text, 256, "The phases carry %s at the peak, the %s %s; copper loss is %s%s", after,
                 s->plain_is_held ? "held fundamental" : "plain sine", before,
                 strcmp(ratio, "1") == 0 ? "the same" : ratio, strcmp(ratio, "1") == 0 ? "" : " times that");
}

void hci_page_currents(const hci_solution_page *p)
{
    char heading[256];
    const hci_html_drawing drawing = {
        .id = "current",
        .title = "Phase currents over the electrical angle",
        .description = "Lines in A over the electrical angle in degrees: the plain sine of phase a, and of "
                       "the solution the three phases, or phase a alone over several turns.",
        .caption = p->facts.baseline,
        .wide = 285,
        .narrow = 300,
        .draw = hci_plot_solution_currents,
        .context = p->solution};
    heading_of_currents(p->solution, heading);
    hci_html_section(p->out, heading);
    hci_html_drawing_begin(p->out, &drawing);
    table_of_waves(p);
    hci_html_drawing_end(p->out, "currents.csv and waveform.csv", p->origin);
    hci_html_section_end(p->out);
}

/* ---- the vector ---- */

static void table_of_vector(const hci_solution_page *p)
{
    static const char *const COLUMN[] = {"<Current", "Least A", "Most A", "Swing A", NULL};
    const hci_plot_facts *f = &p->facts;
    hci_html_table(p->out, "Extremes over the period", COLUMN);
    row_of_range(p->out, "i_d before", (hci_range){f->plain_dq_A.d, f->plain_dq_A.d});
    row_of_range(p->out, "i_q before", (hci_range){f->plain_dq_A.q, f->plain_dq_A.q});
    row_of_range(p->out, "i_d after", f->d_A);
    row_of_range(p->out, "i_q after", f->q_A);
    hci_html_table_end(p->out);
}

#define LARGE 0.01 /* of the largest wave */

/* Of what is at least this share of the largest wave. */
static double highest_rotor_order(const hci_solution *s, double share)
{
    double highest = 0.0, largest_A = 0.0;
    for (size_t k = 0; k < s->current.count; ++k)
        largest_A = fmax(largest_A, hci_amplitude(s->current.wave[k].sine, s->current.wave[k].cosine));
    for (size_t k = 0; k < s->current.count; ++k)
        if (hci_amplitude(s->current.wave[k].sine, s->current.wave[k].cosine) >= share * largest_A)
            highest = fmax(highest, fabs(s->current.wave[k].order - s->current.wave[k].sequence));
    return highest;
}

static void heading_of_vector(const hci_solution_page *p, char text[512])
{
    char d_low[HCI_HTML_NUMBER_SIZE], d_high[HCI_HTML_NUMBER_SIZE], q_low[HCI_HTML_NUMBER_SIZE],
        q_high[HCI_HTML_NUMBER_SIZE], order[HCI_HTML_NUMBER_SIZE];
    hci_html_number_text(d_low, p->facts.d_A.low);
    hci_html_number_text(d_high, p->facts.d_A.high);
    hci_html_number_text(q_low, p->facts.q_A.low);
    hci_html_number_text(q_high, p->facts.q_A.high);
    const double highest = highest_rotor_order(p->solution, 0.0);
    const double large = highest_rotor_order(p->solution, LARGE);
    hci_html_number_text(order, highest);
    snprintf(text, 512,
             "The current loop has to move i_d from %s to %s A and i_q from %s to %s A, up to "
             "electrical order %s",
             d_low, d_high, q_low, q_high, order);
    if (large < highest) {
        const size_t used = strlen(text);
        hci_html_number_text(order, large);
        snprintf(text + used, 512 - used, "; above order %s by less than 1 %% of the largest component",
                 order);
    }
}

void hci_page_vector(const hci_solution_page *p)
{
    char heading[512];
    const hci_html_drawing drawing = {
        .id = "vector",
        .title = "Currents i_d and i_q over the electrical angle",
        .description =
            "Lines in A over the electrical angle in degrees: i_d and i_q of the plain sine, which "
            "stand still, and of the solution. The table has the extremes.",
        .caption = "A plain sine stands still here, since it turns with the rotor; what moves is what the "
                   "current loop has to follow. d is the magnet axis, q leads it.",
        .wide = 262,
        .narrow = 290,
        .draw = hci_plot_solution_dq,
        .context = p->solution};
    if (p->solution->current.count == 0) return;
    heading_of_vector(p, heading);
    hci_html_section(p->out, heading);
    hci_html_drawing_begin(p->out, &drawing);
    table_of_vector(p);
    hci_html_drawing_end(p->out, "waveform.csv", p->origin);
    hci_html_section_end(p->out);
}
