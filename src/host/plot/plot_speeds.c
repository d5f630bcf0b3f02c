/* Torque ripple by remedy and the voltage it takes, over the speed. */
#include <math.h>

#include "host/plot/plot.h"

enum { WIDTH = 760, HEIGHT = 560 };

static const hci_svg_box RIPPLE = {70, 64, 736, 340}, VOLTAGE = {70, 404, 736, 510};

static const char *const STYLE[HCI_REMEDIES] = {"before", "noise", "wanted", "c", "a"};

static double rpm_of(const hci_speed_row *row)
{
    return row->speed_rad_per_s * 30.0 / HCI_PI;
}

static double ripple_of(const hci_speed_row *row, int remedy)
{
    return row->remedy[remedy].T_ripple_percent;
}

static double voltage_of(const hci_speed_row *row, int remedy)
{
    return row->remedy[remedy].line_V;
}

typedef struct {
    hci_svg_axis x, y;
    double (*value)(const hci_speed_row *row, int remedy);
    bool logarithmic;
} panel;

static double y_at(const panel *p, double value)
{
    return p->logarithmic ? hci_svg_log_at(&p->y, value) : hci_svg_at(&p->y, value);
}

/* Compensation and feedforward often lie upon each other: a ring around a dot. */
static void draw_remedy(hci_output *out, const hci_speeds *s, const panel *p, int remedy)
{
    hci_svg_line_begin(out, STYLE[remedy]);
    for (size_t k = 0; k < s->count; ++k)
        if (isfinite(p->value(&s->row[k], remedy)))
            hci_svg_line_point(out, hci_svg_log_at(&p->x, rpm_of(&s->row[k])),
                               y_at(p, p->value(&s->row[k], remedy)));
    hci_svg_line_end(out);
    for (size_t k = 0; k < s->count; ++k) {
        const double x = hci_svg_log_at(&p->x, rpm_of(&s->row[k])), y = y_at(p, p->value(&s->row[k], remedy));
        if (!isfinite(p->value(&s->row[k], remedy))) continue;
        if (remedy == HCI_REMEDY_FEEDFORWARD) hci_svg_circle(out, "dot", x, y, 2.4);
        if (remedy == HCI_REMEDY_COMPENSATION) hci_svg_circle(out, "c", x, y, 5.0);
        if (remedy == HCI_REMEDY_SINE) hci_svg_circle(out, "before", x, y, 2.4);
    }
}

static hci_range range_of(const hci_speeds *s, double (*value)(const hci_speed_row *, int))
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t k = 0; k < s->count; ++k)
        for (int remedy = 0; remedy < HCI_REMEDIES; ++remedy)
            if (isfinite(value(&s->row[k], remedy))) hci_range_include(&r, value(&s->row[k], remedy));
    return r;
}

static hci_svg_axis speed_axis(const hci_speeds *s, const hci_svg_box *b)
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t k = 0; k < s->count; ++k)
        hci_range_include(&r, rpm_of(&s->row[k]));
    return hci_svg_log_axis(r, b->left, b->right, 4.0);
}

static void draw_ripple(hci_output *out, const hci_speeds *s)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_LINE, "before", "sine"},
                                           {HCI_SVG_LINE, "noise", "table"},
                                           {HCI_SVG_LINE, "wanted", "lead"},
                                           {HCI_SVG_LINE, "c", "compensation"},
                                           {HCI_SVG_LINE, "a", "feedforward"}};
    const panel p = {speed_axis(s, &RIPPLE),
                     hci_svg_log_axis(range_of(s, ripple_of), RIPPLE.bottom, RIPPLE.top, 5.0), ripple_of,
                     true};
    hci_svg_head(out, &RIPPLE, "Torque ripple in % of the mean", LEGEND, HCI_REMEDIES);
    hci_svg_log_grid(out, &p.x, &RIPPLE, false);
    hci_svg_log_grid(out, &p.y, &RIPPLE, true);
    for (int remedy = 0; remedy < HCI_REMEDIES; ++remedy)
        draw_remedy(out, s, &p, remedy);
}

static void draw_voltage(hci_output *out, const hci_speeds *s)
{
    hci_range r = range_of(s, voltage_of);
    hci_range_include(&r, 0.0);
    hci_range_include(&r, s->dc_link_V);
    const panel p = {speed_axis(s, &VOLTAGE), hci_svg_axis_over(r, VOLTAGE.bottom, VOLTAGE.top, 4.0),
                     voltage_of, false};
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_LINE, "limit", "dc link"}};
    hci_svg_head(out, &VOLTAGE, "Largest line voltage in V", LEGEND, 1);
    hci_svg_log_grid(out, &p.x, &VOLTAGE, false);
    hci_svg_grid(out, &p.y, &VOLTAGE, true);
    hci_svg_segment(out, "limit", VOLTAGE.left, y_at(&p, s->dc_link_V), VOLTAGE.right,
                    y_at(&p, s->dc_link_V));
    for (int remedy = 0; remedy < HCI_REMEDIES; ++remedy)
        draw_remedy(out, s, &p, remedy);
    hci_svg_label(out, "quiet middle", 0.5 * (VOLTAGE.left + VOLTAGE.right), HEIGHT - 14.0, "speed in rpm");
}

void hci_plot_speeds(hci_output *out, const hci_speeds *s, bool stands_alone)
{
    static const hci_svg_picture PICTURE = {
        "speeds",
        "Torque ripple over the speed by remedy",
        "Above: torque ripple in percent on logarithmic axes, one line for each of sine, table, lead, "
        "compensation "
        "and feedforward. Below: the largest line voltage and the dc link. speeds.csv has the numbers.",
        0,
        0,
        WIDTH,
        HEIGHT};
    hci_svg_begin(out, &PICTURE);
    if (stands_alone) {
        hci_output_text(out, "<style>%s</style>\n", hci_svg_style);
        hci_svg_rectangle(out, "back", 0.0, 0.0, WIDTH, HEIGHT);
    }
    draw_ripple(out, s);
    draw_voltage(out, s);
    hci_svg_end(out);
}
