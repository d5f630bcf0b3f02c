#include "host/diagnose/fit/regression.h"

#include <string.h>

#include "host/diagnose/fit/predicted_reading.h"

const hci_segment *hci_regression_next(const hci_regression *e, const hci_segment *after)
{
    const hci_segment *end = e->samples->segment + e->samples->segment_count;
    const hci_segment *s = after ? after + 1 : e->samples->segment;
    while (s < end && !e->use[s->run])
        ++s;
    return s < end ? s : NULL;
}

hci_noise *hci_regression_noise(const hci_regression *e, const hci_segment *segment)
{
    return &e->noise[segment - e->samples->segment];
}

hci_status hci_regression_residual(const hci_regression *e, const hci_effects *effects, double *residual_Nm,
                                   hci_note *note)
{
    hci_predicted_reading predicted;
    if (!hci_predicted_reading_make(e, effects, false, &predicted))
        return hci_note_memory(note, NULL, "comparing model and recordings");
    memset(residual_Nm, 0, e->samples->count * sizeof *residual_Nm);
    for (const hci_segment *s = NULL; (s = hci_regression_next(e, s)) != NULL;) {
        hci_predicted_reading_fill(e, effects, s, &predicted);
        for (size_t j = 0; j < s->count; ++j)
            residual_Nm[s->first + j] = e->samples->sample[s->first + j].torque_Nm - predicted.torque_Nm[j];
    }
    hci_predicted_reading_release(&predicted);
    return HCI_OK;
}
