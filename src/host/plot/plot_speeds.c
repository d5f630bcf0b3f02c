/* Torque ripple by remedy and the voltage it takes, over the speed. */
#include <math.h>

#include "host/plot/plot.h"

enum { WIDTH = 760, HEIGHT = 580 };

static const hci_svg_box RIPPLE = {70, 64, 736, 340}, VOLTAGE = {70, 424, 736, 530};

static const char *const STYLE[HCI_REMEDIES] = {"before", "noise", "wanted", "c", "a"};

/* Its size: on a logarithmic axis there is no other. */
static double rpm_of(const hci_speed_row *row)
{
    return fabs(row->speed_rad_per_s) * 30.0 / HCI_PI;
}

static const char *label_of(const hci_speeds *s)
{
    return s->row[0].speed_rad_per_s < 0.0 ? "speed in rpm, in the negative direction" : "speed in rpm";
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

static void draw_strips(hci_output *out, const hci_speeds *s, const panel *p, const hci_svg_box *b,
                        const char *unit)
{
    static const char *const NAME[HCI_REMEDIES] = {": sine ", ", table ", ", lead ", ", compensation ",
                                                   ", feedforward "};
    for (size_t k = 0; k < s->count; ++k) {
        const double x = hci_svg_log_at(&p->x, rpm_of(&s->row[k]));
        const hci_svg_box strip = {fmax(x - 5.0, b->left), b->top, fmin(x + 5.0, b->right), b->bottom};
        hci_svg_tell(out, "");
        hci_svg_tell_value(out, "", s->row[k].speed_rad_per_s * 30.0 / HCI_PI, "rpm");
        for (int j = 0; j < HCI_REMEDIES; ++j)
            hci_svg_tell_value(out, NAME[j], p->value(&s->row[k], j), unit);
        hci_svg_strip(out, &strip);
    }
}

void hci_plot_speeds_ripple(hci_output *out, const hci_svg_box *area, const void *speeds)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_LINE, "before", "sine"},
                                           {HCI_SVG_LINE, "noise", "table"},
                                           {HCI_SVG_LINE, "wanted", "lead"},
                                           {HCI_SVG_LINE, "c", "compensation"},
                                           {HCI_SVG_LINE, "a", "feedforward"}};
    const hci_speeds *s = speeds;
    panel p = {.y = hci_svg_log_axis(range_of(s, ripple_of), area->bottom, area->top, 5.0),
               .value = ripple_of,
               .logarithmic = true};
    const hci_svg_box b = hci_svg_log_box_beside(*area, &p.y);
    p.x = speed_axis(s, &b);
    hci_svg_head(out, &b, "Torque ripple in % of the mean", LEGEND, HCI_REMEDIES);
    hci_svg_log_grid(out, &p.x, &b, false);
    hci_svg_log_grid(out, &p.y, &b, true);
    for (int remedy = 0; remedy < HCI_REMEDIES; ++remedy)
        draw_remedy(out, s, &p, remedy);
    draw_strips(out, s, &p, &b, "%");
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0, label_of(s));
}

void hci_plot_speeds_voltage(hci_output *out, const hci_svg_box *area, const void *speeds)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_LINE, "before", "sine"},
                                           {HCI_SVG_LINE, "c", "compensation"},
                                           {HCI_SVG_LINE, "a", "feedforward"},
                                           {HCI_SVG_LINE, "limit", "dc link"}};
    const hci_speeds *s = speeds;
    hci_range r = range_of(s, voltage_of);
    hci_range_include(&r, 0.0);
    hci_range_include(&r, s->dc_link_V);
    panel p = {.y = hci_svg_axis_over(r, area->bottom, area->top, 4.0), .value = voltage_of};
    const hci_svg_box b = hci_svg_box_beside(*area, &p.y);
    p.x = speed_axis(s, &b);
    hci_svg_head(out, &b, "Largest line voltage in V", LEGEND, 4);
    hci_svg_log_grid(out, &p.x, &b, false);
    hci_svg_grid(out, &p.y, &b, true);
    hci_svg_segment(out, "limit", b.left, y_at(&p, s->dc_link_V), b.right, y_at(&p, s->dc_link_V));
    for (int remedy = 0; remedy < HCI_REMEDIES; ++remedy)
        draw_remedy(out, s, &p, remedy);
    draw_strips(out, s, &p, &b, "V");
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0, label_of(s));
}

void hci_plot_speeds(hci_output *out, const hci_speeds *s)
{
    static const hci_svg_picture PICTURE = {
        "speeds",
        "Torque ripple over the speed by remedy",
        "Above: torque ripple in percent on logarithmic axes, one line for each of sine, table, lead, "
        "compensation and feedforward. Below: the largest line voltage and the dc link. speeds.csv has the "
        "numbers.",
        0,
        0,
        WIDTH,
        HEIGHT};
    hci_svg_begin(out, &PICTURE);
    hci_output_text(out, "<style>%s</style>\n", hci_svg_style);
    hci_svg_rectangle(out, "back", 0.0, 0.0, WIDTH, HEIGHT);
    hci_plot_speeds_ripple(out, &RIPPLE, s);
    hci_plot_speeds_voltage(out, &VOLTAGE, s);
    hci_svg_end(out);
}
