/* The largest torque over the speed: with little ripple, with any, and of the plain sine; below, the ripple
 * of each. */
#include <math.h>
#include <stdio.h>

#include "host/plot/sweep/plot_sweep.h"

enum { WIDTH = 1000, HEIGHT = 760, CURVES = 3 };

static const hci_svg_box TORQUE = {70, 106, 976, 440}, RIPPLE = {70, 510, 976, 700};

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
    return hci_svg_at(&p->x, hci_grid_rpm(row->point.speed_rad_per_s));
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
        hci_range_include(&r, hci_grid_rpm(s->plan.point[k].speed_rad_per_s));
    return hci_svg_axis_over(r, b->left, b->right, 10.0);
}

/* Speeds at which there is no torque with so little ripple. */
static void mark_none(hci_output *out, const panel *p)
{
    for (size_t k = 0; k < p->sweep->plan.count; ++k)
        if (p->sweep->row[k].verdict == HCI_GRID_RIPPLE || p->sweep->row[k].verdict == HCI_GRID_LIMITS)
            hci_svg_cross(out, x_at(p, &p->sweep->row[k]), y_at(p, 0.0));
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

static void draw_torque(hci_output *out, const hci_grid *s)
{
    char allowed[64];
    hci_range r = range_of(s, torque);
    hci_range_include(&r, 0.0);
    const panel p = {s, speed_axis(s, &TORQUE), hci_svg_axis_over(r, TORQUE.bottom, TORQUE.top, 8.0), torque,
                     false};
    snprintf(allowed, sizeof allowed, "at most %.4g %% of ripple", s->request.ripple_percent);
    const hci_svg_entry legend[] = {{HCI_SVG_LINE, "a", allowed},
                                    {HCI_SVG_LINE, "c", "any ripple"},
                                    {HCI_SVG_LINE, "before", "plain sine"},
                                    {HCI_SVG_CROSS, "cross", "no torque with so little"}};
    hci_svg_head(out, &TORQUE, "Largest mean torque in N·m", legend, CURVES + 1);
    hci_svg_grid(out, &p.x, &TORQUE, false);
    hci_svg_grid(out, &p.y, &TORQUE, true);
    for (int curve = CURVES - 1; curve >= 0; --curve)
        draw_curve(out, &p, curve);
    mark_none(out, &p);
    name_links(out, &p);
}

static void draw_ripple(hci_output *out, const hci_grid *s)
{
    const hci_svg_entry legend[] = {{HCI_SVG_LINE, "limit", "allowed"}};
    hci_range r = range_of(s, ripple);
    hci_range_include(&r, s->request.ripple_percent);
    const panel p = {s, speed_axis(s, &RIPPLE), hci_svg_log_axis(r, RIPPLE.bottom, RIPPLE.top, 3.0), ripple,
                     true};
    hci_svg_head(out, &RIPPLE, "Ripple of these torques in % of the mean", legend, 1);
    hci_svg_grid(out, &p.x, &RIPPLE, false);
    hci_svg_log_grid(out, &p.y, &RIPPLE, true);
    hci_svg_segment(out, "limit", RIPPLE.left, y_at(&p, s->request.ripple_percent), RIPPLE.right,
                    y_at(&p, s->request.ripple_percent));
    for (int curve = CURVES - 1; curve >= 0; --curve)
        draw_curve(out, &p, curve);
    hci_svg_label(out, "quiet middle", 0.5 * (RIPPLE.left + RIPPLE.right), HEIGHT - 18.0, "speed in rpm");
}

void hci_plot_envelope(hci_output *out, const hci_grid *s, bool stands_alone)
{
    static const hci_svg_picture PICTURE = {
        "sweep",
        "Largest torque over the speed",
        "Above: the largest mean torque over the speed with little ripple, with any ripple and of the plain "
        "sine, "
        "within the same limits. Below: the ripple of these torques. envelope.csv has the numbers.",
        0,
        0,
        WIDTH,
        HEIGHT};
    hci_plot_sweep_begin(out, &PICTURE, s, stands_alone);
    draw_torque(out, s);
    draw_ripple(out, s);
    hci_svg_end(out);
}
