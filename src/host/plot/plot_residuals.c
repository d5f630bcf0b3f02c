/* The residual of a diagnosis by run and order. */
#include <math.h>

#include "host/plot/plot.h"
#include "host/plot/raster.h"

enum { NAMES = 172, MAP_DECADES = 4 };

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

static void draw_line_of(hci_output *out, const hci_plot_map *m, const hci_raster *r,
                         const hci_residual_line *x, double largest_Nm)
{
    const size_t row = place_of_run(m, x->run), column = place_of_order(m, x->order);
    const char *after = x->after_Nm > x->noise_Nm ? "plus" : "within";
    if (row == m->runs_shown || column == m->orders_shown) return;
    if (x->before_Nm >= x->after_Nm) draw_amplitude(out, r, "before", row, column, x->before_Nm / largest_Nm);
    draw_amplitude(out, r, after, row, column, x->after_Nm / largest_Nm);
}

static void draw_map_names(hci_output *out, const hci_plot_map *m, const hci_raster *r, const hci_svg_box *b)
{
    hci_svg_tag tag[HCI_PLOT_MOST_CELLS];
    for (size_t k = 0; k < m->runs_shown; ++k) {
        const double y = r->top + r->height * ((double)k + 0.5);
        hci_svg_name(out, m->runs->role[m->run[k]] == HCI_ROLE_HOLDOUT ? "head end" : "quiet end",
                     b->left - 6.0, y + 4.0, m->runs->run[m->run[k]].name, b->left - 10.0);
        hci_svg_segment(out, "grid", b->left, y + 0.5 * r->height, b->right, y + 0.5 * r->height);
    }
    for (size_t k = 0; k < m->orders_shown; ++k) {
        tag[k].x = r->left + r->width * ((double)k + 0.5);
        tag[k].style = "quiet middle";
        hci_svg_short_text(tag[k].text, m->order[k]);
    }
    hci_svg_tags(out, tag, m->orders_shown, b->bottom);
}

void hci_plot_residuals(hci_output *out, const hci_plot_map *m)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_BAR, "before", "before"},
                                           {HCI_SVG_BAR, "plus", "after"},
                                           {HCI_SVG_BAR, "within", "after, within noise"}};
    const double largest_Nm = largest_residual_Nm(m);
    const hci_raster r = {NAMES, HCI_RASTER_TOP, (HCI_RASTER_RIGHT - NAMES) / (double)m->orders_shown, 17.0};
    const hci_svg_box b = {NAMES, HCI_RASTER_TOP, HCI_RASTER_RIGHT,
                           HCI_RASTER_TOP + 17.0 * (double)m->runs_shown};
    hci_svg_begin(
        out, &(hci_svg_picture){"map", "Residual by run and electrical order, before and after",
                                "A square for each run and order: its side grows with the logarithm of the "
                                "amplitude in N·m, over four decades. The table beside it has the largest.",
                                0, 0, HCI_RASTER_CANVAS, (int)ceil(b.bottom) + 48});
    hci_svg_label(out, "head", 16.0, 22.0, "Residual: run down, electrical order across");
    hci_svg_legend(out, LEGEND, 3, HCI_RASTER_RIGHT, 46.0);
    draw_map_names(out, m, &r, &b);
    hci_raster_frame(out, &b);
    for (size_t k = 0; k < m->diagnosis->lines; ++k)
        draw_line_of(out, m, &r, &m->diagnosis->line[k], largest_Nm);
    hci_svg_label(out, "quiet middle", 0.5 * (b.left + b.right), b.bottom + 39.0, "electrical order");
    hci_svg_end(out);
}
