/* Axes: from values to coordinates, grid lines and their numbers. */
#include <math.h>
#include <stdio.h>

#include "host/draw/svg.h"

#define NUMBER_GAP   8.0  /* between a box and the numbers at its left */
#define RIGHT_MARGIN 12.0 /* that every picture has at the right of a box */

double hci_svg_at(const hci_svg_axis *a, double value)
{
    const double share = (value - a->low) / (a->high - a->low);
    return a->from + fmin(fmax(share, 0.0), 1.0) * (a->to - a->from);
}

double hci_svg_nice_step(double least)
{
    const double ten = pow(10.0, floor(log10(least))), share = least / ten;
    return ten * (share <= 1.0 ? 1.0 : share <= 2.0 ? 2.0 : share <= 5.0 ? 5.0 : 10.0);
}

/* A range that can be drawn: not empty, not a point, with zero when that is near. */
static hci_range drawable(hci_range r)
{
    const double size = fmax(fabs(r.low), fabs(r.high));
    if (!(r.low <= r.high) || !(size > 1e-200) || size > 1e200) return (hci_range){-1.0, 1.0};
    if (r.high - r.low <= 1e-9 * size) return (hci_range){r.low - 0.1 * size, r.high + 0.1 * size};
    if (r.low > 0.0 && r.low < 0.5 * r.high) r.low = 0.0;
    if (r.high < 0.0 && r.high > 0.5 * r.low) r.high = 0.0;
    return r;
}

hci_svg_axis hci_svg_axis_over(hci_range r, double from, double to, double most_ticks)
{
    const hci_range shown = drawable(r);
    const double margin = 0.05 * (shown.high - shown.low);
    hci_svg_axis a = {shown.low, shown.high, from, to, 0.0};
    if (shown.low != 0.0) a.low -= margin;
    if (shown.high != 0.0) a.high += margin;
    a.step = hci_svg_nice_step((a.high - a.low) / most_ticks);
    return a;
}

/* Widens an axis about its middle. */
static void widen(hci_svg_axis *a, double span)
{
    const double middle = 0.5 * (a->low + a->high);
    a->low = middle - 0.5 * span;
    a->high = middle + 0.5 * span;
}

void hci_svg_equal_axes(hci_range x, hci_range y, const hci_svg_box *b, hci_svg_axis *x_axis,
                        hci_svg_axis *y_axis)
{
    const double width = b->right - b->left, height = b->bottom - b->top;
    double scale;
    if (x.high - x.low <= 1e-6 * (fabs(y.high) + fabs(y.low))) x = (hci_range){x.low - 1e-6, x.high + 1e-6};
    *x_axis = hci_svg_axis_over(x, b->left, b->right, 6.0);
    *y_axis = hci_svg_axis_over(y, b->bottom, b->top, 6.0);
    scale = fmax((x_axis->high - x_axis->low) / width, (y_axis->high - y_axis->low) / height);
    widen(x_axis, scale * width);
    widen(y_axis, scale * height);
    x_axis->step = y_axis->step = hci_svg_nice_step(scale * height / 6.0);
}

hci_svg_axis hci_svg_axis_of_angle(double turns, const hci_svg_box *b)
{
    static const double STEP_DEG[] = {60,   90,    180,   360,   720,    1800,  3600,
                                      7200, 18000, 36000, 72000, 180000, 360000};
    hci_svg_axis a = {0.0, 360.0 * turns, b->left, b->right, 0.0};
    size_t k = 0;
    while (k + 1 < sizeof STEP_DEG / sizeof STEP_DEG[0] && 8.0 * STEP_DEG[k] < a.high)
        ++k;
    a.step = STEP_DEG[k];
    return a;
}

static double first_tick(const hci_svg_axis *a)
{
    return ceil(a->low / a->step - 1e-9);
}

static double last_tick(const hci_svg_axis *a)
{
    return floor(a->high / a->step + 1e-9);
}

static void text_of_tick(char text[HCI_SVG_NUMBER_SIZE], const hci_svg_axis *a, double k)
{
    hci_svg_tick_text(text, k * a->step, a->step, a->step * fmax(fabs(first_tick(a)), fabs(last_tick(a))));
}

hci_svg_box hci_svg_box_beside(hci_svg_box b, const hci_svg_axis *y)
{
    double widest = 0.0;
    for (double k = first_tick(y); k <= last_tick(y); k += 1.0) {
        char text[HCI_SVG_NUMBER_SIZE];
        text_of_tick(text, y, k);
        widest = fmax(widest, hci_svg_text_width("quiet end", text));
    }
    b.left += fmax(widest + NUMBER_GAP - HCI_SVG_MARGIN, 0.0);
    return b;
}

/* The number of a grid line: at the left of the box, or below it and not beyond the room at its right. */
static void draw_number(hci_output *out, const hci_svg_box *b, bool upwards, double place, const char *text)
{
    const double most = b->right + RIGHT_MARGIN - 0.5 * hci_svg_text_width("quiet middle", text);
    if (upwards)
        hci_svg_label(out, "quiet end", b->left - NUMBER_GAP, place + 4.0, text);
    else
        hci_svg_label(out, "quiet middle", fmin(place, most), b->bottom + 17.0, text);
}

/* Every so many of the numbers below a box stand clear of one another. */
static double apart_below(const hci_svg_axis *a)
{
    const double pitch = fabs(a->to - a->from) * a->step / (a->high - a->low);
    double widest = 0.0;
    for (double k = first_tick(a); k <= last_tick(a); k += 1.0) {
        char text[HCI_SVG_NUMBER_SIZE];
        text_of_tick(text, a, k);
        widest = fmax(widest, hci_svg_text_width("quiet middle", text));
    }
    return fmax(ceil((widest + HCI_SVG_GAP) / pitch), 1.0);
}

void hci_svg_grid(hci_output *out, const hci_svg_axis *a, const hci_svg_box *b, bool upwards)
{
    const double apart = upwards ? 1.0 : apart_below(a);
    for (double k = first_tick(a); k <= last_tick(a); k += 1.0) {
        const double place = hci_svg_at(a, k * a->step);
        char text[HCI_SVG_NUMBER_SIZE];
        text_of_tick(text, a, k);
        if (upwards)
            hci_svg_segment(out, k == 0.0 ? "axis" : "grid", b->left, place, b->right, place);
        else
            hci_svg_segment(out, k == 0.0 && a->low < 0.0 ? "axis" : "grid", place, b->top, place, b->bottom);
        if (fmod(k, apart) == 0.0) draw_number(out, b, upwards, place, text);
    }
}

/* ---- logarithmic axes ---- */

/* The next of 1, 2, 5 times a power of ten, as a logarithm: not above, or not below. */
static double snapped(double value, bool up)
{
    const double ten = floor(log10(value) + 1e-9), share = value / pow(10.0, ten);
    const double below = share < 2.0 - 1e-9 ? 1.0 : share < 5.0 - 1e-9 ? 2.0 : 5.0;
    const double above = share <= 1.0 + 1e-9   ? 1.0
                         : share <= 2.0 + 1e-9 ? 2.0
                         : share <= 5.0 + 1e-9 ? 5.0
                                               : 10.0;
    return ten + log10(up ? above : below);
}

hci_svg_axis hci_svg_log_axis(hci_range r, double from, double to, double most_decades)
{
    hci_svg_axis a = {-1.0, 0.0, from, to, 1.0};
    if (!(r.high > 1e-200) || !(r.high < 1e200)) return a;
    a.high = snapped(r.high, true);
    a.low = snapped(fmax(r.low > 0.0 ? r.low : 0.0, r.high * pow(10.0, -most_decades)), false);
    a.low = fmin(a.low, a.high - 1.0);
    return a;
}

double hci_svg_log_at(const hci_svg_axis *a, double value)
{
    return value > 0.0 ? hci_svg_at(a, log10(value)) : a->from;
}

hci_svg_box hci_svg_log_box_beside(hci_svg_box b, const hci_svg_axis *y)
{
    double widest = 0.0;
    for (double k = floor(y->low + 1e-6); k <= y->high + 1e-6; k += 1.0) {
        char text[HCI_SVG_NUMBER_SIZE];
        hci_svg_tick_text(text, pow(10.0, k), pow(10.0, k), pow(10.0, k));
        widest = fmax(widest, hci_svg_text_width("quiet end", text));
    }
    b.left += fmax(widest + NUMBER_GAP - HCI_SVG_MARGIN, 0.0);
    return b;
}

static void draw_log_line(hci_output *out, const hci_svg_axis *a, const hci_svg_box *b, bool upwards,
                          double value)
{
    const double place = hci_svg_log_at(a, value);
    char text[HCI_SVG_NUMBER_SIZE];
    hci_svg_tick_text(text, value, pow(10.0, floor(log10(value) + 1e-9)), value);
    if (upwards)
        hci_svg_segment(out, "grid", b->left, place, b->right, place);
    else
        hci_svg_segment(out, "grid", place, b->top, place, b->bottom);
    draw_number(out, b, upwards, place, text);
}

void hci_svg_log_grid(hci_output *out, const hci_svg_axis *a, const hci_svg_box *b, bool upwards)
{
    static const double SHARE[] = {1.0, 2.0, 5.0};
    const double room = fabs(a->to - a->from) / (upwards ? 26.0 : 52.0);
    const size_t shares = 3.0 * (a->high - a->low) <= room ? 3 : 1;
    const double apart = fmax(1.0, ceil((a->high - a->low) / fmax(room, 1.0)));
    for (double k = floor(a->low); k <= a->high + 1e-6; k += apart)
        for (size_t j = 0; j < shares; ++j) {
            const double at = k + log10(SHARE[j]);
            if (at >= a->low - 1e-6 && at <= a->high + 1e-6)
                draw_log_line(out, a, b, upwards, SHARE[j] * pow(10.0, k));
        }
}
