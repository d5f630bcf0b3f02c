#include "host/diagnose/fit/current_sums.h"

#include <math.h>

double hci_current_sum_left(const hci_regression *e, const hci_effects *effects,
                            const hci_binned_sample *sample)
{
    const hci_sample truth = hci_effects_undo(effects, e->machine->pole_pairs, &sample->reading);
    double left_A = sample->sum_A;
    for (int phase = 0; phase < 3; ++phase)
        left_A -= sample->reading.i_abc[phase] - truth.i_abc[phase];
    return left_A;
}

double hci_current_sums_rms(const hci_regression *e, const hci_effects *effects)
{
    double square = 0.0, count = 0.0;
    for (const hci_segment *s = NULL; (s = hci_regression_next(e, s)) != NULL;) {
        const double deviation_A = e->sum_deviation_A[s->run];
        if (!(deviation_A > 0.0)) continue;
        for (size_t k = s->first; k < s->first + s->count; ++k) {
            const hci_binned_sample *sample = &e->samples->sample[k];
            const double left = hci_current_sum_left(e, effects, sample) / deviation_A;
            square += sample->count * left * left;
            count += sample->count;
        }
    }
    return count > 0.0 ? sqrt(square / count) : 0.0;
}
