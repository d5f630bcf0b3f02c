/* The error of each run of a diagnosis, before and after. */
#include <math.h>

#include "host/plot/plot.h"
#include "host/plot/rows.h"

/* x of where names end, and of the right edge. */
static const double NAMES_END = 176.0, RIGHT = 524.0;

static double holdout_weight(const void *context, size_t k)
{
    const hci_run_errors *e = &((const hci_diagnosis *)context)->run[k];
    return e->role == HCI_ROLE_HOLDOUT ? e->rms_after_Nm : 0.0;
}

static double fit_weight(const void *context, size_t k)
{
    const hci_run_errors *e = &((const hci_diagnosis *)context)->run[k];
    return e->role == HCI_ROLE_FIT ? e->rms_after_Nm : 0.0;
}

static void draw_run(hci_output *out, const hci_run_errors *e, double y, const hci_svg_axis *x)
{
    const double before = hci_svg_log_at(x, e->rms_before_Nm), after = hci_svg_log_at(x, e->rms_after_Nm),
                 noise = hci_svg_log_at(x, e->noise_floor_Nm);
    hci_svg_name(out, "quiet", 4.0, y + 4.0, e->file, NAMES_END - 8.0);
    hci_svg_segment(out, "rail", before, y, after, y);
    hci_svg_segment(out, "spread", hci_svg_log_at(x, e->after_low_Nm), y, hci_svg_log_at(x, e->after_high_Nm),
                    y);
    hci_svg_circle(out, "before", before, y, 5.2); /* seen behind the other where nothing changes */
    hci_svg_circle(out, e->role == HCI_ROLE_FIT ? "dot" : "hollow", after, y, 4.0);
    if (noise > x->from) hci_svg_segment(out, "noise", noise, y - 7.0, noise, y + 7.0);
}

/* The runs of one role that are shown, in rows under a heading, which takes a row of its own. */
typedef struct {
    const char *heading;
    size_t place[HCI_PLOT_MOST_RUNS], count;
} run_group;

static size_t rows_of(const run_group *g)
{
    return g->count > 0 ? g->count + 1 : 0;
}

/* row: of the heading. */
static void draw_group(hci_output *out, const hci_diagnosis *d, const run_group *g, size_t row,
                       const hci_svg_axis *x)
{
    if (g->count == 0) return;
    hci_svg_label(out, "head", 4.0, hci_rows_middle(row) + 5.0, g->heading);
    for (size_t k = 0; k < g->count; ++k)
        draw_run(out, &d->run[g->place[k]], hci_rows_middle(row + 1 + k), x);
}

static hci_range range_with(const hci_diagnosis *d, const run_group *g, hci_range r)
{
    for (size_t k = 0; k < g->count; ++k) {
        const hci_run_errors *e = &d->run[g->place[k]];
        hci_range_include(&r, e->rms_before_Nm);
        hci_range_include(&r, e->rms_after_Nm);
        if (e->noise_floor_Nm > 0.0) hci_range_include(&r, e->noise_floor_Nm);
    }
    return r;
}

static const char ERRORS[] =
    "One row for each run, those that were held out first: rms of measured less modelled torque in N·m on a "
    "logarithmic axis, before and after the correction, and the noise of the recording. The bar behind a "
    "mark "
    "is its 95 % interval. The table beside it has the numbers.";

void hci_plot_runs(hci_output *out, const hci_diagnosis *d)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_DOT, "before", "before"},
                                           {HCI_SVG_DOT, "hollow", "after (held out)"},
                                           {HCI_SVG_DOT, "dot", "after (fitted)"},
                                           {HCI_SVG_LINE, "noise", "noise"}};
    run_group held = {.heading = "Held out"}, fitted = {.heading = "Fitted"};
    held.count = hci_plot_largest(holdout_weight, d, d->runs, HCI_PLOT_MOST_RUNS, held.place);
    fitted.count = hci_plot_largest(fit_weight, d, d->runs, HCI_PLOT_MOST_RUNS, fitted.place);
    const size_t rows = rows_of(&held) + rows_of(&fitted);
    const hci_svg_box b = hci_rows_box(NAMES_END, RIGHT, rows);
    const hci_range r = range_with(d, &held, range_with(d, &fitted, HCI_RANGE_EMPTY));
    const hci_svg_axis x = hci_svg_log_axis(r, b.left, b.right, 4.0);
    hci_rows_begin(out, "runs", "Error of each run before and after, with its noise", ERRORS, rows);
    hci_svg_legend(out, LEGEND, 4, RIGHT, 18.0);
    hci_svg_log_grid(out, &x, &b, false);
    draw_group(out, d, &held, 0, &x);
    draw_group(out, d, &fitted, rows_of(&held), &x);
    hci_rows_foot(out, &b, "rms of the torque error in N·m, logarithmic");
    hci_svg_end(out);
}
