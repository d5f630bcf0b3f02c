/* In: options of one point; out: what the currents that hci_solve finds for it do and cost. */
#include "host/sweep/figures.h"

#include <math.h>
#include <string.h>

enum {
    SAMPLES_PER_PERIOD = 32,
    LEAST_SAMPLES = 1024
}; /* of the highest order: peaks to half a percent of it */

#define TOUCHED                                                                                              \
    1e-4 /* share of a limit below which it does not bind: an interior point leaves every price above 0 */
#define MEAN_MET 1e-4 /* share of the torque within which a mean is the wanted one */

hci_grid_figures hci_grid_no_figures(void)
{
    return (hci_grid_figures){.mean_Nm = NAN,
                              .T_ripple_percent = NAN,
                              .worst_Nm = NAN,
                              .worst_order = NAN,
                              .mean_square_A2 = NAN,
                              .loss_to_plain = NAN,
                              .peak_A = NAN,
                              .rms_A = NAN,
                              .line_V = NAN};
}

/* 100 (max − min)/mean of the torque, or of that of the plain sine; NAN without a mean. */
static double ripple_percent(const hci_solution *s, bool is_plain)
{
    const double top = s->order_count ? s->order[s->order_count - 1].torque_Nm.order : 1.0;
    const double least = fmax(LEAST_SAMPLES, SAMPLES_PER_PERIOD * top);
    const size_t samples = s->period_turns * (size_t)ceil(least);
    double mean_Nm = 0.0, high = -HUGE_VAL, low = HUGE_VAL;
    for (size_t k = 0; k < samples; ++k) {
        const double theta_rad = 2.0 * HCI_PI * (double)(s->period_turns * k) / (double)samples;
        double sum_Nm = 0.0;
        for (size_t j = 0; j < s->order_count; ++j)
            sum_Nm +=
                hci_harmonics_at(is_plain ? &s->order[j].before_Nm : &s->order[j].torque_Nm, 1, theta_rad);
        mean_Nm += sum_Nm / (double)samples;
        high = fmax(high, sum_Nm);
        low = fmin(low, sum_Nm);
    }
    if (fabs(mean_Nm) <= 1e-12 * fmax(fabs(high), fabs(low))) return NAN;
    return 100.0 * (high - low) / fabs(mean_Nm);
}

static hci_grid_figures figures_of(const hci_solution *s)
{
    hci_grid_figures f = hci_grid_no_figures();
    f.mean_Nm = s->order_count ? s->order[0].torque_Nm.cosine : 0.0;
    f.T_ripple_percent = ripple_percent(s, false);
    f.worst_Nm = s->worst_error_Nm;
    f.worst_order = s->worst_order;
    f.mean_square_A2 = s->mean_square_A2;
    f.loss_to_plain = s->loss_to_plain;
    f.peak_A = s->peak_phase_current_A;
    f.rms_A = sqrt(s->mean_square_A2 / 3.0);
    f.line_V = s->peak_line_voltage_V;
    for (size_t k = 0; k < s->limit_count; ++k) {
        const hci_limit *l = &s->limit[k];
        f.binds[l->kind] = f.binds[l->kind] || (l->binds && l->value >= (1.0 - TOUCHED) * l->limit);
    }
    return f;
}

/* Of the plain sine that a solution is compared with. */
static hci_grid_figures plain_figures_of(const hci_solution *s)
{
    hci_grid_figures f = hci_grid_no_figures();
    if (!(s->plain_amplitude_A > 0.0)) return f;
    f.mean_Nm = s->order_count ? s->order[0].before_Nm.cosine : 0.0;
    f.T_ripple_percent = ripple_percent(s, true);
    f.peak_A = s->plain_amplitude_A;
    f.rms_A = s->plain_amplitude_A / sqrt(2.0);
    f.mean_square_A2 = 1.5 * s->plain_amplitude_A * s->plain_amplitude_A;
    f.loss_to_plain = 1.0;
    return f;
}

hci_solve_options hci_grid_options_of(const hci_grid_request *r, const hci_grid_point *p,
                                      const hci_target *target)
{
    hci_solve_options o = *r->options;
    o.target = target;
    o.progress = NULL;
    o.at_speed = r->speed_rad_per_s.count > 0 || r->point;
    o.speed_rad_per_s = p->speed_rad_per_s;
    if (!isnan(p->link_V)) o.limit_voltage_V = p->link_V;
    if (!isnan(p->limit_current_A)) o.limit_current_A = p->limit_current_A;
    if (!isnan(p->limit_copper)) {
        o.limits.copper_ratio = p->limit_copper;
        o.limits.copper_W = 0.0;
    }
    return o;
}

static hci_grid_verdict verdict_of(const hci_solution *s, hci_status status, hci_note *reason)
{
    const double mean_Nm = s->order_count ? s->order[0].torque_Nm.cosine : 0.0;
    const double error_Nm = fabs(mean_Nm - s->wanted_mean_Nm);
    if (s->limit_cost == HCI_COST_LIMITS) return HCI_GRID_LIMITS;
    if (!s->within_limits) {
        hci_note_set(reason, HCI_ERROR_NUMERIC, "%s",
                     s->remark.text[0] ? s->remark.text : "the limits are not kept");
        return HCI_GRID_FAILED;
    }
    if (error_Nm > fmax(s->tolerance_Nm, MEAN_MET * fabs(s->wanted_mean_Nm))) return HCI_GRID_TORQUE;
    return status == HCI_NOT_REACHED ? HCI_GRID_RIPPLE : HCI_GRID_REACHED;
}

static void solve(const hci_machine_data *machine, const hci_solve_options *o, hci_grid_answer *a)
{
    hci_solution s;
    const hci_status status = hci_solve(machine, o, &s, &a->reason);
    a->verdict = HCI_GRID_FAILED;
    a->figures = a->plain = hci_grid_no_figures();
    if (status > HCI_NOT_REACHED) return;
    a->verdict = verdict_of(&s, status, &a->reason);
    if (a->verdict < HCI_GRID_LIMITS) a->figures = figures_of(&s);
    a->plain = plain_figures_of(&s);
    hci_solution_release(&s);
}

/* Without a wish for another ripple first: where none remains that is the better answer, since it need not
 * come from the limited components of a search. */
void hci_grid_solve_once(const hci_machine_data *machine, const hci_solve_options *options,
                         hci_grid_answer *answer)
{
    hci_solve_options o = *options;
    memset(answer, 0, sizeof *answer);
    if (o.minimise == HCI_MINIMISE_PEAK_TO_PEAK || o.minimise == HCI_MINIMISE_RMS)
        o.minimise = HCI_MINIMISE_AUTO;
    solve(machine, &o, answer);
    if (o.minimise == options->minimise) return;
    if (answer->verdict != HCI_GRID_RIPPLE && answer->verdict != HCI_GRID_FAILED) return;
    memset(answer, 0, sizeof *answer);
    solve(machine, options, answer);
}
