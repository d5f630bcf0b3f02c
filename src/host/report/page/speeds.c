/* The page of torque ripple over the speed. */
#include <math.h>
#include <stdio.h>

#include "hci/host/base/number.h"
#include "host/draw/html.h"
#include "host/plot/plot.h"
#include "host/report/page/page.h"

static double rpm(double speed_rad_per_s)
{
    return speed_rad_per_s * 30.0 / HCI_PI;
}

static void say_ends(hci_output *out, const hci_speeds *s)
{
    char voltage[HCI_HTML_NUMBER_SIZE], sampled[HCI_HTML_NUMBER_SIZE];
    hci_html_number_text(voltage, rpm(s->voltage_rad_per_s));
    hci_html_number_text(sampled, rpm(s->sampled_rad_per_s));
    if (isfinite(s->voltage_rad_per_s))
        hci_html_say(out, NULL,
                     "The dc link does for all orders up to %s rpm; above that they are kept as long as they "
                     "leave less ripple than without them, the highest the shortest.",
                     voltage);
    if (isfinite(s->sampled_rad_per_s))
        hci_html_say(out, NULL, "The sampling does for all orders up to %s rpm.", sampled);
}

static void table_of_ripple(hci_output *out, const hci_speeds *s, const char *caption, bool worst)
{
    static const char *const COLUMN[] = {"Speed in rpm", "sine",        "table", "lead",
                                         "compensation", "feedforward", NULL};
    hci_html_table(out, caption, COLUMN);
    for (size_t k = 0; k < s->count; ++k) {
        hci_html_row(out);
        hci_html_number(out, rpm(s->row[k].speed_rad_per_s));
        for (int r = 0; r < HCI_REMEDIES; ++r)
            hci_html_number(out, worst ? s->row[k].remedy[r].worst_T_ripple_percent
                                       : s->row[k].remedy[r].T_ripple_percent);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void table_of_voltage(hci_output *out, const hci_speeds *s)
{
    static const char *const COLUMN[] = {"Speed in rpm",
                                         "needed dc link in V",
                                         "orders cut short",
                                         "largest line voltage with feedforward in V",
                                         "share of the samples that lack voltage",
                                         NULL};
    hci_html_table(out, "Voltage", COLUMN);
    for (size_t k = 0; k < s->count; ++k) {
        const hci_speed_result *x = &s->row[k].remedy[HCI_REMEDY_FEEDFORWARD];
        hci_html_row(out);
        hci_html_number(out, rpm(s->row[k].speed_rad_per_s));
        hci_html_number(out, s->row[k].needed_V);
        hci_html_number(out, (double)s->row[k].orders_short);
        hci_html_number(out, x->line_V);
        hci_html_number(out, x->limited_share);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static const char CAPTION[] =
    "100 (T_max − T_min) / T_mean of the simulated drive at a constant speed, whose references come from the "
    "emitted tables in single precision. Sine: i_d = 0 and a constant i_q. Table: the currents as they are. "
    "Lead: read ahead by the delay of the loop. Compensation: each order divided by what the loop makes of "
    "it. "
    "Feedforward: the voltage is given as well.";

/* The remedy with the least ripple at the highest speed that has any. */
static void heading_of_ripple(const hci_speeds *s, char text[256])
{
    static const char *const NAME[HCI_REMEDIES] = {"a plain sine", "the table as it is",
                                                   "the table read ahead", "compensation", "feedforward"};
    const hci_speed_row *row = &s->row[s->count - 1];
    char least[HCI_HTML_NUMBER_SIZE], sine[HCI_HTML_NUMBER_SIZE], speed[HCI_HTML_NUMBER_SIZE];
    int best = 0;
    for (int r = 1; r < HCI_REMEDIES; ++r)
        if (row->remedy[r].T_ripple_percent < row->remedy[best].T_ripple_percent) best = r;
    hci_html_number_text(speed, rpm(row->speed_rad_per_s));
    hci_html_number_text(least, row->remedy[best].T_ripple_percent);
    hci_html_number_text(sine, row->remedy[HCI_REMEDY_SINE].T_ripple_percent);
    snprintf(text, 256, "At %s rpm %s leaves the least ripple, %s %%, where a plain sine has %s %%", speed,
             NAME[best], least, sine);
}

static void tables_of_ripple(hci_output *out, const hci_speeds *s)
{
    char caption[128];
    table_of_ripple(out, s, "T_ripple in %", false);
    if (!(s->model_error > 0.0)) return;
    snprintf(caption, sizeof caption,
             "The same in %%, the worst of machines whose R, L and flux are %s %% off",
             HCI_PERCENT(100.0 * s->model_error, 3));
    table_of_ripple(out, s, caption, true);
}

static void show_ripple(hci_output *out, const hci_speeds *s, const char *origin)
{
    const hci_html_drawing drawing = {
        .id = "speeds",
        .title = "Torque ripple over the speed by remedy",
        .description =
            "Torque ripple in percent over the speed in rpm, both logarithmic: one line for each of "
            "sine, table, lead, compensation and feedforward.",
        .caption = CAPTION,
        .wide = 340,
        .narrow = 340,
        .draw = hci_plot_speeds_ripple,
        .context = s};
    hci_html_section(out, "How the ripple grows with the speed");
    hci_html_drawing_begin(out, &drawing);
    tables_of_ripple(out, s);
    hci_html_drawing_end(out, "speeds.csv, summary.json", origin);
    hci_html_section_end(out);
}

static void show_voltage(hci_output *out, const hci_speeds *s, const char *origin)
{
    const hci_html_drawing drawing = {.id = "voltage",
                                      .title = "Largest line voltage over the speed",
                                      .description = "Lines in V over the speed in rpm, and the dc link.",
                                      .caption = "What the currents take, and what there is.",
                                      .wide = 230,
                                      .narrow = 250,
                                      .draw = hci_plot_speeds_voltage,
                                      .context = s};
    hci_html_section(out, "The voltage that it takes");
    hci_html_drawing_begin(out, &drawing);
    table_of_voltage(out, s);
    hci_html_drawing_end(out, "speeds.csv, summary.json", origin);
    say_ends(out, s);
    hci_html_section_end(out);
}

void hci_page_speeds(hci_output *out, const hci_speeds *s, const hci_report_sources *sources)
{
    char origin[HCI_PAGE_ORIGIN_SIZE], torque[HCI_HTML_NUMBER_SIZE], link[HCI_HTML_NUMBER_SIZE], heading[256],
        kicker[512];
    hci_page_origin(origin, sources);
    hci_html_quantity_text(torque, s->torque_Nm, "N·m");
    hci_html_quantity_text(link, s->dc_link_V, "V");
    heading_of_ripple(s, heading);
    snprintf(kicker, sizeof kicker, "Torque ripple through the current loop · %s",
             sources->machine ? sources->machine : "");
    hci_html_begin(out, &(hci_html_opening){kicker, "Done", heading, true});
    hci_html_say(out, "lead", "%s at %zu speeds with a dc link of %s.", torque, s->count, link);
    hci_html_evidence(out);
    show_ripple(out, s, origin);
    show_voltage(out, s, origin);
    hci_page_show_sources(out, sources);
    hci_html_end(out);
}
