#include <math.h>
#include <stdio.h>

#include "host/plot/fleet/plot_fleet.h"

/* Deviations are drawn from −EDGE to EDGE; what is beyond lies at the edge. */
enum { EDGE = 12, BINS = 4 * EDGE, MOST_MARKS = 400 };

void hci_plot_parameter_name(const hci_line *line, size_t parameter, char text[96])
{
    const hci_fleet_parameter *p = &line->parameter[parameter].name;
    snprintf(text, 96, "%s %s", p->effect, p->parameter);
}

static size_t bin_of(double deviation)
{
    const double at = (fmin(fmax(deviation, -EDGE), EDGE) + EDGE) * BINS / (2.0 * EDGE);
    return at < BINS ? (size_t)at : BINS - 1;
}

typedef struct {
    const hci_line *line;
    size_t parameter;
    hci_svg_axis x;
    double foot, height; /* of the row */
} row;

static void draw_bars(hci_output *out, const row *r, const size_t count[BINS])
{
    size_t most = 1;
    for (size_t k = 0; k < BINS; ++k)
        most = count[k] > most ? count[k] : most;
    for (size_t k = 0; k < BINS; ++k) {
        const double left = -EDGE + 2.0 * EDGE * (double)k / BINS,
                     high = (r->height - 8.0) * (double)count[k] / (double)most;
        if (count[k] > 0)
            hci_svg_rectangle(out, "after", hci_svg_at(&r->x, left) + 0.5, r->foot - fmax(high, 0.7),
                              hci_svg_at(&r->x, left + 2.0 * EDGE / BINS) - 0.5, r->foot);
    }
}

static void mark_outside(hci_output *out, const row *r)
{
    size_t marks = 0;
    for (size_t k = 0; k < r->line->motors && marks < MOST_MARKS; ++k) {
        const double deviation = hci_line_deviation(r->line, k, r->parameter);
        if (!(fabs(deviation) > r->line->limit)) continue;
        hci_svg_circle(out, r->line->motor[k].worst == r->parameter ? "ring" : "before",
                       hci_svg_at(&r->x, deviation), r->foot - 0.5 * r->height + 3.0, 2.6);
        ++marks;
    }
}

static void draw_row(hci_output *out, const row *r, double label_at)
{
    const hci_line_parameter *p = &r->line->parameter[r->parameter];
    size_t count[BINS] = {0};
    char name[96];
    for (size_t k = 0; k < r->line->motors; ++k) {
        const double deviation = hci_line_deviation(r->line, k, r->parameter);
        if (fabs(deviation) <= r->line->limit) ++count[bin_of(deviation)];
    }
    hci_plot_parameter_name(r->line, r->parameter, name);
    hci_svg_segment(out, "grid", r->x.from, r->foot, r->x.to, r->foot);
    hci_svg_tell(out, name);
    hci_svg_tell_value(out, ": median ", p->median, p->name.unit);
    hci_svg_tell_value(out, ", standard deviation ", p->scale, p->name.unit);
    hci_svg_hint(out);
    draw_bars(out, r, count);
    hci_svg_hint_end(out);
    mark_outside(out, r);
    hci_svg_name(out, "small end", label_at, r->foot - 6.0, name, 148.0);
}

void hci_plot_distributions(hci_output *out, const hci_svg_box *area, const void *context)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_BAR, "after", "motors"},
                                           {HCI_SVG_DOT, "ring", "stands out by this"},
                                           {HCI_SVG_LINE, "limit", "limit"}};
    const hci_line *l = context;
    hci_svg_box b = *area;
    b.left = area->left + 110.0;
    const double height = (b.bottom - b.top) / (double)l->parameters;
    const hci_svg_axis x = {-EDGE, EDGE, b.left, b.right, 4.0};
    hci_svg_head(out, &b, "Deviation from the median", LEGEND, 3);
    hci_svg_grid(out, &x, &b, false);
    for (size_t k = 0; k < l->parameters; ++k) {
        const row r = {l, k, x, b.top + (double)(k + 1) * height, height};
        if (l->parameter[k].motors > 1) draw_row(out, &r, b.left - 6.0);
    }
    for (int side = -1; side <= 1; side += 2)
        hci_svg_segment(out, "limit", hci_svg_at(&x, side * l->limit), b.top, hci_svg_at(&x, side * l->limit),
                        b.bottom);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0,
                  "standard deviations of each parameter (robust); what is beyond 12 lies at the edge");
}
