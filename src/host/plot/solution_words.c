/* The words in the picture of a solution: verdict, facts, and what before is. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/plot/solution_curves.h"

enum { LINE_SIZE = HCI_PLOT_LINE_SIZE };

#define SAME_MEAN 5e-4 /* as a share: less is not seen in four digits */

/* Order 0 comes first where it is there at all. */
static double mean_torque_Nm(const hci_solution *s)
{
    if (s->order_count == 0 || hci_order_number(&s->order[0]) >= HCI_ORDER_TOLERANCE) return 0.0;
    return s->order[0].torque_Nm.cosine;
}

static size_t missed_count(const hci_solution *s)
{
    size_t missed = 0;
    for (size_t k = 0; k < s->order_count; ++k)
        missed += hci_order_is_missed(&s->order[k]);
    return missed;
}

static void missed_line(char line[LINE_SIZE], const hci_solution *s, size_t missed)
{
    char order[HCI_SVG_NUMBER_SIZE], error[HCI_SVG_NUMBER_SIZE], more[HCI_SVG_NUMBER_SIZE] = "";
    hci_svg_short_text(order, s->worst_order);
    hci_svg_axis_text(error, s->worst_error_Nm, "N·m");
    if (missed > 1)
        snprintf(more, sizeof more, ", %zu more order%s missed", missed - 1, missed > 2 ? "s" : "");
    snprintf(line, LINE_SIZE, "Not reached: order %s is off by %s%s%s", order, error, more,
             s->within_limits ? "" : "; a limit is not kept");
}

static void limit_line(char line[LINE_SIZE], const hci_solution *s)
{
    char current[HCI_SVG_NUMBER_SIZE], voltage[HCI_SVG_NUMBER_SIZE];
    hci_svg_axis_text(current, s->peak_phase_current_A, "A");
    hci_svg_axis_text(voltage, s->peak_line_voltage_V, "V");
    snprintf(line, LINE_SIZE, "Over a limit: the wanted torque takes a peak phase current of %s", current);
    if (isfinite(s->peak_line_voltage_V))
        snprintf(line + strlen(line), LINE_SIZE - strlen(line), " and line voltage of %s", voltage);
}

static void verdict_line(char line[LINE_SIZE], const hci_solution *s)
{
    const size_t missed = missed_count(s);
    char tolerance[HCI_SVG_NUMBER_SIZE];
    hci_svg_axis_text(tolerance, s->tolerance_Nm, "N·m");
    if (missed > 0)
        missed_line(line, s, missed);
    else if (!s->within_limits)
        limit_line(line, s);
    else
        snprintf(line, LINE_SIZE, "Reached: every torque order is within %s of what is wanted", tolerance);
}

static void peak_to_peak_text(char text[HCI_SVG_NUMBER_SIZE], const hci_solution_curves *c, size_t curve)
{
    const hci_range r = hci_curve_range(c->value[curve]);
    hci_svg_axis_text(text, r.high - r.low, "N·m");
}

/* Rounding has no order that is worst. */
#define FAR_WITHIN 1e-3 /* of the tolerance */

enum { WORST_SIZE = 128 };

static void worst_error_text(char text[WORST_SIZE], const hci_solution *s)
{
    char error[HCI_SVG_NUMBER_SIZE], order[HCI_SVG_NUMBER_SIZE];
    hci_svg_axis_text(error, s->worst_error_Nm, "N·m");
    hci_svg_short_text(order, s->worst_order);
    if (s->worst_error_Nm < FAR_WITHIN * s->tolerance_Nm)
        snprintf(text, WORST_SIZE, "every order as wanted");
    else
        snprintf(text, WORST_SIZE, "worst error %s at order %s", error, order);
}

static void facts_line(char line[LINE_SIZE], const hci_solution_curves *c)
{
    const hci_solution *s = c->solution;
    char mean[HCI_SVG_NUMBER_SIZE], before[HCI_SVG_NUMBER_SIZE], after[HCI_SVG_NUMBER_SIZE],
        loss[HCI_SVG_NUMBER_SIZE], worst[WORST_SIZE];
    hci_svg_axis_text(mean, mean_torque_Nm(s), "N·m");
    worst_error_text(worst, s);
    peak_to_peak_text(before, c, HCI_CURVE_BEFORE);
    peak_to_peak_text(after, c, HCI_CURVE_AFTER);
    snprintf(line, LINE_SIZE, "mean torque %s · %s · peak to peak %s before, %s after", mean, worst, before,
             after);
    if (!isfinite(s->loss_to_plain)) return;
    hci_svg_short_text(loss, s->loss_to_plain);
    snprintf(line + strlen(line), LINE_SIZE - strlen(line), " · copper loss × %s", loss);
}

/* What the plain sine makes, which with saturation is not the mean that its back-EMF alone would make. */
static void plain_line(char line[LINE_SIZE], const hci_solution *s, const char *plain)
{
    char made[HCI_SVG_NUMBER_SIZE];
    const bool has_mean = s->order_count > 0 && hci_order_number(&s->order[0]) < HCI_ORDER_TOLERANCE;
    const double made_Nm = has_mean ? s->order[0].before_Nm.cosine : 0.0,
                 wanted_Nm = has_mean ? s->order[0].target_Nm.cosine : 0.0;
    hci_svg_axis_text(made, made_Nm, "N·m");
    if (fabs(made_Nm - wanted_Nm) <= SAME_MEAN * fabs(wanted_Nm))
        snprintf(line, LINE_SIZE, "Before: a plain sine of %s with the wanted mean torque", plain);
    else
        snprintf(line, LINE_SIZE,
                 "Before: a plain sine of %s, of which the back-EMF alone would make the wanted mean torque "
                 "and the machine makes %s",
                 plain, made);
}

static void baseline_line(char line[LINE_SIZE], const hci_solution_curves *c)
{
    const hci_solution *s = c->solution;
    char plain[HCI_SVG_NUMBER_SIZE], limit[HCI_SVG_NUMBER_SIZE];
    hci_svg_axis_text(plain, s->plain_amplitude_A, "A");
    if (!(s->plain_amplitude_A > 0.0)) {
        snprintf(line, LINE_SIZE,
                 "Before: no current, since no mean torque is wanted; what is left is cogging.");
        return;
    }
    if (s->plain_is_held)
        snprintf(line, LINE_SIZE, "Before: the held fundamental of %s alone", plain);
    else
        plain_line(line, s, plain);
    snprintf(line + strlen(line), LINE_SIZE - strlen(line), ". Copper loss is relative to that of this %s",
             s->plain_is_held ? "fundamental" : "sine");
    if (isfinite(s->loss_to_limit) && missed_count(s) == 0) {
        hci_svg_fixed_text(limit, fmin(s->loss_to_limit, 1e6), 3);
        snprintf(line + strlen(line), LINE_SIZE - strlen(line), ", and is %s × the least possible", limit);
    }
    snprintf(line + strlen(line), LINE_SIZE - strlen(line), ".");
}

void hci_solution_curve_words(const hci_solution_curves *c, hci_plot_facts *f)
{
    verdict_line(f->verdict, c->solution);
    facts_line(f->facts, c);
    baseline_line(f->baseline, c);
    f->before_Nm = hci_curve_range(c->value[HCI_CURVE_BEFORE]);
    f->wanted_Nm = hci_curve_range(c->value[HCI_CURVE_WANTED]);
    f->after_Nm = hci_curve_range(c->value[HCI_CURVE_AFTER]);
    for (size_t k = 0; k < 3; ++k)
        f->phase_A[k] = hci_curve_range(c->value[HCI_CURVE_PHASE_A + k]);
    f->plain_dq_A = hci_curve_vector(&c->solution->plain, 1, 0.0);
    hci_curve_vector_ranges(c, f);
}
