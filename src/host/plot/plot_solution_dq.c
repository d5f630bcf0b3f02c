/* i_d and i_q of a solution over the electrical angle. */
#include "host/plot/solution_curves.h"

#include <math.h>

enum { STRIPS = 60 };

typedef struct {
    const hci_solution_curves *curves;
    hci_svg_box box;
    hci_svg_axis x, y;
} panel;

static void draw_component(hci_output *out, const panel *p, const char *style, bool is_q)
{
    const size_t count = hci_curve_vectors(p->curves);
    hci_svg_line_begin(out, style);
    for (size_t k = 0; k <= count; ++k) {
        const hci_dq i = hci_curve_vector_sample(p->curves, k, count);
        hci_svg_line_point(out, p->x.from + (p->x.to - p->x.from) * (double)k / (double)count,
                           hci_svg_at(&p->y, is_q ? i.q : i.d));
    }
    hci_svg_line_end(out);
}

static void draw_plain(hci_output *out, const panel *p, hci_dq plain)
{
    const double d = hci_svg_at(&p->y, plain.d), q = hci_svg_at(&p->y, plain.q);
    hci_svg_segment(out, "before", p->box.left, d, p->box.right, d);
    hci_svg_segment(out, "before", p->box.left, q, p->box.right, q);
}

static void draw_strips(hci_output *out, const panel *p, hci_dq plain)
{
    const double width = (p->box.right - p->box.left) / STRIPS;
    for (size_t k = 0; k < STRIPS; ++k) {
        const hci_dq i = hci_curve_vector_sample(p->curves, 2 * k + 1, 2 * STRIPS);
        const double left = p->box.left + width * (double)k;
        hci_svg_tell(out, "");
        hci_svg_tell_value(out, "", 360.0 * p->curves->turns * (double)(2 * k + 1) / (2 * STRIPS), "°");
        hci_svg_tell_value(out, ": i_d ", i.d, "A");
        hci_svg_tell_value(out, ", i_q ", i.q, "A");
        hci_svg_tell_value(out, "; before: i_q ", plain.q, "A");
        hci_svg_strip(out, &(hci_svg_box){left, p->box.top, left + width, p->box.bottom});
    }
}

#define OF_Q 0.01 /* i_d to i_q of a plain sine that is i_q alone */

void hci_panel_dq(hci_output *out, const hci_solution_curves *c, const hci_svg_box *box)
{
    const hci_dq plain = hci_curve_vector(&c->solution->plain, 1, 0.0);
    const bool is_of_q = fabs(plain.d) < OF_Q * fabs(plain.q);
    const hci_svg_entry LEGEND[] = {{HCI_SVG_LINE, "before", is_of_q ? "before (i_d = 0)" : "before"},
                                    {HCI_SVG_LINE, "b", "i_d after"},
                                    {HCI_SVG_LINE, "a", "i_q after"}};
    panel p = {.curves = c, .box = hci_curve_box(c, box)};
    p.y = hci_svg_axis_over(hci_curve_dq_range(c), box->bottom, box->top, HCI_CURVE_TICKS);
    p.x = hci_svg_axis_of_angle(c->turns, &p.box);
    hci_svg_head(out, &p.box, "Current in the rotor frame, A", LEGEND, 3);
    hci_panel_angle(out, c, &p.x, &p.box);
    hci_svg_grid(out, &p.y, &p.box, true);
    draw_plain(out, &p, plain);
    draw_component(out, &p, "b", false);
    draw_component(out, &p, "a", true);
    draw_strips(out, &p, plain);
}
