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

/* A heading takes a row of its own. Returns the next free row. */
static size_t draw_runs_of(hci_output *out, const hci_diagnosis *d, const char *heading, const size_t *place,
                           size_t count, size_t row, const hci_svg_axis *x)
{
    if (count == 0) return row;
    hci_svg_label(out, "head", 4.0, hci_rows_middle(row++) + 5.0, heading);
    for (size_t k = 0; k < count; ++k)
        draw_run(out, &d->run[place[k]], hci_rows_middle(row++), x);
    return row;
}

static hci_range range_of_runs(const hci_diagnosis *d, const size_t *place, size_t count, hci_range r)
{
    for (size_t k = 0; k < count; ++k) {
        const hci_run_errors *e = &d->run[place[k]];
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
    size_t held[HCI_PLOT_MOST_RUNS], fitted[HCI_PLOT_MOST_RUNS];
    const size_t helds = hci_plot_largest(holdout_weight, d, d->runs, HCI_PLOT_MOST_RUNS, held),
                 fits = hci_plot_largest(fit_weight, d, d->runs, HCI_PLOT_MOST_RUNS, fitted),
                 rows = helds + (helds > 0) + fits + (fits > 0);
    const hci_svg_box b = hci_rows_box(NAMES_END, RIGHT, rows);
    const hci_range r = range_of_runs(d, held, helds, range_of_runs(d, fitted, fits, HCI_RANGE_EMPTY));
    const hci_svg_axis x = hci_svg_log_axis(r, b.left, b.right, 4.0);
    hci_rows_begin(out, "runs", "Error of each run before and after, with its noise", ERRORS, rows);
    hci_svg_legend(out, LEGEND, 4, RIGHT, 18.0);
    hci_svg_log_grid(out, &x, &b, false);
    draw_runs_of(out, d, "Fitted", fitted, fits, draw_runs_of(out, d, "Held out", held, helds, 0, &x), &x);
    hci_rows_foot(out, &b, "rms of the torque error in N·m, logarithmic");
    hci_svg_end(out);
}
