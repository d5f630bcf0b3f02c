/* The residual of a diagnosis by run and order. */
#include <math.h>

#include "host/plot/plot.h"
#include "host/plot/raster.h"
#include "host/plot/rows.h"

enum { MAP_DECADES = 4 };

static size_t place_of_order(const hci_plot_map *m, double order)
{
    size_t k = 0;
    while (k < m->orders_shown && fabs(m->order[k] - order) >= HCI_ORDER_TOLERANCE)
        ++k;
    return k;
}

static size_t place_of_run(const hci_plot_map *m, size_t run)
{
    size_t k = 0;
    while (k < m->runs_shown && m->run[k] != run)
        ++k;
    return k;
}

static double largest_residual_Nm(const hci_plot_map *m)
{
    double largest = 0.0;
    for (size_t k = 0; k < m->diagnosis->lines; ++k)
        largest = fmax(largest, fmax(m->diagnosis->line[k].before_Nm, m->diagnosis->line[k].after_Nm));
    return largest;
}

/* By the decades above the lowest one that is told apart. */
static void draw_amplitude(hci_output *out, const hci_raster *r, const char *style, size_t row, size_t column,
                           double share)
{
    if (share > 0.0)
        hci_raster_square(out, r, style, row, column, fmax(1.0 + log10(share) / MAP_DECADES, 0.0));
}

static void tell_line(hci_output *out, const hci_plot_map *m, const hci_residual_line *x)
{
    char order[HCI_SVG_NUMBER_SIZE];
    hci_svg_short_text(order, x->order);
    hci_svg_tell(out, m->runs->run[x->run].name);
    hci_svg_tell_more(out, ", order ");
    hci_svg_tell_more(out, order);
    hci_svg_tell_value(out, ": before ", x->before_Nm, "N·m");
    hci_svg_tell_value(out, ", after ", x->after_Nm, "N·m");
    hci_svg_tell_value(out, ", noise ", x->noise_Nm, "N·m");
    hci_svg_hint(out);
}

static void draw_line_of(hci_output *out, const hci_plot_map *m, const hci_raster *r,
                         const hci_residual_line *x, double largest_Nm)
{
    const size_t row = place_of_run(m, x->run), column = place_of_order(m, x->order);
    const char *after = x->after_Nm > x->noise_Nm ? "plus" : "within";
    if (row == m->runs_shown || column == m->orders_shown) return;
    tell_line(out, m, x);
    if (x->before_Nm >= x->after_Nm) draw_amplitude(out, r, "before", row, column, x->before_Nm / largest_Nm);
    draw_amplitude(out, r, after, row, column, x->after_Nm / largest_Nm);
    hci_svg_hint_end(out);
}

static void draw_map_names(hci_output *out, const hci_plot_map *m, const hci_raster *r, const hci_svg_box *b)
{
    hci_svg_tag tag[HCI_PLOT_MOST_CELLS];
    for (size_t k = 0; k < m->runs_shown; ++k) {
        const double y = r->top + r->height * ((double)k + 0.5);
        hci_rows_name(out, b, k, m->runs->role[m->run[k]] == HCI_ROLE_HOLDOUT, m->runs->run[m->run[k]].name);
        hci_svg_segment(out, "grid", b->left, y + 0.5 * r->height, b->right, y + 0.5 * r->height);
    }
    for (size_t k = 0; k < m->orders_shown; ++k) {
        tag[k].x = r->left + r->width * ((double)k + 0.5);
        tag[k].style = "quiet middle";
        hci_svg_short_text(tag[k].text, m->order[k]);
    }
    hci_svg_tags(out, tag, m->orders_shown, b->bottom);
}

void hci_plot_residuals(hci_output *out, const hci_svg_box *area, const void *map)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_BAR, "before", "before"},
                                           {HCI_SVG_BAR, "plus", "after"},
                                           {HCI_SVG_BAR, "within", "after, within noise"}};
    const hci_plot_map *m = map;
    const double largest_Nm = largest_residual_Nm(m);
    const hci_svg_box b = hci_rows_box(area);
    const hci_raster r = {b.left, b.top, (b.right - b.left) / (double)m->orders_shown, HCI_ROWS_HEIGHT};
    hci_svg_head(out, area, "What is left, by run and order", LEGEND, 3);
    draw_map_names(out, m, &r, &b);
    hci_raster_frame(out, &b);
    for (size_t k = 0; k < m->diagnosis->lines; ++k)
        draw_line_of(out, m, &r, &m->diagnosis->line[k], largest_Nm);
    hci_rows_foot(out, &b, "electrical order");
}
