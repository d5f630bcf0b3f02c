/* The files of `sweep`: a table and a picture of its kind, summary.json and report.html. */

#include "hci/host/base/unit.h"
#include "hci/host/report/summary.h"
#include "hci/host/report/sweep/write.h"
#include "host/plot/sweep/plot_sweep.h"
#include "host/report/summary.h"
#include "host/report/sweep/page_sweep.h"
#include "host/sweep/columns.h"

static const char *const TABLE[] = {"trade_off.csv", "envelope.csv", "map.csv"};
static const char *const PICTURE[] = {"trade_off.svg", "envelope.svg", "map.svg"};

/* ---- tables ---- */

/* Figures with the copper loss in W. */
static void put_names(hci_output *out, const char *prefix)
{
    hci_grid_put_names(out, prefix);
    hci_output_text(out, "%scopper_W,", prefix);
}

static void put_figures(hci_output *out, const hci_grid *s, const hci_grid_figures *f)
{
    hci_grid_put_figures(out, f);
    hci_grid_put(out, hci_grid_copper_W(&s->request, f), ',');
}

static void put_end(hci_output *out, const hci_grid_row *row)
{
    hci_output_text(out, "%s,", hci_grid_verdict_name(row->verdict));
    hci_grid_put_text(out, row->reason, '\n');
}

static void write_trade_off(hci_output *out, const hci_grid *s)
{
    hci_output_text(out, "limited,limit_phase_A,limit_loss_to_plain,");
    put_names(out, "");
    hci_output_text(out, "verdict,reason\n");
    for (size_t k = 0; k < s->plan.count; ++k) {
        const hci_grid_row *row = &s->row[k];
        hci_output_text(out, "%s,", k < s->plan.by_current ? "current" : "copper");
        hci_grid_put(out, row->point.limit_current_A, ',');
        hci_grid_put(out, row->point.limit_copper, ',');
        put_figures(out, s, &row->best);
        put_end(out, row);
    }
}

static void write_envelope(hci_output *out, const hci_grid *s)
{
    hci_output_text(out, "speed_rpm,dc_link_V,");
    put_names(out, "");
    put_names(out, "most_");
    put_names(out, "sine_");
    hci_output_text(out, "verdict,reason\n");
    for (size_t k = 0; k < s->plan.count; ++k) {
        const hci_grid_row *row = &s->row[k];
        hci_grid_put(out, hci_rpm(row->point.speed_rad_per_s), ',');
        hci_grid_put(out, row->point.link_V, ',');
        put_figures(out, s, &row->best);
        put_figures(out, s, &row->most);
        put_figures(out, s, &row->sine);
        put_end(out, row);
    }
}

static void write_map(hci_output *out, const hci_grid *s)
{
    hci_output_text(out, "torque_Nm,speed_rpm,dc_link_V,");
    put_names(out, "");
    hci_output_text(out, "verdict,reason\n");
    for (size_t k = 0; k < s->plan.count; ++k) {
        const hci_grid_row *row = &s->row[k];
        hci_grid_put(out, row->point.torque_Nm, ',');
        hci_grid_put(out, hci_rpm(row->point.speed_rad_per_s), ',');
        hci_grid_put(out, row->point.link_V, ',');
        put_figures(out, s, &row->best);
        put_end(out, row);
    }
}

/* ---- files ---- */

static hci_status write_table(hci_output *out, const hci_grid *s, hci_note *note)
{
    const hci_status status = hci_output_file(out, TABLE[s->request.kind], note);
    if (status) return status;
    if (s->request.kind == HCI_GRID_TRADE_OFF) write_trade_off(out, s);
    if (s->request.kind == HCI_GRID_ENVELOPE) write_envelope(out, s);
    if (s->request.kind == HCI_GRID_MAP) write_map(out, s);
    return HCI_OK;
}

static hci_status write_all(hci_output *out, const hci_grid *s, const hci_report_sources *sources,
                            hci_note *note)
{
    hci_status status = write_table(out, s, note);
    if (!status) status = hci_output_file(out, PICTURE[s->request.kind], note);
    if (!status) hci_plot_sweep(out, s);
    if (!status && !sources) status = hci_output_without(out, "report.html", note);
    if (!status && sources) status = hci_output_file(out, "report.html", note);
    if (!status && sources) hci_page_sweep(out, s, sources);
    return status ? status : hci_summary_write(out, hci_grid_json(s), note);
}

hci_status hci_grid_write(const hci_grid *sweep, const hci_report_sources *sources, const char *folder,
                          hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    status = write_all(out, sweep, sources, note);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}
