/* A solution: four panels on a canvas of 1000 × 792 pixels, and words above and below. */
#include <stdio.h>

#include "host/plot/solution_curves.h"

enum { WIDTH = 1000, HEIGHT = 792 };

static const hci_svg_box TORQUE_BOX = {62, 128, 540, 370}, SPECTRUM_BOX = {622, 128, 980, 370};
static const hci_svg_box CURRENT_BOX = {62, 464, 540, 706}, VECTOR_BOX = {622, 464, 980, 706};

static void draw_words(hci_output *out, const hci_plot_facts *f)
{
    hci_output_text(out, "<style>%s</style>\n", hci_svg_style);
    hci_svg_rectangle(out, "back", 0.0, 0.0, WIDTH, HEIGHT);
    hci_svg_label(out, "verdict", 28.0, 38.0, f->verdict);
    hci_svg_label(out, "facts quiet", 28.0, 62.0, f->facts);
    hci_svg_label(out, "small quiet", 28.0, HEIGHT - 26.0, f->baseline);
    hci_svg_label(
        out, "small quiet", 28.0, HEIGHT - 11.0,
        "Amplitudes are peak values; angles and orders are electrical; the torque is that of the model.");
}

void hci_plot_solution_facts(const hci_solution *solution, hci_plot_facts *facts)
{
    hci_solution_curves c;
    hci_solution_curves_fill_period(&c, solution);
    hci_solution_curve_words(&c, facts);
}

void hci_plot_solution(hci_output *out, const hci_solution *solution)
{
    char description[2 * HCI_PLOT_LINE_SIZE + 200];
    hci_plot_facts f;
    hci_solution_curves c;
    hci_solution_curves_fill(&c, solution);
    hci_plot_solution_facts(solution, &f);
    snprintf(description, sizeof description,
             "%s. Four panels: torque over the electrical angle, torque ripple by electrical order, phase "
             "currents, and the path of the current vector. %s",
             f.facts, f.baseline);
    hci_svg_begin(out, &(hci_svg_picture){"hci", f.verdict, description, 0, 0, WIDTH, HEIGHT});
    draw_words(out, &f);
    hci_panel_torque(out, &c, &TORQUE_BOX);
    hci_panel_spectrum(out, solution, &SPECTRUM_BOX);
    hci_panel_currents(out, &c, &CURRENT_BOX);
    hci_panel_vector(out, &c, &VECTOR_BOX);
    hci_svg_end(out);
}

void hci_plot_solution_torque(hci_output *out, const hci_svg_box *box, const void *solution)
{
    hci_solution_curves c;
    hci_solution_curves_fill(&c, solution);
    hci_panel_torque(out, &c, box);
}

void hci_plot_solution_currents(hci_output *out, const hci_svg_box *box, const void *solution)
{
    hci_solution_curves c;
    hci_solution_curves_fill(&c, solution);
    hci_panel_currents(out, &c, box);
}

void hci_plot_solution_dq(hci_output *out, const hci_svg_box *box, const void *solution)
{
    hci_solution_curves c;
    hci_solution_curves_fill(&c, solution);
    hci_panel_dq(out, &c, box);
}

void hci_plot_solution_spectrum(hci_output *out, const hci_svg_box *box, const void *solution)
{
    hci_panel_spectrum(out, solution, box);
}
