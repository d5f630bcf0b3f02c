/* Torque, speed and currents over time. */
#include "host/draw/plot_traces.h"

#include <math.h>

static const hci_svg_box BOX = {64, 40, 462, 220};

void hci_traces_begin(hci_traces *t, double from_s, double to_s)
{
    t->from_s = from_s;
    t->to_s = to_s;
    hci_turn_means_begin(&t->turn);
    for (size_t j = 0; j < HCI_TRACES; ++j)
        for (size_t k = 0; k < HCI_TRACE_INTERVALS; ++k)
            t->extremes[j][k] = HCI_RANGE_EMPTY;
}

/* The time of an interval's middle, and the interval of a time. */
static double middle_s(const hci_traces *t, size_t k)
{
    return t->from_s + (t->to_s - t->from_s) * ((double)k + 0.5) / HCI_TRACE_INTERVALS;
}

void hci_traces_add(hci_traces *t, double time_s, double theta_e_rad, const double value[HCI_TRACES])
{
    const double share = (time_s - t->from_s) / (t->to_s - t->from_s);
    if (!(share >= 0.0 && share <= 1.0)) return;
    const size_t k = (size_t)fmin(HCI_TRACE_INTERVALS * share, HCI_TRACE_INTERVALS - 1.0);
    for (size_t j = 0; j < HCI_TRACES; ++j)
        hci_range_include(&t->extremes[j][k], value[j]);
    hci_turn_means_add(&t->turn, theta_e_rad, value[HCI_TRACE_TORQUE_NM],
                       hci_park(hci_clarke(&value[HCI_TRACE_A_A]), theta_e_rad));
}

static bool is_inside(const hci_traces *t, hci_trace j, size_t k, double from_s, double to_s)
{
    const double at_s = middle_s(t, k);
    return at_s >= from_s && at_s <= to_s && t->extremes[j][k].low <= t->extremes[j][k].high;
}

hci_range hci_traces_range(const hci_traces *t, hci_trace j, double from_s, double to_s)
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t k = 0; k < HCI_TRACE_INTERVALS; ++k) {
        if (!is_inside(t, j, k, from_s, to_s)) continue;
        hci_range_include(&r, t->extremes[j][k].low);
        hci_range_include(&r, t->extremes[j][k].high);
    }
    return r;
}

/* Up and down between the extremes, the nearer one first. */
static void draw_trace(hci_output *out, const hci_traces *t, hci_trace j, const char *style,
                       const hci_svg_axis *x, const hci_svg_axis *y)
{
    double last = 0.0;
    hci_svg_line_begin(out, style);
    for (size_t k = 0; k < HCI_TRACE_INTERVALS; ++k) {
        const hci_range e = t->extremes[j][k];
        const double at = hci_svg_at(x, 1e3 * middle_s(t, k));
        if (!is_inside(t, j, k, 1e-3 * x->low, 1e-3 * x->high)) continue;
        const bool low_first = fabs(e.low - last) <= fabs(e.high - last);
        hci_svg_line_point(out, at, hci_svg_at(y, low_first ? e.low : e.high));
        if (e.high > e.low) hci_svg_line_point(out, at, hci_svg_at(y, low_first ? e.high : e.low));
        last = low_first ? e.high : e.low;
    }
    hci_svg_line_end(out);
}

void hci_plot_trace(hci_output *out, const hci_traces *t, const hci_svg_picture *words, hci_trace first,
                    hci_trace last, double from_s, double to_s)
{
    static const char *const STYLE[] = {"after", "after", "a", "b", "c"};
    static const hci_svg_entry LEGEND[] = {
        {HCI_SVG_LINE, "a", "i_a"}, {HCI_SVG_LINE, "b", "i_b"}, {HCI_SVG_LINE, "c", "i_c"}};
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t j = first; j <= (size_t)last; ++j) {
        const hci_range one = hci_traces_range(t, (hci_trace)j, from_s, to_s);
        hci_range_include(&r, one.low);
        hci_range_include(&r, one.high);
    }
    const hci_svg_axis y = hci_svg_axis_over(r, BOX.bottom, BOX.top, 6.0);
    const hci_svg_box b = hci_svg_box_beside(BOX, &y);
    hci_svg_axis x = {1e3 * from_s, 1e3 * to_s, b.left, b.right, 1.0};
    x.step = hci_svg_nice_step((x.high - x.low) / 7.0);
    hci_svg_begin(out, words);
    hci_svg_head(out, &b, words->title, LEGEND, first == last ? 0 : 3);
    hci_svg_grid(out, &x, &b, false);
    hci_svg_grid(out, &y, &b, true);
    for (size_t j = first; j <= (size_t)last; ++j)
        draw_trace(out, t, (hci_trace)j, STYLE[j], &x, &y);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0, "time in ms");
    hci_svg_end(out);
}
