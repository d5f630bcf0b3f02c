/* The error of each run of a diagnosis, before and after. */
#include <math.h>

#include "host/plot/plot.h"
#include "host/plot/rows.h"

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
    hci_svg_tell(out, e->file);
    hci_svg_tell_value(out, ": before ", e->rms_before_Nm, "N·m");
    hci_svg_tell_value(out, ", after ", e->rms_after_Nm, "N·m");
    hci_svg_tell_value(out, ", noise ", e->noise_floor_Nm, "N·m");
    hci_svg_hint(out);
    hci_svg_segment(out, "rail", before, y, after, y);
    hci_svg_segment(out, "spread", hci_svg_log_at(x, e->after_low_Nm), y, hci_svg_log_at(x, e->after_high_Nm),
                    y);
    hci_svg_circle(out, "before", before, y, 5.2); /* seen behind the other where nothing changes */
    hci_svg_circle(out, e->role == HCI_ROLE_FIT ? "dot" : "hollow", after, y, 4.0);
    if (noise > x->from) hci_svg_segment(out, "noise", noise, y - 7.0, noise, y + 7.0);
    hci_svg_hint_end(out);
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
                       const hci_svg_box *b, const hci_svg_axis *x)
{
    if (g->count == 0) return;
    hci_rows_name(out, b, row, true, g->heading);
    for (size_t k = 0; k < g->count; ++k) {
        hci_rows_name(out, b, row + 1 + k, false, d->run[g->place[k]].file);
        draw_run(out, &d->run[g->place[k]], hci_rows_middle(b, row + 1 + k), x);
    }
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

static void groups_of(const hci_diagnosis *d, run_group *held, run_group *fitted)
{
    held->count = hci_plot_largest(holdout_weight, d, d->runs, HCI_PLOT_MOST_RUNS, held->place);
    fitted->count = hci_plot_largest(fit_weight, d, d->runs, HCI_PLOT_MOST_RUNS, fitted->place);
}

size_t hci_plot_runs_rows(const hci_diagnosis *d)
{
    run_group held, fitted;
    groups_of(d, &held, &fitted);
    return rows_of(&held) + rows_of(&fitted);
}

void hci_plot_runs(hci_output *out, const hci_svg_box *area, const void *diagnosis)
{
    static const hci_svg_entry LEGEND[] = {{HCI_SVG_DOT, "before", "before"},
                                           {HCI_SVG_DOT, "hollow", "after, held out"},
                                           {HCI_SVG_DOT, "dot", "after, fitted"},
                                           {HCI_SVG_LINE, "spread", "95 %"},
                                           {HCI_SVG_LINE, "noise", "noise"}};
    const hci_diagnosis *d = diagnosis;
    run_group held = {.heading = "Held out"}, fitted = {.heading = "Fitted"};
    groups_of(d, &held, &fitted);
    const hci_svg_box b = hci_rows_box(area);
    const hci_range r = range_with(d, &held, range_with(d, &fitted, HCI_RANGE_EMPTY));
    const hci_svg_axis x = hci_svg_log_axis(r, b.left, b.right, 4.0);
    hci_svg_head(out, area, "Torque error, rms", LEGEND, 5);
    hci_svg_log_grid(out, &x, &b, false);
    draw_group(out, d, &held, 0, &b, &x);
    draw_group(out, d, &fitted, rows_of(&held), &b, &x);
    hci_rows_foot(out, &b, "N·m, logarithmic");
}
