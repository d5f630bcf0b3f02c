/* What the page of a solution says first: the verdict, and before and after in large figures. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/machine/expected_ripple.h"
#include "host/report/page/solution_sections.h"

enum { CELL_SIZE = 128 };

static bool has_mean(const hci_solution *s)
{
    return s->order_count > 0 && s->order[0].torque_Nm.order < HCI_ORDER_TOLERANCE;
}

static double mean_Nm(const hci_solution *s)
{
    return has_mean(s) ? s->order[0].torque_Nm.cosine : 0.0;
}

static double swing_Nm(hci_range r)
{
    return r.high - r.low;
}

void hci_page_swing(char text[HCI_PAGE_SWING_SIZE], hci_range r, double tolerance_Nm)
{
    char swing[HCI_HTML_NUMBER_SIZE];
    hci_html_quantity_text(swing, fmax(swing_Nm(r), tolerance_Nm), "N·m");
    const bool is_tiny = strncmp(swing, "< ", 2) == 0;
    snprintf(text, HCI_PAGE_SWING_SIZE, "%s%s", is_tiny || swing_Nm(r) < tolerance_Nm ? "less than " : "",
             swing + (is_tiny ? 2 : 0));
}

bool hci_page_has_plain(const hci_solution *s)
{
    return s->plain_amplitude_A > 0.0;
}

/* ---- the verdict ---- */

static bool is_smooth_wish(const hci_solution_page *p)
{
    return swing_Nm(p->facts.wanted_Nm) <= p->solution->tolerance_Nm;
}

static bool misses_the_mean(const hci_solution *s)
{
    return has_mean(s) && s->order[0].verdict > HCI_ORDER_FREE;
}

static void heading_of(const hci_solution_page *p, hci_status verdict, char text[512])
{
    const hci_solution *s = p->solution;
    char mean[HCI_HTML_NUMBER_SIZE], wanted[HCI_HTML_NUMBER_SIZE], swing[HCI_PAGE_SWING_SIZE];
    hci_html_quantity_text(mean, mean_Nm(s), "N·m");
    hci_html_quantity_text(wanted, has_mean(s) ? s->order[0].target_Nm.cosine : 0.0, "N·m");
    hci_page_swing(swing, p->facts.after_Nm, s->tolerance_Nm);
    if (verdict == HCI_OK)
        snprintf(text, 512, is_smooth_wish(p) ? "%s without ripple" : "%s with the ripple that was asked for",
                 mean);
    else if (misses_the_mean(s))
        snprintf(text, 512, "%s on average, where %s was asked for", mean, wanted);
    else if (!s->within_limits)
        snprintf(text, 512, "%s takes more than a limit allows", mean);
    else
        snprintf(text, 512, "%s, with %s of ripple from peak to peak", mean, swing);
}

void hci_page_ratio(char text[HCI_HTML_NUMBER_SIZE], double ratio)
{
    snprintf(text, HCI_HTML_NUMBER_SIZE, "%.4g", ratio);
}

/* ---- before and after ---- */

/* A mean that is less than this share of the ripple is none to take a percentage of. */
#define NO_MEAN 0.1

/* "3.775 N·m|153 % of the mean" */
static void cell_of_ripple(char text[CELL_SIZE], const hci_solution *s, double swing, double mean)
{
    char percent[HCI_HTML_NUMBER_SIZE], in_Nm[HCI_PAGE_SWING_SIZE];
    hci_page_swing(in_Nm, (hci_range){0.0, swing}, s->tolerance_Nm);
    hci_html_number_text(percent, 100.0 * swing / fabs(mean));
    if (fabs(mean) > NO_MEAN * swing && swing >= s->tolerance_Nm)
        snprintf(text, CELL_SIZE, "%s|%s %% of the mean", in_Nm, percent);
    else
        snprintf(text, CELL_SIZE, "%s", in_Nm);
}

/* As the sentences below the table say it. */
static void cell_of_bound(char text[CELL_SIZE], const hci_solution_page *p)
{
    const hci_solution *s = p->solution;
    const double bound_Nm = hci_ripple_bound_as_said(s->expected.peak_to_peak_Nm);
    char in_Nm[HCI_PAGE_SWING_SIZE];
    if (hci_solution_is_boundless(p->solution)) {
        snprintf(text, CELL_SIZE, "not known|bounded by no less than the torque itself");
        return;
    }
    hci_page_swing(in_Nm, (hci_range){0.0, bound_Nm}, s->tolerance_Nm);
    snprintf(text, CELL_SIZE, "at most %s", in_Nm);
    if (fabs(mean_Nm(s)) > NO_MEAN * bound_Nm && bound_Nm >= s->tolerance_Nm)
        snprintf(text + strlen(text), CELL_SIZE - strlen(text), "|%s %% of the mean (95 %%)",
                 HCI_PERCENT(hci_ripple_bound_as_said(s->expected.T_ripple_percent), 2));
    else
        snprintf(text + strlen(text), CELL_SIZE - strlen(text), "|95 %%");
    if (s->expected.if_in_time)
        snprintf(text + strlen(text), CELL_SIZE - strlen(text), ", if the torque sensor is in time");
}

static void row_of(hci_output *out, const char *name, const char *before, const char *after,
                   const char *machine)
{
    hci_html_compare_row(out, name, (const char *const[]){before, after, machine, NULL});
}

/* "1.2 N·m|at most 0.01 N·m off (95 %)", where a torque was measured. */
static void cell_of_mean(char text[CELL_SIZE], const hci_solution *s)
{
    const hci_expected_ripple *e = &s->expected;
    char mean[HCI_HTML_NUMBER_SIZE], off[HCI_HTML_NUMBER_SIZE];
    snprintf(text, CELL_SIZE, "|not known");
    if (e->state != HCI_RIPPLE_KNOWN || !isfinite(e->mean_error_Nm)) return;
    hci_html_quantity_text(mean, e->mean_Nm, "N·m");
    hci_html_quantity_text(off, hci_ripple_bound_as_said(e->mean_error_Nm), "N·m");
    snprintf(text, CELL_SIZE, "%s|at most %s off (95 %%)", mean, off);
}

static void row_of_mean(const hci_solution_page *p)
{
    const hci_solution *s = p->solution;
    char before[CELL_SIZE], after[HCI_HTML_NUMBER_SIZE], machine[CELL_SIZE];
    hci_html_quantity_text(before, has_mean(s) ? s->order[0].before_Nm.cosine : 0.0, "N·m");
    hci_html_quantity_text(after, mean_Nm(s), "N·m");
    cell_of_mean(machine, s);
    row_of(p->out, "Mean torque", before, after, machine);
}

/* Whether recordings say that the figures hold for the model alone. */
static bool is_of_model(const hci_expected_ripple *e)
{
    return hci_expected_ripple_is_doubtful(e) ||
           (e->state != HCI_RIPPLE_KNOWN && e->state != HCI_RIPPLE_NO_RECORDINGS);
}

static void row_of_ripple(const hci_solution_page *p)
{
    const hci_solution *s = p->solution;
    char before[CELL_SIZE], after[CELL_SIZE], machine[CELL_SIZE] = "|not known";
    if (p->ripple_is_unknown) {
        row_of(p->out, "Torque ripple, peak to peak", "not known", "not known", machine);
        return;
    }
    cell_of_ripple(before, s, swing_Nm(p->facts.before_Nm), has_mean(s) ? s->order[0].before_Nm.cosine : 0.0);
    cell_of_ripple(after, s, swing_Nm(p->facts.after_Nm), mean_Nm(s));
    if (s->expected.state == HCI_RIPPLE_KNOWN) cell_of_bound(machine, p);
    row_of(p->out,
           is_of_model(&s->expected) ? "Torque ripple in the model, peak to peak"
                                     : "Torque ripple, peak to peak",
           before, after, machine);
}

static void row_of_currents(const hci_solution_page *p)
{
    const hci_solution *s = p->solution;
    char before[CELL_SIZE] = "0 A", after[HCI_HTML_NUMBER_SIZE], ratio[HCI_HTML_NUMBER_SIZE],
         times[HCI_HTML_NUMBER_SIZE + 8];
    if (hci_page_has_plain(s)) hci_html_quantity_text(before, s->plain_amplitude_A, "A");
    hci_html_quantity_text(after, s->peak_phase_current_A, "A");
    row_of(p->out, "Peak phase current", before, after, "|the same, if the current loop follows");
    if (!isfinite(s->loss_to_plain)) return;
    hci_page_ratio(ratio, s->loss_to_plain);
    snprintf(times, sizeof times, "%.40s ×", ratio);
    row_of(p->out, "Copper loss", "1 ×", times, "|the same");
}

static void row_of_voltage(const hci_solution_page *p)
{
    char after[HCI_HTML_NUMBER_SIZE];
    if (!isfinite(p->solution->peak_line_voltage_V)) return;
    hci_html_quantity_text(after, p->solution->peak_line_voltage_V, "V");
    row_of(p->out, "Peak line voltage", "–", after, "–");
}

void hci_page_before_and_after(const hci_solution_page *p)
{
    const hci_solution *s = p->solution;
    const char *const column[] = {!hci_page_has_plain(s) ? "Before: no current"
                                  : s->plain_is_held     ? "Before: held fundamental"
                                                         : "Before: plain sine",
                                  "After: in the model", "After: to expect on the machine", NULL};
    hci_html_compare(p->out, column);
    row_of_mean(p);
    row_of_ripple(p);
    row_of_currents(p);
    row_of_voltage(p);
    hci_html_compare_end(p->out);
}

/* What a bound is made of is of interest to some; that it is not known, or that a current was never recorded,
 * is to all. */
void hci_page_expectation(const hci_solution_page *p)
{
    const hci_expected_ripple *e = &p->solution->expected;
    const bool is_boundless = hci_solution_is_boundless(p->solution);
    const bool is_plain = e->state == HCI_RIPPLE_KNOWN && !is_boundless && !(e->outside_share > 0.0) &&
                          !e->speed_outside && !hci_expected_ripple_is_doubtful(e);
    char expected[1024];
    hci_expected_ripple_words(e, expected, sizeof expected);
    if (is_boundless)
        snprintf(expected, sizeof expected,
                 "Ripple not known: the recordings bound it by no less than the torque itself.");
    if (is_plain) hci_html_fold(p->out, "What the bound on the machine is made of");
    hci_html_say(p->out, "quiet", "On the real machine: %s", expected);
    if (is_plain) hci_html_fold_end(p->out);
}

static void say_loop(const hci_solution_page *p)
{
    char reach[1024];
    hci_loop_reach_words(&p->solution->loop, reach, sizeof reach);
    if (reach[0]) hci_html_say(p->out, "quiet", "In a drive: %s.", reach);
}

void hci_page_solution_verdict(const hci_solution_page *p, hci_status verdict, const char *machine)
{
    const bool is_doubtful = hci_expected_ripple_is_doubtful(&p->solution->expected);
    char heading[512], kicker[512];
    heading_of(p, verdict, heading);
    snprintf(kicker, sizeof kicker, "Currents for a wanted torque · %s", machine ? machine : "");
    hci_html_begin(p->out,
                   &(hci_html_opening){kicker,
                                       verdict != HCI_OK ? "Not reached"
                                       : is_doubtful     ? "Reached in a model that is not to be relied on"
                                                         : "Reached",
                                       heading, verdict == HCI_OK && !is_doubtful});
    hci_page_before_and_after(p);
    hci_page_expectation(p);
    say_loop(p);
    if (p->solution->remark.text[0]) hci_html_say(p->out, "quiet", "Remark: %s.", p->solution->remark.text);
}
