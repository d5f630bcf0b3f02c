/* Path of the mean current vector of a simulated drive over one electrical turn. */
#include "host/plot/plot_drive.h"

static const hci_svg_box BOX = {64, 40, 462, 240};

static void draw_path(hci_output *out, const hci_turn_means *t, const hci_svg_axis *d, const hci_svg_axis *q)
{
    hci_svg_line_begin(out, "path");
    for (size_t k = 0; k <= HCI_TURN_STEPS; ++k) {
        const hci_turn_mean m = hci_turn_mean_of(t, k % HCI_TURN_STEPS, 1);
        if (m.samples > 0)
            hci_svg_line_point(out, hci_svg_at(d, m.current_A.d), hci_svg_at(q, m.current_A.q));
    }
    hci_svg_line_end(out);
}

void hci_plot_turn_vector(hci_output *out, const hci_turn_means *t, hci_dq plain_A)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_DOT, "plain", "plain sine"},
                                           {HCI_SVG_LINE, "path", "mean"}};
    hci_range d_A = {plain_A.d, plain_A.d}, q_A = {plain_A.q, plain_A.q};
    hci_svg_axis d, q;
    for (size_t k = 0; k < HCI_TURN_STEPS; ++k) {
        const hci_turn_mean m = hci_turn_mean_of(t, k, 1);
        if (m.samples == 0) continue;
        hci_range_include(&d_A, m.current_A.d);
        hci_range_include(&q_A, m.current_A.q);
    }
    hci_svg_equal_axes(d_A, q_A, &BOX, &d, &q);
    const hci_svg_box b = hci_svg_box_beside(BOX, &q);
    hci_svg_equal_axes(d_A, q_A, &b, &d, &q);
    hci_svg_begin(
        out, &(hci_svg_picture){
                 "vector", "Current vector in the plane of i_d and i_q",
                 "i_q in A over i_d in A: the path of the mean over all turns, and the point of the plain "
                 "sine with the same mean torque. The table beside it has the numbers.",
                 0, 0, 480, 284});
    hci_svg_head(out, &b, "Current vector, i_q in A", LEGEND, 2);
    hci_svg_grid(out, &d, &b, false);
    hci_svg_grid(out, &q, &b, true);
    draw_path(out, t, &d, &q);
    hci_svg_circle(out, "plain", hci_svg_at(&d, plain_A.d), hci_svg_at(&q, plain_A.q), 4.2);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0, "i_d in A");
    hci_svg_end(out);
}
