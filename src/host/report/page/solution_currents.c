/* The section of a solution about its currents: of the phases, and their vector. */
#include <math.h>

#include "host/draw/html.h"
#include "host/report/page/solution_sections.h"

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

static void table_of_currents_over_turn(const hci_solution_page *p)
{
    static const char *const COLUMN[] = {"Angle °", "i_a before A", "i_a A", "i_b A", "i_c A", NULL};
    hci_html_table(p->out, "Phase currents over the electrical angle", COLUMN);
    for (size_t k = 0; k <= HCI_PAGE_STEPS; ++k) {
        const hci_plot_point *x = &p->point[k];
        hci_page_row(
            p->out,
            (const double[]){hci_page_angle_deg(k), x->plain_A, x->phase_A[0], x->phase_A[1], x->phase_A[2]},
            5);
    }
    hci_html_table_end(p->out);
}

static void tables_of_currents(const hci_solution_page *p)
{
    table_of_waves(p);
    table_of_currents_over_turn(p);
}

static void table_of_vector_over_turn(const hci_solution_page *p)
{
    static const char *const COLUMN[] = {"Angle °", "i_d A", "i_q A", "Length A", NULL};
    hci_html_table(p->out, "Current vector over the electrical angle, after", COLUMN);
    for (size_t k = 0; k <= HCI_PAGE_STEPS; ++k) {
        const hci_dq i = p->point[k].dq_A;
        hci_page_row(p->out, (const double[]){hci_page_angle_deg(k), i.d, i.q, hypot(i.d, i.q)}, 4);
    }
    hci_html_table_end(p->out);
}

static void tables_of_vector(const hci_solution_page *p)
{
    static const char *const COLUMN[] = {"<Current", "Least A", "Most A", "Swing A", NULL};
    const hci_plot_facts *f = &p->facts;
    hci_html_table(p->out, "Extremes over the period", COLUMN);
    hci_page_row_of_range(p->out, "i_d before", (hci_range){f->plain_dq_A.d, f->plain_dq_A.d}, 0.0);
    hci_page_row_of_range(p->out, "i_q before", (hci_range){f->plain_dq_A.q, f->plain_dq_A.q}, 0.0);
    hci_page_row_of_range(p->out, "i_d after", f->d_A, 0.0);
    hci_page_row_of_range(p->out, "i_q after", f->q_A, 0.0);
    hci_html_table_end(p->out);
    table_of_vector_over_turn(p);
}

void hci_page_currents(const hci_solution_page *p)
{
    hci_html_section(p->out, "Currents");
    hci_page_panel(p, HCI_PANEL_CURRENT, tables_of_currents, p->facts.baseline,
                   "currents.csv and waveform.csv");
    hci_page_panel(p, HCI_PANEL_VECTOR, tables_of_vector,
                   "A plain sine is one point in this plane, since it turns with the rotor. d is the magnet "
                   "axis, q leads it.",
                   "waveform.csv");
    hci_html_section_end(p->out);
}
