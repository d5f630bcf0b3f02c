/* The section of a diagnosis about what is left: by order, and by run and order. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/draw/html.h"
#include "host/plot/plot.h"
#include "host/plot/rows.h"
#include "host/report/page/diagnosis_sections.h"

enum { MOST_ORDERS = 24, MOST_LINES = 24 }; /* that a table lists */

/* ---- by order ---- */

typedef struct {
    hci_plot_order *order;
    size_t count;
    double *of_run_Nm; /* the largest amplitude after of each run */
} orders;

static int by_order(const void *a, const void *b)
{
    const hci_residual_line *x = a, *y = b;
    const int order = (x->order > y->order) - (x->order < y->order);
    return order ? order : (x->run > y->run) - (x->run < y->run);
}

/* Of each order the largest amplitude of any run; the noise is that of the run in which it is largest after.
 */
static void take_line(orders *o, const hci_residual_line *x)
{
    if (o->count == 0 || x->order > o->order[o->count - 1].order)
        o->order[o->count++] =
            (hci_plot_order){x->order, x->before_Nm, x->after_Nm, x->noise_Nm, x->run, x->run};
    hci_plot_order *p = &o->order[o->count - 1];
    if (x->before_Nm > p->before_Nm) {
        p->before_Nm = x->before_Nm;
        p->before_run = x->run;
    }
    if (x->after_Nm > p->after_Nm) {
        p->after_Nm = x->after_Nm;
        p->noise_Nm = x->noise_Nm;
        p->after_run = x->run;
    }
}

static hci_status orders_make(const hci_diagnosis *d, const hci_runs *runs, orders *o, hci_note *note)
{
    hci_residual_line *line = hci_memory_new(d->lines + 1, sizeof *line);
    o->order = hci_memory_new(d->lines + 1, sizeof *o->order);
    o->of_run_Nm = hci_memory_new(runs->count + 1, sizeof *o->of_run_Nm);
    const bool is_allocated = line && o->order && o->of_run_Nm;
    if (is_allocated) {
        if (d->lines > 0) memcpy(line, d->line, d->lines * sizeof *line);
        qsort(line, d->lines, sizeof *line, by_order);
        for (size_t k = 0; k < d->lines; ++k) {
            double *largest_Nm = &o->of_run_Nm[line[k].run];
            take_line(o, &line[k]);
            *largest_Nm = fmax(*largest_Nm, line[k].after_Nm);
        }
    }
    hci_memory_free(line);
    return is_allocated ? HCI_OK : hci_note_memory(note, NULL, "the report");
}

static double order_weight(const void *context, size_t k)
{
    const hci_plot_order *o = &((const orders *)context)->order[k];
    return fmax(o->before_Nm, o->after_Nm);
}

static void table_of_orders(hci_output *out, const orders *o, const hci_runs *runs)
{
    static const char *const COLUMN[] = {"Order",   "Before N·m", "<in run", "After N·m",
                                         "<in run", "Noise N·m",  NULL};
    size_t place[MOST_ORDERS];
    const size_t count = hci_plot_largest(order_weight, o, o->count, MOST_ORDERS, place);
    char caption[120];
    snprintf(caption, sizeof caption, "The largest %zu of %zu orders, peak amplitude", count, o->count);
    hci_html_table(out, caption, COLUMN);
    for (size_t k = 0; k < count; ++k) {
        const hci_plot_order *x = &o->order[place[k]];
        hci_html_row(out);
        hci_html_number(out, x->order);
        hci_html_number(out, x->before_Nm);
        hci_html_cell(out, runs->run[x->before_run].name);
        hci_html_number(out, x->after_Nm);
        hci_html_cell(out, runs->run[x->after_run].name);
        hci_html_number(out, x->noise_Nm);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

/* Amplitudes that are listed, of those that chance lists: it exceeds the noise once in so many times. */
#define ONCE_IN 20.0

bool hci_page_is_chance(const hci_diagnosis *d)
{
    const double amplitudes = ONCE_IN * fmax((double)d->lines, 1.0);
    const double most = sqrt(1.0 + log(amplitudes) / log(ONCE_IN));
    for (size_t k = 0; k < d->lines; ++k)
        if (d->line[k].after_Nm > most * d->line[k].noise_Nm) return false;
    return true;
}

static void heading_of_orders(const hci_diagnosis *d, const orders *o, char text[256])
{
    char before[HCI_HTML_NUMBER_SIZE], after[HCI_HTML_NUMBER_SIZE], order[HCI_HTML_NUMBER_SIZE];
    double most_before_Nm = 0.0;
    size_t most = 0;
    for (size_t k = 0; k < o->count; ++k) {
        most_before_Nm = fmax(most_before_Nm, o->order[k].before_Nm);
        if (o->order[k].after_Nm > o->order[most].after_Nm) most = k;
    }
    hci_html_number_text(before, most_before_Nm);
    hci_html_number_text(after, o->order[most].after_Nm);
    hci_html_number_text(order, o->order[most].order);
    if (hci_page_is_chance(d))
        snprintf(text, 256, "What is left is noise at each order; before, the largest had %s N·m", before);
    else
        snprintf(text, 256, "The largest order that is left, %s, has %s N·m; before, the largest had %s N·m",
                 order, after, before);
}

static void show_orders(hci_output *out, const hci_diagnosis *d, const orders *o, const hci_runs *runs,
                        const char *origin)
{
    const hci_plot_orders_data data = {o->order, o->count, "Torque error in N·m, peak", "noise", true};
    const hci_html_drawing drawing = {
        .id = "orders",
        .title = "Residual by electrical order, before and after, with the noise",
        .description = "A stem for each order on a logarithmic axis: the largest amplitude in N·m that any "
                       "run has there, before and after the correction; a dash for the noise of that run.",
        .caption =
            "Measured less modelled torque. Of each order the run with the largest amplitude; order 0 is "
            "the mean. The noise is what chance alone exceeds once in twenty times. Four decades are "
            "drawn; what is less lies below them.",
        .wide = 300,
        .narrow = 300,
        .draw = hci_plot_orders,
        .context = &data};
    char heading[256];
    heading_of_orders(d, o, heading);
    hci_html_section(out, heading);
    hci_html_drawing_begin(out, &drawing);
    table_of_orders(out, o, runs);
    hci_html_drawing_end(out, "residual_spectrum.csv", origin);
    hci_html_section_end(out);
}

/* ---- by run and order ---- */

typedef struct {
    const hci_diagnosis *diagnosis;
    const double *after_Nm; /* the largest of each run */
} run_sizes;

static double run_weight(const void *context, size_t k)
{
    return ((const run_sizes *)context)->after_Nm[k];
}

static double line_weight(const void *context, size_t k)
{
    return ((const hci_diagnosis *)context)->line[k].after_Nm;
}

static void table_of_lines(hci_output *out, const hci_diagnosis *d, const hci_runs *runs)
{
    static const char *const COLUMN[] = {"<Run", "Order", "Before N·m", "After N·m", "Noise N·m", NULL};
    size_t place[MOST_LINES];
    const size_t count = hci_plot_largest(line_weight, d, d->lines, MOST_LINES, place);
    char caption[120];
    snprintf(caption, sizeof caption, "The largest %zu of %zu amplitudes that are left", count, d->lines);
    hci_html_table(out, caption, COLUMN);
    for (size_t k = 0; k < count; ++k) {
        const hci_residual_line *x = &d->line[place[k]];
        hci_html_row(out);
        hci_html_cell(out, runs->run[x->run].name);
        hci_html_number(out, x->order);
        hci_html_number(out, x->before_Nm);
        hci_html_number(out, x->after_Nm);
        hci_html_number(out, x->noise_Nm);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void fill_map(const hci_diagnosis *d, const orders *o, const hci_runs *runs, size_t *run,
                     double *order, hci_plot_map *map)
{
    size_t place[HCI_PLOT_MOST_CELLS];
    const run_sizes sizes = {d, o->of_run_Nm};
    *map = (hci_plot_map){d, runs, run, order, 0, 0};
    map->runs_shown = hci_plot_largest(run_weight, &sizes, runs->count, HCI_PLOT_MOST_CELLS, run);
    map->orders_shown = hci_plot_largest(order_weight, o, o->count, HCI_PLOT_MOST_CELLS, place);
    for (size_t k = 0; k < map->orders_shown; ++k)
        order[k] = o->order[place[k]].order;
}

static void heading_of_map(const hci_diagnosis *d, const hci_runs *runs, char text[512])
{
    char order[HCI_HTML_NUMBER_SIZE];
    size_t most = 0;
    for (size_t k = 0; k < d->lines; ++k)
        if (d->line[k].after_Nm > d->line[most].after_Nm) most = k;
    const char *name = runs->run[d->line[most].run].name;
    hci_html_number_text(order, d->line[most].order);
    if (hci_page_is_chance(d))
        snprintf(text, 512, "In no recording is more left than noise");
    else
        snprintf(text, 512, "Most is left at order %s in %s", order,
                 strrchr(name, '/') ? strrchr(name, '/') + 1 : name);
}

static void show_map(hci_output *out, const hci_diagnosis *d, const orders *o, const hci_runs *runs,
                     const char *origin)
{
    size_t run[HCI_PLOT_MOST_CELLS];
    double order[HCI_PLOT_MOST_CELLS];
    hci_plot_map map;
    fill_map(d, o, runs, run, order, &map);
    const int rows = (int)map.runs_shown * HCI_ROWS_HEIGHT;
    const hci_html_drawing drawing = {
        .id = "map",
        .title = "Residual by run and electrical order, before and after",
        .description =
            "A square for each run and order: its side grows with the logarithm of the amplitude in "
            "N·m, over four decades. The table has the largest.",
        .caption =
            "Runs downwards, those in bold were held out; orders to the right. The side of a square grows "
            "with the logarithm of the amplitude over four decades. Of more than 24 runs or orders those "
            "with the largest amplitude are drawn.",
        .wide = 82 + rows,
        .narrow = 104 + rows,
        .draw = hci_plot_residuals,
        .context = &map};
    char heading[512];
    heading_of_map(d, runs, heading);
    hci_html_section(out, heading);
    hci_html_drawing_begin(out, &drawing);
    table_of_lines(out, d, runs);
    hci_html_drawing_end(out, "residual_spectrum.csv", origin);
    hci_html_section_end(out);
}

/* ---- the sections ---- */

hci_status hci_page_residual(hci_output *out, const hci_diagnosis *d, const hci_runs *runs,
                             const char *origin, hci_note *note)
{
    orders o = {NULL, 0, NULL};
    const hci_status status = orders_make(d, runs, &o, note);
    if (!status && o.count == 0)
        hci_html_paragraph(out, "quiet",
                           "No order of the residual stands out of the noise, before or after.");
    if (!status && o.count > 0) {
        show_orders(out, d, &o, runs, origin);
        show_map(out, d, &o, runs, origin);
    }
    hci_memory_free(o.order);
    hci_memory_free(o.of_run_Nm);
    return status;
}
