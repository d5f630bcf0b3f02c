#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/solve/solve_words.h"
#include "cli/terminal/chart.h"
#include "cli/terminal/rows.h"
#include "cli/terminal/say.h"
#include "cli/terminal/text.h"
#include "hci/host/base/number.h"

/* ---- spectrum ---- */

static double amplitude(hci_harmonic h)
{
    return h.order < HCI_ORDER_TOLERANCE ? fabs(h.cosine) : hypot(h.sine, h.cosine);
}

/* Of the ripple: order 0 has a line of its own. */
static double largest_of(const void *solution, size_t k)
{
    const hci_solved_order *o = &((const hci_solution *)solution)->order[k];
    if (o->torque_Nm.order < HCI_ORDER_TOLERANCE) return 0.0;
    return fmax(amplitude(o->target_Nm), fmax(amplitude(o->torque_Nm), amplitude(o->before_Nm)));
}

typedef struct {
    const hci_solution *solution;
    double largest_Nm;
    size_t pick[CLI_MOST_ROWS];
} spectrum;

static void spectrum_row(const void *context, size_t row, cli_cell cell[])
{
    const spectrum *s = context;
    const hci_solved_order *o = &s->solution->order[s->pick[row]];
    const double before_Nm = amplitude(o->before_Nm), after_Nm = amplitude(o->torque_Nm);
    snprintf(cell[0].text, sizeof cell[0].text, "%.5g", o->torque_Nm.order);
    cli_number_text(before_Nm, s->largest_Nm, cell[1].text, sizeof cell[1].text);
    cell[2].value = before_Nm;
    cli_number_text(amplitude(o->target_Nm), s->largest_Nm, cell[3].text, sizeof cell[3].text);
    cli_number_text(after_Nm, s->largest_Nm, cell[4].text, sizeof cell[4].text);
    cell[5].value = after_Nm;
}

static void show_spectrum(const hci_solution *s)
{
    static const cli_column COLUMNS[] = {{CLI_RIGHT, "order"},  {CLI_RIGHT, "before"}, {CLI_BAR, ""},
                                         {CLI_RIGHT, "wanted"}, {CLI_RIGHT, "after"},  {CLI_BAR, ""}};
    char caption[160], baseline[64] = "no current";
    spectrum x = {.solution = s};
    size_t left_out;
    const size_t rows = cli_pick(largest_of, s, s->order_count, 1e-3, x.pick, &left_out);
    for (size_t k = 0; k < rows; ++k)
        x.largest_Nm = fmax(x.largest_Nm, largest_of(s, x.pick[k]));
    if (s->plain_amplitude_A > 0.0)
        snprintf(baseline, sizeof baseline, "the plain fundamental of %.4g A", s->plain_amplitude_A);
    snprintf(caption, sizeof caption, "torque ripple by electrical order, N·m (peak); before: %s", baseline);
    cli_draw(&(cli_chart){.caption = caption,
                          .column = COLUMNS,
                          .columns = 6,
                          .rows = rows,
                          .fill = spectrum_row,
                          .context = &x,
                          .unit = "N·m"});
    if (left_out > 0) cli_say("  and %zu smaller ones: spectrum.csv\n", left_out);
}

/* ---- words ---- */

static void show_failures(const hci_solution *s, hci_order_verdict verdict, const char *words)
{
    int shown = 0, total = 0;
    for (size_t k = 0; k < s->order_count; ++k)
        total += s->order[k].verdict == verdict;
    if (total == 0) return;
    cli_say("  %-12s %s:", hci_order_verdict_name(verdict), words);
    for (size_t k = 0; k < s->order_count && shown < 8; ++k) {
        const hci_solved_order *o = &s->order[k];
        if (o->verdict != verdict) continue;
        cli_say("%s order %g off by %.3g N·m", shown++ ? "," : "", o->torque_Nm.order, o->error_Nm);
        if (hci_remedy_exists(o))
            cli_say(" (%s %g would reach it)",
                    o->remedy.sequence < 0 ? "neg"
                    : o->remedy.sequence   ? "pos"
                                           : "zero",
                    o->remedy.order);
    }
    cli_say("%s\n", shown < total ? ", …" : "");
}

static double top_order(const hci_solution *s)
{
    double top = 0.0;
    for (size_t k = 0; k < s->current.count; ++k)
        top = fmax(top, s->current.wave[k].order);
    return top;
}

static void show_system(const hci_solution *s)
{
    if (s->rows == 0) return;
    cli_say("  system       %zu equations, %zu unknowns, rank %zu, ", s->rows, s->unknowns, s->rank);
    if (isfinite(s->condition)) cli_say("condition about %.2g, ", s->condition);
    cli_say("solved by %s\n", hci_method_name(s->method));
}

static void show_newton(const hci_solution *s)
{
    if (s->newton_steps > 0)
        cli_say("  newton       %s%zu steps, last change %.2g of the current\n",
                s->newton_converged ? "" : "not converged: ", s->newton_steps, s->newton_change);
}

static void show_gaps(const hci_solution *s)
{
    if (s->gap_count == 0) return;
    cli_say("  no current   at %zu range%s of angle (electrical degrees):", s->gap_count,
            s->gap_count == 1 ? "" : "s");
    for (size_t k = 0; k < s->gap_count && k < 6; ++k)
        cli_say(" %.1f–%.1f", s->gap[k].from_rad * 180.0 / HCI_PI, s->gap[k].to_rad * 180.0 / HCI_PI);
    cli_say("%s\n", s->gap_count > 6 ? " …" : "");
    if (isfinite(s->least_iq_A) && s->least_iq_A > 0.0)
        cli_say("               from i_q = %.4g A on there is one at every angle\n", s->least_iq_A);
}

/* Copper loss beside that of the shortest current at each angle. */
static void show_least(double ratio)
{
    if (ratio >= 2.0)
        cli_say("%.3g × the least that the wanted torque takes", ratio);
    else if (ratio >= 1.0005)
        cli_say("%s %% above the least that the wanted torque takes", HCI_PERCENT(100.0 * (ratio - 1.0), 2));
    else if (ratio > 0.9995)
        cli_say("the least that the wanted torque takes");
    else
        cli_say("%s %% less than the wanted torque takes at every angle: orders that are free or not made "
                "save it",
                HCI_PERCENT(100.0 * (1.0 - ratio), 2));
}

/* Whether a phase is limited to no current. */
static bool has_open_phase(const hci_solution *s)
{
    bool open = false;
    for (size_t k = 0; k < s->limit_count; ++k)
        open = open || (s->limit[k].kind == HCI_LIMIT_CURRENT && !(s->limit[k].limit > 0.0));
    return open;
}

static void show_current(const hci_solution *s)
{
    const bool to_plain = isfinite(s->loss_to_plain), to_limit = isfinite(s->loss_to_limit);
    cli_say("  currents     %zu component%s up to order %g, peak phase current %.4g A\n", s->current.count,
            s->current.count == 1 ? "" : "s", top_order(s), s->peak_phase_current_A);
    if (isfinite(s->rms_neutral_A))
        cli_say("  neutral      peak %.4g A, rms %.4g A\n", s->peak_neutral_A, s->rms_neutral_A);
    if (!to_plain && !to_limit) return;
    cli_say("  copper loss  ");
    if (to_plain)
        cli_say("%.4g × the plain fundamental of %.4g A%s", s->loss_to_plain, s->plain_amplitude_A,
                s->limit_cost == HCI_COST_TORQUE ? " that the wanted mean takes" : "");
    if (to_plain && to_limit) cli_say("; ");
    if (to_limit) show_least(s->loss_to_limit);
    cli_say("%s\n", has_open_phase(s) ? ", with all phases" : "");
}

/* Of the largest i_q: an i_d that was meant to be 0. */
static const double NO_ID = 0.02;

static double largest_A(hci_measured_range x)
{
    return fmax(fabs(x.least), fabs(x.most));
}

/* Whether an i_d is to flow although all recordings had next to none. */
static bool is_new_id(const hci_expected_ripple *e)
{
    const double most_A = NO_ID * largest_A(e->measured_iq_A);
    return e->state == HCI_RIPPLE_KNOWN && e->outside_share > 0.0 && largest_A(e->measured_id_A) < most_A &&
           largest_A(e->id_A) > most_A;
}

/* What of it holds for currents that flow as they are. */
static void show_loop(const hci_loop_reach *l)
{
    char words[512];
    hci_loop_reach_words(l, words, sizeof words);
    if (!words[0]) return;
    cli_say("  current loop\n");
    cli_say_paragraph(4, words);
    if (l->leaves_out_back_emf)
        cli_say_paragraph(4,
                          "What harmonics of the back-EMF drive through the loop comes on top: machine.csv "
                          "has no inductance.");
}

static void show_expected(const hci_solution *s)
{
    char words[1024];
    hci_expected_ripple_words(&s->expected, words, sizeof words);
    if (hci_solution_is_boundless(s))
        snprintf(words, sizeof words,
                 "Ripple not known: the recordings bound it by no less than the torque itself.");
    cli_say("  on the real machine\n");
    cli_say_paragraph(4, words);
    if (is_new_id(&s->expected))
        cli_say_paragraph(4,
                          "No recording has an i_d: --method pointwise --current-angle 0 does without it.");
    show_loop(&s->loop);
    if (!s->corrections[0]) return;
    cli_say("  sensors\n");
    cli_say_paragraph(4,
                      "This holds for the true angle and the true current. A drive with the sensors of the "
                      "recordings has to correct what they read, in the order of these lines:");
    for (const char *line = s->corrections; *line != '\0'; line += strcspn(line, "\n") + 1) {
        cli_say("      %.*s\n", (int)strcspn(line, "\n"), line);
        if (strchr(line, '\n') == NULL) break;
    }
}

/* Copper is a loss where the resistance is known. */
static bool is_loss(const hci_solution *s, const hci_limit *l)
{
    return l->kind == HCI_LIMIT_COPPER && s->resistance_ohm > 0.0;
}

/* "phase current a", "line voltage" */
static const char *name_of(const hci_solution *s, const hci_limit *l)
{
    static const char *const PHASE[] = {"phase current a", "phase current b", "phase current c"};
    static const char *const RMS[] = {"rms current a", "rms current b", "rms current c"};
    if (l->kind == HCI_LIMIT_CURRENT) return l->phase < 0 ? "phase current" : PHASE[l->phase];
    if (l->kind == HCI_LIMIT_RMS) return l->phase < 0 ? "rms current" : RMS[l->phase];
    if (is_loss(s, l)) return "copper loss";
    if (l->kind != HCI_LIMIT_VOLTAGE) return "mean of i_a² + i_b² + i_c²";
    static const char *const VOLTAGE[] = {"line voltage", "2 × phase voltage", "√3 × voltage vector"};
    return VOLTAGE[l->modulation];
}

static const char *unit_of(const hci_solution *s, const hci_limit *l)
{
    if (is_loss(s, l)) return "W";
    return l->kind == HCI_LIMIT_VOLTAGE ? "V" : l->kind == HCI_LIMIT_COPPER ? "A²" : "A";
}

/* Of the unit that is shown, for 1 of the limit's own. */
static double scale_of(const hci_solution *s, const hci_limit *l)
{
    return is_loss(s, l) ? s->resistance_ohm : 1.0;
}

/* Share of the mean torque above which the ripple beside the largest mean is spoken of. */
static const double MUCH_RIPPLE = 0.01;

/* "; 1 A more: 0.12 N·m less ripple" */
static void show_gain(const hci_solution *s, const hci_limit *l)
{
    static const char *const WHAT[] = {"", "A² less copper", "N·m less ripple",
                                       "N·m nearer to the wanted mean", "% less to widen all limits by"};
    if (!l->binds) return;
    if (!isfinite(l->gain)) {
        cli_say("; what more of it gives is not known");
        return;
    }
    cli_say("; 1 %s more%s: %.3g %s", unit_of(s, l), l->kind == HCI_LIMIT_VOLTAGE ? " of dc link" : "",
            (s->limit_cost == HCI_COST_LIMITS ? 100.0 : 1.0) * l->gain / scale_of(s, l), WHAT[s->limit_cost]);
}

static void show_touches(const hci_limit *l)
{
    const size_t shown = l->touch_count < 6 ? l->touch_count : 6;
    if (!l->binds || shown == 0) return;
    cli_say("\n               touched at");
    for (size_t k = 0; k < shown; ++k)
        cli_say("%s %s %.1f°", k > 0 ? "," : "", hci_limit_place_name(l, l->touch[k].phase),
                l->touch[k].theta_rad * 180.0 / HCI_PI);
    if (l->touch_count > shown) cli_say(" and at %zu more angles", l->touch_count - shown);
}

static void show_limit(const hci_solution *s, const hci_limit *l)
{
    const double scale = scale_of(s, l);
    cli_say("  limit        %s %.4g of %.4g %s%s", name_of(s, l), scale * l->value, scale * l->limit,
            unit_of(s, l), l->is_declared ? " (machine.csv)" : "");
    show_gain(s, l);
    show_touches(l);
    cli_say("\n");
}

static const char *measure_of(hci_minimise minimise)
{
    if (minimise == HCI_MINIMISE_PEAK_TO_PEAK) return "the ripple, peak to peak,";
    return minimise == HCI_MINIMISE_RMS ? "the rms of the ripple" : "the largest order of the ripple";
}

/* The mean comes first, whatever it costs in ripple. */
static void show_trade(const hci_solution *s, double mean_Nm)
{
    if (s->worst_error_Nm <= MUCH_RIPPLE * fabs(mean_Nm) || s->worst_order < HCI_ORDER_TOLERANCE) return;
    cli_say("               the mean comes before the ripple, %.3g N·m at order %g: a little less of it may "
            "leave\n"
            "               much less ripple (sweep --envelope --ripple 1 finds the most with little)\n",
            s->worst_error_Nm, s->worst_order);
}

/* What the limits cost, in a sentence. */
static void show_cost(const hci_solution *s)
{
    const double mean_Nm = s->order_count ? s->order[0].torque_Nm.cosine : 0.0;
    if (s->limit_cost == HCI_COST_COPPER) cli_say("  limits       kept; they cost copper only\n");
    if (s->limit_cost == HCI_COST_RIPPLE)
        cli_say("  limits       kept; %s is the smallest within them%s with these components (%.4g N·m%s)\n",
                measure_of(s->minimised), s->newton_steps > 0 ? " that was found" : "", s->minimised_Nm,
                s->newton_steps > 0 ? ", near these currents; others may have less" : "");
    if (s->limit_cost == HCI_COST_TORQUE) {
        cli_say(
            "  limits       kept; %.6g N·m is the mean torque nearest to %.6g N·m within them that was found "
            "with these components\n",
            mean_Nm, s->wanted_mean_Nm);
        show_trade(s, mean_Nm);
    }
    if (s->limit_cost == HCI_COST_LIMITS)
        cli_say("  limits       no current keeps them; the given one would with all of them wider by %s %%\n",
                HCI_PERCENT(100.0 * s->exceeded_share, 3));
}

static void show_limits(const hci_solution *s)
{
    if (isfinite(s->peak_line_voltage_V))
        cli_say("  voltage      peak line voltage %.4g V%s\n", s->peak_line_voltage_V,
                isfinite(s->rms_neutral_A) ? "; that of a phase against the neutral is not limited" : "");
    if (s->within_limits || s->limit_cost == HCI_COST_LIMITS) show_cost(s);
    if (!s->within_limits && s->limit_cost != HCI_COST_LIMITS) {
        cli_say("  limits       not kept%s",
                s->method == HCI_METHOD_POINTWISE
                    ? ": --method pointwise does not take limits into account, it only checks them"
                    : "");
        if (isfinite(s->torque_at_limit_Nm))
            cli_say("; a mean torque of %.4g N·m would keep the current limit", s->torque_at_limit_Nm);
        cli_say("\n");
    }
    for (size_t k = 0; k < s->limit_count; ++k)
        show_limit(s, &s->limit[k]);
}

/* T_ripple in per cent below which its value says nothing. */
static const double LEAST_PERCENT = 1e-4;

/* An error that is rounding is none. */
static const double ROUNDING = 1e-3;

static void show_torque(const hci_solution *s, bool reached)
{
    const double mean_Nm = s->order_count ? s->order[0].torque_Nm.cosine : 0.0;
    cli_say("  torque       mean %.6g N·m; ", fabs(mean_Nm) < ROUNDING * s->tolerance_Nm ? 0.0 : mean_Nm);
    if (reached && s->worst_error_Nm < ROUNDING * s->tolerance_Nm)
        cli_say("every order as wanted, far within the tolerance of %.3g N·m\n", s->tolerance_Nm);
    else
        cli_say("worst error %.3g N·m at order %g (tolerance %.3g N·m)\n", s->worst_error_Nm, s->worst_order,
                s->tolerance_Nm);
}

/* Peak to peak over the mean. */
static void show_ripple(const hci_solution *s)
{
    if (!isfinite(s->T_ripple_percent)) return;
    cli_say("  T_ripple     ");
    if (s->T_ripple_percent < LEAST_PERCENT)
        cli_say("below %s %%", HCI_PERCENT(LEAST_PERCENT, 6));
    else
        cli_say("%s %%", HCI_PERCENT(s->T_ripple_percent, 3));
    if (isfinite(s->T_ripple_before_percent))
        cli_say("; of the plain fundamental %s %%", HCI_PERCENT(s->T_ripple_before_percent, 3));
    cli_say("\n");
}

void cli_show_solution(const hci_solution *s, const char *machine, const char *target)
{
    const bool doubtful = hci_expected_ripple_is_doubtful(&s->expected);
    bool reached = true;
    for (size_t k = 0; k < s->order_count; ++k)
        reached = reached && s->order[k].verdict <= HCI_ORDER_FREE;
    cli_say("%s%s" CLI_PLAIN "%s%s: %s, %s\n",
            !reached                        ? CLI_BAD
            : s->within_limits && !doubtful ? CLI_GOOD
                                            : CLI_WARN,
            reached ? "reached" : "not reached",
            !reached   ? " (the nearest is given)"
            : doubtful ? " in a model that is not to be relied on"
                       : "",
            s->within_limits ? "" : ", but a limit is not kept", machine, target);
    show_torque(s, reached);
    show_ripple(s);
    show_expected(s);
    show_current(s);
    show_limits(s);
    show_system(s);
    show_newton(s);
    show_gaps(s);
    show_failures(s, HCI_ORDER_UNREACHABLE, "no component of the set reaches");
    show_failures(s, HCI_ORDER_MISSED, "compared, not met");
    show_failures(s, HCI_ORDER_PARASITIC, "not compared, not met");
    show_spectrum(s);
}
