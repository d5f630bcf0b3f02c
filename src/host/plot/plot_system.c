/* U: which current component makes which torque order. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/plot/plot.h"
#include "host/plot/raster.h"

enum { LABEL = 13 }; /* pixels of a name in height */

#define ROUNDING 1e-12 /* currents below this share of the largest do not flow */

/* ---- one side of U ---- */

enum { EXACT = HCI_PLOT_MOST_CELLS, MOST_CELLS = 2 * EXACT };

/* Its items, torque orders or components, have two rows or columns of U each, but order 0 has one. With few
 * items each of these is a cell, else a cell is for one or more items. */
typedef struct {
    size_t items, cells, items_a_cell; /* 0: a cell for each row or column */
    bool has_zero;
} side;

static side side_of(size_t items, bool has_zero)
{
    side s = {items, 2 * items - has_zero, 0, has_zero};
    if (items <= EXACT) return s;
    s.items_a_cell = (items + MOST_CELLS - 1) / MOST_CELLS;
    s.cells = (items + s.items_a_cell - 1) / s.items_a_cell;
    return s;
}

static size_t cell_of_index(const side *s, size_t index)
{
    return s->items_a_cell == 0 ? index : (index + s->has_zero) / 2 / s->items_a_cell;
}

static size_t first_cell(const side *s, size_t item)
{
    if (s->items_a_cell > 0) return item / s->items_a_cell;
    return item == 0 ? 0 : 2 * item - s->has_zero;
}

/* The cell after those of the item. */
static size_t end_cell(const side *s, size_t item)
{
    return s->items_a_cell > 0 ? item / s->items_a_cell + 1 : 2 * (item + 1) - s->has_zero;
}

/* ---- U ---- */

typedef struct {
    const hci_solution *solution;
    side rows, columns;
    hci_raster raster;
    double value[MOST_CELLS][MOST_CELLS]; /* of the largest size in each cell */
    double largest;
} picture;

static bool has_mean(const hci_solution *s)
{
    return s->order_count > 0 && s->order[0].torque_Nm.order < HCI_ORDER_TOLERANCE;
}

static double largest_current_A(const hci_solution *s)
{
    double largest = 0.0;
    for (size_t k = 0; k < s->current.count; ++k)
        largest = fmax(largest, hci_amplitude(s->current.wave[k].sine, s->current.wave[k].cosine));
    return largest;
}

bool hci_plot_is_used(const hci_solution *s, hci_component component)
{
    const double least_A = ROUNDING * largest_current_A(s);
    for (size_t k = 0; k < s->current.count; ++k) {
        const hci_wave *w = &s->current.wave[k];
        if (w->sequence == component.sequence && fabs(w->order - component.order) < HCI_ORDER_TOLERANCE)
            return hci_amplitude(w->sine, w->cosine) > least_A;
    }
    return false;
}

/* Its rows took no part: weight 0, or not compared. */
static bool is_row_left_out(const hci_solution *s, size_t item)
{
    return s->order[item].verdict == HCI_ORDER_FREE || s->order[item].verdict == HCI_ORDER_PARASITIC;
}

static bool is_column_left_out(const hci_solution *s, size_t item)
{
    return !hci_plot_is_used(s, s->system.set.component[item]);
}

static bool is_unreachable(const hci_solution *s, size_t item)
{
    return s->order[item].verdict == HCI_ORDER_UNREACHABLE;
}

static void fill_values(picture *p)
{
    const hci_solved_system *u = &p->solution->system;
    for (size_t j = 0; j < 2 * u->set.count; ++j)
        for (int64_t k = u->column_start[j]; k < u->column_start[j + 1]; ++k) {
            double *cell =
                &p->value[cell_of_index(&p->rows, (size_t)u->row[k])][cell_of_index(&p->columns, j)];
            if (fabs(u->value[k]) > fabs(*cell)) *cell = u->value[k];
            p->largest = fmax(p->largest, fabs(u->value[k]));
        }
}

static void draw_values(hci_output *out, const picture *p)
{
    const bool has_sign = p->rows.items_a_cell == 0 && p->columns.items_a_cell == 0;
    for (size_t i = 0; i < p->rows.cells; ++i)
        for (size_t j = 0; j < p->columns.cells; ++j) {
            const double value = p->value[i][j];
            if (fabs(value) > HCI_PLOT_ZERO * p->largest)
                hci_raster_square(out, &p->raster, value > 0.0 || !has_sign ? "plus" : "minus", i, j,
                                  sqrt(fabs(value) / p->largest));
        }
}

/* Marks what is true of all items of a cell, so that a cell of several does not say too much. */
static bool all_of_cell(const picture *p, const side *s, size_t item,
                        bool (*is)(const hci_solution *, size_t))
{
    const size_t many = s->items_a_cell > 1 ? s->items_a_cell : 1;
    for (size_t k = item; k < item + many && k < s->items; ++k)
        if (!is(p->solution, k)) return false;
    return true;
}

static size_t step_of(const side *s)
{
    return s->items_a_cell > 1 ? s->items_a_cell : 1;
}

static bool draw_bands(hci_output *out, const picture *p, const hci_svg_box *b)
{
    const hci_raster *r = &p->raster;
    bool any = false;
    for (size_t k = 0; k < p->rows.items; k += step_of(&p->rows)) {
        if (!all_of_cell(p, &p->rows, k, is_row_left_out)) continue;
        hci_svg_rectangle(out, "band", b->left, r->top + r->height * (double)first_cell(&p->rows, k),
                          b->right, r->top + r->height * (double)end_cell(&p->rows, k));
        any = true;
    }
    for (size_t k = 0; k < p->columns.items; k += step_of(&p->columns)) {
        if (!all_of_cell(p, &p->columns, k, is_column_left_out)) continue;
        hci_svg_rectangle(out, "band", r->left + r->width * (double)first_cell(&p->columns, k), b->top,
                          r->left + r->width * (double)end_cell(&p->columns, k), b->bottom);
        any = true;
    }
    return any;
}

/* What is left out in parentheses, since the band alone is faint. */
static void name_item(char text[HCI_SVG_NUMBER_SIZE + 2], const char *name, bool is_left_out)
{
    snprintf(text, HCI_SVG_NUMBER_SIZE + 2, is_left_out ? "(%s)" : "%s", name);
}

/* Lines between the items, and the names of as many as there is room for. */
static void draw_rows(hci_output *out, const picture *p, const hci_svg_box *b)
{
    const hci_raster *r = &p->raster;
    const double pitch = r->height * (double)(p->rows.items_a_cell > 0 ? 1 : 2);
    const size_t apart = step_of(&p->rows) * (size_t)ceil(LABEL / pitch);
    for (size_t k = 0; k < p->rows.items; k += step_of(&p->rows)) {
        const double top = r->top + r->height * (double)first_cell(&p->rows, k),
                     bottom = r->top + r->height * (double)end_cell(&p->rows, k),
                     middle = 0.5 * (top + bottom);
        const bool missed = all_of_cell(p, &p->rows, k, is_unreachable);
        char order[HCI_SVG_NUMBER_SIZE], text[HCI_SVG_NUMBER_SIZE + 2];
        hci_svg_segment(out, "grid", b->left, bottom, b->right, bottom);
        if (missed) hci_svg_cross(out, b->left + 8.0, middle);
        if (k % apart != 0 && !missed) continue;
        hci_svg_short_text(order, p->solution->order[k].torque_Nm.order);
        name_item(text, order, all_of_cell(p, &p->rows, k, is_row_left_out));
        hci_svg_label(out, missed ? "no end" : "quiet end", b->left - 6.0, middle + 4.0, text);
    }
}

static void component_text(char text[HCI_SVG_NUMBER_SIZE], hci_component c)
{
    static const char *const SEQUENCE[] = {"−", "0", "+"};
    char order[HCI_SVG_NUMBER_SIZE];
    hci_svg_short_text(order, c.order);
    snprintf(text, HCI_SVG_NUMBER_SIZE, "%.40s%s", order, SEQUENCE[c.sequence + 1]);
}

static size_t longest_component(const hci_solution *s)
{
    const hci_solved_system *u = &s->system;
    size_t longest = 1;
    for (size_t k = 0; k < u->set.count; ++k) {
        char text[HCI_SVG_NUMBER_SIZE];
        component_text(text, (hci_component){u->set.component[k].order, 1});
        const size_t length = strlen(text) + (is_column_left_out(s, k) ? 2 : 0);
        longest = length > longest ? length : longest;
    }
    return longest;
}

static void draw_columns(hci_output *out, const picture *p, const hci_svg_box *b)
{
    const hci_raster *r = &p->raster;
    const hci_solved_system *u = &p->solution->system;
    const double pitch = r->width * (double)(p->columns.items_a_cell > 0 ? 1 : 2);
    const double room = 8.2 * (double)longest_component(p->solution) + 8.0;
    const size_t apart = step_of(&p->columns) * (size_t)ceil(0.5 * room / pitch);
    bool low = false;
    for (size_t k = 0; k < p->columns.items; k += step_of(&p->columns)) {
        const double left = r->left + r->width * (double)first_cell(&p->columns, k),
                     right = r->left + r->width * (double)end_cell(&p->columns, k);
        char name[HCI_SVG_NUMBER_SIZE], text[HCI_SVG_NUMBER_SIZE + 2];
        hci_svg_segment(out, "grid", right, b->top, right, b->bottom);
        if (k % apart != 0) continue;
        component_text(name, u->set.component[k]);
        name_item(text, name, all_of_cell(p, &p->columns, k, is_column_left_out));
        hci_svg_label(out, "quiet middle", 0.5 * (left + right), b->bottom + (low ? 31.0 : 16.0), text);
        low = !low && room > pitch * (double)(apart / step_of(&p->columns));
    }
}

static void draw_legend(hci_output *out, const picture *p, bool has_band)
{
    hci_svg_entry entry[4] = {{HCI_SVG_BAR, "plus", "above 0"}, {HCI_SVG_BAR, "minus", "below 0"}};
    const bool has_sign = p->rows.items_a_cell == 0 && p->columns.items_a_cell == 0;
    bool has_cross = false;
    size_t count = has_sign ? 2 : 1;
    if (!has_sign) entry[0].text = "the largest entry of the cell";
    for (size_t k = 0; k < p->rows.items; k += step_of(&p->rows))
        has_cross = has_cross || all_of_cell(p, &p->rows, k, is_unreachable);
    if (has_band) entry[count++] = (hci_svg_entry){HCI_SVG_BAR, "band", "left out"};
    if (has_cross) entry[count++] = (hci_svg_entry){HCI_SVG_CROSS, "", "reached by none"};
    hci_svg_legend(out, entry, count, HCI_RASTER_RIGHT, 46.0);
}

static void draw_feet(hci_output *out, const picture *p, const hci_svg_box *b)
{
    char text[160];
    hci_svg_label(out, "quiet", HCI_RASTER_LEFT, b->bottom + 50.0,
                  "current component: order, and its sequence as + or −");
    if (p->rows.items_a_cell == 0 && p->columns.items_a_cell == 0)
        snprintf(text, sizeof text, "each has a sine and a cosine, except torque order 0");
    else
        snprintf(text, sizeof text, "a cell holds %zu torque order%s by %zu component%s", step_of(&p->rows),
                 step_of(&p->rows) > 1 ? "s" : "", step_of(&p->columns), step_of(&p->columns) > 1 ? "s" : "");
    hci_svg_label(out, "quiet", HCI_RASTER_LEFT, b->bottom + 67.0, text);
}

void hci_plot_system(hci_output *out, const hci_solution *s)
{
    picture p = {.solution = s,
                 .rows = side_of(s->order_count, has_mean(s)),
                 .columns = side_of(s->system.set.count, false)};
    const double size =
        fmin(20.0, (HCI_RASTER_RIGHT - HCI_RASTER_LEFT) /
                       (double)(p.columns.cells > p.rows.cells ? p.columns.cells : p.rows.cells));
    const hci_svg_box b = {HCI_RASTER_LEFT, HCI_RASTER_TOP, HCI_RASTER_LEFT + size * (double)p.columns.cells,
                           HCI_RASTER_TOP + size * (double)p.rows.cells};
    p.raster = (hci_raster){b.left, b.top, size, size};
    fill_values(&p);
    hci_svg_begin(
        out, &(hci_svg_picture){"system", "The system U: which current component makes which torque order",
                                "A square for each entry of U that is not 0, its area by its size in "
                                "N·m/A. Rows are torque orders, columns current components. The tables "
                                "beside it say what each component reaches.",
                                0, 0, HCI_RASTER_CANVAS, (int)ceil(b.bottom) + 76});
    hci_svg_label(out, "head", 16.0, 22.0, "U in N·m/A: torque order down, current component across");
    const bool has_band = draw_bands(out, &p, &b);
    draw_rows(out, &p, &b);
    draw_columns(out, &p, &b);
    hci_raster_frame(out, &b);
    draw_values(out, &p);
    draw_legend(out, &p, has_band);
    draw_feet(out, &p, &b);
    hci_svg_end(out);
}
