/* Currents for a target torque, solved for the declared and for the corrected machine and compared on the
 * latter. */
#include <string.h>

#include "hci/host/diagnose/diagnose.h"

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
    how.uncertainty = &diagnosis->uncertainty;
    r->after_status = status = hci_solve(machine, &how, &r->after, note);
    if (status <= HCI_NOT_REACHED)
        status =
            hci_evaluate_currents(machine, corrected, &r->before.current, how.target, &r->old_currents, note);
    if (!status)
        status =
            hci_evaluate_currents(machine, corrected, &r->after.current, how.target, &r->new_currents, note);
    if (!status) return r->after_status;
    hci_resolution_release(r);
    return status;
}

void hci_resolution_release(hci_resolution *r)
{
    hci_solution_release(&r->before);
    hci_solution_release(&r->after);
    hci_torque_evaluation_release(&r->old_currents);
    hci_torque_evaluation_release(&r->new_currents);
    memset(r, 0, sizeof *r);
}
