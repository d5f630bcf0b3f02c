#include "host/solution/limited_set.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/solve/candidates.h"

enum {
    MOST_TOP = 61,    /* order up to which currents may have components where none are named and the torque is
                       * not linear, so that e + L'i has no last order */
    MOST_WHOLE = 181, /* the same where the ripple is so small that the orders above matter */
    LEAST_TOP = 25    /* the same at least */
};

static hci_status out_of_memory(hci_note *note)
{
    return hci_note_memory(note, NULL, "solving within limits");
}

static hci_status copy_set(const hci_component_set *from, hci_component_set *to, hci_note *note)
{
    to->component = hci_memory_new(from->count, sizeof *to->component);
    to->set = hci_memory_new(from->count, sizeof *to->set);
    if (!to->component || !to->set) return out_of_memory(note);
    memcpy(to->component, from->component, from->count * sizeof *to->component);
    memcpy(to->set, from->set, from->count * sizeof *to->set);
    to->count = from->count;
    return HCI_OK;
}

/* Phases that differ mix the sequences: every component of every order that the wanted currents could have.
 */
static hci_status every_component(const hci_wishes *w, double top, hci_component_set *set, hci_note *note)
{
    const hci_task *t = w->of->task;
    hci_harmonic mixed[3] = {{2.0, 1.0, 0.0}, {4.0, 1.0, 0.0}, {6.0, 1.0, 0.0}};
    hci_task with = *t;
    hci_target_order order[3];
    hci_target target = {order, 3};
    for (int k = 0; k < 3; ++k)
        order[k] = (hci_target_order){mixed[k], 1.0};
    with.target = &target;
    return hci_candidates(&with, top, set, note);
}

/* ---- the neutral conductor ---- */

static bool has_zero(const hci_component_set *set, double order)
{
    for (size_t k = 0; k < set->count; ++k)
        if (set->component[k].sequence == 0 && fabs(set->component[k].order - order) < HCI_ORDER_TOLERANCE)
            return true;
    return false;
}

/* Whether a zero sequence of an order may take a phase off its limit: with phases that differ that of every
 * order (of an open phase it takes away what the others have), with phases alike that of the orders in which
 * they are in phase, three times the odd ones. */
static bool is_of_use(bool phases_differ, double order)
{
    return phases_differ || fabs(fmod(order, 6.0) - 3.0) < HCI_ORDER_TOLERANCE;
}

static void add_zero(hci_component_set *set, double order)
{
    if (has_zero(set, order)) return;
    set->set[set->count] = HCI_SET_ZERO;
    set->component[set->count++] = (hci_component){order, 0};
}

/* The zero sequence makes no torque in a balanced machine, so that no candidate has it. */
static hci_status add_zeros(const hci_wishes *w, double top, hci_component_set *set, hci_note *note)
{
    const double turns = (double)w->of->task->period_turns;
    const size_t most = (size_t)floor(top * turns + 0.5);
    const bool phases_differ = !hci_bounds_are_alike(w->of->bounds);
    hci_component *component = hci_memory_resize(set->component, set->count + most + 1, sizeof *component);
    if (component) set->component = component;
    hci_set *name = hci_memory_resize(set->set, set->count + most + 1, sizeof *name);
    if (name) set->set = name;
    if (!component || !name) return out_of_memory(note);
    for (size_t k = 0; k <= most; ++k)
        if (is_of_use(phases_differ, (double)k / turns)) add_zero(set, (double)k / turns);
    return HCI_OK;
}

/* ---- all of it ---- */

hci_status hci_limited_set_choose(const hci_answer *a, bool is_whole, hci_wishes *w, hci_note *note)
{
    const hci_solve_options *o = w->of->options;
    const hci_task *t = w->of->task;
    const double most = hci_task_is_linear(t) ? HUGE_VAL
                        : is_whole            ? MOST_WHOLE
                                              : MOST_TOP,
                 top = fmin(most, fmax(LEAST_TOP, hci_wishes_top(&a->set)));
    hci_status status;
    if (o->set || o->choose_at_most > 0) return copy_set(&a->set, &w->set, note);
    status = hci_bounds_are_alike(w->of->bounds) ? hci_candidates(t, top, &w->set, note)
                                                 : every_component(w, top, &w->set, note);
    return !status && t->has_neutral ? add_zeros(w, top, &w->set, note) : status;
}

bool hci_limited_set_is_cut(const hci_answer *a, const hci_wishes *w)
{
    const hci_solve_options *o = w->of->options;
    return !o->set && o->choose_at_most == 0 && !hci_task_is_linear(w->of->task) &&
           hci_wishes_top(&a->set) > hci_wishes_top(&w->set) + HCI_ORDER_TOLERANCE;
}
