/* Torque, speed and currents of a simulated drive over time. */
#include <math.h>

#include "host/plot/plot_drive.h"

enum { STRIPS = 60 };

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

static void draw_strips(hci_output *out, const hci_plot_window *w, const hci_svg_box *b)
{
    static const char *const NAME[] = {": ", ": ", ": i_a ", ", i_b ", ", i_c "};
    static const char *const UNIT[] = {"N·m", "rpm", "A", "A", "A"};
    const double width = (b->right - b->left) / STRIPS, span_s = (w->to_s - w->from_s) / STRIPS;
    for (size_t k = 0; k < STRIPS; ++k) {
        const double from_s = w->from_s + span_s * (double)k, left = b->left + width * (double)k;
        const hci_svg_box strip = {left, b->top, left + width, b->bottom};
        hci_svg_tell(out, "");
        hci_svg_tell_value(out, "", 1e3 * from_s, "ms");
        hci_svg_tell_value(out, " to ", 1e3 * (from_s + span_s), "ms");
        for (size_t j = w->first; j <= (size_t)w->last; ++j) {
            const hci_range r = hci_traces_range(w->traces, (hci_trace)j, from_s, from_s + span_s);
            if (r.low > r.high) continue;
            hci_svg_tell_value(out, NAME[j], r.low, UNIT[j]);
            hci_svg_tell_value(out, " to ", r.high, UNIT[j]);
        }
        hci_svg_strip(out, &strip);
    }
}

void hci_plot_traces(hci_output *out, const hci_svg_box *area, const void *window)
{
    static const hci_svg_entry LEGEND[] = {
        {HCI_SVG_LINE, "a", "i_a"}, {HCI_SVG_LINE, "b", "i_b"}, {HCI_SVG_LINE, "c", "i_c"}};
    const hci_plot_window *w = window;
    const hci_svg_axis y = hci_svg_axis_over(range_of(w->traces, w), area->bottom, area->top, 6.0);
    const hci_svg_box b = hci_svg_box_beside(*area, &y);
    hci_svg_axis x = {1e3 * w->from_s, 1e3 * w->to_s, b.left, b.right, 1.0};
    x.step = hci_svg_nice_step((x.high - x.low) / 7.0);
    hci_svg_head(out, &b, w->title, LEGEND, w->first == w->last ? 0 : 3);
    hci_svg_grid(out, &x, &b, false);
    hci_svg_grid(out, &y, &b, true);
    for (size_t j = w->first; j <= (size_t)w->last; ++j)
        draw_trace(out, w->traces, (hci_trace)j, w, &x, &y);
    draw_strips(out, w, &b);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0, "time in ms");
}

void hci_plot_traces_of_two(hci_output *out, const hci_svg_box *area, const void *windows)
{
    const hci_plot_window *w = windows;
    hci_svg_box upper = *area, lower = *area;
    upper.bottom = 0.5 * (area->top + area->bottom) - 38.0;
    lower.top = upper.bottom + 76.0;
    hci_plot_traces(out, &upper, &w[0]);
    hci_plot_traces(out, &lower, &w[1]);
}
