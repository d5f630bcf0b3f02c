/* Candidates for the currents. In: a task and a top order; out: every component up to it that U connects,
 * through the back-EMF, with an order that is wanted or disturbed (theory.md, section 5). */
#include "host/solve/candidates.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"

static bool touches(const double *order, size_t order_count, const double *wanted, size_t wanted_count)
{
    for (size_t k = 0; k < order_count; ++k)
        if (hci_orders_find(wanted, wanted_count, order[k]) < wanted_count) return true;
    return false;
}

/* Grows the connected part: marks components that reach an order in `order`, adds what they reach, until
 * nothing is new. */
static size_t connect(const hci_task *t, const hci_component *all, size_t count, bool *used, double *order,
                      size_t orders)
{
    for (bool grown = true; grown;) {
        size_t n = orders;
        grown = false;
        for (size_t k = 0; k < count; ++k) {
            const size_t reached = hci_component_orders(t->gradient, t->gradient_count, all[k], order + n);
            if (used[k] || !touches(order + n, reached, order, orders)) continue;
            used[k] = grown = true;
            n += reached;
        }
        orders = hci_orders_sort(order, n);
    }
    return orders;
}

/* A component that is held fixed is not to be chosen as well; what is held is of positive sequence. */
static bool is_held(const hci_task *t, double order)
{
    return t->held && fabs(t->held->order - order) < HCI_ORDER_TOLERANCE;
}

/* Whether a current loop follows the component: seen from the rotor it is of order n − σ. */
static bool is_followed(const hci_task *t, double order, int sequence)
{
    return !(t->highest_rotor_order > 0.0) ||
           fabs(order - sequence) <= t->highest_rotor_order + HCI_ORDER_TOLERANCE;
}

static size_t every_component(const hci_task *t, double top_order, hci_component *all)
{
    const size_t steps = (size_t)floor(top_order * (double)t->period_turns + 0.5);
    size_t n = 0;
    for (size_t k = 0; k <= steps; ++k) {
        const double order = (double)k / (double)t->period_turns;
        if (!is_held(t, order) && is_followed(t, order, 1)) all[n++] = (hci_component){order, 1};
        if (k > 0 && is_followed(t, order, -1)) all[n++] = (hci_component){order, -1};
        if (t->has_neutral) all[n++] = (hci_component){order, 0};
    }
    return n;
}

static size_t starting_orders(const hci_task *t, double *order)
{
    size_t n = 0;
    order[n++] = 0.0;
    for (size_t k = 0; k < t->target->count; ++k)
        order[n++] = t->target->order[k].torque_Nm.order;
    for (size_t k = 0; k < t->machine->cogging_count; ++k)
        order[n++] = t->machine->cogging[k].order;
    for (size_t k = 0; k < t->offset_count; ++k)
        order[n++] = t->offset[k].order;
    return hci_orders_sort(order, n);
}

static void keep_used(hci_component_set *set, size_t count, const bool *used)
{
    static const hci_set NAME[3] = {HCI_SET_NEG, HCI_SET_ZERO, HCI_SET_POS};
    for (size_t k = 0; k < count; ++k) {
        if (!used[k]) continue;
        set->set[set->count] = NAME[set->component[k].sequence + 1];
        set->component[set->count++] = set->component[k];
    }
}

hci_status hci_candidates(const hci_task *t, double top_order, hci_component_set *set, hci_note *note)
{
    const size_t most = 3 * ((size_t)(top_order * (double)t->period_turns) + 2);
    const size_t reach = 2 * t->gradient_count;
    bool *used = hci_memory_new(most, sizeof *used);
    double *order = hci_memory_new(1 + t->target->count + t->machine->cogging_count + t->offset_count +
                                       reach * (most + 1),
                                   sizeof *order);
    hci_status status = HCI_OK;
    memset(set, 0, sizeof *set);
    set->component = hci_memory_new(most, sizeof *set->component);
    set->set = hci_memory_new(most, sizeof *set->set);
    if (used && order && set->component && set->set) {
        const size_t count = every_component(t, top_order, set->component);
        connect(t, set->component, count, used, order, starting_orders(t, order));
        keep_used(set, count, used);
    } else {
        status = hci_note_memory(note, NULL, "candidates up to order %g", top_order);
    }
    hci_memory_free(used);
    hci_memory_free(order);
    return status;
}

void hci_candidates_span(const hci_task *t, double *torque_order, double *emf_order)
{
    *torque_order = *emf_order = 1.0;
    for (size_t k = 0; k < t->target->count; ++k)
        *torque_order = fmax(*torque_order, t->target->order[k].torque_Nm.order);
    for (size_t k = 0; k < t->machine->cogging_count; ++k)
        *torque_order = fmax(*torque_order, t->machine->cogging[k].order);
    for (size_t k = 0; k < t->machine->back_emf_count; ++k)
        *emf_order = fmax(*emf_order, t->machine->back_emf[k].order);
}
