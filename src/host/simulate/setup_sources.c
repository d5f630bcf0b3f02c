/* Where reference currents come from: a strategy, or waves from files. */
#include <math.h>
#include <stdio.h>

#include "hci/host/currents/solution_folder.h"
#include "host/simulate/setup_task.h"

static hci_status check_waves(const hci_setup_task *b, const hci_currents *currents)
{
    const int pole_pairs = b->machine->model.pole_pairs;
    for (size_t k = 0; k < currents->count; ++k) {
        const hci_wave *w = &currents->wave[k];
        const double turn = w->order * pole_pairs;
        if (w->sequence == 0)
            return hci_setup_wrong(
                b,
                "`currents`: a zero-sequence component of order %g cannot flow in a star without "
                "neutral conductor; leave "
                "it out",
                w->order);
        if (fabs(turn - floor(turn + 0.5)) > HCI_ORDER_TOLERANCE)
            return hci_setup_wrong(
                b,
                "`currents`: order %g is no multiple of 1/%d, so that it does not repeat after a "
                "mechanical turn",
                w->order, pole_pairs);
        if (fabs(w->order - floor(w->order + 0.5)) > HCI_ORDER_TOLERANCE)
            b->setup->period_turns = (size_t)pole_pairs;
    }
    return HCI_OK;
}

static hci_status read_waves(const hci_setup_task *b)
{
    hci_setup *p = b->setup;
    const char *path = b->scenario->currents;
    hci_status status;
    if (p->has_command && !hci_solution_is_folder(path))
        return hci_setup_wrong(
            b, "`currents` is one file, which a torque cannot scale; give the folder that `solve` "
               "wrote, or delete the set "
               "point");
    if (p->has_command && !hci_solution_has_parts(path))
        return hci_setup_wrong(
            b, "`currents`: this solution has no currents_per_Nm.csv: it is for one torque (a held "
               "fundamental, or reluctance torque); use `strategy`, or delete the set point");
    status = hci_solution_read_currents(
        path, p->has_command ? HCI_SOLUTION_CURRENTS_CONSTANT : HCI_SOLUTION_CURRENTS, &p->fixed, b->note);
    if (!status && p->has_command)
        status = hci_solution_read_currents(path, HCI_SOLUTION_CURRENTS_PER_NM, &p->per_Nm, b->note);
    if (!status) status = check_waves(b, &p->fixed);
    if (!status) status = check_waves(b, &p->per_Nm);
    if (!status && p->fixed.count + p->per_Nm.count == 0)
        status = hci_setup_wrong(b, "`currents`: no rows, so that nothing flows");
    p->source[0].fixed = p->fixed.wave;
    p->source[0].fixed_count = p->fixed.count;
    p->source[0].per_Nm = p->per_Nm.wave;
    p->source[0].per_Nm_count = p->per_Nm.count;
    return status;
}

hci_status hci_setup_sources(const hci_setup_task *b)
{
    const hci_scenario *s = b->scenario;
    hci_setup *p = b->setup;
    p->source[0].strategy = s->strategy;
    p->source[1].strategy = s->strategy_2;
    p->source[1].from_s = s->strategy_2_from_s;
    if (b->loop) p->source[0].code = &b->loop->code;
    p->drive.control.sources = p->source;
    p->drive.control.source_count = isnan(s->strategy_2_from_s) ? 1 : 2;
    return s->currents[0] != '\0' ? read_waves(b) : HCI_OK;
}
