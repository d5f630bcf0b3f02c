/* The largest torque over the speed: with little ripple, with any, and of the plain sine; below, the ripple
 * of each. */
#include <math.h>
#include <stdio.h>

#include "hci/host/base/number.h"
#include "hci/host/base/unit.h"
#include "host/plot/sweep/plot_sweep.h"

enum { WIDTH = 1000, HEIGHT = 780, CURVES = 3 };

static const hci_svg_box TORQUE = {70, 106, 976, 440}, RIPPLE = {70, 530, 976, 730};

static const char *const STYLE[CURVES] = {"a", "c", "before"};

static const hci_grid_figures *figures(const hci_grid_row *row, int curve)
{
    return curve == 0 ? &row->best : curve == 1 ? &row->most : &row->sine;
}

typedef double value_of(const hci_grid_figures *f);

static double torque(const hci_grid_figures *f)
{
    return f->mean_Nm;
}

static double ripple(const hci_grid_figures *f)
{
    return f->T_ripple_percent;
}

typedef struct {
    const hci_grid *sweep;
    hci_svg_axis x, y;
    value_of *value;
    bool is_logarithmic;
} panel;

static double y_at(const panel *p, double value)
{
    return p->is_logarithmic ? hci_svg_log_at(&p->y, value) : hci_svg_at(&p->y, value);
}

static double x_at(const panel *p, const hci_grid_row *row)
{
    return hci_svg_at(&p->x, hci_rpm(row->point.speed_rad_per_s));
}

/* One line for each dc link; a gap where there is no value. */
static void draw_line(hci_output *out, const panel *p, int curve)
{
    const size_t speeds = p->sweep->request.speed_rad_per_s.count;
    bool is_open = false;
    for (size_t k = 0; k < p->sweep->plan.count; ++k) {
        const hci_grid_row *row = &p->sweep->row[k];
        const double value = p->value(figures(row, curve));
        const bool ends = !isfinite(value) || k % speeds == 0;
        if (is_open && ends) hci_svg_line_end(out);
        is_open = is_open && !ends;
        if (!isfinite(value)) continue;
        if (!is_open) hci_svg_line_begin(out, STYLE[curve]);
        is_open = true;
        hci_svg_line_point(out, x_at(p, row), y_at(p, value));
    }
    if (is_open) hci_svg_line_end(out);
}

static void draw_curve(hci_output *out, const panel *p, int curve)
{
    draw_line(out, p, curve);
    for (size_t k = 0; k < p->sweep->plan.count && curve == 0; ++k) {
        const hci_grid_row *row = &p->sweep->row[k];
        if (isfinite(p->value(&row->best)))
            hci_svg_circle(out, "dot", x_at(p, row), y_at(p, p->value(&row->best)), 2.6);
    }
}

static hci_range range_of(const hci_grid *s, value_of *value)
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t k = 0; k < s->plan.count; ++k)
        for (int curve = 0; curve < CURVES; ++curve)
            hci_range_include(&r, value(figures(&s->row[k], curve)));
    return r;
}

static hci_svg_axis speed_axis(const hci_grid *s, const hci_svg_box *b)
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t k = 0; k < s->plan.count; ++k)
        hci_range_include(&r, hci_rpm(s->plan.point[k].speed_rad_per_s));
    return hci_svg_axis_over(r, b->left, b->right, 10.0);
}

/* Whether there is no torque with so little ripple. */
static bool is_none(const hci_grid_row *row)
{
    return row->verdict == HCI_GRID_RIPPLE || row->verdict == HCI_GRID_LIMITS;
}

static bool has_none(const hci_grid *s)
{
    for (size_t k = 0; k < s->plan.count; ++k)
        if (is_none(&s->row[k])) return true;
    return false;
}

static void mark_none(hci_output *out, const panel *p)
{
    for (size_t k = 0; k < p->sweep->plan.count; ++k)
        if (is_none(&p->sweep->row[k])) hci_svg_cross(out, x_at(p, &p->sweep->row[k]), y_at(p, 0.0));
}

/* The dc link at the first point of each line, where there are several. */
static void name_links(hci_output *out, const panel *p)
{
    const size_t speeds = p->sweep->request.speed_rad_per_s.count;
    for (size_t k = speeds - 1; k < p->sweep->plan.count && p->sweep->request.link_V.count > 1; k += speeds) {
        const hci_grid_row *row = &p->sweep->row[k];
        char text[48];
        snprintf(text, sizeof text, "%.4g V", row->point.link_V);
        if (isfinite(row->most.mean_Nm))
            hci_svg_label(out, "small quiet end", x_at(p, row) - 4.0, y_at(p, row->most.mean_Nm) - 5.0, text);
    }
}

/* Strips about the speeds that tell what all curves are there. */
static void draw_strips(hci_output *out, const panel *p, const hci_svg_box *b, const char *unit)
{
    for (size_t k = 0; k < p->sweep->plan.count; ++k) {
        const hci_grid_row *row = &p->sweep->row[k];
        const double x = x_at(p, row);
        const hci_svg_box strip = {fmax(x - 5.0, b->left), b->top, fmin(x + 5.0, b->right), b->bottom};
        hci_svg_tell(out, "");
        hci_svg_tell_value(out, "", hci_rpm(row->point.speed_rad_per_s), "rpm");
        hci_svg_tell_value(out, ", little ripple: ", p->value(&row->best), unit);
        hci_svg_tell_value(out, ", any ripple: ", p->value(&row->most), unit);
        hci_svg_tell_value(out, ", plain sine: ", p->value(&row->sine), unit);
        hci_svg_strip(out, &strip);
    }
}

void hci_plot_envelope_torque(hci_output *out, const hci_svg_box *area, const void *sweep)
{
    const hci_grid *s = sweep;
    char allowed[64];
    hci_range r = range_of(s, torque);
    hci_range_include(&r, 0.0);
    panel p = {.sweep = s, .y = hci_svg_axis_over(r, area->bottom, area->top, 8.0), .value = torque};
    const hci_svg_box b = hci_svg_box_beside(*area, &p.y);
    p.x = speed_axis(s, &b);
    snprintf(allowed, sizeof allowed, "at most %s %% of ripple", HCI_PERCENT(s->request.ripple_percent, 4));
    const hci_svg_entry legend[] = {{HCI_SVG_LINE, "a", allowed},
                                    {HCI_SVG_LINE, "c", "any ripple"},
                                    {HCI_SVG_LINE, "before", "plain sine"},
                                    {HCI_SVG_CROSS, "cross", "none"}};
    hci_svg_head(out, &b, "Largest torque in N·m", legend, CURVES + has_none(s));
    hci_svg_grid(out, &p.x, &b, false);
    hci_svg_grid(out, &p.y, &b, true);
    for (int curve = CURVES - 1; curve >= 0; --curve)
        draw_curve(out, &p, curve);
    mark_none(out, &p);
    name_links(out, &p);
    draw_strips(out, &p, &b, "N·m");
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0, "speed in rpm");
}

void hci_plot_envelope_ripple(hci_output *out, const hci_svg_box *area, const void *sweep)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_LINE, "a", "little ripple"},
                                           {HCI_SVG_LINE, "c", "any ripple"},
                                           {HCI_SVG_LINE, "before", "plain sine"},
                                           {HCI_SVG_LINE, "limit", "allowed"}};
    const hci_grid *s = sweep;
    hci_range r = range_of(s, ripple);
    hci_range_include(&r, s->request.ripple_percent);
    panel p = {.sweep = s,
               .y = hci_svg_log_axis(r, area->bottom, area->top, 3.0),
               .value = ripple,
               .is_logarithmic = true};
    const hci_svg_box b = hci_svg_log_box_beside(*area, &p.y);
    p.x = speed_axis(s, &b);
    hci_svg_head(out, &b, "Ripple in % of the mean", LEGEND, 4);
    hci_svg_grid(out, &p.x, &b, false);
    hci_svg_log_grid(out, &p.y, &b, true);
    hci_svg_segment(out, "limit", b.left, y_at(&p, s->request.ripple_percent), b.right,
                    y_at(&p, s->request.ripple_percent));
    for (int curve = CURVES - 1; curve >= 0; --curve)
        draw_curve(out, &p, curve);
    draw_strips(out, &p, &b, "%");
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0, "speed in rpm");
}

void hci_plot_envelope(hci_output *out, const hci_grid *s)
{
    static const hci_svg_picture PICTURE = {
        "sweep",
        "Largest torque over the speed",
        "Above: the largest mean torque over the speed, found with the components that may be used, with "
        "little "
        "ripple and with any, and of the plain sine, within the same limits. Below: the ripple of these "
        "torques. envelope.csv has the numbers.",
        0,
        0,
        WIDTH,
        HEIGHT};
    hci_plot_sweep_begin(out, &PICTURE, s);
    hci_plot_envelope_torque(out, &TORQUE, s);
    hci_plot_envelope_ripple(out, &RIPPLE, s);
    hci_svg_end(out);
}
