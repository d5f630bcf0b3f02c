/* The only file that writes SVG: elements, texts, pictures, legends. */
#include "host/draw/svg.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/base/utf8.h"

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
        hci_output_text(out, "%s<tspan class=\"sub\" dy=\"3\">%c</tspan><tspan dy=\"-3\"%s>",
                        lowered ? "</tspan>" : "", text[1], text[2] == ' ' ? " dx=\"4\"" : "");
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

/* ---- what is told under the pointer ---- */

void hci_svg_tell(hci_output *out, const char *text)
{
    hci_output_text(out, "<g><title>");
    hci_svg_text(out, text);
}

void hci_svg_tell_more(hci_output *out, const char *text)
{
    hci_svg_text(out, text);
}

/* A prefix would be odd before °, %, ×, rpm and ms, and where there is no unit. */
void hci_svg_tell_value(hci_output *out, const char *words, double value, const char *unit)
{
    char text[HCI_SVG_NUMBER_SIZE];
    const bool is_plain = (unsigned char)*unit >= 0x80 || strchr("%rm", *unit);
    if (!isfinite(value)) return;
    if (is_plain) {
        hci_svg_short_text(text, value);
        snprintf(text + strlen(text), sizeof text - strlen(text), "%s%s",
                 !*unit || strcmp(unit, "°") == 0 ? "" : " ", unit);
    } else {
        hci_svg_axis_text(text, value, unit);
    }
    hci_svg_text(out, words);
    hci_svg_text(out, text);
}

void hci_svg_hint(hci_output *out)
{
    hci_output_text(out, "</title>\n");
}

void hci_svg_hint_end(hci_output *out)
{
    hci_output_text(out, "</g>\n");
}

void hci_svg_strip(hci_output *out, const hci_svg_box *strip)
{
    hci_svg_hint(out);
    hci_svg_rectangle(out, "hit", strip->left, strip->top, strip->right, strip->bottom);
    hci_svg_hint_end(out);
}

/* ---- names and labels ---- */

void hci_svg_name(hci_output *out, const char *style, double x, double y, const char *text, double room)
{
    const bool is_whole = hci_svg_text_width(style, text) <= room;
    room -= is_whole ? 0.0 : hci_svg_text_width(style, "…");
    for (const char *folder; hci_svg_text_width(style, text) > room && (folder = strchr(text, '/')) != NULL;)
        text = folder + 1;
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
        if (b->x - a->x < half + HCI_SVG_GAP) return true;
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

#define ROW 18.0 /* pixels from row to row over a box */

static double width_of_entry(const hci_svg_entry *e)
{
    return 38.0 + hci_svg_text_width("legend", e->text);
}

/* How many of the entries fit in a row, one at least. */
static size_t fit_in_row(const hci_svg_entry *entries, size_t count, double width)
{
    size_t n = 0;
    for (double used = 0.0; n < count; ++n) {
        used += width_of_entry(&entries[n]);
        if (n > 0 && used - 16.0 > width) break;
    }
    return n;
}

static void draw_legend_row(hci_output *out, const hci_svg_entry *entries, size_t count, double left,
                            double y)
{
    for (size_t k = 0; k < count; ++k) {
        draw_mark(out, entries[k], left, y - 4.0);
        hci_svg_label(out, "legend", left + 22.0, y, entries[k].text);
        left += width_of_entry(&entries[k]);
    }
}

void hci_svg_head(hci_output *out, const hci_svg_box *b, const char *title, const hci_svg_entry *entries,
                  size_t count)
{
    const double left = b->left - 34.0, width = b->right - left;
    double used = hci_svg_text_width("head", title), y = b->top - ROW;
    size_t rows = 0;
    for (size_t k = 0; k < count; ++k)
        used += width_of_entry(&entries[k]);
    if (used <= width) {
        hci_svg_label(out, "head", left, y, title);
        hci_svg_legend(out, entries, count, b->right, y);
        return;
    }
    for (size_t k = 0; k < count; k += fit_in_row(entries + k, count - k, width))
        ++rows;
    y -= ROW * (double)rows - 4.0;
    hci_svg_label(out, "head", left, y, title);
    for (size_t k = 0, n; k < count; k += n) {
        n = fit_in_row(entries + k, count - k, width);
        draw_legend_row(out, entries + k, n, left, y += ROW);
    }
}
