/* The parameters of an effect with their intervals. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/plot/plot.h"
#include "host/plot/rows.h"

/* x of where names end, and of the right edge. */
static const double NAMES_END = 176.0, RIGHT = 524.0;

void hci_plot_term_name(char name[HCI_PLOT_NAME_SIZE], const hci_effect *effect, size_t term)
{
    const hci_effect_term *t = &effect->term[term];
    const hci_effect_parameter *p = &effect->type->parameter[t->parameter];
    char order[HCI_SVG_NUMBER_SIZE];
    hci_svg_short_text(order, t->order);
    snprintf(name, HCI_PLOT_NAME_SIZE, "%.40s%s%s", p->name, p->ordered ? "_" : "", p->ordered ? order : "");
}

static double half_interval(const hci_effect_term *t)
{
    return isfinite(t->std_error) ? 1.96 * t->std_error : 0.0;
}

static void draw_term(hci_output *out, const hci_effect *effect, size_t term, double y, const hci_svg_axis *x)
{
    const hci_effect_term *t = &effect->term[term];
    const double half = half_interval(t), low = hci_svg_at(x, t->value - half),
                 high = hci_svg_at(x, t->value + half);
    char name[HCI_PLOT_NAME_SIZE];
    hci_plot_term_name(name, effect, term);
    hci_svg_name(out, "quiet", 4.0, y + 4.0, name, NAMES_END - 8.0);
    hci_svg_segment(out, "after", low, y, high, y);
    hci_svg_segment(out, "after", low, y - 5.0, low, y + 5.0);
    hci_svg_segment(out, "after", high, y - 5.0, high, y + 5.0);
    hci_svg_circle(out, "dot", hci_svg_at(x, t->value), y, 3.0);
}

void hci_plot_terms(hci_output *out, const char *id, const char *title, const hci_effect *effect,
                    const size_t *term, size_t count)
{
    const hci_svg_box b = hci_rows_box(NAMES_END, RIGHT, count);
    const char *unit = effect->type->parameter[effect->term[term[0]].parameter].unit;
    hci_range r = {0.0, 0.0};
    hci_svg_axis x;
    char foot[64];
    for (size_t k = 0; k < count; ++k) {
        const hci_effect_term *t = &effect->term[term[k]];
        hci_range_include(&r, t->value - half_interval(t));
        hci_range_include(&r, t->value + half_interval(t));
    }
    x = hci_svg_axis_over(r, b.left, b.right, 5.0);
    hci_rows_begin(
        out, id, title,
        "One row for each parameter: the value and its 95 % interval. The table beside it has the numbers.",
        count);
    hci_svg_name(out, "head", 4.0, HCI_ROWS_TOP - 34.0, title, HCI_ROWS_WIDTH);
    hci_svg_grid(out, &x, &b, false);
    for (size_t k = 0; k < count; ++k)
        draw_term(out, effect, term[k], hci_rows_middle(k), &x);
    snprintf(foot, sizeof foot, "value%s%.40s", strcmp(unit, "1") == 0 ? ", without unit" : " in ",
             strcmp(unit, "1") == 0 ? "" : unit);
    hci_rows_foot(out, &b, foot);
    hci_svg_end(out);
}
