#include "host/solution/limited_set.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/solve/candidates.h"

enum {
    MOST_TOP = 61, /* order up to which currents may have components where none are named and the torque is
                    * not linear, so that e + L'i has no last order */
    LEAST_TOP = 25 /* the same at least */
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

hci_status hci_limited_set_choose(const hci_answer *a, hci_wishes *w, hci_note *note)
{
    const hci_solve_options *o = w->of->options;
    const double most = hci_task_is_linear(w->of->task) ? HUGE_VAL : MOST_TOP,
                 top = fmin(most, fmax(LEAST_TOP, hci_wishes_top(&a->set)));
    if (o->set || o->choose_at_most > 0) return copy_set(&a->set, &w->set, note);
    if (!hci_bounds_are_alike(w->of->bounds)) return every_component(w, top, &w->set, note);
    return hci_candidates(w->of->task, top, &w->set, note);
}
