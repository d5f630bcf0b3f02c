/* A log as it was read, over the time; and over the angle what was tuned: torque with and without current,
 * and the currents. */
#include <math.h>
#include <stdio.h>

#include "hci/host/base/unit.h"
#include "hci/math/harmonic.h"
#include "host/plot/plot.h"
#include "host/plot/solution_curves.h"
#include "host/recording/rotor_frame.h"

enum { COLUMNS = 480, STRIPS = 60 };

/* ---- a log ---- */

/* Least and most in each part of the time. */
typedef struct {
    hci_range part[COLUMNS], all;
    double end; /* of the axis, s or samples */
} raster;

static double time_of(const hci_run *run, size_t k)
{
    return run->time_s ? run->time_s[k] - run->time_s[0] : (double)k;
}

/* The mechanical angle in turns, or the speed in rpm. */
static double position_of(const hci_run *run, size_t k)
{
    return run->theta_m_rad ? run->theta_m_rad[k] / (2.0 * HCI_PI) : hci_rpm(run->speed_rad_per_s[k]);
}

/* The torque as it was measured, or i_q, or the voltage of phase a. */
static double signal_of(const hci_run *run, size_t k)
{
    if (run->torque_source == HCI_TORQUE_MEASURED) return run->torque_Nm[k];
    if (run->v_V && run->torque_source == HCI_TORQUE_NONE) return run->v_V[3 * k];
    return run->theta_m_rad ? hci_run_dq(run, run->pole_pairs, k).q : run->i_A[3 * k];
}

/* A quantity above a picture and within a sentence. */
typedef struct {
    const char *title, *words;
} quantity_name;

static quantity_name name_of_signal(const hci_run *run)
{
    static const quantity_name TORQUE = {"Torque in N·m", "torque in N·m"},
                               VOLTAGE = {"Voltage of phase a in V", "voltage of phase a in V"},
                               Q = {"i_q in A", "i_q in A"}, A = {"i_a in A", "i_a in A"};
    if (run->torque_source == HCI_TORQUE_MEASURED) return TORQUE;
    if (run->v_V && run->torque_source == HCI_TORQUE_NONE) return VOLTAGE;
    return run->theta_m_rad ? Q : A;
}

static void fill(raster *r, const hci_run *run, double (*value)(const hci_run *, size_t))
{
    r->end = time_of(run, run->count - 1);
    r->all = HCI_RANGE_EMPTY;
    for (size_t j = 0; j < COLUMNS; ++j)
        r->part[j] = HCI_RANGE_EMPTY;
    for (size_t k = 0; k < run->count; ++k) {
        const double share = r->end > 0.0 ? time_of(run, k) / r->end : 0.0, x = value(run, k);
        const size_t j = (size_t)fmin(COLUMNS - 1.0, fmax(0.0, share * COLUMNS));
        hci_range_include(&r->part[j], x);
        hci_range_include(&r->all, x);
    }
}

static void draw_raster(hci_output *out, const raster *r, const hci_svg_axis *x, const hci_svg_axis *y)
{
    hci_svg_line_begin(out, "after");
    for (size_t j = 0; j < COLUMNS; ++j) {
        const hci_range p = r->part[j];
        const double at = x->from + (x->to - x->from) * ((double)j + 0.5) / COLUMNS;
        if (p.low > p.high) continue;
        hci_svg_line_point(out, at, hci_svg_at(y, j % 2 == 0 ? p.low : p.high));
        if (p.high > p.low) hci_svg_line_point(out, at, hci_svg_at(y, j % 2 == 0 ? p.high : p.low));
    }
    hci_svg_line_end(out);
}

static void tell_raster(hci_output *out, const raster *r, const hci_run *run, const hci_svg_box *b)
{
    const double width = (b->right - b->left) / STRIPS;
    for (size_t k = 0; k < STRIPS; ++k) {
        const hci_svg_box strip = {b->left + width * (double)k, b->top, b->left + width * (double)(k + 1),
                                   b->bottom};
        hci_range all = HCI_RANGE_EMPTY;
        for (size_t j = k * COLUMNS / STRIPS; j < (k + 1) * COLUMNS / STRIPS; ++j)
            if (r->part[j].low <= r->part[j].high) {
                hci_range_include(&all, r->part[j].low);
                hci_range_include(&all, r->part[j].high);
            }
        if (all.low > all.high) continue;
        hci_svg_tell(out, "");
        hci_svg_tell_value(out, run->time_s ? "" : "sample ", r->end * ((double)k + 0.5) / STRIPS,
                           run->time_s ? "s" : "");
        hci_svg_tell_value(out, ": ", all.low, "");
        hci_svg_tell_value(out, " to ", all.high, "");
        hci_svg_strip(out, &strip);
    }
}

static void draw_panel(hci_output *out, const hci_svg_box *area, const hci_run *run, const char *title,
                       double (*value)(const hci_run *, size_t))
{
    raster r;
    fill(&r, run, value);
    const hci_svg_axis y = hci_svg_axis_over(r.all, area->bottom, area->top, 4.0);
    const hci_svg_box b = hci_svg_box_beside(*area, &y);
    hci_svg_axis x = {0.0, r.end > 0.0 ? r.end : 1.0, b.left, b.right, 1.0};
    x.step = hci_svg_nice_step(x.high / 7.0);
    hci_svg_head(out, &b, title, NULL, 0);
    hci_svg_grid(out, &x, &b, false);
    hci_svg_grid(out, &y, &b, true);
    draw_raster(out, &r, &x, &y);
    tell_raster(out, &r, run, &b);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0,
                  run->time_s ? "time in s" : "sample");
}

void hci_plot_log_ranges(const hci_run *run, hci_plot_log_facts *facts)
{
    facts->position = run->theta_m_rad ? "mechanical angle in turns" : "speed in rpm";
    facts->signal = name_of_signal(run).words;
    facts->of_position = facts->of_signal = HCI_RANGE_EMPTY;
    for (size_t k = 0; k < run->count; ++k) {
        hci_range_include(&facts->of_position, position_of(run, k));
        hci_range_include(&facts->of_signal, signal_of(run, k));
    }
}

void hci_plot_log(hci_output *out, const hci_svg_box *area, const void *log)
{
    const hci_run *run = log;
    hci_svg_box upper = *area, lower = *area;
    upper.bottom = 0.5 * (area->top + area->bottom) - 38.0;
    lower.top = upper.bottom + 76.0;
    draw_panel(out, &upper, run, run->theta_m_rad ? "Mechanical angle in turns" : "Speed in rpm",
               position_of);
    draw_panel(out, &lower, run, name_of_signal(run).title, signal_of);
}

bool hci_plot_log_can(const hci_run *run)
{
    return run->count > 1 && run->i_A && (run->theta_m_rad || run->speed_rad_per_s);
}

/* ---- what was tuned, over one angle ---- */

static hci_range range_of_open(const hci_plot_tuned *t)
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t k = 0; k < t->count; ++k)
        hci_range_include(&r, t->open_Nm[k]);
    return r;
}

static void fill_curves(hci_solution_curves *c, const hci_plot_tuned *t)
{
    hci_solution_curves_fill(c, t->solution);
    c->beside = range_of_open(t);
}

void hci_plot_tuned_torque(hci_output *out, const hci_svg_box *area, const void *tuned)
{
    hci_solution_curves c;
    fill_curves(&c, tuned);
    hci_panel_torque(out, &c, area);
}

void hci_plot_tuned_dq(hci_output *out, const hci_svg_box *area, const void *tuned)
{
    hci_solution_curves c;
    fill_curves(&c, tuned);
    hci_panel_dq(out, &c, area);
}

/* The angle of a point of the torque without current. */
static double angle_of(const hci_plot_tuned *t, size_t k)
{
    return 360.0 * (double)t->solution->period_turns * (double)k / (double)(t->count - 1);
}

static void tell_open(hci_output *out, const hci_plot_tuned *t, const hci_svg_axis *x, const hci_svg_box *b)
{
    const double width = (b->right - b->left) / STRIPS;
    for (size_t k = 0; k < STRIPS; ++k) {
        const double share = (2.0 * (double)k + 1.0) / (2 * STRIPS), end = angle_of(t, t->count - 1);
        const size_t at = (size_t)(share * x->high / end * (double)(t->count - 1));
        hci_svg_tell(out, "");
        hci_svg_tell_value(out, "", angle_of(t, at), "°");
        hci_svg_tell_value(out, ": without current ", t->open_Nm[at], "N·m");
        hci_svg_strip(out, &(hci_svg_box){b->left + width * (double)k, b->top,
                                          b->left + width * (double)(k + 1), b->bottom});
    }
}

void hci_plot_tuned_open(hci_output *out, const hci_svg_box *area, const void *tuned)
{
    static const hci_svg_entry ENTRY[] = {{HCI_SVG_LINE, "plain", "without current"}};
    const hci_plot_tuned *t = tuned;
    hci_solution_curves c;
    fill_curves(&c, t);
    const hci_svg_axis y = hci_svg_axis_over(c.beside, area->bottom, area->top, HCI_CURVE_TICKS);
    const hci_svg_box b = hci_curve_box(&c, area);
    const hci_svg_axis x = hci_svg_axis_of_angle(c.turns, &b);
    hci_svg_head(out, &b, "Torque in N·m", ENTRY, 1);
    hci_panel_angle(out, &c, &x, &b);
    hci_svg_grid(out, &y, &b, true);
    hci_svg_line_begin(out, "plain");
    for (size_t k = 0; k < t->count && angle_of(t, k) <= x.high; ++k)
        hci_svg_line_point(out, hci_svg_at(&x, angle_of(t, k)), hci_svg_at(&y, t->open_Nm[k]));
    hci_svg_line_end(out);
    tell_open(out, t, &x, &b);
}
