/* The loop closed: currents for the corrected machine. */
#include <string.h>

#include "hci/host/diagnose/diagnose.h"

static hci_status judge(const hci_machine_data *machine, const hci_effects *effects,
                        const hci_solution *solution, const hci_target *target, hci_judgement *judgement,
                        hci_note *note)
{
    return hci_judge_currents(machine, effects, solution->current.wave, solution->current.count, target,
                              judgement, note);
}

hci_status hci_diagnosis_resolve(const hci_machine_data *machine, const hci_effects *declared,
                                 const hci_diagnosis *diagnosis, const hci_solve_options *options,
                                 hci_resolution *r, hci_note *note)
{
    const hci_effects *corrected = &diagnosis->effects.list;
    hci_solve_options how = *options;
    hci_status status;
    memset(r, 0, sizeof *r);
    how.effects = declared;
    r->before_status = status = hci_solve(machine, &how, &r->before, note);
    if (status > HCI_NOT_REACHED) return status;
    how.effects = corrected;
    r->after_status = status = hci_solve(machine, &how, &r->after, note);
    if (status <= HCI_NOT_REACHED)
        status = judge(machine, corrected, &r->before, how.target, &r->old_currents, note);
    if (!status) status = judge(machine, corrected, &r->after, how.target, &r->new_currents, note);
    if (!status) return r->after_status;
    hci_resolution_release(r);
    return status;
}

void hci_resolution_release(hci_resolution *r)
{
    hci_solution_release(&r->before);
    hci_solution_release(&r->after);
    hci_judgement_release(&r->old_currents);
    hci_judgement_release(&r->new_currents);
    memset(r, 0, sizeof *r);
}
