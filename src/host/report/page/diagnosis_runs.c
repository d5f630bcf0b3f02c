/* The section of a diagnosis about its runs: errors before and after, and slips of the index. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/draw/html.h"
#include "host/plot/plot.h"
#include "host/plot/rows.h"
#include "host/report/page/diagnosis_sections.h"

static void table_of_runs(hci_output *out, const hci_diagnosis *d)
{
    static const char *const COLUMN[] = {"<Run",      "<Role",     "Mean N·m", "Before N·m", "After N·m",
                                         "Noise N·m", "95 % from", "to",       NULL};
    hci_html_table(out, "rms of measured less modelled torque, runs held out first", COLUMN);
    for (size_t k = 0; k < 2 * d->runs; ++k) {
        const hci_run_errors *e = &d->run[k % d->runs];
        if (e->role != (k < d->runs ? HCI_ROLE_HOLDOUT : HCI_ROLE_FIT)) continue;
        const double value[] = {e->mean_torque_Nm, e->rms_before_Nm, e->rms_after_Nm,
                                e->noise_floor_Nm, e->after_low_Nm,  e->after_high_Nm};
        hci_html_row(out);
        hci_html_cell(out, e->file);
        hci_html_cell(out, e->role == HCI_ROLE_FIT ? "fit" : "holdout");
        for (size_t j = 0; j < sizeof value / sizeof *value; ++j)
            hci_html_number(out, value[j]);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void say_slips(hci_output *out, const hci_diagnosis *d)
{
    static const char *const COLUMN[] = {"<Run", "Ahead, mechanical °", NULL};
    bool any = false;
    for (size_t k = 0; k < d->runs; ++k)
        any = any || d->run[k].slip_rad != 0.0;
    if (!any) return;
    hci_html_paragraph(out, NULL,
                       "The index of the encoder slipped: the mechanical angle of these runs is ahead of "
                       "that of the others. It was turned back for the diagnosis; the files are as they "
                       "were.");
    hci_html_table(out, "Index slips", COLUMN);
    for (size_t k = 0; k < d->runs; ++k) {
        if (d->run[k].slip_rad == 0.0) continue;
        hci_html_row(out);
        hci_html_cell(out, d->run[k].file);
        hci_html_number(out, d->run[k].slip_rad * 180.0 / HCI_PI);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void heading_of(const hci_diagnosis *d, char text[256])
{
    const bool held = isfinite(d->holdout_after_Nm);
    char before[HCI_HTML_NUMBER_SIZE], after[HCI_HTML_NUMBER_SIZE];
    hci_html_number_text(before, held ? d->holdout_before_Nm : d->rms_before_Nm);
    hci_html_number_text(after, held ? d->holdout_after_Nm : d->rms_after_Nm);
    const char *where = held ? "On the runs that were held out" : "On the runs that were fitted";
    if (strcmp(before, after) == 0)
        snprintf(text, 256, "%s the error stays %s N·m", where, after);
    else
        snprintf(text, 256, "%s the error goes from %s to %s N·m", where, before, after);
}

void hci_page_run_errors(hci_output *out, const hci_diagnosis *d, const char *origin)
{
    const int rows = (int)hci_plot_runs_rows(d) * HCI_ROWS_HEIGHT;
    const hci_html_drawing drawing = {
        .id = "runs",
        .title = "Error of each run before and after, with its noise",
        .description = "One row for each run, those that were held out first: rms of measured less modelled "
                       "torque in N·m on a logarithmic axis, before and after the correction, and the noise "
                       "of the recording. The bar behind a mark is its 95 % interval.",
        .caption =
            "Measured less modelled torque: before of the declared machine, after of the corrected one. "
            "Runs held out took no part in the fit: they are the test. Of more than 40 runs of one role "
            "those with the largest error are drawn; noise left of the axis is not.",
        .wide = 82 + rows,
        .narrow = 140 + rows,
        .legend_rows = 3,
        .draw = hci_plot_runs,
        .context = d};
    char heading[256];
    heading_of(d, heading);
    hci_html_section(out, heading);
    hci_html_drawing_begin(out, &drawing);
    table_of_runs(out, d);
    hci_html_drawing_end(out, "errors.csv", origin);
    say_slips(out, d);
    hci_html_section_end(out);
}
