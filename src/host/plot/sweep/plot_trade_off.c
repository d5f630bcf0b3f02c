/* Ripple against the limit of the peak current and against that of copper; below, what the one costs of the
 * other. */
#include <math.h>
#include <stdio.h>

#include "hci/host/base/unit.h"
#include "host/plot/sweep/plot_sweep.h"

enum { WIDTH = 1000, HEIGHT = 772 };

static const hci_svg_box BOX[2][2] = {{{70, 106, 490, 380}, {570, 106, 980, 380}},
                                      {{70, 488, 490, 700}, {570, 488, 980, 700}}};

typedef double value_of(const hci_grid_figures *f);

static double ripple(const hci_grid_figures *f)
{
    return f->T_ripple_percent;
}

static double copper(const hci_grid_figures *f)
{
    return f->loss_to_plain;
}

static double peak(const hci_grid_figures *f)
{
    return f->peak_A;
}

/* One panel: a value over a limit. */
typedef struct {
    const hci_grid *sweep;
    bool of_copper;
    value_of *value;
    const hci_svg_box *box;
    const char *title;
} panel;

static double limit_of(const panel *p, size_t k)
{
    const hci_grid_point *point = &p->sweep->plan.point[k];
    return p->of_copper ? point->limit_copper : point->limit_current_A;
}

static size_t first(const panel *p)
{
    return p->of_copper ? p->sweep->plan.by_current : 0;
}

static size_t end(const panel *p)
{
    return p->of_copper ? p->sweep->plan.count : p->sweep->plan.by_current;
}

static bool is_shown(const panel *p, size_t k)
{
    return p->sweep->row[k].verdict <= HCI_GRID_RIPPLE;
}

static const hci_grid_figures *sine_of(const hci_grid *s)
{
    for (size_t k = 0; k < s->plan.count; ++k)
        if (isfinite(s->row[k].sine.peak_A)) return &s->row[k].sine;
    return NULL;
}

/* The plain sine has its own peak as limit, and 1 of copper. */
static void draw_sine(hci_output *out, const panel *p, const hci_svg_axis *x, const hci_svg_axis *y)
{
    const hci_grid_figures *sine = sine_of(p->sweep);
    if (sine)
        hci_svg_circle(out, "before", hci_svg_at(x, p->of_copper ? 1.0 : sine->peak_A),
                       hci_svg_at(y, p->value(sine)), 4.5);
}

static void ranges(const panel *p, hci_range *x, hci_range *y)
{
    const hci_grid_figures *sine = sine_of(p->sweep);
    *x = *y = HCI_RANGE_EMPTY;
    for (size_t k = first(p); k < end(p); ++k)
        if (is_shown(p, k)) {
            hci_range_include(x, limit_of(p, k));
            if (k > first(p)) hci_range_include(x, limit_of(p, k - 1));
            hci_range_include(y, p->value(&p->sweep->row[k].best));
        }
    if (!sine) return;
    hci_range_include(x, p->of_copper ? 1.0 : sine->peak_A);
    hci_range_include(y, p->value(sine));
}

static void draw_curve(hci_output *out, const panel *p, const hci_svg_axis *x, const hci_svg_axis *y)
{
    hci_svg_line_begin(out, "a");
    for (size_t k = first(p); k < end(p); ++k)
        if (is_shown(p, k))
            hci_svg_line_point(out, hci_svg_at(x, limit_of(p, k)),
                               hci_svg_at(y, p->value(&p->sweep->row[k].best)));
    hci_svg_line_end(out);
    for (size_t k = first(p); k < end(p); ++k)
        if (is_shown(p, k))
            hci_svg_circle(out, "dot", hci_svg_at(x, limit_of(p, k)),
                           hci_svg_at(y, p->value(&p->sweep->row[k].best)), 2.4);
}

/* Wider than the dots, to be hit. */
static void draw_hints(hci_output *out, const panel *p, const hci_svg_axis *x)
{
    for (size_t k = first(p); k < end(p); ++k) {
        const hci_grid_figures *f = &p->sweep->row[k].best;
        const double at = hci_svg_at(x, limit_of(p, k));
        const hci_svg_box strip = {at - 4.0, p->box->top, at + 4.0, p->box->bottom};
        if (!is_shown(p, k)) continue;
        hci_svg_tell(out, "limit ");
        hci_svg_tell_value(out, "", limit_of(p, k), p->of_copper ? "×" : "A");
        hci_svg_tell_value(out, ": ripple ", f->T_ripple_percent, "%");
        hci_svg_tell_value(out, ", copper ", f->loss_to_plain, "×");
        hci_svg_tell_value(out, ", peak ", f->peak_A, "A");
        hci_svg_strip(out, &strip);
    }
}

static const char UNREACHED[] = "not reached";

/* Where the limit does not let the torque be reached. */
static void draw_unreached(hci_output *out, const panel *p, const hci_svg_axis *x)
{
    double least = HUGE_VAL;
    for (size_t k = first(p); k < end(p); ++k)
        if (is_shown(p, k)) least = fmin(least, limit_of(p, k));
    if (!(least > x->low && least < HUGE_VAL)) return;
    hci_svg_rectangle(out, "band", p->box->left, p->box->top, hci_svg_at(x, least), p->box->bottom);
    if (hci_svg_at(x, least) - p->box->left > hci_svg_text_width("small quiet", UNREACHED) + 18.0)
        hci_svg_label(out, "small quiet", p->box->left + 6.0, p->box->top + 16.0, UNREACHED);
}

/* Over the limits alone, without zero. */
static hci_svg_axis limit_axis(hci_range r, const hci_svg_box *b)
{
    const double margin = r.low < r.high ? 0.03 * (r.high - r.low) : 0.1 * fabs(r.low) + 1e-9;
    hci_svg_axis a = {r.low - margin, r.high + margin, b->left, b->right, 0.0};
    if (!(r.low <= r.high)) a = (hci_svg_axis){0.0, 1.0, b->left, b->right, 0.0};
    a.step = hci_svg_nice_step((a.high - a.low) / 8.0);
    return a;
}

static void draw_panel(hci_output *out, panel whole)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_LINE, "a", "within the limit"},
                                           {HCI_SVG_DOT, "before", "plain sine"}};
    panel *const p = &whole;
    hci_range over, values;
    ranges(p, &over, &values);
    const hci_svg_axis y = hci_svg_axis_over(values, p->box->bottom, p->box->top, 6.0);
    const hci_svg_box b = hci_svg_box_beside(*p->box, &y);
    p->box = &b;
    const hci_svg_axis x = limit_axis(over, &b);
    draw_unreached(out, p, &x);
    hci_svg_head(out, p->box, p->title, LEGEND, 2);
    hci_svg_grid(out, &x, p->box, false);
    hci_svg_grid(out, &y, p->box, true);
    draw_curve(out, p, &x, &y);
    draw_sine(out, p, &x, &y);
    draw_hints(out, p, &x);
    hci_svg_label(out, "quiet middle", 0.5 * (p->box->left + p->box->right), p->box->bottom + 35.0,
                  p->of_copper ? "limit of the copper loss, × the plain sine"
                               : "limit of the phase current, peak in A");
}

void hci_plot_ripple_by_current(hci_output *out, const hci_svg_box *box, const void *sweep)
{
    draw_panel(out, (panel){sweep, false, ripple, box, "Torque ripple in %"});
}

void hci_plot_ripple_by_copper(hci_output *out, const hci_svg_box *box, const void *sweep)
{
    draw_panel(out, (panel){sweep, true, ripple, box, "Torque ripple in %"});
}

void hci_plot_copper_by_current(hci_output *out, const hci_svg_box *box, const void *sweep)
{
    draw_panel(out, (panel){sweep, false, copper, box, "Copper loss, × the plain sine"});
}

void hci_plot_peak_by_copper(hci_output *out, const hci_svg_box *box, const void *sweep)
{
    draw_panel(out, (panel){sweep, true, peak, box, "Peak phase current in A"});
}

void hci_plot_trade_off(hci_output *out, const hci_grid *s)
{
    char title[128];
    snprintf(title, sizeof title, "%.5g N·m at %.5g rpm: ripple against peak current and copper",
             s->plan.point[0].torque_Nm, hci_rpm(s->plan.point[0].speed_rad_per_s));
    const hci_svg_picture picture = {
        "sweep",
        title,
        "Four panels: torque ripple over the limit of the phase current and over the limit of the copper "
        "loss; "
        "copper loss over the first, peak current over the second. trade_off.csv has the numbers.",
        0,
        0,
        WIDTH,
        HEIGHT};
    hci_plot_sweep_begin(out, &picture, s);
    hci_plot_ripple_by_current(out, &BOX[0][0], s);
    hci_plot_ripple_by_copper(out, &BOX[0][1], s);
    hci_plot_copper_by_current(out, &BOX[1][0], s);
    hci_plot_peak_by_copper(out, &BOX[1][1], s);
    hci_svg_end(out);
}
