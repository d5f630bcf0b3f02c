/* Mean i_d and i_q of a simulated drive over one electrical turn. */
#include "host/plot/plot_drive.h"

enum { STRIPS = 60 };

typedef struct {
    const hci_turn_means *turn;
    hci_svg_box box;
    hci_svg_axis x, y;
} panel;

static void draw_component(hci_output *out, const panel *p, const char *style, bool is_q)
{
    hci_svg_line_begin(out, style);
    for (size_t k = 0; k < HCI_TURN_STEPS; ++k) {
        const hci_turn_mean m = hci_turn_mean_of(p->turn, k, 1);
        if (m.samples > 0)
            hci_svg_line_point(out, hci_svg_at(&p->x, 360.0 * ((double)k + 0.5) / HCI_TURN_STEPS),
                               hci_svg_at(&p->y, is_q ? m.current_A.q : m.current_A.d));
    }
    hci_svg_line_end(out);
}

static void draw_level(hci_output *out, const panel *p, double value_A)
{
    const double y = hci_svg_at(&p->y, value_A);
    hci_svg_segment(out, "before", p->box.left, y, p->box.right, y);
}

static void draw_strips(hci_output *out, const panel *p)
{
    const double width = (p->box.right - p->box.left) / STRIPS;
    for (size_t k = 0; k < STRIPS; ++k) {
        const double left = p->box.left + width * (double)k;
        const hci_turn_mean m =
            hci_turn_mean_of(p->turn, k * (HCI_TURN_STEPS / STRIPS), HCI_TURN_STEPS / STRIPS);
        if (m.samples == 0) continue;
        hci_svg_tell(out, "");
        hci_svg_tell_value(out, "", 360.0 * ((double)k + 0.5) / STRIPS, "°");
        hci_svg_tell_value(out, ": i_d ", m.current_A.d, "A");
        hci_svg_tell_value(out, ", i_q ", m.current_A.q, "A");
        hci_svg_strip(out, &(hci_svg_box){left, p->box.top, left + width, p->box.bottom});
    }
}

static hci_range range_of(const hci_plot_turn *t)
{
    hci_range r = {0.0, 0.0};
    hci_range_include(&r, t->plain_q_A);
    for (size_t k = 0; k < HCI_TURN_STEPS; ++k) {
        const hci_turn_mean m = hci_turn_mean_of(t->turn, k, 1);
        if (m.samples == 0) continue;
        hci_range_include(&r, m.current_A.d);
        hci_range_include(&r, m.current_A.q);
    }
    return r;
}

void hci_plot_turn_dq(hci_output *out, const hci_svg_box *area, const void *turn)
{
    static const hci_svg_entry LEGEND[] = {
        {HCI_SVG_LINE, "before", "plain sine"}, {HCI_SVG_LINE, "b", "i_d"}, {HCI_SVG_LINE, "a", "i_q"}};
    const hci_plot_turn *t = turn;
    panel p = {.turn = t->turn, .y = hci_svg_axis_over(range_of(t), area->bottom, area->top, 6.0)};
    p.box = hci_svg_box_beside(*area, &p.y);
    p.x = hci_svg_axis_of_angle(1.0, &p.box);
    hci_svg_head(out, &p.box, "Mean current in the rotor frame, A", LEGEND, 3);
    hci_svg_grid(out, &p.x, &p.box, false);
    hci_svg_grid(out, &p.y, &p.box, true);
    draw_level(out, &p, 0.0);
    draw_level(out, &p, t->plain_q_A);
    draw_component(out, &p, "b", false);
    draw_component(out, &p, "a", true);
    draw_strips(out, &p);
    hci_svg_label(out, "quiet middle", 0.5 * (p.box.left + p.box.right), p.box.bottom + 35.0,
                  "electrical angle in degrees");
}
