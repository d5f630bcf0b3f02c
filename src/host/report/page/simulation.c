/* The page of a simulation: verdict, then the sections. */
#include <math.h>
#include <stdio.h>

#include "host/draw/html.h"
#include "host/report/page/page.h"
#include "host/report/page/simulation_sections.h"

/* The main results, at the top of the page. */
static void say_facts(hci_output *out, const hci_simulation *s)
{
    char mean[HCI_HTML_NUMBER_SIZE], speed[HCI_HTML_NUMBER_SIZE], swing[HCI_HTML_NUMBER_SIZE],
        loss[128] = "", before[HCI_HTML_NUMBER_SIZE + 80] = "";
    hci_html_quantity_text(mean, s->torque_Nm.mean, "N·m");
    hci_html_quantity_text(swing, s->torque_Nm.most - s->torque_Nm.least, "N·m");
    hci_html_number_text(speed, s->speed_rad_per_s.mean * 30.0 / HCI_PI);
    if (isfinite(s->loss_to_plain)) {
        char ratio[HCI_HTML_NUMBER_SIZE];
        hci_html_number_text(ratio, s->loss_to_plain);
        snprintf(loss, sizeof loss,
                 " Its copper loss is %s times that of a plain sine with the same mean torque.", ratio);
    }
    if (hci_page_has_before(s)) {
        char plain[HCI_HTML_NUMBER_SIZE];
        hci_html_quantity_text(plain, s->plain.peak_to_peak_Nm, "N·m");
        snprintf(before, sizeof before, ", with a plain sine of the same mean torque by %s", plain);
    }
    hci_html_say(out, "lead",
                 "The drive makes %s on average at %s rpm; its torque varies by %s%s from peak to peak%s.%s",
                 mean, speed, swing[0] == '<' ? "less than" : "", swing + (swing[0] == '<'), before, loss);
}

/* "29.6 → 0.33 %" where there is a before. */
static void tile_of_ripple(hci_output *out, const char *name, double before, double after,
                           const char *formula)
{
    char from[HCI_HTML_NUMBER_SIZE], to[HCI_HTML_NUMBER_SIZE], value[2 * HCI_HTML_NUMBER_SIZE + 8],
        remark[96];
    if (!isfinite(after) || !isfinite(before)) {
        hci_html_tile_number(out, name, after, "%", formula);
        return;
    }
    hci_html_number_text(from, before);
    hci_html_quantity_text(to, after, "%");
    snprintf(value, sizeof value, "%s → %s", from, to);
    snprintf(remark, sizeof remark, "plain sine → this drive; %s", formula);
    hci_html_tile(out, name, value, remark);
}

static void say_verdict(hci_output *out, const hci_simulation *s)
{
    char from[HCI_HTML_NUMBER_SIZE], to[HCI_HTML_NUMBER_SIZE];
    const char *badge = !s->energy_balances ? "Not to be trusted: the energy does not balance"
                        : s->remark.text[0] ? "Done, with a remark"
                                            : "Done";
    hci_html_begin(out, &(hci_html_opening){"Simulation of the drive", badge, badge, s->energy_balances});
    say_facts(out, s);
    hci_html_number_text(from, s->from_s);
    hci_html_number_text(to, s->to_s);
    if (s->periods > 0)
        hci_html_say(out, NULL, "Evaluated from %s s to %s s: %zu whole period%s.", from, to, s->periods,
                     s->periods == 1 ? "" : "s");
    else
        hci_html_say(out, NULL,
                     "Evaluated from %s s to %s s, in which the rotor has not turned one period: there is "
                     "no spectrum.",
                     from, to);
    if (s->remark.text[0]) hci_html_paragraph(out, NULL, s->remark.text);
}

static void show_tiles(hci_output *out, const hci_simulation *s)
{
    hci_html_tiles(out);
    hci_html_tile_number(out, "Mean torque", s->torque_Nm.mean, "N·m", "over the evaluated time");
    tile_of_ripple(out, "T_ripple", hci_page_has_before(s) ? s->plain.T_ripple_percent : (double)NAN,
                   s->T_ripple_percent, "100 (T_max − T_min) / T_mean");
    tile_of_ripple(out, "F_ripple", hci_page_has_before(s) ? s->plain.F_ripple_percent : (double)NAN,
                   s->F_ripple_percent, "100 rms(T − T_mean) / T_mean");
    hci_html_tile_number(out, "Copper loss", s->copper_W, "W", "mean");
    hci_html_tile_number(out, "Peak phase current", s->peak_phase_A, "A", "largest of the phases");
    hci_html_tiles_end(out);
}

static void show_drive(hci_output *out, const hci_simulation *s)
{
    static const char *const COLUMN[] = {"<Quantity", "Value", NULL};
    hci_html_section(out, "The drive");
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
    hci_html_paragraph(out, "quiet", "Numbers: summary.json.");
    hci_html_section_end(out);
}

hci_status hci_page_simulation(hci_output *out, const hci_simulation *s, const hci_traces *traces,
                               const hci_report_sources *sources, hci_note *note)
{
    char origin[HCI_PAGE_ORIGIN_SIZE];
    hci_page_origin(origin, sources);
    say_verdict(out, s);
    show_tiles(out, s);
    hci_status status = hci_page_turn(out, s, &traces->turn, origin, note);
    if (!status) status = hci_page_spectrum(out, s, origin, note);
    if (status) return status;
    hci_page_traces(out, s, traces, origin);
    show_drive(out, s);
    hci_page_show_sources(out, sources);
    hci_html_end(out);
    return HCI_OK;
}
