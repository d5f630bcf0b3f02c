/* Drawing as SVG text: elements, axes and legends. Coordinates are pixels, y downwards; `style` is a class of
 * the document's style sheet, which also gives those that are used here: axis, grid, head, quiet, middle,
 * end, sub, cross. */
#ifndef HCI_SRC_HOST_DRAW_SVG_H
#define HCI_SRC_HOST_DRAW_SVG_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/base/output.h"
#include "host/numeric/range.h"

/* The style sheet: part of a page, or brought along by a picture that stands alone. */
extern const char hci_svg_style[];

/* ---- numbers as text, without the locale ---- */

enum { HCI_SVG_NUMBER_SIZE = 48 };

/* With so many decimals; |value|·10^decimals is limited to 10^15. */
void hci_svg_fixed_text(char text[HCI_SVG_NUMBER_SIZE], double value, int decimals);

/* Four significant digits, no zeros behind: 12, 0.3333. Below 10⁻⁶: 0. */
void hci_svg_short_text(char text[HCI_SVG_NUMBER_SIZE], double value);

/* The same with the unit and its prefix: 12 A, 25 mN·m. */
void hci_svg_quantity_text(char text[HCI_SVG_NUMBER_SIZE], double value, const char *unit);

/* The same in the unit of an axis, which torque, current and voltage have on a page: without a prefix, unless
 * they were mostly zeros. 0.025 N·m, 5 µN·m, 25 mW. */
void hci_svg_axis_text(char text[HCI_SVG_NUMBER_SIZE], double value, const char *unit);

/* A multiple of `step` with the decimals that the step has. largest: of the values on the axis, which share
 * one notation; a power of ten where they are small or large, and not only near to one another. */
void hci_svg_tick_text(char text[HCI_SVG_NUMBER_SIZE], double value, double step, double largest);

/* ---- elements ---- */

typedef struct {
    double left, top, right, bottom;
} hci_svg_box;

void hci_svg_segment(hci_output *out, const char *style, double x1, double y1, double x2, double y2);
void hci_svg_rectangle(hci_output *out, const char *style, double left, double top, double right,
                       double bottom);
void hci_svg_circle(hci_output *out, const char *style, double x, double y, double radius);
void hci_svg_cross(hci_output *out, double x, double y);

/* What is drawn between hci_svg_hint and hci_svg_hint_end tells a text under the pointer: first its parts.
 * A value: words, number and unit; nothing where it is not finite. */
void hci_svg_tell(hci_output *out, const char *text);
void hci_svg_tell_more(hci_output *out, const char *text);
void hci_svg_tell_value(hci_output *out, const char *words, double value, const char *unit);
void hci_svg_hint(hci_output *out);
void hci_svg_hint_end(hci_output *out);

/* Ends a hint with a strip that is seen under the pointer alone. */
void hci_svg_strip(hci_output *out, const hci_svg_box *strip);

/* A line through points: begin, points, end. */
void hci_svg_line_begin(hci_output *out, const char *style);
void hci_svg_line_point(hci_output *out, double x, double y);
void hci_svg_line_end(hci_output *out);

/* Text with what XML needs escaped; the letter after an underscore is a subscript. */
void hci_svg_label(hci_output *out, const char *style, double x, double y, const char *text);

/* The same without an element around it and without subscripts, as for <title>. What is no UTF-8, or no
 * character of XML, becomes U+FFFD. */
void hci_svg_text(hci_output *out, const char *text);

/* Pixels that a text takes at most in one of the common fonts; it is bold in the styles "head" and "no". */
double hci_svg_text_width(const char *style, const char *text);

/* Pixels that stay free between two labels in a row. */
#define HCI_SVG_GAP 4.0

/* A name without subscripts, of which as much of the end is shown as fits in `room` pixels. */
void hci_svg_name(hci_output *out, const char *style, double x, double y, const char *text, double room);

/* Labels under an axis at y, ascending from left to right by their middle x: in one row where they fit side
 * by side, else in two, else only every second, third … of them. */
typedef struct {
    double x;
    const char *style;
    char text[HCI_SVG_NUMBER_SIZE];
} hci_svg_tag;

void hci_svg_tags(hci_output *out, const hci_svg_tag *tag, size_t count, double y);

/* ---- pictures ---- */

/* id: letters, for the attributes that point to title and description; once in a document. */
typedef struct {
    const char *id, *title, *description;
    int left, top, width, height; /* what is seen of the canvas */
} hci_svg_picture;

void hci_svg_begin(hci_output *out, const hci_svg_picture *picture);
void hci_svg_end(hci_output *out);

/* ---- axes ---- */

/* Values low … high lie at the coordinates from … to, with a grid line at every multiple of step. */
typedef struct {
    double low, high, from, to, step;
} hci_svg_axis;

/* The coordinate of a value; what lies outside the axis, or is no number, is at one of its ends. */
double hci_svg_at(const hci_svg_axis *a, double value);

/* The smallest of 1, 2, 5 times a power of ten that is not below `least` > 0. */
double hci_svg_nice_step(double least);

/* An axis with some room around the range, with zero where that is near; any range will do. */
hci_svg_axis hci_svg_axis_over(hci_range r, double from, double to, double most_ticks);

/* 0 to 360·turns degrees over the width of the box. */
hci_svg_axis hci_svg_axis_of_angle(double turns, const hci_svg_box *b);

/* Two axes that fill the box with the same length of a unit on both. */
void hci_svg_equal_axes(hci_range x, hci_range y, const hci_svg_box *b, hci_svg_axis *x_axis,
                        hci_svg_axis *y_axis);

/* Pixels at the left of a box in which the numbers of an upright axis stand. */
enum { HCI_SVG_MARGIN = 46 };

/* The box, narrower at its left where they need more. */
hci_svg_box hci_svg_box_beside(hci_svg_box box, const hci_svg_axis *upright);

/* Grid lines and numbers of an axis that runs upwards, or to the right. */
void hci_svg_grid(hci_output *out, const hci_svg_axis *a, const hci_svg_box *b, bool upwards);

/* Logarithmic, from a 1, 2 or 5 times a power of ten to another, at least one decade. What is too small, or
 * not above 0, lies at its lower end. */
hci_svg_axis hci_svg_log_axis(hci_range r, double from, double to, double most_decades);
hci_svg_box hci_svg_log_box_beside(hci_svg_box box, const hci_svg_axis *upright);
double hci_svg_log_at(const hci_svg_axis *a, double value);
void hci_svg_log_grid(hci_output *out, const hci_svg_axis *a, const hci_svg_box *b, bool upwards);

/* ---- legends ---- */

typedef enum { HCI_SVG_LINE, HCI_SVG_BAR, HCI_SVG_DOT, HCI_SVG_CROSS } hci_svg_mark;

typedef struct {
    hci_svg_mark mark;
    const char *style, *text;
} hci_svg_entry;

/* In one line that ends at `right`. */
void hci_svg_legend(hci_output *out, const hci_svg_entry *entries, size_t count, double right, double y);

/* Title and legend over a box: in one row, or where it is narrow the legend in rows of its own below. */
void hci_svg_head(hci_output *out, const hci_svg_box *b, const char *title, const hci_svg_entry *entries,
                  size_t count);

#endif
