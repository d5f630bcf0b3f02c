/* Cogging torque that one slow turn has shown is declared in the next round, and has in it what the sensors
 * of that turn made of it, such as side bands of an encoder that is not centred; further recordings under
 * another load tell the one from the other only where it is not held. */
#include "hci/host/diagnose/diagnose.h"

#include <math.h>

static bool has_cogging(const hci_machine_data *machine)
{
    for (size_t k = 0; k < machine->model.cogging_count; ++k)
        if (machine->model.cogging[k].sine != 0.0 || machine->model.cogging[k].cosine != 0.0) return true;
    return false;
}

static bool any_is_held(const hci_runs *runs)
{
    for (size_t k = 0; k < runs->count; ++k)
        if (runs->role[k] == HCI_ROLE_FIT && runs->run[k].torque_source == HCI_TORQUE_HOLDING) return true;
    return false;
}

static bool is_explained(const hci_diagnosis *d)
{
    return d->search == HCI_WORK_COMPLETE &&
           (d->verdict == HCI_DIAGNOSIS_COMPLETE || d->verdict == HCI_DIAGNOSIS_EXPLAINED);
}

/* Of a slow turn against a load that nobody knows nothing is complete, but the ripple is described. */
static bool is_described(const hci_diagnosis *d)
{
    return is_explained(d) ||
           (d->search == HCI_WORK_COMPLETE && d->unknown_loads > 0 && d->verdict == HCI_DIAGNOSIS_AMBIGUOUS);
}

hci_status hci_diagnose_further(const hci_machine_data *machine, const hci_effects *declared,
                                const hci_runs *runs, const hci_diagnose_options *options, hci_diagnosis *d,
                                hci_note *note)
{
    hci_diagnosis afresh;
    const hci_status status = hci_diagnose(machine, declared, runs, options, d, note);
    if (status > HCI_NOT_REACHED || is_described(d) || d->search == HCI_WORK_INTERRUPTED || d->slip ||
        !has_cogging(machine) || !any_is_held(runs))
        return status;
    hci_machine_data without = *machine;
    without.model.cogging_count = 0;
    const hci_status again = hci_diagnose(&without, declared, runs, options, &afresh, note);
    if (again <= HCI_NOT_REACHED && is_described(&afresh)) {
        hci_diagnosis_release(d);
        *d = afresh;
        d->without_cogging = true;
        return again;
    }
    if (again <= HCI_NOT_REACHED) hci_diagnosis_release(&afresh);
    if (again > HCI_NOT_REACHED) hci_diagnosis_release(d);
    return again > HCI_NOT_REACHED ? again : status;
}
