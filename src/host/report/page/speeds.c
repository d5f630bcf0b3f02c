/* The page of torque ripple over the speed. */
#include <math.h>
#include <stdio.h>

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
                     "The dc link does for all orders up to %s rpm; above that they fade, the highest "
                     "first.",
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
    "Torque ripple 100 (T_max − T_min) / T_mean of the simulated drive at a constant speed, whose references "
    "come from the emitted tables in single precision. Sine: i_d = 0 and a constant i_q. Table: the currents "
    "as "
    "they are. Lead: read ahead by the delay of the loop. Compensation: each order divided by what the loop "
    "makes of it. Feedforward: the voltage is given as well. Below: the largest line voltage, and the dc "
    "link.";

void hci_page_speeds(hci_output *out, const hci_speeds *s, const hci_report_sources *sources)
{
    char origin[HCI_PAGE_ORIGIN_SIZE], torque[HCI_HTML_NUMBER_SIZE], link[HCI_HTML_NUMBER_SIZE];
    hci_page_origin(origin, sources);
    hci_html_quantity_text(torque, s->torque_Nm, "N·m");
    hci_html_quantity_text(link, s->dc_link_V, "V");
    hci_html_begin(out, &(hci_html_opening){"Torque ripple through the current loop", "Done", "Done", true});
    hci_html_say(out, "lead", "%s at %zu speeds with a dc link of %s.", torque, s->count, link);
    say_ends(out, s);
    hci_html_section(out, "Ripple over the speed");
    hci_html_figure(out);
    hci_plot_speeds(out, s, false);
    hci_html_figure_tables(out);
    table_of_ripple(out, s, "T_ripple in %", false);
    if (s->model_error > 0.0) {
        char caption[128];
        snprintf(caption, sizeof caption,
                 "The same in %%, the worst of machines whose R, L and flux are %.3g %% off",
                 100.0 * s->model_error);
        table_of_ripple(out, s, caption, true);
    }
    table_of_voltage(out, s);
    hci_html_figure_end(out, CAPTION, "speeds.csv, summary.json", origin);
    hci_html_section_end(out);
    hci_page_show_sources(out, sources);
    hci_html_end(out);
}
