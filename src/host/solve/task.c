/* A task for a machine with its effects, and the period in which everything repeats. */
#include <math.h>
#include <string.h>

#include "host/solve/task.h"

#define MOST_TURNS 4096

void hci_task_begin(const hci_quadratic_model *model, const hci_target *target, hci_task *t)
{
    memset(t, 0, sizeof *t);
    t->machine = &model->machine;
    t->higher = model->higher.effects ? &model->higher : NULL;
    t->target = target;
    t->gradient = model->machine.back_emf;
    t->gradient_count = model->machine.back_emf_count;
}

double hci_magnet_temperature_C(const hci_solve_options *o)
{
    if (!o->at_temperature) return NAN;
    return o->temperature_C;
}

hci_status hci_task_goes_on(const hci_task *task, hci_note *note)
{
    if (!task->stop || !task->stop(task->stop_context)) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_STOPPED, "solving was stopped before there was a result");
}

bool hci_task_is_linear(const hci_task *task)
{
    return task->machine->slope_count == 0 && !task->higher;
}

static bool is_whole(double order, size_t turns)
{
    const double periods = order * (double)turns;
    return fabs(periods - floor(periods + 0.5)) < HCI_ORDER_TOLERANCE * (double)turns;
}

static bool machine_repeats(const hci_task *t, size_t turns)
{
    const hci_machine *m = t->machine;
    bool whole = !t->higher || hci_effects_repeat(t->higher->effects, m->pole_pairs, turns);
    for (size_t k = 0; k < m->back_emf_count; ++k)
        whole = whole && is_whole(m->back_emf[k].order, turns);
    for (size_t k = 0; k < m->cogging_count; ++k)
        whole = whole && is_whole(m->cogging[k].order, turns);
    for (size_t k = 0; k < m->slope_count; ++k)
        whole = whole && is_whole(m->slope[k].order, turns);
    return whole;
}

static bool all_repeat(const hci_task *t, const hci_component_set *set, const hci_wave *wave, size_t count,
                       size_t turns)
{
    bool whole = machine_repeats(t, turns);
    for (size_t k = 0; k < t->target->count; ++k)
        whole = whole && is_whole(t->target->order[k].torque_Nm.order, turns);
    for (size_t k = 0; set && k < set->count; ++k)
        whole = whole && is_whole(set->component[k].order, turns);
    for (size_t k = 0; k < count; ++k)
        whole = whole && is_whole(wave[k].order, turns);
    return whole;
}

hci_status hci_task_find_period(hci_task *t, const hci_component_set *set, const hci_wave *wave, size_t count,
                                hci_note *note)
{
    for (t->period_turns = 1; t->period_turns <= MOST_TURNS; ++t->period_turns)
        if (all_repeat(t, set, wave, count, t->period_turns)) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "the orders have no common period of at most %d electrical turns; write fractional orders as "
        "k/pole_pairs with at least 7 digits",
        MOST_TURNS);
}
