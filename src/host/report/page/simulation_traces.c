/* The section of a simulation over the time. */
#include <stdio.h>
#include <string.h>

#include "host/draw/html.h"
#include "host/plot/plot_drive.h"
#include "host/report/page/simulation_sections.h"

static void row_of(hci_output *out, const char *name, const hci_statistics *x, double factor)
{
    const double value[] = {x->mean, x->rms, x->least, x->most};
    hci_html_row(out);
    hci_html_cell(out, name);
    for (size_t k = 0; k < 4; ++k)
        hci_html_number_in(out, factor * value[k], factor * (x->most - x->least));
    hci_html_row_end(out);
}

static void table_of_statistics(hci_output *out, const hci_simulation *s, hci_trace first)
{
    static const char *const COLUMN[] = {"<Quantity", "Mean", "rms", "Least", "Most", NULL};
    hci_html_table(out, "Over the evaluated time", COLUMN);
    if (first == HCI_TRACE_TORQUE_NM) row_of(out, "torque N·m", &s->torque_Nm, 1.0);
    if (first == HCI_TRACE_SPEED_RPM) row_of(out, "speed rpm", &s->speed_rad_per_s, 30.0 / HCI_PI);
    if (first == HCI_TRACE_A_A) {
        row_of(out, "length of the current vector A", &s->current_A, 1.0);
        row_of(out, "√(i_dx² + i_qx²) A", &s->current_dqx_A, 1.0);
    }
    hci_html_table_end(out);
}

static const char TRUE_VALUES[] =
    "True values, not what sensors read; between extremes where samples are denser than the picture.";

static void show_currents(hci_output *out, const hci_simulation *s, const hci_traces *t, const char *origin)
{
    const hci_plot_window window = {t,      "Phase currents in A", HCI_TRACE_A_A, HCI_TRACE_C_A, s->from_s,
                                    s->to_s};
    const hci_html_drawing drawing = {.id = "current",
                                      .title = "Phase currents over time",
                                      .description = "Three lines in A over time in ms.",
                                      .caption = TRUE_VALUES,
                                      .wide = 262,
                                      .narrow = 262,
                                      .draw = hci_plot_traces,
                                      .context = &window};
    char heading[256], peak[HCI_HTML_NUMBER_SIZE], plain[HCI_HTML_NUMBER_SIZE];
    hci_html_quantity_text(peak, s->peak_phase_A, "A");
    hci_html_quantity_text(plain, s->plain_amplitude_A, "A");
    if (s->plain_amplitude_A > 0.0)
        snprintf(heading, sizeof heading, "The phases carry %s at the peak, a plain sine %s", peak, plain);
    else
        snprintf(heading, sizeof heading, "The phases carry %s at the peak", peak);
    hci_html_section(out, heading);
    hci_html_drawing_begin(out, &drawing);
    table_of_statistics(out, s, HCI_TRACE_A_A);
    hci_html_drawing_end(out, "summary.json, and trajectory.csv with the course", origin);
    hci_html_section_end(out);
}

static void heading_of_course(const hci_simulation *s, char text[256])
{
    const double rpm = 30.0 / HCI_PI;
    char low[HCI_HTML_NUMBER_SIZE], high[HCI_HTML_NUMBER_SIZE];
    hci_html_number_text(low, s->speed_rad_per_s.least * rpm);
    hci_html_number_text(high, s->speed_rad_per_s.most * rpm);
    if (strcmp(low, high) == 0)
        snprintf(text, 256, "Over time the speed is %s rpm", low);
    else
        snprintf(text, 256, "Over time the speed is between %s and %s rpm", low, high);
}

static void show_course(hci_output *out, const hci_simulation *s, const hci_traces *t, const char *origin)
{
    const hci_plot_window window[] = {
        {t, "Torque in N·m", HCI_TRACE_TORQUE_NM, HCI_TRACE_TORQUE_NM, s->from_s, s->to_s},
        {t, "Speed in rpm, mechanical", HCI_TRACE_SPEED_RPM, HCI_TRACE_SPEED_RPM, s->from_s, s->to_s}};
    const hci_html_drawing drawing = {.id = "torque",
                                      .title = "Torque and speed over time",
                                      .description =
                                          "Two lines over time in ms: torque in N·m, speed in rpm.",
                                      .caption = "Torque and speed as they are over the same time.",
                                      .wide = 380,
                                      .narrow = 400,
                                      .draw = hci_plot_traces_of_two,
                                      .context = window};
    char heading[256];
    heading_of_course(s, heading);
    hci_html_section(out, heading);
    hci_html_drawing_begin(out, &drawing);
    table_of_statistics(out, s, HCI_TRACE_TORQUE_NM);
    table_of_statistics(out, s, HCI_TRACE_SPEED_RPM);
    hci_html_drawing_end(out, "summary.json, and trajectory.csv with the course", origin);
    hci_html_section_end(out);
}

void hci_page_traces(hci_output *out, const hci_simulation *s, const hci_traces *t, const char *origin)
{
    show_currents(out, s, t, origin);
    show_course(out, s, t, origin);
}
