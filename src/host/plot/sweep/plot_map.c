/* Maps over torque and speed, a cell for each point: ripple, copper, peak current, voltage, and which limit
 * binds. */
#include <math.h>
#include <stdio.h>

#include "hci/host/base/unit.h"
#include "host/plot/sweep/plot_sweep.h"

enum { WIDTH = 1320, HEIGHT = 836, LEVELS = 10, MOST_SIDE = 512 };

/* How panels are put side by side in a box. */
typedef struct {
    hci_svg_box area;
    int columns;
    double width, height, across, down; /* of the axes; from one panel to the next */
} layout;

typedef double value_of(const hci_grid *s, const hci_grid_figures *f);

static double ripple(const hci_grid *s, const hci_grid_figures *f)
{
    (void)s;
    return f->T_ripple_percent;
}

static double copper(const hci_grid *s, const hci_grid_figures *f)
{
    const double loss_W = hci_grid_copper_W(&s->request, f);
    return isfinite(s->request.machine->resistance_ohm) ? loss_W : f->mean_square_A2;
}

static double peak(const hci_grid *s, const hci_grid_figures *f)
{
    (void)s;
    return f->peak_A;
}

static double line(const hci_grid *s, const hci_grid_figures *f)
{
    (void)s;
    return f->line_V;
}

/* ---- where the points are ---- */

/* Values that points have, ascending, each once. */
typedef struct {
    double value[MOST_SIDE];
    size_t count;
} side;

static void include(side *s, double value)
{
    size_t k = 0;
    while (k < s->count && s->value[k] < value)
        ++k;
    if ((k < s->count && s->value[k] == value) || s->count == MOST_SIDE) return;
    for (size_t j = s->count++; j > k; --j)
        s->value[j] = s->value[j - 1];
    s->value[k] = value;
}

/* The edges of the cell of a value: halfway to its neighbours, at the first one not across zero. */
static void edges(const side *s, double value, double edge[2])
{
    size_t k = 0;
    while (k + 1 < s->count && s->value[k] < value)
        ++k;
    const double below = k > 0 ? value - s->value[k - 1] : k + 1 < s->count ? s->value[k + 1] - value : 1.0;
    const double above = k + 1 < s->count ? s->value[k + 1] - value : below;
    edge[0] = value >= 0.0 ? fmax(value - 0.5 * below, 0.0) : value - 0.5 * below;
    edge[1] = value + 0.5 * above;
}

typedef struct {
    const hci_grid *sweep;
    side speed_rpm, torque_Nm;
    double link_V; /* of the points that are drawn; NAN: all */
} field;

static void fill_field(const hci_grid *s, field *f)
{
    *f = (field){.sweep = s, .link_V = s->plan.point[0].link_V};
    for (size_t k = 0; k < s->plan.count; ++k) {
        include(&f->speed_rpm, hci_rpm(s->plan.point[k].speed_rad_per_s));
        include(&f->torque_Nm, s->plan.point[k].torque_Nm);
    }
}

static bool is_drawn(const field *f, size_t k)
{
    return isnan(f->link_V) || f->sweep->plan.point[k].link_V == f->link_V;
}

/* ---- a panel ---- */

typedef struct {
    const field *field;
    hci_svg_box box;
    hci_svg_axis x, y;
    const char *title, *unit;
    value_of *value; /* NULL: the limit that binds */
    bool is_ripple;
    double level[LEVELS]; /* a cell has the colour of the last one that it reaches */
} panel;

static hci_svg_axis axis_of(const side *s, double from, double to, double ticks)
{
    double first[2], last[2];
    edges(s, s->value[0], first);
    edges(s, s->value[s->count - 1], last);
    hci_svg_axis a = {first[0], last[1], from, to, 0.0};
    a.step = hci_svg_nice_step((a.high - a.low) / ticks);
    return a;
}

static panel make_panel(const field *f, const layout *l, int place, const char *title, value_of *value)
{
    panel p = {.field = f, .title = title, .value = value, .is_ripple = value == ripple};
    const double left = l->area.left + l->across * (place % l->columns),
                 top = l->area.top + l->down * (place / l->columns);
    p.box = (hci_svg_box){left, top, left + l->width, top + l->height};
    p.x = axis_of(&f->speed_rpm, p.box.left, p.box.right, 6.0);
    p.y = axis_of(&f->torque_Nm, p.box.bottom, p.box.top, 6.0);
    return p;
}

/* Ripple in % below which there is none on the map: a hundred orders within their tolerance make less. */
#define LEAST_RIPPLE 0.01

/* Steps of 1, 2, 5 that end below the largest ripple, or begin at the least one; the first level is none. */
static void set_ripple_levels(panel *p, double most_percent)
{
    double first = hci_svg_nice_step(fmax(most_percent, LEAST_RIPPLE) * 0.5);
    for (int k = LEVELS - 1; k > 1; --k)
        first = hci_svg_nice_step(0.39 * first);
    p->level[0] = 0.0;
    p->level[1] = fmax(first, LEAST_RIPPLE);
    for (int k = 2; k < LEVELS; ++k)
        p->level[k] = hci_svg_nice_step(1.9 * p->level[k - 1]);
}

/* Ripple in steps of 1, 2, 5; anything else in equal steps. */
static void set_levels(panel *p)
{
    const hci_grid *s = p->field->sweep;
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t k = 0; k < s->plan.count && p->value; ++k)
        if (is_drawn(p->field, k) && s->row[k].verdict <= HCI_GRID_RIPPLE)
            hci_range_include(&r, p->value(s, &s->row[k].best));
    if (!(r.low <= r.high)) r = (hci_range){0.0, 1.0};
    const double least = fmax((r.high - r.low) / (LEVELS - 1), fmax(1e-3 * r.high, 1e-12));
    const double step = hci_svg_nice_step(least), low = step * floor(r.low / step);
    for (int k = 0; k < LEVELS; ++k)
        p->level[k] = low + k * step;
    if (p->is_ripple) set_ripple_levels(p, r.high);
}

/* Classes of the limits that bind: none, current, rms, voltage, copper, several. */
static int limit_class(const hci_grid_figures *f)
{
    int found = 0, count = 0;
    for (int k = 0; k <= HCI_LIMIT_COPPER; ++k)
        if (f->binds[k]) {
            found = k + 1;
            ++count;
        }
    return count > 1 ? HCI_LIMIT_COPPER + 2 : found;
}

static void style_of(const panel *p, const hci_grid_row *row, char style[16])
{
    int k = LEVELS - 1;
    if (row->verdict > HCI_GRID_RIPPLE && (p->value || row->verdict > HCI_GRID_TORQUE)) {
        snprintf(style, 16, "band");
        return;
    }
    if (!p->value) {
        snprintf(style, 16, "kind%d", limit_class(&row->best));
        return;
    }
    const double value = p->value(p->field->sweep, &row->best);
    while (k > 0 && !(value >= p->level[k] - 1e-12 * fabs(p->level[k])))
        --k;
    if (isfinite(value))
        snprintf(style, 16, "heat%d", k);
    else
        snprintf(style, 16, "band");
}

static void tell_cell(hci_output *out, const panel *p, const hci_grid_point *point, const hci_grid_row *row)
{
    char binds[HCI_GRID_BINDS_SIZE];
    hci_grid_binds_text(&row->best, binds);
    hci_svg_tell(out, "");
    hci_svg_tell_value(out, "", hci_rpm(point->speed_rad_per_s), "rpm");
    hci_svg_tell_value(out, ", ", point->torque_Nm, "N·m");
    if (p->value)
        hci_svg_tell_value(out, ": ", p->value(p->field->sweep, &row->best), p->unit);
    else
        hci_svg_tell_more(out, binds[0] ? ": " : ": no limit");
    if (!p->value) hci_svg_tell_more(out, binds);
    hci_svg_tell_more(out, "; ");
    hci_svg_tell_more(out, hci_grid_verdict_name(row->verdict));
    hci_svg_hint(out);
}

static void draw_cells(hci_output *out, const panel *p)
{
    const hci_grid *s = p->field->sweep;
    for (size_t k = 0; k < s->plan.count; ++k) {
        const hci_grid_point *point = &s->plan.point[k];
        double x[2], y[2];
        char style[16];
        if (!is_drawn(p->field, k)) continue;
        edges(&p->field->speed_rpm, hci_rpm(point->speed_rad_per_s), x);
        edges(&p->field->torque_Nm, point->torque_Nm, y);
        style_of(p, &s->row[k], style);
        tell_cell(out, p, point, &s->row[k]);
        hci_svg_rectangle(out, style, hci_svg_at(&p->x, x[0]), hci_svg_at(&p->y, y[1]),
                          hci_svg_at(&p->x, x[1]), hci_svg_at(&p->y, y[0]));
        hci_svg_hint_end(out);
    }
}

/* ---- legends ---- */

static void draw_levels(hci_output *out, const panel *p)
{
    const double top = p->box.bottom + 46.0, width = (p->box.right - p->box.left) / LEVELS;
    const double step = p->level[1] - p->level[0];
    double free = p->box.left;
    for (int k = 0; k < LEVELS; ++k) {
        const double left = p->box.left + k * width;
        char style[16], text[HCI_SVG_NUMBER_SIZE];
        snprintf(style, sizeof style, "heat%d", k);
        hci_svg_rectangle(out, style, left, top, left + width, top + 10.0);
        if (p->is_ripple)
            hci_svg_short_text(text, p->level[k]);
        else
            hci_svg_tick_text(text, p->level[k], step, fabs(p->level[LEVELS - 1]));
        if (left < free) continue;
        hci_svg_label(out, "small quiet", left, top + 22.0, text);
        free = left + hci_svg_text_width("small quiet", text);
    }
}

/* Whether a limit of that class binds at a point that is drawn. */
static bool has_class(const field *f, int class)
{
    for (size_t k = 0; k < f->sweep->plan.count; ++k)
        if (is_drawn(f, k) && f->sweep->row[k].verdict <= HCI_GRID_TORQUE &&
            limit_class(&f->sweep->row[k].best) == class)
            return true;
    return false;
}

static void draw_kinds(hci_output *out, const panel *p)
{
    static const char *const NAME[] = {"none", "current", "rms", "voltage", "copper", "several"};
    const double top = p->box.bottom + 46.0;
    double left = p->box.left;
    for (int k = 0; k < (int)(sizeof NAME / sizeof NAME[0]); ++k) {
        char style[16];
        if (!has_class(p->field, k)) continue;
        snprintf(style, sizeof style, "kind%d", k);
        hci_svg_rectangle(out, style, left, top, left + 10.0, top + 10.0);
        hci_svg_label(out, "small quiet", left + 13.0, top + 9.0, NAME[k]);
        left += 24.0 + hci_svg_text_width("small quiet", NAME[k]);
    }
}

static void draw_panel(hci_output *out, panel *p)
{
    set_levels(p);
    hci_svg_head(out, &p->box, p->title, NULL, 0);
    draw_cells(out, p);
    hci_svg_grid(out, &p->x, &p->box, false);
    hci_svg_grid(out, &p->y, &p->box, true);
    if (p->value)
        draw_levels(out, p);
    else
        draw_kinds(out, p);
    hci_svg_label(out, "quiet middle", 0.5 * (p->box.left + p->box.right), p->box.bottom + 36.0,
                  "speed in rpm; upwards: torque in N·m");
}

/* ---- all of it ---- */

static void draw_maps(hci_output *out, const hci_grid *s, const layout *l)
{
    const bool in_W = isfinite(s->request.machine->resistance_ohm);
    const char *const unit[] = {"%", in_W ? "W" : "A²", "A", "V", ""};
    field f;
    fill_field(s, &f);
    panel all[] = {
        make_panel(&f, l, 0, "Torque ripple in % of the mean", ripple),
        make_panel(&f, l, 1, in_W ? "Copper loss in W" : "Mean of i_a² + i_b² + i_c² in A²", copper),
        make_panel(&f, l, 2, "Peak phase current in A", peak),
        make_panel(&f, l, 3, "Peak line voltage in V", line), make_panel(&f, l, 4, "Limit that binds", NULL)};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; ++k) {
        all[k].unit = unit[k];
        draw_panel(out, &all[k]);
    }
}

void hci_plot_maps(hci_output *out, const hci_svg_box *box, const void *sweep)
{
    layout l = {.area = *box, .columns = box->right - box->left > 500.0 ? 2 : 1, .down = HCI_MAP_DOWN};
    l.area.top += 26.0;
    l.height = l.down - 116.0;
    l.across = (box->right - box->left + 46.0) / l.columns;
    l.width = l.across - 46.0;
    draw_maps(out, sweep, &l);
}

static void draw_remarks(hci_output *out, const hci_grid *s, double left, double top)
{
    char text[96] = "";
    if (!isnan(s->plan.point[0].link_V))
        snprintf(text, sizeof text, "Drawn: the points with a dc link of %.5g V.", s->plan.point[0].link_V);
    hci_svg_label(out, "quiet", left, top, "Upwards: mean torque in N·m.");
    hci_svg_label(out, "quiet", left, top + 22.0, "Grey: the mean torque is not reached within the limits;");
    hci_svg_label(out, "quiet", left, top + 40.0, "in the map of limits: nothing keeps them, or no result.");
    hci_svg_label(out, "quiet", left, top + 62.0, text);
    hci_svg_label(out, "quiet", left, top + 84.0, "map.csv has the numbers.");
}

void hci_plot_map(hci_output *out, const hci_grid *s)
{
    static const hci_svg_picture PICTURE = {
        "sweep",
        "Maps over torque and speed",
        "Five maps over speed and mean torque, a cell for each point: torque ripple, copper, peak phase "
        "current, "
        "peak line voltage, and the limit that binds. map.csv has the numbers.",
        0,
        0,
        WIDTH,
        HEIGHT};
    const layout l = {{70.0, 112.0, WIDTH, HEIGHT}, 3, 350.0, 236.0, 434.0, 374.0};
    hci_plot_sweep_begin(out, &PICTURE, s);
    draw_maps(out, s, &l);
    draw_remarks(out, s, 938.0, 506.0);
    hci_svg_end(out);
}
