#include "host/diagnose/fit/evidence.h"

#include <string.h>

#include "host/diagnose/fit/predicted_reading.h"

const hci_stretch *hci_evidence_next(const hci_evidence *e, const hci_stretch *after)
{
    const hci_stretch *end = e->cells->stretch + e->cells->stretch_count;
    const hci_stretch *s = after ? after + 1 : e->cells->stretch;
    while (s < end && !e->use[s->run])
        ++s;
    return s < end ? s : NULL;
}

hci_noise *hci_evidence_noise(const hci_evidence *e, const hci_stretch *stretch)
{
    return &e->noise[stretch - e->cells->stretch];
}

hci_status hci_evidence_residual(const hci_evidence *e, const hci_effects *effects, double *residual_Nm,
                                 hci_note *note)
{
    hci_observation seen;
    if (!hci_observation_make(e, effects, false, &seen))
        return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for comparing model and recordings");
    memset(residual_Nm, 0, e->cells->count * sizeof *residual_Nm);
    for (const hci_stretch *s = NULL; (s = hci_evidence_next(e, s)) != NULL;) {
        hci_observe(e, effects, s, &seen);
        for (size_t j = 0; j < s->count; ++j)
            residual_Nm[s->first + j] = e->cells->cell[s->first + j].torque_Nm - seen.torque_Nm[j];
    }
    hci_observation_release(&seen);
    return HCI_OK;
}
