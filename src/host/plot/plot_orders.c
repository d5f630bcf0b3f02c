/* Amplitudes over the order, as stems. */
#include <math.h>

#include "host/plot/plot.h"

typedef struct {
    hci_svg_box box;
    hci_svg_axis x, y;
    bool logarithmic;
} order_axes;

static double height_of(const order_axes *a, double amplitude_Nm)
{
    return a->logarithmic ? hci_svg_log_at(&a->y, amplitude_Nm) : hci_svg_at(&a->y, amplitude_Nm);
}

static order_axes axes_of(const hci_plot_orders_data *d, const hci_svg_box *area)
{
    const hci_plot_order *order = d->order;
    const size_t count = d->count;
    const bool logarithmic = d->logarithmic;
    hci_range n = {0.0, 1.0}, amplitude_Nm = HCI_RANGE_EMPTY;
    for (size_t k = 0; k < count; ++k) {
        const double value[] = {order[k].before_Nm, order[k].after_Nm, order[k].noise_Nm};
        hci_range_include(&n, order[k].order);
        for (size_t j = 0; j < 3; ++j)
            if (value[j] > 0.0) hci_range_include(&amplitude_Nm, value[j]);
    }
    if (!logarithmic) amplitude_Nm.low = 0.0;
    const hci_svg_axis y = logarithmic ? hci_svg_log_axis(amplitude_Nm, area->bottom, area->top, 4.0)
                                       : hci_svg_axis_over(amplitude_Nm, area->bottom, area->top, 6.0);
    const hci_svg_box b = logarithmic ? hci_svg_log_box_beside(*area, &y) : hci_svg_box_beside(*area, &y);
    return (order_axes){b, hci_svg_axis_over(n, b.left, b.right, 10.0), y, logarithmic};
}

/* Styles of a stem and of the dot on it. */
typedef struct {
    const char *line, *dot;
    double radius;
} stem_style;

/* What lies below the axis is left out. */
static void draw_stem(hci_output *out, const order_axes *a, const stem_style *style, double order,
                      double amplitude_Nm)
{
    const double x = hci_svg_at(&a->x, order), y = height_of(a, amplitude_Nm);
    if (!(amplitude_Nm > 0.0) || y >= a->y.from) return;
    hci_svg_segment(out, style->line, x, a->y.from, x, y);
    hci_svg_circle(out, style->dot, x, y, style->radius);
}

static void tell_order(hci_output *out, const hci_plot_order *o)
{
    char order[HCI_SVG_NUMBER_SIZE];
    hci_svg_short_text(order, o->order);
    hci_svg_tell(out, "order ");
    hci_svg_tell_more(out, order);
    hci_svg_tell_value(out, ": before ", o->before_Nm, "N·m");
    hci_svg_tell_value(out, isfinite(o->before_Nm) ? ", after " : ": ", o->after_Nm, "N·m");
    hci_svg_tell_value(out, ", noise ", o->noise_Nm, "N·m");
    hci_svg_hint(out);
}

static void draw_order(hci_output *out, const order_axes *a, const hci_plot_order *o)
{
    static const stem_style BEFORE = {"before", "before", 3.6}, AFTER = {"after", "dot", 2.4};
    const double x = hci_svg_at(&a->x, o->order), y = height_of(a, o->noise_Nm);
    tell_order(out, o);
    draw_stem(out, a, &BEFORE, o->order, o->before_Nm);
    draw_stem(out, a, &AFTER, o->order, o->after_Nm);
    if (o->noise_Nm > 0.0 && y < a->y.from) hci_svg_segment(out, "noise", x - 3.0, y, x + 3.0, y);
    hci_svg_hint_end(out);
}

void hci_plot_orders(hci_output *out, const hci_svg_box *area, const void *orders)
{
    const hci_plot_orders_data *d = orders;
    const bool compared = d->count > 0 && isfinite(d->order[0].before_Nm);
    const bool has_noise = d->count > 0 && isfinite(d->order[0].noise_Nm);
    const hci_svg_entry entry[] = {{HCI_SVG_DOT, "before", "before"},
                                   {HCI_SVG_DOT, "dot", compared ? "after" : "torque"},
                                   {HCI_SVG_LINE, "noise", d->noise}};
    const order_axes a = axes_of(d, area);
    hci_svg_head(out, &a.box, d->title, compared ? entry : entry + 1,
                 compared || has_noise ? (size_t)compared + 1 + (size_t)has_noise : 0);
    if (d->logarithmic)
        hci_svg_log_grid(out, &a.y, &a.box, true);
    else
        hci_svg_grid(out, &a.y, &a.box, true);
    hci_svg_grid(out, &a.x, &a.box, false);
    for (size_t k = 0; k < d->count; ++k)
        draw_order(out, &a, &d->order[k]);
    hci_svg_label(out, "quiet middle", 0.5 * (a.box.left + a.box.right), a.box.bottom + 35.0,
                  "electrical order");
}
