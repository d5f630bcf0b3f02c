/* What the currents of a solution do: torque and verdict of every order, and the copper loss. */
#include <math.h>

#include "host/base/memory.h"
#include "host/machine/sampled_torque.h"
#include "host/machine/torque_gradient.h"
#include "host/solve/harmonic_system.h"

#define NEGLIGIBLE 1e-12 /* waves of e + ½L'i below this share of the largest make no torque worth a line */

static hci_status no_memory(hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the torque spectrum");
}

/* The plain fundamental: the one that is held, or the least sine whose mutual torque has the wanted mean. */
static hci_wave plain_fundamental(const hci_task *t)
{
    const double mean_Nm = hci_target_mean_Nm(t->target);
    if (t->held) return *t->held;
    for (size_t k = 0; k < t->machine->back_emf_count; ++k) {
        const hci_wave *e = &t->machine->back_emf[k];
        const double square = e->sine * e->sine + e->cosine * e->cosine;
        if (fabs(e->order - 1.0) < HCI_ORDER_TOLERANCE && e->sequence == 1 && square > 0.0) {
            const double scale = mean_Nm / (1.5 * square);
            return (hci_wave){1.0, 1, scale * e->sine, scale * e->cosine};
        }
    }
    return (hci_wave){1.0, 1, 0.0, 0.0};
}

/* A current, e + ½L'i, whose product with it is the mutual and reluctance torque, and the torque beyond. */
typedef struct {
    const hci_wave *wave;
    size_t count;
    hci_wave *gain;
    size_t gain_count;
    hci_harmonic *beyond;
    size_t beyond_count;
} acting;

static hci_status act(const hci_task *t, const hci_wave *wave, size_t count, acting *a, hci_note *note)
{
    hci_status status =
        hci_torque_gradient(t->machine, wave, count, 0.5, NEGLIGIBLE, &a->gain, &a->gain_count, note);
    a->wave = wave;
    a->count = count;
    if (!status && t->beyond && count > 0)
        status =
            hci_sampled_torque(t->beyond, t->period_turns, wave, count, &a->beyond, &a->beyond_count, note);
    return status;
}

static void release_acting(acting *a)
{
    hci_memory_free(a->gain);
    hci_memory_free(a->beyond);
}

static size_t orders_of(const acting *c, double *order)
{
    size_t n = 0;
    for (size_t k = 0; k < c->count; ++k)
        n += hci_component_orders(c->gain, c->gain_count,
                                  (hci_component){c->wave[k].order, c->wave[k].sequence}, order + n);
    for (size_t k = 0; k < c->beyond_count; ++k)
        order[n++] = c->beyond[k].order;
    return n;
}

/* Every order that two currents make torque at (the second may have no waves), that is wanted, or that
 * cogging has. */
typedef struct {
    double *order;
    size_t count;
    acting first, second;
} reach;

static hci_status find_reach(const hci_task *t, const hci_wave *first, size_t first_count,
                             const hci_wave *second, size_t second_count, reach *r, hci_note *note)
{
    const hci_machine *m = t->machine;
    hci_status status = act(t, first, first_count, &r->first, note);
    if (!status) status = act(t, second, second_count, &r->second, note);
    if (status) return status;
    r->order = hci_memory_new(
        1 + m->cogging_count + t->target->count + 2 * r->first.gain_count * first_count +
            2 * r->second.gain_count * second_count + r->first.beyond_count + r->second.beyond_count,
        sizeof *r->order);
    if (!r->order) return no_memory(note);
    r->order[r->count++] = 0.0;
    for (size_t k = 0; k < m->cogging_count; ++k)
        r->order[r->count++] = m->cogging[k].order;
    for (size_t k = 0; k < t->target->count; ++k)
        r->order[r->count++] = t->target->order[k].torque_Nm.order;
    r->count += orders_of(&r->first, r->order + r->count);
    r->count += orders_of(&r->second, r->order + r->count);
    r->count = hci_orders_sort(r->order, r->count);
    return HCI_OK;
}

static void release_reach(reach *r)
{
    hci_memory_free(r->order);
    release_acting(&r->first);
    release_acting(&r->second);
}

static void add_to_reach(const reach *r, hci_harmonic term, hci_harmonic *torque)
{
    const size_t at = hci_orders_find(r->order, r->count, term.order);
    torque[at].sine += term.sine;
    torque[at].cosine += term.cosine;
}

/* Torque of a current at every order of the reach: (e + ½L'i)·i + T_cog, and what is beyond. */
static void torque_of(const hci_task *t, const reach *r, const acting *c, hci_harmonic *torque)
{
    for (size_t k = 0; k < r->count; ++k)
        torque[k] = (hci_harmonic){r->order[k], 0.0, 0.0};
    for (size_t k = 0; k < t->machine->cogging_count; ++k)
        add_to_reach(r, t->machine->cogging[k], torque);
    for (size_t k = 0; k < c->beyond_count; ++k)
        add_to_reach(r, c->beyond[k], torque);
    hci_system_add_torque(c->gain, c->gain_count, c->wave, c->count, r->order, r->count, torque);
}

static double distance_Nm(hci_harmonic a, hci_harmonic b)
{
    return hypot(a.sine - b.sine, a.cosine - b.cosine);
}

hci_status hci_torque_spectrum_evaluate(const hci_task *task, const hci_wave *wave, size_t count,
                                        hci_harmonic **torque, size_t *torque_count, hci_note *note)
{
    reach r = {0};
    hci_status status = find_reach(task, wave, count, wave, 0, &r, note);
    *torque = NULL;
    *torque_count = 0;
    if (!status && !(*torque = hci_memory_new(r.count, sizeof **torque))) status = no_memory(note);
    if (!status) {
        torque_of(task, &r, &r.first, *torque);
        *torque_count = r.count;
    }
    release_reach(&r);
    return status;
}

hci_status hci_torque_error_evaluate(const hci_task *task, const hci_wave *wave, size_t count,
                                     hci_torque_error *error, hci_note *note)
{
    hci_harmonic *torque;
    size_t orders;
    const hci_status status = hci_torque_spectrum_evaluate(task, wave, count, &torque, &orders, note);
    *error = (hci_torque_error){0.0, 0.0};
    for (size_t k = 0; k < orders; ++k) {
        const hci_target_order wanted = hci_target_at(task->target, torque[k].order);
        const double amplitude = wanted.weight * distance_Nm(torque[k], wanted.torque_Nm);
        error->worst_Nm = fmax(error->worst_Nm, amplitude);
        error->square_sum += amplitude * amplitude;
    }
    hci_memory_free(torque);
    return status;
}

/* The component that makes torque order m with one wave of the gain; the lower of the two possible orders. */
static hci_component component_for(const hci_wave *gain, double m)
{
    return m > gain->order ? (hci_component){m - gain->order, -gain->sequence}
                           : (hci_component){m + gain->order, gain->sequence};
}

/* The one that needs the least current, of those that may flow and are not held already. */
static hci_component remedy_for(const hci_task *t, double m)
{
    hci_component best = {0.0, 0};
    double strongest = 0.0;
    for (size_t k = 0; k < t->gain_count; ++k) {
        const hci_wave *gain = &t->gain[k];
        const hci_component c = component_for(gain, m);
        const double strength = hci_amplitude(gain->sine, gain->cosine);
        const bool is_held = t->held && m >= HCI_ORDER_TOLERANCE && c.sequence == t->held->sequence &&
                             fabs(c.order - t->held->order) < HCI_ORDER_TOLERANCE;
        if (strength <= strongest || is_held || (gain->sequence == 0 && !t->has_neutral)) continue;
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

/* Whether any component of the set reaches the order. reached: room for the orders of one component. */
static bool is_touched(const hci_task *t, const hci_component_set *set, double order, double *reached)
{
    for (size_t k = 0; k < set->count; ++k) {
        const size_t n = hci_component_orders(t->gain, t->gain_count, set->component[k], reached);
        for (size_t j = 0; j < n; ++j)
            if (fabs(reached[j] - order) < HCI_ORDER_TOLERANCE) return true;
    }
    return false;
}

typedef struct {
    const hci_task *task;
    const hci_component_set *set;
    const double *compared; /* NULL: all orders are compared */
    size_t compared_count;
    double *reached; /* room for the orders of one component */
} judge;

static hci_order_verdict judge_order(const judge *j, const hci_solved_order *o, double tolerance_Nm)
{
    const double order = o->torque_Nm.order;
    if (hci_target_at(j->task->target, order).weight <= 0.0) return HCI_ORDER_FREE;
    if (o->error_Nm <= tolerance_Nm) return HCI_ORDER_REACHED;
    if (!is_touched(j->task, j->set, order, j->reached)) return HCI_ORDER_UNREACHABLE;
    if (j->compared && hci_orders_find(j->compared, j->compared_count, order) == j->compared_count)
        return HCI_ORDER_PARASITIC;
    return HCI_ORDER_MISSED;
}

/* Target, torque and error of every order, and the worst of those cared for. */
static void judge_orders(const judge *j, const hci_harmonic *torque, const hci_harmonic *before,
                         hci_solution *s)
{
    s->worst_error_Nm = -1.0;
    for (size_t k = 0; k < s->order_count; ++k) {
        hci_solved_order *o = &s->order[k];
        o->target_Nm = hci_target_at(j->task->target, torque[k].order).torque_Nm;
        o->torque_Nm = torque[k];
        o->before_Nm = before[k];
        o->error_Nm = distance_Nm(torque[k], o->target_Nm);
        o->verdict = judge_order(j, o, s->tolerance_Nm);
        if (o->verdict == HCI_ORDER_UNREACHABLE) o->remedy = remedy_for(j->task, o->torque_Nm.order);
        if (o->verdict == HCI_ORDER_FREE || o->error_Nm <= s->worst_error_Nm) continue;
        s->worst_error_Nm = o->error_Nm;
        s->worst_order = o->torque_Nm.order;
    }
    if (s->worst_error_Nm < 0.0) s->worst_error_Nm = 0.0;
}

static hci_status fill_orders(const judge *j, const reach *r, hci_solution *s, hci_note *note)
{
    hci_harmonic *torque = hci_memory_new(2 * r->count, sizeof *torque);
    s->order = hci_memory_new(r->count, sizeof *s->order);
    s->order_count = s->order ? r->count : 0;
    if (torque && s->order) {
        torque_of(j->task, r, &r->first, torque);
        torque_of(j->task, r, &r->second, torque + r->count);
        judge_orders(j, torque, torque + r->count, s);
    }
    hci_memory_free(torque);
    return torque && s->order ? HCI_OK : no_memory(note);
}

/* NAN where there is nothing to compare with. */
static double ratio(double value, double reference)
{
    if (!(reference > 0.0)) return NAN;
    return value / reference;
}

static void fill_losses(const hci_task *t, hci_solution *s)
{
    const hci_wave plain = plain_fundamental(t);
    s->mean_square_A2 = hci_waves_mean_square(s->current.wave, s->current.count);
    s->plain_amplitude_A = hci_amplitude(plain.sine, plain.cosine);
    s->loss_to_plain = ratio(s->mean_square_A2, 1.5 * s->plain_amplitude_A * s->plain_amplitude_A);
    s->loss_to_limit = ratio(s->mean_square_A2, s->limit_mean_square_A2);
}

hci_status hci_solution_evaluate(const hci_task *task, const hci_component_set *set, hci_compare compare,
                                 hci_solution *solution, hci_note *note)
{
    const hci_wave plain = plain_fundamental(task);
    hci_harmonic_system b = {0};
    reach r = {0};
    double *reached = hci_memory_new(2 * task->gain_count, sizeof *reached);
    hci_status status =
        reached ? find_reach(task, solution->current.wave, solution->current.count, &plain, 1, &r, note)
                : no_memory(note);
    if (!status && compare == HCI_COMPARE_SQUARE)
        status = hci_harmonic_system_make(task, set->component, set->count, compare, &b, note);
    if (!status) {
        const judge j = {task, set, b.order, b.order_count, reached};
        status = fill_orders(&j, &r, solution, note);
    }
    hci_harmonic_system_release(&b);
    hci_memory_free(reached);
    release_reach(&r);
    if (!status) fill_losses(task, solution);
    return status;
}
