/* A measured waveform on a canvas of 1000 × 680 pixels: over one turn, and by order. */
#include <math.h>
#include <stdio.h>

#include "hci/math/harmonic.h"
#include "host/plot/plot.h"

enum { WIDTH = 1000, HEIGHT = 680, POINTS = 2880 };

static const hci_svg_box TURN = {72, 120, 976, 340}, ORDERS = {72, 418, 976, 618};

/* Standard errors on each side of an amplitude: 95 %. */
#define INTERVAL 1.96

/* So that the smallest amplitude does not lie on the edge. */
#define ROOM_BELOW 0.7

static bool is_cogging(const hci_waveform *w)
{
    return w->quantity == HCI_WAVEFORM_COGGING;
}

static const char *unit_of(const hci_waveform *w)
{
    return is_cogging(w) ? "N·m" : "V·s/rad";
}

/* Electrical turns that the picture goes round: a mechanical one where orders are told apart on it. */
static double turns_of(const hci_waveform *w)
{
    return w->step > 0.0 ? 1.0 / w->step : 1.0;
}

static const char *angle_of(const hci_waveform *w)
{
    return turns_of(w) > 1.0 ? "mechanical angle in degrees" : "electrical angle in degrees";
}

static double value_at(const hci_waveform *w, bool all, double theta_rad)
{
    double sum = 0.0;
    for (size_t k = 0; k < w->count; ++k) {
        const hci_waveform_order *o = &w->order[k];
        if (all || o->kept) sum += o->amplitude * sin(o->order * theta_rad + o->phase_rad);
    }
    return sum;
}

/* ---- over a turn ---- */

typedef struct {
    double value[POINTS + 1];
    hci_range range;
} curve;

static void fill(curve *c, const hci_waveform *w, bool all)
{
    c->range = HCI_RANGE_EMPTY;
    for (int k = 0; k <= POINTS; ++k) {
        c->value[k] = value_at(w, all, 2.0 * HCI_PI * turns_of(w) * k / POINTS);
        hci_range_include(&c->range, c->value[k]);
    }
}

static void draw_curve(hci_output *out, const curve *c, const char *style, const hci_svg_axis *x,
                       const hci_svg_axis *y)
{
    hci_svg_line_begin(out, style);
    for (int k = 0; k <= POINTS; ++k)
        hci_svg_line_point(out, hci_svg_at(x, 360.0 * k / POINTS), hci_svg_at(y, c->value[k]));
    hci_svg_line_end(out);
}

static void draw_turn(hci_output *out, const hci_waveform *w, const curve *kept)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_LINE, "before", "all orders that were looked at"},
                                           {HCI_SVG_LINE, "after", "orders kept"}};
    const bool compared = w->kept < w->count;
    curve all = *kept;
    if (compared) fill(&all, w, true);
    const hci_svg_axis y = hci_svg_axis_over(all.range, TURN.bottom, TURN.top, 6.0);
    const hci_svg_box b = hci_svg_box_beside(TURN, &y);
    const hci_svg_axis x = hci_svg_axis_of_angle(1.0, &b);
    char title[96];
    snprintf(title, sizeof title, "%s in %s", is_cogging(w) ? "Torque" : "Back-EMF of phase a by speed",
             unit_of(w));
    hci_svg_head(out, &b, title, LEGEND, compared ? 2 : 0);
    hci_svg_grid(out, &x, &b, false);
    hci_svg_grid(out, &y, &b, true);
    if (compared) draw_curve(out, &all, "before", &x, &y);
    draw_curve(out, kept, "after", &x, &y);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0, angle_of(w));
}

/* ---- by order ---- */

static void draw_order(hci_output *out, const hci_waveform_order *o, const hci_svg_axis *x,
                       const hci_svg_axis *y)
{
    const double at = hci_svg_at(x, o->order), top = hci_svg_log_at(y, o->amplitude);
    if (top >= y->from) return;
    if (o->kept) {
        hci_svg_segment(out, "after", at, y->from, at, top);
        hci_svg_segment(out, "noise", at, hci_svg_log_at(y, o->amplitude - INTERVAL * o->std_error), at,
                        hci_svg_log_at(y, o->amplitude + INTERVAL * o->std_error));
    }
    hci_svg_circle(out, o->kept ? "dot" : "before", at, top, o->kept ? 2.6 : 1.6);
}

static void draw_orders(hci_output *out, const hci_waveform *w)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_DOT, "before", "left out: noise can make it"},
                                           {HCI_SVG_DOT, "dot", "kept"},
                                           {HCI_SVG_LINE, "noise", "95 % interval"}};
    hci_range order = {0.0, 1.0}, amplitude = HCI_RANGE_EMPTY;
    char title[96];
    for (size_t k = 0; k < w->count; ++k) {
        hci_range_include(&order, w->order[k].order);
        if (!(w->order[k].amplitude > 0.0)) continue;
        hci_range_include(&amplitude, ROOM_BELOW * w->order[k].amplitude);
        hci_range_include(&amplitude, w->order[k].amplitude);
    }
    const hci_svg_axis x = hci_svg_axis_over(order, ORDERS.left, ORDERS.right, 16.0);
    const hci_svg_axis y = hci_svg_log_axis(amplitude, ORDERS.bottom, ORDERS.top, 4.0);
    snprintf(title, sizeof title, "Peak amplitude in %s", unit_of(w));
    hci_svg_head(out, &ORDERS, title, LEGEND, 3);
    hci_svg_log_grid(out, &y, &ORDERS, true);
    hci_svg_grid(out, &x, &ORDERS, false);
    for (int kept = 0; kept < 2; ++kept)
        for (size_t k = 0; k < w->count; ++k)
            if (w->order[k].kept == kept) draw_order(out, &w->order[k], &x, &y);
    hci_svg_label(out, "quiet middle", 0.5 * (ORDERS.left + ORDERS.right), ORDERS.bottom + 35.0,
                  "electrical order");
}

/* ---- words ---- */

enum { LINE_SIZE = 256 };

static void write_verdict(char line[LINE_SIZE], const hci_waveform *w)
{
    const hci_waveform_order *largest = NULL;
    char text[HCI_SVG_NUMBER_SIZE];
    for (size_t k = 0; k < w->count; ++k)
        if (w->order[k].kept && (!largest || w->order[k].amplitude > largest->amplitude))
            largest = &w->order[k];
    const char *quantity = is_cogging(w) ? "Cogging torque" : "Back-EMF";
    if (!largest) {
        snprintf(line, LINE_SIZE, "%s: no order stands out of the noise", quantity);
        return;
    }
    hci_svg_axis_text(text, largest->amplitude, unit_of(w));
    snprintf(line, LINE_SIZE, "%s: %zu order%s, the largest %s at electrical order %.6g", quantity, w->kept,
             w->kept == 1 ? "" : "s", text, largest->order);
}

static void write_facts(char line[LINE_SIZE], const hci_waveform *w, hci_range r)
{
    char swing[HCI_SVG_NUMBER_SIZE], friction[HCI_SVG_NUMBER_SIZE];
    hci_svg_axis_text(swing, r.high - r.low, unit_of(w));
    hci_svg_axis_text(friction, w->friction_Nm, "N·m");
    snprintf(line, LINE_SIZE, "peak to peak %s%s%s · turns: %zu forward, %zu backward · errors %s", swing,
             isfinite(w->friction_Nm) ? " · friction " : "", isfinite(w->friction_Nm) ? friction : "",
             w->turns_forward, w->turns_backward,
             w->between_turns ? "from how the turns differ" : "from the orders around");
}

void hci_plot_waveform(hci_output *out, const hci_waveform *w)
{
    char verdict[LINE_SIZE], facts[LINE_SIZE], description[2 * LINE_SIZE];
    curve kept;
    fill(&kept, w, false);
    write_verdict(verdict, w);
    write_facts(facts, w, kept.range);
    snprintf(description, sizeof description,
             "%s. Two panels: the waveform over the %s, and amplitudes by order on a logarithmic axis.",
             facts, angle_of(w));
    hci_svg_begin(out, &(hci_svg_picture){"hci", verdict, description, 0, 0, WIDTH, HEIGHT});
    hci_output_text(out, "<style>%s</style>\n", hci_svg_style);
    hci_svg_rectangle(out, "back", 0, 0, WIDTH, HEIGHT);
    hci_svg_label(out, "verdict", 24, 34, verdict);
    hci_svg_label(out, "facts quiet", 24, 58, facts);
    draw_turn(out, w, &kept);
    if (w->count > 0) draw_orders(out, w);
    hci_svg_end(out);
}
