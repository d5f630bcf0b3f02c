/* The files of `simulate --table`: speeds.csv, speeds.svg, summary.json and report.html. */
#include <math.h>

#include "hci/host/base/unit.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/write.h"
#include "host/plot/plot.h"
#include "host/report/page/page.h"
#include "host/report/summary.h"

/* An empty cell where there is no number. */
static void put(hci_output *out, double value, char end)
{
    if (isfinite(value))
        hci_output_number(out, value, end);
    else
        hci_output_text(out, "%c", end);
}

static void write_row(hci_output *out, const hci_speed_row *row, hci_remedy remedy)
{
    const hci_speed_result *x = &row->remedy[remedy];
    hci_output_number(out, hci_rpm(row->speed_rad_per_s), ',');
    hci_output_text(out, "%s,", hci_remedy_name(remedy));
    put(out, x->T_ripple_percent, ',');
    put(out, x->F_ripple_percent, ',');
    put(out, x->worst_T_ripple_percent, ',');
    hci_output_number(out, x->mean_Nm, ',');
    hci_output_number(out, x->peak_A, ',');
    hci_output_number(out, x->line_V, ',');
    hci_output_number(out, row->needed_V, ',');
    hci_output_number(out, x->limited_share, ',');
    hci_output_number(out, x->ripple_Nm, '\n');
}

static hci_status write_csv(hci_output *out, const hci_speeds *s, hci_note *note)
{
    const hci_status status = hci_output_file(out, "speeds.csv", note);
    if (status) return status;
    hci_output_text(out,
                    "speed_rpm,remedy,T_ripple_percent,F_ripple_percent,worst_T_ripple_percent,torque_Nm,"
                    "peak_phase_A,peak_line_V,needed_dc_link_V,limited_share,ripple_Nm\n");
    for (size_t k = 0; k < s->count; ++k)
        for (int r = 0; r < HCI_REMEDIES; ++r)
            write_row(out, &s->row[k], (hci_remedy)r);
    return HCI_OK;
}

static hci_status write_all(hci_output *out, const hci_speeds *s, const hci_report_sources *sources,
                            hci_note *note)
{
    hci_status status = write_csv(out, s, note);
    if (!status) status = hci_output_file(out, "speeds.svg", note);
    if (!status) hci_plot_speeds(out, s);
    if (!status && !sources) status = hci_output_without(out, "report.html", note);
    if (!status && sources) status = hci_output_file(out, "report.html", note);
    if (!status && sources) hci_page_speeds(out, s, sources);
    return status ? status : hci_summary_write(out, hci_speeds_json(s), note);
}

hci_status hci_speeds_write(const hci_speeds *speeds, const hci_report_sources *sources, const char *folder,
                            hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    status = write_all(out, speeds, sources, note);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}
