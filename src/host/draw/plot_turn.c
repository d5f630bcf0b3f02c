#include "host/draw/plot_turn.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "hci/math/harmonic.h"

static const hci_svg_box BOX = {64, 40, 462, 240};

void hci_turn_means_begin(hci_turn_means *t)
{
    memset(t, 0, sizeof *t);
    for (size_t k = 0; k < HCI_TURN_STEPS; ++k)
        t->torque_range_Nm[k] = HCI_RANGE_EMPTY;
}

void hci_turn_means_add(hci_turn_means *t, double theta_e_rad, double torque_Nm, hci_dq current_A)
{
    const double turns = theta_e_rad / (2.0 * HCI_PI), share = turns - floor(turns);
    if (!isfinite(share)) return;
    const size_t k = (size_t)fmin(HCI_TURN_STEPS * share, HCI_TURN_STEPS - 1.0);
    ++t->samples[k];
    t->torque_Nm[k] += torque_Nm;
    t->current_A[k].d += current_A.d;
    t->current_A[k].q += current_A.q;
    hci_range_include(&t->torque_range_Nm[k], torque_Nm);
}

hci_turn_mean hci_turn_mean_of(const hci_turn_means *t, size_t step, size_t many)
{
    hci_turn_mean m = {.torque_range_Nm = HCI_RANGE_EMPTY};
    for (size_t k = step; k < step + many && k < HCI_TURN_STEPS; ++k) {
        m.samples += t->samples[k];
        m.torque_Nm += t->torque_Nm[k];
        m.current_A.d += t->current_A[k].d;
        m.current_A.q += t->current_A[k].q;
        hci_range_include(&m.torque_range_Nm, t->torque_range_Nm[k].low);
        hci_range_include(&m.torque_range_Nm, t->torque_range_Nm[k].high);
    }
    if (m.samples == 0) return m;
    m.torque_Nm /= (double)m.samples;
    m.current_A.d /= (double)m.samples;
    m.current_A.q /= (double)m.samples;
    return m;
}

/* ---- torque ---- */

static double angle_deg(size_t step)
{
    return 360.0 * ((double)step + 0.5) / HCI_TURN_STEPS;
}

/* A stroke from the least to the most of each step; those that touch make a band. */
static void draw_band(hci_output *out, const hci_turn_means *t, const hci_svg_axis *x, const hci_svg_axis *y)
{
    hci_svg_line_begin(out, "haze");
    for (size_t k = 0; k < HCI_TURN_STEPS; ++k) {
        const hci_range r = t->torque_range_Nm[k];
        const double at = hci_svg_at(x, angle_deg(k));
        if (t->samples[k] == 0) continue;
        hci_svg_line_point(out, at, hci_svg_at(y, k % 2 ? r.high : r.low));
        hci_svg_line_point(out, at, hci_svg_at(y, k % 2 ? r.low : r.high));
    }
    hci_svg_line_end(out);
}

static void draw_edge(hci_output *out, const hci_turn_means *t, bool upper, const hci_svg_axis *x,
                      const hci_svg_axis *y)
{
    hci_svg_line_begin(out, "edge");
    for (size_t k = 0; k < HCI_TURN_STEPS; ++k)
        if (t->samples[k] > 0)
            hci_svg_line_point(out, hci_svg_at(x, angle_deg(k)),
                               hci_svg_at(y, upper ? t->torque_range_Nm[k].high : t->torque_range_Nm[k].low));
    hci_svg_line_end(out);
}

static void draw_mean(hci_output *out, const hci_turn_means *t, const char *style, const hci_svg_axis *x,
                      const hci_svg_axis *y)
{
    hci_svg_line_begin(out, style);
    for (size_t k = 0; k < HCI_TURN_STEPS; ++k)
        if (t->samples[k] > 0)
            hci_svg_line_point(out, hci_svg_at(x, angle_deg(k)),
                               hci_svg_at(y, t->torque_Nm[k] / (double)t->samples[k]));
    hci_svg_line_end(out);
}

static hci_range range_of_both(const hci_turn_means *t, const hci_turn_means *before)
{
    hci_range r = hci_turn_mean_of(t, 0, HCI_TURN_STEPS).torque_range_Nm;
    const hci_range plain =
        before ? hci_turn_mean_of(before, 0, HCI_TURN_STEPS).torque_range_Nm : HCI_RANGE_EMPTY;
    hci_range_include(&r, plain.low);
    hci_range_include(&r, plain.high);
    return r;
}

void hci_plot_turn_torque(hci_output *out, const hci_turn_means *t, const hci_turn_means *before)
{
    static const hci_svg_entry ALONE[] = {{HCI_SVG_LINE, "edge", "least and most"},
                                          {HCI_SVG_LINE, "after", "mean"}};
    static const hci_svg_entry COMPARED[] = {{HCI_SVG_LINE, "before", "before"},
                                             {HCI_SVG_LINE, "after", "after"}};
    const hci_svg_axis y = hci_svg_axis_over(range_of_both(t, before), BOX.bottom, BOX.top, 6.0);
    const hci_svg_box b = hci_svg_box_beside(BOX, &y);
    const hci_svg_axis x = hci_svg_axis_of_angle(1.0, &b);
    hci_svg_begin(out,
                  &(hci_svg_picture){
                      "turn", "Torque over one electrical turn",
                      "The mean over all turns in N·m at each electrical angle in degrees, and the band from "
                      "the least to the most; with a plain sine and simulated. The table beside it has the "
                      "numbers.",
                      0, 0, 480, 284});
    hci_svg_head(out, &b, "Torque in N·m", before ? COMPARED : ALONE, 2);
    hci_svg_grid(out, &x, &b, false);
    hci_svg_grid(out, &y, &b, true);
    if (before) draw_band(out, before, &x, &y);
    draw_band(out, t, &x, &y);
    if (before) draw_mean(out, before, "before", &x, &y);
    draw_edge(out, t, false, &x, &y);
    draw_edge(out, t, true, &x, &y);
    draw_mean(out, t, "after", &x, &y);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0,
                  "electrical angle in degrees");
    hci_svg_end(out);
}

/* ---- current vector ---- */

static void draw_path(hci_output *out, const hci_turn_means *t, const hci_svg_axis *d, const hci_svg_axis *q)
{
    hci_svg_line_begin(out, "path");
    for (size_t k = 0; k <= HCI_TURN_STEPS; ++k) {
        const hci_turn_mean m = hci_turn_mean_of(t, k % HCI_TURN_STEPS, 1);
        if (m.samples > 0)
            hci_svg_line_point(out, hci_svg_at(d, m.current_A.d), hci_svg_at(q, m.current_A.q));
    }
    hci_svg_line_end(out);
}

void hci_plot_turn_vector(hci_output *out, const hci_turn_means *t, hci_dq plain_A)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_DOT, "plain", "plain sine"},
                                           {HCI_SVG_LINE, "path", "mean"}};
    hci_range d_A = {plain_A.d, plain_A.d}, q_A = {plain_A.q, plain_A.q};
    hci_svg_axis d, q;
    for (size_t k = 0; k < HCI_TURN_STEPS; ++k) {
        const hci_turn_mean m = hci_turn_mean_of(t, k, 1);
        if (m.samples == 0) continue;
        hci_range_include(&d_A, m.current_A.d);
        hci_range_include(&q_A, m.current_A.q);
    }
    hci_svg_equal_axes(d_A, q_A, &BOX, &d, &q);
    const hci_svg_box b = hci_svg_box_beside(BOX, &q);
    hci_svg_equal_axes(d_A, q_A, &b, &d, &q);
    hci_svg_begin(
        out, &(hci_svg_picture){
                 "vector", "Current vector in the plane of i_d and i_q",
                 "i_q in A over i_d in A: the path of the mean over all turns, and the point of the plain "
                 "sine with the same mean torque. The table beside it has the numbers.",
                 0, 0, 480, 284});
    hci_svg_head(out, &b, "Current vector, i_q in A", LEGEND, 2);
    hci_svg_grid(out, &d, &b, false);
    hci_svg_grid(out, &q, &b, true);
    draw_path(out, t, &d, &q);
    hci_svg_circle(out, "plain", hci_svg_at(&d, plain_A.d), hci_svg_at(&q, plain_A.q), 4.2);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0, "i_d in A");
    hci_svg_end(out);
}
