/* The page of a solution: verdict, the sections, cost and method. */
#include <math.h>
#include <stdio.h>

#include "host/draw/html.h"
#include "host/report/page/solution_sections.h"

/* ---- verdict ---- */

static double mean_Nm(const hci_solution *s)
{
    return hci_page_has_mean(s) ? s->order[0].torque_Nm.cosine : 0.0;
}

/* "by 3.8 N·m", "by less than 1 pN·m" */
static void say_swing(char text[HCI_HTML_NUMBER_SIZE + 16], hci_range r)
{
    char swing[HCI_HTML_NUMBER_SIZE];
    hci_html_quantity_text(swing, r.high - r.low, "N·m");
    snprintf(text, HCI_HTML_NUMBER_SIZE + 16, "by %s%s", swing[0] == '<' ? "less than" : "",
             swing + (swing[0] == '<'));
}

/* The main results, at the top of the page. */
static void say_verdict(const hci_solution_page *p, hci_status verdict)
{
    const hci_solution *s = p->solution;
    const bool is_smooth = p->facts.wanted_Nm.high - p->facts.wanted_Nm.low <= s->tolerance_Nm;
    char mean[HCI_HTML_NUMBER_SIZE], before[HCI_HTML_NUMBER_SIZE + 16], after[HCI_HTML_NUMBER_SIZE + 16],
        loss[128] = "", expected[1024];
    hci_html_quantity_text(mean, mean_Nm(s), "N·m");
    say_swing(before, p->facts.before_Nm);
    say_swing(after, p->facts.after_Nm);
    if (isfinite(s->loss_to_plain)) {
        char ratio[HCI_HTML_NUMBER_SIZE];
        hci_html_number_text(ratio, s->loss_to_plain);
        snprintf(loss, sizeof loss, ", for %s times the copper loss of the plain sine", ratio);
    }
    hci_html_say(
        p->out, "lead",
        "With these currents the machine makes %s on average%s. From peak to peak its torque varies %s, "
        "with a plain sine %s%s.",
        mean,
        !s->within_limits   ? ", but beyond a limit"
        : verdict != HCI_OK ? ", but not all that was asked for"
        : is_smooth         ? " and no ripple, as was asked for"
                            : " and the ripple that was asked for",
        after, before, loss);
    hci_html_paragraph(p->out, NULL, p->facts.verdict);
    hci_expected_ripple_words(&s->expected, expected, sizeof expected);
    hci_html_say(p->out, NULL, "On the real machine: %s", expected);
}

static void show_tiles(const hci_solution_page *p)
{
    const hci_solution *s = p->solution;
    const hci_range before = p->facts.before_Nm, after = p->facts.after_Nm;
    char remark[96], number[HCI_HTML_NUMBER_SIZE];
    hci_html_tiles(p->out);
    hci_html_tile_number(p->out, "Mean torque", mean_Nm(s), "N·m", "electromagnetic, of the model");
    hci_html_quantity_text(number, before.high - before.low, "N·m");
    snprintf(remark, sizeof remark, "before: %s", number);
    hci_html_tile_number(p->out, "Torque, peak to peak", after.high - after.low, "N·m", remark);
    hci_html_number_text(number, s->worst_order);
    snprintf(remark, sizeof remark, "at order %s", number);
    hci_html_tile_number(p->out, "Largest error of an order", s->worst_error_Nm, "N·m", remark);
    hci_html_tile_number(p->out, "Copper loss", s->loss_to_plain, "×", "that of the plain sine");
    hci_html_tile_number(p->out, "Peak phase current", s->peak_phase_current_A, "A", "largest of the phases");
    hci_html_tiles_end(p->out);
}

/* ---- cost and method ---- */

static void show_cost(const hci_solution_page *p)
{
    static const char *const COLUMN[] = {"<Quantity", "Value", NULL};
    const hci_solution *s = p->solution;
    hci_output *out = p->out;
    hci_html_section(out, "What it costs, and how it was found");
    hci_html_table(out, "Cost and limits", COLUMN);
    hci_html_quantity(out, "mean of i_a² + i_b² + i_c² in A²", s->mean_square_A2);
    hci_html_quantity(out, "amplitude of the plain sine in A", s->plain_amplitude_A);
    hci_html_quantity(out, "copper loss to that of the plain sine", s->loss_to_plain);
    hci_html_quantity(out, "copper loss to the least possible", s->loss_to_limit);
    hci_html_quantity(out, "peak phase current in A", s->peak_phase_current_A);
    hci_html_quantity(out, "peak line voltage in V", s->peak_line_voltage_V);
    hci_html_quantity(out, "largest mean torque within the current limit in N·m", s->torque_at_limit_Nm);
    hci_html_table_end(out);
    hci_html_say(out, NULL, "Method: %s; %zu equations for %zu unknowns, rank %zu%s.",
                 hci_method_name(s->method), s->rows, s->unknowns, s->rank,
                 s->newton_steps == 0  ? ""
                 : s->newton_converged ? "; Newton's method converged"
                                       : "; Newton's method did not converge, this is the nearest answer");
    if (s->with_effects) hci_html_paragraph(out, NULL, "The machine is taken with its effects.");
    if (s->remark.text[0]) hci_html_paragraph(out, NULL, s->remark.text);
    hci_html_paragraph(out, "quiet", "Numbers: summary.json.");
    hci_html_section_end(out);
}

/* ---- limits ---- */

static const char *name_of_limit(const hci_limit *l)
{
    static const char *const NAME[] = {"phase current, A", "rms current, A", "line voltage, V",
                                       "mean of i_a² + i_b² + i_c², A²"};
    return NAME[l->kind];
}

/* The angles at which a limit is touched, in degrees. */
static void say_touches(const hci_limit *l, char *text, size_t size)
{
    static const char *const PHASE[] = {"a", "b", "c"}, *const PAIR[] = {"ab", "bc", "ca"};
    size_t used = 0;
    text[0] = '\0';
    for (size_t k = 0; k < l->touch_count && k < HCI_MOST_TOUCHES && used + 24 < size; ++k)
        used += (size_t)snprintf(text + used, size - used, "%s%s %.1f°", k > 0 ? ", " : "",
                                 (l->kind == HCI_LIMIT_VOLTAGE ? PAIR : PHASE)[l->touch[k].phase],
                                 l->touch[k].theta_rad * 180.0 / HCI_PI);
}

static void show_limit(hci_output *out, const hci_limit *l)
{
    static const char *const PHASE[] = {"a", "b", "c"};
    char touches[640];
    say_touches(l, touches, sizeof touches);
    hci_html_row(out);
    hci_html_cell(out, name_of_limit(l));
    hci_html_cell(out, l->phase < 0 ? "all" : PHASE[l->phase]);
    hci_html_number(out, l->limit);
    hci_html_number(out, l->value);
    hci_html_number(out, l->gain);
    hci_html_cell(out, touches);
    hci_html_row_end(out);
}

static void show_limits(const hci_solution_page *p)
{
    static const char *const COLUMN[] = {"<Limit",          "<Phase",      "Allowed", "Largest",
                                         "Gain for 1 more", "<Touched at", NULL};
    static const char *const COST[] = {
        "The currents keep the limits as they are.",
        "The torque is as wanted, for more copper loss. Gain: A² less.",
        "The mean torque is as wanted; its ripple is the smallest within the limits. Gain: N·m less ripple.",
        "The mean torque is the nearest to the wanted one within the limits. Gain: N·m nearer.",
        "No current keeps the limits; this one exceeds all of them by the same share. Gain: share less."};
    const hci_solution *s = p->solution;
    if (s->limit_count == 0) return;
    hci_html_section(p->out, "Limits");
    hci_html_paragraph(
        p->out, NULL,
        s->within_limits || s->limit_cost == HCI_COST_LIMITS
            ? COST[s->limit_cost]
            : "A limit is not kept by these currents: its largest value is above what is allowed.");
    hci_html_table(p->out, "Limits, and what 1 more of each would give", COLUMN);
    for (size_t k = 0; k < s->limit_count; ++k)
        show_limit(p->out, &s->limit[k]);
    hci_html_table_end(p->out);
    hci_html_section_end(p->out);
}

/* ---- the page ---- */

void hci_page_solution(hci_output *out, const hci_solution *s, hci_status verdict,
                       const hci_report_sources *sources)
{
    hci_solution_page p = {.out = out, .solution = s};
    hci_plot_solution_facts(s, &p.facts);
    hci_page_origin(p.origin, sources);
    for (size_t k = 0; k <= HCI_PAGE_STEPS; ++k)
        hci_plot_solution_point(s, hci_page_angle_deg(k) * HCI_PI / 180.0, &p.point[k]);
    hci_html_begin(out, "Currents for a wanted torque", verdict == HCI_OK ? "Reached" : "Not reached",
                   verdict == HCI_OK);
    say_verdict(&p, verdict);
    show_tiles(&p);
    hci_page_torque(&p);
    hci_page_currents(&p);
    show_limits(&p);
    hci_page_system(&p);
    show_cost(&p);
    hci_page_show_sources(out, sources);
    hci_html_end(out);
}
