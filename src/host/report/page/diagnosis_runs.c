/* The section of a diagnosis about its runs: errors before and after, and slips of the index. */
#include "host/draw/html.h"
#include "host/plot/plot.h"
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

void hci_page_run_errors(hci_output *out, const hci_diagnosis *d, const char *origin)
{
    hci_html_section(out, "How well it fits, run by run");
    hci_html_paragraph(out, NULL,
                       "Runs that were held out took no part in the fit: they are the test. A model as good "
                       "as the recordings allow reaches their noise.");
    hci_html_figure(out);
    hci_plot_runs(out, d);
    hci_html_figure_tables(out);
    table_of_runs(out, d);
    hci_html_figure_end(out,
                        "Before: the declared machine. After: the corrected one. Of more than 40 runs of "
                        "one role the picture has those with the largest error after. Noise left of the "
                        "axis is not drawn.",
                        "errors.csv", origin);
    say_slips(out, d);
    hci_html_section_end(out);
}
