#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli.h"

int cli_fail(hci_status status, const hci_note *note)
{
    cli_progress_end();
    fprintf(stderr, "hci-solve: %s\n", note->text[0] ? note->text : hci_status_text(status));
    return hci_status_exit_code(status);
}

void cli_remark(const hci_note *remark)
{
    if (remark->text[0]) fprintf(stderr, "hci-solve: note: %s\n", remark->text);
}

/* ---- progress ---- */

static struct {
    bool started, shown;
    struct timespec start;
    double last_s;
} bar;

static double seconds_since(const struct timespec *start)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)(now.tv_sec - start->tv_sec) + 1e-9 * (double)(now.tv_nsec - start->tv_nsec);
}

void cli_progress(void *context, const char *what, double share)
{
    double elapsed_s;
    (void)context;
    if (!isatty(STDERR_FILENO)) return;
    if (!bar.started) {
        bar.started = true;
        clock_gettime(CLOCK_MONOTONIC, &bar.start);
    }
    elapsed_s = seconds_since(&bar.start);
    if (elapsed_s < 1.0 || elapsed_s - bar.last_s < 0.1) return;
    bar.last_s = elapsed_s;
    bar.shown = true;
    fprintf(stderr, "\r%s %3.0f %%, %.0f s left\033[K", what, 100.0 * share,
            share > 0.01 ? elapsed_s * (1.0 - share) / share : 0.0);
}

void cli_progress_end(void)
{
    if (bar.shown) fprintf(stderr, "\r\033[K");
    bar.shown = bar.started = false;
}

/* ---- a solution ---- */

enum { BAR_WIDTH = 30, MOST_ROWS = 16 };

static double amplitude(hci_harmonic h)
{
    return h.order < HCI_ORDER_TOLERANCE ? fabs(h.cosine) : hypot(h.sine, h.cosine);
}

static double largest_of(const hci_solved_order *o)
{
    return fmax(amplitude(o->target_Nm), fmax(amplitude(o->torque_Nm), amplitude(o->before_Nm)));
}

/* Rows worth showing: the largest ones above order 0. Returns the threshold that at most MOST_ROWS orders
 * pass. */
static double threshold_Nm(const hci_solution *s, double largest_Nm)
{
    double threshold = 1e-3 * largest_Nm;
    for (size_t shown = MOST_ROWS + 1; shown > MOST_ROWS; threshold *= 1.25) {
        shown = 0;
        for (size_t k = 0; k < s->order_count; ++k)
            shown +=
                s->order[k].torque_Nm.order >= HCI_ORDER_TOLERANCE && largest_of(&s->order[k]) >= threshold;
        if (shown <= MOST_ROWS) break;
    }
    return threshold;
}

static void draw_bar(double value, double largest)
{
    const int length = largest > 0.0 ? (int)(BAR_WIDTH * value / largest + 0.5) : 0;
    for (int k = 0; k < BAR_WIDTH; ++k)
        fputc(k < length ? '#' : ' ', stderr);
}

static void show_spectrum(const hci_solution *s)
{
    double largest = 0.0, threshold;
    for (size_t k = 0; k < s->order_count; ++k)
        if (s->order[k].torque_Nm.order >= HCI_ORDER_TOLERANCE)
            largest = fmax(largest, largest_of(&s->order[k]));
    if (largest <= 0.0) return;
    threshold = threshold_Nm(s, largest);
    fprintf(stderr, "\n  torque ripple in N·m (peak) by electrical order; before: the plain fundamental\n");
    fprintf(stderr, "  %7s %8s %-*s %8s %8s %-*s\n", "order", "before", BAR_WIDTH, "", "wanted", "after",
            BAR_WIDTH, "");
    for (size_t k = 0; k < s->order_count; ++k) {
        const hci_solved_order *o = &s->order[k];
        if (o->torque_Nm.order < HCI_ORDER_TOLERANCE || largest_of(o) < threshold) continue;
        fprintf(stderr, "  %7.4g %8.4f ", o->torque_Nm.order, amplitude(o->before_Nm));
        draw_bar(amplitude(o->before_Nm), largest);
        fprintf(stderr, " %8.4f %8.4f ", amplitude(o->target_Nm), amplitude(o->torque_Nm));
        draw_bar(amplitude(o->torque_Nm), largest);
        fputc('\n', stderr);
    }
    fputc('\n', stderr);
}

static void show_failures(const hci_solution *s, hci_order_verdict verdict, const char *words)
{
    int shown = 0, total = 0;
    for (size_t k = 0; k < s->order_count; ++k)
        total += s->order[k].verdict == verdict;
    if (total == 0) return;
    fprintf(stderr, "  %-12s %s:", hci_order_verdict_name(verdict), words);
    for (size_t k = 0; k < s->order_count && shown < 8; ++k) {
        const hci_solved_order *o = &s->order[k];
        if (o->verdict != verdict) continue;
        fprintf(stderr, "%s order %g off by %.3g N·m", shown++ ? "," : "", o->torque_Nm.order, o->error_Nm);
        if (hci_remedy_exists(o))
            fprintf(stderr, " (%s %g would reach it)",
                    o->remedy.sequence < 0 ? "neg"
                    : o->remedy.sequence   ? "pos"
                                           : "zero",
                    o->remedy.order);
    }
    fprintf(stderr, "%s\n", shown < total ? ", …" : "");
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
    fprintf(stderr, "  system       %zu equations, %zu unknowns, rank %zu, ", s->rows, s->unknowns, s->rank);
    if (isfinite(s->condition)) fprintf(stderr, "condition about %.2g, ", s->condition);
    fprintf(stderr, "solved by %s\n", hci_method_name(s->method));
}

static void show_newton(const hci_solution *s)
{
    if (s->newton_steps > 0)
        fprintf(stderr, "  newton       %s%zu steps, last change %.2g of the current\n",
                s->newton_converged ? "" : "not converged: ", s->newton_steps, s->newton_change);
}

static void show_gaps(const hci_solution *s)
{
    if (s->gap_count == 0) return;
    fprintf(stderr, "  no current   at %zu range%s of angle (electrical degrees):", s->gap_count,
            s->gap_count == 1 ? "" : "s");
    for (size_t k = 0; k < s->gap_count && k < 6; ++k)
        fprintf(stderr, " %.1f–%.1f", s->gap[k].from_rad * 180.0 / HCI_PI, s->gap[k].to_rad * 180.0 / HCI_PI);
    fprintf(stderr, "%s\n", s->gap_count > 6 ? " …" : "");
    if (isfinite(s->least_iq_A) && s->least_iq_A > 0.0)
        fprintf(stderr, "               from i_q = %.4g A on there is one at every angle\n", s->least_iq_A);
}

static void show_current(const hci_solution *s)
{
    const bool to_plain = isfinite(s->loss_to_plain), to_limit = isfinite(s->loss_to_limit);
    fprintf(stderr, "  currents     %zu component%s up to order %g, peak phase current %.4g A\n",
            s->current.count, s->current.count == 1 ? "" : "s", top_order(s), s->peak_phase_current_A);
    if (!to_plain && !to_limit) return;
    fprintf(stderr, "  copper loss  ");
    if (to_plain)
        fprintf(stderr, "%.4g × the plain fundamental of %.4g A", s->loss_to_plain, s->plain_amplitude_A);
    if (to_limit) fprintf(stderr, "%s%.4g × the pointwise limit", to_plain ? "; " : "", s->loss_to_limit);
    fputc('\n', stderr);
}

static void show_limits(const hci_solution *s)
{
    if (isfinite(s->peak_line_voltage_V))
        fprintf(stderr, "  voltage      peak line voltage %.4g V\n", s->peak_line_voltage_V);
    if (s->within_limits) return;
    fprintf(stderr, "  limits       not kept");
    if (isfinite(s->torque_at_limit_Nm))
        fprintf(stderr, "; a mean torque of %.4g N·m would keep the current limit", s->torque_at_limit_Nm);
    fputc('\n', stderr);
}

void cli_show_solution(const hci_solution *s, const char *machine, const char *target)
{
    bool reached = true;
    cli_progress_end();
    for (size_t k = 0; k < s->order_count; ++k)
        reached = reached && s->order[k].verdict <= HCI_ORDER_FREE;
    fprintf(stderr, "%s%s: %s, %s\n", reached ? "reached" : "not reached (the nearest is given)",
            s->within_limits ? "" : ", but a limit is not kept", machine, target);
    fprintf(stderr, "  torque       mean %.6g N·m; worst error %.3g N·m at order %g (tolerance %.3g N·m)\n",
            s->order_count ? s->order[0].torque_Nm.cosine : 0.0, s->worst_error_Nm, s->worst_order,
            s->tolerance_Nm);
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
