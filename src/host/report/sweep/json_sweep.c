#include <math.h>

#include "hci/host/base/unit.h"
#include "hci/host/report/sweep/write.h"
#include "host/report/summary.h"
#include "host/sweep/columns.h"

static void put_figures(hci_json *json, const hci_grid_request *r, const hci_grid_figures *f)
{
    char binds[HCI_GRID_BINDS_SIZE];
#define PUT(field, column) hci_json_number(json, column, f->field);
    HCI_GRID_FIGURES(PUT)
#undef PUT
    hci_json_number(json, "copper_W", hci_grid_copper_W(r, f));
    hci_grid_binds_text(f, binds);
    hci_json_text(json, "binds", binds);
}

static void put_counts(hci_json *json, const hci_grid *s)
{
    size_t count[HCI_GRID_FAILED + 1];
    hci_grid_count(s, count);
    hci_json_number(json, "points", (double)s->plan.count);
    hci_json_object(json, "verdicts");
    for (int k = 0; k <= HCI_GRID_FAILED; ++k)
        hci_json_number(json, hci_grid_verdict_name((hci_grid_verdict)k), (double)count[k]);
    hci_json_close(json);
}

static void put_failures(hci_json *json, const hci_grid *s)
{
    hci_json_array(json, "failed");
    for (size_t k = 0; k < s->plan.count; ++k) {
        if (!s->done[k] || s->row[k].verdict != HCI_GRID_FAILED) continue;
        hci_json_object(json, NULL);
        hci_json_number(json, "point", (double)(k + 1));
        hci_json_text(json, "reason", s->row[k].reason);
        hci_json_close(json);
    }
    hci_json_close(json);
}

/* ---- trade-off ---- */

static void put_least(hci_json *json, const char *name, const hci_grid *s, bool of_copper, double percent)
{
    const hci_grid_row *row = hci_grid_least(s, of_copper, percent);
    hci_json_object(json, name);
    if (row) {
        hci_json_number(json, of_copper ? "limit_loss_to_plain" : "limit_phase_A",
                        of_copper ? row->point.limit_copper : row->point.limit_current_A);
        put_figures(json, &s->request, &row->best);
    }
    hci_json_close(json);
}

static void put_trade_off(hci_json *json, const hci_grid *s)
{
    static const char *const NAME[] = {"by_current", "by_copper"};
    hci_json_number(json, "torque_Nm", s->plan.point[0].torque_Nm);
    hci_json_number(json, "speed_rpm", hci_rpm(s->plan.point[0].speed_rad_per_s));
    for (int k = 0; k < 2; ++k) {
        hci_json_object(json, NAME[k]);
        put_least(json, "any_ripple", s, k == 1, HUGE_VAL);
        put_least(json, "one_percent", s, k == 1, 1.0);
        put_least(json, "no_ripple", s, k == 1, HCI_GRID_SMOOTH);
        hci_json_close(json);
    }
    hci_json_object(json, "sine");
    for (size_t k = 0; k < s->plan.count; ++k)
        if (isfinite(s->row[k].sine.peak_A)) {
            put_figures(json, &s->request, &s->row[k].sine);
            break;
        }
    hci_json_close(json);
}

/* ---- envelope, map ---- */

static void put_part(hci_json *json, const char *name, const hci_grid *s, const hci_grid_figures *f)
{
    hci_json_object(json, name);
    put_figures(json, &s->request, f);
    hci_json_close(json);
}

static void put_envelope(hci_json *json, const hci_grid *s)
{
    hci_json_number(json, "ripple_percent", s->request.ripple_percent);
    hci_json_array(json, "speeds");
    for (size_t k = 0; k < s->plan.count; ++k) {
        const hci_grid_row *row = &s->row[k];
        hci_json_object(json, NULL);
        hci_json_number(json, "speed_rpm", hci_rpm(row->point.speed_rad_per_s));
        hci_json_number(json, "dc_link_V", row->point.link_V);
        hci_json_text(json, "verdict", hci_grid_verdict_name(row->verdict));
        put_part(json, "best", s, &row->best);
        put_part(json, "most", s, &row->most);
        put_part(json, "sine", s, &row->sine);
        hci_json_close(json);
    }
    hci_json_close(json);
}

/* Of the points whose mean is reached. */
static void put_map(hci_json *json, const hci_grid *s)
{
    double ripple = NAN, peak_A = NAN, ms_A2 = NAN, line_V = NAN;
    for (size_t k = 0; k < s->plan.count; ++k) {
        const hci_grid_figures *f = &s->row[k].best;
        if (s->row[k].verdict > HCI_GRID_RIPPLE) continue;
        ripple = fmax(ripple, f->T_ripple_percent);
        peak_A = fmax(peak_A, f->peak_A);
        ms_A2 = fmax(ms_A2, f->mean_square_A2);
        line_V = fmax(line_V, f->line_V);
    }
    hci_json_number(json, "worst_T_ripple_percent", ripple);
    hci_json_number(json, "largest_peak_phase_A", peak_A);
    hci_json_number(json, "largest_mean_square_A2", ms_A2);
    hci_json_number(json, "largest_peak_line_V", line_V);
}

char *hci_grid_json(const hci_grid *s)
{
    hci_json json;
    char limits[HCI_GRID_WORDS_SIZE];
    hci_grid_limits_words(&s->request, limits);
    hci_summary_begin(&json, "sweep");
    hci_json_text(&json, "kind", hci_grid_kind_name(s->request.kind));
    hci_json_text(&json, "limits", limits);
    put_counts(&json, s);
    put_failures(&json, s);
    if (s->request.kind == HCI_GRID_TRADE_OFF) put_trade_off(&json, s);
    if (s->request.kind == HCI_GRID_ENVELOPE) put_envelope(&json, s);
    if (s->request.kind == HCI_GRID_MAP) put_map(&json, s);
    return hci_json_end(&json);
}
