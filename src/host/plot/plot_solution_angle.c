/* Torque, and phase currents, over the electrical angle. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/plot/solution_curves.h"

static hci_range range_of(const hci_solution_curves *c, size_t first, size_t last)
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t j = first; j <= last; ++j) {
        const hci_range one = hci_curve_range(c->value[j]);
        hci_range_include(&r, one.low);
        hci_range_include(&r, one.high);
    }
    return r;
}

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
        snprintf(text, sizeof text, "electrical angle in degrees; %.0f of the %zu turns of the period",
                 c->turns, c->solution->period_turns);
    else
        snprintf(text, sizeof text, "electrical angle in degrees");
    hci_svg_label(out, "quiet middle", 0.5 * (b->left + b->right), b->bottom + 35.0, text);
}

void hci_panel_torque(hci_output *out, const hci_solution_curves *c, const hci_svg_box *box)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_LINE, "before", "before"},
                                           {HCI_SVG_LINE, "wanted", "wanted"},
                                           {HCI_SVG_LINE, "after", "after"}};
    const hci_svg_axis y =
        hci_svg_axis_over(range_of(c, HCI_CURVE_BEFORE, HCI_CURVE_AFTER), box->bottom, box->top, 6.0);
    const hci_svg_box b = hci_svg_box_beside(*box, &y);
    const hci_svg_axis x = hci_svg_axis_of_angle(c->turns, &b);
    hci_svg_head(out, &b, "Torque in N·m", LEGEND, 3);
    hci_panel_angle(out, c, &x, &b);
    hci_svg_grid(out, &y, &b, true);
    draw_curve(out, "before", c->value[HCI_CURVE_BEFORE], &x, &y);
    draw_curve(out, "after", c->value[HCI_CURVE_AFTER], &x, &y);
    draw_curve(out, "wanted", c->value[HCI_CURVE_WANTED], &x,
               &y); /* dashed, so that what lies under it is seen */
    draw_strips(out, c, &b, "N·m",
                (const told[]){{"before", c->value[HCI_CURVE_BEFORE]},
                               {"wanted", c->value[HCI_CURVE_WANTED]},
                               {"after", c->value[HCI_CURVE_AFTER]}},
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
        hci_svg_axis_over(range_of(c, HCI_CURVE_PHASE_A, HCI_CURVE_PLAIN_A), box->bottom, box->top, 6.0);
    const hci_svg_box b = hci_svg_box_beside(*box, &y);
    const hci_svg_axis x = hci_svg_axis_of_angle(c->turns, &b);
    for (size_t k = 0; k < count; ++k) {
        legend[k] = phase[k].entry;
        curve[k] = (told){phase[k].entry.text, c->value[phase[k].curve]};
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
