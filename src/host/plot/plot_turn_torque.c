/* Torque of a simulated drive over one electrical turn: the mean of all turns, and a band of their extremes.
 */
#include "host/plot/plot_drive.h"

enum { STRIPS = 60 };

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

static void tell_range(hci_output *out, const char *words, hci_range r)
{
    hci_svg_tell_value(out, words, r.low, "N·m");
    hci_svg_tell_value(out, " to ", r.high, "N·m");
}

static void draw_strips(hci_output *out, const hci_plot_turn *t, const hci_svg_box *b)
{
    const double width = (b->right - b->left) / STRIPS;
    const size_t step = HCI_TURN_STEPS / STRIPS;
    for (size_t k = 0; k < STRIPS; ++k) {
        const double left = b->left + width * (double)k;
        const hci_turn_mean m = hci_turn_mean_of(t->turn, k * step, step);
        if (m.samples == 0 && !t->before) continue;
        hci_svg_tell(out, "");
        hci_svg_tell_value(out, "", 360.0 * ((double)k + 0.5) / STRIPS, "°");
        if (m.samples > 0) {
            hci_svg_tell_value(out, ": mean ", m.torque_Nm, "N·m");
            tell_range(out, ", from ", m.torque_range_Nm);
        }
        if (t->before)
            tell_range(out, "; before from ", hci_turn_mean_of(t->before, k * step, step).torque_range_Nm);
        hci_svg_strip(out, &(hci_svg_box){left, b->top, left + width, b->bottom});
    }
}

void hci_plot_turn_torque(hci_output *out, const hci_svg_box *area, const void *turn)
{
    static const hci_svg_entry ENTRY[] = {{HCI_SVG_LINE, "before", "before"},
                                          {HCI_SVG_LINE, "after", "after, mean"},
                                          {HCI_SVG_LINE, "edge", "least and most"}};
    const hci_plot_turn *t = turn;
    const hci_svg_axis y = hci_svg_axis_over(range_of_both(t->turn, t->before), area->bottom, area->top, 6.0);
    const hci_svg_box b = hci_svg_box_beside(*area, &y);
    const hci_svg_axis x = hci_svg_axis_of_angle(1.0, &b);
    hci_svg_head(out, &b, "Torque in N·m", ENTRY + (t->before ? 0 : 1), t->before ? 3 : 2);
    hci_svg_grid(out, &x, &b, false);
    hci_svg_grid(out, &y, &b, true);
    if (t->before) draw_band(out, t->before, &x, &y);
    draw_band(out, t->turn, &x, &y);
    if (t->before) draw_mean(out, t->before, "before", &x, &y);
    draw_edge(out, t->turn, false, &x, &y);
    draw_edge(out, t->turn, true, &x, &y);
    draw_mean(out, t->turn, "after", &x, &y);
    draw_strips(out, t, &b);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0,
                  "electrical angle in degrees");
}
