/* What the currents of a solution do. In: a solution whose currents are filled; out: torque and verdict of
 * every order with a remedy where there is one, and the copper loss beside those of the plain fundamental and
 * of the pointwise limit. */
#include "host/solve/evaluate_solution.h"

#include <math.h>

#include "host/base/memory.h"
#include "host/currents/plain_sine.h"
#include "host/solve/harmonic_system.h"
#include "host/solve/pointwise.h"
#include "host/solve/torque_spectrum.h"

const char *hci_order_verdict_name(hci_order_verdict verdict)
{
    static const char *const NAME[] = {"reached", "free", "missed", "parasitic", "unreachable"};
    return NAME[verdict];
}

/* The component that makes torque order m with one wave of the gradient; the lower of the two possible
 * orders. */
static hci_component component_for(const hci_wave *e, double m)
{
    return m > e->order ? (hci_component){m - e->order, -e->sequence}
                        : (hci_component){m + e->order, e->sequence};
}

static bool is_held(const hci_task *t, hci_component c)
{
    return t->held && c.sequence == t->held->sequence && fabs(c.order - t->held->order) < HCI_ORDER_TOLERANCE;
}

/* The one that needs the least current, of those that may flow and are not held already. */
static hci_component remedy_for(const hci_task *t, double m)
{
    hci_component best = {0.0, 0};
    double strongest = 0.0;
    for (size_t k = 0; k < t->gradient_count; ++k) {
        const hci_wave *e = &t->gradient[k];
        const hci_component c = component_for(e, m);
        const double strength = hci_amplitude(e->sine, e->cosine);
        if (strength <= strongest || (e->sequence == 0 && !t->has_neutral)) continue;
        if (m >= HCI_ORDER_TOLERANCE && is_held(t, c)) continue;
        strongest = strength;
        best = c;
    }
    return best;
}

bool hci_remedy_exists(const hci_solved_order *order)
{
    const bool is_none = order->remedy.sequence == 0 && order->remedy.order < HCI_ORDER_TOLERANCE;
    return order->verdict == HCI_ORDER_UNREACHABLE && !is_none;
}

/* Whether any component of the set reaches the order. reached: workspace for the orders of one component. */
static bool is_touched(const hci_task *t, const hci_component_set *set, double order, double *reached)
{
    for (size_t k = 0; k < set->count; ++k) {
        const size_t n = hci_component_orders(t->gradient, t->gradient_count, set->component[k], reached);
        for (size_t j = 0; j < n; ++j)
            if (fabs(reached[j] - order) < HCI_ORDER_TOLERANCE) return true;
    }
    return false;
}

/* What the verdicts need to know. */
typedef struct {
    const hci_task *task;
    const hci_component_set *set; /* whose components could reach an order */
    const double *compared;       /* NULL: all orders are compared */
    size_t compared_count;
    double *reached; /* workspace for the orders of one component */
} criteria;

static hci_order_verdict verdict_of(const criteria *c, const hci_solved_order *o, double tolerance_Nm)
{
    const double order = o->torque_Nm.order;
    if (hci_target_at(c->task->target, order).weight <= 0.0) return HCI_ORDER_FREE;
    if (o->error_Nm <= tolerance_Nm) return HCI_ORDER_REACHED;
    if (!is_touched(c->task, c->set, order, c->reached)) return HCI_ORDER_UNREACHABLE;
    if (c->compared && hci_orders_find(c->compared, c->compared_count, order) == c->compared_count)
        return HCI_ORDER_PARASITIC;
    return HCI_ORDER_MISSED;
}

static hci_solved_order evaluate_order(const criteria *c, hci_harmonic torque_Nm, hci_harmonic before_Nm,
                                       double tolerance_Nm)
{
    hci_solved_order o = {.torque_Nm = torque_Nm, .before_Nm = before_Nm};
    o.target_Nm = hci_target_at(c->task->target, torque_Nm.order).torque_Nm;
    o.error_Nm = hci_torque_distance_Nm(torque_Nm, o.target_Nm);
    o.verdict = verdict_of(c, &o, tolerance_Nm);
    if (o.verdict == HCI_ORDER_UNREACHABLE) o.remedy = remedy_for(c->task, torque_Nm.order);
    return o;
}

/* The worst order of those cared for. */
static void find_worst(hci_solution *s)
{
    s->worst_error_Nm = -1.0;
    for (size_t k = 0; k < s->order_count; ++k) {
        const hci_solved_order *o = &s->order[k];
        if (o->verdict == HCI_ORDER_FREE || o->error_Nm <= s->worst_error_Nm) continue;
        s->worst_error_Nm = o->error_Nm;
        s->worst_order = o->torque_Nm.order;
    }
    if (s->worst_error_Nm < 0.0) s->worst_error_Nm = 0.0;
}

static hci_status fill_orders(const criteria *c, const hci_torque_spectra *t, hci_solution *s, hci_note *note)
{
    s->order = hci_memory_new(t->count, sizeof *s->order);
    if (!s->order) return hci_note_memory(note, NULL, "the torque spectrum");
    s->order_count = t->count;
    for (size_t k = 0; k < t->count; ++k)
        s->order[k] = evaluate_order(c, t->first[k], t->second[k], s->tolerance_Nm);
    find_worst(s);
    return HCI_OK;
}

/* Swing over mean of one of the two torques; a mean that is none, of which the ripple would be any share, has
 * none. */
static hci_status find_ripple(const hci_solution *s, hci_harmonic *torque, double *percent, hci_note *note)
{
    const hci_harmonic_list list = {torque, s->order_count};
    const double mean_Nm =
        s->order_count > 0 && torque[0].order < HCI_ORDER_TOLERANCE ? torque[0].cosine : 0.0;
    double swing_Nm;
    const hci_status status = hci_torque_swing(&list, s->period_turns, &swing_Nm, note);
    *percent = fabs(mean_Nm) > s->tolerance_Nm ? hci_percent_of_mean(swing_Nm, mean_Nm) : (double)NAN;
    return status;
}

/* NAN where there is nothing to compare with. */
static double ratio(double value, double reference)
{
    if (!(reference > 0.0)) return NAN;
    return value / reference;
}

/* Of a direction that is kept, else in phase with the back-EMF. */
static hci_wave plain_of(const hci_task *t)
{
    const hci_wave kept = t->current_angle_rad ? hci_pointwise_kept_sine(t) : (hci_wave){0.0, 0, 0.0, 0.0};
    const bool is_found = hci_amplitude(kept.sine, kept.cosine) > 0.0;
    return is_found ? kept : hci_plain_sine(t->machine, hci_target_mean_Nm(t->target));
}

/* What the currents are compared with. */
static void fill_plain(const hci_task *t, hci_solution *s)
{
    s->plain_is_held = t->held != NULL;
    s->plain = t->held ? *t->held : plain_of(t);
    s->plain_amplitude_A = hci_amplitude(s->plain.sine, s->plain.cosine);
}

static void fill_losses(hci_solution *s)
{
    s->mean_square_A2 = hci_waves_mean_square(s->current.wave, s->current.count);
    s->loss_to_plain = ratio(s->mean_square_A2, 1.5 * s->plain_amplitude_A * s->plain_amplitude_A);
    s->loss_to_limit = ratio(s->mean_square_A2, s->limit_mean_square_A2);
}

/* The orders that the square system compares; none named where all are. */
static hci_status find_compared(const hci_task *t, const hci_component_set *set, hci_compare compare,
                                hci_harmonic_system *system, hci_note *note)
{
    *system = (hci_harmonic_system){0};
    if (compare != HCI_COMPARE_SQUARE) return HCI_OK;
    return hci_harmonic_system_make(t, set->component, set->count, compare, system, note);
}

hci_status hci_solution_evaluate(const hci_task *task, const hci_component_set *set, hci_compare compare,
                                 hci_solution *solution, hci_note *note)
{
    const hci_wave_view current = {solution->current.wave, solution->current.count},
                        before = {&solution->plain, 1};
    hci_harmonic_system system = {0};
    hci_torque_spectra torque = {0};
    double *reached = hci_memory_new(2 * task->gradient_count, sizeof *reached);
    hci_status status = reached ? HCI_OK : hci_note_memory(note, NULL, "the torque spectrum");
    fill_plain(task, solution);
    if (!status) status = hci_torque_spectra_make(task, current, before, &torque, note);
    if (!status) status = find_compared(task, set, compare, &system, note);
    if (!status) {
        const criteria c = {task, set, system.order, system.order_count, reached};
        status = fill_orders(&c, &torque, solution, note);
    }
    if (!status) status = find_ripple(solution, torque.first, &solution->T_ripple_percent, note);
    if (!status) status = find_ripple(solution, torque.second, &solution->T_ripple_before_percent, note);
    hci_harmonic_system_release(&system);
    hci_torque_spectra_release(&torque);
    hci_memory_free(reached);
    if (!status) fill_losses(solution);
    return status;
}
