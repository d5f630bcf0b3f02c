/* Torque, speed and currents of a simulated drive over time. */
#include <math.h>

#include "host/plot/plot_drive.h"

static const hci_svg_box BOX = {64, 40, 462, 220};

static bool is_shown(const hci_plot_window *w, double time_s, hci_range extremes)
{
    return time_s >= w->from_s && time_s <= w->to_s && extremes.low <= extremes.high;
}

/* Up and down between the extremes, the nearer one first. */
static void draw_trace(hci_output *out, const hci_traces *t, hci_trace j, const hci_plot_window *w,
                       const hci_svg_axis *x, const hci_svg_axis *y)
{
    static const char *const STYLE[] = {"after", "after", "a", "b", "c"};
    double last = 0.0;
    hci_svg_line_begin(out, STYLE[j]);
    for (size_t k = 0; k < HCI_TRACE_INTERVALS; ++k) {
        const hci_range e = t->extremes[j][k];
        const double time_s = hci_traces_time_s(t, k), at = hci_svg_at(x, 1e3 * time_s);
        if (!is_shown(w, time_s, e)) continue;
        const bool low_first = fabs(e.low - last) <= fabs(e.high - last);
        hci_svg_line_point(out, at, hci_svg_at(y, low_first ? e.low : e.high));
        if (e.high > e.low) hci_svg_line_point(out, at, hci_svg_at(y, low_first ? e.high : e.low));
        last = low_first ? e.high : e.low;
    }
    hci_svg_line_end(out);
}

static hci_range range_of(const hci_traces *t, const hci_plot_window *w)
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t j = w->first; j <= (size_t)w->last; ++j) {
        const hci_range one = hci_traces_range(t, (hci_trace)j, w->from_s, w->to_s);
        hci_range_include(&r, one.low);
        hci_range_include(&r, one.high);
    }
    return r;
}

void hci_plot_traces(hci_output *out, const hci_traces *t, const hci_plot_window *w)
{
    static const hci_svg_entry LEGEND[] = {
        {HCI_SVG_LINE, "a", "i_a"}, {HCI_SVG_LINE, "b", "i_b"}, {HCI_SVG_LINE, "c", "i_c"}};
    const hci_svg_axis y = hci_svg_axis_over(range_of(t, w), BOX.bottom, BOX.top, 6.0);
    const hci_svg_box b = hci_svg_box_beside(BOX, &y);
    hci_svg_axis x = {1e3 * w->from_s, 1e3 * w->to_s, b.left, b.right, 1.0};
    x.step = hci_svg_nice_step((x.high - x.low) / 7.0);
    hci_svg_begin(out, w->words);
    hci_svg_head(out, &b, w->words->title, LEGEND, w->first == w->last ? 0 : 3);
    hci_svg_grid(out, &x, &b, false);
    hci_svg_grid(out, &y, &b, true);
    for (size_t j = w->first; j <= (size_t)w->last; ++j)
        draw_trace(out, t, (hci_trace)j, w, &x, &y);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0, "time in ms");
    hci_svg_end(out);
}
