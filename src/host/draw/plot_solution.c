/* Four panels on a canvas of 1000 × 792 pixels, and words above and below. */
#include "host/draw/plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "host/draw/svg.h"

enum { WIDTH = 1000, HEIGHT = 792 };

static const hci_svg_box TORQUE = {62, 128, 540, 370}, SPECTRUM = {622, 128, 980, 370};
static const hci_svg_box CURRENT = {62, 464, 540, 706}, VECTOR = {622, 464, 980, 706};

/* Okabe and Ito's palette, told apart by colour-blind readers and by lightness in a grey print; darker in the
 * light, where marks need a contrast of 3 to the ground. Grid and rails are below that: nothing is read from
 * them alone. */
const char hci_plot_style[] =
    ".hci{font:12px system-ui,'Helvetica Neue',Arial,sans-serif}.hci text{fill:#1c1f23}"
    ".hci .back{fill:#fff}.hci .verdict{font-size:18px;font-weight:600}.hci .facts{font-size:13px}"
    ".hci .head{font-size:13px;font-weight:600}.hci .quiet{fill:#5a6068}.hci .small{font-size:11px}"
    ".hci .sub{font-size:70%}.hci .no{fill:#c04a00;font-weight:700}.hci .middle{text-anchor:middle}"
    ".hci .end{text-anchor:end}"
    ".hci path,.hci polyline{fill:none;stroke-linejoin:round;stroke-linecap:round}"
    ".hci .grid{stroke:#e4e6ea}.hci .axis{stroke:#8b9099}.hci .before{stroke:#767c86;stroke-width:1.1}"
    ".hci rect.before{fill:#8b9099;stroke:none}"
    ".hci .wanted{stroke:#b87a00;stroke-width:2.4;stroke-linecap:butt;stroke-dasharray:6 4}"
    ".hci rect.wanted{fill:none;stroke-width:1.2;stroke-dasharray:none}"
    ".hci .after{stroke:#0072b2;stroke-width:1.6}.hci rect.after{fill:#0072b2;stroke:none}"
    ".hci .a{stroke:#0072b2;stroke-width:1.8}.hci .b{stroke:#b87a00;stroke-width:1.5}"
    ".hci .c{stroke:#009e73;stroke-width:1.5}.hci .path{stroke:#0072b2;stroke-width:1.2}"
    ".hci .start{fill:#0072b2}.hci .plain{fill:none;stroke:#5a6068;stroke-width:1.8}"
    ".hci .cross,.hci .ring{fill:none;stroke:#c04a00;stroke-width:1.8}"
    ".hci .noise{stroke:#c04a00;stroke-width:1.6}.hci "
    ".spread{stroke:#0072b2;stroke-width:3;stroke-opacity:.8}"
    ".hci circle.dot{fill:#0072b2}.hci circle.hollow{fill:#fff;stroke:#0072b2;stroke-width:1.8}"
    ".hci circle.before{fill:#8b9099;stroke:none}.hci .maybe{fill:#b87a00}.hci .rail{stroke:#c3c7cd}"
    ".hci .plus{fill:#0072b2}.hci .within{fill:none;stroke:#0072b2;stroke-width:1.2}.hci "
    ".minus{fill:#fff;stroke:#c04a00;stroke-width:1.2}.hci .band{fill:#eceef1}"
    ".hci .haze{stroke:#e1e4e8;stroke-width:1.6}.hci .edge{stroke:#767c86;stroke-width:.8}"
    ".hci .limit{stroke:#c04a00;stroke-width:1.4;stroke-dasharray:5 3}"
    "@media screen and (prefers-color-scheme:dark){.hci text{fill:#eceff2}.hci .back{fill:#16191d}"
    ".hci .quiet{fill:#a6adb6}.hci .no{fill:#ff8c50}.hci .grid{stroke:#2b3037}.hci .axis{stroke:#737a84}"
    ".hci .before{stroke:#858c96}.hci rect.before{fill:#6c737d}.hci .wanted{stroke:#e69f00}"
    ".hci .after,.hci .a,.hci .path{stroke:#56b4e9}.hci rect.after,.hci .start{fill:#56b4e9}"
    ".hci .b{stroke:#e69f00}.hci .maybe{fill:#e69f00}.hci .c{stroke:#2fc79a}.hci .plain{stroke:#a6adb6}.hci "
    ".cross,.hci .ring{stroke:#ff8c50}"
    ".hci .noise{stroke:#ff8c50}.hci .spread{stroke:#56b4e9}.hci circle.dot{fill:#56b4e9}"
    ".hci circle.hollow{fill:#16191d;stroke:#56b4e9}.hci .rail{stroke:#4a515a}"
    ".hci .plus{fill:#56b4e9}.hci .within{stroke:#56b4e9}.hci .minus{fill:#16191d;stroke:#ff8c50}.hci "
    ".band{fill:#262b32}"
    ".hci .haze{stroke:#2b3037}.hci .edge{stroke:#858c96}.hci .limit{stroke:#ff8c50}}";

/* ---- curves over the angle ---- */

enum { BEFORE, WANTED, AFTER, PHASE_A, PHASE_B, PHASE_C, PLAIN_A, CURVES };

/* Each of the COLUMNS steps of a curve has two vertices: its extremes in the order in which they come. */
enum { COLUMNS = 360, VERTICES = 2 * COLUMNS, MOST_FINE = 64 };

typedef struct {
    const hci_solution *solution;
    double top_order; /* highest one that can be seen */
    double turns;     /* electrical turns drawn */
    size_t fine;      /* samples of a column */
    double value[CURVES][VERTICES + 1];
} curves;

static double amplitude(hci_harmonic h)
{
    return h.order < HCI_ORDER_TOLERANCE ? fabs(h.cosine) : hci_amplitude(h.sine, h.cosine);
}

static double largest_of(const hci_solved_order *o)
{
    return fmax(amplitude(o->target_Nm), fmax(amplitude(o->torque_Nm), amplitude(o->before_Nm)));
}

static double order_of(const hci_solved_order *o)
{
    return o->torque_Nm.order;
}

/* Below this share of the largest amplitude a harmonic is thinner than a line. */
#define VISIBLE 2e-3

static double visible_top_order(const hci_solution *s)
{
    double torque_Nm = 0.0, current_A = 0.0, top = 1.0;
    for (size_t k = 0; k < s->order_count; ++k)
        torque_Nm = fmax(torque_Nm, largest_of(&s->order[k]));
    for (size_t k = 0; k < s->current.count; ++k)
        current_A = fmax(current_A, hci_amplitude(s->current.wave[k].sine, s->current.wave[k].cosine));
    for (size_t k = 0; k < s->order_count; ++k)
        if (largest_of(&s->order[k]) >= VISIBLE * torque_Nm) top = fmax(top, order_of(&s->order[k]));
    for (size_t k = 0; k < s->current.count; ++k)
        if (hci_amplitude(s->current.wave[k].sine, s->current.wave[k].cosine) >= VISIBLE * current_A)
            top = fmax(top, s->current.wave[k].order);
    return top;
}

/* Order 0 comes first where it is there at all. */
static double mean_Nm(const hci_solution *s, bool wanted)
{
    if (s->order_count == 0 || order_of(&s->order[0]) >= HCI_ORDER_TOLERANCE) return 0.0;
    return wanted ? s->order[0].target_Nm.cosine : s->order[0].torque_Nm.cosine;
}

static void sample(const curves *c, double theta_rad, double value[CURVES])
{
    const hci_solution *s = c->solution;
    double plain[3];
    for (size_t k = BEFORE; k <= AFTER; ++k)
        value[k] = 0.0;
    for (size_t k = 0; k < s->order_count; ++k) {
        const hci_solved_order *o = &s->order[k];
        const double sine = sin(order_of(o) * theta_rad), cosine = cos(order_of(o) * theta_rad);
        value[BEFORE] += o->before_Nm.sine * sine + o->before_Nm.cosine * cosine;
        value[WANTED] += o->target_Nm.sine * sine + o->target_Nm.cosine * cosine;
        value[AFTER] += o->torque_Nm.sine * sine + o->torque_Nm.cosine * cosine;
    }
    hci_waves_at(s->current.wave, s->current.count, theta_rad, &value[PHASE_A]);
    hci_waves_at(&c->solution->plain, 1, theta_rad, plain);
    value[PLAIN_A] = plain[0];
}

static double sample_angle_rad(const curves *c, size_t column, size_t k)
{
    return 2.0 * HCI_PI * c->turns * ((double)column + (double)k / (double)c->fine) / COLUMNS;
}

static void fill_column(curves *c, size_t column)
{
    double low[CURVES], high[CURVES], value[CURVES];
    size_t low_at[CURVES] = {0}, high_at[CURVES] = {0};
    sample(c, sample_angle_rad(c, column, 0), low);
    memcpy(high, low, sizeof high);
    for (size_t k = 1; k < c->fine; ++k) {
        sample(c, sample_angle_rad(c, column, k), value);
        for (size_t j = 0; j < CURVES; ++j) {
            if (value[j] < low[j]) {
                low[j] = value[j];
                low_at[j] = k;
            } else if (value[j] > high[j]) {
                high[j] = value[j];
                high_at[j] = k;
            }
        }
    }
    for (size_t j = 0; j < CURVES; ++j) {
        const bool low_first = low_at[j] <= high_at[j];
        c->value[j][2 * column] = low_first ? low[j] : high[j];
        c->value[j][2 * column + 1] = low_first ? high[j] : low[j];
    }
}

static void fill_curves(curves *c, const hci_solution *s)
{
    const double most = (double)COLUMNS * MOST_FINE;
    double end[CURVES];
    c->solution = s;
    c->top_order = visible_top_order(s);
    c->turns = fmax(1.0, fmin((double)s->period_turns, floor(most / (8.0 * c->top_order))));
    c->fine = (size_t)fmax(2.0, fmin(MOST_FINE, ceil(8.0 * c->top_order * c->turns / COLUMNS)));
    for (size_t k = 0; k < COLUMNS; ++k)
        fill_column(c, k);
    sample(c, sample_angle_rad(c, COLUMNS, 0), end);
    for (size_t j = 0; j < CURVES; ++j)
        c->value[j][VERTICES] = end[j];
}

static hci_range range_of_values(const double *value)
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t k = 0; k <= VERTICES; ++k)
        hci_range_include(&r, value[k]);
    return r;
}

static hci_range range_of(const curves *c, size_t first, size_t last)
{
    hci_range r = HCI_RANGE_EMPTY;
    for (size_t j = first; j <= last; ++j) {
        const hci_range one = range_of_values(c->value[j]);
        hci_range_include(&r, one.low);
        hci_range_include(&r, one.high);
    }
    return r;
}

static void draw_curve(hci_output *out, const char *style, const double *value, const hci_svg_axis *x,
                       const hci_svg_axis *y)
{
    const hci_range r = range_of_values(value);
    const size_t step = fabs(hci_svg_at(y, r.high) - hci_svg_at(y, r.low)) < 0.01
                            ? VERTICES
                            : 1; /* a flat one needs its ends only */
    hci_svg_line_begin(out, style);
    for (size_t k = 0; k <= VERTICES; k += step)
        hci_svg_line_point(out, x->from + (x->to - x->from) * (double)k / VERTICES, hci_svg_at(y, value[k]));
    hci_svg_line_end(out);
}

static void draw_angle(hci_output *out, const curves *c, const hci_svg_axis *x, const hci_svg_box *b)
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

/* ---- the four panels ---- */

static void draw_torque(hci_output *out, const curves *c, const hci_svg_box *room)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_LINE, "before", "before"},
                                           {HCI_SVG_LINE, "wanted", "wanted"},
                                           {HCI_SVG_LINE, "after", "after"}};
    const hci_svg_axis y = hci_svg_axis_over(range_of(c, BEFORE, AFTER), room->bottom, room->top, 6.0);
    const hci_svg_box b = hci_svg_box_beside(*room, &y);
    const hci_svg_axis x = hci_svg_axis_of_angle(c->turns, &b);
    hci_svg_head(out, &b, "Torque in N·m", LEGEND, 3);
    draw_angle(out, c, &x, &b);
    hci_svg_grid(out, &y, &b, true);
    draw_curve(out, "before", c->value[BEFORE], &x, &y);
    draw_curve(out, "after", c->value[AFTER], &x, &y);
    draw_curve(out, "wanted", c->value[WANTED], &x, &y); /* dashed, so that what lies under it is seen */
}

/* The letter of a phase over its peak. */
static void draw_phase_letter(hci_output *out, const double *value, const char *letter, const hci_svg_axis *y,
                              const hci_svg_box *b)
{
    size_t peak = 0;
    for (size_t k = 1; k < VERTICES; ++k)
        if (value[k] > value[peak]) peak = k;
    hci_svg_label(out, "head middle", b->left + (b->right - b->left) * (double)peak / VERTICES,
                  hci_svg_at(y, value[peak]) - 5.0, letter);
}

static void draw_currents(hci_output *out, const curves *c, const hci_svg_box *room)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_LINE, "before", "i_a before"},
                                           {HCI_SVG_LINE, "a", "i_a"},
                                           {HCI_SVG_LINE, "b", "i_b"},
                                           {HCI_SVG_LINE, "c", "i_c"}};
    const hci_svg_axis y = hci_svg_axis_over(range_of(c, PHASE_A, PLAIN_A), room->bottom, room->top, 6.0);
    const hci_svg_box b = hci_svg_box_beside(*room, &y);
    const hci_svg_axis x = hci_svg_axis_of_angle(c->turns, &b);
    hci_svg_head(out, &b, "Phase currents in A", LEGEND, 4);
    draw_angle(out, c, &x, &b);
    hci_svg_grid(out, &y, &b, true);
    draw_curve(out, "before", c->value[PLAIN_A], &x, &y);
    draw_curve(out, "c", c->value[PHASE_C], &x, &y);
    draw_curve(out, "b", c->value[PHASE_B], &x, &y);
    draw_curve(out, "a", c->value[PHASE_A], &x, &y);
    draw_phase_letter(out, c->value[PHASE_A], "a", &y, &b);
    draw_phase_letter(out, c->value[PHASE_B], "b", &y, &b);
    draw_phase_letter(out, c->value[PHASE_C], "c", &y, &b);
}

/* ---- current vector ---- */

static hci_dq vector_at(const hci_wave *waves, size_t count, double theta_rad)
{
    double abc[3];
    hci_waves_at(waves, count, theta_rad, abc);
    return hci_park(hci_clarke(abc), theta_rad);
}

enum { MOST_VECTORS = 10 * COLUMNS };

static size_t vector_count(const curves *c)
{
    return (size_t)fmax(VERTICES, fmin(MOST_VECTORS, ceil(64.0 * c->top_order * c->turns)));
}

static hci_dq vector_sample(const curves *c, size_t k, size_t count)
{
    const double theta_rad = 2.0 * HCI_PI * c->turns * (double)k / (double)count;
    return vector_at(c->solution->current.wave, c->solution->current.count, theta_rad);
}

/* Both axes with the same number of amperes a pixel. */
static void vector_axes(const curves *c, hci_dq plain, const hci_svg_box *b, hci_svg_axis *d, hci_svg_axis *q)
{
    hci_range d_A = HCI_RANGE_EMPTY, q_A = HCI_RANGE_EMPTY;
    for (size_t k = 0, count = vector_count(c); k < count; ++k) {
        const hci_dq i = vector_sample(c, k, count);
        hci_range_include(&d_A, i.d);
        hci_range_include(&q_A, i.q);
    }
    hci_range_include(&d_A, plain.d);
    hci_range_include(&q_A, plain.q);
    hci_svg_equal_axes(d_A, q_A, b, d, q);
}

/* Points closer than one and a half pixels to the last one are left out. */
static void draw_path(hci_output *out, const curves *c, const hci_svg_axis *d, const hci_svg_axis *q)
{
    const size_t count = vector_count(c);
    double last_x = -1e9, last_y = -1e9;
    hci_svg_line_begin(out, "path");
    for (size_t k = 0; k <= count; ++k) {
        const hci_dq i = vector_sample(c, k, count);
        const double x = hci_svg_at(d, i.d), y = hci_svg_at(q, i.q);
        if (k < count && hypot(x - last_x, y - last_y) < 1.5) continue;
        hci_svg_line_point(out, x, y);
        last_x = x;
        last_y = y;
    }
    hci_svg_line_end(out);
}

/* With a rim, to be seen on a dense path. */
static void draw_vector_mark(hci_output *out, const char *style, double x, double y)
{
    hci_svg_circle(out, "back", x, y, 6.5);
    hci_svg_circle(out, style, x, y, 4.2);
}

static void draw_vector(hci_output *out, const curves *c, const hci_svg_box *room)
{
    static const hci_svg_entry LEGEND[] = {
        {HCI_SVG_DOT, "plain", "before"}, {HCI_SVG_LINE, "path", "after"}, {HCI_SVG_DOT, "start", "at 0°"}};
    const hci_dq plain = vector_at(&c->solution->plain, 1, 0.0), start = vector_sample(c, 0, 1);
    hci_svg_axis d, q;
    vector_axes(c, plain, room, &d, &q);
    const hci_svg_box b = hci_svg_box_beside(*room, &q);
    vector_axes(c, plain, &b, &d, &q);
    hci_svg_head(out, &b, "Current vector, i_q in A", LEGEND, 3);
    hci_svg_grid(out, &d, &b, false);
    hci_svg_grid(out, &q, &b, true);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0, "i_d in A");
    draw_path(out, c, &d, &q);
    draw_vector_mark(out, "plain", hci_svg_at(&d, plain.d), hci_svg_at(&q, plain.q));
    draw_vector_mark(out, "start", hci_svg_at(&d, start.d), hci_svg_at(&q, start.q));
}

/* ---- spectrum ---- */

enum { MOST_GROUPS = 16 };

/* Bars below this share of the largest are a pixel high. */
#define WORTHWHILE 5e-3

static bool is_missed(const hci_solved_order *o)
{
    return o->verdict > HCI_ORDER_FREE;
}

/* What an order is worth showing: its size, but a missed one never less than some of the largest. */
static double worth_of(const hci_solved_order *o, double largest_Nm)
{
    const double size_Nm = fmax(largest_of(o), o->error_Nm);
    return is_missed(o) ? fmax(size_Nm, 0.02 * largest_Nm + o->error_Nm) : size_Nm;
}

static bool is_ripple(const hci_solved_order *o)
{
    return order_of(o) >= HCI_ORDER_TOLERANCE;
}

static double largest_ripple_Nm(const hci_solution *s)
{
    double largest = 0.0;
    for (size_t k = 0; k < s->order_count; ++k)
        if (is_ripple(&s->order[k])) largest = fmax(largest, largest_of(&s->order[k]));
    return largest;
}

typedef struct {
    const hci_solution *solution;
    double largest_Nm;
} ripple;

/* 0 for what is not worth a group of bars. */
static double group_weight(const void *context, size_t k)
{
    const ripple *r = context;
    const hci_solved_order *o = &r->solution->order[k];
    const double worth = worth_of(o, r->largest_Nm);
    return is_ripple(o) && worth > WORTHWHILE * r->largest_Nm ? worth : 0.0;
}

/* A height of nothing still shows as a line. */
static void draw_bar(hci_output *out, const char *style, double left, double width, double value,
                     const hci_svg_axis *y)
{
    hci_svg_rectangle(out, style, left, fmin(hci_svg_at(y, value), y->from - 1.5), left + width, y->from);
}

static void draw_group(hci_output *out, const hci_solved_order *o, double middle, double width,
                       const hci_svg_axis *y)
{
    const double bar = fmin(13.0, 0.27 * width), top = hci_svg_at(y, largest_of(o)) - 9.0;
    draw_bar(out, "before", middle - 1.5 * bar, bar, amplitude(o->before_Nm), y);
    draw_bar(out, "wanted", middle - 0.5 * bar, bar, amplitude(o->target_Nm), y);
    draw_bar(out, "after", middle + 0.5 * bar, bar, amplitude(o->torque_Nm), y);
    if (o->verdict == HCI_ORDER_UNREACHABLE) hci_svg_cross(out, middle, top);
    if (is_missed(o) && o->verdict != HCI_ORDER_UNREACHABLE) hci_svg_circle(out, "ring", middle, top, 4.0);
}

/* Those of the groups with their orders below; `width` pixels each, from `left` on. */
static void draw_groups(hci_output *out, const hci_solution *s, const size_t *group, size_t count,
                        double left, double width, const hci_svg_axis *y)
{
    hci_svg_tag tag[MOST_GROUPS];
    for (size_t k = 0; k < count; ++k) {
        const hci_solved_order *o = &s->order[group[k]];
        tag[k].x = left + width * ((double)k + 0.5);
        tag[k].style = is_missed(o) ? "no middle" : "quiet middle";
        hci_svg_short_text(tag[k].text, order_of(o));
        draw_group(out, o, tag[k].x, width, y);
    }
    hci_svg_tags(out, tag, count, y->from);
}

static void draw_spectrum_foot(hci_output *out, const hci_solution *s, const hci_svg_box *b, size_t shown,
                               size_t eligible)
{
    static const hci_svg_entry MARKS[] = {{HCI_SVG_DOT, "ring", "missed"},
                                          {HCI_SVG_CROSS, "", "unreachable"}};
    bool missed = false, unreachable = false;
    char text[80];
    for (size_t k = 0; k < s->order_count; ++k) {
        unreachable = unreachable || s->order[k].verdict == HCI_ORDER_UNREACHABLE;
        missed = missed || (is_missed(&s->order[k]) && s->order[k].verdict != HCI_ORDER_UNREACHABLE);
    }
    if (shown < eligible)
        snprintf(text, sizeof text, "electrical order, the largest %zu of %zu", shown, eligible);
    else
        snprintf(text, sizeof text, "electrical order");
    hci_svg_label(out, "quiet", b->left, b->bottom + 35.0, text);
    hci_svg_legend(out, missed ? MARKS : MARKS + 1, (size_t)missed + (size_t)unreachable, b->right,
                   b->bottom + 35.0);
}

static void draw_spectrum(hci_output *out, const hci_solution *s, const hci_svg_box *room)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_BAR, "before", "before"},
                                           {HCI_SVG_BAR, "wanted", "wanted"},
                                           {HCI_SVG_BAR, "after", "after"}};
    const hci_range peaks = {0.0, 1.04 * largest_ripple_Nm(s)};
    const hci_svg_axis y =
        hci_svg_axis_over(peaks.high > 0.0 ? peaks : (hci_range){0.0, 1.0}, room->bottom, room->top, 6.0);
    const hci_svg_box b = hci_svg_box_beside(*room, &y);
    const ripple r = {s, largest_ripple_Nm(s)};
    size_t group[MOST_GROUPS], eligible = 0;
    const size_t count = hci_plot_largest(group_weight, &r, s->order_count, MOST_GROUPS, group);
    const double width = fmin((b.right - b.left) / (double)(count > 0 ? count : 1), 60.0);
    const double left = 0.5 * (b.left + b.right - width * (double)count);
    for (size_t k = 0; k < s->order_count; ++k)
        eligible += group_weight(&r, k) > 0.0;
    hci_svg_head(out, &b, "Ripple in N·m (peak)", LEGEND, 3);
    hci_svg_grid(out, &y, &b, true);
    draw_groups(out, s, group, count, left, width, &y);
    if (y.from - hci_svg_at(&y, s->tolerance_Nm) > 1.5 && count > 0)
        hci_svg_segment(out, "limit", b.left, hci_svg_at(&y, s->tolerance_Nm), b.right,
                        hci_svg_at(&y, s->tolerance_Nm));
    if (count == 0)
        hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), 0.5 * (b.top + b.bottom),
                      "no torque ripple");
    draw_spectrum_foot(out, s, &b, count, eligible);
}

/* ---- words ---- */

enum { LINE_SIZE = HCI_PLOT_LINE_SIZE };

static size_t missed_count(const hci_solution *s)
{
    size_t missed = 0;
    for (size_t k = 0; k < s->order_count; ++k)
        missed += is_missed(&s->order[k]);
    return missed;
}

static void missed_line(char line[LINE_SIZE], const hci_solution *s, size_t missed)
{
    char order[HCI_SVG_NUMBER_SIZE], error[HCI_SVG_NUMBER_SIZE], more[HCI_SVG_NUMBER_SIZE] = "";
    hci_svg_short_text(order, s->worst_order);
    hci_svg_quantity_text(error, s->worst_error_Nm, "N·m");
    if (missed > 1)
        snprintf(more, sizeof more, ", %zu more order%s missed", missed - 1, missed > 2 ? "s" : "");
    snprintf(line, LINE_SIZE, "Not reached: order %s is off by %s%s", order, error, more);
}

static void limit_line(char line[LINE_SIZE], const hci_solution *s)
{
    char current[HCI_SVG_NUMBER_SIZE], voltage[HCI_SVG_NUMBER_SIZE];
    hci_svg_quantity_text(current, s->peak_phase_current_A, "A");
    hci_svg_quantity_text(voltage, s->peak_line_voltage_V, "V");
    snprintf(line, LINE_SIZE, "Over a limit: the wanted torque takes a peak phase current of %s", current);
    if (isfinite(s->peak_line_voltage_V))
        snprintf(line + strlen(line), LINE_SIZE - strlen(line), " and line voltage of %s", voltage);
}

static void verdict_line(char line[LINE_SIZE], const hci_solution *s)
{
    const size_t missed = missed_count(s);
    char tolerance[HCI_SVG_NUMBER_SIZE];
    hci_svg_quantity_text(tolerance, s->tolerance_Nm, "N·m");
    if (missed > 0)
        missed_line(line, s, missed);
    else if (!s->within_limits)
        limit_line(line, s);
    else
        snprintf(line, LINE_SIZE, "Reached: every torque order is within %s of what is wanted", tolerance);
}

static void peak_to_peak_text(char text[HCI_SVG_NUMBER_SIZE], const curves *c, size_t curve)
{
    const hci_range r = range_of_values(c->value[curve]);
    hci_svg_quantity_text(text, r.high - r.low, "N·m");
}

static void facts_line(char line[LINE_SIZE], const curves *c)
{
    const hci_solution *s = c->solution;
    char mean[HCI_SVG_NUMBER_SIZE], error[HCI_SVG_NUMBER_SIZE], order[HCI_SVG_NUMBER_SIZE],
        before[HCI_SVG_NUMBER_SIZE], after[HCI_SVG_NUMBER_SIZE], loss[HCI_SVG_NUMBER_SIZE];
    hci_svg_quantity_text(mean, mean_Nm(s, false), "N·m");
    hci_svg_quantity_text(error, s->worst_error_Nm, "N·m");
    hci_svg_short_text(order, s->worst_order);
    peak_to_peak_text(before, c, BEFORE);
    peak_to_peak_text(after, c, AFTER);
    snprintf(line, LINE_SIZE,
             "mean torque %s · worst error %s at order %s · peak to peak %s before, %s after", mean, error,
             order, before, after);
    if (!isfinite(s->loss_to_plain)) return;
    hci_svg_short_text(loss, s->loss_to_plain);
    snprintf(line + strlen(line), LINE_SIZE - strlen(line), " · copper loss × %s", loss);
}

static void baseline_line(char line[LINE_SIZE], const curves *c)
{
    const hci_solution *s = c->solution;
    char plain[HCI_SVG_NUMBER_SIZE], limit[HCI_SVG_NUMBER_SIZE];
    hci_svg_quantity_text(plain, s->plain_amplitude_A, "A");
    if (!(s->plain_amplitude_A > 0.0))
        snprintf(line, LINE_SIZE,
                 "Before: no current, since no mean torque is wanted; what is left is cogging.");
    else if (s->plain_is_held)
        snprintf(
            line, LINE_SIZE,
            "Before: the held fundamental of %s alone. Copper loss is relative to that of this fundamental",
            plain);
    else
        snprintf(
            line, LINE_SIZE,
            "Before: a plain sine of %s with the wanted mean torque. Copper loss is relative to that of this "
            "sine",
            plain);
    if (!(s->plain_amplitude_A > 0.0)) return;
    if (isfinite(s->loss_to_limit) && missed_count(s) == 0) {
        hci_svg_fixed_text(limit, fmin(s->loss_to_limit, 1e6), 3);
        snprintf(line + strlen(line), LINE_SIZE - strlen(line), ", and is %s × the least possible", limit);
    }
    snprintf(line + strlen(line), LINE_SIZE - strlen(line), ".");
}

static void draw_words(hci_output *out, const hci_plot_facts *f)
{
    hci_output_text(out, "<style>%s</style>\n", hci_plot_style);
    hci_svg_rectangle(out, "back", 0.0, 0.0, WIDTH, HEIGHT);
    hci_svg_label(out, "verdict", 28.0, 38.0, f->verdict);
    hci_svg_label(out, "facts quiet", 28.0, 62.0, f->facts);
    hci_svg_label(out, "small quiet", 28.0, HEIGHT - 26.0, f->baseline);
    hci_svg_label(
        out, "small quiet", 28.0, HEIGHT - 11.0,
        "Amplitudes are peak values; angles and orders are electrical; the torque is that of the model.");
}

static void fill_vector_ranges(const curves *c, hci_plot_facts *f)
{
    f->d_A = f->q_A = HCI_RANGE_EMPTY;
    for (size_t k = 0, count = vector_count(c); k < count; ++k) {
        const hci_dq i = vector_sample(c, k, count);
        hci_range_include(&f->d_A, i.d);
        hci_range_include(&f->q_A, i.q);
    }
}

static void fill_facts(const curves *c, hci_plot_facts *f)
{
    verdict_line(f->verdict, c->solution);
    facts_line(f->facts, c);
    baseline_line(f->baseline, c);
    f->before_Nm = range_of_values(c->value[BEFORE]);
    f->wanted_Nm = range_of_values(c->value[WANTED]);
    f->after_Nm = range_of_values(c->value[AFTER]);
    for (size_t k = 0; k < 3; ++k)
        f->phase_A[k] = range_of_values(c->value[PHASE_A + k]);
    f->plain_dq_A = vector_at(&c->solution->plain, 1, 0.0);
    fill_vector_ranges(c, f);
}

void hci_plot_solution_facts(const hci_solution *solution, hci_plot_facts *facts)
{
    curves c;
    fill_curves(&c, solution);
    fill_facts(&c, facts);
}

void hci_plot_solution(hci_output *out, const hci_solution *solution)
{
    char description[2 * LINE_SIZE + 200];
    hci_plot_facts f;
    curves c;
    fill_curves(&c, solution);
    fill_facts(&c, &f);
    snprintf(description, sizeof description,
             "%s. Four panels: torque over the electrical angle, torque ripple by electrical order, phase "
             "currents, and the path of the current vector. %s",
             f.facts, f.baseline);
    hci_svg_begin(out, &(hci_svg_picture){"hci", f.verdict, description, 0, 0, WIDTH, HEIGHT});
    draw_words(out, &f);
    draw_torque(out, &c, &TORQUE);
    draw_spectrum(out, solution, &SPECTRUM);
    draw_currents(out, &c, &CURRENT);
    draw_vector(out, &c, &VECTOR);
    hci_svg_end(out);
}

void hci_plot_solution_panel(hci_output *out, const hci_solution *solution, hci_plot_panel panel)
{
    static const char *const ID[] = {"torque", "spectrum", "current", "vector"};
    static const char *const TITLE[] = {"Torque over the electrical angle: before, wanted, after",
                                        "Torque ripple by electrical order: before, wanted, after",
                                        "Phase currents over the electrical angle",
                                        "Path of the current vector in the plane of i_d and i_q"};
    static const char *const DESCRIPTION[] = {
        "Lines in N·m over the electrical angle in degrees. The table beside it has the extremes.",
        "Bars in N·m, peak amplitude, three for each order. The table beside it has the numbers.",
        "Lines in A over the electrical angle in degrees: the plain sine of phase a, and phases a, b and c "
        "of "
        "the solution. The table beside it has the waves that they are made of.",
        "i_q in A over i_d in A: the point of the plain sine, the path of the solution and where it is at "
        "angle 0. The table beside it has the extremes."};
    static const hci_svg_box BOX = {76, 36, 540, 278};
    curves c;
    fill_curves(&c, solution);
    hci_svg_begin(out, &(hci_svg_picture){ID[panel], TITLE[panel], DESCRIPTION[panel], 12, 0, 552, 322});
    if (panel == HCI_PANEL_TORQUE) draw_torque(out, &c, &BOX);
    if (panel == HCI_PANEL_SPECTRUM) draw_spectrum(out, solution, &BOX);
    if (panel == HCI_PANEL_CURRENT) draw_currents(out, &c, &BOX);
    if (panel == HCI_PANEL_VECTOR) draw_vector(out, &c, &BOX);
    hci_svg_end(out);
}

void hci_plot_solution_point(const hci_solution *solution, double theta_rad, hci_plot_point *point)
{
    const curves c = {.solution = solution};
    double value[CURVES];
    sample(&c, theta_rad, value);
    point->before_Nm = value[BEFORE];
    point->wanted_Nm = value[WANTED];
    point->after_Nm = value[AFTER];
    point->plain_A = value[PLAIN_A];
    memcpy(point->phase_A, &value[PHASE_A], sizeof point->phase_A);
    point->dq_A = vector_at(solution->current.wave, solution->current.count, theta_rad);
}
