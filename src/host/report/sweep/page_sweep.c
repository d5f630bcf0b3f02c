/* The page of a sweep: what it found in a sentence, its picture, its table. */
#include "host/report/sweep/page_sweep.h"

#include <math.h>
#include <stdio.h>

#include "host/draw/html.h"
#include "host/plot/sweep/plot_sweep.h"
#include "host/report/page/page.h"

enum { MOST_ROWS = 400 };

/* ---- trade-off ---- */

static void say_least(hci_output *out, const hci_grid *s, double percent, const char *what)
{
    const hci_grid_row *row = hci_grid_least(s, false, percent);
    if (!row) return;
    hci_html_say(
        out, NULL,
        "%s: a limit of the phase current of %.4g A, with %.3g %% of ripple and %.4g times the copper loss "
        "of the plain sine.",
        what, row->point.limit_current_A, row->best.T_ripple_percent, row->best.loss_to_plain);
}

static void say_trade_off(hci_output *out, const hci_grid *s)
{
    say_least(out, s, HUGE_VAL, "The least that makes the torque");
    say_least(out, s, 1.0, "The least with at most 1 % of ripple");
    say_least(out, s, HCI_GRID_SMOOTH, "The least without ripple");
}

static void rows_of_trade_off(hci_output *out, const hci_grid *s, bool of_copper)
{
    static const char *const CURRENT[] = {"limit in A",        "ripple in %", "copper loss, × the plain sine",
                                          "peak current in A", "<verdict",    NULL};
    static const char *const COPPER[] = {
        "limit, × the plain sine", "ripple in %", "copper loss, × the plain sine",
        "peak current in A",       "<verdict",    NULL};
    const size_t from = of_copper ? s->plan.by_current : 0,
                 to = of_copper ? s->plan.count : s->plan.by_current;
    hci_html_table(out, of_copper ? "By the limit of the copper loss" : "By the limit of the phase current",
                   of_copper ? COPPER : CURRENT);
    for (size_t k = from; k < to && k < from + MOST_ROWS; ++k) {
        const hci_grid_row *row = &s->row[k];
        hci_html_row(out);
        hci_html_number(out, of_copper ? row->point.limit_copper : row->point.limit_current_A);
        hci_html_number(out, row->best.T_ripple_percent);
        hci_html_number(out, row->best.loss_to_plain);
        hci_html_number(out, row->best.peak_A);
        hci_html_cell(out, hci_grid_verdict_name(row->verdict));
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

/* ---- envelope ---- */

static void say_envelope(hci_output *out, const hci_grid *s)
{
    const hci_grid_row *row = &s->row[0];
    if (isfinite(row->best.mean_Nm))
        hci_html_say(
            out, NULL,
            "At %.4g rpm: %.4g N·m with at most %.4g %% of ripple, %.4g N·m with %.3g %%, and %.4g N·m with "
            "%.3g %% by the plain sine.",
            hci_grid_rpm(row->point.speed_rad_per_s), row->best.mean_Nm, s->request.ripple_percent,
            row->most.mean_Nm, row->most.T_ripple_percent, row->sine.mean_Nm, row->sine.T_ripple_percent);
}

static void envelope_row(hci_output *out, const hci_grid_row *row)
{
    const hci_grid_figures *part[] = {&row->best, &row->most, &row->sine};
    char binds[HCI_GRID_BINDS_SIZE];
    hci_html_row(out);
    hci_html_number(out, hci_grid_rpm(row->point.speed_rad_per_s));
    hci_html_number(out, row->point.link_V);
    for (int j = 0; j < 3; ++j) {
        hci_html_number(out, part[j]->mean_Nm);
        hci_html_number(out, part[j]->T_ripple_percent);
    }
    hci_grid_binds_text(&row->best, binds);
    hci_html_cell(out, binds);
    hci_html_cell(out, hci_grid_verdict_name(row->verdict));
    hci_html_row_end(out);
}

static void rows_of_envelope(hci_output *out, const hci_grid *s)
{
    static const char *const COLUMN[] = {"speed in rpm",
                                         "dc link in V",
                                         "torque in N·m",
                                         "its ripple in %",
                                         "with any ripple in N·m",
                                         "its ripple in %",
                                         "plain sine in N·m",
                                         "its ripple in %",
                                         "<binds",
                                         "<verdict",
                                         NULL};
    hci_html_table(out, "Largest mean torque", COLUMN);
    for (size_t k = 0; k < s->plan.count && k < MOST_ROWS; ++k)
        envelope_row(out, &s->row[k]);
    hci_html_table_end(out);
}

/* ---- map ---- */

static void say_map(hci_output *out, const hci_grid *s)
{
    size_t count[HCI_GRID_FAILED + 1];
    hci_grid_count(s, count);
    hci_html_say(
        out, NULL,
        "Of %zu points %zu have no ripple, %zu the smallest there is, %zu less torque than is wanted; at %zu "
        "no current keeps the limits, and %zu have no result.",
        s->plan.count, count[HCI_GRID_REACHED], count[HCI_GRID_RIPPLE], count[HCI_GRID_TORQUE],
        count[HCI_GRID_LIMITS], count[HCI_GRID_FAILED]);
}

static void map_row(hci_output *out, const hci_grid_row *row)
{
    char binds[HCI_GRID_BINDS_SIZE];
    hci_html_row(out);
    hci_html_number(out, hci_grid_rpm(row->point.speed_rad_per_s));
    hci_html_number(out, row->point.torque_Nm);
    hci_html_number(out, row->best.T_ripple_percent);
    hci_html_number(out, row->best.mean_square_A2);
    hci_html_number(out, row->best.peak_A);
    hci_html_number(out, row->best.line_V);
    hci_grid_binds_text(&row->best, binds);
    hci_html_cell(out, binds);
    hci_html_cell(out, hci_grid_verdict_name(row->verdict));
    hci_html_row_end(out);
}

static void rows_of_map(hci_output *out, const hci_grid *s)
{
    static const char *const COLUMN[] = {"speed in rpm",
                                         "torque in N·m",
                                         "ripple in %",
                                         "mean square in A²",
                                         "peak current in A",
                                         "line voltage in V",
                                         "<binds",
                                         "<verdict",
                                         NULL};
    hci_html_table(out, s->plan.count > MOST_ROWS ? "Points; the first of them" : "Points", COLUMN);
    for (size_t k = 0; k < s->plan.count && k < MOST_ROWS; ++k)
        map_row(out, &s->row[k]);
    hci_html_table_end(out);
}

/* ---- all of it ---- */

static void show_reasons(hci_output *out, const hci_grid *s)
{
    size_t count[HCI_GRID_FAILED + 1], shown = 0;
    hci_grid_count(s, count);
    if (count[HCI_GRID_FAILED] == 0) return;
    hci_html_section(out, "Points without a result");
    for (size_t k = 0; k < s->plan.count && shown < 20; ++k)
        if (s->row[k].verdict == HCI_GRID_FAILED) {
            hci_html_say(out, NULL, "Point %zu: %s", k + 1, s->row[k].reason);
            ++shown;
        }
    hci_html_section_end(out);
}

static void show_tables(hci_output *out, const hci_grid *s)
{
    if (s->request.kind == HCI_GRID_ENVELOPE) rows_of_envelope(out, s);
    if (s->request.kind == HCI_GRID_MAP) rows_of_map(out, s);
    if (s->request.kind != HCI_GRID_TRADE_OFF) return;
    rows_of_trade_off(out, s, false);
    rows_of_trade_off(out, s, true);
}

static void say_results(hci_output *out, const hci_grid *s)
{
    char limits[HCI_GRID_WORDS_SIZE];
    hci_grid_limits_words(&s->request, limits);
    hci_html_say(out, "lead", "%zu points; %s.", s->plan.count, limits[0] ? limits : "no limits");
    if (s->request.kind == HCI_GRID_TRADE_OFF) say_trade_off(out, s);
    if (s->request.kind == HCI_GRID_ENVELOPE) say_envelope(out, s);
    if (s->request.kind == HCI_GRID_MAP) say_map(out, s);
}

static void show_figure(hci_output *out, const hci_grid *s, const hci_report_sources *sources)
{
    static const char *const FILES[] = {"trade_off.csv", "envelope.csv", "map.csv"};
    char origin[HCI_PAGE_ORIGIN_SIZE];
    hci_page_origin(origin, sources);
    hci_html_section(out, "Picture and numbers");
    hci_html_figure(out);
    hci_plot_sweep(out, s, false);
    hci_html_figure_tables(out);
    show_tables(out, s);
    hci_html_figure_end(
        out,
        "Torque ripple: 100 (T_max − T_min) / T_mean of the torque that the model makes of currents "
        "that flow exactly. Each point is solved as `solve` does.",
        FILES[s->request.kind], origin);
    hci_html_section_end(out);
}

void hci_page_sweep(hci_output *out, const hci_grid *s, const hci_report_sources *sources)
{
    static const char *const HEADING[] = {"Ripple against current and copper",
                                          "Largest torque over the speed", "Maps over torque and speed"};
    hci_html_begin(out, &(hci_html_opening){HEADING[s->request.kind], "Done", "Done", true});
    say_results(out, s);
    show_figure(out, s, sources);
    show_reasons(out, s);
    hci_page_show_sources(out, sources);
    hci_html_end(out);
}
