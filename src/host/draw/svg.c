/* The only file that writes SVG. */
#include "host/draw/svg.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/base/utf8.h"

/* ---- numbers as text, without the locale ---- */

void hci_svg_fixed_text(char text[HCI_SVG_NUMBER_SIZE], double value, int decimals)
{
    const double power = pow(10.0, decimals);
    const long long scaled = llround(fmin(fabs(value) * power, 1e15)), unit = llround(power);
    const char *sign = value < 0.0 && scaled > 0 ? "−" : "";
    if (decimals == 0)
        snprintf(text, HCI_SVG_NUMBER_SIZE, "%s%lld", sign, scaled);
    else
        snprintf(text, HCI_SVG_NUMBER_SIZE, "%s%lld.%0*lld", sign, scaled / unit, decimals, scaled % unit);
}

enum { MOST_DECIMALS = 12 };

static int decade(double value)
{
    return isfinite(value) && value != 0.0 ? (int)floor(log10(fabs(value)) + 1e-9) : 0;
}

/* A multiple of `step` with the decimals that the step has. largest: of the values on the axis, which share
 * one notation; a power of ten where they are small or large, and not only near to one another. */
static void tick_text(char text[HCI_SVG_NUMBER_SIZE], double value, double step, double largest)
{
    const bool plain = (step >= 1e-4 || largest >= 1e-3) && largest < 1e6;
    const int exponent = plain ? 0 : decade(fmax(largest, step)), decimals = exponent - decade(step);
    if (fabs(value) < 0.5 * step) value = 0.0;
    hci_svg_fixed_text(text, value / pow(10.0, exponent),
                       decimals < 0                    ? 0
                       : value == 0.0 && exponent != 0 ? 0
                       : decimals < MOST_DECIMALS      ? decimals
                                                       : MOST_DECIMALS);
    if (value != 0.0 && exponent != 0)
        snprintf(text + strlen(text), HCI_SVG_NUMBER_SIZE - strlen(text), "e%d", exponent);
}

void hci_svg_short_text(char text[HCI_SVG_NUMBER_SIZE], double value)
{
    const int exponent = fabs(value) >= 1e-6 ? decade(value) : 0;
    hci_svg_fixed_text(text, value, exponent < 3 ? 3 - exponent : 0);
    if (!strchr(text, '.')) return;
    for (char *end = text + strlen(text) - 1; *end == '0' || *end == '.'; --end) {
        const bool point = *end == '.';
        *end = '\0';
        if (point) return;
    }
}

void hci_svg_quantity_text(char text[HCI_SVG_NUMBER_SIZE], double value, const char *unit)
{
    static const char *const PREFIX[] = {"p", "n", "µ", "m", "", "k", "M"};
    int k = 4;
    if (!isfinite(value) || fabs(value) >= 1e9) {
        snprintf(text, HCI_SVG_NUMBER_SIZE, "> 1000 M%s", unit);
    } else if (value != 0.0 && fabs(value) < 1e-12) {
        snprintf(text, HCI_SVG_NUMBER_SIZE, "< 1 p%s", unit);
    } else {
        for (; fabs(value) >= 1000.0 && k < 6; ++k)
            value /= 1000.0;
        for (; fabs(value) < 0.1 && value != 0.0 && k > 0; --k)
            value *= 1000.0;
        hci_svg_short_text(text, value);
        snprintf(text + strlen(text), HCI_SVG_NUMBER_SIZE - strlen(text), " %s%s", PREFIX[k], unit);
    }
}

/* ---- elements ---- */

/* A coordinate in hundredths; what lies far out or is no number goes to the edge. */
static void put(hci_output *out, double value, const char *after)
{
    const double limited = value > -9999.0 ? fmin(value, 9999.0) : -9999.0;
    const long hundredths = lround(100.0 * limited);
    hci_output_text(out, "%s%ld.%02ld%s", hundredths < 0 ? "-" : "", labs(hundredths) / 100,
                    labs(hundredths) % 100, after);
}

void hci_svg_segment(hci_output *out, const char *style, double x1, double y1, double x2, double y2)
{
    hci_output_text(out, "<path class=\"%s\" d=\"M", style);
    put(out, x1, " ");
    put(out, y1, "L");
    put(out, x2, " ");
    put(out, y2, "\"/>\n");
}

void hci_svg_rectangle(hci_output *out, const char *style, double left, double top, double right,
                       double bottom)
{
    hci_output_text(out, "<rect class=\"%s\" x=\"", style);
    put(out, left, "\" y=\"");
    put(out, top, "\" width=\"");
    put(out, fmax(right - left, 0.0), "\" height=\"");
    put(out, fmax(bottom - top, 0.0), "\"/>\n");
}

void hci_svg_circle(hci_output *out, const char *style, double x, double y, double radius)
{
    hci_output_text(out, "<circle class=\"%s\" cx=\"", style);
    put(out, x, "\" cy=\"");
    put(out, y, "\" r=\"");
    put(out, radius, "\"/>\n");
}

void hci_svg_cross(hci_output *out, double x, double y)
{
    hci_svg_segment(out, "cross", x - 4.0, y - 4.0, x + 4.0, y + 4.0);
    hci_svg_segment(out, "cross", x - 4.0, y + 4.0, x + 4.0, y - 4.0);
}

void hci_svg_line_begin(hci_output *out, const char *style)
{
    hci_output_text(out, "<polyline class=\"%s\" points=\"", style);
}

void hci_svg_line_point(hci_output *out, double x, double y)
{
    put(out, x, ",");
    put(out, y, " ");
}

void hci_svg_line_end(hci_output *out)
{
    hci_output_text(out, "\"/>\n");
}

static void put_character(hci_output *out, char c)
{
    if (strchr("<>&\"", c))
        hci_output_text(out, "&#%d;", c);
    else
        hci_output_text(out, "%c", c);
}

/* Bytes of the character that begins here: 0 where it is not UTF-8, or one that XML cannot hold. */
static size_t character_length(const char *text)
{
    uint32_t code;
    const size_t length = hci_utf8_decode(text, &code);
    if (code == 0xFFFE || code == 0xFFFF) return 0;
    return code < 0x20 && !strchr("\t\n\r", *text) ? 0 : length;
}

void hci_svg_text(hci_output *out, const char *text)
{
    while (*text) {
        size_t length = character_length(text);
        if (length == 0) hci_output_text(out, "\xEF\xBF\xBD"); /* the replacement character */
        if (length == 0) ++text;
        for (; length > 0; --length)
            put_character(out, *text++);
    }
}

/* A blank at the start of a tspan would be lost: it is a shift instead. */
static void put_with_subscripts(hci_output *out, const char *text)
{
    bool lowered = false;
    for (; *text; ++text) {
        if (*text != '_' || !text[1]) {
            put_character(out, *text);
            continue;
        }
        hci_output_text(out, "<tspan class=\"sub\" dy=\"3\">%c</tspan><tspan dy=\"-3\"%s>", text[1],
                        text[2] == ' ' ? " dx=\"4\"" : "");
        text += text[2] == ' ' ? 2 : 1;
        lowered = true;
    }
    if (lowered) hci_output_text(out, "</tspan>");
}

void hci_svg_label(hci_output *out, const char *style, double x, double y, const char *text)
{
    hci_output_text(out, "<text class=\"%s\" x=\"", style);
    put(out, x, "\" y=\"");
    put(out, y, "\">");
    put_with_subscripts(out, text);
    hci_output_text(out, "</text>\n");
}

/* ---- widths: those of the widest of the common fonts, so that what has room here has it anywhere ---- */

#define TAG_GAP 4.0  /* between two labels in a row */
#define BOLD    1.22 /* of a heading, which is larger too */

static double character_width(const char *c)
{
    if (!hci_utf8_begins(*c)) return 0.0; /* within a character */
    if (strncmp(c, "·", strlen("·")) == 0) return 3.9;
    if (strncmp(c, "−", strlen("−")) == 0) return 10.1;
    if ((unsigned char)*c >= 0x80) return 12.0;
    if (strchr("mwMW%@", *c)) return 11.9;
    if (*c >= 'A' && *c <= 'Z') return 9.5;
    return strchr("fijlrt.,:;/()[]|!' -", *c) ? 4.9 : 7.7;
}

double hci_svg_text_width(const char *style, const char *text)
{
    double width = 0.0;
    for (; *text; ++text)
        width += character_width(text);
    return width * (strncmp(style, "head", 4) == 0 || strncmp(style, "no", 2) == 0 ? BOLD : 1.0);
}

void hci_svg_name(hci_output *out, const char *style, double x, double y, const char *text, double room)
{
    const bool is_whole = hci_svg_text_width(style, text) <= room;
    room -= is_whole ? 0.0 : hci_svg_text_width(style, "…");
    while (hci_svg_text_width(style, text) > room && *text)
        do
            ++text;
        while (!hci_utf8_begins(*text));
    hci_output_text(out, "<text class=\"%s\" x=\"", style);
    put(out, x, "\" y=\"");
    put(out, y, is_whole ? "\">" : "\">…");
    hci_svg_text(out, text);
    hci_output_text(out, "</text>\n");
}

/* Whether some stand too near to the next one of their row, where every `apart`-th is shown in so many rows.
 */
static bool tags_touch(const hci_svg_tag *tag, size_t count, size_t apart, size_t rows)
{
    for (size_t k = 0; k + apart * rows < count; k += apart) {
        const hci_svg_tag *a = &tag[k], *b = &tag[k + apart * rows];
        const double half =
            0.5 * (hci_svg_text_width(a->style, a->text) + hci_svg_text_width(b->style, b->text));
        if (b->x - a->x < half + TAG_GAP) return true;
    }
    return false;
}

void hci_svg_tags(hci_output *out, const hci_svg_tag *tag, size_t count, double y)
{
    size_t apart = 1, rows = 1;
    if (tags_touch(tag, count, 1, 1)) rows = 2;
    while (rows == 2 && apart < count && tags_touch(tag, count, apart, rows))
        ++apart;
    for (size_t k = 0; k < count; k += apart)
        hci_svg_label(out, tag[k].style, tag[k].x,
                      y + (rows == 1            ? 17.0
                           : k / apart % 2 == 0 ? 12.0
                                                : 23.0),
                      tag[k].text);
}

void hci_svg_begin(hci_output *out, const hci_svg_picture *p)
{
    hci_output_text(out,
                    "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"hci\" viewBox=\"%d %d %d %d\" "
                    "role=\"img\" aria-labelledby=\"%s-title\" aria-describedby=\"%s-desc\">\n<title "
                    "id=\"%s-title\">",
                    p->left, p->top, p->width, p->height, p->id, p->id, p->id);
    hci_svg_text(out, p->title);
    hci_output_text(out, "</title>\n<desc id=\"%s-desc\">", p->id);
    hci_svg_text(out, p->description);
    hci_output_text(out, "</desc>\n");
}

void hci_svg_end(hci_output *out)
{
    hci_output_text(out, "</svg>\n");
}

/* ---- axes ---- */

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
    tick_text(text, k * a->step, a->step, a->step * fmax(fabs(first_tick(a)), fabs(last_tick(a))));
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
    return fmax(ceil((widest + TAG_GAP) / pitch), 1.0);
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

static void draw_log_line(hci_output *out, const hci_svg_axis *a, const hci_svg_box *b, bool upwards,
                          double value)
{
    const double place = hci_svg_log_at(a, value);
    char text[HCI_SVG_NUMBER_SIZE];
    tick_text(text, value, pow(10.0, floor(log10(value) + 1e-9)), value);
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

/* ---- legends ---- */

static void draw_mark(hci_output *out, hci_svg_entry e, double x, double y)
{
    if (e.mark == HCI_SVG_LINE) hci_svg_segment(out, e.style, x, y, x + 16.0, y);
    if (e.mark == HCI_SVG_BAR) hci_svg_rectangle(out, e.style, x + 5.0, y - 5.0, x + 14.0, y + 5.0);
    if (e.mark == HCI_SVG_DOT) hci_svg_circle(out, e.style, x + 10.0, y, 4.0);
    if (e.mark == HCI_SVG_CROSS) hci_svg_cross(out, x + 10.0, y);
}

void hci_svg_legend(hci_output *out, const hci_svg_entry *entries, size_t count, double right, double y)
{
    while (count-- > 0) {
        right -= hci_svg_text_width("legend", entries[count].text);
        hci_svg_label(out, "legend", right, y, entries[count].text);
        draw_mark(out, entries[count], right - 22.0, y - 4.0);
        right -= 38.0;
    }
}

void hci_svg_head(hci_output *out, const hci_svg_box *b, const char *title, const hci_svg_entry *entries,
                  size_t count)
{
    hci_svg_label(out, "head", b->left - 34.0, b->top - 18.0, title);
    hci_svg_legend(out, entries, count, b->right, b->top - 18.0);
}
