/* The page of a sweep: what it found in a sentence, its picture, its table. */
#include "host/report/sweep/page_sweep.h"
#include "hci/host/base/number.h"
#include "hci/host/base/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/draw/html.h"
#include "host/plot/sweep/plot_sweep.h"
#include "host/report/page/page.h"

enum { MOST_ROWS = 400 };

/* ---- trade-off ---- */

static void say_least(hci_output *out, const hci_grid *s, double percent, const char *what)
{
    const hci_grid_row *row = hci_grid_least(s, false, percent);
    char ripple[64];
    if (!row) return;
    if (row->best.T_ripple_percent < HCI_GRID_SMOOTH)
        snprintf(ripple, sizeof ripple, "no ripple");
    else
        snprintf(ripple, sizeof ripple, "%s %% of ripple", HCI_PERCENT(row->best.T_ripple_percent, 3));
    hci_html_say(out, NULL,
                 "%s: a limit of the phase current of %.4g A, with %s and %.4g times the copper loss of the "
                 "plain sine.",
                 what, row->point.limit_current_A, ripple, row->best.loss_to_plain);
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
            "At %.4g rpm: %.4g N·m with at most %s %% of ripple, %.4g N·m with %s %%, and %.4g N·m with "
            "%s %% by the plain sine.",
            hci_rpm(row->point.speed_rad_per_s), row->best.mean_Nm, HCI_PERCENT(s->request.ripple_percent, 4),
            row->most.mean_Nm, HCI_PERCENT(row->most.T_ripple_percent, 3), row->sine.mean_Nm,
            HCI_PERCENT(row->sine.T_ripple_percent, 3));
}

static void envelope_row(hci_output *out, const hci_grid_row *row)
{
    const hci_grid_figures *part[] = {&row->best, &row->most, &row->sine};
    char binds[HCI_GRID_BINDS_SIZE];
    hci_html_row(out);
    hci_html_number(out, hci_rpm(row->point.speed_rad_per_s));
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

/* How many points there are of each verdict, of which there are any. */
static void say_map(hci_output *out, const hci_grid *s)
{
    static const char *const OF[] = {"without ripple", "with the smallest ripple there is",
                                     "with less torque than is wanted", "where no current keeps the limits",
                                     "without a result"};
    size_t count[HCI_GRID_FAILED + 1];
    char text[320];
    hci_grid_count(s, count);
    snprintf(text, sizeof text, "%zu points", s->plan.count);
    for (size_t k = 0; k <= HCI_GRID_FAILED; ++k)
        if (count[k] > 0)
            snprintf(text + strlen(text), sizeof text - strlen(text), "%s %zu %s",
                     strchr(text, ':') ? "," : ":", count[k], OF[k]);
    hci_html_say(out, NULL, "%s.", text);
}

static void map_row(hci_output *out, const hci_grid_row *row)
{
    char binds[HCI_GRID_BINDS_SIZE];
    hci_html_row(out);
    hci_html_number(out, hci_rpm(row->point.speed_rad_per_s));
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

/* ---- the pictures ---- */

static void tables_of(hci_output *out, const hci_grid *s, int picture)
{
    if (s->request.kind == HCI_GRID_ENVELOPE) rows_of_envelope(out, s);
    if (s->request.kind == HCI_GRID_MAP) rows_of_map(out, s);
    if (s->request.kind == HCI_GRID_TRADE_OFF) rows_of_trade_off(out, s, picture % 2 == 1);
}

/* A section: the sentence, and the drawing that shows it. */
typedef struct {
    const char *heading;
    hci_html_drawing drawing;
} picture;

#define RIPPLE_IS                                                                                             \
    "Torque ripple: 100 (T_max − T_min) / T_mean of the torque that the model makes of currents that flow " \
    "exactly. Each point is solved as `solve` does."

static const picture TRADE_OFF[] = {
    {"The more peak current is allowed, the less ripple",
     {.id = "ripple-current",
      .title = "Torque ripple over the limit of the phase current",
      .description = "A line with a dot for each limit: torque ripple in per cent; the plain sine as a dot.",
      .caption = RIPPLE_IS,
      .wide = 280,
      .narrow = 290,
      .draw = hci_plot_ripple_by_current}},
    {"The more copper loss is allowed, the less ripple",
     {.id = "ripple-copper",
      .title = "Torque ripple over the limit of the copper loss",
      .description = "A line with a dot for each limit: torque ripple in per cent; the plain sine as a dot.",
      .caption = "The same ripple, where copper loss is limited and the peak is not.",
      .wide = 280,
      .narrow = 290,
      .draw = hci_plot_ripple_by_copper}},
    {"The copper loss that goes with each peak current",
     {.id = "copper-current",
      .title = "Copper loss over the limit of the phase current",
      .description = "A line with a dot for each limit: copper loss over that of the plain sine.",
      .caption = "Of the currents of the first picture.",
      .wide = 230,
      .narrow = 250,
      .draw = hci_plot_copper_by_current}},
    {"The peak current that goes with each copper loss",
     {.id = "peak-copper",
      .title = "Peak phase current over the limit of the copper loss",
      .description = "A line with a dot for each limit: peak phase current in A.",
      .caption = "Of the currents of the second picture.",
      .wide = 230,
      .narrow = 250,
      .draw = hci_plot_peak_by_copper}},
    {0}};

static const picture ENVELOPE[] = {
    {"How much torque there is at each speed",
     {.id = "torque",
      .title = "Largest mean torque over the speed",
      .description =
          "Lines in N·m over the speed in rpm: with little ripple, with any, and of the plain sine, "
          "within the same limits.",
      .caption = "The largest mean torque found within the limits, but for the plain sine of the components "
                 "that may be used. " RIPPLE_IS,
      .wide = 320,
      .narrow = 320,
      .legend_rows = 3,
      .draw = hci_plot_envelope_torque}},
    {"How much ripple these torques have",
     {.id = "ripple",
      .title = "Ripple of these torques over the speed",
      .description = "Lines in per cent of the mean torque over the speed in rpm, logarithmic.",
      .caption = "Ripple of the torques above.",
      .wide = 250,
      .narrow = 290,
      .legend_rows = 3,
      .draw = hci_plot_envelope_ripple}},
    {0}};

static const picture MAP[] = {
    {"What each torque costs at each speed",
     {.id = "maps",
      .title = "Maps over torque and speed",
      .description =
          "Five maps over speed and mean torque, a cell for each point: torque ripple, copper, peak "
          "phase current, peak line voltage, and the limit that binds.",
      .caption =
          "Upwards: mean torque in N·m. Grey: the mean torque is not reached within the limits; in the "
          "map of limits: nothing keeps them, or no result. Of several dc links the first is "
          "drawn. " RIPPLE_IS,
      .wide = 3 * HCI_MAP_DOWN + 8,
      .narrow = 5 * HCI_MAP_DOWN + 8,
      .headless = true,
      .draw = hci_plot_maps}},
    {0}};

static void show_pictures(hci_output *out, const hci_grid *s, const hci_report_sources *sources)
{
    static const picture *const OF[] = {TRADE_OFF, ENVELOPE, MAP};
    static const char *const FILES[] = {"trade_off.csv", "envelope.csv", "map.csv"};
    char origin[HCI_PAGE_ORIGIN_SIZE];
    hci_page_origin(origin, sources);
    for (int k = 0; OF[s->request.kind][k].heading; ++k) {
        hci_html_drawing drawing = OF[s->request.kind][k].drawing;
        drawing.context = s;
        hci_html_section(out, OF[s->request.kind][k].heading);
        hci_html_drawing_begin(out, &drawing);
        tables_of(out, s, k);
        hci_html_drawing_end(out, FILES[s->request.kind], origin);
        hci_html_section_end(out);
    }
}

/* ---- the verdict ---- */

static void heading_of_trade_off(const hci_grid *s, char text[256])
{
    const hci_grid_row *smooth = hci_grid_least(s, false, HCI_GRID_SMOOTH),
                       *least = hci_grid_least(s, false, HUGE_VAL);
    const double torque_Nm = s->plan.point[0].torque_Nm;
    if (smooth)
        snprintf(text, 256, "%.4g N·m without ripple takes %.4g A at the peak", torque_Nm,
                 smooth->best.peak_A);
    else if (least)
        snprintf(text, 256, "%.4g N·m takes %.4g A at the peak, with %s %% of ripple", torque_Nm,
                 least->best.peak_A, HCI_PERCENT(least->best.T_ripple_percent, 3));
    else
        snprintf(text, 256, "No limit that was tried lets %.4g N·m be made", torque_Nm);
}

static void heading_of_envelope(const hci_grid *s, char text[256])
{
    const hci_grid_row *row = &s->row[0];
    if (isfinite(row->best.mean_Nm))
        snprintf(text, 256, "%.4g N·m at %.4g rpm with at most %s %% of ripple", row->best.mean_Nm,
                 hci_rpm(row->point.speed_rad_per_s), HCI_PERCENT(s->request.ripple_percent, 4));
    else
        snprintf(text, 256, "No torque at %.4g rpm with at most %s %% of ripple",
                 hci_rpm(row->point.speed_rad_per_s), HCI_PERCENT(s->request.ripple_percent, 4));
}

static void heading_of(const hci_grid *s, char text[256])
{
    size_t count[HCI_GRID_FAILED + 1];
    hci_grid_count(s, count);
    if (s->request.kind == HCI_GRID_TRADE_OFF) heading_of_trade_off(s, text);
    if (s->request.kind == HCI_GRID_ENVELOPE) heading_of_envelope(s, text);
    if (s->request.kind == HCI_GRID_MAP)
        snprintf(text, 256, "At %zu of %zu points the torque is made without ripple", count[HCI_GRID_REACHED],
                 s->plan.count);
}

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

static void say_results(hci_output *out, const hci_grid *s)
{
    char limits[HCI_GRID_WORDS_SIZE];
    hci_grid_limits_words(&s->request, limits);
    hci_html_say(out, "lead", "%zu points; %s.", s->plan.count, limits[0] ? limits : "no limits");
    if (s->request.kind == HCI_GRID_TRADE_OFF) say_trade_off(out, s);
    if (s->request.kind == HCI_GRID_ENVELOPE) say_envelope(out, s);
    if (s->request.kind == HCI_GRID_MAP) say_map(out, s);
    hci_html_evidence(out);
}

void hci_page_sweep(hci_output *out, const hci_grid *s, const hci_report_sources *sources)
{
    static const char *const KIND[] = {"Ripple against current and copper", "Largest torque over the speed",
                                       "Maps over torque and speed"};
    size_t count[HCI_GRID_FAILED + 1];
    char kicker[512], heading[256];
    hci_grid_count(s, count);
    heading_of(s, heading);
    snprintf(kicker, sizeof kicker, "%s · %s", KIND[s->request.kind],
             sources->machine ? sources->machine : "");
    hci_html_begin(out, &(hci_html_opening){kicker,
                                            count[HCI_GRID_FAILED] == 0 ? "Done" : "Points without a result",
                                            heading, count[HCI_GRID_FAILED] == 0});
    say_results(out, s);
    show_pictures(out, s, sources);
    show_reasons(out, s);
    hci_page_show_sources(out, sources);
    hci_html_end(out);
}
