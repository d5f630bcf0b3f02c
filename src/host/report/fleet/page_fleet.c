/* The page of a fleet: who stands out, how parameters are distributed, what changes over time. */
#include "host/report/fleet/page_fleet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "host/draw/html.h"
#include "host/plot/fleet/plot_fleet.h"

enum { MOST_ROWS = 400, MOST_FAILED = 50 };

static void say_results(hci_output *out, const hci_line *l)
{
    size_t without = 0;
    for (size_t k = 0; k < l->motors; ++k)
        without += l->motor[k].worst == HCI_LINE_NONE;
    hci_html_say(out, "lead", "%zu motors; %zu of them were fitted, %zu were not.", l->motors,
                 l->motors - without, without);
    hci_html_say(
        out, NULL,
        "A motor stands out where one of its parameters is more than %.3g robust standard deviations from "
        "the median of all: "
        "of sound motors whose parameters are normally distributed, %s %% would, some %.2g of these.",
        l->limit, HCI_PERCENT(100.0 * l->false_alarms, 3), l->false_alarms * (double)(l->motors - without));
    hci_html_evidence(out);
}

/* ---- who stands out ---- */

static int by_deviation(const void *a, const void *b)
{
    const double x = fabs((*(const hci_line_motor *const *)a)->deviation),
                 y = fabs((*(const hci_line_motor *const *)b)->deviation);
    return (x < y) - (x > y);
}

static void odd_row(hci_output *out, const hci_line *l, const hci_line_motor *m)
{
    const double value = l->value[(size_t)(m - l->motor) * l->parameters + m->worst];
    char name[96];
    hci_plot_parameter_name(l, m->worst, name);
    hci_html_row(out);
    hci_html_cell(out, m->name);
    hci_html_cell(out, m->batch);
    hci_html_cell(out, m->date);
    hci_html_cell(out, name);
    hci_html_number(out, value);
    hci_html_number(out, l->parameter[m->worst].median);
    hci_html_cell(out, l->parameter[m->worst].name.unit);
    hci_html_number(out, m->deviation);
    hci_html_row_end(out);
}

static void table_of_odd(hci_output *out, const hci_line *l)
{
    static const char *const COLUMN[] = {
        "<motor", "<batch", "<date", "<by", "value", "median", "<unit", "standard deviations", NULL};
    const hci_line_motor *odd[MOST_ROWS];
    size_t count = 0;
    for (size_t k = 0; k < l->motors && count < MOST_ROWS; ++k)
        if (l->motor[k].stands_out) odd[count++] = &l->motor[k];
    qsort(odd, count, sizeof odd[0], by_deviation);
    hci_html_table(out,
                   hci_line_outside(l) > MOST_ROWS ? "Motors that stand out; the first of them"
                                                   : "Motors that stand out",
                   COLUMN);
    for (size_t k = 0; k < count; ++k)
        odd_row(out, l, odd[k]);
    hci_html_table_end(out);
}

static void show_motors(hci_output *out, const hci_line *l)
{
    const hci_html_drawing drawing = {
        .id = "motors",
        .title = "Largest deviation of each motor",
        .description =
            "A dot for each motor: its largest deviation in standard deviations, logarithmic, over the date.",
        .caption = "The parameter in which a motor is furthest from the median, whichever that is.",
        .wide = 300,
        .narrow = 300,
        .legend_rows = 2,
        .draw = hci_plot_motors,
        .context = l};
    hci_html_section(out, "Which motors stand out");
    hci_html_drawing_begin(out, &drawing);
    table_of_odd(out, l);
    hci_html_drawing_end(out, "deviations.csv", "fleet.csv");
    hci_html_section_end(out);
}

/* ---- distributions ---- */

static void table_of_parameters(hci_output *out, const hci_line *l)
{
    static const char *const COLUMN[] = {
        "<parameter",     "<unit",        "motors",  "median",    "standard deviation (robust)",
        "lower limit",    "upper limit",  "outside", "in common", "± ",
        "between motors", "noise of one", NULL};
    hci_html_table(out, "Parameters", COLUMN);
    for (size_t k = 0; k < l->parameters; ++k) {
        const hci_line_parameter *p = &l->parameter[k];
        const double value[] = {(double)p->motors,  p->median, p->scale,          p->low,     p->high,
                                (double)p->outside, p->mean,   p->mean_std_error, p->between, p->noise};
        char name[96];
        hci_plot_parameter_name(l, k, name);
        hci_html_row(out);
        hci_html_cell(out, name);
        hci_html_cell(out, p->name.unit);
        for (size_t j = 0; j < sizeof value / sizeof value[0]; ++j)
            hci_html_number(out, value[j]);
        hci_html_row_end(out);
    }
    hci_html_table_end(out);
}

static void show_distributions(hci_output *out, const hci_line *l)
{
    const int high = (int)l->parameters * HCI_PLOT_PARAMETER_DOWN + 110;
    const hci_html_drawing drawing = {
        .id = "parameters",
        .title = "How each parameter is distributed",
        .description = "A row for each parameter: a histogram of the motors' deviations, and a ring for each "
                       "motor that stands out by it.",
        .caption = "What a motor has beyond the machine folder, less the median, over the robust standard "
                   "deviation. "
                   "Grey rings: motors that stand out more by another parameter.",
        .wide = high,
        .narrow = high,
        .legend_rows = 2,
        .draw = hci_plot_distributions,
        .context = l};
    hci_html_section(out, "How each parameter is distributed");
    hci_html_drawing_begin(out, &drawing);
    table_of_parameters(out, l);
    hci_html_drawing_end(out, "line.csv", "fleet.csv");
    hci_html_section_end(out);
}

/* ---- trends ---- */

static void say_trends(hci_output *out, const hci_line *l)
{
    char name[96];
    for (size_t k = 0; k < l->parameters; ++k) {
        const hci_line_parameter *p = &l->parameter[k];
        const char *unit = strcmp(p->name.unit, "1") == 0 ? "" : p->name.unit;
        hci_plot_parameter_name(l, k, name);
        if (p->has_trend)
            hci_html_say(out, NULL, "%s changes by %.3g ± %.1g %s in 30 days.", name, 30.0 * p->per_day,
                         30.0 * p->per_day_std_error, unit);
        if (p->has_batches)
            hci_html_say(out, NULL,
                         "%s differs from batch to batch by %.3g %s (standard deviation of the batches).",
                         name, p->batch_deviation, unit);
    }
}

static void show_trends(hci_output *out, const hci_line *l)
{
    const int high = (int)hci_plot_batches_count(l) * HCI_PLOT_BATCHES_DOWN + 40;
    const hci_html_drawing drawing = {
        .id = "batches",
        .title = "Means of batches",
        .description = "A dot for each batch: the mean of a parameter over its motors that do not stand out.",
        .caption = "Parameters that change most over the date or from batch to batch.",
        .wide = high,
        .narrow = high,
        .headless = true,
        .draw = hci_plot_batches,
        .context = l};
    if (hci_plot_batches_count(l) == 0) return;
    hci_html_section(out, "What changes over time and from batch to batch");
    say_trends(out, l);
    hci_html_drawing_begin(out, &drawing);
    hci_html_drawing_end(out, "line.csv", "fleet.csv");
    hci_html_section_end(out);
}

/* ---- motors without a result ---- */

static void show_failed(hci_output *out, const hci_line *l)
{
    size_t shown = 0;
    for (size_t k = 0; k < l->motors && shown < MOST_FAILED; ++k) {
        if (l->motor[k].state <= HCI_FLEET_OPEN) continue;
        if (shown++ == 0) hci_html_section(out, "Motors without a result");
        hci_html_say(out, NULL, "%s: %s", l->motor[k].name, hci_fleet_state_name(l->motor[k].state));
    }
    if (shown > 0) hci_html_section_end(out);
}

void hci_page_fleet(hci_output *out, const hci_line *l)
{
    const size_t outside = hci_line_outside(l);
    char heading[160], kicker[160];
    snprintf(kicker, sizeof kicker, "Motors of one make · %s", hci_fleet_command_name(l->command));
    snprintf(heading, sizeof heading,
             outside == 1 ? "%zu of %zu motors stands out" : "%zu of %zu motors stand out", outside,
             l->motors);
    hci_html_begin(out, &(hci_html_opening){kicker, outside == 0 ? "None stands out" : "Some stand out",
                                            heading, outside == 0});
    say_results(out, l);
    if (l->parameters > 0) {
        show_motors(out, l);
        show_distributions(out, l);
        show_trends(out, l);
    }
    show_failed(out, l);
    hci_html_end(out);
}
