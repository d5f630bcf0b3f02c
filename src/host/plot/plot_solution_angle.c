/* Torque, and phase currents, over the electrical angle. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/plot/solution_curves.h"

static void draw_curve(hci_output *out, const char *style, const double *value, const hci_svg_axis *x,
                       const hci_svg_axis *y)
{
    const hci_range r = hci_curve_range(value);
    const size_t step = fabs(hci_svg_at(y, r.high) - hci_svg_at(y, r.low)) < 0.01
                            ? HCI_CURVE_VERTICES
                            : 1; /* a flat one needs its ends only */
    hci_svg_line_begin(out, style);
    for (size_t k = 0; k <= HCI_CURVE_VERTICES; k += step)
        hci_svg_line_point(out, x->from + (x->to - x->from) * (double)k / HCI_CURVE_VERTICES,
                           hci_svg_at(y, value[k]));
    hci_svg_line_end(out);
}

enum { STRIPS = 60 };

/* A curve and its name in what strips tell. */
typedef struct {
    const char *name;
    const double *value;
    double expected; /* how far from it the machine may be; 0: nothing is said */
} told;

/* Strips over the angle that tell the values of some curves there. */
static void draw_strips(hci_output *out, const hci_solution_curves *c, const hci_svg_box *b, const char *unit,
                        const told *curve, size_t count)
{
    const double width = (b->right - b->left) / STRIPS;
    for (size_t k = 0; k < STRIPS; ++k) {
        const size_t vertex = (2 * k + 1) * HCI_CURVE_VERTICES / (2 * STRIPS);
        const hci_svg_box strip = {b->left + width * (double)k, b->top, b->left + width * (double)(k + 1),
                                   b->bottom};
        hci_svg_tell(out, "");
        hci_svg_tell_value(out, "", 360.0 * c->turns * (double)vertex / HCI_CURVE_VERTICES, "°");
        for (size_t j = 0; j < count; ++j) {
            hci_svg_tell_more(out, j > 0 ? ", " : ": ");
            hci_svg_tell_more(out, curve[j].name);
            hci_svg_tell_value(out, " ", curve[j].value[vertex], unit);
            if (curve[j].expected > 0.0)
                hci_svg_tell_value(out, ", on the machine (95 %) ± ", curve[j].expected, unit);
        }
        hci_svg_strip(out, &strip);
    }
}

void hci_panel_angle(hci_output *out, const hci_solution_curves *c, const hci_svg_axis *x,
                     const hci_svg_box *b)
{
    char text[HCI_SVG_NUMBER_SIZE + 80];
    hci_svg_grid(out, x, b, false);
    if (c->turns < (double)c->solution->period_turns)
        snprintf(text, sizeof text, "electrical angle in degrees; %.0f of %zu turns", c->turns,
                 c->solution->period_turns);
    else
        snprintf(text, sizeof text, "electrical angle in degrees");
    hci_svg_label(out, "quiet middle", 0.5 * (b->left + b->right), b->bottom + 35.0, text);
}

/* Upwards of the curve after to its end, and back below it. */
static void draw_expected(hci_output *out, const hci_solution_curves *c, double half_Nm,
                          const hci_svg_axis *x, const hci_svg_axis *y)
{
    const double *value = c->value[HCI_CURVE_AFTER], width = x->to - x->from;
    if (!(half_Nm > 0.0)) return;
    hci_svg_line_begin(out, "expected");
    for (size_t k = 0; k <= HCI_CURVE_VERTICES; ++k)
        hci_svg_line_point(out, x->from + width * (double)k / HCI_CURVE_VERTICES,
                           hci_svg_at(y, value[k] + half_Nm));
    for (size_t k = HCI_CURVE_VERTICES + 1; k-- > 0;)
        hci_svg_line_point(out, x->from + width * (double)k / HCI_CURVE_VERTICES,
                           hci_svg_at(y, value[k] - half_Nm));
    hci_svg_line_end(out);
}

#define APART 0.005 /* of the axis: nearer to each other two curves are one */

/* Whether the wanted torque is seen beside the one that is reached. */
static bool is_wanted_seen(const hci_solution_curves *c, const hci_svg_axis *y)
{
    for (size_t k = 0; k <= HCI_CURVE_VERTICES; ++k)
        if (!(fabs(c->value[HCI_CURVE_AFTER][k] - c->value[HCI_CURVE_WANTED][k]) <=
              APART * (y->high - y->low)))
            return true;
    return false;
}

/* What is drawn of the torque, without what has no mark. */
static size_t torque_legend(bool has_wanted, bool has_expected, hci_svg_entry legend[4])
{
    size_t n = 0;
    legend[n++] = (hci_svg_entry){HCI_SVG_LINE, "before", "before"};
    if (has_wanted) legend[n++] = (hci_svg_entry){HCI_SVG_LINE, "wanted", "wanted"};
    legend[n++] = (hci_svg_entry){HCI_SVG_LINE, "after", "after"};
    if (has_expected) legend[n++] = (hci_svg_entry){HCI_SVG_BAR, "expected", "on the machine (95 %)"};
    return n;
}

void hci_panel_torque(hci_output *out, const hci_solution_curves *c, const hci_svg_box *box)
{
    hci_svg_entry legend[4];
    const double half_Nm = 0.5 * hci_plot_expected_Nm(c->solution);
    const hci_svg_axis y =
        hci_svg_axis_over(hci_curve_torque_range(c), box->bottom, box->top, HCI_CURVE_TICKS);
    const hci_svg_box b = hci_curve_box(c, box);
    const hci_svg_axis x = hci_svg_axis_of_angle(c->turns, &b);
    const bool has_wanted = is_wanted_seen(c, &y);
    hci_svg_head(out, &b, "Torque in N·m", legend, torque_legend(has_wanted, half_Nm > 0.0, legend));
    hci_panel_angle(out, c, &x, &b);
    hci_svg_grid(out, &y, &b, true);
    draw_curve(out, "before", c->value[HCI_CURVE_BEFORE], &x, &y);
    draw_expected(out, c, half_Nm, &x, &y);
    draw_curve(out, "after", c->value[HCI_CURVE_AFTER], &x, &y);
    if (has_wanted) draw_curve(out, "wanted", c->value[HCI_CURVE_WANTED], &x, &y); /* dashed: seen through */
    draw_strips(out, c, &b, "N·m",
                (const told[]){{"before", c->value[HCI_CURVE_BEFORE], 0.0},
                               {"wanted", c->value[HCI_CURVE_WANTED], 0.0},
                               {"after", c->value[HCI_CURVE_AFTER], half_Nm}},
                3);
}

/* The letter of a phase over its peak. */
static void draw_phase_letter(hci_output *out, const double *value, const char *letter, const hci_svg_axis *y,
                              const hci_svg_box *b)
{
    size_t peak = 0;
    for (size_t k = 1; k < HCI_CURVE_VERTICES; ++k)
        if (value[k] > value[peak]) peak = k;
    hci_svg_label(out, "head middle", b->left + (b->right - b->left) * (double)peak / HCI_CURVE_VERTICES,
                  hci_svg_at(y, value[peak]) - 5.0, letter);
}

typedef struct {
    hci_svg_entry entry;
    int curve;
    const char *letter;
} phase_curve;

/* Over several turns three phases are a woven band: phase a alone shows how one turn differs from the next.
 */
static size_t phases_of(const hci_solution_curves *c, phase_curve list[4])
{
    static const phase_curve ALL[] = {{{HCI_SVG_LINE, "before", "i_a before"}, HCI_CURVE_PLAIN_A, NULL},
                                      {{HCI_SVG_LINE, "a", "i_a"}, HCI_CURVE_PHASE_A, "a"},
                                      {{HCI_SVG_LINE, "b", "i_b"}, HCI_CURVE_PHASE_B, "b"},
                                      {{HCI_SVG_LINE, "c", "i_c"}, HCI_CURVE_PHASE_C, "c"}};
    const size_t count = c->turns > 1.0 ? 2 : 4;
    memcpy(list, ALL, count * sizeof *list);
    return count;
}

void hci_panel_currents(hci_output *out, const hci_solution_curves *c, const hci_svg_box *box)
{
    phase_curve phase[4];
    hci_svg_entry legend[4];
    told curve[4];
    const size_t count = phases_of(c, phase);
    const hci_svg_axis y =
        hci_svg_axis_over(hci_curve_current_range(c), box->bottom, box->top, HCI_CURVE_TICKS);
    const hci_svg_box b = hci_curve_box(c, box);
    const hci_svg_axis x = hci_svg_axis_of_angle(c->turns, &b);
    for (size_t k = 0; k < count; ++k) {
        legend[k] = phase[k].entry;
        curve[k] = (told){phase[k].entry.text, c->value[phase[k].curve], 0.0};
    }
    hci_svg_head(out, &b, "Phase currents in A", legend, count);
    hci_panel_angle(out, c, &x, &b);
    hci_svg_grid(out, &y, &b, true);
    draw_curve(out, "before", curve[0].value, &x, &y);
    for (size_t k = count - 1; k > 0; --k)
        draw_curve(out, phase[k].entry.style, curve[k].value, &x, &y);
    for (size_t k = 1; k < count && count > 2; ++k)
        draw_phase_letter(out, curve[k].value, phase[k].letter, &y, &b);
    draw_strips(out, c, &b, "A", curve, count);
}
