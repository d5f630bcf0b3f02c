/* Torque ripple by electrical order: before, wanted, after. */
#include <math.h>
#include <stdio.h>

#include "host/plot/solution_curves.h"

enum { MOST_GROUPS = 16 };

/* Bars below this share of the largest would be less than a pixel high. */
#define LEAST_SHOWN 5e-3

/* By what orders are chosen for display: their size; a missed one counts at least a share of the largest. */
static double display_size_Nm(const hci_solved_order *o, double largest_Nm)
{
    const double size_Nm = fmax(hci_order_largest_Nm(o), o->error_Nm);
    return hci_order_is_missed(o) ? fmax(size_Nm, 0.02 * largest_Nm + o->error_Nm) : size_Nm;
}

static bool is_ripple(const hci_solved_order *o)
{
    return hci_order_number(o) >= HCI_ORDER_TOLERANCE;
}

static double largest_ripple_Nm(const hci_solution *s)
{
    double largest = 0.0;
    for (size_t k = 0; k < s->order_count; ++k)
        if (is_ripple(&s->order[k])) largest = fmax(largest, hci_order_largest_Nm(&s->order[k]));
    return largest;
}

typedef struct {
    const hci_solution *solution;
    double largest_Nm;
} ripple;

/* The orders that have a group of bars, `width` pixels each, from `left` on. */
typedef struct {
    size_t order[MOST_GROUPS], count;
    double left, width;
} groups;

/* 0 for an order that gets no group of bars. */
static double group_weight(const void *context, size_t k)
{
    const ripple *r = context;
    const hci_solved_order *o = &r->solution->order[k];
    const double size_Nm = display_size_Nm(o, r->largest_Nm);
    return is_ripple(o) && size_Nm > LEAST_SHOWN * r->largest_Nm ? size_Nm : 0.0;
}

/* The largest, in the middle of the box. */
static groups groups_in(const hci_svg_box *b, const ripple *r)
{
    groups g;
    g.count = hci_plot_largest(group_weight, r, r->solution->order_count, MOST_GROUPS, g.order);
    g.width = fmin((b->right - b->left) / (double)(g.count > 0 ? g.count : 1), 110.0);
    g.left = 0.5 * (b->left + b->right - g.width * (double)g.count);
    return g;
}

/* A height of nothing still shows as a line. */
static void draw_bar(hci_output *out, const char *style, double left, double width, double value,
                     const hci_svg_axis *y)
{
    hci_svg_rectangle(out, style, left, fmin(hci_svg_at(y, value), y->from - 1.5), left + width, y->from);
}

/* The bars of an order tell its amplitudes. */
static void begin_group(hci_output *out, const hci_solved_order *o)
{
    char order[HCI_SVG_NUMBER_SIZE];
    hci_svg_short_text(order, hci_order_number(o));
    hci_svg_tell(out, "order ");
    hci_svg_tell_more(out, order);
    hci_svg_tell_value(out, ": before ", hci_peak_Nm(o->before_Nm), "N·m");
    hci_svg_tell_value(out, ", wanted ", hci_peak_Nm(o->target_Nm), "N·m");
    hci_svg_tell_value(out, ", after ", hci_peak_Nm(o->torque_Nm), "N·m");
    hci_svg_tell_more(out, "; ");
    hci_svg_tell_more(out, hci_order_verdict_name(o->verdict));
    hci_svg_hint(out);
}

static void draw_group(hci_output *out, const hci_solved_order *o, double middle, double width,
                       const hci_svg_axis *y)
{
    const double bar = fmin(24.0, 0.27 * width), top = hci_svg_at(y, hci_order_largest_Nm(o)) - 9.0;
    begin_group(out, o);
    draw_bar(out, "before", middle - 1.5 * bar, bar, hci_peak_Nm(o->before_Nm), y);
    draw_bar(out, "wanted", middle - 0.5 * bar, bar, hci_peak_Nm(o->target_Nm), y);
    draw_bar(out, "after", middle + 0.5 * bar, bar, hci_peak_Nm(o->torque_Nm), y);
    if (o->verdict == HCI_ORDER_UNREACHABLE) hci_svg_cross(out, middle, top);
    if (hci_order_is_missed(o) && o->verdict != HCI_ORDER_UNREACHABLE)
        hci_svg_circle(out, "ring", middle, top, 4.0);
    hci_svg_hint_end(out);
}

/* Bars, and the orders below. */
static void draw_groups(hci_output *out, const hci_solution *s, const groups *g, const hci_svg_axis *y)
{
    hci_svg_tag tag[MOST_GROUPS];
    for (size_t k = 0; k < g->count; ++k) {
        const hci_solved_order *o = &s->order[g->order[k]];
        tag[k].x = g->left + g->width * ((double)k + 0.5);
        tag[k].style = hci_order_is_missed(o) ? "no middle" : "quiet middle";
        hci_svg_short_text(tag[k].text, hci_order_number(o));
        draw_group(out, o, tag[k].x, g->width, y);
    }
    hci_svg_tags(out, tag, g->count, y->from);
}

static void draw_spectrum_foot(hci_output *out, const hci_solution *s, const hci_svg_box *b, size_t shown,
                               size_t eligible)
{
    static const hci_svg_entry MARKS[] = {{HCI_SVG_DOT, "ring", "missed"},
                                          {HCI_SVG_CROSS, "", "unreachable"}};
    bool missed = false, unreachable = false;
    char text[80];
    for (size_t k = 0; k < s->order_count; ++k) {
        unreachable = unreachable || s->order[k].verdict == HCI_ORDER_UNREACHABLE;
        missed =
            missed || (hci_order_is_missed(&s->order[k]) && s->order[k].verdict != HCI_ORDER_UNREACHABLE);
    }
    if (shown < eligible)
        snprintf(text, sizeof text, "electrical order, the largest %zu of %zu", shown, eligible);
    else
        snprintf(text, sizeof text, "electrical order");
    hci_svg_label(out, "quiet", b->left, b->bottom + 39.0, text);
    hci_svg_legend(out, missed ? MARKS : MARKS + 1, (size_t)missed + (size_t)unreachable, b->right,
                   b->bottom + 39.0);
}

void hci_panel_spectrum(hci_output *out, const hci_solution *s, const hci_svg_box *box)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_BAR, "before", "before"},
                                           {HCI_SVG_BAR, "wanted", "wanted"},
                                           {HCI_SVG_BAR, "after", "after"}};
    const hci_range peaks = {0.0, 1.04 * largest_ripple_Nm(s)};
    const hci_svg_axis y =
        hci_svg_axis_over(peaks.high > 0.0 ? peaks : (hci_range){0.0, 1.0}, box->bottom, box->top, 6.0);
    const hci_svg_box b = hci_svg_box_beside(*box, &y);
    const ripple r = {s, largest_ripple_Nm(s)};
    const groups g = groups_in(&b, &r);
    size_t eligible = 0;
    for (size_t k = 0; k < s->order_count; ++k)
        eligible += group_weight(&r, k) > 0.0;
    hci_svg_head(out, &b, "Ripple in N·m (peak)", LEGEND, 3);
    hci_svg_grid(out, &y, &b, true);
    draw_groups(out, s, &g, &y);
    if (y.from - hci_svg_at(&y, s->tolerance_Nm) > 1.5 && g.count > 0)
        hci_svg_segment(out, "limit", b.left, hci_svg_at(&y, s->tolerance_Nm), b.right,
                        hci_svg_at(&y, s->tolerance_Nm));
    if (g.count == 0)
        hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), 0.5 * (b.top + b.bottom),
                      "no torque ripple");
    draw_spectrum_foot(out, s, &b, g.count, eligible);
}
