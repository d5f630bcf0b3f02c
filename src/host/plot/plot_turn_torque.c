/* Torque of a simulated drive over one electrical turn: the mean of all turns, and a band of their extremes.
 */
#include "host/plot/plot_drive.h"

static const hci_svg_box BOX = {64, 40, 462, 240};

static double angle_deg(size_t step)
{
    return 360.0 * ((double)step + 0.5) / HCI_TURN_STEPS;
}

/* A stroke from the least to the most of each step; those that touch make a band. */
static void draw_band(hci_output *out, const hci_turn_means *t, const hci_svg_axis *x, const hci_svg_axis *y)
{
    hci_svg_line_begin(out, "haze");
    for (size_t k = 0; k < HCI_TURN_STEPS; ++k) {
        const hci_range r = t->torque_range_Nm[k];
        const double at = hci_svg_at(x, angle_deg(k));
        if (t->samples[k] == 0) continue;
        hci_svg_line_point(out, at, hci_svg_at(y, k % 2 ? r.high : r.low));
        hci_svg_line_point(out, at, hci_svg_at(y, k % 2 ? r.low : r.high));
    }
    hci_svg_line_end(out);
}

static void draw_edge(hci_output *out, const hci_turn_means *t, bool upper, const hci_svg_axis *x,
                      const hci_svg_axis *y)
{
    hci_svg_line_begin(out, "edge");
    for (size_t k = 0; k < HCI_TURN_STEPS; ++k)
        if (t->samples[k] > 0)
            hci_svg_line_point(out, hci_svg_at(x, angle_deg(k)),
                               hci_svg_at(y, upper ? t->torque_range_Nm[k].high : t->torque_range_Nm[k].low));
    hci_svg_line_end(out);
}

static void draw_mean(hci_output *out, const hci_turn_means *t, const char *style, const hci_svg_axis *x,
                      const hci_svg_axis *y)
{
    hci_svg_line_begin(out, style);
    for (size_t k = 0; k < HCI_TURN_STEPS; ++k)
        if (t->samples[k] > 0)
            hci_svg_line_point(out, hci_svg_at(x, angle_deg(k)),
                               hci_svg_at(y, t->torque_Nm[k] / (double)t->samples[k]));
    hci_svg_line_end(out);
}

static hci_range range_of_both(const hci_turn_means *t, const hci_turn_means *before)
{
    hci_range r = hci_turn_mean_of(t, 0, HCI_TURN_STEPS).torque_range_Nm;
    const hci_range plain =
        before ? hci_turn_mean_of(before, 0, HCI_TURN_STEPS).torque_range_Nm : HCI_RANGE_EMPTY;
    hci_range_include(&r, plain.low);
    hci_range_include(&r, plain.high);
    return r;
}

void hci_plot_turn_torque(hci_output *out, const hci_turn_means *t, const hci_turn_means *before)
{
    static const hci_svg_entry ALONE[] = {{HCI_SVG_LINE, "edge", "least and most"},
                                          {HCI_SVG_LINE, "after", "mean"}};
    static const hci_svg_entry COMPARED[] = {{HCI_SVG_LINE, "before", "before"},
                                             {HCI_SVG_LINE, "after", "after"}};
    const hci_svg_axis y = hci_svg_axis_over(range_of_both(t, before), BOX.bottom, BOX.top, 6.0);
    const hci_svg_box b = hci_svg_box_beside(BOX, &y);
    const hci_svg_axis x = hci_svg_axis_of_angle(1.0, &b);
    hci_svg_begin(out,
                  &(hci_svg_picture){
                      "turn", "Torque over one electrical turn",
                      "The mean over all turns in N·m at each electrical angle in degrees, and the band from "
                      "the least to the most; with a plain sine and simulated. The table beside it has the "
                      "numbers.",
                      0, 0, 480, 284});
    hci_svg_head(out, &b, "Torque in N·m", before ? COMPARED : ALONE, 2);
    hci_svg_grid(out, &x, &b, false);
    hci_svg_grid(out, &y, &b, true);
    if (before) draw_band(out, before, &x, &y);
    draw_band(out, t, &x, &y);
    if (before) draw_mean(out, before, "before", &x, &y);
    draw_edge(out, t, false, &x, &y);
    draw_edge(out, t, true, &x, &y);
    draw_mean(out, t, "after", &x, &y);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0,
                  "electrical angle in degrees");
    hci_svg_end(out);
}
