/* The page of a simulation: verdict, then the sections. */
#include <math.h>
#include <stdio.h>

#include "host/draw/html.h"
#include "host/report/page/page.h"
#include "host/report/page/simulation_sections.h"

/* A ripple below this is rounding. */
#define ROUNDING_PERCENT 1e-9

static void say_verdict(hci_output *out, const hci_simulation *s, const char *machine)
{
    const char *badge = !s->energy_balances ? "Not to be trusted: the energy does not balance"
                        : s->remark.text[0] ? "Done, with a remark"
                                            : "Done";
    char heading[256], kicker[512], mean[HCI_HTML_NUMBER_SIZE], ripple[HCI_HTML_NUMBER_SIZE],
        speed[HCI_HTML_NUMBER_SIZE];
    hci_html_quantity_text(mean, s->torque_Nm.mean, "N·m");
    hci_html_number_text(ripple, s->T_ripple_percent);
    hci_html_number_text(speed, s->speed_rad_per_s.mean * 30.0 / HCI_PI);
    if (s->T_ripple_percent < ROUNDING_PERCENT)
        snprintf(heading, sizeof heading, "The drive makes %s at %s rpm without ripple", mean, speed);
    else if (isfinite(s->T_ripple_percent))
        snprintf(heading, sizeof heading, "The drive makes %s at %s rpm with %s %% of ripple", mean, speed,
                 ripple);
    else
        snprintf(heading, sizeof heading, "The drive makes %s on average at %s rpm", mean, speed);
    snprintf(kicker, sizeof kicker, "Simulation of a drive · %s", machine ? machine : "");
    hci_html_begin(out, &(hci_html_opening){kicker, badge, heading, s->energy_balances});
    if (s->remark.text[0]) hci_html_say(out, NULL, "Remark: %s.", s->remark.text);
}

static void say_window(hci_output *out, const hci_simulation *s)
{
    char from[HCI_HTML_NUMBER_SIZE], to[HCI_HTML_NUMBER_SIZE];
    hci_html_number_text(from, s->from_s);
    hci_html_number_text(to, s->to_s);
    if (s->periods > 0)
        hci_html_say(out, "quiet", "Evaluated from %s s to %s s: %zu whole period%s.", from, to, s->periods,
                     s->periods == 1 ? "" : "s");
    else
        hci_html_say(out, "quiet",
                     "Evaluated from %s s to %s s, in which the rotor has not turned one period: there is "
                     "no spectrum.",
                     from, to);
}

/* ---- before and after ---- */

/* before: of the plain sine; left out where there is none. */
static void row_of(hci_output *out, const hci_simulation *s, const char *name, const double *value,
                   const char *unit)
{
    char before[HCI_HTML_NUMBER_SIZE] = "–", after[HCI_HTML_NUMBER_SIZE] = "–";
    if (isfinite(value[0])) hci_html_quantity_text(before, value[0], unit);
    if (isfinite(value[1])) hci_html_quantity_text(after, value[1], unit);
    if (!isfinite(value[1])) return;
    if (hci_page_has_before(s))
        hci_html_compare_row(out, name, (const char *const[]){before, after, NULL});
    else
        hci_html_compare_row(out, name, (const char *const[]){after, NULL});
}

static void show_before_and_after(hci_output *out, const hci_simulation *s)
{
    static const char *const BOTH[] = {"Before: plain sine that flows as it should", "After: this drive",
                                       NULL};
    const bool both = hci_page_has_before(s);
    const double swing_Nm = s->torque_Nm.most - s->torque_Nm.least;
    hci_html_compare(out, BOTH + !both);
    row_of(out, s, "Mean torque", (const double[]){both ? s->torque_Nm.mean : (double)NAN, s->torque_Nm.mean},
           "N·m");
    row_of(out, s, "Torque ripple, peak to peak", (const double[]){s->plain.peak_to_peak_Nm, swing_Nm},
           "N·m");
    row_of(out, s, "T_ripple, peak to peak to mean",
           (const double[]){s->plain.T_ripple_percent, s->T_ripple_percent}, "%");
    row_of(out, s, "F_ripple, rms to mean", (const double[]){s->plain.F_ripple_percent, s->F_ripple_percent},
           "%");
    row_of(out, s, "Peak phase current", (const double[]){s->plain_amplitude_A, s->peak_phase_A}, "A");
    row_of(out, s, "Copper loss", (const double[]){s->copper_W / s->loss_to_plain, s->copper_W}, "W");
    hci_html_compare_end(out);
    say_window(out, s);
}

static void show_drive(hci_output *out, const hci_simulation *s)
{
    static const char *const COLUMN[] = {"<Quantity", "Value", NULL};
    hci_html_fold(out, "Loss, switching and energies in numbers");
    hci_html_table(out, "Loss, switching and energies", COLUMN);
    hci_html_quantity(out, "copper loss in W", s->copper_W);
    hci_html_quantity(out, "amplitude of a plain sine with this mean torque in A", s->plain_amplitude_A);
    hci_html_quantity(out, "copper loss to that of the plain sine", s->loss_to_plain);
    hci_html_quantity(out, "switching frequency in Hz", s->switching_frequency_Hz);
    hci_html_quantity(out, "samples without a current for the torque", (double)s->without_current);
    hci_html_quantity(out, "samples at a current limit", (double)s->limited);
    hci_html_quantity(out, "electrical energy in J", s->energy_J.electrical);
    hci_html_quantity(out, "copper in J", s->energy_J.copper);
    hci_html_quantity(out, "stored in J", s->energy_J.stored);
    hci_html_quantity(out, "to the shaft in J", s->energy_J.mechanical);
    hci_html_quantity(out, "left over by the integration in J", s->energy_J.residual);
    hci_html_quantity(out, "step in s", s->step_s);
    hci_html_table_end(out);
    hci_html_paragraph(out, "quiet", "Beside this page: summary.json.");
    hci_html_fold_end(out);
}

hci_status hci_page_simulation(hci_output *out, const hci_simulation *s, const hci_traces *traces,
                               const hci_report_sources *sources, hci_note *note)
{
    char origin[HCI_PAGE_ORIGIN_SIZE];
    hci_page_origin(origin, sources);
    say_verdict(out, s, sources->machine);
    show_before_and_after(out, s);
    hci_status status = hci_page_turn(out, s, &traces->turn, origin, note);
    if (!status) status = hci_page_spectrum(out, s, origin, note);
    if (status) return status;
    hci_page_traces(out, s, traces, origin);
    show_drive(out, s);
    hci_page_show_sources(out, sources);
    hci_html_end(out);
    return HCI_OK;
}
