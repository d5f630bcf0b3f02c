/* Path of the current vector in the plane of i_d and i_q. */
#include <math.h>

#include "host/plot/solution_curves.h"

/* Both axes with the same number of amperes a pixel. */
static void vector_axes(const hci_solution_curves *c, hci_dq plain, const hci_svg_box *b, hci_svg_axis *d,
                        hci_svg_axis *q)
{
    hci_range d_A = HCI_RANGE_EMPTY, q_A = HCI_RANGE_EMPTY;
    for (size_t k = 0, count = hci_curve_vectors(c); k < count; ++k) {
        const hci_dq i = hci_curve_vector_sample(c, k, count);
        hci_range_include(&d_A, i.d);
        hci_range_include(&q_A, i.q);
    }
    hci_range_include(&d_A, plain.d);
    hci_range_include(&q_A, plain.q);
    hci_svg_equal_axes(d_A, q_A, b, d, q);
}

/* Points closer than one and a half pixels to the last one are left out. */
static void draw_path(hci_output *out, const hci_solution_curves *c, const hci_svg_axis *d,
                      const hci_svg_axis *q)
{
    const size_t count = hci_curve_vectors(c);
    double last_x = -1e9, last_y = -1e9;
    hci_svg_tell(out, "after: the path over the period");
    hci_svg_hint(out);
    hci_svg_line_begin(out, "path");
    for (size_t k = 0; k <= count; ++k) {
        const hci_dq i = hci_curve_vector_sample(c, k, count);
        const double x = hci_svg_at(d, i.d), y = hci_svg_at(q, i.q);
        if (k < count && hypot(x - last_x, y - last_y) < 1.5) continue;
        hci_svg_line_point(out, x, y);
        last_x = x;
        last_y = y;
    }
    hci_svg_line_end(out);
    hci_svg_hint_end(out);
}

/* With a rim, to be seen on a dense path. */
static void draw_vector_mark(hci_output *out, const char *style, double x, double y)
{
    hci_svg_circle(out, "back", x, y, 6.5);
    hci_svg_circle(out, style, x, y, 4.2);
}

static void tell_vector(hci_output *out, const char *name, hci_dq i)
{
    hci_svg_tell(out, name);
    hci_svg_tell_value(out, ": i_d ", i.d, "A");
    hci_svg_tell_value(out, ", i_q ", i.q, "A");
    hci_svg_hint(out);
}

void hci_panel_vector(hci_output *out, const hci_solution_curves *c, const hci_svg_box *box)
{
    static const hci_svg_entry LEGEND[] = {
        {HCI_SVG_DOT, "plain", "before"}, {HCI_SVG_LINE, "path", "after"}, {HCI_SVG_DOT, "start", "at 0°"}};
    const hci_dq plain = hci_curve_vector(&c->solution->plain, 1, 0.0),
                 start = hci_curve_vector_sample(c, 0, 1);
    hci_svg_axis d, q;
    vector_axes(c, plain, box, &d, &q);
    const hci_svg_box b = hci_svg_box_beside(*box, &q);
    vector_axes(c, plain, &b, &d, &q);
    hci_svg_head(out, &b, "Current vector, i_q in A", LEGEND, 3);
    hci_svg_grid(out, &d, &b, false);
    hci_svg_grid(out, &q, &b, true);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0, "i_d in A");
    draw_path(out, c, &d, &q);
    tell_vector(out, "before", plain);
    draw_vector_mark(out, "plain", hci_svg_at(&d, plain.d), hci_svg_at(&q, plain.q));
    hci_svg_hint_end(out);
    tell_vector(out, "after, at 0°", start);
    draw_vector_mark(out, "start", hci_svg_at(&d, start.d), hci_svg_at(&q, start.q));
    hci_svg_hint_end(out);
}
