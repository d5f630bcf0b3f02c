#include <math.h>
#include <stdio.h>

#include "host/plot/fleet/plot_fleet.h"

/* Of many sound motors only some are drawn. */
enum { MOST_SOUND = 3000, MOST_ODD = 1000, MOST_NAMES = 12, EDGE = 100 };

/* Where a motor stands: its day, or its place where a date is missing. */
typedef struct {
    bool by_day;
    hci_range range;
} order;

static order order_of(const hci_line *l)
{
    order o = {true, HCI_RANGE_EMPTY};
    for (size_t k = 0; k < l->motors; ++k)
        o.by_day = o.by_day && !isnan(l->motor[k].day);
    for (size_t k = 0; k < l->motors; ++k)
        hci_range_include(&o.range, o.by_day ? l->motor[k].day - l->motor[0].day : (double)k + 1.0);
    return o;
}

static double place_of(const hci_line *l, const order *o, size_t k)
{
    return o->by_day ? l->motor[k].day - l->motor[0].day : (double)k + 1.0;
}

static void draw_sound(hci_output *out, const hci_line *l, const order *o, const hci_svg_axis *x,
                       const hci_svg_axis *y)
{
    const size_t every = l->motors / MOST_SOUND + 1;
    for (size_t k = 0; k < l->motors; k += every)
        if (!l->motor[k].stands_out && l->motor[k].worst != HCI_LINE_NONE)
            hci_svg_circle(out, "before", hci_svg_at(x, place_of(l, o, k)),
                           hci_svg_log_at(y, fabs(l->motor[k].deviation)), 1.5);
}

static void draw_odd(hci_output *out, const hci_line *l, const order *o, const hci_svg_axis *x,
                     const hci_svg_axis *y)
{
    size_t drawn = 0;
    for (size_t k = 0; k < l->motors && drawn < MOST_ODD; ++k) {
        const hci_line_motor *m = &l->motor[k];
        char name[96], text[256];
        if (!m->stands_out) continue;
        hci_plot_parameter_name(l, m->worst, name);
        snprintf(text, sizeof text, "%s: %s, %.1f standard deviations", m->name, name, m->deviation);
        hci_svg_tell(out, text);
        hci_svg_hint(out);
        hci_svg_circle(out, "ring", hci_svg_at(x, place_of(l, o, k)), hci_svg_log_at(y, fabs(m->deviation)),
                       3.0);
        hci_svg_hint_end(out);
        if (hci_line_outside(l) <= MOST_NAMES)
            hci_svg_name(out, "small", hci_svg_at(x, place_of(l, o, k)) + 5.0,
                         hci_svg_log_at(y, fabs(m->deviation)) - 4.0, m->name, 90.0);
        ++drawn;
    }
}

void hci_plot_motors(hci_output *out, const hci_svg_box *area, const void *context)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_DOT, "before", "motor"},
                                           {HCI_SVG_DOT, "ring", "stands out"},
                                           {HCI_SVG_LINE, "limit", "limit"}};
    const hci_line *l = context;
    const order o = order_of(l);
    hci_range r = {0.5, 2.0 * l->limit};
    for (size_t k = 0; k < l->motors; ++k)
        if (l->motor[k].worst != HCI_LINE_NONE)
            hci_range_include(&r, fmin(fabs(l->motor[k].deviation), EDGE));
    const hci_svg_axis y = hci_svg_log_axis(r, area->bottom, area->top, 3.0);
    const hci_svg_box b = hci_svg_log_box_beside(*area, &y);
    const hci_svg_axis x = hci_svg_axis_over(o.range, b.left, b.right, 10.0);
    hci_svg_head(out, &b, "Largest deviation of each motor", LEGEND, 3);
    hci_svg_grid(out, &x, &b, false);
    hci_svg_log_grid(out, &y, &b, true);
    draw_sound(out, l, &o, &x, &y);
    draw_odd(out, l, &o, &x, &y);
    hci_svg_segment(out, "limit", b.left, hci_svg_log_at(&y, l->limit), b.right,
                    hci_svg_log_at(&y, l->limit));
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0,
                  o.by_day ? "days since the date of the first motor" : "motors by their names");
}
