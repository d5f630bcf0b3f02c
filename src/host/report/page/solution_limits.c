/* The section of a solution about its limits: how near the currents come to each. */
#include <math.h>
#include <stdio.h>

#include "host/plot/rows.h"
#include "host/report/page/solution_sections.h"

static const char *unit_of(const hci_limit *l)
{
    static const char *const UNIT[] = {"A", "A", "V", "A²"};
    return UNIT[l->kind];
}

static void name_of(const hci_limit *l, char text[HCI_HTML_NUMBER_SIZE])
{
    static const char *const NAME[] = {"phase current", "rms current", "", "copper"};
    static const char *const VOLTAGE[] = {"line voltage", "2 × phase voltage", "√3 × voltage vector"};
    static const char *const PHASE[] = {"", " of a", " of b", " of c"};
    snprintf(text, HCI_HTML_NUMBER_SIZE, "%s%s",
             l->kind == HCI_LIMIT_VOLTAGE ? VOLTAGE[l->modulation] : NAME[l->kind], PHASE[l->phase + 1]);
}

/* The angles at which a limit is touched, in degrees. */
static void say_touches(const hci_limit *l, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (size_t k = 0; k < l->touch_count && k < HCI_MOST_TOUCHES && used + 24 < size; ++k)
        used += (size_t)snprintf(text + used, size - used, "%s%s %.1f°", k > 0 ? ", " : "",
                                 hci_limit_place_name(l, l->touch[k].phase),
                                 l->touch[k].theta_rad * 180.0 / HCI_PI);
}

static void row_of_limit(hci_output *out, const hci_limit *l)
{
    char touches[640], name[HCI_HTML_NUMBER_SIZE], named[2 * HCI_HTML_NUMBER_SIZE];
    say_touches(l, touches, sizeof touches);
    name_of(l, name);
    snprintf(named, sizeof named, "%s, %s", name, unit_of(l));
    hci_html_row(out);
    hci_html_cell(out, named);
    hci_html_number(out, l->limit);
    hci_html_number(out, l->value);
    hci_html_number(out, l->gain);
    hci_html_cell_words(out, touches);
    hci_html_row_end(out);
}

static void table_of_limits(const hci_solution_page *p)
{
    static const char *const COLUMN[] = {"<Limit",          "Allowed",     "Largest",
                                         "Gain for 1 more", "<Touched at", NULL};
    hci_html_table(p->out, "Limits, and what 1 more of each would give", COLUMN);
    for (size_t k = 0; k < p->solution->limit_count; ++k)
        row_of_limit(p->out, &p->solution->limit[k]);
    hci_html_table_end(p->out);
}

/* ---- the picture: a bar for each limit, in per cent of what is allowed ---- */

static void draw_limit(hci_output *out, const hci_limit *l, const hci_svg_axis *x, double y)
{
    char name[HCI_HTML_NUMBER_SIZE];
    const double share = l->limit > 0.0 ? 100.0 * l->value / l->limit : 0.0;
    name_of(l, name);
    hci_svg_tell(out, name);
    hci_svg_tell_value(out, ": ", l->value, unit_of(l));
    hci_svg_tell_value(out, " of ", l->limit, unit_of(l));
    hci_svg_hint(out);
    hci_svg_rectangle(out, share > 100.0001 ? "over" : "after", x->from, y - 7.0, hci_svg_at(x, share),
                      y + 7.0);
    hci_svg_hint_end(out);
    hci_svg_label(out, l->binds ? "head end" : "quiet end", x->from - 8.0, y + 4.0, name);
}

static void draw_limits(hci_output *out, const hci_svg_box *area, const void *context)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_BAR, "after", "used"},
                                           {HCI_SVG_LINE, "limit", "allowed"}};
    const hci_solution *s = context;
    hci_svg_box b = *area;
    hci_range r = {0.0, 110.0};
    b.left += 86.0;
    for (size_t k = 0; k < s->limit_count; ++k)
        if (s->limit[k].limit > 0.0) hci_range_include(&r, 105.0 * s->limit[k].value / s->limit[k].limit);
    hci_svg_axis x = {0.0, r.high, b.left, b.right, 0.0};
    x.step = hci_svg_nice_step(r.high / 6.0);
    hci_svg_head(out, &b, "Share of what is allowed", LEGEND, 2);
    hci_svg_grid(out, &x, &b, false);
    for (size_t k = 0; k < s->limit_count; ++k)
        draw_limit(out, &s->limit[k], &x, b.top + HCI_ROWS_HEIGHT * ((double)k + 0.7));
    hci_svg_segment(out, "limit", hci_svg_at(&x, 100.0), b.top, hci_svg_at(&x, 100.0), b.bottom);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 35.0, "%");
}

/* ---- the section ---- */

static void heading_of(const hci_solution *s, char text[256])
{
    static const char *const COST[] = {
        "The limits are kept, and cost nothing", "The limits cost copper: the torque is as wanted",
        ("The limits cost smoothness: the mean torque is as wanted, its ripple the smallest of these "
         "components by"),
        "The limits cost torque: the mean is the nearest within them that was found with these components",
        "No current keeps the limits: this one exceeds all of them by the same share"};
    static const char *const BY[] = {" the sum of squares", " the worst order", " peak to peak", " rms"};
    if (s->within_limits || s->limit_cost == HCI_COST_LIMITS)
        snprintf(text, 256, "%s%s", COST[s->limit_cost],
                 s->limit_cost == HCI_COST_RIPPLE ? BY[s->minimised] : "");
    else
        snprintf(text, 256, "A limit is not kept by these currents");
}

void hci_page_limits(const hci_solution_page *p)
{
    static const char *const GAIN[] = {"", " Gain: A² less.", " Gain: N·m less ripple.", " Gain: N·m nearer.",
                                       " Gain: share less."};
    const hci_solution *s = p->solution;
    const int rows = (int)s->limit_count * HCI_ROWS_HEIGHT + 10;
    char heading[256], caption[256];
    if (s->limit_count == 0) return;
    heading_of(s, heading);
    snprintf(caption, sizeof caption,
             "The largest of each quantity over the turn, in per cent of its limit. Limits in bold bind: a "
             "wider one would give something.%s",
             GAIN[s->limit_cost]);
    const hci_html_drawing drawing = {
        .id = "limits",
        .title = "How near the currents come to their limits",
        .description = "A bar for each limit in per cent of what is allowed. The table has the numbers.",
        .caption = caption,
        .wide = 82 + rows,
        .narrow = 104 + rows,
        .draw = draw_limits,
        .context = s};
    hci_html_section(p->out, heading);
    hci_html_drawing_begin(p->out, &drawing);
    table_of_limits(p);
    hci_html_drawing_end(p->out, "summary.json", p->origin);
    hci_html_section_end(p->out);
}
